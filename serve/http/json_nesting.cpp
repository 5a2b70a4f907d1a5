// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http/json_nesting.hpp"

#include <algorithm>

namespace warren::serve {

std::size_t nesting_of(std::string_view text, NestedIn what) {
  std::size_t deepest = 0;
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n' && what == NestedIn::lines) {  // a string holds none
      depth = 0;
      in_string = false;
    } else if (in_string) {
      i += c == '\\' ? 1 : 0;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

}  // namespace warren::serve
