// SPDX-License-Identifier: BSD-3-Clause
#include "studies/compare/planner_deal.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <string>

#include "core/base/error.hpp"
#include "solve/steps/kind_of_problem.hpp"

namespace warren {
namespace {

std::string refused(const PlannerDeal& deal) {
  try {
    deal_planners(deal);
  } catch (const UsageError& error) {
    return error.spelled("--", '-');
  }
  ADD_FAILURE() << "was taken";
  return {};
}

TEST(PlannerDeal, EachPlannerGetsWhatItTakes) {
  PlannerDeal deal{.planners = {PlannerKind::prm, PlannerKind::visibility}};
  deal.common.roadmap.neighbours = 7;
  deal.common.visibility.full = true;
  deal.common.seed = 3;
  const auto contenders = deal_planners(deal);
  ASSERT_EQ(contenders.size(), 2U);
  EXPECT_EQ(contenders[0].planner, PlannerKind::prm);
  EXPECT_EQ(contenders[0].roadmap.neighbours, 7U);
  EXPECT_FALSE(contenders[0].visibility.full);
  EXPECT_EQ(contenders[1].planner, PlannerKind::visibility);
  EXPECT_FALSE(contenders[1].roadmap.neighbours);
  EXPECT_TRUE(contenders[1].visibility.full);
  for (const SolveOptions& contender : contenders) EXPECT_EQ(contender.seed, 3U);
}

TEST(PlannerDeal, EachValueOfAListMakesAContender) {
  const auto contenders = deal_planners({.planners = {PlannerKind::prm, PlannerKind::cells},
                                         .samplers = {SamplerKind::uniform, SamplerKind::halton},
                                         .samples = {50, std::nullopt}});
  ASSERT_EQ(contenders.size(), 5U) << "cells takes neither";
  EXPECT_EQ(contenders[0].sampler, SamplerKind::uniform);
  EXPECT_EQ(contenders[0].roadmap.samples, 50U);
  EXPECT_FALSE(contenders[1].roadmap.samples);
  EXPECT_EQ(contenders[2].sampler, SamplerKind::halton);
  EXPECT_EQ(contenders[4].planner, PlannerKind::cells);
  EXPECT_FALSE(contenders[4].sampler);
}

TEST(PlannerDeal, AQueueGoesOnlyToSearchesThatHaveOne) {
  const auto contenders = deal_planners({.planners = {PlannerKind::prm},
                                         .searches = {SearchMethod::astar, SearchMethod::bfs},
                                         .queues = {QueueKind::heap, QueueKind::lazy_heap}});
  ASSERT_EQ(contenders.size(), 3U);
  EXPECT_EQ(contenders[1].queue, QueueKind::lazy_heap);
  EXPECT_EQ(contenders[2].search, SearchMethod::bfs);
  EXPECT_FALSE(contenders[2].queue);
}

TEST(PlannerDeal, WhatNoPlannerTakesIsRefusedByName) {
  PlannerDeal deal{.planners = {PlannerKind::visibility, PlannerKind::cells}};
  deal.common.trees.goal_bias = 0.5;
  EXPECT_NE(refused(deal).find("--goal-bias: visibility would ignore it"), std::string::npos) << refused(deal);
  EXPECT_NE(refused({.planners = {PlannerKind::grid}, .samples = {std::nullopt}}).find("--samples: grid"),
            std::string::npos);
}

TEST(PlannerDeal, TheQuestionIsCheckedOnce) {
  EXPECT_THROW(deal_planners({.planners = {PlannerKind::prm}, .question = {.clearance = -1.0}}), UsageError);
}

TEST(PlannerDeal, EveryOptionReachesThePlannersThatTakeIt) {
  SolveOptions all{.optimise = true, .sampler = SamplerKind::halton, .search = SearchMethod::dijkstra};
  all.queue = QueueKind::lazy_heap;
  all.roadmap = {.samples = 9, .neighbours = 8, .lazy = LazyCheck::path, .pipeline = PipelineKind::plain};
  all.roadmap.attach = GrowingAttach{};
  all.trees = {.step = 0.5, .goal_bias = 0.25, .nodes = 99, .trees = 2, .via = {{1.0, 2.0}}};
  all.grid = {.cell = 0.5, .angles = 8, .face_motion = true, .step_cost = 2.0, .turn_cost = 3.0};
  all.grid.diagonal = Diagonal::unit;
  all.grid.layers = LayerKind::exact;
  all.cells.doors = DoorKind::funnel;
  all.axis.objective = AxisObjective::clearance;
  all.visibility = {.full = true, .sampled_edges = 0.1};
  all.car = {.steering = SteeringKind::dubins, .turning_radius = 2.0, .cusp_cost = 1.0, .reverse_cost = 2.0};
  const PlannerDeal deal{.planners = {std::begin(all_planners), std::end(all_planners)}, .common = all};
  OptionSet reached;
  for (const SolveOptions& contender : deal_planners(deal)) {
    reached = reached | given(contender);
    for (std::size_t i = 0; i < option_count; ++i) {
      const auto option = static_cast<Option>(i);
      const bool is_taken = !given(contender).has(option) || planner_takes(*contender.planner, option);
      EXPECT_TRUE(is_taken) << name_of(*contender.planner) << " got " << name_of(option);
    }
  }
  for (std::size_t i = 0; i < option_count; ++i) {
    const auto option = static_cast<Option>(i);
    EXPECT_EQ(reached.has(option), option != Option::radius) << name_of(option);
  }
}

}  // namespace
}  // namespace warren
