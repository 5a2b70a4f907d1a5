// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/arms/arm_files_io.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

DhTable read_table(const std::string& text) {
  const TemporaryDirectory directory;
  return read_dh_table(InputFile(directory.write("arm.dh", text), {}), {});
}

TEST(DhTable, ReadsThePumaAsItIsBuiltIn) {
  const DhTable table = read_table(R"(# Puma 560
convention standard
angles degrees
joint 0       0      90  -160 160
joint 0       0.4318 0   -45 225
joint 0.15005 0.0203 -90 -225 45
joint 0.4318, 0, 90, -110, 170   # commas too
joint 0 0 -90 -100 100
joint 0 0 0 -266 266
tool 0 0 0.1
)");
  const DhTable puma = puma560_table(0.1);
  ASSERT_EQ(table.joints.size(), 6U);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const JointState q = arm_oracle::random_state(puma, 1, i);
    EXPECT_LT((SerialChain(table).tool_pose(q).matrix() - SerialChain(puma).tool_pose(q).matrix()).norm(), 1e-14);
  }
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_DOUBLE_EQ(table.joints[j].low_rad, puma.joints[j].low_rad);
    EXPECT_DOUBLE_EQ(table.joints[j].high_rad, puma.joints[j].high_rad);
  }
}

TEST(DhTable, TakesRadiansOffsetsAndTheOtherConvention) {
  const DhTable table = read_table("joint 1 2 0.5 -1 1 0.25\nconvention modified");
  ASSERT_EQ(table.joints.size(), 1U);
  EXPECT_EQ(table.convention, DhConvention::modified);
  EXPECT_EQ(table.joints[0].d, 1.0);
  EXPECT_EQ(table.joints[0].a, 2.0);
  EXPECT_EQ(table.joints[0].alpha_rad, 0.5);
  EXPECT_EQ(table.joints[0].offset_rad, 0.25);
}

TEST(DhTable, RefusesBadInputInOneLineThatNamesFileAndLine) {
  struct Case {
    const char* text;
    const char* says;
  };
  std::string seven;
  for (int i = 0; i < 7; ++i) seven += "joint 0 1 0 -1 1\n";
  const Case cases[] = {{"", ":1: the file ends without any `joint"},
                        {"# nothing\n\n", "the file ends without any"},
                        {"joint 0 1 0 -1\n", ":1: expected `joint D A ALPHA LOW HIGH [OFFSET]` (found: 4 numbers)"},
                        {"joint 0 1 0 -1 1 0 7\n", "7 numbers"},
                        {"joint 0\n", "(found: 1 number)"},
                        {"\njoint 0 1 0 1 -1\n", ":2: LOW must not exceed HIGH"},
                        {"joint 0 1 x -1 1\n", "expected a number (found: x)"},
                        {"joint 0 1 nan -1 1\n", ":1:"},
                        {"convention other\n", "expected `convention standard|modified` (found: other)"},
                        {"angles\n", "expected `angles radians|degrees`"},
                        {"angles degrees please\n", "expected `angles radians|degrees`"},
                        {"tool 1 2\n", "expected `tool X Y Z`"},
                        {"tool 0 0 1\njoint 0 1 0 -1 1\ntool 0 0 2\n", ":3: a second `tool` line"},
                        {"angles degrees\nangles radians\n", ":2: a second `angles` line"},
                        {"link 1 2\n", "expected one of joint, convention, angles, tool (found: link)"},
                        {seven.c_str(), ":7: an arm has at most 6 joints"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const std::string said = test::refusal<InputError>([&] { read_table(c.text); });
    EXPECT_NE(said.find(c.says), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace warren
