// SPDX-License-Identifier: BSD-3-Clause
// A body that moves along a picture's path.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"

namespace warren {

struct MovingBody {
  std::vector<Vec2> outline = {};    ///< around the reference point; empty: a disc
  double radius = 0.0;               ///< of the disc
  bool heads = false;                ///< a disc that has a heading: it is marked
  std::vector<Se2> poses = {};       ///< along the path, at least one; a leg turns the shorter way
  std::vector<double> lengths = {};  ///< of the leg that ends at each pose; the first is 0
};

}  // namespace warren
