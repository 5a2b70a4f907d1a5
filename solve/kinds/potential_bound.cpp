// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/potential_bound.hpp"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include "planners/grid/price_potential.hpp"
#include "solve/kinds/lower_bound.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {
namespace {

/// Beyond, cells are not cut any smaller.
constexpr std::uint64_t most_parts_of_cells = std::uint64_t{1} << 26U;

/// One start, one goal.
bool has_one_way(const Problem& problem) {
  const GoalRule& rule = problem.rule;
  return rule.others.empty() && !rule.region && rule.visit.empty() && !rule.back && problem.start.size() == 2 &&
         problem.goal.size() == 2;
}

struct Proved {
  double bound = 0.0;
  CellPotential proof;
};

Proved proved_by_potential(const Answer& answer, const OccupancyMap& map, std::optional<double> gap,
                           const Execution& execution) {
  const Problem& problem = answer.problem;
  const Vec2 start{problem.start[0], problem.start[1]};
  const Vec2 goal{problem.goal[0], problem.goal[1]};
  const Bitmap closed = closed_cells(map, start);
  const double radius = problem.robot.radius / map.cell;
  PotentialQuestion question{closed, map_point(map, start), map_point(map, goal), radius + problem.clearance / map.cell,
                             radius};
  if (const auto& clearance = problem.prices.clearance; clearance && clearance->price > 0.0) {
    question.price = clearance->price;
    question.reach = clearance_reach(*clearance, problem.robot.radius) / map.cell;
  }
  const double cost = answer.cost.value_or(answer.length);
  const double enough = gap ? cost / (1.0 + *gap) / map.cell : 0.0;
  const std::uint32_t most_parts = gap ? 3 : 2;
  // A place in cells is rounded by less than this times its distance from the origin.
  constexpr double misplaced = 1e-13;
  const double lost =
      misplaced * (norm(start) + norm(goal) + 2.0 * norm(map.origin) + 2.0 * map.cell) * (1.0 + question.price);
  Proved best;
  for (std::uint32_t parts = 1; parts <= most_parts && closed.size() * parts * parts <= most_parts_of_cells; ++parts) {
    try {
      auto found = price_potential(question, {.parts = parts, .sweeps = 12, .enough = enough}, execution);
      if (!found) break;
      const double bound = found->bound * map.cell * (1.0 - 1e-10) - lost;
      if (!(bound > best.bound)) continue;
      for (double& value : found->values.values) value *= map.cell;
      best = {bound, std::move(found->values)};
    } catch (const Stopped&) {
      break;
    } catch (const std::bad_alloc&) {
      break;
    }
    if (gap && best.bound >= enough * map.cell) break;
  }
  return best;
}

}  // namespace

void prove_on_map(Answer& answer, const Scene& scene, const SolveOptions& options, ByProducts* keep,
                  const Execution& execution) {
  const bool keeps = keep != nullptr && keep->wants_certificate;
  const std::optional<double> gap = options.anytime.gap;
  const RobotKind body = answer.problem.robot.kind;
  const bool is_plain = body == RobotKind::point || body == RobotKind::disc;
  if (!(options.bound || gap || keeps) || !answer.verified || !scene.map || !is_plain) return;
  if (answer.planner != name_of(PlannerKind::grid) || !options.trees.via.empty() || !has_one_way(answer.problem))
    return;
  double seconds = 0.0;
  const StageTimer timer(execution, "bound", seconds, scene.map->blocked.size());
  if (!answer.price) answer.cost.reset();  // in steps: what is bounded is the length
  const double cost = answer.cost.value_or(answer.length);
  double bound = answer.lower_bound.value_or(0.0);
  bound = std::max(bound, proved_bound(scene, answer.problem, BoundOf::length, BoundEffort::exact, execution));
  const bool is_reached = gap && cost <= bound * (1.0 + *gap);
  if (keeps || !is_reached) {
    Proved proved = proved_by_potential(answer, *scene.map, gap, execution);
    bound = keeps ? proved.bound : std::max(bound, proved.bound);
    if (keeps && !proved.proof.values.empty()) keep->certificate = std::move(proved.proof);
  }
  answer.lower_bound = bound;
  answer.bound_of = "all";
  constexpr double rounding = 1e-9;
  answer.optimal = cost - bound <= rounding * cost;
}

}  // namespace warren
