// SPDX-License-Identifier: BSD-3-Clause
// A disc on an open map with blocks that are dear to be near to: the backward field alone (weights that are known, and
// weights that are made), a whole question beside the A* of one that has no prices, four other ways, and the question
// asked again after 100 cells have changed on its path.
#include <benchmark/benchmark.h>

#include <iterator>
#include <vector>

#include "bench/report.hpp"
#include "core/base/rng.hpp"
#include "planners/grid/grid_search.hpp"
#include "planners/grid/price_field.hpp"
#include "planners/shorten/taut_path.hpp"
#include "solve/replanner.hpp"
#include "solve/solve.hpp"
#include "worlds/plane/grid_world.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {
namespace {

constexpr std::uint32_t map_side = 600;
constexpr double cell = 0.05;
constexpr double radius = 0.2;

/// What a question is asked on.
struct PricedMap {
  OccupancyMap map;
  Prices prices;
  Cell start{30, 30};
  Cell goal{map_side - 31, map_side - 41};

  PricedMap() {
    map.blocked = Bitmap(map_side, map_side);
    map.cell = cell;
    prices.clearance = ClearancePrice{3.0, 0.5};
    for (std::uint64_t i = 0; i < 120; ++i) {
      const auto at = [&](std::uint64_t axis) {
        return static_cast<std::uint32_t>(50 + random_bits(1, i, axis) % (map_side - 124));
      };
      for (std::uint32_t y = at(1); y < at(1) + 12; ++y) map.blocked.set_run(y, at(0), at(0) + 24);
    }
  }
  Bitmap wide() const { return blocked_for_disc(map.blocked, radius / cell, bench::one_thread); }
  StepWeights weights(const MapPrices& made, MapPrices::Scratch& scratch) const {
    return {wide(), [&](Cell from, unsigned direction) { return made.step_up(from, direction, scratch); },
            bench::one_thread};
  }
  Question question() const {
    Question question;
    question.robot = {.kind = RobotKind::disc, .radius = radius};
    question.start = {cell * (start.x + 0.5), cell * (start.y + 0.5)};
    question.goal = {cell * (goal.x + 0.5), cell * (goal.y + 0.5)};
    question.prices = prices;
    return question;
  }
  Scene scene() const {
    Scene scene;
    scene.map = map;
    return scene;
  }
};

/// range(0): 0 weights are made on the way, 1 they are known.
void price_field(benchmark::State& state) {
  const PricedMap world;
  const MapPrices prices(world.map, radius, world.prices, bench::one_thread);
  MapPrices::Scratch scratch;
  const PriceField::Goal goals[] = {{world.goal}};
  const auto settle = [&](StepWeights& weights) {
    PriceField field(weights, goals, {}, bench::one_thread);
    field.settle_all(bench::one_thread);
    return field.expanded();
  };
  StepWeights known = world.weights(prices, scratch);
  const std::uint64_t cells = settle(known);
  for (auto _ : state) {
    if (state.range(0) != 0) {
      settle(known);
    } else {
      StepWeights made = world.weights(prices, scratch);
      settle(made);
    }
  }
  bench::report(state, cells, 24 * cells);
  state.SetLabel(state.range(0) != 0 ? "weights known" : "weights made");
}
BENCHMARK(price_field)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// range(0): 0 A* without prices, 1 distances, weights, field and pulling taut. Both make the map wide for the disc.
void one_question(benchmark::State& state) {
  const PricedMap world;
  const bool is_priced = state.range(0) != 0;
  for (auto _ : state) {
    if (!is_priced) {
      const Bitmap wide = world.wide();
      GridSearch search(wide);
      benchmark::DoNotOptimize(search.find(world.start, world.goal, {}, bench::one_thread));
      continue;
    }
    const MapPrices prices(world.map, radius, world.prices, bench::one_thread);
    MapPrices::Scratch scratch;
    StepWeights weights = world.weights(prices, scratch);
    const PriceField::Goal goals[] = {{world.goal}};
    const Cell towards[] = {world.start};
    PriceField field(weights, goals, towards, bench::one_thread);
    bench::check(field.cost(world.start, bench::one_thread).has_value(), "priced field");
    const GridWorld free(world.map, radius, *prices.distances());
    GridWorld::Query query;
    const PricedLegs legs{[&](Vec2 a, Vec2 b) { return prices.cost(a, b, scratch); },
                          [&](Vec2 a, Vec2 b) { return free.is_free_motion(a, b, query); }, cell};
    Path<Vec2> path;
    for (const Cell at : field.path(world.start, bench::one_thread).first) path.push_back(cell_centre(world.map, at));
    benchmark::DoNotOptimize(priced_taut(std::move(path), legs, bench::one_thread));
  }
  state.SetLabel(is_priced ? "priced" : "A*, no prices");
}
BENCHMARK(one_question)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// range(0): other ways that are asked for; range(1): 1 with prices.
void alternatives(benchmark::State& state) {
  const PricedMap world;
  const Scene scene = world.scene();
  Question question = world.question();
  if (state.range(1) == 0) question.prices = {};
  if (state.range(0) > 0) question.route.alternatives = state.range(0);
  for (auto _ : state) {
    const Answer answer = solve(scene, question, {.planner = PlannerKind::grid}, {.threads = 1});
    bench::check(answer.verified && std::ssize(answer.alternatives) == state.range(0), "alternatives");
  }
  state.SetLabel(state.range(1) != 0 ? "priced" : "no prices");
}
BENCHMARK(alternatives)->ArgsProduct({{0, 4}, {0, 1}})->Unit(benchmark::kMillisecond);

/// range(0): 0 solved afresh, 1 by a Replanner. A block of 10 x 10 cells comes and goes again, range(1): 0 on the last
/// path, farther along each time; 1 anywhere that leaves start and goal free.
void replan(benchmark::State& state) {
  const PricedMap world;
  const Question question = world.question();
  const Scene scene = world.scene();
  const SolveOptions options{.planner = PlannerKind::grid};
  const Limits limits{.threads = 1};
  Replanner replanner(scene, question, options, limits);
  const auto answered = [&] {
    return state.range(0) != 0 ? replanner.solve() : solve(replanner.scene(), question, options, limits);
  };
  Answer answer = answered();
  std::uint64_t round = 0;
  const auto corner = [&] {
    if (state.range(1) == 0) {
      const Vec2 on = answer.path[1 + round % (answer.path.size() - 2)];
      return Cell{static_cast<std::uint32_t>(on.x / cell) - 5, static_cast<std::uint32_t>(on.y / cell) - 5};
    }
    const auto at = [&](std::uint64_t axis) {
      return 50 + static_cast<std::uint32_t>(random_bits(2, round, axis) % (map_side - 124));
    };
    return Cell{at(0), at(1)};
  };
  for (auto _ : state) {
    bench::check(answer.outcome == Outcome::solved, "replanned");
    const Cell low = corner();
    ++round;
    std::vector<CellChange> come;
    std::vector<CellChange> gone;
    for (std::uint32_t y = low.y; y < low.y + 10; ++y) {
      for (std::uint32_t x = low.x; x < low.x + 10; ++x) {
        come.push_back({{x, y}, true});
        gone.push_back({{x, y}, world.map.blocked.test(x, y)});
      }
    }
    replanner.update(come);
    benchmark::DoNotOptimize(answered());
    replanner.update(gone);
    answer = answered();
  }
  state.SetItemsProcessed(2 * static_cast<std::int64_t>(state.iterations()));
  state.SetLabel(state.range(0) != 0 ? "replanned" : "afresh");
}
BENCHMARK(replan)->ArgsProduct({{0, 1}, {0, 1}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace warren
