// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/wall_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"

namespace warren {
namespace {

using Walls = std::vector<Segment>;

WallIndex index_of(const Walls& walls, unsigned threads = 1) {
  return WallIndex(WallSet::narrowest(walls), Execution{threads});
}

struct Kind {
  const char* name;
  std::function<Walls(std::uint64_t)> make;
};

Vec2 point_in(std::uint64_t seed, std::uint64_t i, std::uint64_t axis, double size) {
  return {size * uniform(seed, i, axis), size * uniform(seed, i, axis + 1)};
}

/// On a small integer grid, so that touching, overlapping, collinear and zero-length walls abound.
Walls integer_walls(std::uint64_t seed) {
  Walls walls;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const auto c = [&](std::uint64_t axis) { return static_cast<double>(random_bits(seed, i, axis) % 12); };
    walls.push_back({{c(0), c(1)}, {c(2), c(3)}});
  }
  return walls;
}

/// Lengths over six orders of magnitude, clustered.
Walls mixed_walls(std::uint64_t seed) {
  Walls walls;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Vec2 centre = i % 2 == 0 ? point_in(seed, i, 0, 100.0) : Vec2{40, 60} + point_in(seed, i, 0, 1e-2);
    const double length = std::pow(10.0, -4.0 + 6.0 * uniform(seed, i, 5)) * (i % 2 == 0 ? 1.0 : 1e-3);
    const double angle = 6.2831853 * uniform(seed, i, 6);
    const Vec2 half{0.5 * length * std::cos(angle), 0.5 * length * std::sin(angle)};
    walls.push_back({centre - half, centre + half});
  }
  return walls;
}

Walls parallel_walls(std::uint64_t) {
  Walls walls;
  for (int i = 0; i < 200; ++i) walls.push_back({{0.0, 1.0 * i}, {199.0, 1.0 * i}});
  return walls;
}

Walls far_walls(std::uint64_t seed) {
  Walls walls = integer_walls(seed);
  for (Segment& s : walls) s = {s.a + Vec2{1e6, -1e6}, s.b + Vec2{1e6, -1e6}};
  return walls;
}

const std::vector<Kind> kinds = {
    {"integer", integer_walls}, {"mixed", mixed_walls}, {"parallel", parallel_walls}, {"far", far_walls}};

struct Motion {
  Segment motion;
  double clearance;
};

Motion random_motion(const Walls& walls, std::uint64_t seed, std::uint64_t i) {
  const Segment near = walls[random_bits(seed, i, 50) % walls.size()];
  const double size = std::pow(10.0, -3.0 + 4.0 * uniform(seed, i, 51));
  const auto offset = [&](std::uint64_t axis) { return point_in(seed, i, axis, 2 * size) - Vec2{size, size}; };
  Segment motion{near.a + offset(52), near.b + offset(54)};
  if (i % 3 == 0) motion.b = motion.a + offset(56);
  if (i % 5 == 0) {
    motion = {{std::round(motion.a.x), std::round(motion.a.y)}, {std::round(motion.b.x), std::round(motion.b.y)}};
  }
  return {motion, size * uniform(seed, i, 58)};
}

void expect_brute_force_answers(const Walls& walls, const WallIndex& index, const Motion& m) {
  bool touches = false;
  double nearest = 1e300;
  double point_nearest = 1e300;
  for (const Segment& w : walls) {
    touches |= segments_touch(m.motion, w);
    nearest = std::min(nearest, distance(m.motion, w));
    point_nearest = std::min(point_nearest, distance(m.motion.a, w));
  }
  ASSERT_EQ(index.blocks(m.motion.a, m.motion.b), touches);
  ASSERT_DOUBLE_EQ(index.clearance(m.motion.a), point_nearest);
  ASSERT_DOUBLE_EQ(index.clearance(m.motion.a, m.clearance), std::min(m.clearance, point_nearest));
  if (std::abs(nearest - m.clearance) > 1e-9 * (m.clearance + 1e-3)) {
    ASSERT_EQ(index.keeps_clearance(m.motion.a, m.motion.b, m.clearance), nearest >= m.clearance);
  }
}

TEST(WallIndex, AgreesWithBruteForceOnEveryKindOfWalls) {
  for (const Kind& kind : kinds) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Walls walls = kind.make(seed);
      const WallIndex index = index_of(walls);
      for (std::uint64_t i = 0; i < 200; ++i) {
        SCOPED_TRACE(std::string(kind.name) + " seed " + std::to_string(seed) + " motion " + std::to_string(i));
        expect_brute_force_answers(walls, index, random_motion(walls, seed, i));
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

/// Bunches of motions, near each other and not, of every size.
void expect_single_answers(const Walls& walls, const WallIndex& index, std::uint64_t seed) {
  for (std::uint64_t bunch = 0; bunch < 40; ++bunch) {
    std::vector<Segment> motions;
    const Motion centre = random_motion(walls, seed, 100 * bunch);
    for (std::uint64_t i = 0; i < 1 + bunch % WallIndex::most_motions; ++i) {
      const Motion other = random_motion(walls, seed, 100 * bunch + i);
      const Vec2 away = other.motion.b - other.motion.a;
      motions.push_back(bunch % 3 == 0 ? other.motion : Segment{centre.motion.a, centre.motion.a + 0.3 * away});
    }
    const std::uint32_t kept = index.keep_clearance(motions, centre.clearance);
    const std::uint32_t touching = index.keep_clearance(motions, 0.0);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      ASSERT_EQ((kept >> i & 1U) != 0, index.keeps_clearance(motions[i].a, motions[i].b, centre.clearance)) << bunch;
      ASSERT_EQ((touching >> i & 1U) != 0, !index.blocks(motions[i].a, motions[i].b)) << bunch;
    }
    ASSERT_EQ(kept >> motions.size(), 0U);
  }
}

TEST(WallIndex, AnswersForABunchOfMotionsAsForEachAlone) {
  for (const Kind& kind : kinds) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(std::string(kind.name) + " seed " + std::to_string(seed));
      const Walls walls = kind.make(seed);
      expect_single_answers(walls, index_of(walls), seed);
    }
  }
  EXPECT_EQ(index_of({}).keep_clearance(std::vector<Segment>{{{0, 0}, {1, 1}}, {{2, 0}, {1, 1}}}, 0.5), 3U);
  EXPECT_EQ(index_of({}).keep_clearance({}, 0.5), 0U);
}

/// The same walls and motions with every instruction set that this machine has, against one screen a motion.
template <class T>
void expect_bunches_sifted_alike() {
  using detail::InstructionSet;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Segment> motions;
    std::vector<WallOf<T>> walls;
    const std::uint64_t count = seed % 4 == 3 ? 5 : 16;
    for (std::uint64_t i = 0; i < count; ++i) motions.push_back({point_in(seed, i, 0, 3), point_in(seed, i, 2, 3)});
    for (std::uint64_t i = 0; i < 5 * seed; ++i) {
      const auto c = [&](std::uint64_t axis) { return static_cast<T>(4 * uniform(seed, i, axis)); };
      walls.push_back({c(4), c(5), c(6), c(7)});
    }
    for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
      if (set > detail::best_instruction_set()) continue;
      detail::MotionBunch<T> bunch(motions, 0.1);
      bunch.sift(walls, set);
      for (std::size_t i = 0; i < count; ++i) {
        const Box box = box_of(motions[i]).grown(0.1);
        ASSERT_TRUE(bunch.around().contains(box.min) && bunch.around().contains(box.max));
        const BoxScreen<T> screen(box);
        const auto meets = [&](const WallOf<T>& wall) { return screen.meets(wall); };
        ASSERT_EQ(bunch.count(i), static_cast<std::size_t>(std::count_if(walls.begin(), walls.end(), meets)));
        if (bunch.count(i) == 0) continue;
        ASSERT_EQ(bunch.first(i),
                  static_cast<std::size_t>(std::find_if(walls.begin(), walls.end(), meets) - walls.begin()));
        ASSERT_EQ(bunch.last(i),
                  static_cast<std::size_t>(walls.rend() - std::find_if(walls.rbegin(), walls.rend(), meets)) - 1);
      }
    }
  }
}

TEST(WallIndex, SiftsBunchesAlikeWithEveryInstructionSet) {
  expect_bunches_sifted_alike<float>();
  expect_bunches_sifted_alike<double>();
}

TEST(WallIndex, MotionEndingOnAWallIsBlocked) {
  const WallIndex index = index_of({{{0, 0}, {2, 0}}, {{5, 5}, {5, 5}}});
  EXPECT_TRUE(index.blocks({1, 1}, {1, 0}));
  EXPECT_TRUE(index.blocks({2, 1}, {2, 0}));
  EXPECT_TRUE(index.blocks({-1, 0}, {0, 0}));
  EXPECT_TRUE(index.blocks({4, 4}, {6, 6}));
  EXPECT_FALSE(index.blocks({1, 1}, {1, std::nextafter(0.0, 1.0)}));
}

TEST(WallIndex, DistanceEqualToTheClearanceIsFree) {
  const WallIndex index = index_of({{{0, 0}, {2, 0}}});
  EXPECT_TRUE(index.keeps_clearance({0, 0.5}, {2, 0.5}, 0.5));
  EXPECT_FALSE(index.keeps_clearance({0, 0.5}, {2, 0.5}, std::nextafter(0.5, 1.0)));
  EXPECT_FALSE(index.keeps_clearance({-1, 0.6}, {1, 0.4}, 0.5));
}

TEST(WallIndex, NoWallsBlockNothing) {
  const WallIndex index = index_of({});
  EXPECT_FALSE(index.blocks({0, 0}, {1, 1}));
  EXPECT_TRUE(index.keeps_clearance({0, 0}, {1, 1}, 3.0));
  EXPECT_EQ(index.clearance({0, 0}), std::numeric_limits<double>::infinity());
}

TEST(WallIndex, MemoryStaysLinearWhenLongAndShortWallsMix) {
  Walls walls;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Vec2 p = point_in(7, i, 0, 1.0);
    walls.push_back({p, p + Vec2{1e-4, 0}});
  }
  for (int i = 0; i < 50; ++i) walls.push_back({{-1e5, 1e3 * i}, {1e5, 1e3 * i}});
  const WallIndex index = index_of(walls);
  EXPECT_LT(index.bytes(), 32 * (5 * walls.size() + 65536) + 4 * (4 * walls.size() + 65536));
  std::size_t visited = 0;
  index.for_each_near(Box{{0.5, 0.5}, {0.5, 0.5}}, [&](const Segment&) { return ++visited > 0; });
  EXPECT_LT(visited, 500U) << "the crowded cell must have been refined";
}

TEST(WallIndex, AnswersDoNotDependOnTheThreads) {
  Walls walls;  // enough for several chunks
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    const Vec2 p = point_in(3, i, 0, 400.0);
    walls.push_back({p, p + point_in(3, i, 2, 2.0)});
  }
  const auto in_order = [](const WallIndex& index) {
    std::vector<Segment> all;
    index.for_each_near(index.box(), [&](const Segment& s) { return all.push_back(s), true; });
    return all;
  };
  const std::vector<Segment> expected = in_order(index_of(walls, 1));
  for (const unsigned threads : {2U, 3U, 8U}) EXPECT_EQ(in_order(index_of(walls, threads)), expected) << threads;
}

}  // namespace
}  // namespace warren
