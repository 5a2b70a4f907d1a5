// SPDX-License-Identifier: BSD-3-Clause
// What the machine itself gives to several threads at this moment. Two cores of a virtual machine may be two threads of
// one core, or share it with somebody else: then even arithmetic in registers doesn't run twice as fast on both, and no
// program can. So that a speed-up can be held against what was there, the same arithmetic is timed beside each run.
#pragma once

#include "parallel/execution.hpp"

namespace warren::studies {

/// Rounds of integer arithmetic a second that the execution's threads do together, in registers, enough of it at once
/// to fill a core: latency leaves no room for another thread on the same core. Timed in each thread, so that waking
/// threads and sharing out the work cost nothing. Takes some 10 ms of CPU. Throws Stopped.
double arithmetic_per_second(const Execution& execution);

}  // namespace warren::studies
