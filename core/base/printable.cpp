// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/printable.hpp"

#include <array>
#include <cstdint>

namespace warren {
namespace {

struct CodeRange {
  std::uint32_t first;
  std::uint32_t last;
};

/// Joiners (U+200C, U+200D) and variation selectors are left out: scripts need them, and they reorder nothing.
constexpr std::array<CodeRange, 13> unseen{{
    {0x00, 0x1f},        // C0 controls, the escape and the end of a line among them
    {0x7f, 0x9f},        // DEL, C1 controls: U+009B begins an escape sequence as ESC [ does
    {0xad, 0xad},        // soft hyphen
    {0x61c, 0x61c},      // mark of direction
    {0x180e, 0x180e},    // vowel separator without width
    {0x200b, 0x200b},    // space without width
    {0x200e, 0x200f},    // marks of direction
    {0x2028, 0x202e},    // ends of line and paragraph, embeddings and overrides of direction
    {0x2060, 0x206f},    // joins of words, isolates of direction
    {0xfdd0, 0xfdef},    // no characters
    {0xfeff, 0xfeff},    // byte order mark
    {0xfff0, 0xfffb},    // annotations
    {0xe0000, 0xe0fff},  // tags
}};

bool is_unseen(std::uint32_t code) {
  const bool no_character = (code & 0xfffeU) == 0xfffeU;
  return no_character ||
         std::any_of(unseen.begin(), unseen.end(), [&](CodeRange r) { return code >= r.first && code <= r.last; });
}

struct Character {
  std::size_t bytes = 0;  // 0: no UTF-8
  std::uint32_t code = 0;
};

/// The character at the front. Overlong forms are no UTF-8.
Character character_at_front(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {1, lead};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || bytes > text.size()) return {};
  std::uint32_t code = lead & (0xffU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6U | (byte(i) & 0x3fU);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool is_half = code >= 0xd800 && code <= 0xdfff;
  return code >= least[bytes] && code <= 0x10ffff && !is_half ? Character{bytes, code} : Character{};
}

/// Bytes of the character at the front if it may be shown, else 0.
std::size_t shown_bytes(std::string_view text) {
  const Character c = character_at_front(text);
  return c.bytes > 0 && !is_unseen(c.code) ? c.bytes : 0;
}

}  // namespace

std::size_t utf8_bytes(std::string_view text) { return character_at_front(text).bytes; }

std::string printable(std::string_view text, std::size_t longest) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string shown;
  while (!text.empty()) {
    if (shown.size() >= longest) return shown + "...";
    const std::size_t bytes = shown_bytes(text);
    if (bytes == 0) {
      const auto byte = static_cast<unsigned char>(text.front());
      shown.append("\\x").append({digits[byte >> 4U], digits[byte & 15U]});
    } else {
      shown.append(text.substr(0, bytes));
    }
    text.remove_prefix(std::max<std::size_t>(1, bytes));
  }
  return shown;
}

}  // namespace warren
