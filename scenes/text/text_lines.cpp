// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/text_lines.hpp"

#include <algorithm>

namespace warren {
namespace {

constexpr std::size_t bytes_a_look = std::size_t{1} << 18;

}  // namespace

TextLines::TextLines(const InputFile& file, const Execution& execution) : file_(file), execution_(execution) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (execution.progress != nullptr) execution.progress->begin("read", file.bytes().size());
  if (file.bytes().starts_with(byte_order_mark)) at_ = byte_order_mark.size();
}

bool TextLines::next() {
  const std::string_view all = file_.bytes();
  if (at_ >= all.size()) return false;
  if (at_ - forgotten_ >= bytes_a_look) look();
  const std::size_t end = std::min(all.find('\n', at_), all.size());
  line_ = all.substr(at_, end - at_);
  at_ = end + 1;
  ++number_;
  return true;
}

void TextLines::look() {
  constexpr std::size_t small_blocks_a_byte = 32;
  execution_.reserve(std::min(bytes_a_look, file_.bytes().size() - at_) * small_blocks_a_byte);
  execution_.advance(at_ - forgotten_);
  file_.forget(forgotten_, at_);
  forgotten_ = at_;
}

}  // namespace warren
