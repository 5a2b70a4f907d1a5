// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/solve_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"

namespace warren {
namespace {

void check_range(Option option, std::optional<double> value, double low, double high) {
  if (!value || (*value >= low && *value <= high)) return;
  throw UsageError(fmt::format("@{}: must be a number from {} to {} (found: {})", name_of(option), low, high, *value));
}

void check_positive(Option option, std::optional<double> value) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return;
  throw UsageError(fmt::format("@{}: must be a number above 0 (found: {})", name_of(option), *value));
}

void check_count(Option option, std::optional<std::uint64_t> value, std::uint64_t low, std::uint64_t high) {
  if (!value || (*value >= low && *value <= high)) return;
  throw UsageError(
      fmt::format("@{}: must be a whole number from {} to {} (found: {})", name_of(option), low, high, *value));
}

void check_way_points(const std::vector<std::vector<double>>& via) {
  const auto is_coordinate = [](double x) { return std::abs(x) <= largest_coordinate; };
  for (const std::vector<double>& state : via) {
    const bool known = state.size() == 2 || state.size() == 3 || state.size() == 6;
    if (known && std::all_of(state.begin(), state.end(), is_coordinate)) continue;
    throw UsageError("@via: a way-point is 2, 3 or 6 numbers of at most 1e60");
  }
}

}  // namespace

void SolveOptions::validate() const {
  constexpr std::uint64_t most_drawn = std::uint64_t{1} << 31;
  check_count(Option::samples, roadmap.samples, 1, most_drawn);
  check_count(Option::neighbours, roadmap.neighbours, 1, 4096);
  check_positive(Option::radius, roadmap.radius);
  if (roadmap.attach) {
    check_positive(Option::attach, roadmap.attach->radius);
    check_positive(Option::attach, roadmap.attach->step);
    check_count(Option::attach, roadmap.attach->tries, 1, 10'000);
  }
  check_positive(Option::step, trees.step);
  check_range(Option::goal_bias, trees.goal_bias, 0.0, 1.0);
  check_count(Option::nodes, trees.nodes, 2, most_drawn);
  check_count(Option::trees, trees.trees, 1, 4096);
  check_way_points(trees.via);
  check_positive(Option::cell, grid.cell);
  check_count(Option::angles, grid.angles, 1, 1'000'000);
  check_positive(Option::step_cost, grid.step_cost);
  check_positive(Option::turn_cost, grid.turn_cost);
  check_positive(Option::sampled_edges, visibility.sampled_edges);
  check_positive(Option::turning_radius, car.turning_radius);
  check_range(Option::cusp_cost, car.cusp_cost, 0.0, largest_coordinate);
  check_range(Option::reverse_cost, car.reverse_cost, 1.0, largest_coordinate);
}

OptionSet given(const SolveOptions& o) {
  OptionSet set;
  const auto add = [&](Option option, bool is_given) {
    if (is_given) set = set | OptionSet{option};
  };
  add(Option::sampler, o.sampler.has_value());
  add(Option::samples, o.roadmap.samples.has_value());
  add(Option::neighbours, o.roadmap.neighbours.has_value() || o.roadmap.star == StarRule::neighbours);
  add(Option::radius, o.roadmap.radius.has_value() || o.roadmap.star == StarRule::radius);
  add(Option::search, o.search.has_value());
  add(Option::queue, o.queue.has_value());
  add(Option::lazy, o.roadmap.lazy.has_value() || o.visibility.lazy);
  add(Option::pipeline, o.roadmap.pipeline.has_value());
  add(Option::optimise, o.optimise);
  add(Option::cell, o.grid.cell.has_value());
  add(Option::angles, o.grid.angles.has_value());
  add(Option::face_motion, o.grid.face_motion);
  add(Option::step_cost, o.grid.step_cost.has_value());
  add(Option::turn_cost, o.grid.turn_cost.has_value());
  add(Option::diagonal, o.grid.diagonal.has_value());
  add(Option::layers, o.grid.layers.has_value());
  add(Option::full, o.visibility.full);
  add(Option::sampled_edges, o.visibility.sampled_edges.has_value());
  add(Option::doors, o.cells.doors.has_value());
  add(Option::objective, o.axis.objective.has_value());
  add(Option::step, o.trees.step.has_value());
  add(Option::goal_bias, o.trees.goal_bias.has_value());
  add(Option::nodes, o.trees.nodes.has_value());
  add(Option::trees, o.trees.trees.has_value());
  add(Option::via, !o.trees.via.empty());
  add(Option::steering, o.car.steering.has_value());
  add(Option::turning_radius, o.car.turning_radius.has_value());
  add(Option::cusp_cost, o.car.cusp_cost.has_value());
  add(Option::reverse_cost, o.car.reverse_cost.has_value());
  add(Option::attach, o.roadmap.attach.has_value());
  add(Option::heuristic, o.heuristic.has_value());
  add(Option::neighbour_index, o.roadmap.neighbour_index.has_value());
  return set;
}

}  // namespace warren
