// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/steering_curve.hpp"

#include <gtest/gtest.h>

#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "tests/worlds/poses/steering_words.hpp"

namespace warren {
namespace {

using body_scenes::random_pose;

using std::numbers::pi;

// Builds with sanitizers take a tenth of the pairs.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t many = 10'000;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr std::uint64_t many = 10'000;
#else
constexpr std::uint64_t many = 100'000;
#endif
#else
constexpr std::uint64_t many = 100'000;
#endif

double dubins(const Se2& a, const Se2& b, double rho) { return rho * DubinsCurve::shortest(a, b, rho).length; }
double reeds_shepp(const Se2& a, const Se2& b, double rho) { return rho * ReedsSheppCurve::shortest(a, b, rho).length; }

TEST(SteeringCurve, KnownLengthsComeOut) {
  struct Known {
    Se2 goal;
    double rho, dubins, reeds_shepp;
  };
  const Known all[] = {{{4, 0, 0}, 1.0, 4.0, 4.0},
                       {{0, 4, 0}, 1.0, 6.283185, 5.478121},
                       {{0, 0, pi}, 1.0, 7.330383, 3.141593},
                       {{1, 1, pi / 2}, 1.0, 1.570796, 1.570796},
                       {{-3, 2, -pi / 2}, 1.0, 6.948457, 3.806864},
                       {{3, 3, pi}, 1.0, 6.303870, 5.384233},
                       {{0, 4, 0}, 0.5, 4.739060, 4.671134},
                       {{1, 1, pi / 2}, 0.5, 1.492505, 1.492505},
                       {{0.2, 0.3, pi}, 0.5, 3.277006, 1.570796}};
  for (const Known& known : all) {
    SCOPED_TRACE(::testing::Message() << known.goal.x << ' ' << known.goal.y << ' ' << known.goal.theta);
    EXPECT_NEAR(dubins({}, known.goal, known.rho), known.dubins, 5e-7);
    EXPECT_NEAR(reeds_shepp({}, known.goal, known.rho), known.reeds_shepp, 5e-7);
  }
}

template <class Curve>
void expect_ends_at_the_goal(std::uint64_t seed) {
  double worst = 0.0;
  std::uint64_t backwards = 0;
  for (std::uint64_t i = 0; i < many; ++i) {
    const Se2 a = random_pose(seed, 2 * i);
    const Se2 b = random_pose(seed, 2 * i + 1);
    const double rho = 0.2 + 3.0 * uniform(seed, i, 7);
    const SteeringWord word = Curve::shortest(a, b, rho);
    const Se2 end = steering_words::integrated(a, word, rho);
    worst = std::max({worst, std::abs(end.x - b.x), std::abs(end.y - b.y), std::abs(turn_between(end.theta, b.theta))});
    for (const SteeringPiece& piece : word.used()) backwards += piece.length < 0.0 ? 1 : 0;
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_EQ(backwards == 0, Curve::one_way);
}

TEST(SteeringCurve, IntegratedNumericallyDubinsCurvesEndAtTheGoal) { expect_ends_at_the_goal<DubinsCurve>(1); }
TEST(SteeringCurve, IntegratedNumericallyReedsSheppCurvesEndAtTheGoal) { expect_ends_at_the_goal<ReedsSheppCurve>(2); }

/// The pair and what is cut from its curve, at the origin and far away: a car that takes rounding for a detour circles.
template <class Curve>
void expect_the_same_lengths_anywhere(std::uint64_t seed) {
  for (std::uint64_t i = 0; i < many / 20; ++i) {
    SCOPED_TRACE(i);
    const double offset = std::pow(10.0, 3.0 + static_cast<double>(i % 5));
    const double rho = std::array{0.1, 1.0, 5.0}[i / 5 % 3];
    const auto there = [&](Se2 pose) { return Se2{pose.x + offset, pose.y - offset, pose.theta}; };
    const Se2 a = random_pose(seed, 2 * i);
    const Se2 b = random_pose(seed, 2 * i + 1);
    const SteeringCurve curve(a, b, Curve::shortest(a, b, rho), rho);
    const double length = curve.length();
    const double rounding = 1e-9 + 100.0 * std::numeric_limits<double>::epsilon() * offset;
    const auto far_length = [&](const Se2& from, const Se2& to) {
      return rho * Curve::shortest(there(from), there(to), rho).length;
    };
    EXPECT_NEAR(far_length(a, b), length, rounding);
    std::array<double, 4> at{0.0, uniform(seed, i, 6), uniform(seed, i, 7), 1.0};
    if (i % 3 == 0) at[2] = std::min(1.0, at[1] + std::pow(10.0, -9.0 * uniform(seed, i, 8)));
    std::sort(at.begin(), at.end());
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = far_length(curve.at(at[k] * length), curve.at(at[k + 1] * length));
      EXPECT_LE(part, (at[k + 1] - at[k]) * length + rounding) << k;
      sum += part;
    }
    EXPECT_GE(sum, length - rounding);
  }
}
TEST(SteeringCurve, DubinsCurvesAndTheirPartsAreAsLongFarFromTheOrigin) {
  expect_the_same_lengths_anywhere<DubinsCurve>(21);
}
TEST(SteeringCurve, ReedsSheppCurvesAndTheirPartsAreAsLongFarFromTheOrigin) {
  expect_the_same_lengths_anywhere<ReedsSheppCurve>(22);
}

/// Their circles touch: of a tangent that rounding makes between them the curve would turn by the root of it.
TEST(SteeringCurve, TwoArcsStayTwoArcsFarFromTheOrigin) {
  for (const double offset : {0.0, 1e3, 1e5, 1e7}) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      SCOPED_TRACE(::testing::Message() << offset << ' ' << i);
      const auto between = [i](std::uint64_t axis, double low, double high) {
        return low + (high - low) * uniform(11, i, axis);
      };
      const Se2 a{offset + between(0, 0, 9), between(1, 0, 9) - offset, between(2, -3, 3)};
      const Se2 middle = after_piece(a, {Steer::left, between(3, 0.2, 1.0)});
      const Se2 b = after_piece(middle, {Steer::right, between(4, 0.2, 1.0)});
      const SteeringCurve curve(a, b, ReedsSheppCurve::shortest(a, b, 1.0), 1.0);
      ASSERT_EQ(curve.piece_count(), 2U);
      EXPECT_NEAR(distance(curve.joint(1).position(), middle.position()), 0.0, 1e-9 + 4e-15 * offset);
    }
  }
}

/// Between near poses many words are as long as the turn: far from the origin the same one is driven as near it.
TEST(SteeringCurve, OfReedsSheppCurvesThatAreAsLongTheSameIsTakenAnywhere) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto between = [i](std::uint64_t axis, double low, double high) {
      return low + (high - low) * uniform(12, i, axis);
    };
    const auto driven_at = [&](double offset) {
      const Se2 a{offset + between(0, 0, 0.5), between(1, 0, 0.5) - offset, between(2, -3, 3)};
      const Se2 b{offset + between(3, 0, 0.5), between(4, 0, 0.5) - offset, a.theta + between(5, 1.5, 3)};
      const SteeringCurve curve(a, b, ReedsSheppCurve::shortest(a, b, 1.0), 1.0);
      std::vector<double> pieces;
      for (std::size_t k = 0; k < curve.piece_count(); ++k) {
        pieces.push_back(static_cast<double>(curve.piece(k).steer));
        pieces.push_back(curve.piece(k).length);
      }
      return pieces;
    };
    const std::vector<double> near = driven_at(0.0);
    for (const double offset : {1e3, 1e5, 1e7}) {
      SCOPED_TRACE(::testing::Message() << offset << ' ' << i);
      const std::vector<double> far = driven_at(offset);
      ASSERT_EQ(far.size(), near.size());
      for (std::size_t k = 0; k < far.size(); ++k) EXPECT_NEAR(far[k], near[k], 1e-9 + 4e-14 * offset);
    }
  }
}

TEST(SteeringCurve, BackingUpNeverMakesLongerAndTheWayBackIsAsLong) {
  for (std::uint64_t i = 0; i < many / 4; ++i) {
    const Se2 a = random_pose(3, 2 * i);
    const Se2 b = random_pose(3, 2 * i + 1);
    const double there = reeds_shepp(a, b, 1.0);
    ASSERT_LE(there, dubins(a, b, 1.0) + 1e-9) << i;
    ASSERT_NEAR(there, reeds_shepp(b, a, 1.0), 1e-9) << i;
    ASSERT_GE(there, distance(a.position(), b.position()) - 1e-9) << i;
    ASSERT_GE(there, std::abs(turn_between(a.theta, b.theta)) - 1e-9) << i;
    // Forwards, the way back is the way between the reversed poses.
    const Se2 turned_a{a.x, a.y, a.theta + pi};
    const Se2 turned_b{b.x, b.y, b.theta + pi};
    ASSERT_NEAR(dubins(a, b, 1.0), dubins(turned_b, turned_a, 1.0), 1e-9) << i;
  }
}

/// Also where many words are as long, near poses with different headings: roadmaps check one direction alone.
TEST(SteeringCurve, TheWayBackIsTheSameWayDrivenBack) {
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    SCOPED_TRACE(i);
    const double spread = i % 2 == 0 ? 0.5 : 5.0;
    const auto pose = [&](std::uint64_t axis) {
      return Se2{spread * uniform(9, i, axis), spread * uniform(9, i, axis + 1), 6.0 * uniform(9, i, axis + 2) - 3.0};
    };
    const Se2 a = pose(0);
    const Se2 b = pose(3);
    const SteeringWord there = ReedsSheppCurve::shortest(a, b, 1.0);
    const SteeringWord back = ReedsSheppCurve::shortest(b, a, 1.0);
    EXPECT_EQ(there.length, back.length);
    ASSERT_EQ(there.count, back.count);
    for (std::size_t k = 0; k < there.count; ++k) {
      const SteeringPiece& piece = back.pieces[there.count - 1U - k];
      EXPECT_EQ(there.pieces[k].steer, piece.steer);
      EXPECT_EQ(there.pieces[k].length, -piece.length);
    }
  }
}

TEST(SteeringCurve, NoDetourIsShorter) {
  for (std::uint64_t i = 0; i < many / 4; ++i) {
    const Se2 a = random_pose(4, 3 * i);
    const Se2 b = random_pose(4, 3 * i + 1);
    const Se2 c = random_pose(4, 3 * i + 2);
    ASSERT_LE(dubins(a, c, 2.0), dubins(a, b, 2.0) + dubins(b, c, 2.0) + 1e-9) << i;
    ASSERT_LE(reeds_shepp(a, c, 2.0), reeds_shepp(a, b, 2.0) + reeds_shepp(b, c, 2.0) + 1e-9) << i;
  }
}

/// Rounding must not make a full circle of an arc of no length.
template <class Curve>
void expect_parts_of_shortest_curves_to_be_shortest(std::uint64_t seed) {
  for (std::uint64_t i = 0; i < many / 4; ++i) {
    const Se2 a = random_pose(seed, 2 * i);
    const Se2 b = random_pose(seed, 2 * i + 1);
    const SteeringCurve curve(a, b, Curve::shortest(a, b, 1.3), 1.3);
    double way = curve.length() * uniform(seed, i, 9);
    if (i % 4 == 0) way = curve.piece_length(0);  // between two pieces
    const Se2 between = curve.at(way);
    ASSERT_NEAR(1.3 * Curve::shortest(a, between, 1.3).length, way, 1e-8) << i;
    ASSERT_NEAR(1.3 * Curve::shortest(between, b, 1.3).length, curve.length() - way, 1e-8) << i;
  }
}

TEST(SteeringCurve, PartsOfShortestCurvesAreShortest) {
  expect_parts_of_shortest_curves_to_be_shortest<DubinsCurve>(5);
  expect_parts_of_shortest_curves_to_be_shortest<ReedsSheppCurve>(6);
}

/// All words of the theorems, solved by Newton's method.
TEST(SteeringCurve, NoWordIsShorterThanTheShortest) {
  const auto forward = steering_words::dubins_patterns();
  const auto both = steering_words::reeds_shepp_patterns();
  std::uint64_t met_forwards = 0;
  std::uint64_t met = 0;
  for (const std::uint64_t seed : test::seeds(40)) {
    SCOPED_TRACE(seed);
    const double size = seed % 3 == 0 ? 1.0 : 5.0;  // near goals take the words with many arcs
    const Se2 goal{size * (2.0 * uniform(seed, 0, 0) - 1.0), size * (2.0 * uniform(seed, 0, 1) - 1.0),
                   2.0 * pi * uniform(seed, 0, 2) - pi};
    const double found = steering_words::shortest(forward, goal, true, seed, 24);
    const double found_both = steering_words::shortest(both, goal, false, seed, 12);
    EXPECT_LE(dubins({}, goal, 1.0), found + 1e-8);
    EXPECT_LE(reeds_shepp({}, goal, 1.0), found_both + 1e-8);
    met_forwards += dubins({}, goal, 1.0) > found - 1e-8 ? 1 : 0;
    met += reeds_shepp({}, goal, 1.0) > found_both - 1e-8 ? 1 : 0;
  }
  EXPECT_GE(met_forwards, test::share(36));  // Newton's method may miss some
  EXPECT_GE(met, test::share(36));
}

TEST(SteeringCurve, PosesOnTheWayLieOnTheCurveAndInItsBox) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const Se2 a = random_pose(seed, 0);
    const Se2 b = random_pose(seed, 1);
    const double rho = 0.3 + uniform(seed, 2, 0);
    const SteeringCurve curve(a, b, ReedsSheppCurve::shortest(a, b, rho), rho);
    EXPECT_EQ(curve.at(0.0), a);
    EXPECT_EQ(curve.at(curve.length()), b);
    Box met;
    constexpr int steps = 2000;
    const double step = curve.length() / steps;
    for (int i = 0; i <= steps; ++i) {
      const Se2 pose = curve.at(i * step);
      met.include(pose.position());
      if (i == 0) continue;
      const Se2 before = curve.at((i - 1) * step);
      ASSERT_LE(distance(before.position(), pose.position()), step * (1 + 1e-9));
      ASSERT_LE(std::abs(turn_between(before.theta, pose.theta)), step / rho * (1 + 1e-9));
    }
    const Box box = curve.box();
    EXPECT_TRUE(box.grown(1e-9).contains(met.min) && box.grown(1e-9).contains(met.max));
    EXPECT_TRUE(met.grown(step).contains(box.min) && met.grown(step).contains(box.max));
  }
}

TEST(SteeringCurve, ExtremesOfScaleEndAtTheGoal) {
  for (const double scale : {1e-9, 1e-4, 1e3, 1e6, 1e9}) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      SCOPED_TRACE(::testing::Message() << scale << " " << i);
      const Se2 goal{scale * (uniform(8, i, 0) - 0.5), scale * (uniform(8, i, 1) - 0.5), 6.0 * uniform(8, i, 2)};
      for (const SteeringWord& word :
           {DubinsCurve::shortest({}, goal, 1.0), ReedsSheppCurve::shortest({}, goal, 1.0)}) {
        EXPECT_TRUE(ends_at(word, goal));
      }
    }
  }
  EXPECT_EQ(DubinsCurve::shortest({1, 2, 3}, {1, 2, 3}, 1.0).length, 0.0);
  EXPECT_EQ(ReedsSheppCurve::shortest({1, 2, 3}, {1, 2, 3}, 1.0).length, 0.0);
  EXPECT_NEAR(dubins({1, 2, 3}, {1, 2, 3 + 2 * pi}, 1.0), 0.0, 1e-12);
}

TEST(SteeringCurve, ItsJointsAreLegsThatTellTheCurveWholly) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Se2 a = random_pose(7, 2 * i);
    const Se2 b = random_pose(7, 2 * i + 1);
    constexpr double rho = 0.7;
    const SteeringCurve curve(a, b, ReedsSheppCurve::shortest(a, b, rho), rho);
    std::vector<Se2> poses{a};
    append_joints(poses, curve);
    EXPECT_EQ(poses.back(), b);
    const std::vector<double> turns = leg_turns(poses);
    const std::vector<double> lengths = leg_lengths(poses, turns);
    double length = 0.0;
    for (std::size_t leg = 1; leg < poses.size(); ++leg) {
      EXPECT_LE(std::abs(turns[leg]), 0.5 * pi * (1.0 + 1e-8));
      const Se2 middle = pose_on_leg(poses[leg - 1], poses[leg], 0.5);
      const Se2 driven = curve.at(length + 0.5 * lengths[leg]);
      EXPECT_NEAR(distance(middle.position(), driven.position()), 0.0, 1e-6);
      EXPECT_NEAR(turn_between(middle.theta, driven.theta), 0.0, 1e-6);
      length += lengths[leg];
    }
    EXPECT_NEAR(length, curve.length(), 1e-6);
  }
}

TEST(SteeringCurve, ADifferentialDriveTurnsGoesStraightAndTurns) {
  for (std::uint64_t seed = 0; seed < many / 10; ++seed) {
    SCOPED_TRACE(seed);
    const Se2 a = random_pose(seed, 0);
    const Se2 b = random_pose(seed, 3);
    const double rho = 0.1 + uniform(seed, 6, 0);
    const SteeringCurve curve(a, b, DifferentialCurve::shortest(a, b, rho), rho);
    const double straight = distance(a.position(), b.position());
    ASSERT_EQ(curve.piece_count(), 3U);
    EXPECT_NEAR(curve.driven(), straight, 1e-9);
    EXPECT_NEAR(curve.length(), straight + rho * (std::abs(curve.piece(0).length) + std::abs(curve.piece(2).length)),
                1e-9);
    double least = 1e9;
    for (const double off : {0.0, pi}) {
      const double towards = std::atan2(b.y - a.y, b.x - a.x) + off;
      least = std::min(least, std::abs(std::remainder(towards - a.theta, 2 * pi)) +
                                  std::abs(std::remainder(b.theta - towards, 2 * pi)));
    }
    EXPECT_NEAR(std::abs(curve.piece(0).length) + std::abs(curve.piece(2).length), least, 1e-9);
    for (int i = 0; i <= 20; ++i) {
      const Se2 on_way = curve.at_driven(straight * i / 20.0);
      EXPECT_NEAR(distance(on_way.position(), a.position() + i / 20.0 * (b.position() - a.position())), 0.0, 1e-9);
    }
    const Se2 last = curve.at(curve.length() * (1.0 - 1e-13));
    EXPECT_NEAR(distance(last.position(), b.position()), 0.0, 1e-9);
    EXPECT_NEAR(std::remainder(last.theta - b.theta, 2 * pi), 0.0, 1e-9);
    const SteeringCurve back(b, a, DifferentialCurve::shortest(b, a, rho), rho);
    EXPECT_NEAR(back.length(), curve.length(), 1e-9);
  }
  const SteeringCurve spot({1, 2, 0}, {1, 2, pi / 2}, DifferentialCurve::shortest({1, 2, 0}, {1, 2, pi / 2}, 0.5), 0.5);
  EXPECT_EQ(spot.driven(), 0.0);
  EXPECT_NEAR(spot.length(), pi / 4, 1e-12);
  EXPECT_EQ(spot.at(spot.length() / 2).position(), (Vec2{1, 2}));
}

}  // namespace
}  // namespace warren
