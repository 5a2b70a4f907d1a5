// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/error.hpp"

#include <cstddef>

namespace warren {
namespace {

bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

/// An @ that begins a word: not one within a name of a file.
bool begins_option(std::string_view text, std::size_t i) {
  return text[i] == '@' && i + 1 < text.size() && is_letter(text[i + 1]) && (i == 0 || text[i - 1] == ' ');
}

}  // namespace

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
