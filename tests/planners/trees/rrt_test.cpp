// SPDX-License-Identifier: BSD-3-Clause
#include "planners/trees/rrt_connect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/base/error.hpp"
#include "planners/shorten/shortcut.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/plane/maze_world.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {
namespace {

using body_scenes::hook;
using body_scenes::kite;

/// What the reports call poly-easy: ten convex polygons and a kite.
Scene poly_easy() {
  Scene scene;
  scene.bounds = Box{{-4.29, -2.32}, {5.12, 2.78}};
  const std::vector<std::vector<double>> polygons = {
      {0.81, -0.87, 1.03, -1.32, 1.49, -1.38, 1.76, -1.01, 1.31, -0.47, 0.81, -0.51},
      {0.32, 0.90, 1.22, 0.71, 1.22, 1.39, 1.03, 1.60, 0.78, 1.56, 0.53, 1.42, 0.35, 1.11},
      {-0.34, 1.75, 0.29, 1.85, 0.19, 2.55, 0.17, 2.59, -0.32, 2.68},
      {2.01, 0.10, 2.18, -0.15, 2.39, -0.25, 2.74, -0.09, 2.89, 0.13, 2.76, 0.51, 2.31, 0.58},
      {-1.81, 0.41, -1.73, -0.37, -0.96, -0.42, -1.25, 0.06, -1.60, 0.32},
      {-0.55, -0.22, 0.10, 0.07, 0.23, 0.13, 0.25, 0.18, 0.29, 0.62, -0.16, 0.72},
      {2.01, -1.07, 2.02, -1.08, 2.61, -0.82, 2.92, -0.57, 2.74, -0.34, 2.30, -0.36},
      {-2.09, 2.05, -1.88, 1.52, -1.53, 1.35, -1.32, 1.32, -1.27, 1.50, -1.33, 1.78, -1.37, 1.91, -1.64, 2.04, -2.04,
       2.13},
      {1.47, 1.45, 1.66, 1.34, 2.23, 1.12, 2.37, 1.39, 2.01, 1.90, 1.68, 1.94},
      {-1.19, -2.00, -1.11, -2.03, -0.54, -2.22, -0.53, -1.57, -0.90, -1.58, -1.08, -1.73, -1.18, -1.91}};
  for (const auto& numbers : polygons) {
    ScenePolygon polygon;
    for (std::size_t i = 0; i < numbers.size(); i += 2) polygon.corners.push_back({numbers[i], numbers[i + 1]});
    scene.polygons.push_back(polygon);
  }
  return scene;
}

constexpr Se2 easy_start{-3.14, 0.23, 0};
constexpr Se2 easy_goal{3.86, 0.23, 0};

double plane_length(const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }

using Planner = Solution<Se2> (*)(const AnyWorld<Se2>&, const Se2&, std::span<const Se2>, const RrtOptions&,
                                  const Execution&, PlannedRoadmap<Se2>*);
struct NamedPlanner {
  const char* name;
  Planner plan;
};
const std::vector<NamedPlanner> planners = {{"rrt", rrt<Se2, false>}, {"rrt-connect", rrt_connect<Se2, false>}};

void expect_verified(const Scene& scene, const std::vector<Vec2>& outline, const Path<Se2>& path,
                     const PoseVerifyOptions& options) {
  const Verification v = verify_se2(scene, outline, path, options, {});
  EXPECT_TRUE(v.verified) << v.first_violation.value_or(Violation{}).obstacle;
}

TEST(RrtConnect, SolvesPolyEasyForEverySeed) {
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  double best = 100.0;
  for (std::uint64_t seed = 1; seed <= test::share(100, 20); ++seed) {
    SCOPED_TRACE(seed);
    const auto solution =
        rrt_connect(WorldView(world), easy_start, std::span(&easy_goal, 1), {.places = false, .seed = seed}, {});
    ASSERT_EQ(solution.outcome, Outcome::solved);
    expect_verified(scene, kite, solution.path, {.start = easy_start, .goal = easy_goal});
    if (seed > 20) continue;
    Counters counters;
    const auto path = shortcut_path(WorldView(world), solution.path, plane_length, {.seed = seed}, {}, counters);
    expect_verified(scene, kite, path, {.start = easy_start, .goal = easy_goal});
    const double length = path_length(path, plane_length);
    EXPECT_LE(length, path_length(solution.path, plane_length) + 1e-12);
    EXPECT_GE(length, 7.0);  // straight on; the reference point is outside of the body and may cross obstacles
    best = std::min(best, length);
  }
  EXPECT_LE(best, 7.6);
}

TEST(RrtConnect, GoesOverFreePlacesBeforeAnythingIsDrawn) {
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  for (const double turn : {0.0, 0.3, 3.0}) {
    for (const bool backwards : {false, true}) {
      SCOPED_TRACE(std::to_string(turn) + (backwards ? " backwards" : ""));
      std::vector<Se2> ends{easy_start, {easy_goal.x, easy_goal.y, turn}};
      if (backwards) std::swap(ends[0], ends[1]);
      const auto solution = rrt_connect(WorldView(world), ends[0], std::span(&ends[1], 1), {.seed = 3}, {});
      ASSERT_EQ(solution.outcome, Outcome::solved);
      expect_verified(scene, kite, solution.path, {.start = ends[0], .goal = ends[1]});
      if (turn == 0.0 && !backwards) {  // backwards the way cuts a corner, and trees go on from what was free of it
        EXPECT_EQ(solution.counters.samples, 0U);
      }
      EXPECT_LT(solution.counters.edges_checked, 60U);
      const auto drawn =
          rrt_connect(WorldView(world), ends[0], std::span(&ends[1], 1), {.places = false, .seed = 3}, {});
      EXPECT_GT(drawn.counters.samples, 0U);
    }
  }
}

TEST(RrtConnect, GoesOverFreePlacesToTheNearestGoal) {
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  const std::vector<Se2> goals{{3.86, 0.23, 2.0}, {3.86, 0.23, 0.0}, {3.86, 0.23, -2.0}};
  const auto solution = rrt_connect(WorldView(world), easy_start, goals, {}, {});
  ASSERT_EQ(solution.outcome, Outcome::solved);
  EXPECT_EQ(solution.path.back(), goals[1]);
  EXPECT_EQ(solution.counters.samples, 0U);
  expect_verified(scene, kite, solution.path, {.start = easy_start, .goal = goals[1]});
}

/// No step leaves the cell of the goals, and these are so many that the start's tree grows alone.
TEST(RrtConnect, GoesAStepOnTowardsItsSampleWhereThereAreDomains) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {100, 100}};
  const std::vector<Vec2> cell{{89.5, 89.5}, {90.6, 89.5}, {90.6, 90.5}, {89.5, 90.5}};
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < 4; ++i) walls.push_back({cell[i], cell[(i + 1) % 4]});
  scene.walls = WallSet::narrowest(walls);
  const MazeWorld world(scene, 1e-6, {});
  std::vector<Vec2> goals;
  for (int i = 0; i < 600; ++i) goals.push_back({90.0 + 1e-4 * i, 90.0});
  const RrtOptions options{.sampler = SamplerKind::uniform, .step = 1.0, .domain = 1e6, .nodes = 900};
  const auto found = rrt_connect(WorldView(world), Vec2{50, 50}, goals, options, {});
  EXPECT_EQ(found.outcome, Outcome::not_connected);
  EXPECT_LT(found.counters.samples + 50, found.roadmap.milestones - goals.size()) << "one state a sample";
}

TEST(Rrt, SolvesScatteredScenesWithEverySampler) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = body_scenes::scattered(seed);
    const Se2World world(scene, hook, 0.02);
    auto query = world.make_query();
    std::vector<Se2> ends;
    for (std::uint64_t i = 0; ends.size() < 2; ++i) {
      const Se2 pose = body_scenes::random_pose(seed, i);
      if (world.is_free(pose, query)) ends.push_back(pose);
    }
    for (const NamedPlanner& planner : planners) {
      for (const SamplerKind sampler : {SamplerKind::uniform, SamplerKind::halton, SamplerKind::gaussian,
                                        SamplerKind::bridge, SamplerKind::mixture}) {
        SCOPED_TRACE(std::string(planner.name) + " seed " + std::to_string(seed) + " sampler " +
                     std::to_string(static_cast<int>(sampler)));
        const auto solution = planner.plan(WorldView(world), ends[0], std::span(&ends[1], 1),
                                           {.sampler = sampler, .seed = seed}, {}, nullptr);
        ASSERT_EQ(solution.outcome, Outcome::solved);
        expect_verified(scene, hook, solution.path, {.clearance = 0.02, .start = ends[0], .goal = ends[1]});
      }
    }
  }
}

TEST(RrtConnect, KeepsToTheBoxOfObstaclesWithoutBounds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene = body_scenes::scattered(seed);
    scene.bounds.reset();
    const Se2World world(scene, hook, {});
    auto query = world.make_query();
    std::vector<Se2> ends;
    for (std::uint64_t i = 0; ends.size() < 2; ++i) {
      const Se2 pose = body_scenes::random_pose(seed, i);
      if (world.is_free(pose, query)) ends.push_back(pose);
    }
    const auto solution = rrt_connect(WorldView(world), ends[0], std::span(&ends[1], 1), {.seed = seed}, {});
    ASSERT_EQ(solution.outcome, Outcome::solved);
    expect_verified(scene, hook, solution.path, {.start = ends[0], .goal = ends[1]});
  }
}

TEST(RrtConnect, JoinsNoPlaceBeyondTheBox) {
  Scene scene;
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{1.4, 1}, {7.2, 1}}, {{1.4, 5}, {7.2, 5}}});
  const Se2World world(scene, kite, {});
  auto query = world.make_query();
  MotionTree<Se2World> tree(world, GrowthDirection::forward);
  tree.add_root({7.0, 3, 0});
  Counters counters;
  const double beyond = std::nextafter(7.2, 8.0);
  EXPECT_TRUE(tree.join(0, {7.2, 3, 0}, query, counters).has_value());
  EXPECT_FALSE(tree.join(0, {beyond, 3, 0}, query, counters).has_value());
}

TEST(Rrt, IsTheSameForAnyNumberOfThreadsAndTrees) {
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  for (const NamedPlanner& planner : planners) {
    for (const std::uint32_t trees : {1U, 3U, 8U}) {
      SCOPED_TRACE(std::string(planner.name) + " trees " + std::to_string(trees));
      std::vector<Solution<Se2>> all;
      for (const unsigned threads : {1U, 2U, 3U, 8U}) {
        auto solution = planner.plan(WorldView(world), easy_start, std::span(&easy_goal, 1),
                                     {.trees = trees, .seed = 5}, {.threads = threads}, nullptr);
        Counters& counters = solution.counters;
        solution.path = shortcut_path(WorldView(world), solution.path, plane_length, {.rounds = 20},
                                      {.threads = threads}, counters);
        all.push_back(std::move(solution));
      }
      for (const auto& solution : all) {
        EXPECT_EQ(solution.path, all.front().path);
        EXPECT_EQ(solution.counters, all.front().counters);
        EXPECT_EQ(solution.roadmap.milestones, all.front().roadmap.milestones);
      }
    }
  }
}

/// They grow side by side, and none sees what the others have been granted.
TEST(Rrt, EachOfMoreTreesAsksForTheRoomOfAll) {
  using View = AnyWorld<Se2>;
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  const WorldView view(world);
  const std::span<const Se2> goal(&easy_goal, 1);
  const Deadline whole(std::numeric_limits<double>::infinity(), resident_bytes() + (std::size_t{1} << 32U));
  const auto asked = [&](const auto& grow) {
    constexpr std::size_t all = std::size_t{1} << 20U;
    const Deadline counted(&whole, CountedRoom{all});
    grow(Execution{.deadline = &counted});
    return all - counted.room();
  };
  const std::size_t alone = asked([&](const Execution& execution) {
    MotionTree<View> tree(view, GrowthDirection::forward);
    tree.add_root(easy_start);
    tree.ask_room(execution);
  });
  EXPECT_GT(alone, 0U);
  for (const std::uint32_t trees : {1U, 4U}) {
    const RrtOptions options{.trees = trees};
    const std::size_t of_rrt = asked([&](const Execution& execution) {
      detail::RrtSearch<View>(view, easy_start, goal, options, 0.5, 1).advance(1, execution);
    });
    const std::size_t of_pair = asked([&](const Execution& execution) {
      detail::RrtConnectSearch<View>(view, easy_start, goal, options, 0.5, 1).advance(1, execution);
    });
    EXPECT_EQ(of_rrt, trees * alone);
    EXPECT_GE(of_pair, 2 * trees * alone);
  }
}

TEST(Rrt, MoreTreesNeverTakeMoreBatches) {
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto rounds = [&](std::uint32_t trees) {
      return rrt(WorldView(world), easy_start, std::span(&easy_goal, 1), {.trees = trees, .seed = seed}, {})
          .counters.rounds;
    };
    EXPECT_LE(rounds(4), rounds(1)) << seed;
  }
}

TEST(RrtConnect, TakesTheGoalThatIsReached) {
  Scene scene = body_scenes::scattered(3);
  scene.polygons.push_back({{{8, 8}, {10, 8}, {10, 10}, {8, 10}}});
  const Se2World world(scene, hook, {});
  auto query = world.make_query();
  std::vector<Se2> free;
  for (std::uint64_t i = 0; free.size() < 2; ++i) {
    const Se2 pose = body_scenes::random_pose(3, i);
    if (world.is_free(pose, query)) free.push_back(pose);
  }
  const std::vector<Se2> goals = {{9, 9, 0}, free[1]};  // the first is blocked
  for (const NamedPlanner& planner : planners) {
    const auto solution = planner.plan(WorldView(world), free[0], goals, {}, {}, nullptr);
    ASSERT_EQ(solution.outcome, Outcome::solved) << planner.name;
    EXPECT_EQ(solution.path.back(), free[1]);
    EXPECT_EQ(planner.plan(WorldView(world), free[0], std::span(goals).first(1), {}, {}, nullptr).outcome,
              Outcome::goal_blocked);
    EXPECT_EQ(planner.plan(WorldView(world), goals[0], std::span(free), {}, {}, nullptr).outcome,
              Outcome::start_blocked);
  }
}

TEST(Rrt, GivesUpWhereThereIsNoWay) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{5, 0}, {5, 10}}});
  const Se2World world(scene, hook, {});
  const Se2 goal{8, 5, 0};
  for (const NamedPlanner& planner : planners) {
    SCOPED_TRACE(planner.name);
    PlannedRoadmap<Se2> keep;
    const auto solution =
        planner.plan(WorldView(world), {2, 5, 0}, std::span(&goal, 1), {.nodes = 300, .trees = 2}, {}, &keep);
    EXPECT_EQ(solution.outcome, Outcome::not_connected);
    EXPECT_TRUE(solution.path.empty());
    EXPECT_GE(solution.separation.nearest_gap, 0.0);
    EXPECT_LE(solution.separation.nearest_gap, 9.0);
    EXPECT_EQ(keep.states.size(), solution.roadmap.milestones + 2);
    EXPECT_EQ(keep.states.back().x < 5.0, std::string(planner.name) == "rrt");
  }
}

TEST(Rrt, StopsAtTheDeadline) {
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  const Deadline past(1e-9);
  const auto solution = rrt_connect(WorldView(world), easy_start, std::span(&easy_goal, 1), {}, {.deadline = &past});
  EXPECT_EQ(solution.outcome, Outcome::stopped);
  EXPECT_TRUE(solution.path.empty());
}

TEST(Rrt, ServesPointsAmongWallsToo) {
  const Scene scene = maze_scene({6, 6, 3, MazeAlgorithm::backtracker, 0.0}, false, {});
  const MazeWorld world(scene, 0.1, {});
  const Vec2 start{scene.start[0], scene.start[1]};
  const Vec2 goal{scene.goal[0], scene.goal[1]};
  const auto solution = rrt_connect(WorldView(world), start, std::span(&goal, 1), {}, {});
  ASSERT_EQ(solution.outcome, Outcome::solved);
  Counters counters;
  const auto path = shortcut_path(WorldView(world), solution.path, MazeWorld::distance, {}, {}, counters);
  EXPECT_LT(path_length(path, MazeWorld::distance), path_length(solution.path, MazeWorld::distance));
  for (const auto& p : {solution.path, path}) {
    EXPECT_TRUE(verify_path(scene, p, {.clearance = 0.1, .start = start, .goal = goal}, {}).verified);
  }
}

TEST(RrtConnect, TinyStepsNeitherPassTheLimitOfNodesNorGoOnForEver) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{5, 0}, {5, 1}}});
  const MazeWorld world(scene, 0.1, {});
  const Vec2 goal{9, 9};
  for (const double step : {1e-4, 1e-18}) {
    SCOPED_TRACE(step);
    const auto solution =
        rrt_connect(WorldView(world), Vec2{1, 1}, std::span(&goal, 1), {.step = step, .nodes = 500}, {});
    EXPECT_EQ(solution.outcome, Outcome::not_connected);
    EXPECT_LE(solution.roadmap.milestones, 501U);
  }
  const Deadline soon(0.05);
  const RrtOptions endless{.step = 1e-7, .nodes = most_samples};
  const auto stopped = rrt_connect(WorldView(world), Vec2{1, 1}, std::span(&goal, 1), endless, {.deadline = &soon});
  EXPECT_EQ(stopped.outcome, Outcome::stopped);
}

TEST(Rrt, RefusesOptionsOutOfRange) {
  const auto message = [](const RrtOptions& asked) { return test::refusal<InputError>([&] { asked.validate(); }); };
  EXPECT_EQ(message({}), "");
  EXPECT_EQ(message({.step = 0.0}).substr(0, 4), "step");
  EXPECT_EQ(message({.domain = 0.5}).substr(0, 6), "domain");
  EXPECT_EQ(message({.moving = 0.0}).substr(0, 6), "moving");
  EXPECT_EQ(message({.goal_bias = 1.5}).substr(0, 9), "goal bias");
  EXPECT_EQ(message({.nodes = 1}).substr(0, 5), "nodes");
  EXPECT_EQ(message({.trees = 0}).substr(0, 5), "trees");
  EXPECT_EQ(message({.sampler = SamplerKind::lattice}).substr(0, 7), "sampler");
}

/// In the open the shortest path is the straight one; around a corner it is known.
TEST(ShortcutPath, ApproachesTheShortestPathAroundACorner) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{5, 0}, {5, 5}}});
  const MazeWorld world(scene, 1e-6, {});
  const Path<Vec2> path = {{2, 1}, {1, 9}, {4, 6}, {5, 9}, {9, 9}, {8, 1}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Counters counters;
    const auto shorter = shortcut_path(WorldView(world), path, MazeWorld::distance, {.seed = seed}, {}, counters);
    EXPECT_EQ(shorter.front(), path.front());
    EXPECT_EQ(shorter.back(), path.back());
    EXPECT_LE(path_length(shorter, MazeWorld::distance), 10.0 * 1.005) << seed;  // 3-4-5 triangles on both sides
    EXPECT_GE(path_length(shorter, MazeWorld::distance), 10.0);
    EXPECT_GT(counters.edges_checked, 0U);
  }
}

TEST(Samplers, GaussianAndBridgeSamplesAreFreeAndNearObstacles) {
  const Scene scene = body_scenes::scattered(2);
  const Se2World world(scene, kite, {});
  auto query = world.make_query();
  const auto mean_clearance = [&](SamplerKind kind) {
    double sum = 0.0;
    int count = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
      const auto state = obstacle_sample(world, kind, 1, i, query);
      if (!state) continue;
      EXPECT_TRUE(world.is_free(*state, query));
      sum += world.clearance(*state, 1e9, query);
      ++count;
    }
    EXPECT_GT(count, 100);
    return sum / count;
  };
  const double everywhere = [&] {
    double sum = 0.0;
    int count = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
      const Se2 state = uniform_state(world, 1, i);
      if (!world.is_free(state, query)) continue;
      sum += world.clearance(state, 1e9, query);
      ++count;
    }
    return sum / count;
  }();
  EXPECT_LT(mean_clearance(SamplerKind::gaussian), 0.6 * everywhere);
  EXPECT_LT(mean_clearance(SamplerKind::bridge), 0.6 * everywhere);
  EXPECT_LT(mean_clearance(SamplerKind::mixture), everywhere);
}

TEST(Prm, SolvesForTurningBodiesWithEverySamplerAndRule) {
  const Scene scene = poly_easy();
  const Se2World world(scene, kite, {});
  constexpr SamplerKind samplers[] = {SamplerKind::uniform, SamplerKind::halton, SamplerKind::gaussian,
                                      SamplerKind::bridge, SamplerKind::mixture};
  constexpr StarRule rules[] = {StarRule::none, StarRule::neighbours, StarRule::radius};
  for (const std::uint64_t i : test::seeds(15, 5, 0)) {
    const SamplerKind sampler = samplers[i % 5];
    const StarRule star = rules[i % 3];
    SCOPED_TRACE(testing::Message() << static_cast<int>(sampler) << " " << static_cast<int>(star));
    RoadmapOptions options;
    options.sampler = sampler;
    options.star = star;
    Counters first;
    Path<Se2> path;
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      if (threads > 1 && star != StarRule::none) continue;
      const auto solution = prm(WorldView(world), easy_start, easy_goal, options, {.threads = threads});
      ASSERT_EQ(solution.outcome, Outcome::solved);
      if (threads == 1) {
        path = solution.path;
        first = solution.counters;
        expect_verified(scene, kite, path, {.start = easy_start, .goal = easy_goal});
      }
      EXPECT_EQ(solution.path, path);
      EXPECT_EQ(solution.counters, first);
    }
    if (star == StarRule::radius) continue;
    const auto lazy = lazy_prm(WorldView(world), easy_start, easy_goal, options, {});
    ASSERT_EQ(lazy.outcome, Outcome::solved);
    EXPECT_NEAR(path_length(lazy.path, [&](const Se2& a, const Se2& b) { return world.distance(a, b); }),
                path_length(path, [&](const Se2& a, const Se2& b) { return world.distance(a, b); }), 1e-9);
  }
}

TEST(PrmStar, NeighboursAndRadiusFollowTheSamples) {
  EXPECT_EQ(star_rule(StarRule::neighbours, 1000, 3, 0.0).neighbours, 26U);  // e 4/3 ln 1000 = 25.04
  EXPECT_EQ(star_rule(StarRule::neighbours, 1000, 2, 0.0).neighbours, 29U);  // e 3/2 ln 1000 = 28.17
  // 2 (3/2 V / pi ln n / n)^(1/2)
  EXPECT_NEAR(star_rule(StarRule::radius, 1000, 2, 10.0).radius, 0.3632, 1e-3);
  EXPECT_THROW(star_rule(StarRule::radius, 1000, 3, 0.0), UsageError);
  // Of an arm none of whose joints moves anything.
  EXPECT_EQ(star_rule(StarRule::neighbours, 1000, 0, 0.0), star_rule(StarRule::neighbours, 1000, 1, 0.0));
}

}  // namespace
}  // namespace warren
