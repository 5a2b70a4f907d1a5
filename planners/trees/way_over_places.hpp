// SPDX-License-Identifier: BSD-3-Clause
// A way over the free places of a coarse grid: breadth first, all places of a row at once, eight neighbours each; then
// straight on as far as the places allow. First over places whose neighbours are free as well, then over all. Some
// dozens of instructions a row and step, so about 2 us: a hint to try before a search, whose motions must be checked.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/world.hpp"

namespace warren {

/// Places from start to goal, both included, and which of them are the corners of a way straight from one to the next,
/// the first and the last included. Empty where no way was found.
struct PlaceWay {
  std::vector<Vec2> places;
  std::vector<std::uint32_t> corners;
};

/// A set bit of the grid is a free place.
PlaceWay way_over_places(const PlaceGrid& free, Vec2 start, Vec2 goal);

}  // namespace warren
