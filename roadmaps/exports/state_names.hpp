// SPDX-License-Identifier: BSD-3-Clause
// What the numbers of a state are called in files: x, y, theta, or the joints of an arm.
#pragma once

#include <string>
#include <vector>

namespace warren {

/// "x", "y" of two numbers, "theta" (radians) with them of three; else "q1", "q2" and so on (radians).
std::vector<std::string> state_names(unsigned dimension);

/// Do the first two numbers of a state say a place in the plane?
constexpr bool is_in_plane(unsigned dimension) { return dimension == 2 || dimension == 3; }

}  // namespace warren
