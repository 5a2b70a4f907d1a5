// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/certified_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace warren {
namespace {

/// A point that runs along the unit interval; the clearance is a function of the place.
template <class Clearance>
MotionVerdict verdict_of(const Clearance& clearance, double resolution, int* looks = nullptr) {
  int count = 0;
  const MotionVerdict verdict = certified_motion(
      [&](double t, double) {
        ++count;
        return clearance(t);
      },
      [](double t, double u) { return u - t; }, resolution);
  if (looks != nullptr) *looks = count;
  return verdict;
}

double distance_to(double obstacle, double t) { return std::abs(t - obstacle); }

TEST(CertifiedMotion, OfOnePieceTakesOneLook) {
  int looks = 0;
  EXPECT_EQ(verdict_of([](double) { return 0.6; }, 1e-6, &looks), MotionVerdict::free);
  EXPECT_EQ(looks, 1);
}

TEST(CertifiedMotion, FindsABlockedPlaceHoweverNarrow) {
  for (int i = 1; i < 200; ++i) {
    const double at = 0.005 * i;
    for (const double width : {1e-2, 1e-4}) {
      SCOPED_TRACE(testing::Message() << at << " " << width);
      const auto verdict = verdict_of([&](double t) { return distance_to(at, t) - width; }, 1e-7);
      EXPECT_EQ(verdict, MotionVerdict::blocked);
    }
  }
}

TEST(CertifiedMotion, RefusesWhatTouchesWithoutBeingSeenToTouch) {
  // 1/3 is no binary fraction: no middle ever lies there.
  EXPECT_EQ(verdict_of([](double t) { return distance_to(1.0 / 3.0, t); }, 1e-6), MotionVerdict::refused);
}

TEST(CertifiedMotion, AcceptsWhatKeepsMoreThanTheResolution) {
  EXPECT_EQ(verdict_of([](double t) { return std::max(distance_to(0.3, t), 1e-3); }, 1e-3), MotionVerdict::free);
  EXPECT_EQ(verdict_of([](double) { return 1e-3; }, 1e-3), MotionVerdict::free);
  EXPECT_EQ(verdict_of([](double) { return 1e-4; }, 1e-3), MotionVerdict::refused);
}

TEST(CertifiedMotion, LooksBreadthFirst) {
  int looks = 0;
  EXPECT_EQ(verdict_of([](double t) { return t == 1.0 - 1.0 / 16.0 ? 0.0 : 1e-9; }, 1e-6, &looks),
            MotionVerdict::blocked);
  EXPECT_EQ(looks, 15);  // all of four levels
}

/// With more pieces than the queue holds the rest is done depth first: the same verdict, every piece looked at once.
TEST(CertifiedMotion, LooksAtEveryPieceOnceWhenThereAreMany) {
  for (const double clearance : {1e-3, 1e-4, 1e-5}) {
    std::multiset<double> places;
    const MotionVerdict verdict = verdict_of(
        [&](double t) {
          places.insert(t);
          return clearance;
        },
        0.5 * clearance);
    EXPECT_EQ(verdict, MotionVerdict::free);
    const std::set<double> different(places.begin(), places.end());
    EXPECT_EQ(different.size(), places.size());
    int level = 0;
    while (std::ldexp(0.5, -level) >= clearance) ++level;
    EXPECT_EQ(places.size(), (std::size_t{2} << level) - 1);
  }
}

TEST(CertifiedMotion, FindsTheOneBlockedPieceAmongMany) {
  for (int i = 1; i < 4096; i += 97) {
    const double at = (i + 0.5) / 4096.0;
    EXPECT_EQ(verdict_of([&](double t) { return t == at ? -1.0 : 1e-5; }, 1e-6), MotionVerdict::blocked);
  }
}

TEST(CertifiedMotion, OfLengthZeroIsFreeWhereItStandsFree) {
  const auto still = [](double clearance) {
    return certified_motion([=](double, double) { return clearance; }, [](double, double) { return 0.0; }, 1e-3);
  };
  EXPECT_EQ(still(1e-9), MotionVerdict::free);
  EXPECT_EQ(still(0.0), MotionVerdict::blocked);
}

}  // namespace
}  // namespace warren
