// SPDX-License-Identifier: BSD-3-Clause
#include "tests/planners/visibility/plane_contest.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <exception>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "tests/planners/visibility/rational_plane.hpp"

namespace warren::test {
namespace {

/// The box of all obstacles; nothing where there are none.
std::optional<Box> confining_box(const PlaneObstacles& obstacles) {
  if (obstacles.bounds) return obstacles.bounds;
  Box box;
  for (const Vec2 p : obstacles.polygons.corners) box.include(p);
  for (const Segment& wall : obstacles.walls) {
    box.include(wall.a);
    box.include(wall.b);
  }
  return box.empty() ? std::nullopt : std::optional(box);
}

/// Without bounds nobody gets between the obstacles' box and a wall on its side: there stands a block instead, as deep
/// as the rest of the plane, which ends well outside of the box.
PlaneObstacles closed_behind_walls(const PlaneObstacles& obstacles) {
  PlaneObstacles closed = obstacles;
  const std::optional<Box> box = confining_box(obstacles);
  if (obstacles.bounds || !box || !(box->min.x < box->max.x) || !(box->min.y < box->max.y)) return closed;
  const Vec2 low = box->min;
  const Vec2 high = box->max;
  const double deep = 4.0 * std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
  closed.bounds = Box{{low.x - deep, low.y - deep}, {high.x + deep, high.y + deep}};
  const auto block = [&](Vec2 p, Vec2 q) { closed.polygons.add(std::array{p, Vec2{q.x, p.y}, q, Vec2{p.x, q.y}}); };
  for (const auto& [a, b] : obstacles.walls) {
    const auto [left, right] = std::minmax(a.x, b.x);
    const auto [bottom, top] = std::minmax(a.y, b.y);
    if (left == right && bottom < top && left == low.x) block({left - deep, bottom}, {left, top});
    if (left == right && bottom < top && left == high.x) block({left, bottom}, {left + deep, top});
    if (bottom == top && left < right && bottom == low.y) block({left, bottom - deep}, {right, bottom});
    if (bottom == top && left < right && bottom == high.y) block({left, bottom}, {right, bottom + deep});
  }
  return closed;
}

bool is_outside(const std::optional<Box>& box, Vec2 p) { return box && !box->contains(p); }

/// One planner on one problem.
struct Contestant {
  const char* name;
  bool is_shortest;  ///< by claim
  std::function<Solution<Vec2>(const PlaneProblem&)> plan;
};

std::vector<Contestant> contestants() {
  const auto visibility = [](const char* name, const VisibilityOptions& options) {
    return Contestant{name, true, [options](const PlaneProblem& p) {
                        return confined_visibility_path(p.obstacles, p.start, p.goal, options, {});
                      }};
  };
  const auto cells = [](const char* name, bool is_shortest, const CellOptions& options) {
    return Contestant{name, is_shortest, [options](const PlaneProblem& p) {
                        return plan_through_cells(p.obstacles, p.start, p.goal, options, {});
                      }};
  };
  using enum SearchKind;
  return {
      visibility("visibility", {}),
      visibility("visibility, full", {.edges = VisibilityEdges::full}),
      visibility("visibility, lazy", {.lazy = true}),
      visibility("visibility, dijkstra", {.search = dijkstra}),
      cells("cells, funnel, astar", true, {.doors = DoorKind::funnel, .search = astar}),
      cells("cells, funnel, dijkstra", true, {.doors = DoorKind::funnel, .search = dijkstra}),
      cells("cells, funnel, bfs", false, {.doors = DoorKind::funnel, .search = bfs}),
      cells("cells, midpoint", false, {.doors = DoorKind::midpoint}),
  };
}

std::string complaint_about(const Contestant& who, const PlaneProblem& problem, const Solution<Vec2>& plan,
                            const ExactAnswer& expected) {
  if (plan.outcome != expected.outcome) {
    return fmt::format("{}: {} instead of {}", who.name, name_of(plan.outcome), name_of(expected.outcome));
  }
  if (expected.outcome != Outcome::solved) return {};
  if (!(plan.path.front() == problem.start && plan.path.back() == problem.goal)) {
    return fmt::format("{}: the path does not join start and goal", who.name);
  }
  const Verification v = judged(problem.obstacles, plan.path);
  if (!v.verified) {
    return fmt::format("{}: the judge refuses leg {}, {}", who.name, v.first_violation->leg,
                       v.first_violation->obstacle);
  }
  const double length = length_of(plan.path);
  const bool too_short = length < expected.length * (1.0 - length_tolerance);
  const bool too_long = who.is_shortest && length > expected.length * (1.0 + length_tolerance);
  return too_short || too_long ? fmt::format("{}: length {} instead of {}", who.name, length, expected.length) : "";
}

std::string outcome_of(const Contestant& who, const PlaneProblem& problem, const ExactAnswer& expected,
                       ContestTally& tally) {
  try {
    return complaint_about(who, problem, who.plan(problem), expected);
  } catch (const ObstacleClash&) {
    ++tally.refused;
    return expected.has_overlaps ? "" : fmt::format("{}: refuses a world without overlaps", who.name);
  } catch (const std::exception& error) {
    return fmt::format("{}: {}", who.name, error.what());
  }
}

/// The obstacles without one polygon's corner; nothing where the rest is no polygon.
std::optional<PlaneObstacles> without_corner(const PlaneObstacles& obstacles, std::size_t corner) {
  Scene scene = scene_of(obstacles);
  for (ScenePolygon& polygon : scene.polygons) {
    if (corner < polygon.corners.size()) {
      polygon.corners.erase(polygon.corners.begin() + static_cast<std::ptrdiff_t>(corner));
      break;
    }
    corner -= polygon.corners.size();
  }
  try {
    return plane_obstacles(scene, {});
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The obstacles without one thing each: bounds, a wall, a polygon, a corner of a polygon.
std::vector<PlaneObstacles> with_less(const PlaneObstacles& obstacles) {
  std::vector<PlaneObstacles> result;
  for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
    PlaneObstacles less{{}, obstacles.walls, obstacles.bounds};
    for (std::size_t q = 0; q < obstacles.polygons.size(); ++q) {
      if (q != p) less.polygons.add(obstacles.polygons[q]);
    }
    result.push_back(less);
  }
  for (std::size_t w = 0; w < obstacles.walls.size(); ++w) {
    result.push_back(obstacles);
    result.back().walls.erase(result.back().walls.begin() + static_cast<std::ptrdiff_t>(w));
  }
  if (obstacles.bounds) {
    result.push_back(obstacles);
    result.back().bounds.reset();
  }
  for (std::size_t c = 0; c < obstacles.polygons.corners.size(); ++c) {
    if (const auto less = without_corner(obstacles, c)) result.push_back(*less);
  }
  return result;
}

}  // namespace

ExactAnswer answer_by_definition(const PlaneProblem& problem) {
  const auto& [obstacles, start, goal] = problem;
  const std::optional<Box> box = confining_box(obstacles);
  const PlaneObstacles closed = closed_behind_walls(obstacles);
  const rational::Plane plane(closed, {start, goal});
  ExactAnswer answer;
  answer.has_overlaps = rational::Plane(obstacles).has_overlaps();
  const std::optional<Box>& bounds = obstacles.bounds;
  const auto reaches_out = [&](Vec2 p) { return bounds && !bounds->contains(p); };
  for (const Vec2 p : obstacles.polygons.corners) answer.has_overlaps = answer.has_overlaps || reaches_out(p);
  for (const Segment& wall : obstacles.walls) {
    answer.has_overlaps = answer.has_overlaps || reaches_out(wall.a) || reaches_out(wall.b);
  }
  if (is_outside(box, start) || plane.is_blocked(start)) {
    answer.outcome = Outcome::start_blocked;
  } else if (is_outside(box, goal) || plane.is_blocked(goal)) {
    answer.outcome = Outcome::goal_blocked;
  } else {
    answer.length = start == goal ? 0.0 : rational::Plane::shortest(plane.edges(), start, goal);
    answer.outcome = std::isinf(answer.length) ? Outcome::not_connected : Outcome::solved;
  }
  return answer;
}

std::string disagreement(const PlaneProblem& problem, ContestTally& tally) {
  static const std::vector<Contestant> all = contestants();
  const ExactAnswer expected = answer_by_definition(problem);
  const double straight = distance(problem.start, problem.goal);
  tally.solved += expected.outcome == Outcome::solved ? 1 : 0;
  tally.bent += expected.outcome == Outcome::solved && expected.length > straight * (1.0 + length_tolerance) ? 1 : 0;
  tally.apart += expected.outcome == Outcome::not_connected ? 1 : 0;
  tally.blocked += expected.outcome == Outcome::start_blocked || expected.outcome == Outcome::goal_blocked ? 1 : 0;
  ContestTally refusals;
  for (const Contestant& who : all) {
    std::string complaint = outcome_of(who, problem, expected, refusals);
    if (!complaint.empty()) return complaint;
  }
  tally.refused += refusals.refused > 0 ? 1 : 0;
  return {};
}

PlaneProblem smallest_disagreement(PlaneProblem problem) {
  ContestTally unused;
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (const PlaneObstacles& less : with_less(problem.obstacles)) {
      const PlaneProblem candidate{less, problem.start, problem.goal};
      if (disagreement(candidate, unused).empty()) continue;
      problem = candidate;
      smaller = true;
      break;
    }
  }
  return problem;
}

std::string scene_text(const PlaneProblem& problem) {
  std::string text;
  const auto add = [&](const char* item, std::span<const Vec2> points) {
    text += item;
    for (const Vec2 p : points) fmt::format_to(std::back_inserter(text), " {} {}", p.x, p.y);
    text += '\n';
  };
  const PlaneObstacles& obstacles = problem.obstacles;
  for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) add("polygon", obstacles.polygons[p]);
  for (const Segment& wall : obstacles.walls) add("wall", std::array{wall.a, wall.b});
  if (obstacles.bounds) add("bounds", std::array{obstacles.bounds->min, obstacles.bounds->max});
  add("start", std::array{problem.start});
  add("goal", std::array{problem.goal});
  return text;
}

}  // namespace warren::test
