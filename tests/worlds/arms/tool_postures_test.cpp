// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "tests/seeds.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

using namespace arm_oracle;

/// Joints at their limits, too: there least is left around what reaches.
JointState state_within(const DhTable& table, std::uint64_t i) {
  JointState q = random_state(table, 11, i);
  for (std::size_t k = 0; k < table.joints.size(); ++k) {
    const std::uint64_t bits = random_bits(i, k);
    if (bits % 4 == 0) q[k] = bits % 8 == 0 ? table.joints[k].low_rad : table.joints[k].high_rad;
  }
  return q;
}

TEST(ToolPostures, AreFoundWhereverTheToolReaches) {
  for (const double tool : {0.05, 0.3, 0.5, 1.2}) {
    for (const PumaLimits limits : {PumaLimits::classic, PumaLimits::symmetric}) {
      const DhTable table = puma560_table(tool, limits);
      const SerialChain chain(table);
      for (const std::uint64_t i : test::seeds(200)) {
        SCOPED_TRACE(i);
        const Point place = points(table, state_within(table, i)).back();
        const ToolPostures found = tool_postures(chain, {place[0], place[1], place[2]}, 0.25, 1, {});
        ASSERT_FALSE(found.none_is_left) << "there is one";
        for (const JointState& q : found.states) {
          EXPECT_LT(apart(points(table, q).back(), place), 1e-9);
          EXPECT_TRUE(is_within_limits(table, q));
          EXPECT_EQ(q[5], 0.25);
        }
      }
    }
  }
}

TEST(ToolPostures, OfNoneThatIsProved) {
  const SerialChain chain(puma560_table(0.5));
  EXPECT_TRUE(tool_postures(chain, {2.0, 0.0, 0.0}, 0.0, 1, {}).none_is_left) << "too far";
  EXPECT_TRUE(tool_postures(chain, {0.0, 0.0, 1.5}, 0.0, 1, {}).none_is_left) << "too high";
  EXPECT_FALSE(tool_postures(chain, {-0.059, 0.09, 0.758}, 0.0, 1, {}).states.empty());
  EXPECT_GE(tool_postures(chain, {0.5, 0.2, 0.3}, 0.0, 64, {}).states.size(), 64U);
}

}  // namespace
}  // namespace warren
