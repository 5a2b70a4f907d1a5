// SPDX-License-Identifier: BSD-3-Clause
#include "solve/replanner.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "solve/kinds/kept_ways.hpp"
#include "solve/solve.hpp"

namespace warren {
namespace {

void change(OccupancyMap& map, Cell c, bool blocked) {
  const bool was_unknown = !map.unknown.empty() && map.unknown.test(c.x, c.y);
  std::uint64_t& blocked_count = map.occupied > 0 ? map.occupied : map.between;
  --(was_unknown ? map.unknown_count : map.blocked.test(c.x, c.y) ? blocked_count : map.free);
  if (was_unknown) map.unknown.clear(c.x, c.y);
  blocked ? map.blocked.set(c.x, c.y) : map.blocked.clear(c.x, c.y);
  ++(blocked ? map.occupied : map.free);
}

}  // namespace

Replanner::Replanner(Scene scene, Question question, SolveOptions options, Limits limits)
    : scene_(std::move(scene)),
      question_(std::move(question)),
      options_(std::move(options)),
      limits_(std::move(limits)),
      kept_(std::make_unique<KeptWays>()) {}

Replanner::~Replanner() = default;

OccupancyMap& Replanner::map() {
  if (!scene_.map) throw UsageError("cells change in maps alone; this world has none");
  return *scene_.map;
}

void Replanner::update(std::span<const CellChange> cells) {
  OccupancyMap& of = map();
  for (const CellChange& to : cells) {
    if (to.cell.x < of.width() && to.cell.y < of.height()) continue;
    throw InputError("cells", fmt::format("must be in the map, which is {} wide and {} high", of.width(), of.height()),
                     fmt::format("{}, {}", to.cell.x, to.cell.y));
  }
  for (const CellChange& to : cells) change(of, to.cell, to.blocked);
}

void Replanner::update(const Box& box, bool blocked) {
  OccupancyMap& of = map();
  for (std::uint32_t y = 0; y < of.height(); ++y) {
    for (std::uint32_t x = 0; x < of.width(); ++x) {
      const Vec2 middle = cell_centre(of, {x, y});
      const bool is_in =
          middle.x >= box.min.x && middle.x <= box.max.x && middle.y >= box.min.y && middle.y <= box.max.y;
      if (is_in) change(of, {x, y}, blocked);
    }
  }
}

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
