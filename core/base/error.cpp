// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/error.hpp"

namespace warren {
namespace {

bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

/// An @ that begins a word: not one within a name of a file.
bool begins_option(std::string_view text, std::size_t i) {
  return text[i] == '@' && i + 1 < text.size() && is_letter(text[i + 1]) && (i == 0 || text[i - 1] == ' ');
}

constexpr std::string_view before_value = " (found: ";

std::string placed(std::string_view where, std::string_view wrong, std::string_view value) {
  std::string line{where};
  line.append(": ").append(wrong);
  if (!value.empty()) line.append(before_value).append(value).append(")");
  return line;
}

}  // namespace

PlacedError::PlacedError(std::string_view where, std::string_view wrong, std::string_view value)
    : TextError(placed(where, wrong, value)),
      where_bytes_(printable(where).size()),
      wrong_bytes_(printable(wrong).size()) {}

std::string_view PlacedError::value() const noexcept {
  const std::size_t before = where_bytes_ + 2 + wrong_bytes_ + before_value.size();
  return before < line().size() ? line().substr(before, line().size() - before - 1) : std::string_view{};
}

std::string UsageError::spelled(std::string_view text, std::string_view prefix, char hyphen) {
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!begins_option(text, i)) {
      line += text[i];
      continue;
    }
    line += prefix;
    for (; i + 1 < text.size() && (is_letter(text[i + 1]) || text[i + 1] == '_'); ++i) {
      line += text[i + 1] == '_' ? hyphen : text[i + 1];
    }
  }
  return line;
}

}  // namespace warren
