// SPDX-License-Identifier: BSD-3-Clause
// Convex hulls of points in space, by qhull.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Corners that a hull may have.
inline constexpr std::size_t most_hull_corners = 30'000;

/// The hull of at least one point, all finite: corners are points as they were given, in the order of their
/// coordinates; faces are triangles, counter-clockwise from outside. No point is farther outside than 1e-9 of the
/// hull's size. Points that lie in a plane or on a line, to rounding, are all corners, without faces. Throws
/// InputError, naming `where`, at more than most_hull_corners corners; Stopped. O(n log n).
Solid convex_hull(std::span<const Vec3> points, const std::string& where, const Execution& execution);

/// Leaves each point once, in the order of their coordinates, and says of each point that was there its number now.
/// Fewer than 2^32 points. Throws Stopped. O(n log n).
std::vector<std::uint32_t> weld_points(std::vector<Vec3>& points, const Execution& execution);

/// What a closed surface of outward triangles holds; 0 without triangles.
double volume_inside(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace warren
