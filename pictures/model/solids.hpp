// SPDX-License-Identifier: BSD-3-Clause
// Solids of space seen in perspective, as one part of a picture: plain data; formats/solid_raster.cpp draws them.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "pictures/model/colors.hpp"
#include "pictures/model/picture_options.hpp"
#include "scenes/scene/dh_table.hpp"

namespace warren {

/// A ball that went from a to b (a == b: a ball), or the box between these corners.
struct Solid {
  Vec3 a;
  Vec3 b;
  double radius = 0.0;  ///< of the ball; < 0: a box
  Rgb color = {};
  Part part = Part::world;
};

/// A floor with squares below the solids, and shadows on it, makes depth readable; what is far is paler.
struct SolidView {
  Box box = {};              ///< in the picture's world: where it stands
  Vec3 target;               ///< the middle of what is seen
  double reach = 1.0;        ///< of a ball around the target that just fits into the box, > 0
  double azimuth_rad = 0.0;  ///< where the eye stands, as seen from the target: from x to y
  double rise_rad = 0.0;     ///< and above the floor
  Vec3 floor;                ///< the corner of the floor with the least x and y
  double floor_side = 1.0;   ///< > 0
  double square = 1.0;       ///< side of the floor's squares
  std::vector<Solid> solids = {};
  bool is_thinned = false;  ///< lines of a roadmap are thinner and paler, being so many
};

/// Of links and paths that are to be seen, in reaches.
inline constexpr double least_radius = 0.006;

/// The eye is so many reaches away from the target.
inline constexpr double eye_distance = 3.2;

}  // namespace warren
