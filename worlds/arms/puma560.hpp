// SPDX-License-Identifier: BSD-3-Clause
// The Unimation Puma 560: its Denavit-Hartenberg table (metres, after Corke and Armstrong-Helouvry, ICRA 1994), its
// joint limits, its inverse kinematics in closed form, and a search for postures at a place.
//
// Inverse kinematics (after Paul and Zhang, Int. J. Robotics Research 5(2), 1986) of a wrist whose angles are given:
// the tip's place gives the shoulder on two sides and for each the elbow on two: four branches, and each angle again a
// full turn further where the limits leave room for that. Where an end of the reach makes two branches one, it is told
// once.
//
// Which postures bring the tool's tip to a place, for an arm of the Puma 560's shape? Joints 4 and 5 are free, and for
// each turn of theirs the first three follow in closed form. So the two are searched: their limits are halved again and
// again, and a piece is dropped where no turn in it can do. That is proved: all turns of a piece keep the tip, seen
// from frame 3, in a ball, and the closed form, with intervals for numbers, then says between which angles joints 1, 2
// and 3 would have to be; where that is beyond a joint's limits for either shoulder and elbow, the piece can't do. The
// middles of pieces of one size are tried, so what is found is spread evenly.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {

/// classic: +-160, -45..225, -225..45, -110..170, +-100, +-266 degrees, as the toolboxes long had them.
/// symmetric: +-160, +-110, +-135, +-266, +-100, +-266 degrees (Wang, Chen, IEEE Trans. Robotics Autom. 7(4), 1991), as
/// they have them now.
enum class PumaLimits : std::uint8_t { classic, symmetric };
constexpr std::string_view name_of(PumaLimits limits) {
  return limits == PumaLimits::classic ? "classic" : "symmetric";
}

/// The standard table; the tool stands `tool` metres along the last z axis.
DhTable puma560_table(double tool = 0.0, PumaLimits limits = PumaLimits::classic);

/// All joint angles within the limits that bring the tool's tip to `place`, with the wrist's three angles as given: the
/// four branches of shoulder and elbow and their full turns. For an arm of puma560_table's shape (any lengths d3, d4,
/// a2, a3, any limits, a tool along the last z axis). In a fixed order; empty: out of reach. Throws InputError for
/// chains of another shape.
std::vector<JointState> puma560_inverse_place(const SerialChain& chain, const Vec3& place,
                                              const std::array<double, 3>& wrist);

/// Is this a chain of that shape?
bool has_puma560_shape(const SerialChain& chain);

struct ToolPostures {
  std::vector<JointState> states;  ///< within the limits, joint 6 as asked for, since the tool lies along its axis
  bool none_is_left = false;       ///< proved, where there are none: the place is out of reach
};

/// Pieces are halved until there are `enough` states, none is left, or they are a ten-thousandth of a radian small or
/// 200,000; each takes some microseconds. In a fixed order. Throws InputError as puma560_inverse_place, Stopped.
ToolPostures tool_postures(const SerialChain& chain, const Vec3& place, double sixth, std::size_t enough,
                           const Execution& execution);

}  // namespace warren
