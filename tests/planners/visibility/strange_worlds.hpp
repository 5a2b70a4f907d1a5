// SPDX-License-Identifier: BSD-3-Clause
// Small worlds of polygons and walls as a stranger would make them to break a planner: shared ends, sides and corners,
// collinear overlaps, crossings, walls of no length, doubles, polygons within polygons, corners an ulp off a line, and
// coordinates from 1e-12 to 1e12 in one world or each world at its own scale. Start and goal stand on corners, sides,
// walls, the box, lines through corners and anywhere, and sometimes in one place.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/plane/polygon.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"

namespace warren::test {

struct PlaneProblem {
  PlaneObstacles obstacles;
  Vec2 start, goal;
};

/// A problem from a seed. Polygons are simple and anticlockwise; they may overlap.
class StrangeWorlds {
 public:
  explicit StrangeWorlds(std::uint64_t seed);
  PlaneProblem make();

 private:
  /// How single coordinates come about.
  enum class Numbers : std::uint8_t { grid, reals, pool, powers };

  void choose_numbers();
  double value_of_pool();
  double coordinate();
  Vec2 fresh_point();
  Vec2 known_corner();
  Vec2 on_known_side();
  Vec2 beyond_known_side();
  Vec2 nearly(Vec2 p);
  Vec2 place();
  Segment known_side();
  std::vector<Vec2> rectangle();
  std::vector<Vec2> on_a_side();
  std::vector<Vec2> within_a_corner();
  std::vector<Vec2> around_a_point();
  std::vector<Vec2> bracket_around();
  std::vector<Vec2> outline();
  bool overlaps(const std::vector<Vec2>& ring) const;
  bool add_polygon();
  bool add_wall();
  void add_bounds();
  Vec2 end_of_path();

  Dice dice_;
  Numbers numbers_ = Numbers::grid;
  bool may_overlap_ = false;
  double scale_ = 1.0;
  Vec2 offset_;
  std::vector<double> pool_;
  std::vector<Segment> sides_;  // of all that stands, walls too
  PlaneProblem made_;
};

}  // namespace warren::test
