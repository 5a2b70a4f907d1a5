// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/se2_world.hpp"

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "worlds/poses/pose_in_bounds.hpp"
#include "worlds/rasters/convex_pieces.hpp"

namespace warren {
namespace {

double radius_of(std::span<const Vec2> outline, const Execution& execution) {
  check_body(outline, "robot", execution);
  double radius = 0.0;
  for (const Vec2 p : outline) radius = std::max(radius, norm(p));
  return radius;
}

double positive(const char* name, double value) {
  if (value > 0.0 && value <= largest_coordinate) return value;
  throw InputError(name, "must be a number above 0, up to 1e60", std::to_string(value));
}

}  // namespace

Se2World::Se2World(const Scene& scene, std::span<const Vec2> outline, const Se2Options& options,
                   const Execution& execution)
    : outline_(outline.begin(), outline.end()),
      radius_(positive("robot: radius", radius_of(outline, execution))),
      angle_weight_(positive("angle weight", options.angle_weight.value_or(radius_))),
      resolution_(positive("resolution", options.resolution.value_or(1e-4 * radius_))),
      planning_clearance_(checked_clearance(options.clearance) * (1.0 + 1e-9)),
      tree_(scene, radius_ + planning_clearance_, execution) {
  box_ = scene.bounds ? *scene.bounds : tree_.obstacle_box();
  if (box_.empty()) throw InputError("world", "has neither obstacles nor bounds: nothing confines the robot");
  if (!scene.map) return;
  map_ = *scene.map;
  const DistanceField field(map_->blocked, CellDistance::squares, true, execution);
  corridors_.emplace(*map_, field, planning_clearance_ / map_->cell, execution);
}

Se2 Se2World::at_unit(const std::array<double, 3>& u) const {
  return confined_pose(box_, tree_.bounds().has_value(), outline_, planning_clearance_, u);
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

PlaceGrid Se2World::free_places(const State& a) const {
  constexpr std::size_t most_pieces = 256;
  if (tree_.piece_count() > most_pieces) return {};
  const Rotation turned(a.theta);
  std::vector<Vec2> mirrored;
  mirrored.reserve(outline_.size());
  Box body;
  for (const Vec2 p : outline_) {
    const Vec2 arm = turned(p);
    body.include(arm);
    mirrored.push_back(Vec2{} - arm);
  }
  Box places = box_;
  if (tree_.bounds()) {
    const Box wide = body.grown(planning_clearance_);
    places = {box_.min - wide.min, box_.max - wide.max};
  }
  if (places.empty()) return {};
  PlaceGrid free = PlaceGrid::over(places);
  tree_.take_blocked_places(convex_hull(std::move(mirrored)), planning_clearance_, free);
  return free;
}

/// Is the body where it may be, if it touches no obstacle?
bool Se2World::is_confined(const State& a) const {
  if (!map_) return tree_.bounds() || box_.contains(a.position());
  const std::optional<Cell> cell = cell_at(*map_, placed(a, outline_.front()));
  return cell && !map_->blocked.test(cell->x, cell->y);
}

bool Se2World::is_free(const State& a, Query& query) const { return is_confined(a) && clearance(a, 0.0, query) > 0.0; }

MotionVerdict Se2World::judge_motion(const State& a, const State& b, Query& query) const {
  const Vec2 way = b.position() - a.position();
  const double turn = turn_between(a.theta, b.theta);
  const double whole = norm(way) + radius_ * std::abs(turn);
  Footprint& body = query.footprint;
  for (std::size_t i = 0; i < outline_.size(); ++i) body.bends()[i] = 0.5 * turn * turn * norm(outline_[i]);
  const auto look = [&](double middle, double half, std::uint32_t& parts) {
    const Vec2 position = a.position() + middle * way;
    const Rotation turned(a.theta + middle * turn);
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const Vec2 arm = turned(outline_[i]);
      body.corners()[i] = position + arm;
      body.velocities()[i] = way + turn * Vec2{-arm.y, arm.x};
    }
    body.finish();
    const Room room = tree_.room(body, {half, half * whole}, planning_clearance_);
    if (room == Room::clear) parts = 0;
    return room == Room::blocked ? -1.0 : 0.0;
  };
  return certified_parts(1, look, whole > 0.0 ? resolution_ / whole : 1.0);
}

bool Se2World::is_free_motion(const State& a, const State& b, Query& query) const {
  const MotionVerdict verdict = judge_motion(a, b, query);
  if (verdict == MotionVerdict::refused) ++query.refused;
  return verdict == MotionVerdict::free;
}

}  // namespace warren
