// SPDX-License-Identifier: BSD-3-Clause
// The shapes of marks: start is a disc, goal a star with five points; a front is a triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

enum class MarkShape : std::uint8_t { disc, star, front };

/// The outline around the origin; y up; the star stands on two points, the front points to the right. All look equally
/// large.
std::vector<Vec2> mark_outline(MarkShape shape, double radius);

}  // namespace warren
