// SPDX-License-Identifier: BSD-3-Clause
// SIGINT, SIGTERM and SIGHUP (unless nohup has it ignored) set a flag that every stage polls: the program ends in
// order, and a second one within a second changes nothing about that, for a key pressed twice must leave no
// half-written file; after a second it kills at once. A file that grows past its limit (SIGXFSZ) is an output that
// can't be written. SIGPIPE ends the program quietly, SIGQUIT at once, with a core where the system keeps one.
#pragma once

#include "core/run/execution.hpp"

namespace warren::tools {

void install_signal_handlers();

/// 0, or the number of the signal that came.
const SignalFlag& signal_flag();
/// The signal that came has done what it could: the next one stops what runs then.
void forget_signal();

}  // namespace warren::tools
