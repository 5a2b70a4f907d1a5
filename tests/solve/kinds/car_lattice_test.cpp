// SPDX-License-Identifier: BSD-3-Clause
// The lattice of a car on maps: its search against a plain Dijkstra over the same motions, its estimate against what is
// left, its stamps and paths against poses sampled densely and squares.
#include "solve/kinds/car_lattice.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_oracle.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

using body_oracle::Shape;

constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();

RobotSpec car(SteeringKind steering, double turning_radius, double long_half = 1.6, double wide_half = 0.9) {
  RobotSpec robot{.kind = RobotKind::car, .turning_radius = turning_radius, .steering = steering};
  robot.outline = {{-0.5 * long_half, -wide_half},
                   {1.5 * long_half, -wide_half},
                   {1.5 * long_half, wide_half},
                   {-0.5 * long_half, wide_half}};
  return robot;
}

/// Cells of side 1, some of them blocked, but none near the ends.
Scene random_map(std::uint64_t seed, std::uint32_t side, double share, std::initializer_list<Vec2> kept_free) {
  Scene scene;
  scene.map.emplace();
  scene.map->blocked = Bitmap(side, side);
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      bool is_near = false;
      for (const Vec2 p : kept_free) is_near = is_near || std::hypot(x + 0.5 - p.x, y + 0.5 - p.y) < 4.0;
      if (!is_near && uniform(seed, y * side + x, 0) < share) scene.map->blocked.set(x, y);
    }
  }
  add_map_walls(scene, {});
  return scene;
}

struct Task {
  Scene scene;
  RobotSpec robot;
  Se2 start;
  Se2 goal;
  CarLatticeOptions options;
  std::optional<CarBody> body;
  std::optional<CarLattice> lattice;

  void make(const Execution& execution) {
    body.emplace(scene, CarOptions{.turning_radius = robot.turning_radius, .outline = robot.outline}, execution);
    const auto shortest = robot.steering == SteeringKind::dubins        ? DubinsCurve::shortest
                          : robot.steering == SteeringKind::reeds_shepp ? ReedsSheppCurve::shortest
                                                                        : DifferentialCurve::shortest;
    lattice.emplace(*body, scene, robot, shortest, start, std::span(&goal, 1), options, execution);
  }
};

const Execution execution;

/// Start and goal in two corners, on states or off them.
Task task(std::uint64_t seed, bool on_states) {
  Task task;
  constexpr std::uint32_t side = 22;
  const auto near = [&](std::uint64_t axis, double middle) {
    return on_states ? middle + 0.5 : middle + uniform(seed, 1'000'000, axis);
  };
  task.start = {near(0, 4.0), near(1, 4.0), on_states ? 0.0 : uniform(seed, 1'000'000, 2)};
  task.goal = {near(3, 17.0), near(4, 17.0), on_states ? std::atan2(1.0, 2.0) : 6.0 * uniform(seed, 1'000'000, 5)};
  task.scene = random_map(seed, side, 0.06, {task.start.position(), task.goal.position()});
  task.robot = car(seed % 2 == 0 ? SteeringKind::dubins : SteeringKind::reeds_shepp, seed % 3 == 0 ? 2.0 : 3.0);
  task.options.headings = seed % 4 < 3 ? 16 : 32;
  if (seed % 2 == 1 && seed % 5 < 2) task.options.price = {.cusp = 2.0, .reverse = 1.5};
  if (seed % 7 == 0) {
    task.robot.steering = SteeringKind::differential;
    task.options.turn_cost = seed % 14 == 0 ? 2.0 : 0.1;
  }
  return task;
}

/// What is left to pay from each state (x, y, heading, last gear: 0 of none): backwards by the definition, over edges
/// that are listed first.
class Oracle {
 public:
  Oracle(CarLattice& lattice, std::uint64_t gear_change)
      : width_(lattice.width()),
        headings_(lattice.headings()),
        count_(std::size_t{3} * width_ * lattice.height() * headings_) {
    into_.resize(count_);
    shots_.resize(count_, never);
    joins_.resize(count_);
    for (std::uint32_t y = 0; y < lattice.height(); ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) {
        for (std::uint32_t k = 0; k < headings_; ++k) add({x, y}, k, lattice, gear_change);
      }
    }
  }
  std::size_t number(Cell cell, std::uint32_t heading, int gear) const {
    return ((std::size_t{cell.y} * width_ + cell.x) * headings_ + heading) * 3 + static_cast<std::size_t>(gear + 1);
  }
  /// By number; with shots from everywhere, or from where they are joins.
  std::vector<std::uint64_t> left(bool all_shots) const {
    using Open = std::pair<std::uint64_t, std::size_t>;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    std::vector<std::uint64_t> left(count_, never);
    const auto reach = [&](std::size_t state, std::uint64_t cost) {
      if (cost >= left[state]) return;
      left[state] = cost;
      open.emplace(cost, state);
    };
    for (std::size_t state = 0; state < count_; ++state) {
      if (all_shots || joins_[state]) reach(state, shots_[state]);
    }
    while (!open.empty()) {
      const auto [cost, state] = open.top();
      open.pop();
      if (cost > left[state]) continue;
      for (const auto& [before, step] : into_[state]) reach(before, cost + step);
    }
    return left;
  }

 private:
  void add(Cell cell, std::uint32_t heading, CarLattice& lattice, std::uint64_t gear_change) {
    for (const LatticeMotion& motion : lattice.motions_from(heading)) {
      const std::int64_t to_x = std::int64_t{cell.x} + motion.dx;
      const std::int64_t to_y = std::int64_t{cell.y} + motion.dy;
      if (to_x < 0 || to_y < 0 || to_x >= lattice.width() || to_y >= lattice.height()) continue;
      if (!lattice.is_free(cell, motion)) continue;
      const Cell to{static_cast<std::uint32_t>(to_x), static_cast<std::uint32_t>(to_y)};
      for (const int gear : {-1, 0, 1}) {
        const int next = motion.gear == 0 ? gear : motion.gear;
        const std::uint64_t change = gear != 0 && next != gear ? gear_change : 0;
        into_[number(to, motion.to, next)].emplace_back(number(cell, heading, gear), motion.cost + change);
      }
    }
    for (const int gear : {-1, 0, 1}) {
      const std::size_t state = number(cell, heading, gear);
      joins_[state] = lattice.joins(cell);
      const auto shot = lattice.shot(cell, heading, static_cast<std::int8_t>(gear), never, gear_change);
      if (shot) shots_[state] = shot->cost;
    }
  }

  std::size_t width_;
  std::size_t headings_;
  std::size_t count_;
  std::vector<std::vector<std::pair<std::size_t, std::uint64_t>>> into_;
  std::vector<std::uint64_t> shots_;
  std::vector<bool> joins_;
};

LatticeSolution searched(Task& task, double gap, std::size_t judge_bytes = 0, const Execution& on = execution) {
  LatticeSearchOptions options;
  options.gear_change = task.lattice->units_of(task.options.price.cusp);
  options.gap = gap;
  options.judge_bytes = judge_bytes;
  return LatticeSearch(*task.lattice, options, on).run();
}

TEST(CarLattice, FindsWhatAPlainDijkstraFindsAndItsEstimateNeverExceedsIt) {
  std::size_t found = 0;
  std::vector<std::uint64_t> seeds = test::seeds(500, 1);
  seeds.push_back(436);  // whose only way ends with a curve from afar
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    Task asked = task(seed, true);
    asked.make(execution);
    CarLattice& lattice = *asked.lattice;
    const std::uint64_t change = lattice.units_of(asked.options.price.cusp);
    const Oracle oracle(lattice, change);
    const std::vector<std::uint64_t> joins = oracle.left(false);
    const std::vector<std::uint64_t> shots = oracle.left(true);
    const std::size_t start = oracle.number(lattice.starts().front().cell, lattice.starts().front().heading, 0);
    const LatticeSolution solution = searched(asked, 0.0);
    ASSERT_EQ(solution.found(), shots[start] != never);
    for (std::uint32_t y = 0; y < lattice.height(); ++y) {
      for (std::uint32_t x = 0; x < lattice.width(); ++x) {
        for (std::uint32_t k = 0; k < lattice.headings(); ++k)
          ASSERT_LE(lattice.at_least({x, y}, k), joins[oracle.number({x, y}, k, 0)]) << x << " " << y << " " << k;
      }
    }
    if (!solution.found()) continue;
    ++found;
    EXPECT_EQ(solution.ended_by, "optimum");
    EXPECT_LE(solution.path.cost, joins[start]);
    EXPECT_GE(solution.path.cost, shots[start]);
    EXPECT_EQ(solution.bound, std::min(solution.path.cost, joins[start]));
    // Rounds before the last keep what they prove.
    const LatticeSolution early = searched(asked, 0.5);
    EXPECT_LE(early.bound, joins[start]);
    EXPECT_LE(static_cast<double>(early.path.cost), 1.5 * static_cast<double>(joins[start]));
    EXPECT_GE(early.path.cost, solution.path.cost);
  }
  if (test::asks_all()) EXPECT_GE(found, 250U);
}

TEST(CarLattice, EstimatesFallByNoMoreThanAMotionCosts) {
  for (const std::uint64_t seed : test::seeds(40, 2)) {
    SCOPED_TRACE(seed);
    Task asked = task(seed, false);
    asked.make(execution);
    CarLattice& lattice = *asked.lattice;
    for (std::uint32_t y = 0; y < lattice.height(); ++y) {
      for (std::uint32_t x = 0; x < lattice.width(); ++x) {
        for (std::uint32_t k = 0; k < lattice.headings(); ++k) {
          const std::uint64_t here = lattice.at_least({x, y}, k);
          for (const LatticeMotion& motion : lattice.motions_from(k)) {
            const std::int64_t to_x = std::int64_t{x} + motion.dx;
            const std::int64_t to_y = std::int64_t{y} + motion.dy;
            if (to_x < 0 || to_y < 0 || to_x >= lattice.width() || to_y >= lattice.height()) continue;
            if (!lattice.is_free({x, y}, motion)) continue;
            const std::uint64_t there =
                lattice.at_least({static_cast<std::uint32_t>(to_x), static_cast<std::uint32_t>(to_y)}, motion.to);
            ASSERT_NE(here, never) << "the middle of a free motion";
            ASSERT_LE(here, motion.cost + there);
          }
        }
      }
    }
  }
}

Shape placed_shape(const Shape& outline, const Se2& pose) {
  Shape there;
  for (const Vec2 p : outline) {
    there.push_back({pose.x + std::cos(pose.theta) * p.x - std::sin(pose.theta) * p.y,
                     pose.y + std::sin(pose.theta) * p.x + std::cos(pose.theta) * p.y});
  }
  return there;
}

/// Does the body overlap a blocked cell or leave the map, at poses so densely along a leg?
bool collides(const OccupancyMap& map, const Shape& outline, const Se2& a, const Se2& b) {
  const double turn = std::remainder(b.theta - a.theta, 2.0 * M_PI);
  const double chord = std::hypot(b.x - a.x, b.y - a.y);
  const int pieces = 1 + static_cast<int>(40.0 * (chord + 3.0 * std::abs(turn)));
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    Se2 pose{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.theta + t * turn};
    if (std::abs(turn) > 1e-9) {  // about the middle of the circle through both
      const double signed_chord =
          (b.x - a.x) * std::cos(a.theta + 0.5 * turn) + (b.y - a.y) * std::sin(a.theta + 0.5 * turn);
      const double radius = 0.5 * signed_chord / std::sin(0.5 * turn);
      pose.x = a.x + radius * (std::sin(pose.theta) - std::sin(a.theta));
      pose.y = a.y - radius * (std::cos(pose.theta) - std::cos(a.theta));
    }
    const Shape body = placed_shape(outline, pose);
    for (const Vec2 p : body) {
      if (p.x < 0.0 || p.y < 0.0 || p.x > map.width() || p.y > map.height()) return true;
    }
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (!map.blocked.test(x, y) || std::hypot(x + 0.5 - pose.x, y + 0.5 - pose.y) > 5.0) continue;
        const Shape square{{1.0 * x, 1.0 * y}, {x + 1.0, 1.0 * y}, {x + 1.0, y + 1.0}, {1.0 * x, y + 1.0}};
        if (!(body_oracle::between(body, square) > 0.0)) return true;
      }
    }
  }
  return false;
}

TEST(CarLattice, PathsMeetNothingAndEndWhereTheyShall) {
  std::size_t found = 0;
  for (const std::uint64_t seed : test::seeds(2000, 6)) {
    SCOPED_TRACE(seed);
    Task asked = task(seed, false);
    asked.make(execution);
    const LatticeSolution solution = searched(asked, 0.1);
    if (!solution.found()) continue;
    ++found;
    const Path<Se2> poses = asked.lattice->poses(solution.path);
    EXPECT_EQ(poses.front(), asked.start);
    EXPECT_EQ(poses.back().position(), asked.goal.position());
    double cost = 0.0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      ASSERT_FALSE(collides(*asked.scene.map, asked.robot.outline, poses[i - 1], poses[i])) << "leg " << i;
      const double half = 0.5 * std::remainder(poses[i].theta - poses[i - 1].theta, 2.0 * M_PI);
      const double chord = distance(poses[i].position(), poses[i - 1].position());
      cost += std::abs(half) < 1e-9 ? chord : chord * half / std::sin(half);
    }
    const bool has_prices = asked.options.price.cusp > 0.0 || asked.options.turn_cost > 0.0;
    const double told = asked.lattice->unit() * static_cast<double>(solution.path.cost);
    EXPECT_LE(cost, told + 1e-4 * told);
    if (!has_prices) {
      EXPECT_NEAR(cost, told, 1e-4 * told);
    }
  }
  EXPECT_GE(found, test::share(1000, 2));
}

TEST(SweptStamps, HoldEveryCellThatADenseSweepTouches) {
  for (const std::uint64_t seed : test::seeds(24, 1)) {
    SCOPED_TRACE(seed);
    const RobotSpec robot = car(SteeringKind::reeds_shepp, 2.0 + 2.0 * uniform(seed, 0, 0), 1.0 + uniform(seed, 0, 1),
                                0.4 + uniform(seed, 0, 2));
    const MotionSet motions({.headings = seed % 2 == 0 ? 16U : 32U,
                             .turning_radius = robot.turning_radius,
                             .reverses = true,
                             .turns_on_spot = seed % 3 == 0},
                            execution);
    const SweptStamps stamps(motions, robot.outline, 0.0, execution);
    FreeCells map(Bitmap(80, 80));
    const Cell origin{40, 40};
    const auto every = static_cast<std::uint32_t>(test::share(3, 12));
    for (std::uint32_t k = static_cast<std::uint32_t>(seed) % every; k < motions.headings(); k += every) {
      for (const LatticeMotion& motion : motions.from(k)) {
        ASSERT_TRUE(stamps.is_free(map, origin, motion)) << k;
        const Se2 from{0.0, 0.0, motions.heading_rad(k)};
        const Se2 to{1.0 * motion.dx, 1.0 * motion.dy, motions.heading_rad(motion.to)};
        const SteeringCurve curve(from, to, motion.word, robot.turning_radius);
        const Se2 last = curve.at(curve.length() * (1.0 - 1e-12));
        EXPECT_NEAR(last.x, to.x, 1e-9);
        EXPECT_NEAR(last.y, to.y, 1e-9);
        EXPECT_NEAR(std::remainder(last.theta - to.theta, 2.0 * M_PI), 0.0, 1e-9);
        std::size_t touched_alone = 0;
        for (int i = 0; i <= 24; ++i) {
          const Shape body = placed_shape(robot.outline, curve.at(curve.length() * i / 24.0));
          for (std::int32_t y = -9; y <= 9; ++y) {
            for (std::int32_t x = -9; x <= 9; ++x) {
              const Shape square{{x - 0.5, y - 0.5}, {x + 0.5, y - 0.5}, {x + 0.5, y + 0.5}, {x - 0.5, y + 0.5}};
              if (std::hypot(x - body[0].x, y - body[0].y) > 6.0 || body_oracle::between(body, square) > 1e-12)
                continue;
              const Cell cell{static_cast<std::uint32_t>(40 + x), static_cast<std::uint32_t>(40 + y)};
              map.change(cell, false);
              ASSERT_FALSE(stamps.is_free(map, origin, motion)) << k << " " << x << " " << y;
              map.change(cell, true);
              ++touched_alone;
            }
          }
        }
        EXPECT_GT(touched_alone, 0U);
      }
    }
  }
}

/// What hybrid A* of others lets pass: a cell wholly inside of the outline, and a wall that lies between two poses.
TEST(SweptStamps, SeeWhatIsInsideOfTheBodyAndBetweenPoses) {
  const MotionSet motions({.headings = 16, .turning_radius = 4.0}, execution);
  const std::vector<Vec2> big{{-3.3, -3.3}, {3.3, -3.3}, {3.3, 3.3}, {-3.3, 3.3}};
  const std::vector<Vec2> small{{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}};
  const SweptStamps of_big(motions, big, 0.0, execution);
  const SweptStamps of_small(motions, small, 0.0, execution);
  Bitmap inside(40, 40);
  inside.set(20, 20);
  Bitmap between(40, 40);
  for (std::uint32_t y = 0; y < 40; ++y) between.set(22, y);
  const LatticeMotion& one = motions.from(0)[0];
  const LatticeMotion& far = motions.from(0)[1];
  ASSERT_EQ(one.dx, 1);
  ASSERT_EQ(far.dx, 4);
  EXPECT_TRUE(of_big.is_free(FreeCells(Bitmap(40, 40)), {20, 20}, one));
  EXPECT_FALSE(of_big.is_free(FreeCells(inside), {20, 20}, one));
  EXPECT_TRUE(of_small.is_free(FreeCells(between), {20, 20}, one));
  EXPECT_FALSE(of_small.is_free(FreeCells(between), {20, 20}, far));
  EXPECT_FALSE(of_small.is_free(FreeCells(Bitmap(40, 40)), {37, 20}, far)) << "over the rim";
}

TEST(CarLattice, IsTheSameForAnyNumberOfThreads) {
  std::vector<std::uint64_t> costs;
  for (const unsigned threads : {1U, 2U, 3U}) {
    Execution on;
    on.threads = threads;
    Task asked = task(3, false);
    asked.make(on);
    const LatticeSolution solution = searched(asked, 0.0);
    costs.push_back(solution.path.cost);
    costs.push_back(solution.expanded);
  }
  EXPECT_EQ(costs, (std::vector{costs[0], costs[1], costs[0], costs[1], costs[0], costs[1]}));
}

TEST(CarLattice, MemoryForTheJudgeIsKeptBackOnceThereIsAPath) {
  const Deadline all(std::numeric_limits<double>::infinity(), resident_bytes() + (std::size_t{1} << 32U));
  Execution on;
  on.deadline = &all;
  std::size_t cut = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Task asked = task(seed, false);
    asked.make(execution);
    const LatticeSolution whole = searched(asked, 0.0, 0, on);
    if (!whole.found() || whole.rounds == 1) continue;
    const LatticeSolution first = searched(asked, 0.0, std::size_t{1} << 40U, on);  // more than there is
    EXPECT_TRUE(first.found());
    EXPECT_EQ(first.ended_by, "memory");
    EXPECT_EQ(first.rounds, 1U);
    ++cut;
  }
  EXPECT_GT(cut, 0U);
}

/// Nothing is met, and of the search's lists the open one alone grows.
struct BlockedStarts {
  std::vector<LatticeStart> all;

  static std::uint32_t width() { return 1; }
  static std::uint32_t height() { return 1; }
  static std::uint32_t headings() { return 1; }
  static std::span<const LatticeMotion> motions_from(std::uint32_t) { return {}; }
  static bool is_free(Cell, const LatticeMotion&) { return false; }
  static std::uint64_t extra(Cell, std::uint32_t, const LatticeMotion&) { return 0; }
  static std::uint64_t at_least(Cell, std::uint32_t) { return 0; }
  std::span<const LatticeStart> starts() const { return all; }
  static bool is_free_start(std::size_t) { return false; }
  static bool joins(Cell) { return false; }
  static std::optional<LatticeShot> shot(Cell, std::uint32_t, std::int8_t, std::uint64_t, std::uint64_t) { return {}; }
  static std::optional<LatticeShot> direct_shot(std::uint64_t, std::uint64_t) { return {}; }
  static std::uint64_t shot_pause(std::uint64_t) { return 1; }
};

TEST(CarLattice, TheOpenListAsksForItsMemory) {
  BlockedStarts space{.all = std::vector<LatticeStart>(100'000)};
  const LatticeSearchOptions options;
  EXPECT_FALSE(LatticeSearch(space, options, execution).run().found());
  const Deadline all(std::numeric_limits<double>::infinity(), resident_bytes() + (std::size_t{1} << 32U));
  const Deadline counted(&all, CountedRoom{std::size_t{1} << 20U});  // of 1.6 MB
  Execution on;
  on.deadline = &counted;
  LatticeSearch search(space, options, on);
  EXPECT_EQ(stopped_by([&] { search.run(); }), StopReason::memory);
}

TEST(CarLattice, ShortGoalsInTheOpenAreDrivenStraightThere) {
  for (const std::uint64_t seed : test::seeds(10'000, 6)) {
    SCOPED_TRACE(seed);
    Task asked;
    asked.robot = car(seed % 2 == 0 ? SteeringKind::dubins : SteeringKind::reeds_shepp, 3.0);
    asked.scene = random_map(seed, 60, 0.0, {});
    asked.start = {30.0 + uniform(seed, 0, 0), 30.0 + uniform(seed, 0, 1), 6.0 * uniform(seed, 0, 2)};
    const double way = 12.0 * uniform(seed, 0, 3);
    const double angle = 6.3 * uniform(seed, 0, 4);
    asked.goal = {asked.start.x + way * std::cos(angle), asked.start.y + way * std::sin(angle),
                  6.0 * uniform(seed, 0, 5)};
    asked.make(execution);
    const LatticeSolution solution = searched(asked, 0.05);
    ASSERT_TRUE(solution.found());
    const double free_length = 3.0 * (asked.robot.steering == SteeringKind::dubins
                                          ? DubinsCurve::shortest(asked.start, asked.goal, 3.0).length
                                          : ReedsSheppCurve::shortest(asked.start, asked.goal, 3.0).length);
    EXPECT_LE(asked.lattice->unit() * static_cast<double>(solution.path.cost), 1.1 * free_length + 1e-6);
  }
}

}  // namespace
}  // namespace warren
