// SPDX-License-Identifier: BSD-3-Clause
// --help and --version: made from the table of commands. And what is said of a word that nobody knows: what it is here,
// where it is one of the field's (docs/other_names.md), else "did you mean" the known word with the smallest edit
// distance.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/embedded_file.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// The verbs, a line each.
std::string program_help();
/// The verb's options, the most used ones or all in groups, and examples, in lines of at most `width` columns (those of
/// 60 at least).
std::string command_help(const Command& command, std::size_t width, bool all);
/// What an option of these commands is, a value of one, or a word of the field. Throws UsageError for an unknown word.
std::string word_help(std::string_view word, std::span<const Command> commands, std::size_t width);
std::string version_text(std::string_view commit);

struct HelpExample {
  std::string_view command;  ///< a whole command line
  std::string_view does;
};
/// Of one verb, or of all in an order in which they can be typed one after the other (help.cpp).
std::vector<HelpExample> help_examples(std::string_view verb = {});
/// Of verbs with many options the ten that are used most, blank-separated; empty: help has all options.
std::string_view most_used_options(std::string_view verb);

/// "--neighbours K|auto|star", "-o, --output FILE"; of a list "NAME[,...]" unless the name says so.
std::string option_usage(const OptionSpec& option);
/// What "WORLD", an operand or a value of that name, is; empty where the name says enough.
std::string_view meaning_of(std::string_view operand);

// The headings under which help and manual pages list options: what is asked, how it is solved, what is written, how
// the program runs. One table by name, since verbs share options.

/// A title each, such as "Question", and what stands below it.
template <class T>
using Groups = std::vector<std::pair<std::string_view, std::vector<const T*>>>;

/// The verb's options in groups, none empty: its own first, the others in the order of the table.
Groups<OptionSpec> grouped_options(const Command& command);

/// The headings of the verbs themselves, in the order of command_table().
Groups<Command> grouped_commands();

// Which build this is: what `warren --version` says beyond the version.

/// The commit that the sources are of, with "-dirty" where they differ from it; "unknown" where they came without git.
/// Made anew by each build (cmake/commit.cmake) and linked into the program alone.
std::string_view build_commit();

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
