// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/se2_world.hpp"

#include <algorithm>

#include "scenes/scene/plane_obstacles.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

/// What planning keeps around the body. Throws InputError for what is out of range.
double checked_reach(std::span<const Vec2> outline, double clearance, const Execution& execution) {
  check_body(outline, "robot", execution);
  checked_length("robot: radius", outline_reach(outline), false);
  return checked_clearance(clearance) * (1.0 + 1e-9);
}

}  // namespace

Se2World::Se2World(const Scene& scene, std::span<const Vec2> outline, double clearance, const Execution& execution)
    : BodyAmongObstacles(scene, outline, checked_reach(outline, clearance, execution), 0.0, "robot", execution),
      radius_(outline_reach(outline)) {
  if (!scene.map) return;
  const DistanceField field(scene.map->blocked, CellDistance::squares, true, execution);
  corridors_.emplace(*scene.map, field, reach() / scene.map->cell, execution);
}

Se2 Se2World::corridor_state(std::uint64_t seed, std::uint64_t index) const {
  Se2 state = uniform_state(*this, seed, index);
  if (!corridors_ || corridors_->empty()) return state;
  const Vec2 p = corridors_->at(seed, index);
  return {p.x, p.y, state.theta};
}

PlaceGrid Se2World::free_places(const State& a) const {
  constexpr std::size_t most_pieces = 256;
  if (obstacles().piece_count() > most_pieces) return {};
  const Rotation turned(a.theta);
  std::vector<Vec2> mirrored;
  mirrored.reserve(outline().size());
  for (const Vec2 p : outline()) mirrored.push_back(Vec2{} - turned(p));
  const Box box = places(a.theta);
  if (box.empty()) return {};
  PlaceGrid free = PlaceGrid::over(box);
  obstacles().take_blocked_places(convex_hull(std::move(mirrored)), reach(), free);
  return free;
}

MotionVerdict Se2World::judge_motion(const State& a, const State& b, Query& query) const {
  const Vec2 way = b.position() - a.position();
  const double turn = turn_between(a.theta, b.theta);
  const double whole = norm(way) + radius_ * std::abs(turn);
  Footprint& body = query.footprint;
  const std::span<const Vec2> outline = this->outline();
  for (std::size_t i = 0; i < outline.size(); ++i) body.bends[i] = 0.5 * turn * turn * norm(outline[i]);
  const double finest = std::max(whole > 0.0 ? resolution() / whole : 1.0, OpenPiece::finest);
  const auto look = [&](const OpenPiece& piece, bool& split) {
    const Vec2 position = a.position() + piece.middle * way;
    const Rotation turned(a.theta + piece.middle * turn);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 arm = turned(outline[i]);
      body.corners[i] = position + arm;
      body.velocities[i] = way + turn * Vec2{-arm.y, arm.x};
    }
    body.finish();
    const Room room = obstacles().room(body, {piece.half, piece.half * whole}, reach());
    if (room == Room::clear) return MotionVerdict::free;
    if (room == Room::blocked) return MotionVerdict::blocked;
    split = piece.half > finest;
    return MotionVerdict::refused;
  };
  return judge_pieces(look);
}

}  // namespace warren
