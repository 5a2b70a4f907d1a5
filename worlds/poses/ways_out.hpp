// SPDX-License-Identifier: BSD-3-Clause
// Out of where a car that backs up can hardly move, such as a parking bay with half a metre to spare: by strokes,
// forwards and backwards in turns, straight or at full lock, each as long as it is certified free. Such strokes are
// shorter than the motions of a lattice, and no sample falls between them. Searched breadth first, so the fewest
// strokes come first; poses that lie within a hundredth of a turning radius and of a radian of one another are one. An
// order of its own, of strokes that have no ends before they are driven: core's searches have vertices.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/solution.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "worlds/poses/car_world.hpp"

namespace warren {

/// Ways from a free pose to places from which the car has a stroke of 0.8 turning radii: poses, the first `from`
/// itself, between each two of which the car's shortest curve is one free stroke. At most `most`, the fewest strokes
/// first. None where `from` has such a stroke itself, or where three times 10,000 poses were tried in vain. Driven
/// back, they are ways in. Throws Stopped.
std::vector<Path<Se2>> ways_out(const CarBody& body, const Se2& from, std::size_t most, const Execution& execution);

}  // namespace warren
