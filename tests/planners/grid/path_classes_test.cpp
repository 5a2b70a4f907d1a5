// SPDX-License-Identifier: BSD-3-Clause
// The K cheapest classes over cells against those that other cuts and a plain search find.
#include "planners/grid/path_classes.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/base/rng.hpp"
#include "tests/planners/grid/class_oracle.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

Bitmap picture(const std::vector<std::string>& rows) {
  Bitmap blocked(static_cast<std::uint32_t>(rows.front().size()), static_cast<std::uint32_t>(rows.size()));
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    for (std::uint32_t x = 0; x < blocked.width(); ++x) {
      if (rows[rows.size() - 1 - y][x] == '#') blocked.set(x, y);
    }
  }
  return blocked;
}

unsigned step_between(Cell a, Cell b) {
  for (unsigned s = 0; s < cell_steps.size(); ++s) {
    if (a.x + static_cast<std::uint32_t>(cell_steps[s][0]) == b.x &&
        a.y + static_cast<std::uint32_t>(cell_steps[s][1]) == b.y) {
      return s;
    }
  }
  ADD_FAILURE() << "no step";
  return 0;
}

Path<Vec2> middles(const std::vector<Cell>& cells) {
  Path<Vec2> path;
  for (const Cell c : cells) path.push_back({c.x + 0.5, c.y + 0.5});
  return path;
}

TEST(PathClasses, HolesAreWhatTheBorderDoesNotReach) {
  const Bitmap blocked = picture({"#........",  //
                                  ".#..##...",  //
                                  "....##.#.",  //
                                  "...#..#..",  //
                                  ".........",  //
                                  "....#...."});
  const Execution execution;
  const HoleCuts all(blocked, 0.0, execution);
  ASSERT_EQ(all.holes().size(), 1U);  // diagonal neighbours are one; what reaches the border is none
  EXPECT_EQ(all.holes()[0].low, (Cell{3, 2}));
  EXPECT_EQ(all.holes()[0].high, (Cell{7, 4}));
  EXPECT_EQ(HoleCuts(blocked, 5.0, execution).holes().size(), 1U);
  EXPECT_TRUE(HoleCuts(blocked, 5.5, execution).holes().empty());
}

TEST(PathClasses, OneHoleHasTwoSidesAndTurnsAroundIt) {
  const Bitmap blocked = picture({".....",  //
                                  ".....",  //
                                  "..#..",  //
                                  ".....",  //
                                  "....."});
  const Execution execution;
  StepWeights weights(blocked, Diagonal::sqrt2, execution);
  const Cell start{0, 2};
  const Cell goal{4, 2};
  const PriceField::Goal goals[] = {{goal}};
  PriceField field(weights, goals, {}, execution);
  const HoleCuts cuts(blocked, 0.0, execution);
  const auto found = cheapest_classes(weights, field, cuts, start, goal, {.count = 3, .stretch = 10.0}, execution);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].cost, found[1].cost);  // above and below
  EXPECT_LT(found[1].cost, found[2].cost);  // once around
  const std::set<std::vector<std::int32_t>> words{found[0].passed, found[1].passed, found[2].passed};
  EXPECT_EQ(words.size(), 3U);
  EXPECT_TRUE(words.contains({}));
  EXPECT_TRUE(words.contains({1}));
  EXPECT_EQ(cheapest_classes(weights, field, cuts, start, goal, {.count = 3, .stretch = 1.2}, execution).size(), 2U);
}

void expect_path(const Bitmap& blocked, const class_oracle::Weigh& weigh, const HoleCuts& cuts, const ClassPath& path) {
  std::uint64_t cost = 0;
  std::vector<std::int32_t> passed;
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    const Cell from = path.cells[i - 1];
    const unsigned step = step_between(from, path.cells[i]);
    ASSERT_TRUE(grid_oracle::may_step(blocked, static_cast<int>(from.x), static_cast<int>(from.y), cell_steps[step][0],
                                      cell_steps[step][1], Diagonal::sqrt2));
    cost += weigh(from, path.cells[i]);
    if (const std::int32_t letter = cuts.letter(from, step)) class_oracle::append(passed, letter);
  }
  EXPECT_EQ(cost, path.cost);
  EXPECT_EQ(passed, path.passed);
  EXPECT_EQ(cuts.word(middles(path.cells)), path.passed);
}

void expect_classes(std::uint64_t seed, bool is_weighed) {
  SCOPED_TRACE(seed);
  SequentialRng rng(seed);
  const auto size = static_cast<std::uint32_t>(6 + rng.below(7));
  Bitmap blocked(size, size);
  const std::uint64_t share = 6 + rng.below(20);
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      if (rng.below(100) < share) blocked.set(x, y);
    }
  }
  const Cell start{0, static_cast<std::uint32_t>(rng.below(size))};
  const Cell goal{size - 1, static_cast<std::uint32_t>(rng.below(size))};
  blocked.clear(start.x, start.y);
  blocked.clear(goal.x, goal.y);
  const double least = static_cast<double>(rng.below(3));
  const std::size_t count = 1 + rng.below(8);
  const double stretch = 1.0 + 0.25 * static_cast<double>(rng.below(8));
  const class_oracle::Weigh weigh = [&](Cell a, Cell b) -> std::uint64_t {
    const bool diagonal = a.x != b.x && a.y != b.y;
    std::uint64_t weight = diagonal ? units_a_diagonal : units_a_cell;
    if (is_weighed) weight += 7 * (std::uint64_t{a.x + b.x} * 977 + std::uint64_t{a.y + b.y} * 4099) % 90'001 * 5;
    return weight;
  };
  const Execution execution;
  StepWeights weights(
      blocked,
      [&](Cell from, unsigned direction) {
        const Cell to{from.x + static_cast<std::uint32_t>(cell_steps[direction][0]),
                      from.y + static_cast<std::uint32_t>(cell_steps[direction][1])};
        return weigh(from, to);
      },
      execution);
  const PriceField::Goal goals[] = {{goal}};
  const Cell towards[] = {start};
  PriceField field(weights, goals, towards, execution);
  const HoleCuts cuts(blocked, least, execution);
  const auto found =
      cheapest_classes(weights, field, cuts, start, goal, {.count = count, .stretch = stretch}, execution);
  const std::vector<Cell> rays = class_oracle::ray_starts(blocked, least);
  ASSERT_EQ(cuts.holes().size(), rays.size());
  const auto expected = class_oracle::cheapest(blocked, rays, weigh, start, goal, count, stretch);
  if (!expected) return;
  std::vector<std::uint64_t> costs;
  std::set<class_oracle::Word> words;
  for (const ClassPath& path : found) {
    costs.push_back(path.cost);
    words.insert(class_oracle::word_of(rays, path.cells));
    ASSERT_EQ(path.cells.front(), start);
    ASSERT_EQ(path.cells.back(), goal);
    expect_path(blocked, weigh, cuts, path);
  }
  EXPECT_EQ(costs, *expected);
  EXPECT_EQ(words.size(), found.size());
}

TEST(PathClasses, AreThoseOfOtherCutsOnRandomMaps) {
  for (const std::uint64_t seed : test::seeds(500, 12)) expect_classes(seed, false);
}

TEST(PathClasses, AreThoseOfOtherCutsOnRandomMapsWithWeights) {
  for (const std::uint64_t seed : test::seeds(500, 12, 1'001)) expect_classes(seed, true);
}

}  // namespace
}  // namespace warren
