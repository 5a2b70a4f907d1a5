// SPDX-License-Identifier: BSD-3-Clause
// Where a ray meets a solid.
#pragma once

#include "pictures/model/solids.hpp"

namespace warren {

/// How far from the eye a ray of length 1 enters the solid; infinite where it passes by; < 0 where it is behind.
double enter_solid(const Vec3& eye, const Vec3& ray, const Solid& s);

/// Outwards, of length 1, at a place on its surface.
Vec3 normal_at(const Vec3& p, const Solid& s);

}  // namespace warren
