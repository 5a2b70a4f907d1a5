// SPDX-License-Identifier: BSD-3-Clause
// Convex pieces of bodies and of what bodies sweep: a polygon as the union of convex ones, what a piece covers while it
// goes straight or turns about the origin, and Minkowski sums with a wall. Corners run counter-clockwise; a piece may
// also be one point or two.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/base/world.hpp"

namespace warren {

using ConvexPiece = std::vector<Vec2>;

/// The convex hull, counter-clockwise, without corners on its sides. O(n log n).
ConvexPiece convex_hull(std::vector<Vec2> points);

/// A simple polygon, either orientation, as convex pieces: itself if it is convex, else triangles. O(n^3).
std::vector<ConvexPiece> outline_pieces(std::span<const Vec2> outline);

/// What a piece covers on its straight way by `step`: exact.
ConvexPiece swept_by_step(const ConvexPiece& piece, Vec2 step);

/// What a piece covers while it turns about the origin by angle_rad (0 < angle_rad <= pi / 2), as a union. Holds all of
/// it; where the piece holds the origin, it is exceeded by less than 1e-4 of the piece's radius for angles up to 15
/// degrees (arcs are replaced by tangents); elsewhere by the hulls of eighths of the turn.
std::vector<ConvexPiece> swept_by_turn(const ConvexPiece& piece, double angle_rad);

/// The positions of the origin at which the piece touches the segment: the segment minus the piece.
ConvexPiece touching_positions(const ConvexPiece& piece, const Segment& wall);

/// The piece turned by angle `k` of n; quarter turns are exact, so bodies with that symmetry keep their corners' bits.
ConvexPiece turned(std::span<const Vec2> outline, std::uint32_t k, std::uint32_t n);

/// Where a convex body that doesn't turn would meet a convex obstacle, marked on a coarse grid of places: the rows of
/// the Minkowski sum of the obstacle and the mirrored body, whose sides are taken in the order of their directions as
/// they are merged. O(n + m + rows) for n and m corners, nothing is allocated. A guide, not a proof: doubles as they
/// come. Takes the bits of places away at which the body comes nearer to the obstacle than `reach` (>= 0), by the
/// larger of the distances in x and y, and maybe of a few more. Both run counter-clockwise, with one corner or more.
void take_blocked_places(std::span<const Vec2> obstacle, std::span<const Vec2> mirrored_body, double reach,
                         PlaceGrid& free);

}  // namespace warren
