// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/error.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/base/enum_names.hpp"

namespace warren {
namespace {

enum class Fruit : std::uint8_t { apple, sour_cherry };
constexpr auto enum_names(Fruit) { return std::array<std::string_view, 2>{"apple", "sour-cherry"}; }

TEST(UsageError, EachCallerSpellsAnOptionInHisOwnWay) {
  const UsageError error("@goal_bias: must be a number from 0 to 1; rrt takes @goal_bias, see b@d_name");
  EXPECT_STREQ(error.what(), "goal_bias: must be a number from 0 to 1; rrt takes goal_bias, see b@d_name");
  EXPECT_EQ(error.spelled("--", '-'), "--goal-bias: must be a number from 0 to 1; rrt takes --goal-bias, see b@d_name");
}

TEST(UsageError, AnAtThatBeginsNoWordStays) {
  EXPECT_EQ(UsageError("@").spelled("--", '-'), "@");
  EXPECT_EQ(UsageError("a @ b @1").spelled("--", '-'), "a @ b @1");
  EXPECT_EQ(UsageError("").spelled("--", '-'), "");
}

TEST(Error, WhatComesFromFilesIsPrintable) {
  EXPECT_STREQ(InputError("a.scene:3", "no such word", "\x1b[2J").what(), "a.scene:3: no such word (found: \\x1b[2J)");
  EXPECT_EQ(UsageError("@json: \n").spelled("--", '-'), "--json: \\x0a");
}

TEST(PlacedError, TellsItsParts) {
  const InputError whole("a.scene:3", "no such word", "\x1b");
  EXPECT_EQ(whole.where(), "a.scene:3");
  EXPECT_EQ(whole.wrong(), "no such word");
  EXPECT_EQ(whole.value(), "\\x1b");
  const InputError plain("\n", "");
  EXPECT_EQ(plain.where(), "\\x0a");
  EXPECT_EQ(plain.wrong(), "");
  EXPECT_EQ(plain.value(), "");
  const ReadError gone("a: b", "no such file");
  EXPECT_EQ(gone.where(), "a: b");
  EXPECT_EQ(gone.wrong(), "can't be read: no such file");
}

TEST(EnumNames, LeadBothWays) {
  EXPECT_EQ(name_of(Fruit::sour_cherry), "sour-cherry");
  EXPECT_EQ(enum_named<Fruit>("sour-cherry"), Fruit::sour_cherry);
  EXPECT_EQ(enum_named<Fruit>("sour_cherry"), std::nullopt);
  EXPECT_EQ(enum_named<Fruit>(""), std::nullopt);
}

}  // namespace
}  // namespace warren
