// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/convex_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/seeds.hpp"
#include "tests/worlds/arms/random_arm.hpp"

namespace warren {
namespace {

using random_arm::Draw;
using random_arm::kinds;

/// The mean of corners that is nearest to p, or a little farther: weight goes from corner to corner, as much as brings
/// the mean nearer, a dozen times between any two.
Vec3 nearest_of_hull(const std::vector<Vec3>& corners, const Vec3& p) {
  const std::size_t n = corners.size();
  std::vector<double> weights(n, 1.0 / static_cast<double>(n));
  Vec3 off = -p;
  for (const Vec3& corner : corners) off += corner / static_cast<double>(n);
  for (int round = 0; round < 12; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = i + 1; k < n; ++k) {
        const Vec3 across = corners[i] - corners[k];
        const double more = std::clamp(-off.dot(across) / across.squaredNorm(), -weights[i], weights[k]);
        weights[i] += more;
        weights[k] -= more;
        off += more * across;
      }
    }
  }
  return p + off;
}

/// A body at some pose, which knows the nearest of its points.
struct PosedSolid {
  Solid solid;
  Eigen::Isometry3d pose;

  Vec3 nearest(const Vec3& world) const {
    const Vec3 p = (pose * solid.pose).inverse() * world;
    const Vec3& half = solid.half;
    Vec3 found = p;
    switch (solid.kind) {
      case SolidKind::sphere:
        if (p.norm() > half.x()) found = half.x() * p.normalized();
        break;
      case SolidKind::box:
        found = p.cwiseMax(-half).cwiseMin(half);
        break;
      case SolidKind::cylinder: {
        const double away = std::hypot(p.x(), p.y());
        const double part = away > half.x() ? half.x() / away : 1.0;
        found = {part * p.x(), part * p.y(), std::clamp(p.z(), -half.z(), half.z())};
        break;
      }
      case SolidKind::capsule: {
        const Vec3 core(0.0, 0.0, std::clamp(p.z(), -half.z(), half.z()));
        const double away = (p - core).norm();
        if (away > half.x()) found = core + half.x() / away * (p - core);
        break;
      }
      case SolidKind::hull:
        found = nearest_of_hull(solid.corners, p);
        break;
    }
    return pose * solid.pose * found;
  }
};

/// Never less than the distance: from one body to the other and back again.
double slow_distance(const PosedSolid& a, const PosedSolid& b, int rounds) {
  Vec3 in_b = b.pose * b.solid.pose.translation();
  if (b.solid.kind == SolidKind::hull) in_b = b.nearest(in_b);
  double least = 1e300;
  for (int i = 0; i < rounds; ++i) {
    const Vec3 in_a = a.nearest(in_b);
    in_b = b.nearest(in_a);
    least = std::min(least, (in_a - in_b).norm());
  }
  return least;
}

MovingFrame still_at(const Eigen::Isometry3d& pose) {
  MovingFrame frame;
  frame.turn = pose.linear();
  frame.at = pose.translation();
  return frame;
}

PlaneBetween plane(const PosedSolid& a, const PosedSolid& b) {
  return plane_between(ConvexBody(a.solid), still_at(a.pose), ConvexBody(b.solid), still_at(b.pose), 1e9);
}

/// Two of the kinds, `size` large.
std::array<PosedSolid, 2> pair_of(std::uint64_t seed, double size) {
  Draw draw(seed);
  std::array<PosedSolid, 2> pair;
  for (std::size_t i = 0; i < 2; ++i) {
    pair[i].solid = draw.solid(kinds[i == 0 ? seed % 5 : seed / 5 % 5], size);
    pair[i].pose.setIdentity();
    pair[i].pose.linear() = draw.pose(0.0).linear();
    pair[i].pose.translation() = 0.55 * size * draw.vector();
  }
  return pair;
}

TEST(ConvexMotion, ThePlaneTellsTheDistance) {
  int apart = 0;
  for (const std::uint64_t seed : test::seeds(400, 20)) {
    SCOPED_TRACE(seed);
    const auto [a, b] = pair_of(seed, 1.0);
    const double slow = slow_distance(a, b, 60);
    const PlaneBetween found = plane(a, b);
    EXPECT_LE(found.below, slow + 1e-12);
    EXPECT_GE(std::max(found.below, 0.0), slow - 0.02) << "the slow way comes near";
    EXPECT_NEAR(found.direction.norm(), 1.0, 1e-12);
    if (found.below <= 0.0) continue;
    ++apart;
    const auto farthest = [](const PosedSolid& of, const Vec3& direction) {
      const ConvexBody body(of.solid);
      std::size_t near = 0;
      return direction.dot(of.pose * body.core_support(of.pose.linear().transpose() * direction, near)) + body.margin();
    };
    EXPECT_NEAR(-farthest(b, -found.direction) - farthest(a, found.direction), found.below, 1e-11);
  }
  EXPECT_GT(apart, 2);
}

TEST(ConvexMotion, SwappedMovedAndScaledItIsTheSameDistance) {
  for (const std::uint64_t seed : test::seeds(400, 20)) {
    SCOPED_TRACE(seed);
    const auto [a, b] = pair_of(seed, 1.0);
    const double here = std::max(0.0, plane(a, b).below);
    EXPECT_NEAR(std::max(0.0, plane(b, a).below), here, 1e-8);
    Draw draw(seed + 1'000'000);
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    moved.linear() = draw.pose(0.0).linear();
    moved.translation() = 3.0 * draw.vector();
    EXPECT_NEAR(std::max(0.0, plane({a.solid, moved * a.pose}, {b.solid, moved * b.pose}).below), here, 1e-8);
    for (const double size : {1e-6, 1e3}) {
      const auto [c, d] = pair_of(seed, size);
      EXPECT_NEAR(std::max(0.0, plane(c, d).below) / size, here, 1e-8);
    }
  }
}

/// A frame that turns evenly and slides evenly.
struct TrueMotion {
  Eigen::Isometry3d middle;
  Vec3 velocity;
  Vec3 spin;
  Eigen::Isometry3d at(double t) const {
    Eigen::Isometry3d pose = middle;
    const double angle = t * spin.norm();
    pose.linear() = Eigen::AngleAxisd(angle, spin.normalized()).toRotationMatrix() * middle.linear();
    pose.translation() += t * velocity;
    return pose;
  }
  MovingFrame frame(const ConvexBody& body) const {
    MovingFrame frame = still_at(middle);
    frame.velocity = velocity;
    frame.spin = spin;
    frame.bend = spin.squaredNorm() * (body.centre().norm() + body.radius());
    return frame;
  }
};

TEST(ConvexMotion, WhatIsProvedHoldsAllTheTime) {
  std::array<int, 3> verdicts{};
  int missed = 0;
  for (const std::uint64_t seed : test::seeds(800, 30)) {
    SCOPED_TRACE(seed);
    const auto [a, b] = pair_of(seed, 1.0);
    Draw draw(seed + 2'000'000);
    const ConvexBody body_a(a.solid);
    const ConvexBody body_b(b.solid);
    const TrueMotion way_a{a.pose, draw.vector(), 2.0 * draw.vector()};
    const TrueMotion way_b{b.pose, draw.vector(), 2.0 * draw.vector()};
    const double half = 0.1 * std::abs(draw.number());
    const double room = 0.1 * std::max(0.0, draw.number());
    const Apart verdict = keep_apart(body_a, way_a.frame(body_a), body_b, way_b.frame(body_b), half, room);
    ++verdicts[static_cast<std::size_t>(verdict)];
    double least = 1e9;
    for (int i = -4; i <= 4; ++i) {
      const double t = half * i / 4.0;
      const PosedSolid at_a{a.solid, way_a.at(t)};
      const PosedSolid at_b{b.solid, way_b.at(t)};
      least = std::min(least, plane(at_a, at_b).below);
      if (verdict == Apart::proved && i % 4 == 0) {
        EXPECT_GT(slow_distance(at_a, at_b, 20), room);
      }
    }
    if (verdict == Apart::proved) {
      EXPECT_GT(least, room);
    }
    if (verdict == Apart::meet) {
      EXPECT_LE(plane(a, b).below, room);
    }
    const double bend = 0.5 * half * half * (way_a.frame(body_a).bend + way_b.frame(body_b).bend);
    if (verdict != Apart::proved && least > room + 2.0 * bend + 1e-3) ++missed;
  }
  for (const int count : verdicts) EXPECT_GE(count, test::asks_all() ? 20 : 0);
  EXPECT_LE(missed, 4) << "the plane has to do for both ends";
}

TEST(ConvexMotion, OfBodiesAtRestItIsEitherProvedOrMet) {
  for (const std::uint64_t seed : test::seeds(400, 20)) {
    SCOPED_TRACE(seed);
    const auto [a, b] = pair_of(seed, 1.0);
    const ConvexBody body_a(a.solid);
    const ConvexBody body_b(b.solid);
    const Apart verdict = keep_apart(body_a, still_at(a.pose), body_b, still_at(b.pose), 0.0, 0.01);
    const double distance = slow_distance(a, b, 60);
    if (verdict == Apart::proved) {
      EXPECT_GT(distance, 0.01);
    }
    if (verdict == Apart::meet) {
      EXPECT_LT(distance, 0.02);
    }
    EXPECT_NE(verdict, Apart::open) << distance;
  }
}

Solid box_at(const Vec3& middle, const Vec3& half) {
  Solid made;
  made.kind = SolidKind::box;
  made.pose.translation() = middle;
  made.half = half;
  return made;
}

Apart at_rest(const Solid& a, const Solid& b, double room = 0.0) {
  return keep_apart(ConvexBody(a), {}, ConvexBody(b), {}, 0.0, room);
}

TEST(ConvexMotion, WhatTouchesIsOpen) {
  const Solid unit = box_at({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(at_rest(unit, box_at({2, 0.3, 0.2}, {1, 1, 1})), Apart::open);
  EXPECT_EQ(at_rest(unit, box_at({2.000001, 0.3, 0.2}, {1, 1, 1})), Apart::proved);
  EXPECT_EQ(at_rest(unit, box_at({1.999999, 0.3, 0.2}, {1, 1, 1})), Apart::meet);
  EXPECT_EQ(at_rest(unit, box_at({2.5, 0, 0}, {1, 1, 1}), 0.5), Apart::open);
  EXPECT_EQ(at_rest(unit, unit, 1e-9), Apart::meet);
  Solid ball;
  ball.pose.translation() = Vec3(0, 0, 2);
  ball.half.x() = 1.0;
  EXPECT_EQ(at_rest(unit, ball), Apart::open);
  ball.half.x() = 1.000001;
  EXPECT_EQ(at_rest(unit, ball), Apart::meet);
}

TEST(ConvexMotion, WhatIsFlatOrAPoint) {
  const Solid sheet = box_at({0, 0, 0}, {1, 1, 0});
  EXPECT_EQ(at_rest(sheet, box_at({0.2, 0.1, 1e-6}, {1, 1, 0})), Apart::proved);
  EXPECT_EQ(at_rest(sheet, sheet), Apart::open) << "no depth";
  EXPECT_EQ(at_rest(sheet, sheet, 1e-6), Apart::meet);
  Solid point;
  point.kind = SolidKind::hull;
  point.corners = {{0, 0, 0}};
  for (const SolidKind kind : kinds) {
    Solid none = point;
    none.kind = kind;
    none.pose.translation() = Vec3(0.1, 0.2, 0.25);
    EXPECT_EQ(at_rest(sheet, none), Apart::proved);
    EXPECT_EQ(at_rest(sheet, none, 0.3), Apart::meet);
    EXPECT_EQ(at_rest(none, point), Apart::proved);
    EXPECT_EQ(at_rest(none, none), Apart::open);
  }
}

TEST(ConvexMotion, OfALargeHullTheFarthestCornerIsFound) {
  Draw draw(5);
  Solid hull;
  hull.kind = SolidKind::hull;
  hull.pose.linear() = draw.pose(0.0).linear();
  hull.pose.translation() = draw.vector();
  for (int i = 0; i < 500; ++i) hull.corners.push_back(draw.vector().normalized().cwiseProduct(Vec3(1.0, 0.3, 0.1)));
  const ConvexBody body(hull);
  for (int i = 0; i < 30; ++i) {
    const Vec3 direction = draw.vector();
    double most = -1e9;
    for (const Vec3& corner : hull.corners) most = std::max(most, direction.dot(hull.pose * corner));
    std::size_t near = 0;
    EXPECT_NEAR(direction.dot(body.core_support(direction, near)), most, 1e-14);
    EXPECT_LE(most, direction.dot(body.centre()) + direction.norm() * body.radius());
  }
}

}  // namespace
}  // namespace warren
