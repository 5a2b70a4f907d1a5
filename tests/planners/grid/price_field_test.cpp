// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/price_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"
#include "planners/grid/visiting_order.hpp"
#include "tests/planners/grid/grid_oracle.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using grid_oracle::may_step;
using grid_oracle::random_cell;
using grid_oracle::random_map;

constexpr std::uint64_t nowhere = std::numeric_limits<std::uint64_t>::max();

/// A price of any step, the same there and back: of both cells, up to fifty times its length and more.
std::uint64_t weight_of(std::uint64_t seed, int x, int y, int dx, int dy) {
  const auto bits = [&](int u, int v) {
    return random_bits(seed, static_cast<std::uint64_t>(u), static_cast<std::uint64_t>(v));
  };
  const std::uint64_t length = dx != 0 && dy != 0 ? units_a_diagonal : units_a_cell;
  const std::uint64_t extra = (bits(x, y) ^ bits(x + dx, y + dy)) % (seed % 4 == 0 ? 2 : 1 + (length << seed % 6));
  return seed % 5 == 0 ? length + (extra << 13U) : length + extra;
}

/// Plain Dijkstra over a plain array.
std::vector<std::uint64_t> plain_costs(const Bitmap& blocked, std::uint64_t seed,
                                       const std::vector<PriceField::Goal>& goals) {
  const auto width = static_cast<int>(blocked.width());
  std::vector<std::uint64_t> cost(blocked.size(), nowhere);
  std::priority_queue<std::pair<std::uint64_t, int>, std::vector<std::pair<std::uint64_t, int>>, std::greater<>> queue;
  for (const PriceField::Goal& goal : goals) {
    if (blocked.test(goal.cell.x, goal.cell.y)) continue;
    const int at = static_cast<int>(goal.cell.y) * width + static_cast<int>(goal.cell.x);
    cost[static_cast<std::size_t>(at)] = std::min(cost[static_cast<std::size_t>(at)], goal.cost);
    queue.emplace(goal.cost, at);
  }
  while (!queue.empty()) {
    const auto [d, at] = queue.top();
    queue.pop();
    if (d > cost[static_cast<std::size_t>(at)]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = at % width;
        const int y = at / width;
        if (!may_step(blocked, x, y, dx, dy, Diagonal::sqrt2)) continue;
        const std::uint64_t through = d + weight_of(seed, x, y, dx, dy);
        const int to = at + dy * width + dx;
        if (through >= cost[static_cast<std::size_t>(to)]) continue;
        cost[static_cast<std::size_t>(to)] = through;
        queue.emplace(through, to);
      }
    }
  }
  return cost;
}

StepWeights priced(const Bitmap& map, std::uint64_t seed) {
  return {map,
          [seed](Cell from, unsigned s) {
            return weight_of(seed, static_cast<int>(from.x), static_cast<int>(from.y), cell_steps[s][0],
                             cell_steps[s][1]);
          },
          Execution{}};
}

/// Cells that come and go, and steps that get dearer and cheaper: what is asked after a repair is what a new field
/// says, to the unit and cell by cell, wherever it is asked and however much was known before.
TEST(PriceField, RepairedItIsAsANewOne) {
  for (const std::uint64_t seed : test::seeds(1000, 100)) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    std::uint64_t cells = 0;  // drawn
    Bitmap map = random_map(seed);
    std::vector<std::uint64_t> extra(map.size());  // what a cell adds to the steps from and to it
    const auto weigh = [&extra, width = map.width()](Cell from, unsigned s) {
      const std::size_t to = (from.y + static_cast<std::size_t>(cell_steps[s][1])) * width + from.x +
                             static_cast<std::size_t>(cell_steps[s][0]);
      return (is_diagonal(s) ? units_a_diagonal : units_a_cell) + extra[from.y * std::size_t{width} + from.x] +
             extra[to];
    };
    StepWeights weights(map, weigh, {});
    std::vector<PriceField::Goal> goals;
    for (std::uint64_t i = 0; i <= rng.below(3); ++i)
      goals.push_back({random_cell(map, seed, cells++), rng.below(3 * units_a_cell)});
    const std::vector<Cell> starts{random_cell(map, seed, cells++), random_cell(map, seed, cells++)};
    const std::span<const Cell> towards = seed % 3 == 0 ? std::span<const Cell>() : std::span(starts);
    std::optional<PriceField> field(std::in_place, weights, goals, towards, Execution{});
    for (int change = 0; change < 40; ++change) {
      if (!map.test(starts[0].x, starts[0].y)) field->cost(starts[0], {});
      std::vector<Cell> touched;
      const Cell at = random_cell(map, seed, cells++);
      for (std::uint64_t n = rng.below(6); n-- > 0;) {
        const Cell c{std::min<std::uint32_t>(map.width() - 1, at.x + static_cast<std::uint32_t>(rng.below(3))),
                     std::min<std::uint32_t>(map.height() - 1, at.y + static_cast<std::uint32_t>(rng.below(3)))};
        if (rng.below(2) == 0) {
          const bool free = map.test(c.x, c.y);
          free ? map.clear(c.x, c.y) : map.set(c.x, c.y);
          weights.change(c, free);
        } else {
          extra[c.y * std::size_t{map.width()} + c.x] = rng.below(2) * rng.below(9 * units_a_cell);
        }
        for (std::uint32_t y = c.y - std::min(c.y, 1U); y <= std::min(c.y + 1, map.height() - 1); ++y) {
          for (std::uint32_t x = c.x - std::min(c.x, 1U); x <= std::min(c.x + 1, map.width() - 1); ++x) {
            weights.forget({x, y});
            touched.push_back({x, y});
          }
        }
      }
      if (!field->repair(touched, map.size() / 2, {})) field.emplace(weights, goals, towards, Execution{});
      StepWeights new_weights(map, weigh, {});
      PriceField fresh(new_weights, goals, towards, {});
      for (const Cell start : starts) {
        if (map.test(start.x, start.y)) continue;
        const auto cost = field->cost(start, {});
        ASSERT_EQ(cost, fresh.cost(start, {}));
        if (cost) ASSERT_EQ(field->path(start, {}), fresh.path(start, {}));
      }
    }
  }
}

TEST(PriceField, CostsAreThoseOfAPlainDijkstraToTheUnit) {
  for (const std::uint64_t seed : test::seeds(500, 10)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed, 60);
    std::vector<PriceField::Goal> goals;
    for (std::uint64_t i = 0; i <= seed % 4; ++i)
      goals.push_back({random_cell(map, seed, 500 + i), i * 700'000 + random_bits(seed, i, 77) % 5});
    const std::vector<std::uint64_t> expected = plain_costs(map, seed, goals);
    const auto expected_at = [&](Cell c) { return expected[std::size_t{c.y} * map.width() + c.x]; };
    StepWeights weights = priced(map, seed);
    const Cell first = random_cell(map, seed, 1);
    PriceField ahead(weights, goals, std::span(&first, 1), {});
    PriceField everywhere(weights, goals, {}, {});
    // The first is what the field heads for; the others, anywhere, it goes on for.
    for (std::uint64_t i = 0; i < 8; ++i) {
      const Cell from = i == 0 ? first : random_cell(map, seed, 1 + i);
      for (PriceField* field : {&ahead, &everywhere}) {
        const auto cost = field->cost(from, {});
        ASSERT_EQ(cost.value_or(nowhere), map.test(from.x, from.y) ? nowhere : expected_at(from)) << i;
        if (!cost) continue;
        const auto [cells, goal] = field->path(from, {});
        std::uint64_t sum = goals[goal].cost;
        for (std::size_t k = 1; k < cells.size(); ++k) {
          const int x = static_cast<int>(cells[k - 1].x);
          const int y = static_cast<int>(cells[k - 1].y);
          const int dx = static_cast<int>(cells[k].x) - x;
          const int dy = static_cast<int>(cells[k].y) - y;
          ASSERT_TRUE(may_step(map, x, y, dx, dy, Diagonal::sqrt2));
          sum += weight_of(seed, x, y, dx, dy);
        }
        ASSERT_EQ(cells.front(), from);
        ASSERT_EQ(cells.back(), goals[goal].cell);
        ASSERT_EQ(sum, *cost);
      }
      // Whatever the order of work was, the way is the same one.
      if (ahead.cost(from, {})) {
        ASSERT_EQ(ahead.path(from, {}), everywhere.path(from, {}));
      }
    }
    everywhere.settle_all({});
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x)
        ASSERT_EQ(everywhere.reached({x, y}), expected_at({x, y}) != nowhere);
    }
  }
}

TEST(PriceField, StepsWithoutAPriceWeighTheirLengthByEveryRule) {
  for (const std::uint64_t seed : test::seeds(90, 12)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed);
    const Cell start = random_cell(map, seed, 1);
    const PriceField::Goal goal[] = {{random_cell(map, seed, 2)}};
    for (const Diagonal diagonal : {Diagonal::sqrt2, Diagonal::unit, Diagonal::none}) {
      StepWeights weights(map, diagonal, {});
      PriceField field(weights, goal, std::span(&start, 1), {});
      const auto cost = field.cost(start, {});
      const double expected = grid_oracle::shortest(map, start, goal[0].cell, diagonal);
      ASSERT_EQ(cost.has_value(), std::isfinite(expected));
      if (!cost) continue;
      EXPECT_NEAR(static_cast<double>(*cost) / units_a_cell, expected, 1e-6 * expected);
      EXPECT_NEAR(grid_oracle::judged(map, field.path(start, {}).first, start, goal[0].cell, diagonal), expected, 1e-9);
    }
  }
}

TEST(PriceField, AStopEndsIt) {
  const Bitmap map(800, 800);
  StepWeights weights(map, Diagonal::sqrt2, {});
  const PriceField::Goal goal[] = {{{0, 0}}};
  PriceField field(weights, goal, {}, {});
  const Deadline over(0.0, 1e9);
  Execution execution;
  execution.deadline = &over;
  EXPECT_THROW(field.cost({799, 799}, execution), Stopped);
}

/// The least of all permutations, and of equal ones the first.
VisitingOrder by_permutations(const TourCosts& costs) {
  VisitingOrder best{{}, no_leg};
  std::vector<std::uint64_t> order;
  for (std::size_t i = 0; i < costs.to_end.size(); ++i) order.push_back(i);
  do {
    std::uint64_t sum = costs.from_start[order[0]] + costs.to_end[order.back()];
    for (std::size_t i = 1; i < order.size(); ++i) sum += costs.between[order[i - 1]][order[i]];
    if (sum < best.cost) best = {order, sum};
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(VisitingOrder, IsTheLexicographicallyLeastOfTheCheapest) {
  for (const std::uint64_t seed : test::seeds(400, 60)) {
    SCOPED_TRACE(seed);
    const std::size_t count = 1 + seed % 6;
    // Few different costs, so that many orders are equal; now and then there is no way.
    std::uint64_t at = 0;
    const auto cost = [&] {
      const std::uint64_t bits = random_bits(seed, ++at, 3);
      return seed % 3 == 0 && bits % 4 == 0 ? no_leg : bits % (seed % 2 == 0 ? 3 : 1000);
    };
    TourCosts costs;
    for (std::size_t i = 0; i < count; ++i) {
      costs.from_start.push_back(cost());
      costs.to_end.push_back(seed % 5 == 0 ? 0 : cost());
      std::vector<std::uint64_t>& row = costs.between.emplace_back();
      for (std::size_t j = 0; j < count; ++j) row.push_back(cost());
    }
    const VisitingOrder expected = by_permutations(costs);
    const auto found = best_order(costs);
    ASSERT_EQ(found.has_value(), expected.cost < no_leg);
    if (!found) continue;
    EXPECT_EQ(found->cost, expected.cost);
    EXPECT_EQ(found->order, expected.order);
  }
}

}  // namespace
}  // namespace warren
