// SPDX-License-Identifier: BSD-3-Clause
// Out of where a car that backs up can hardly move, such as a parking bay with half a metre to spare: by strokes,
// straight or at full lock, each as long as it is certified free. Such strokes are shorter than the motions of a
// lattice, and no sample falls between them. Searched breadth first, so the fewest strokes come first; poses that
// differ by less than a hundredth of a turning radius and of a radian are one, then by less than 0.003 and by 0.001. A
// queue of its own: core's searches have vertices, and a stroke has no end before it is driven.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/solution.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "worlds/poses/car_world.hpp"

namespace warren {

/// Ways from a free pose whose last stroke is 0.8 turning radii long: poses, the first `from` itself, between each two
/// of which the car's shortest curve is one free stroke. At most `most`, the fewest strokes first. None where `from`
/// has such a stroke itself, or where each of the three searches tried 10,000 poses or all there are in vain. Driven
/// back, they are ways in. Throws Stopped.
std::vector<Path<Se2>> ways_out(const CarBody& body, const Se2& from, std::size_t most, const Execution& execution);

}  // namespace warren
