// SPDX-License-Identifier: BSD-3-Clause
// Text of unknown origin (names of files, words of files, what libraries say of them) as it may be shown: one line that
// moves no cursor, changes no colour and reads in the order of its bytes. The only function that does this.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace warren {

/// The text, cut off with "..." once `longest` bytes are shown. As \xHH stands each byte that is no UTF-8, and each of
/// a character that can't be seen or acts on others: controls (C0, DEL, C1), ends of lines and paragraphs, marks,
/// embeddings, overrides and isolates of direction, zero-width spaces and joins of words, tags, and what is no
/// character. The same text again if it is made printable twice. Linear in what is shown.
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// Bytes of the UTF-8 character that the text, which is not empty, begins with; 0 where it begins with none.
std::size_t utf8_bytes(std::string_view text);

}  // namespace warren
