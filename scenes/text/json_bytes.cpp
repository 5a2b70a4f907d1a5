// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/json_bytes.hpp"

#include <algorithm>

#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

constexpr std::size_t json_bytes_a_look = std::size_t{1} << 16;

}  // namespace

JsonBytes::JsonBytes(const InputFile& file, const Execution& execution)
    : file_(file), execution_(execution), text_(file.bytes()) {
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  next_look_ = text_.data() + std::min(json_bytes_a_look, text_.size());
}

/// A text grows in two vectors that double, so it is asked for four times; all else becomes at most 32 bytes a byte.
void JsonBytes::look() {
  constexpr std::size_t small_blocks_a_byte = 32;
  const char* end = text_.data() + text_.size();
  const std::string_view seen(next_look_ - std::min<std::ptrdiff_t>(json_bytes_a_look, next_look_ - text_.data()),
                              next_look_);
  const std::size_t quote = seen.rfind('"');
  without_quote_ = quote == std::string_view::npos ? without_quote_ + seen.size() : seen.size() - quote;
  execution_.reserve(small_blocks_a_byte * json_bytes_a_look + 4 * without_quote_);
  if (seen.size() == json_bytes_a_look && seen.find_first_not_of("0123456789") == std::string_view::npos) {
    scene_text::Place{file_.name(), line_}.fail("expected numbers of at most 65536 digits", seen);
  }
  next_look_ += std::min<std::ptrdiff_t>(json_bytes_a_look, end - next_look_);
}

}  // namespace warren
