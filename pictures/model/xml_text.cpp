// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/xml_text.hpp"

#include <algorithm>
#include <cstddef>

#include "core/base/printable.hpp"

namespace warren {
namespace {

/// add(piece): each character, or what stands for it.
template <class Add>
void for_each_seen(std::string_view text, const Add& add) {
  while (!text.empty()) {
    const std::string_view character = text.substr(0, std::max<std::size_t>(utf8_bytes(text), 1));
    const bool is_seen = character == "\n" || printable(character) == character;
    add(is_seen ? character : std::string_view("?"));
    text.remove_prefix(character.size());
  }
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string out;
  for_each_seen(text, [&](std::string_view piece) {
    const char c = piece.front();
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : piece;
  });
  return out;
}

std::string seen_text(std::string_view text) {
  std::string out;
  for_each_seen(text, [&](std::string_view piece) { out += piece; });
  return out;
}

}  // namespace warren
