// SPDX-License-Identifier: BSD-3-Clause
// What may follow the words of a command line that is being typed, from the table of commands: verbs, options that are
// not given yet, their values, also after "--opt=" and one by one in lists, worlds (maze: and its keys), names of
// examples, files. The shells' scripts (warren completion SHELL) ask for it and add the files themselves.
#pragma once

#include <span>
#include <string>

namespace warren::tools {

/// words: those behind the program's name, the last as far as it is typed (perhaps empty). A line a candidate, "WORD"
/// or "WORD<tab>what it is", whole words that begin with the last one; then a line of ":", of "f" for files and "d" for
/// folders that fit as well, "n" if the word goes on after the candidate, a blank, and the part of the last word that
/// stands before a file's name, such as "--json=".
std::string completion_lines(std::span<const std::string> words);

}  // namespace warren::tools
