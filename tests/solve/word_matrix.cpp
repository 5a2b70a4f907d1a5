// SPDX-License-Identifier: BSD-3-Clause
#include "tests/solve/word_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "solve/question/question_of_arm.hpp"

namespace warren::test {

std::vector<double> state_at(const RobotSpec& robot, Vec2 place) {
  if (!is_arm(robot)) return {place.x, place.y};
  return {0.2 * (place.x - 5.0), 0.1 * (place.y - 5.0), 0.0, 0.0, 0.0, 0.0};
}

namespace {

bool meets(const Answer& answer, Box box) {
  for (std::size_t i = 1; i < answer.path.size(); ++i) {
    for (int n = 0; n <= 1000; ++n) {
      const Vec2 p = answer.path[i - 1] + 0.001 * n * (answer.path[i] - answer.path[i - 1]);
      if (p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y) return true;
    }
  }
  return false;
}

/// An arm stops at what it has to pass.
bool stops(const StateList& states, std::span<const double> at) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (std::ranges::equal(states[i], at)) return true;
  }
  return false;
}

bool passes(const Answer& answer, Vec2 place) {
  if (is_arm(answer.problem.robot)) return stops(answer.states, state_at(answer.problem.robot, place));
  double nearest = distance(answer.path.front(), place);
  for (std::size_t i = 1; i < answer.path.size(); ++i) {
    const Vec2 along = answer.path[i] - answer.path[i - 1];
    const double square = dot(along, along);
    const double share = square > 0.0 ? std::clamp(dot(place - answer.path[i - 1], along) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, distance(answer.path[i - 1] + share * along, place));
  }
  return nearest < 1e-9;
}

constexpr Box lower{{4.0, 0.0}, {6.0, 4.0}};  // below the block in the middle, where the shortest way leads
constexpr Vec2 stop{5.0, 9.0};
constexpr Vec2 other_stop{2.0, 8.0};
constexpr Vec2 beside_all{9.3, 0.4};  // in a corner where no way leads

std::vector<Vec2> corners(Box b) { return {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}}; }

PriceMask mask(MaskKind kind, std::int8_t value) {
  MaskCells cells{.width = 1, .height = 1, .values = {value}, .cell = 3.0, .origin = {3.5, 0.0}};
  PriceMask made{.kind = kind, .file = "mask.yaml"};
  made.read = std::move(cells);
  return made;
}

/// Where it began.
bool is_back(const Answer& answer) {
  const StateList& states = answer.states;
  if (is_arm(answer.problem.robot)) return std::ranges::equal(states[0], states[states.size() - 1]);
  return answer.path.front() == answer.path.back();
}

bool is_priced(const Answer& answer) { return answer.price && answer.cost; }

/// A block in the middle of a room, nearer to the upper wall.
Scene map_room() {
  Scene scene;
  scene.source = "room";
  OccupancyMap map;
  map.blocked = Bitmap(20, 20);
  map.cell = 0.5;
  map.unknown = Bitmap(20, 20);
  for (std::uint32_t y = 8; y < 13; ++y) map.blocked.set_run(y, 8, 12);
  map.blocked.set(1, 18);
  map.unknown.set(1, 18);
  map.unknown_count = 1;
  map.occupied = map.blocked.count() - 1;
  map.free = map.blocked.size() - map.blocked.count();
  scene.map = std::move(map);
  return scene;
}

Scene polygon_room() {
  Scene scene;
  scene.source = "room";
  scene.bounds = Box{{0.0, 0.0}, {10.0, 10.0}};
  scene.grid = GridSpec{.cell = 0.1};
  scene.polygons.push_back({corners({{4.0, 4.0}, {6.0, 6.5}}), 0});
  return scene;
}

/// A sphere where the wrist of a Puma is that stands over its joints' zeros.
Scene sphere_room() {
  Scene scene;
  scene.source = "room";
  scene.spheres.push_back({0.4521, -0.15005, 0.4318, 0.06});
  return scene;
}

void add_prices(std::vector<AskedRow>& rows) {
  const auto add = [&](std::string name, auto ask) {
    rows.push_back({std::move(name), ask, is_priced, false, [](Answer& a) { *a.cost *= 0.999; }});
  };
  add("clearance_price", [](Question& q, SolveOptions&) { q.prices.clearance = ClearancePrice{2.0, 1.0}; });
  add("area", [](Question& q, SolveOptions&) { q.prices.areas.push_back({3.0, corners(lower), 0}); });
  add("areas", [](Question& q, SolveOptions&) {
    q.prices.masks.push_back(mask(MaskKind::areas, 50));
    q.prices.masks.back().factor = 5.0;
  });
  add("speed_zones", [](Question& q, SolveOptions&) { q.prices.masks.push_back(mask(MaskKind::speed, 60)); });
  add("keep_out", [](Question& q, SolveOptions&) {
    q.prices.masks.push_back(mask(MaskKind::keep_out, 100));
    q.prices.masks.back().factor = 4.0;
  });
  add("unknown", [](Question& q, SolveOptions&) { q.prices.unknown = 2.0; });
  rows.push_back({"keep_out",
                  [](Question& q, SolveOptions&) {
                    q.prices.keep_out.push_back({corners(lower), 0});
                  },
                  [](const Answer& a) { return !meets(a, lower); }});
  rows.push_back({"unknown", [](Question& q, SolveOptions&) { q.prices.unknown = 1.0; },
                  [](const Answer& a) { return a.problem.prices.unknown == 1.0; }});
}

void add_choices(std::vector<AskedRow>& rows) {
  const auto add = [&](std::string name, auto ask, auto is_heard) { rows.push_back({std::move(name), ask, is_heard}); };
  add(
      "goal", [](Question& q, SolveOptions&) { q.rule.others.push_back(state_at(*q.robot, stop)); },
      [](const Answer& a) { return a.goal_index.has_value(); });
  add(
      "goal_tolerance",
      [](Question& q, SolveOptions&) {
        q.goal = state_at(*q.robot, {4.6, 5.0});  // in the block
        q.rule.tolerance = 2.0;
      },
      [](const Answer& a) { return a.goal_reached && a.goal_reached->distance <= 2.0; });
  add(
      "goal_region", [](Question& q, SolveOptions&) { q.rule.region = 1.0; },
      [](const Answer& a) { return a.goal_reached && a.goal_reached->distance <= 1.0; });
  add(
      "visit",
      [](Question& q, SolveOptions&) {
        q.rule.visit = {state_at(*q.robot, stop), state_at(*q.robot, other_stop)};
      },
      [](const Answer& a) { return a.order.size() == 2 && passes(a, stop) && passes(a, other_stop); });
  rows.back().by_all = true;
  rows.back().spoil = [](Answer& a) { a.problem.rule.visit[1] = state_at(a.problem.robot, beside_all); };
  add(
      "return",
      [](Question& q, SolveOptions&) {
        q.goal.clear();
        q.rule.visit = {state_at(*q.robot, stop)};
        q.rule.back = true;
      },
      [](const Answer& a) { return passes(a, stop) && is_back(a); });
  rows.back().by_all = true;
  rows.back().with = "visit";
  rows.back().spoil = [](Answer& a) { a.problem.rule.visit[0] = state_at(a.problem.robot, beside_all); };
  add(
      "via", [](Question& q, SolveOptions& o) { o.trees.via = {state_at(*q.robot, stop)}; },
      [](const Answer& a) { return passes(a, stop); });
  rows.back().by_all = true;
  rows.back().spoil = [](Answer& a) { a.problem.via[0] = state_at(a.problem.robot, beside_all); };
  add(
      "alternatives", [](Question& q, SolveOptions&) { q.route.alternatives = 2; },
      [](const Answer& a) { return !a.alternatives.empty(); });
  add(
      "keep_to",
      [](Question& q, SolveOptions&) {
        q.route.keep_to = {q.start, state_at(*q.robot, {5.0, 3.0}), q.goal};
      },
      [](const Answer& a) { return a.keeping.has_value(); });
  add(
      "gap", [](Question&, SolveOptions& o) { o.anytime.gap = 0.5; },
      [](const Answer& a) { return a.lower_bound && gap_of(a) && *gap_of(a) <= 0.5; });
}

}  // namespace

std::vector<AskedRow> asked_rows() {
  const auto nothing = [](Question&, SolveOptions&) {};
  std::vector<AskedRow> rows{{"", nothing, [](const Answer&) { return true; }}};
  add_prices(rows);
  add_choices(rows);
  return rows;
}

std::vector<AskedBody> asked_bodies() {
  const RobotSpec point{};
  const RobotSpec disc{.kind = RobotKind::disc, .radius = 0.3};
  const RobotSpec polygon{.kind = RobotKind::polygon, .outline = corners({{-0.3, -0.2}, {0.3, 0.2}})};
  const RobotSpec car{.kind = RobotKind::car, .radius = 0.25, .turning_radius = 0.8};
  const RobotSpec drive{
      .kind = RobotKind::car, .radius = 0.25, .turning_radius = 0.8, .steering = SteeringKind::differential};
  return {{"point on a map", map_room(), point},
          {"disc on a map", map_room(), disc},
          {"point among polygons", polygon_room(), point},
          {"disc among polygons", polygon_room(), disc},
          {"polygon on a map", map_room(), polygon},
          {"polygon among polygons", polygon_room(), polygon},
          {"car on a map", map_room(), car},
          {"car among polygons", polygon_room(), car},
          {"differential drive on a map", map_room(), drive},
          {"differential drive among polygons", polygon_room(), drive},
          {"arm at a sphere", sphere_room(), {.kind = RobotKind::puma560, .radius = 0.04}}};
}

}  // namespace warren::test
