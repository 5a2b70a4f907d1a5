// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/letters.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "pictures/model/axis.hpp"

namespace warren {
namespace {

TEST(Letters, AreAsWideAsTheirFontSays) {
  EXPECT_NEAR(text_width("i", 1000), 278, 1);         // DejaVu Sans: 569 of 2048 units
  EXPECT_NEAR(text_width("W", 1000), 989, 1);         // 2025
  EXPECT_NEAR(text_width("~", 1000), 838, 1);         // 1716, the last of ASCII
  EXPECT_NEAR(text_width("\xc3\xbf", 1000), 592, 1);  // y with diaeresis, the last: 1212
  EXPECT_EQ(text_width("", 10), 0.0);
  EXPECT_DOUBLE_EQ(text_width("ab", 10), text_width("a", 10) + text_width("b", 10));
}

TEST(Letters, HaveTheirShapes) {
  EXPECT_EQ(text_outlines(" ", 10).size(), 0U);
  EXPECT_EQ(text_outlines("l", 10).size(), 1U);
  EXPECT_EQ(text_outlines("o", 10).size(), 2U);
  EXPECT_EQ(text_outlines("B8", 10).size(), 6U);
  const PolygonSet plain = text_outlines("o", 10);
  const PolygonSet accented = text_outlines("\xc3\xb6", 10);  // its contours are the plain one's, and the dots
  ASSERT_EQ(accented.size(), 4U);
  EXPECT_TRUE(std::any_of(accented.corners.begin(), accented.corners.end(),
                          [&](Vec2 p) { return p == plain.corners.front(); }));
  Box box;
  for (const Vec2 p : text_outlines("H", 100).corners) box.include(p);
  EXPECT_NEAR(box.height(), 73, 1);  // of the size: its capitals
  EXPECT_NEAR(box.max.y, 0.0, 1e-9) << "it stands on the line";
}

TEST(Letters, UnknownOnesAreQuestionMarks) {
  EXPECT_EQ(latin1_text("a\xe2\x82\xac\xff\n"), "a???");
  EXPECT_EQ(latin1_text("\xc3\xa9"), "\xe9");
}

TEST(Letters, LinesAreCutWhereTheyDoNotFit) {
  EXPECT_EQ(fitting_text("short", 10, 100), "short");
  const std::string cut = fitting_text("much too long for this", 10, 60);
  EXPECT_TRUE(cut.ends_with("..."));
  EXPECT_LE(text_width(cut, 10), 60);
  const auto lines = wrapped_text("one two three four", 10, 50);
  EXPECT_GT(lines.size(), 1U);
  for (const std::string& line : lines) EXPECT_LE(text_width(line, 10), 50) << line;
}

TEST(Letters, WrappedLinesKeepAKeyAndItsValueTogether) {
  const std::string text = "prm, uniform, length 485, seed 1; a disc of radius 0.25";
  for (double width = 80.0; width < 400.0; width += 1.0) {
    const auto lines = wrapped_text(text, 10, width);
    std::string joined;
    for (const std::string& line : lines) {
      joined += (joined.empty() ? "" : " ") + line;
      EXPECT_LE(text_width(line, 10), width);
      EXPECT_NE(line, "1;") << width;
      EXPECT_FALSE(line.ends_with("seed") || line.ends_with("length")) << line;
    }
    EXPECT_EQ(joined, text) << width;
  }
  EXPECT_TRUE(wrapped_text("", 10, 50).empty());
}

TEST(Ticks, AreRoundAndCoverTheRange) {
  EXPECT_DOUBLE_EQ(tick_step(10, 5), 2.0);
  EXPECT_DOUBLE_EQ(tick_step(0.07, 7), 0.01);
  EXPECT_EQ(ticks_between(-1, 1, 0.5).size(), 5U);
  EXPECT_EQ(tick_text(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tick_text(-1e-17, 0.1), "0");
  EXPECT_EQ(tick_text(4000, 500), "4000");
  EXPECT_EQ(tick_text(3e9, 1e9), "3e+09");
}

}  // namespace
}  // namespace warren
