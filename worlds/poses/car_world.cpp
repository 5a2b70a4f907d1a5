// SPDX-License-Identifier: BSD-3-Clause
// The motion check (CarBody), which the header's head explains, and what a car pays (PricedCar).
#include "worlds/poses/car_world.hpp"

#include <algorithm>
#include <cmath>

#include "core/plane/polygon.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

/// What planning keeps: beyond what it must a factor, and what the poses of a curve are rounded by. Throws InputError
/// for what is out of range.
double checked_reach(const CarOptions& options, const Execution& execution) {
  constexpr double more = 1e-9;
  if (!options.outline.empty()) check_body(options.outline, "robot", execution);
  checked_length("robot: turning radius", options.turning_radius, false);
  const double asked = checked_clearance(options.clearance) +
                       (options.outline.empty() ? checked_length("robot: radius", options.radius, true) : 0.0);
  return asked * (1.0 + more) + more * options.turning_radius;
}

double resolution_of(const CarOptions& options) {
  constexpr double share = 1e-4;
  const double size = options.outline.empty() ? options.radius : outline_reach(options.outline);
  return share * (size > 0.0 ? size : options.turning_radius);
}

constexpr double as_good = 1e-9;  // in turning radii: what is shorter by less is as long

}  // namespace

CarBody::CarBody(const Scene& scene, const CarOptions& options, const Execution& execution)
    : BodyAmongObstacles(scene, options.outline.empty() ? std::vector{Vec2{}} : options.outline,
                         checked_reach(options, execution), options.turning_radius, "car", execution),
      turning_radius_(options.turning_radius),
      resolution_(resolution_of(options)) {}

bool CarBody::confines(const Box& way) const {
  constexpr double rounding = 1e-11;
  if (obstacles().bounds() || map()) return true;  // they are obstacles like others, as is a map's rim
  const Box room = box().grown(rounding * (turning_radius_ + box().width() + box().height()));
  return room.contains(way.min) && room.contains(way.max);
}

MotionVerdict CarBody::judge(const SteeringCurve& curve, Query& query) const {
  if (!confines(curve.box())) return MotionVerdict::blocked;
  const CurveTravel travelled(curve, outline());
  const double length = curve.length();
  return certified_motion([&](double t, double enough) { return clearance(curve.at(t * length), enough, query); },
                          [&](double t, double u) { return travelled(u * length) - travelled(t * length); },
                          resolution_);
}

/// Pieces of no length have no gear, as SteeringCurve leaves them out; nor have those that only make up for `off`, by
/// which rounding moves the ends: far from the origin they were changes of gear that nobody drives.
PricedCar::Recipe PricedCar::priced(const SteeringWord& word, double off) const {
  Recipe recipe{word};
  for (const SteeringPiece& piece : word.used()) {
    if (std::abs(piece.length) < std::max(SteeringCurve::nothing, off)) continue;
    const std::int8_t gear = piece.length < 0.0 ? -1 : 1;
    if (recipe.first_gear == 0) recipe.first_gear = gear;
    if (recipe.last_gear == -gear) recipe.price += price_.cusp;
    recipe.last_gear = gear;
    recipe.price += (gear < 0 ? price_.reverse : 1.0) * car_->turning_radius() * std::abs(piece.length);
  }
  return recipe;
}

PricedCar::Recipe PricedCar::shortest(const State& a, const State& b) const {
  const double radius = car_->turning_radius();
  return priced(ReedsSheppCurve::shortest(a, b, radius), off_by_rounding(a, b, radius));
}

std::vector<PricedCurve> PricedCar::ways(const State& a, const State& b, double most) const {
  const double radius = car_->turning_radius();
  const Se2 goal = seen_from(a, b, radius);
  const double off = off_by_rounding(a, b, radius);
  std::array<Recipe, 4> best;
  for (Recipe& recipe : best) recipe.price = most;
  ReedsSheppCurve::for_each_word(a, b, radius, most / radius, [&](const SteeringWord& word) {
    const Recipe recipe = priced(word, off);
    Recipe& same = best[(recipe.first_gear > 0 ? 2U : 0U) + (recipe.last_gear > 0 ? 1U : 0U)];
    const double shorter = same.price - radius * (as_good + 8.0 * off);
    const bool is_better = recipe.price < (same.first_gear == 0 ? most : shorter);
    if (recipe.first_gear != 0 && is_better && ends_at(word, goal, off)) same = recipe;
  });
  std::vector<PricedCurve> ways;
  for (const Recipe& recipe : best) {
    if (recipe.first_gear == 0) continue;
    ways.push_back({{a, b, recipe.word, radius}, recipe.price, recipe.first_gear, recipe.last_gear});
  }
  return ways;
}

Se2 PricedCar::drawn_near(const State& a, const std::array<double, 4>& u, double scale) const {
  constexpr double share_driven = 0.6;
  constexpr double least = 0.02;    // in turning radii
  constexpr double shifted = 0.15;  // to each side, in turning radii
  constexpr double turned_rad = 0.25;
  const double radius = car_->turning_radius();
  if (u[0] < share_driven) {
    const auto steer = static_cast<Steer>(bounded_whole<int>(3.0 * u[1]) - 1);
    const double length = (u[2] < 0.5 ? -1.0 : 1.0) * (least + scale * u[3] * u[3]);
    const Se2 to = after_piece({a.x / radius, a.y / radius, a.theta}, {steer, length});
    return {radius * to.x, radius * to.y, wrapped_angle(to.theta)};
  }
  const auto slip = [&](std::size_t i, double size) { return scale * size * (2.0 * u[i] - 1.0); };
  return {a.x + slip(1, shifted * radius), a.y + slip(2, shifted * radius),
          wrapped_angle(a.theta + slip(3, turned_rad))};
}

/// Without joints that rounding alone parts from those before.
void PricedCar::append(Path<State>& path, const Way& way) {
  std::vector<Se2> joints;
  append_joints(joints, way.curve);
  if (joints.empty()) return;
  const double radius = way.curve.turning_radius();
  const double apart = radius * (as_good + 8.0 * off_by_rounding(path.back(), joints.back(), radius));
  const auto is_near = [&](const Se2& a, const Se2& b) { return norm(a.position() - b.position()) <= apart; };
  const std::size_t before = path.size();
  for (const Se2& joint : joints) {
    if (!is_near(path.back(), joint)) path.push_back(joint);
  }
  if (path.size() > before) path.pop_back();
  path.push_back(joints.back());
}

double PricedCar::price(std::span<const State> path, int gear_before, int gear_after) const {
  double sum = 0.0;
  int gear = gear_before;
  const auto change_to = [&](int next) {
    if (gear != 0 && next != 0 && gear != next) sum += price_.cusp;
    if (next != 0) gear = next;
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Recipe way = shortest(path[i - 1], path[i]);
    change_to(way.first_gear);
    if (way.last_gear != 0) gear = way.last_gear;
    sum += way.price;
  }
  change_to(gear_after);
  return sum;
}

}  // namespace warren
