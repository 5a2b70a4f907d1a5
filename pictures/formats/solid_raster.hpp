// SPDX-License-Identifier: BSD-3-Clause
// Solids in perspective, as pixels: whatever is nearest to the eye is seen, however the solids lie among each other.
#pragma once

#include <cstddef>

#include "core/run/execution.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

/// Those of the parts that are shown. O(solids + pixels that each may cover). Throws Stopped.
Image draw_solids(const SolidView& view, Parts parts, std::size_t width, std::size_t height,
                  const Execution& execution);

// Where a ray meets a solid.

/// How far from the eye a ray of length 1 enters the solid; infinite where it passes by; < 0 where it is behind.
double enter_solid(const Vec3& eye, const Vec3& ray, const SeenSolid& s);

/// Outwards, of length 1, at a place on its surface.
Vec3 normal_at(const Vec3& p, const SeenSolid& s);

}  // namespace warren
