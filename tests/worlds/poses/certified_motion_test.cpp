// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/certified_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/base/rng.hpp"

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

/// Proved free, to both sides of its middle.
struct Stretch {
  double middle;
  double half;
};

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

/// Parts whose clearances fall off towards a place of their own, which some of them touch.
TEST(CertifiedParts, JudgesAsAllPartsAtOnceAndLooksAtNoPieceTwice) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    constexpr std::uint32_t count = 5;
    const auto clearance = [&](std::uint32_t part, double t) {
      const double least = 0.04 * uniform(seed, part, 0) - (seed % 2 == 0 ? 0.004 : 0.0);
      return std::abs(t - uniform(seed, part, 1)) + least;
    };
    std::uint64_t all_looks = 0;
    const auto together = [&](double t, double) {
      double least = 1.0;
      for (std::uint32_t part = 0; part < count; ++part) least = std::min(least, clearance(part, t));
      all_looks += count;
      return least;
    };
    const MotionVerdict expected = certified_motion(
        together, [](double t, double u) { return u - t; }, 1e-6);
    std::uint64_t looks = 0;
    std::vector<std::vector<Stretch>> proved(count);
    const auto look = [&](double middle, double half, std::uint32_t& parts) {
      for (std::uint32_t part = 0; part < count; ++part) {
        if ((parts >> part & 1U) == 0) continue;
        ++looks;
        for (const Stretch& s : proved[part]) EXPECT_GE(std::abs(middle - s.middle), s.half);
        if (clearance(part, middle) <= 0.0) return -1.0;
        if (clearance(part, middle) <= half) continue;
        proved[part].push_back({middle, half});
        parts ^= 1U << part;
      }
      return 0.0;
    };
    const MotionVerdict verdict = certified_parts((1U << count) - 1, look, 1e-6);
    EXPECT_EQ(verdict, expected);
    EXPECT_LE(looks, all_looks);
    if (verdict != MotionVerdict::free) continue;
    for (const auto& stretches : proved) {
      double sum = 0.0;
      for (const Stretch& s : stretches) sum += 2.0 * s.half;
      EXPECT_EQ(sum, 1.0);  // of every part, all pieces once
    }
  }
}

/// What is proved around the middles covers the motion, and looks are not spent on it again.
TEST(CertifiedParts, CutsOnlyWhatIsNotProvedYet) {
  for (const double clearance : {0.3, 0.07, 1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(clearance);
    std::vector<Stretch> proved;
    const auto look = [&](double middle, double half, std::uint32_t& parts) {
      for (const Stretch& s : proved) EXPECT_GE(std::abs(middle - s.middle), s.half);
      proved.push_back({middle, std::min(half, clearance)});
      if (clearance > half) parts = 0;
      return proved.back().half;
    };
    EXPECT_EQ(certified_parts(1, look, 1e-6), MotionVerdict::free);
    std::sort(proved.begin(), proved.end(), [](const Stretch& a, const Stretch& b) { return a.middle < b.middle; });
    double reached = 0.0;
    for (const Stretch& s : proved) {
      EXPECT_NEAR(s.middle - s.half, reached, 1e-12);
      reached = s.middle + s.half;
    }
    EXPECT_NEAR(reached, 1.0, 1e-12);
    int halvings = 0;
    EXPECT_EQ(verdict_of([&](double) { return clearance; }, 1e-6, &halvings), MotionVerdict::free);
    EXPECT_LE(proved.size(), static_cast<std::size_t>(halvings));
    EXPECT_LE(static_cast<double>(proved.size()), 2.0 / clearance);
  }
}

TEST(CertifiedParts, FindsWhatIsBlockedBesideWhatIsProved) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const double at = uniform(seed, 0, 0);
    const double width = seed % 2 == 0 ? 1e-3 : -1e-3;  // negative: a gap that can be passed
    const auto look = [&](double middle, double half, std::uint32_t& parts) {
      const double clearance = distance_to(at, middle) - width;
      if (clearance <= 0.0) return -1.0;
      if (clearance > half) parts = 0;
      return std::min(half, 0.999 * clearance);
    };
    EXPECT_EQ(certified_parts(1, look, 1e-7), width > 0.0 ? MotionVerdict::blocked : MotionVerdict::free);
  }
}

}  // namespace
}  // namespace warren
