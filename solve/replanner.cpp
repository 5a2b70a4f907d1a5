// SPDX-License-Identifier: BSD-3-Clause
#include "solve/replanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "solve/kinds/kept_ways.hpp"
#include "solve/solve.hpp"

namespace warren {
namespace {

OccupancyMap& map_of(Scene& scene) {
  if (!scene.map) throw UsageError("cells change in maps alone; this world has none");
  return *scene.map;
}

void change(OccupancyMap& map, Cell c, bool blocked) {
  const bool was_unknown = !map.unknown.empty() && map.unknown.test(c.x, c.y);
  std::uint64_t& blocked_count = map.occupied > 0 ? map.occupied : map.between;
  --(was_unknown ? map.unknown_count : map.blocked.test(c.x, c.y) ? blocked_count : map.free);
  if (was_unknown) map.unknown.clear(c.x, c.y);
  if (!map.water.empty()) map.water.clear(c.x, c.y);
  blocked ? map.blocked.set(c.x, c.y) : map.blocked.clear(c.x, c.y);
  ++(blocked ? map.occupied : map.free);
}

/// Of cells: whose middle may be in the box, the others being too far away for any rounding.
Box cells_near(const OccupancyMap& map, const Box& box) {
  Box all = world_box(map);
  double off = map.cell;
  for (const Vec2 corner : {all.min, all.max}) off += 0x1p-45 * (std::abs(corner.x) + std::abs(corner.y));
  all = all.grown(off);
  Box near;
  for (const double x : {std::max(box.min.x - off, all.min.x), std::min(box.max.x + off, all.max.x)}) {
    for (const double y : {std::max(box.min.y - off, all.min.y), std::min(box.max.y + off, all.max.y)}) {
      near.include(map_point(map, {x, y}));
    }
  }
  return near;
}

}  // namespace

void change_cells(Scene& scene, std::span<const CellChange> cells) {
  OccupancyMap& map = map_of(scene);
  for (const CellChange& to : cells) {
    if (to.cell.x < map.width() && to.cell.y < map.height()) continue;
    throw InputError("cells",
                     fmt::format("must be in the map, which is {} wide and {} high", map.width(), map.height()),
                     fmt::format("{}, {}", to.cell.x, to.cell.y));
  }
  for (const CellChange& to : cells) change(map, to.cell, to.blocked);
}

void change_cells(Scene& scene, const Box& box, bool blocked, const Execution& execution) {
  OccupancyMap& map = map_of(scene);
  const Box near = cells_near(map, box);
  const auto bound = [](double at, std::uint32_t most) { return bounded_whole<std::uint32_t>(at, 0.0, most); };
  std::uint64_t seen = 0;
  for (std::uint32_t y = bound(near.min.y, map.height()); y < bound(std::ceil(near.max.y), map.height()); ++y) {
    for (std::uint32_t x = bound(near.min.x, map.width()); x < bound(std::ceil(near.max.x), map.width()); ++x) {
      execution.poll(seen++);
      if (box.contains(cell_centre(map, {x, y}))) change(map, {x, y}, blocked);
    }
  }
}

Replanner::Replanner(Scene scene, Question question, SolveOptions options, Limits limits)
    : scene_(std::move(scene)),
      question_(std::move(question)),
      options_(std::move(options)),
      limits_(std::move(limits)),
      kept_(std::make_unique<KeptWays>()) {}

Replanner::~Replanner() = default;

Answer Replanner::solve(const std::vector<double>& start) {
  const LimitedExecution limited(limits_);
  return solve_within(start, limited.execution());
}

Answer Replanner::solve_within(const std::vector<double>& start, const Execution& execution) {
  Question question = question_;
  if (!start.empty()) question.start = start;
  return solve_explained(scene_, question, options_, execution, nullptr, nullptr, kept_.get());
}

}  // namespace warren
