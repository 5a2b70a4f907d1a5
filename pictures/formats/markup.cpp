// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "core/base/printable.hpp"

namespace warren {

std::string seen_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::string_view character = text.substr(0, std::max<std::size_t>(utf8_bytes(text), 1));
    const bool is_seen = character == "\n" || printable(character) == character;
    out += is_seen ? character : std::string_view("?");
    text.remove_prefix(character.size());
  }
  return out;
}

std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : seen_text(text)) {
    const std::string_view piece(&c, 1);
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : piece;
  }
  return out;
}

std::string css_color(Rgb c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string encoded(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0U;
    };
    const unsigned three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    text += digits[three >> 18U];
    text += digits[three >> 12U & 63U];
    text += i + 1 < bytes.size() ? digits[three >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? digits[three & 63U] : '=';
  }
  return text;
}

}  // namespace

void Base64::write(std::string_view bytes) {
  left_ += bytes;
  const std::size_t whole = left_.size() / 3 * 3;
  if (whole == 0) return;
  write_(encoded(std::string_view(left_).substr(0, whole)));
  left_.erase(0, whole);
}

void Base64::end() { write_(encoded(left_)); }

}  // namespace warren
