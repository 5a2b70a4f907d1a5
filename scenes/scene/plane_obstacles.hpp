// SPDX-License-Identifier: BSD-3-Clause
// A scene's polygons as planners take them: checked, without repeated corners, anticlockwise. Refused, with the
// polygon's line: fewer than three different corners, no area, an outline that crosses or touches itself or turns back
// on itself. Corners on a straight side, equal corners in a row (a closed ring's last one too) and either orientation
// are legal; so are polygons that touch, share corners or sides, or overlap: what is blocked is their union.
// O(n log n) for n corners, in parallel over the polygons.
//
// Polygons with holes as obstacles: cut along lines between their own corners into simple polygons that touch, so that
// what is blocked and what is free stays the same to the last bit, holes included, and all planners know the pieces.
//
// Each hole is tied by two cuts, from its leftmost and from its rightmost corner (of equal x: the lower and the upper
// one), so every piece is bounded by one outline. A sweep finds the cuts as those of polygons
// into monotone ones are found (de Berg et al., Computational Geometry, ch. 3), and rings that cross. Rings that touch
// at a point are tied there: of any corner all that is left without it hangs together, so each outline still passes a
// corner once. Every decision is exact. O(n log n) for n corners in all, however many holes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// outer, holes: rings of either orientation, not closed. The pieces run anticlockwise. Empty where the rings can't be
/// those of a polygon with holes: a hole without area, outside of the polygon, or one that crosses another ring or
/// shares more than a point with it. A ring that meets itself is handed back alone, as the one piece: whoever takes it
/// says what is wrong. Throws Stopped.
std::vector<std::vector<Vec2>> without_holes(const std::vector<Vec2>& outer, std::span<const std::vector<Vec2>> holes,
                                             const Execution& execution);

/// Adds the pieces as polygons of that line, the outer ring as it is where there are no holes, and the cuts between
/// them as seams. Throws InputError naming the scene's source and the line where the rings can't be those of a polygon
/// with holes, Stopped.
void add_without_holes(Scene& scene, std::size_t line, std::vector<Vec2> outer,
                       std::span<const std::vector<Vec2>> holes, const Execution& execution);

/// Is the point on a seam, between its ends? Then it is strictly inside of the polygon that was cut there.
bool stands_on_seam(const Scene& scene, Vec2 p);

/// Two sides that meet where they must not; side i begins in corner i.
struct SideContact {
  std::size_t first;
  std::size_t second;
};

/// Where a closed outline crosses or touches itself. Small ones by comparing all sides, others by a sweep, which stops
/// at the first contact: O(n log n), exact. At least three corners, no two in a row equal. Sides that follow each other
/// may meet in their corner alone. Throws Stopped.
std::optional<SideContact> self_contact(std::span<const Vec2> corners, const Execution& execution);

/// Throws InputError naming file and line for a polygon that is not simple, Stopped.
void check_polygons(const Scene& scene, const Execution& execution);

/// Throws InputError naming `where` for the outline of a body that is no simple polygon, Stopped.
void check_body(std::span<const Vec2> outline, const std::string& where, const Execution& execution);

/// Polygons in the scene's order, walls, bounds. Throws as check_polygons does, and for 2^32 corners.
PlaneObstacles plane_obstacles(const Scene& scene, const Execution& execution);

/// The same outline without repeated corners, anticlockwise; as it is where it has no area.
std::vector<Vec2> anticlockwise(const std::vector<Vec2>& corners);

/// Where a polygon is said to be wrong: "file:line", or "file: polygon 3" (from 0) where no line is known.
std::string place_of_polygon(const Scene& scene, std::size_t polygon);

}  // namespace warren
