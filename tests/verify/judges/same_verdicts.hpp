// SPDX-License-Identifier: BSD-3-Clause
// Two verdicts are the same in every field, numbers bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "verify/judges/verification.hpp"

namespace warren {

inline std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

inline void expect_same(const Verification& a, const Verification& b) {
  EXPECT_EQ(a.verified, b.verified);
  EXPECT_EQ(bits(a.length), bits(b.length));
  EXPECT_EQ(bits(a.min_clearance), bits(b.min_clearance)) << a.min_clearance << " and " << b.min_clearance;
  EXPECT_EQ(bits(a.turn_rad), bits(b.turn_rad));
  EXPECT_EQ(a.cusps, b.cusps);
  EXPECT_EQ(bits(a.reversed), bits(b.reversed));
  ASSERT_EQ(a.first_violation.has_value(), b.first_violation.has_value());
  if (!a.first_violation) return;
  EXPECT_EQ(a.first_violation->leg, b.first_violation->leg);
  EXPECT_EQ(bits(a.first_violation->distance), bits(b.first_violation->distance));
  EXPECT_EQ(a.first_violation->obstacle, b.first_violation->obstacle);
}

}  // namespace warren
