// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/se2_world.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace warren {
namespace {

double radius_of(std::span<const Vec2> outline) {
  if (outline.size() < 3) throw InputError("robot", "a polygon needs three corners or more");
  double radius = 0.0;
  for (const Vec2 p : outline) radius = std::max(radius, norm(p));
  return radius;
}

double positive(const char* name, double value) {
  if (value > 0.0 && value <= largest_coordinate) return value;
  throw InputError(name, "must be a number above 0, up to 1e60", std::to_string(value));
}

double checked_clearance(double clearance) {
  if (clearance >= 0.0 && clearance <= largest_coordinate) return clearance;
  throw InputError("clearance", "must be a number from 0 to 1e60", std::to_string(clearance));
}

double at_share(double low, double high, double share) {
  return high > low ? low + share * (high - low) : 0.5 * (low + high);
}

}  // namespace

Se2World::Se2World(const Scene& scene, std::span<const Vec2> outline, const Se2Options& options,
                   const Execution& execution)
    : outline_(outline.begin(), outline.end()),
      radius_(positive("robot: radius", radius_of(outline))),
      angle_weight_(positive("angle weight", options.angle_weight.value_or(radius_))),
      resolution_(positive("resolution", options.resolution.value_or(1e-4 * radius_))),
      planning_clearance_(checked_clearance(options.clearance) * (1.0 + 1e-9)),
      tree_(scene, radius_ + planning_clearance_) {
  box_ = scene.bounds ? *scene.bounds : tree_.obstacle_box();
  if (box_.empty()) throw InputError("world", "has neither obstacles nor bounds: nothing confines the robot");
  if (!scene.map) return;
  map_ = *scene.map;
  const DistanceField field(map_->blocked, CellDistance::squares, true, execution);
  corridors_.emplace(*map_, field, planning_clearance_ / map_->cell, execution);
}

Se2 Se2World::at_unit(const std::array<double, 3>& u) const {
  const double theta = wrapped_angle((2.0 * u[2] - 1.0) * std::numbers::pi);
  Box confines = box_;
  if (tree_.bounds()) {
    const Rotation turned(theta);
    Box body;
    for (const Vec2 p : outline_) body.include(turned(p));
    const Box wide = body.grown(planning_clearance_);
    confines = {confines.min - wide.min, confines.max - wide.max};
  }
  return {at_share(confines.min.x, confines.max.x, u[0]), at_share(confines.min.y, confines.max.y, u[1]), theta};
}

double Se2World::clearance(const State& a, double enough, Query& query) const {
  const Rotation turned(a.theta);
  const std::span<Vec2> corners = query.footprint.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = a.position() + turned(outline_[i]);
  query.footprint.finish();
  return tree_.clearance(query.footprint, enough + planning_clearance_) - planning_clearance_;
}

Se2 Se2World::corridor_state(std::uint64_t seed, std::uint64_t index) const {
  Se2 state = uniform_state(*this, seed, index);
  if (!corridors_ || corridors_->empty()) return state;
  const Vec2 p = corridors_->at(seed, index);
  return {p.x, p.y, state.theta};
}

/// Is the body where it may be, if it touches no obstacle?
bool Se2World::is_confined(const State& a) const {
  if (!map_) return tree_.bounds() || box_.contains(a.position());
  const std::optional<Cell> cell = cell_at(*map_, placed(a, outline_.front()));
  return cell && !map_->blocked.test(cell->x, cell->y);
}

bool Se2World::is_free(const State& a, Query& query) const { return is_confined(a) && clearance(a, 0.0, query) > 0.0; }

MotionVerdict Se2World::judge_motion(const State& a, const State& b, Query& query) const {
  const double whole = travel(a, b);
  return certified_motion([&](double t, double enough) { return clearance(interpolate(a, b, t), enough, query); },
                          [whole](double t, double u) { return (u - t) * whole; }, resolution_);
}

bool Se2World::is_free_motion(const State& a, const State& b, Query& query) const {
  const MotionVerdict verdict = judge_motion(a, b, query);
  if (verdict == MotionVerdict::refused) ++query.refused;
  return verdict == MotionVerdict::free;
}

}  // namespace warren
