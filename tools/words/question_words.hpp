// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about the question that a world is asked.
#pragma once

#include <span>

#include "solve/question/question.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --robot --start --goal --clearance --contact
std::span<const OptionSpec> question_option_specs();

/// Nothing where nothing is said. Throws UsageError for values that no problem can have.
Question question_words(const Arguments& arguments);

}  // namespace warren::tools
