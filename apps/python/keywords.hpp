// SPDX-License-Identifier: BSD-3-Clause
// Python's keywords as the words of a command line: the program's own table says which there are, and the program's own
// readers (tools/words) what they mean, so that an option can't be one thing here and another there. A keyword costs
// under a microsecond.
#pragma once

#include <pybind11/pybind11.h>

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/python/library_calls.hpp"
#include "tools/words/command.hpp"

namespace warren::python {

/// A command of these options, but for those named `without`.
tools::Command command_of(std::string_view name, std::initializer_list<std::span<const tools::OptionSpec>> options,
                          std::initializer_list<std::string_view> without = {});

/// What `make` makes: made when it is first asked for, and kept.
template <tools::Command make()>
const tools::Command& made_once() {
  static const tools::Command command = make();
  return command;
}

/// What follows an option on a command line: words as they are, numbers with all their digits, sequences apart by
/// commas, sequences of sequences by semicolons. Throws TypeError.
std::string word_of(pybind11::handle value, const std::string& keyword);

/// The keywords that are not None, nor False where that is a flag left out, after what is there already, such as
/// operands. Throws TypeError for one that the command has not, UsageError.
tools::Arguments arguments_of(const tools::Command& command, const pybind11::dict& keywords,
                              std::vector<std::string> words = {});

/// Takes threads, budget (seconds, or a word such as "500ms"), memory (bytes, or a word such as "2GiB") and progress
/// out of the keywords. Throws UsageError, TypeError.
CallLimits take_limits(pybind11::dict& keywords);
/// The word of --budget: a number is of seconds.
std::string budget_word(pybind11::handle value);

/// The keywords of a command: name, what follows it, help, choices.
pybind11::list keyword_table(const tools::Command& command);

}  // namespace warren::python
