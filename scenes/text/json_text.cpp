// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/json_text.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/base/printable.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

/// What JSON writes for a character below 0x20, and for those that end or begin something.
void append_escaped(std::string& text, char c) {
  constexpr std::string_view characters = "\"\\\b\f\n\r\t";
  constexpr std::string_view letters = "\"\\bfnrt";
  if (const std::size_t at = characters.find(c); at != std::string_view::npos) {
    text += {'\\', letters[at]};
  } else {
    text += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
}

bool is_plain(char c) { return static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\'; }

constexpr std::size_t json_bytes_a_look = std::size_t{1} << 16;

}  // namespace

std::string json_string(std::string_view text) {
  std::string json = "\"";
  while (!text.empty()) {
    const std::size_t bytes = utf8_bytes(text);
    if (bytes == 0) {
      json += "\xef\xbf\xbd";
    } else if (bytes == 1 && !is_plain(text.front())) {
      append_escaped(json, text.front());
    } else {
      json.append(text.substr(0, bytes));
    }
    text.remove_prefix(std::max<std::size_t>(1, bytes));
  }
  return json + "\"";
}

std::string json_number(double value) {
  std::string text;
  append_json_number(text, value);
  return text;
}

void append_json_number(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  std::array<char, 32> digits;  // of a double: 24 at most
  // Paths over cells are whole numbers: these are written without a formatter, below 1e15 without an exponent.
  if (std::abs(value) < 1e15 && std::trunc(value) == value && (value != 0.0 || !std::signbit(value))) {
    const auto [end, error] =
        std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<std::int64_t>(value));
    text.append(digits.data(), end).append(".0");
    return;
  }
  const auto end = fmt::format_to(digits.begin(), FMT_COMPILE("{}"), value);
  text.append(digits.begin(), end);
  if (std::none_of(digits.begin(), end, [](char c) { return c == '.' || c == 'e'; })) text += ".0";
}

void append_json_list(std::string& text, std::span<const double> values) {
  char before = '[';
  for (const double value : values) {
    text += before;
    append_json_number(text, value);
    before = ',';
  }
  text += values.empty() ? "[]" : "]";
}

JsonBytes::JsonBytes(const InputFile& file, const Execution& execution)
    : file_(file), execution_(execution), text_(without_byte_order_mark(file.bytes())) {
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
