// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/solid_index.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/puma560.hpp"

namespace warren {
namespace {

using namespace arm_oracle;

Vec3 random_point(std::uint64_t seed, std::uint64_t index, std::uint64_t axis) {
  return {2.0 * uniform(seed, index, axis) - 1.0, 2.0 * uniform(seed, index, axis + 1) - 1.0,
          2.0 * uniform(seed, index, axis + 2) - 1.0};
}
Point plain(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

TEST(SolidDistance, OfSegmentsAndBoxesIsTheLeastAlongTheSegment) {
  for (std::uint64_t i = 0; i < 4000; ++i) {
    SCOPED_TRACE(i);
    const Vec3 a = random_point(1, i, 0);
    Vec3 b = random_point(1, i, 3);
    for (int axis = 0; axis < 3; ++axis) {
      if (uniform(1, i, 40 + static_cast<std::uint64_t>(axis)) < 0.2) b[axis] = a[axis];  // parallel to faces
    }
    if (i % 17 == 0) b = a;
    SolidBox box{};
    const Vec3 corner = random_point(1, i, 6);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = corner[static_cast<int>(axis)];
      box.high[axis] = box.low[axis] + (uniform(1, i, 50 + axis) < 0.1 ? 0.0 : 0.7 * uniform(1, i, 10 + axis));
    }
    const double found = std::sqrt(distance_square(Spine(a, b), box));
    EXPECT_NEAR(found, segment_distance(plain(a), plain(b), box), 1e-9);
  }
}

TEST(SolidDistance, OfTwoSegmentsIsTheLeastOfAllPairs) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const Vec3 a = random_point(2, i, 0);
    const Vec3 b = random_point(2, i, 3);
    const Vec3 c = random_point(2, i, 6);
    Vec3 d = random_point(2, i, 9);
    if (i % 5 == 0) d = c + 0.7 * (b - a);  // parallel
    if (i % 7 == 0) d = c;
    const double found = std::sqrt(distance_square(Spine(a, b), Spine(c, d)));
    EXPECT_NEAR(found, segments_apart(plain(a), plain(b), plain(c), plain(d)), 1e-7);
  }
}

double plain_distance(const Scene& scene, const Vec3& a, const Vec3& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& s : scene.spheres) least = std::min(least, segment_distance(plain(a), plain(b), s));
  for (const SolidBox& box : scene.boxes) least = std::min(least, segment_distance(plain(a), plain(b), box));
  return least;
}

TEST(SolidIndex, DistancesAreThoseOfAPlainLoop) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene = scattered_spheres(seed, seed % 7 * 6);  // one by one up to 32 in all, else in a tree
    add_boxes(scene, seed, seed % 5 * 4);
    const SolidIndex index(scene.spheres, scene.boxes);
    ASSERT_EQ(index.size(), scene.spheres.size() + scene.boxes.size());
    for (std::uint64_t i = 0; i < 60; ++i) {
      const Vec3 a = random_point(seed, i, 100);
      const Vec3 b = a + 0.4 * random_point(seed, i, 103);
      const double expected = plain_distance(scene, a, b);
      const double all = std::numeric_limits<double>::infinity();
      const Spine spine(a, b);
      if (index.size() == 0) {
        EXPECT_EQ(index.distance(spine, all), all);
      } else {
        EXPECT_NEAR(index.distance(spine, all), expected, 1e-8);
      }
      const double enough = 0.4 * uniform(seed, i, 201);
      if (expected > enough + 1e-8) {
        EXPECT_GT(index.distance(spine, enough), enough);
      }
      double nearest = all;
      index.for_each_within(spine, enough, [&](const Approach& near) {
        nearest = std::min(nearest, near.distance);
        // A plane between ball and segment.
        if (near.outward.squaredNorm() == 0.0) return enough;
        const double gap = near.distance + near.radius - 1e-9;
        EXPECT_GE(near.outward.dot(a - near.centre), gap);
        EXPECT_GE(near.outward.dot(b - near.centre), gap);
        return enough;
      });
      if (std::abs(expected - enough) < 1e-8) continue;
      EXPECT_EQ(nearest <= enough, expected <= enough);
      if (expected <= enough) {
        EXPECT_NEAR(std::max(nearest, 0.0), std::max(expected, 0.0), 1e-8);
      }
    }
  }
}

TEST(SolidIndex, OfManyIsNotBuiltToItsEndWhenASignalCame) {
  const Scene scene = scattered_spheres(1, 5000);
  const SignalFlag signal{15};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  EXPECT_THROW(SolidIndex(scene.spheres, scene.boxes, {.deadline = &deadline}), Stopped);
  EXPECT_THROW(ArmWorld(scene, SerialChain(puma560_table()), {}, {.deadline = &deadline}), Stopped);
}

TEST(SolidIndex, RefusesWhatIsNoSolid) {
  const double nan = std::nan("");
  const auto refuses = [](const std::vector<Sphere>& spheres, const std::vector<SolidBox>& boxes) {
    EXPECT_THROW(SolidIndex(spheres, boxes), InputError);
  };
  refuses({{0, 0, 0, -1}}, {});
  refuses({{nan, 0, 0, 1}}, {});
  refuses({}, {{{0, 0, 0}, {1, -1, 1}}});
  refuses({}, {{{0, nan, 0}, {1, 1, 1}}});
}

}  // namespace
}  // namespace warren
