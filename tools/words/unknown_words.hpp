// SPDX-License-Identifier: BSD-3-Clause
// What is said of a word that nobody knows: what it is here, where it is one of the field's (docs/other_names.md), else
// "did you mean" the known word with the smallest edit distance.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/embedded_file.hpp"

namespace warren::tools {

/// "; WHAT IT IS HERE", or "; did you mean KNOWN?" for the earliest of the closest known words, or for one that begins
/// so, or "; did you mean NAME? WHAT IT IS HERE" for a misspelt word of the field. Capitals and dashes before it count
/// nothing; "" if more than a third of the letters would have to change, a quarter for the field's.
std::string suggestion(std::string_view word, std::span<const std::string_view> known);

// Words of the field, of other planners and of ROS, and what they are here: the one table is docs/other_names.md, whose
// bytes the build puts into the program. Unknown options, verbs, planners and `warren help WORD` ask it.

/// The page alone.
std::span<const EmbeddedFile> other_names_page();

/// A row of the table.
struct OtherName {
  std::string_view names;  ///< "timeout, time limit", the same with dashes before and between and in capitals
  std::string_view here;   ///< a sentence without its full stop; what is typed stands between backquotes
};
const std::vector<OtherName>& other_names();

/// What the word is here, as the screen has it: without backquotes. Empty: not in the table.
std::string other_name(std::string_view word);

/// "--optimise" of "--optimize": options that have a second spelling, which is taken everywhere. Others stay.
std::string_view own_spelling(std::string_view option);

}  // namespace warren::tools
