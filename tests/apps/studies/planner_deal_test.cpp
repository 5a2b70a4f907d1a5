// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/planner_contest.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "solve/kinds/kind_of_problem.hpp"

namespace warren::studies {
namespace {

DealtOption list(Option option, std::vector<DealtValue> values) { return {option, std::move(values)}; }

DealtValue samples(std::optional<std::uint64_t> count) {
  return {count ? std::to_string(*count) : "auto", {.roadmap = {.samples = count}}};
}

DealtOption samplers() {
  return list(Option::sampler,
              {{"uniform", {.sampler = SamplerKind::uniform}}, {"halton", {.sampler = SamplerKind::halton}}});
}

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
  EXPECT_EQ(contenders[0].options.planner, PlannerKind::prm);
  EXPECT_EQ(contenders[0].options.roadmap.neighbours, 7U);
  EXPECT_FALSE(contenders[0].options.visibility.full);
  EXPECT_EQ(contenders[1].options.planner, PlannerKind::visibility);
  EXPECT_FALSE(contenders[1].options.roadmap.neighbours);
  EXPECT_TRUE(contenders[1].options.visibility.full);
  for (const PlannerContender& contender : contenders) EXPECT_EQ(contender.options.seed, 3U);
}

TEST(PlannerDeal, EachValueOfAListMakesAContender) {
  const auto contenders =
      deal_planners({.planners = {PlannerKind::prm, PlannerKind::cells},
                     .lists = {samplers(), list(Option::samples, {samples(50), samples(std::nullopt)})}});
  ASSERT_EQ(contenders.size(), 5U) << "cells takes neither";
  EXPECT_EQ(contenders[0].options.sampler, SamplerKind::uniform);
  EXPECT_EQ(contenders[0].options.roadmap.samples, 50U);
  EXPECT_EQ(contenders[0].dealt, (std::vector<DealtWord>{{"sampler", "uniform"}, {"samples", "50"}}));
  EXPECT_FALSE(contenders[1].options.roadmap.samples);
  EXPECT_EQ(contenders[1].dealt.back().second, "auto");
  EXPECT_EQ(contenders[2].options.sampler, SamplerKind::halton);
  EXPECT_EQ(contenders[4].options.planner, PlannerKind::cells);
  EXPECT_FALSE(contenders[4].options.sampler);
  EXPECT_TRUE(contenders[4].dealt.empty());
}

TEST(PlannerDeal, AListOfOneValueSetsNobodyApart) {
  const auto contenders =
      deal_planners({.planners = {PlannerKind::prm}, .lists = {list(Option::samples, {samples(50)})}});
  ASSERT_EQ(contenders.size(), 1U);
  EXPECT_EQ(contenders[0].options.roadmap.samples, 50U);
  EXPECT_TRUE(contenders[0].dealt.empty());
}

TEST(PlannerDeal, ClearancesAreDealtToAllPlanners) {
  const auto contenders =
      deal_planners({.planners = {PlannerKind::prm, PlannerKind::voronoi}, .clearances = {0.1, 0.25}});
  ASSERT_EQ(contenders.size(), 4U);
  EXPECT_EQ(contenders[1].question.clearance, 0.25);
  EXPECT_EQ(contenders[2].question.clearance, 0.1);
  EXPECT_EQ(contenders[3].dealt, (std::vector<DealtWord>{{"clearance", "0.25"}}));
  EXPECT_THROW(deal_planners({.planners = {PlannerKind::prm}, .clearances = {0.1, -1.0}}), UsageError);
}

TEST(PlannerDeal, MoreThanTenThousandContendersAreRefused) {
  PlannerDeal deal{.planners = {PlannerKind::prm}, .lists = {list(Option::samples, {}), list(Option::neighbours, {})}};
  for (std::uint32_t i = 1; i <= 101; ++i) {
    deal.lists[0].values.push_back(samples(i));
    deal.lists[1].values.push_back({std::to_string(i), {.roadmap = {.neighbours = i}}});
  }
  EXPECT_NE(refused(deal).find("10000"), std::string::npos);
  deal.lists[0].values.resize(99);
  EXPECT_EQ(deal_planners(deal).size(), 9999U);
}

TEST(PlannerDeal, AQueueGoesOnlyToSearchesThatHaveOne) {
  const auto contenders = deal_planners(
      {.planners = {PlannerKind::prm},
       .lists = {
           list(Option::search, {{"astar", {.search = SearchMethod::astar}}, {"bfs", {.search = SearchMethod::bfs}}}),
           list(Option::queue,
                {{"heap", {.queue = QueueKind::heap}}, {"lazy-heap", {.queue = QueueKind::lazy_heap}}})}});
  ASSERT_EQ(contenders.size(), 3U);
  EXPECT_EQ(contenders[1].options.queue, QueueKind::lazy_heap);
  EXPECT_EQ(contenders[2].options.search, SearchMethod::bfs);
  EXPECT_FALSE(contenders[2].options.queue);
}

TEST(PlannerDeal, WhatNoPlannerTakesIsRefusedByName) {
  PlannerDeal deal{.planners = {PlannerKind::visibility, PlannerKind::cells}};
  deal.common.trees.goal_bias = 0.5;
  EXPECT_NE(refused(deal).find("--goal-bias: visibility would ignore it"), std::string::npos) << refused(deal);
  EXPECT_NE(refused({.planners = {PlannerKind::grid}, .lists = {list(Option::samples, {samples(std::nullopt)})}})
                .find("--samples: grid"),
            std::string::npos);
}

TEST(PlannerDeal, TheQuestionIsCheckedOnce) {
  EXPECT_THROW(deal_planners({.planners = {PlannerKind::prm}, .question = {.clearance = -1.0}}), UsageError);
}

TEST(PlannerDeal, EveryOptionReachesThePlannersThatTakeIt) {
  SolveOptions all{.optimise = true, .sampler = SamplerKind::halton, .search = SearchMethod::astar, .bound = true};
  all.queue = QueueKind::lazy_heap;
  all.roadmap = {.samples = 9, .neighbours = 8, .lazy = LazyCheck::expansion, .pipeline = PipelineKind::plain};
  all.roadmap.attach = GrowingAttach{};
  all.roadmap.neighbour_index = NeighbourIndex::kd_tree;
  all.heuristic = HeuristicKind::manhattan;
  all.trees = {.step = 0.5, .goal_bias = 0.25, .nodes = 99, .trees = 2, .via = {{1.0, 2.0}}};
  all.anytime = {.iterations = 9, .gap = 0.1, .parts = {AnytimePart::tree}};
  all.grid = {.cell = 0.5, .angles = 8, .face_motion = true, .step_cost = 2.0, .turn_cost = 3.0};
  all.grid.diagonal = Diagonal::unit;
  all.grid.headings = 32;
  all.grid.layers = LayerKind::exact;
  all.cells.doors = DoorKind::funnel;
  all.axis.objective = AxisObjective::clearance;
  all.visibility = {.full = true, .sampled_edges = 0.1};
  all.car = {.steering = SteeringKind::dubins, .turning_radius = 2.0, .cusp_cost = 1.0, .reverse_cost = 2.0};
  const PlannerDeal deal{.planners = {std::begin(all_planners), std::end(all_planners)}, .common = all};
  OptionSet reached;
  for (const PlannerContender& dealt : deal_planners(deal)) {
    const SolveOptions& contender = dealt.options;
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
}  // namespace warren::studies
