// SPDX-License-Identifier: BSD-3-Clause
// The first pages of heap and stack, asked of the kernel at once: one call instead of some fifty interruptions, half a
// microsecond each on a good day, ten on a bad one. A small question touches no more than these.
#pragma once

namespace warren {

/// What is left to the kernel where it knows no such call.
void take_first_pages();

}  // namespace warren
