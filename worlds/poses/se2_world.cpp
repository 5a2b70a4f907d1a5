// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/se2_world.hpp"

#include <algorithm>

#include "scenes/scene/plane_obstacles.hpp"
#include "worlds/rasters/convex_pieces.hpp"

namespace warren {
namespace {

double radius_of(std::span<const Vec2> outline, const Execution& execution) {
  check_body(outline, "robot", execution);
  return checked_length("robot: radius", outline_reach(outline), false);
}

}  // namespace

Se2World::Se2World(const Scene& scene, std::span<const Vec2> outline, const Se2Options& options,
                   const Execution& execution)
    : radius_(radius_of(outline, execution)),
      angle_weight_(checked_length("angle weight", options.angle_weight.value_or(radius_), false)),
      resolution_(checked_length("resolution", options.resolution.value_or(1e-4 * radius_), false)),
      body_(scene, outline, checked_clearance(options.clearance) * (1.0 + 1e-9), 0.0, "robot", execution) {
  if (!scene.map) return;
  const DistanceField field(scene.map->blocked, CellDistance::squares, true, execution);
  corridors_.emplace(*scene.map, field, body_.reach() / scene.map->cell, execution);
}

Se2 Se2World::corridor_state(std::uint64_t seed, std::uint64_t index) const {
  Se2 state = uniform_state(*this, seed, index);
  if (!corridors_ || corridors_->empty()) return state;
  const Vec2 p = corridors_->at(seed, index);
  return {p.x, p.y, state.theta};
}

PlaceGrid Se2World::free_places(const State& a) const {
  constexpr std::size_t most_pieces = 256;
  if (body_.obstacles().piece_count() > most_pieces) return {};
  const Rotation turned(a.theta);
  std::vector<Vec2> mirrored;
  mirrored.reserve(body_.outline().size());
  for (const Vec2 p : body_.outline()) mirrored.push_back(Vec2{} - turned(p));
  const Box places = body_.places(a.theta);
  if (places.empty()) return {};
  PlaceGrid free = PlaceGrid::over(places);
  body_.obstacles().take_blocked_places(convex_hull(std::move(mirrored)), body_.reach(), free);
  return free;
}

MotionVerdict Se2World::judge_motion(const State& a, const State& b, Query& query) const {
  const Vec2 way = b.position() - a.position();
  const double turn = turn_between(a.theta, b.theta);
  const double whole = norm(way) + radius_ * std::abs(turn);
  Footprint& body = query.footprint;
  const std::span<const Vec2> outline = body_.outline();
  for (std::size_t i = 0; i < outline.size(); ++i) body.bends[i] = 0.5 * turn * turn * norm(outline[i]);
  const double finest = std::max(whole > 0.0 ? resolution_ / whole : 1.0, OpenPiece::finest);
  const auto look = [&](const OpenPiece& piece, bool& split) {
    const Vec2 position = a.position() + piece.middle * way;
    const Rotation turned(a.theta + piece.middle * turn);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 arm = turned(outline[i]);
      body.corners[i] = position + arm;
      body.velocities[i] = way + turn * Vec2{-arm.y, arm.x};
    }
    body.finish();
    const Room room = body_.obstacles().room(body, {piece.half, piece.half * whole}, body_.reach());
    if (room == Room::clear) return MotionVerdict::free;
    if (room == Room::blocked) return MotionVerdict::blocked;
    split = piece.half > finest;
    return MotionVerdict::refused;
  };
  return judge_pieces(look);
}

bool Se2World::is_free_motion(const State& a, const State& b, Query& query) const {
  const MotionVerdict verdict = judge_motion(a, b, query);
  if (verdict == MotionVerdict::refused) ++query.refused;
  return verdict == MotionVerdict::free;
}

}  // namespace warren
