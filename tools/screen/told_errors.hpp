// SPDX-License-Identifier: BSD-3-Clause
// What goes wrong in a program becomes one line on standard error and an exit code, here and nowhere else.
#pragma once

#include <functional>
#include <string_view>

namespace warren::tools {

/// Runs the program of that name and gives its exit code; what it has printed is on its way then. hint: follows what is
/// said of a command line that can't be.
int run_with_errors_told(std::string_view program, std::string_view hint, const std::function<int()>& run);

/// "NAME: text" on standard error; gives the code back.
int complain(std::string_view program, int code, std::string_view text);

}  // namespace warren::tools
