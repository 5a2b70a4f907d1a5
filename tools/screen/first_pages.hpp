// SPDX-License-Identifier: BSD-3-Clause
// The first pages of heap and stack, asked of the kernel at once: one call instead of some fifty interruptions, half a
// microsecond each on a good day, ten on a bad one. A small question touches no more than these.
#pragma once

namespace warren::tools {

/// Never fails: a kernel that knows no such call gives the pages one by one, as they are touched.
void take_first_pages();

}  // namespace warren::tools
