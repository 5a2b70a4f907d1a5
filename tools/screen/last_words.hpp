// SPDX-License-Identifier: BSD-3-Clause
// What still works when nothing else does: one line on standard error without a byte of memory, and descriptors that
// are what their numbers say.
#pragma once

#include <string_view>

namespace warren::tools {

/// Where the caller has closed standard input, output or error, what is opened first would take its number, and results
/// and messages would end up in it. Such a descriptor fails from now on when it is used.
void hold_standard_descriptors();

/// Writes to standard error, come what may. Allocates nothing.
void say_on_standard_error(std::string_view text) noexcept;

/// Says that memory is out; returns the exit code for it. Allocates nothing.
int say_memory_is_out() noexcept;

/// Memory that runs out in a destructor, or while an error is told, ends the program by say_memory_is_out(), too, where
/// it would have been aborted.
void install_last_words();

}  // namespace warren::tools
