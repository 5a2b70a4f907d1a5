// SPDX-License-Identifier: BSD-3-Clause
// Bounds of all paths on random maps: below what paths cost, proved to the judge and to an oracle that samples; and
// certificates that are none.
#include "verify/judges/verify_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"
#include "planners/grid/price_field.hpp"
#include "planners/grid/price_potential.hpp"
#include "spatial/maps/distance_field.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

struct Asked {
  OccupancyMap map;
  PotentialClaim claim;
  Cell start;
  Cell goal;
};

Asked random_question(std::uint64_t seed) {
  SequentialRng rng(seed);
  Asked asked;
  const auto width = static_cast<std::uint32_t>(8 + rng.below(16));
  const auto height = static_cast<std::uint32_t>(8 + rng.below(16));
  asked.map.blocked = Bitmap(width, height);
  asked.map.cell = 0.05 * static_cast<double>(1 + rng.below(40));
  asked.map.origin = {static_cast<double>(rng.below(9)) - 4.3, static_cast<double>(rng.below(9)) - 4.7};
  if (rng.below(3) == 0) asked.map.yaw_rad = 0.1 * static_cast<double>(rng.below(60));
  const std::uint64_t share = rng.below(25);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      if (rng.below(100) < share) asked.map.blocked.set(x, y);
    }
  }
  if (rng.below(3) != 0) {
    asked.claim.price = static_cast<double>(rng.below(60)) / 10.0;
    asked.claim.reach = asked.map.cell * static_cast<double>(1 + rng.below(60)) / 10.0;
  }
  if (rng.below(3) == 0) asked.claim.radius = asked.map.cell * static_cast<double>(rng.below(25)) / 10.0;
  asked.claim.keeps = asked.claim.radius;
  asked.start = {0, static_cast<std::uint32_t>(rng.below(height))};
  asked.goal = {width - 1, static_cast<std::uint32_t>(rng.below(height))};
  if (rng.below(2) == 0) asked.start = {static_cast<std::uint32_t>(rng.below(width)), asked.start.y};
  return asked;
}

double distance_to_blocked(const Bitmap& blocked, Vec2 p) {
  double least = std::min({p.x, p.y, blocked.width() - p.x, blocked.height() - p.y});
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    for (std::uint32_t x = 0; x < blocked.width(); ++x) {
      if (!blocked.test(x, y)) continue;
      const double dx = std::max({x - p.x, p.x - x - 1.0, 0.0});
      const double dy = std::max({y - p.y, p.y - y - 1.0, 0.0});
      least = std::min(least, std::sqrt(dx * dx + dy * dy));
    }
  }
  return least;
}

/// What length costs at a place, in cells; below 0: the middle can't be there.
double price_at(const Asked& asked, Vec2 p) {
  const double d = distance_to_blocked(asked.map.blocked, p) * asked.map.cell;
  if (d < asked.claim.keeps - 1e-9) return -1.0;
  if (!(asked.claim.price > 0.0)) return 1.0;
  const double share = std::max(0.0, 1.0 - (d - asked.claim.radius) / asked.claim.reach);
  return 1.0 + asked.claim.price * share * share;
}

/// Is no slope of the certificate above the price at any of many places of its triangle?
void expect_proof(const Asked& asked, const CellPotential& proof) {
  const std::uint32_t parts = proof.width / asked.map.width();
  const double side = asked.map.cell / parts;
  for (std::uint32_t y = 0; y < proof.height; ++y) {
    for (std::uint32_t x = 0; x < proof.width; ++x) {
      if (asked.map.blocked.test(x / parts, y / parts)) continue;
      const double m = proof.values[proof.middle(x, y)];
      const std::size_t at[] = {proof.corner(x, y), proof.corner(x + 1, y), proof.corner(x + 1, y + 1),
                                proof.corner(x, y + 1)};
      const Vec2 places[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (std::size_t i = 0; i < 4; ++i) {
        const double a = proof.values[at[i]];
        const double b = proof.values[at[(i + 1) % 4]];
        const double along = (b - a) / side;
        const double across = (m - 0.5 * (a + b)) / (0.5 * side);
        const double slope = std::sqrt(along * along + across * across);
        if (slope <= 1.0) continue;
        for (int u = 0; u <= 3; ++u) {
          for (int v = 0; u + v <= 3; ++v) {
            const Vec2 in_cell =
                (u / 3.0) * places[i] + (v / 3.0) * places[(i + 1) % 4] + ((3 - u - v) / 3.0) * Vec2{0.5, 0.5};
            const Vec2 p = (1.0 / parts) * (Vec2{static_cast<double>(x), static_cast<double>(y)} + in_cell);
            const double price = price_at(asked, p);
            ASSERT_TRUE(price < 0.0 || slope <= price + 1e-9) << x << ", " << y << ", triangle " << i;
          }
        }
      }
    }
  }
}

/// Of a path over cells, in world units, by sums over short pieces; none: nothing joins the two.
std::optional<double> cost_over_cells(const Asked& asked, const Execution& execution) {
  const Bitmap wide = blocked_for_disc(asked.map.blocked, asked.claim.keeps / asked.map.cell, execution);
  if (wide.test(asked.start.x, asked.start.y) || wide.test(asked.goal.x, asked.goal.y)) return std::nullopt;
  StepWeights weights(wide, Diagonal::sqrt2, execution);
  const PriceField::Goal goals[] = {{asked.goal}};
  PriceField field(weights, goals, {}, execution);
  if (!field.cost(asked.start, execution)) return std::nullopt;
  const std::vector<Cell> cells = field.path(asked.start, execution).first;
  double sum = 0.0;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const Vec2 a{cells[i - 1].x + 0.5, cells[i - 1].y + 0.5};
    const Vec2 b{cells[i].x + 0.5, cells[i].y + 0.5};
    constexpr int pieces = 32;
    for (int n = 0; n < pieces; ++n) {
      sum += distance(a, b) / pieces * price_at(asked, a + ((n + 0.5) / pieces) * (b - a));
    }
  }
  return sum * asked.map.cell;
}

struct Made {
  Asked asked;
  CellPotential proof;
  double cost = 0.0;
};

/// none: a map on which nothing joins the two.
std::optional<Made> made(std::uint64_t seed) {
  const Execution execution{.threads = 1};
  Asked asked = random_question(seed);
  const auto cost = cost_over_cells(asked, execution);
  if (!cost) return std::nullopt;
  const double cell = asked.map.cell;
  const auto middle = [](Cell c) { return Vec2{c.x + 0.5, c.y + 0.5}; };
  const PotentialQuestion question{asked.map.blocked,        middle(asked.start),       middle(asked.goal),
                                   asked.claim.keeps / cell, asked.claim.radius / cell, asked.claim.price,
                                   asked.claim.reach / cell};
  auto found = price_potential(question, {.parts = 1 + static_cast<std::uint32_t>(seed % 3)}, execution);
  EXPECT_TRUE(found) << seed;
  if (!found) return std::nullopt;
  for (double& value : found->values.values) value *= cell;
  asked.claim.start = cell_centre(asked.map, asked.start);
  asked.claim.goal = cell_centre(asked.map, asked.goal);
  asked.claim.lower_bound = found->bound * cell * (1.0 - 1e-11);
  return Made{std::move(asked), std::move(found->values), *cost};
}

TEST(Potential, IsAProofOnRandomMapsAndBelowWhatPathsCost) {
  const Execution execution;
  double share = 0.0;
  int count = 0;
  for (const std::uint64_t seed : test::seeds(10'000, 25)) {
    SCOPED_TRACE(seed);
    const auto one = made(seed);
    if (!one) continue;
    ASSERT_LE(one->asked.claim.lower_bound, one->cost * (1.0 + 1e-3 * 1e-3));
    const JudgedBound judged = verify_potential(one->asked.map, one->asked.claim, one->proof, execution);
    ASSERT_EQ(judged.verdict, BoundVerdict::checked) << judged.what;
    expect_proof(one->asked, one->proof);
    if (testing::Test::HasFatalFailure()) return;
    if (one->cost > 0.0) {
      share += one->asked.claim.lower_bound / one->cost;
      ++count;
    }
  }
  ASSERT_GT(count, 2);
  EXPECT_GT(share / count, 0.7);  // as a bound it is worth something
}

TEST(Potential, OneValueRaisedIsRefused) {
  const Execution execution;
  int refused = 0;
  for (const std::uint64_t seed : test::seeds(200, 16)) {
    SCOPED_TRACE(seed);
    auto one = made(seed);
    if (!one || one->asked.start == one->asked.goal) continue;
    const auto parts = one->proof.width / one->asked.map.width();
    // Of a disc a part of the start's cell may be none of its middle's: the part at the middle of the cell is.
    const std::size_t at =
        one->proof.middle(one->asked.start.x * parts + parts / 2, one->asked.start.y * parts + parts / 2);
    one->proof.values[at] += 5.0 * (1.0 + one->asked.claim.price) * one->asked.map.cell;
    EXPECT_EQ(verify_potential(one->asked.map, one->asked.claim, one->proof, execution).verdict, BoundVerdict::refuted);
    ++refused;
  }
  EXPECT_GT(refused, 0);
}

TEST(Potential, ABoundAboveItsCertificateIsRefusedAndOneOfAnotherMap) {
  const Execution execution;
  for (const std::uint64_t seed : {3U, 4U, 5U, 6U}) {
    auto one = made(seed);
    if (!one) continue;
    PotentialClaim claim = one->asked.claim;
    claim.lower_bound = claim.lower_bound * 1.01 + 1e-6;
    EXPECT_EQ(verify_potential(one->asked.map, claim, one->proof, execution).verdict, BoundVerdict::refuted);
    one->proof.values.back() = std::nan("");  // means nothing
    EXPECT_EQ(verify_potential(one->asked.map, one->asked.claim, one->proof, execution).verdict, BoundVerdict::checked);
    one->proof.width += 1;
    EXPECT_EQ(verify_potential(one->asked.map, one->asked.claim, one->proof, execution).verdict, BoundVerdict::refuted);
  }
}

TEST(Potential, NotANumberIsNoProof) {
  const Execution execution;
  auto one = made(7);
  for (std::uint64_t seed = 8; !one; ++seed) one = made(seed);
  for (double& value : one->proof.values) value = std::nan("");
  EXPECT_EQ(verify_potential(one->asked.map, one->asked.claim, one->proof, execution).verdict, BoundVerdict::refuted);
}

}  // namespace
}  // namespace warren
