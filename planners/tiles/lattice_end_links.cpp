// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/lattice_end_links.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "planners/tiles/wall_marking.hpp"

namespace warren {
namespace {

constexpr double step = 1.0;         // the longest edge
constexpr double first_look = 20.0;  // where nothing is within a step: a corner's 256 nearest stand within this,
constexpr double last_look = 80.0;   // unless milestones are blocked; with fewer than 256 within this, that is all
constexpr std::size_t most_looked_at = 256;

/// The walls that may touch an edge of at most `reach` from `at`.
std::vector<Segment> walls_around(const LatticeWorld& world, Vec2 at, double reach) {
  const Box around = Box{at, at}.grown(reach + world.clearance * (1 + 1e-9) + 1e-6);
  std::vector<Segment> near;
  const auto take = [&](const Segment& wall) {
    if (around.meets(box_of(wall))) near.push_back(wall);
  };
  if (reach == step && world.grid.area().contains(at)) {
    const auto index = [](double x, std::uint32_t count) {
      return static_cast<std::uint32_t>(std::clamp(std::floor(x - 0.5), 0.0, count - 1.0));
    };
    const std::size_t tile = world.grid.tile_at(index(at.x, world.grid.cols), index(at.y, world.grid.rows));
    world.tiles.reader()->read(tile).for_each_around(world.grid, tile, around, take);
    return near;
  }
  world.tiles.for_each_near(around, take);
  return near;
}

bool is_free(std::span<const Segment> walls, const Segment& edge, double clearance) {
  return std::none_of(walls.begin(), walls.end(),
                      [&](const Segment& wall) { return blocks_edge(wall, edge, clearance); });
}

/// The milestones within `reach` of `at`, nearest first.
std::vector<EndLink> milestones_around(const LatticeWorld& world, std::span<const Segment> walls, Vec2 at,
                                       double reach) {
  std::vector<EndLink> found;
  const auto first = [&](double x) { return static_cast<std::int64_t>(std::max(0.0, std::ceil(x - reach) - 1)); };
  const auto last = [&](double x, std::uint32_t count) {
    return static_cast<std::int64_t>(std::min(count - 1.0, std::floor(x + reach) - 1));
  };
  for (std::int64_t row = first(at.y); row <= last(at.y, world.grid.rows); ++row) {
    for (std::int64_t col = first(at.x); col <= last(at.x, world.grid.cols); ++col) {
      const Vec2 point = TileGrid::point(col, row);
      const double length = distance(at, point);
      if (length > reach || !world.box.contains(point)) continue;
      if (!is_free(walls, {point, point}, world.clearance)) continue;
      found.push_back({static_cast<std::uint32_t>(col), static_cast<std::uint32_t>(row), length});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const EndLink& a, const EndLink& b) { return a.length < b.length; });
  return found;
}

/// Puts the edges to the candidates to the walls; keeps the free ones, or only the first.
void try_links(const LatticeWorld& world, std::span<const Segment> walls, std::span<const EndLink> candidates,
               bool first_only, EndLinks& result) {
  ++result.queries;
  for (const EndLink& link : candidates) {
    ++result.checked;
    if (!is_free(walls, {result.at, TileGrid::point(link.col, link.row)}, world.clearance)) continue;
    result.links.push_back(link);
    if (first_only) return;
  }
}

}  // namespace

EndLinks end_links(const LatticeWorld& world, Vec2 at) {
  EndLinks result{at, false, {}, 0, 0};
  if (!world.box.contains(at)) return result;
  const std::vector<Segment> near = walls_around(world, at, step);
  result.free = is_free(near, {at, at}, world.clearance);
  if (!result.free) return result;
  try_links(world, near, milestones_around(world, near, at, step), false, result);
  if (!result.links.empty()) return result;
  for (double reach = first_look; reach <= last_look; reach *= 2) {
    const std::vector<Segment> wide = walls_around(world, at, reach);
    std::vector<EndLink> candidates = milestones_around(world, wide, at, reach);
    if (candidates.size() < most_looked_at && reach < last_look) continue;
    candidates.resize(std::min(candidates.size(), most_looked_at));
    try_links(world, wide, candidates, true, result);
    break;
  }
  return result;
}

bool is_direct_candidate(Vec2 a, Vec2 b) { return distance(a, b) <= step; }

bool is_direct_edge_free(const LatticeWorld& world, Vec2 a, Vec2 b) {
  return is_free(walls_around(world, a, step), {a, b}, world.clearance);
}

}  // namespace warren
