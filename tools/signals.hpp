// SPDX-License-Identifier: BSD-3-Clause
// SIGINT and SIGTERM set a flag that every stage polls; a second signal kills at once. SIGPIPE ends the program
// quietly.
#pragma once

#include "parallel/deadline.hpp"

namespace warren {

void install_signal_handlers();

/// 0, or the number of the signal that came.
const SignalFlag& signal_flag();

}  // namespace warren
