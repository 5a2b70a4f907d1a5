// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_formats_io.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace warren {
namespace {

TEST(BinaryUnit, IsTheFinestThatKeepsTheLargestBelowTwoToThe31) {
  struct Case {
    double largest;
    const char* name;
    std::int64_t multiple;
  };
  for (const Case& asked :
       {Case{1, "2^-30", 1 << 30}, Case{std::nextafter(2, 0), "2^-29", 1 << 30}, Case{2147483647, "2^0", 2147483647},
        Case{2147483647.25, "2^0", 2147483647}, Case{2147483647.5, "2^1", 1 << 30}, Case{2147483648.0, "2^1", 1 << 30},
        Case{5e-324, "2^-1104", 1 << 30}, Case{0, "2^0", 0},
        Case{std::numeric_limits<double>::max(), "2^994", 1 << 30}}) {
    const BinaryUnit unit(asked.largest);
    EXPECT_EQ(unit.name(), asked.name) << asked.largest;
    EXPECT_EQ(unit.multiple(asked.largest), asked.multiple) << asked.largest;
    EXPECT_EQ(unit.multiple(-asked.largest), -asked.multiple) << asked.largest;
  }
}

}  // namespace
}  // namespace warren
