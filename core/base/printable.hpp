// SPDX-License-Identifier: BSD-3-Clause
// Text of unknown origin (names of files, words of files, what libraries say of them) as it may be shown: one line that
// moves no cursor, changes no colour and reads in the order of its bytes. The only function that does this.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace warren {

/// The text, cut off with "..." once `longest` bytes are shown. As \xHH stands each byte that is no UTF-8, and each of
/// a character that can't be seen or acts on others: controls (C0, DEL, C1), ends of lines and paragraphs, marks,
/// embeddings, overrides and isolates of direction, zero-width spaces and joins of words, tags, and what is no
/// character. The same text again if it is made printable twice. Linear in what is shown.
std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// Bytes of the UTF-8 character that the text, which is not empty, begins with; 0 where it begins with none.
std::size_t utf8_bytes(std::string_view text);

/// What stands between the marks: one piece more than there are marks; pieces may be empty.
inline std::vector<std::string_view> split(std::string_view text, std::string_view mark) {
  std::vector<std::string_view> pieces;
  for (;;) {
    const std::size_t end = text.find(mark);
    pieces.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + mark.size());
  }
}

/// How far two words are from each other: the optimal string alignment distance. O(length a × length b). How many
/// characters make b of a, inserted, deleted, replaced, or swapped with the next.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace warren
