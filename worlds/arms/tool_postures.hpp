// SPDX-License-Identifier: BSD-3-Clause
// Which postures bring the tool's tip to a place, for an arm of the Puma 560's shape? Joints 4 and 5 are free, and for
// each turn of theirs the first three follow in closed form. So the two are searched: their limits are halved again and
// again, and a piece is dropped where no turn in it can do. That is proved: all turns of a piece keep the tip, seen
// from frame 3, in a ball, and the closed form, with intervals for numbers, then says between which angles joints 1, 2
// and 3 would have to be; where that is beyond a joint's limits for either shoulder and elbow, the piece can't do. The
// middles of pieces of one size are tried, so what is found is spread evenly.
#pragma once

#include <cstddef>
#include <vector>

#include "core/run/execution.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {

struct ToolPostures {
  std::vector<JointState> states;  ///< within the limits, joint 6 as asked for, since the tool lies along its axis
  bool none_is_left = false;       ///< proved, where there are none: the place is out of reach
};

/// Pieces are halved until there are `enough` states, none is left, or they are a ten-thousandth of a radian small or
/// 200,000; each takes some microseconds. In a fixed order. Throws InputError as puma560_inverse_place, Stopped.
ToolPostures tool_postures(const SerialChain& chain, const Vec3& place, double sixth, std::size_t enough,
                           const Execution& execution);

}  // namespace warren
