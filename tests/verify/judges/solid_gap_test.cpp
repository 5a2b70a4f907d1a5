// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/judged_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/arms/random_arm.hpp"

namespace warren {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// How far a solid goes in a direction, by its definition.
double farthest(const Solid& solid, const Vec3& n) {
  const auto corners_of_box = [&] {
    std::vector<Vec3> all;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) all.push_back(solid.half.cwiseProduct(Vec3(x, y, z)));
      }
    }
    return all;
  };
  double most = -never;
  const auto consider = [&](const Vec3& p, double beyond) { most = std::max(most, n.dot(solid.pose * p) + beyond); };
  const Vec3 axis = solid.pose.linear().col(2);
  const double across = (n - axis.dot(n) * axis).norm();
  switch (solid.kind) {
    case SolidKind::sphere:
      consider(Vec3::Zero(), solid.half.x() * n.norm());
      break;
    case SolidKind::box:
      for (const Vec3& p : corners_of_box()) consider(p, 0.0);
      break;
    case SolidKind::hull:
      for (const Vec3& p : solid.corners) consider(p, 0.0);
      break;
    default:
      for (const double z : {-solid.half.z(), solid.half.z()}) {
        consider({0.0, 0.0, z}, solid.half.x() * (solid.kind == SolidKind::cylinder ? across : n.norm()));
      }
  }
  return most;
}

double parted_by(const Solid& a, const Solid& b, const Vec3& n) { return -farthest(b, -n) - farthest(a, n); }

/// The best of many planes: never more than the distance; 0 for solids that meet.
double parted_by_planes(const Solid& a, const Solid& b, const Vec3& first, std::uint64_t seed) {
  Vec3 best = first;
  double most = std::max(0.0, parted_by(a, b, best));
  double step = 1.0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto u = [&](std::uint64_t k) { return 2.0 * uniform(seed, i, k) - 1.0; };
    const Vec3 n = (best + step * Vec3(u(0), u(1), u(2))).normalized();
    const double parted = parted_by(a, b, n);
    if (parted > most) most = parted, best = n;
    step *= 0.995;
  }
  return most;
}

struct Measured {
  SolidGap gap;  // radii taken off
  double radii;
};
Measured measured(const Solid& a, const Solid& b, double close, double enough = never) {
  SolidFrame of_a{{a.pose.linear().col(0), a.pose.linear().col(1), a.pose.linear().col(2)}, a.pose.translation()};
  SolidFrame of_b{{b.pose.linear().col(0), b.pose.linear().col(1), b.pose.linear().col(2)}, b.pose.translation()};
  const SolidCore core_a = core_of(a, of_a);
  const SolidCore core_b = core_of(b, of_b);
  const double radii = core_a.radius + core_b.radius;
  SolidGap gap = gap_between({core_a, of_a}, {core_b, of_b}, close, enough);
  gap.least -= radii;
  gap.most -= radii;
  return {gap, radii};
}

TEST(SolidGap, OfEveryPairOfKindsIsThatOfTheBestPlane) {
  std::size_t apart = 0;
  for (const std::uint64_t seed : test::seeds(120, 6)) {
    SCOPED_TRACE(seed);
    for (const SolidKind kind : random_arm::kinds) {
      for (const SolidKind other : random_arm::kinds) {
        random_arm::Draw draw(seed * 25 + static_cast<std::uint64_t>(kind) * 5 + static_cast<std::uint64_t>(other));
        const Solid a = draw.solid(kind, 1.0);
        Solid b = draw.solid(other, 1.0);
        b.pose.translation() += 1.5 * draw.vector();
        const auto [gap, radii] = measured(a, b, 1e-9);
        if (gap.most + radii <= 1e-9) continue;  // the cores meet
        ++apart;
        EXPECT_NEAR(gap.towards.norm(), 1.0, 1e-12);
        EXPECT_NEAR(parted_by(a, b, gap.towards), gap.least, 1e-12);  // what is promised is seen by supports alone
        EXPECT_LE(gap.most - gap.least, 1e-9);
        EXPECT_LE(parted_by_planes(a, b, gap.towards, seed), std::max(0.0, gap.most) + 1e-12);
      }
    }
  }
  EXPECT_GT(apart, test::share(2500, 100));
}

TEST(SolidGap, IsZeroWhereCoresMeetAndStopsWhereThatIsEnough) {
  Solid box{.kind = SolidKind::box, .half = {1.0, 1.0, 1.0}};
  Solid other = box;
  other.pose.translation() = Vec3(1.5, 0.0, 0.0);
  EXPECT_LE(measured(box, other, 1e-12).gap.most, 1e-12);
  other.pose.translation() = Vec3(9.0, 0.5, 0.25);
  const auto [gap, radii] = measured(box, other, 0.0, 1.0);
  EXPECT_GE(gap.least, 1.0);
  EXPECT_LE(gap.least, 7.0);
  EXPECT_GE(gap.most, 7.0);
}

/// Points, segments and squares, told as hulls and boxes: nothing divides by a size of 0.
TEST(SolidGap, OfFlatSolidsIsThatOfTheirPoints) {
  Solid point{.kind = SolidKind::hull};
  point.corners = {{3.0, 4.0, 0.0}};
  const Solid ball{.kind = SolidKind::sphere};
  const Solid flat{.kind = SolidKind::box, .half = {1.0, 0.0, 0.0}};
  const Solid disc{.kind = SolidKind::cylinder, .half = {1.0, 0.0, 0.0}};
  EXPECT_DOUBLE_EQ(measured(point, ball, 0.0).gap.most, 5.0);
  EXPECT_NEAR(measured(point, flat, 0.0).gap.most, std::sqrt(20.0), 1e-12);
  EXPECT_NEAR(measured(disc, point, 0.0).gap.least, 4.0, 1e-12);
  Solid line = point;
  line.corners = {{3.0, 4.0, 0.0}, {3.0, -4.0, 0.0}, {3.0, -4.0, 0.0}, {3.0, 1.0, 0.0}};
  EXPECT_NEAR(measured(line, disc, 0.0).gap.least, 2.0, 1e-12);
  EXPECT_NEAR(measured(line, line, 0.0).gap.most, 0.0, 1e-12);
}

}  // namespace
}  // namespace warren
