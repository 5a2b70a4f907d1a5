// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/xml_text.hpp"

#include <algorithm>
#include <cstddef>

#include "core/base/printable.hpp"

namespace warren {

std::string xml_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t bytes = std::max<std::size_t>(utf8_bytes(text), 1);
    const char c = text.front();
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        if (bytes > 1) {
          out += text.substr(0, bytes);
        } else {
          out += (static_cast<unsigned char>(c) < 0x20 && c != '\n') || static_cast<unsigned char>(c) > 0x7e ? '?' : c;
        }
    }
    text.remove_prefix(bytes);
  }
  return out;
}

}  // namespace warren
