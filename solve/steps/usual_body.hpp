// SPDX-License-Identifier: BSD-3-Clause
// What most bodies of sampled_solve.hpp and sampled_roadmap.hpp have in common.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/base/solution.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

struct UsualBody {
  static constexpr bool has_trees = true;
  static constexpr bool names_pipeline = false;
  static constexpr bool judged_by_index = false;  ///< does its judge take an ObstacleIndex?
  static constexpr std::string_view noun = "body";
  static constexpr std::optional<SamplerKind> tree_sampler = std::nullopt;

  static void add_options(Answer&) {}
  template <class World, class State>
  static std::vector<State> best_first(const World&, const std::vector<State>& goals) {
    return goals;
  }
  static std::uint64_t goals_tried() { return 0; }
  static bool knows_all_goals() { return true; }
  static std::optional<GrowingAttach> attach(const SolveOptions&) { return std::nullopt; }
  template <class World, class Goals>
  static std::string_view cause_of_blocked(const World&, Outcome outcome, const Goals&) {
    return outcome == Outcome::start_blocked ? "start_in_collision" : "goal_in_collision";
  }
};

}  // namespace warren
