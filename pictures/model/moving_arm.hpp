// SPDX-License-Identifier: BSD-3-Clause
// An arm that moves: where the ends of its links are at moments of its path.
#pragma once

#include <array>
#include <vector>

#include "core/base/types.hpp"
#include "scenes/scene/dh_table.hpp"

namespace warren {

/// From space into a picture's world: which axes run right and up, and where the space's zero stands.
struct Projection {
  std::array<int, 2> axes;
  Vec2 shift;
  Vec2 at(const Vec3& p) const { return shift + Vec2{p[axes[0]], p[axes[1]]}; }
};

struct MovingArm {
  double radius = 0.0;                 ///< of the links
  std::vector<Projection> views = {};  ///< that show it
  std::vector<double> moments = {};    ///< 0 .. 1, by the way in joint space; as many as spines, none or at least one
  std::vector<Vec3> tools = {};        ///< the tool's way; a line
  std::vector<std::vector<Vec3>> spines = {};  ///< the ends of its links, from the base; all of one size
};

}  // namespace warren
