// SPDX-License-Identifier: BSD-3-Clause
// All planners that claim the shortest path of a point among polygons and walls, on one problem, against each other and
// against brute force over rationals, which shares no predicate with any of them; and the judge on each of their paths.
#pragma once

#include <string>

#include "core/base/solution.hpp"
#include "tests/planners/visibility/strange_worlds.hpp"

namespace warren::test {

/// Lengths that differ by less, relative to themselves, are equal: a path of 100 legs is rounded by no more, and the
/// search through cells takes ways to a corner as equally long that differ by 1e-12 of their length.
inline constexpr double length_tolerance = 1e-11;

/// The answer by definition.
struct ExactAnswer {
  Outcome outcome = Outcome::not_connected;
  double length = 0.0;        ///< of the shortest path, if solved
  bool has_overlaps = false;  ///< cells may refuse the world
};
ExactAnswer answer_by_definition(const PlaneProblem& problem);

/// What was met on the way.
struct ContestTally {
  int solved = 0;
  int bent = 0;  ///< of these: not by the straight way
  int apart = 0;
  int blocked = 0;
  int refused = 0;  ///< by cells: polygons overlap, or obstacles cross
};

/// Who is wrong, and how; empty where all agree.
std::string disagreement(const PlaneProblem& problem, ContestTally& tally);

/// The problem without what can be left out of it while they still disagree.
PlaneProblem smallest_disagreement(PlaneProblem problem);

/// As a world file, which reads back bit for bit.
std::string scene_text(const PlaneProblem& problem);

}  // namespace warren::test
