// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include "tests/seeds.hpp"
#include "tests/worlds/arms/random_arm.hpp"
#include "worlds/arms/arm_lanes.hpp"

namespace warren {
namespace {

using detail::ArmSetup;
using random_arm::Draw;

/// Frames by Eigen's own rotations.
std::vector<Eigen::Matrix4d> frames_of(const ArmModel& model, const JointState& q) {
  std::vector<Eigen::Matrix4d> frames;
  for (const ArmJoint& joint : model.joints) {
    const double value = joint.multiplier * q[joint.variable] + joint.offset;
    Eigen::Affine3d motion = Eigen::Affine3d::Identity();
    if (joint.slides) {
      motion.translate(value * joint.axis);
    } else {
      motion.rotate(Eigen::AngleAxisd(value, joint.axis));
    }
    const Eigen::Matrix4d own = joint.origin.matrix() * motion.matrix();
    frames.push_back(
        joint.parent == base_frame ? own : Eigen::Matrix4d(frames[static_cast<std::size_t>(joint.parent)] * own));
  }
  return frames;
}

/// From a point to a solid; 0 inside. A hull is none of those asked here.
double distance_to(const Solid& solid, const Vec3& place) {
  const Vec3 p = (solid.pose.inverse() * place).cwiseAbs();
  const Vec3& half = solid.half;
  switch (solid.kind) {
    case SolidKind::box:
      return (p - half).cwiseMax(0.0).norm();
    case SolidKind::cylinder:
      return std::hypot(std::max(0.0, std::hypot(p.x(), p.y()) - half.x()), std::max(0.0, p.z() - half.z()));
    case SolidKind::capsule:
      return std::max(0.0, std::hypot(p.x(), p.y(), std::max(0.0, p.z() - half.z())) - half.x());
    default:
      return std::max(0.0, p.norm() - half.x());
  }
}

struct PlacedBall {
  Vec3 at;
  double radius;
};

/// Of links that are made of balls: by how much they keep apart from the obstacles and, pair by pair, from each other.
double room_at(const ArmModel& model, std::span<const Solid> obstacles, const JointState& q) {
  const auto frames = frames_of(model, q);
  std::vector<std::vector<PlacedBall>> links;
  double least = std::numeric_limits<double>::infinity();
  for (const ArmLink& link : model.links) {
    links.emplace_back();
    for (const Solid& ball : link.solids) {
      Eigen::Vector4d at = ball.pose.translation().homogeneous();
      if (link.frame != base_frame) at = frames[static_cast<std::size_t>(link.frame)] * at;
      links.back().push_back({at.head<3>(), ball.half.x()});
      for (const Solid& solid : obstacles) {
        least = std::min(least, distance_to(solid, links.back().back().at) - ball.half.x());
      }
    }
  }
  for (const LinkPair& pair : model.pairs) {
    for (const PlacedBall& a : links[pair[0]]) {
      for (const PlacedBall& b : links[pair[1]]) least = std::min(least, (a.at - b.at).norm() - a.radius - b.radius);
    }
  }
  return least;
}

JointState along(const JointState& q, const JointState& way, double t) {
  JointState at{};
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = q[i] + t * way[i];
  return at;
}

double least_room(const ArmModel& model, std::span<const Solid> obstacles, const JointState& q, const JointState& way,
                  int steps) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    least = std::min(least, room_at(model, obstacles, along(q, way, static_cast<double>(i) / steps)));
  }
  return least;
}

/// A chain or tree whose links are one to three balls; pairs are the links that are apart at rest.
ArmModel ball_arm(std::uint64_t seed, std::size_t variables, bool tree) {
  ArmModel model = random_arm::arm(seed, variables, tree);
  Draw draw(seed + 77);
  for (ArmLink& link : model.links) {
    link.solids.clear();
    for (std::size_t i = draw.below(3) + 1; i-- > 0;) {
      Solid ball = draw.solid(SolidKind::sphere, 0.1);
      ball.pose.translation() = 0.1 * draw.vector();
      ball.half = Vec3(0.02 + 0.02 * std::abs(draw.number()), 0.0, 0.0);
      link.solids.push_back(ball);
    }
  }
  const JointState rest = random_arm::state(model, seed, 99);
  for (std::uint32_t a = 0; a < model.links.size(); ++a) {
    for (std::uint32_t b = a + 1; b < model.links.size(); ++b) {
      model.pairs = {{a, b}};
      if (room_at(model, {}, rest) > 0.0) model.assumed.push_back(std::to_string(a * 100 + b));
    }
  }
  model.pairs.clear();
  for (const std::string& pair : model.assumed) {
    const auto number = static_cast<std::uint32_t>(std::stoul(pair));
    model.pairs.push_back({number / 100, number % 100});
  }
  return model;
}

Solid obstacle(Draw& draw) {
  Solid solid = draw.solid(random_arm::kinds[draw.below(4)], 0.4);
  if (draw.below(3) == 0) solid.pose.linear().setIdentity();
  solid.pose.translation() = 0.9 * draw.vector();
  return solid;
}

JointState way_between(const ArmModel& model, const JointState& from, const JointState& to, double part) {
  JointState way{};
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    way[i] = part * variable_way(model.variables[i], from[i], to[i]);
  }
  return way;
}

template <class T>
double largest_error_of_sines() {
  double most = 0.0;
  for (double from = -13.0; from < 13.0; from += 0.00137) {
    std::array<T, detail::lane_count<T>> angles;
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = static_cast<T>(from + 0.0001 * static_cast<double>(i));
    detail::Lanes<T> sine;
    detail::Lanes<T> cosine;
    detail::sines_of<T>(detail::lanes_at<T>(angles.data()), sine, cosine);
    for (unsigned i = 0; i < angles.size(); ++i) {
      most = std::max(most, std::abs(double{sine[i]} - std::sin(double{angles[i]})));
      most = std::max(most, std::abs(double{cosine[i]} - std::cos(double{angles[i]})));
    }
  }
  return most;
}

TEST(ArmLanes, SinesAreAsExactAsTheCertificateAssumes) {
  EXPECT_LT(largest_error_of_sines<float>(), detail::largest_sine_error<float>);
  EXPECT_LT(largest_error_of_sines<double>(), detail::largest_sine_error<double>);
}

TEST(ArmCertificate, VerdictsAreThoseOfDenseStates) {
  std::array<int, 3> seen{};
  for (const std::uint64_t seed : test::seeds(400, 12)) {
    SCOPED_TRACE(seed);
    const ArmModel model = ball_arm(seed, 2 + seed % 6, seed % 2 == 0);
    Draw draw(seed + 1);
    std::vector<Solid> obstacles;
    for (std::uint64_t i = 0; i < 1 + seed % 12; ++i) obstacles.push_back(obstacle(draw));
    const double clearance = seed % 3 == 0 ? 0.01 : 0.0;
    const ArmCertificate certificate(model, obstacles, clearance, 1e-5);
    const ArmSetup setup(model, obstacles, clearance, 1e-5, {});
    for (std::uint64_t i = 0; i < 4; ++i) {
      const JointState q = random_arm::state(model, seed, 2 * i);
      const JointState way = way_between(model, q, random_arm::state(model, seed, 2 * i + 1), i == 3 ? 1.0 : 0.2);
      const MotionVerdict verdict = certificate.motion(q, way);
      ++seen[static_cast<std::size_t>(verdict)];
      const double room = least_room(model, obstacles, q, way, 150) - clearance;
      if (verdict == MotionVerdict::free) {
        EXPECT_GT(room, 0.0);
      }
      if (verdict == MotionVerdict::blocked) {
        EXPECT_LT(room, 0.03);  // which nothing exceeds between two of the states
      }
      EXPECT_EQ(verdict, detail::judge_arm_motion(setup, q, way, detail::InstructionSet::baseline));
      EXPECT_EQ(certificate.is_free(q), room_at(model, obstacles, q) > clearance);
    }
  }
  EXPECT_GT(seen[0], 3);
  EXPECT_GT(seen[1], 3);
  EXPECT_EQ(seen[2], 0);
}

/// As least_room, by ever finer steps around the least.
double closest(const ArmModel& model, std::span<const Solid> obstacles, const JointState& q, const JointState& way) {
  double best = 0.5;
  double least = std::numeric_limits<double>::infinity();
  for (double half = 0.5; half > 1e-5; half /= 20.0) {
    const double middle = best;
    for (int i = -40; i <= 40; ++i) {
      const double t = std::clamp(middle + half * i / 40.0, 0.0, 1.0);
      const double room = room_at(model, obstacles, along(q, way, t));
      if (room < least) best = t;
      least = std::min(least, room);
    }
  }
  return least;
}

/// A ball in the way that a motion just touches, or just does not.
struct Attack {
  int missed = 0;   // that touch by 1e-5 to 1e-3, and are called free
  int forgone = 0;  // that pass by 1e-4 and more, and are not called free
};

Attack attack(double bend_factor, std::uint64_t seeds) {
  Attack found;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    ArmModel model = ball_arm(seed, 3 + seed % 4, seed % 2 == 0);
    model.pairs.clear();
    Draw draw(seed + 5);
    const JointState q = random_arm::state(model, seed, 0);
    const JointState way = way_between(model, q, random_arm::state(model, seed, 1), 0.7);
    Solid ball = obstacle(draw);
    ball.kind = SolidKind::sphere;
    ball.half = Vec3::Zero();
    const double room = closest(model, {&ball, 1}, q, way);
    if (room < 0.01) continue;
    const auto verdict = [&](double radius) {
      ball.half.x() = radius;
      return detail::judge_arm_motion(ArmSetup(model, {&ball, 1}, 0.0, 1e-5, {}), q, way,
                                      detail::best_instruction_set(), bend_factor);
    };
    for (const double depth : {1e-5, 1e-4, 1e-3}) found.missed += verdict(room + depth) == MotionVerdict::free ? 1 : 0;
    if (bend_factor == 1.0 && verdict(room - 1e-4) != MotionVerdict::free) {
      found.forgone += least_room(model, {&ball, 1}, q, way, 3000) > 0.0 ? 1 : 0;
    }
  }
  return found;
}

TEST(ArmCertificate, MotionsThatJustTouchAreNotFree) {
  const Attack whole = attack(1.0, test::share(400, 20));
  EXPECT_EQ(whole.missed, 0);
  EXPECT_EQ(whole.forgone, 0);
}

/// A rod that turns about z, with a ball at its end; nothing to be kept apart, so obstacles alone can stop it.
ArmModel rod(double at) {
  ArmModel model;
  model.name = "rod";
  model.variables = {{.name = "turn", .low = -3.0, .high = 3.0}};
  model.joints = {{.name = "turn", .axis = Vec3::UnitZ()}};
  Solid ball;
  ball.half.x() = 0.1;
  ball.pose.translation().x() = at;
  model.links = {{"tip", 0, {ball}}};
  return model;
}

TEST(ArmCertificate, NumbersThatAreNoneOrTooLargeProveNothing) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Solid wall;  // right of the rod's way at 0
  wall.kind = SolidKind::box;
  wall.half = Vec3(0.5, 0.5, 0.5);
  wall.pose.translation().x() = 5.0;
  const ArmCertificate near(rod(1.0), {&wall, 1}, 0.0, 1e-5);
  EXPECT_TRUE(near.is_free(JointState{}));
  for (const double angle : {nan, infinity, -infinity, 1e9}) EXPECT_FALSE(near.is_free(JointState{angle}));
  for (const double way : {nan, infinity}) EXPECT_NE(near.motion(JointState{}, JointState{way}), MotionVerdict::free);
  for (const double size : {1e15, 1e30, 1e39, 1e45, 1e59}) {
    SCOPED_TRACE(size);
    wall.half = Vec3::Constant(0.5 * size);
    wall.pose.translation().x() = size;
    EXPECT_FALSE(ArmCertificate(rod(size), {&wall, 1}, 0.0, 1e-5).is_free(JointState{}));
    Solid ball;  // holds the base, as far as numbers tell
    ball.half.x() = size;
    ball.pose.translation().x() = size;
    EXPECT_FALSE(ArmCertificate(rod(1.0), {&ball, 1}, 0.0, 1e-5).is_free(JointState{}));
  }
}

/// Two rough bodies that nearly touch all along: what would take seconds is given up.
TEST(ArmCertificate, HullsThatNearlyTouchAreGivenUpInTime) {
  Solid plate;
  plate.kind = SolidKind::hull;
  Draw draw(3);
  for (int i = 0; i < 1000; ++i) plate.corners.push_back(Vec3(3.0 * draw.number(), 3.0 * draw.number(), -0.5));
  plate.corners.push_back(Vec3(0.0, 0.0, -1.0));
  ArmModel model = rod(1.0);
  Solid& foot = model.links[0].solids[0];
  foot.kind = SolidKind::hull;
  for (int i = 0; i < 1000; ++i) {
    foot.corners.push_back(0.5 * Vec3(draw.number(), draw.number(), 0.0) + Vec3(0.0, 0.0, -0.5 + 3e-9));
  }
  foot.corners.push_back(Vec3(0.0, 0.0, 0.5));
  const ArmCertificate certificate(model, {&plate, 1}, 0.0, 1e-12);
  const auto begun = std::clock();
  EXPECT_EQ(certificate.motion(JointState{-1.0}, JointState{2.0}), MotionVerdict::refused);
  EXPECT_LT(static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC, 5.0);
}

TEST(ArmCertificate, TheAttackWouldSeeABoundTooSmall) { EXPECT_GT(attack(0.1, 20).missed, 0); }

/// Two boxes on arms that turn against each other, and a hull of points between: what no ball decides.
TEST(ArmCertificate, BodiesThatAreNoBallsAreProvedAndMet) {
  for (const std::uint64_t seed : test::seeds(60, 8)) {
    SCOPED_TRACE(seed);
    ArmModel model = random_arm::arm(seed, 3, seed % 2 == 0);
    if (model.links.size() > 2) model.pairs = {{0, 2}};
    Draw draw(seed + 9);
    Solid hull = draw.solid(random_arm::kinds[seed % 5], 0.3);
    hull.pose.translation() = 0.6 * draw.vector();
    const ArmCertificate certificate(model, {&hull, 1}, 0.0, 1e-5);
    const ArmSetup setup(model, {&hull, 1}, 0.0, 1e-5, {});
    const JointState q = random_arm::state(model, seed, 0);
    const JointState way = way_between(model, q, random_arm::state(model, seed, 1), 0.3);
    const MotionVerdict verdict = certificate.motion(q, way);
    bool meets = false;
    const auto touch = [](const ArmLink& link, const MovingFrame& at, const Solid& other, const MovingFrame& other_at) {
      return std::any_of(link.solids.begin(), link.solids.end(), [&](const Solid& solid) {
        return keep_apart(ConvexBody(solid), at, ConvexBody(other), other_at, 0.0, 0.0) == Apart::meet;
      });
    };
    for (int i = 0; i <= 100; ++i) {
      const auto frames = frames_of(model, along(q, way, i / 100.0));
      std::vector<MovingFrame> at(frames.size());
      for (std::size_t j = 0; j < frames.size(); ++j) {
        at[j].turn = frames[j].topLeftCorner<3, 3>();
        at[j].at = frames[j].topRightCorner<3, 1>();
      }
      for (std::size_t j = 0; j < model.links.size(); ++j) meets |= touch(model.links[j], at[j], hull, {});
      for (const LinkPair& pair : model.pairs) {
        for (const Solid& solid : model.links[pair[1]].solids) {
          meets |= touch(model.links[pair[0]], at[pair[0]], solid, at[pair[1]]);
        }
      }
    }
    if (meets) {
      EXPECT_EQ(verdict, MotionVerdict::blocked);
    } else {
      EXPECT_NE(verdict, MotionVerdict::refused);
    }
    EXPECT_EQ(verdict, detail::judge_arm_motion(setup, q, way, detail::InstructionSet::baseline));
  }
}

}  // namespace
}  // namespace warren
