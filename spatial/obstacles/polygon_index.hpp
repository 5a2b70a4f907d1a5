// SPDX-License-Identifier: BSD-3-Clause
// Where a point lies among polygons: inside which, on whose outline. A tree over the polygons' boxes finds those that
// come into question; within one, a ray to the right is followed down boxes over 8, 64, 512, ... sides in a row: a run
// of sides that lies wholly right of the point crosses the ray as often as its two ends say, so only runs around the
// point are opened. Exact (core/plane/geometry). O(log n) for polygons and outlines that do not crowd around the point.
// Memory: 60 bytes a polygon, 25 a corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "spatial/obstacles/box_tree.hpp"

namespace warren {

enum class PolygonSide : std::uint8_t { outside, on_outline, inside };

/// Immutable after construction; any number of threads may ask.
class PolygonIndex {
 public:
  PolygonIndex() = default;
  /// Simple polygons, anticlockwise or not. Throws Stopped.
  PolygonIndex(PolygonSet polygons, const Execution& execution);

  const PolygonSet& polygons() const { return polygons_; }
  /// The box of all corners; empty if there are none.
  const Box& box() const { return box_; }

  /// Where p lies with regard to one polygon.
  PolygonSide side_of(std::size_t polygon, Vec2 p) const noexcept;
  /// A polygon whose open inside holds p; none if there is none. Always the same one for the same polygons.
  std::optional<std::uint32_t> polygon_around(Vec2 p) const noexcept;

  /// Side i begins in corner i.
  Segment side(std::size_t i) const noexcept { return {polygons_.corners[i], polygons_.corners[next_[i]]}; }
  /// Calls visit(polygon) -> bool for each whose box meets `box` (and perhaps some others), in an order that depends on
  /// the polygons alone, until it returns false.
  template <class Visit>
  void for_each_polygon_near(const Box& box, const Visit& visit) const {
    tree_.search({{box.min.x, box.min.y}, {box.max.x, box.max.y}}, 0.0,
                 [&](std::uint32_t place) { return visit(tree_.order()[place]) ? 0.0 : -1.0; });
  }
  /// Calls visit(side) -> bool for each side of a polygon whose box meets `box`, in order, until it returns false.
  template <class Visit>
  bool for_each_side_near(std::size_t polygon, const Box& box, const Visit& visit) const {
    const Range run = sides_of(polygon);
    const std::size_t level = level_of(run);
    const std::size_t shift = fan_bits * level;
    for (std::size_t block = run.first >> shift; block <= (run.last - 1) >> shift; ++block) {
      if (!visit_block(level, block, run, box, visit)) return false;
    }
    return true;
  }

 private:
  struct Crossings;

  Range sides_of(std::size_t polygon) const noexcept {
    return {polygons_.first[polygon], polygons_.first[polygon + 1]};
  }
  /// The lowest level on which a run touches few blocks.
  static std::size_t level_of(Range run) noexcept;
  void count(std::size_t level, std::size_t block, Range run, Crossings& crossings) const noexcept;
  /// Level 0: a side; level k: block of 8^k sides.
  template <class Visit>
  bool visit_block(std::size_t level, std::size_t block, Range run, const Box& box, const Visit& visit) const {
    if (level == 0) return !box_of(side(block)).meets(box) || visit(block);
    if (!levels_[level - 1][block].meets(box)) return true;
    const std::size_t shift = fan_bits * (level - 1);
    const std::size_t first = std::max(run.first >> shift, block << fan_bits);
    const std::size_t last = std::min((run.last - 1) >> shift, (block << fan_bits) + (std::size_t{1} << fan_bits) - 1);
    for (std::size_t part = first; part <= last; ++part) {
      if (!visit_block(level - 1, part, run, box, visit)) return false;
    }
    return true;
  }

  static constexpr std::size_t fan_bits = 3;

  PolygonSet polygons_;
  std::vector<std::uint32_t> next_;       ///< the corner after each in its polygon
  std::vector<std::vector<Box>> levels_;  ///< [k]: boxes over 8^(k + 1) sides in a row, across polygons
  BoxTree<2> tree_;                       ///< over the polygons' boxes
  Box box_;
};

}  // namespace warren
