// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace warren {
namespace {

std::string plot_svg(const Plot& plot) { return sheet_of(plot).svg(); }

std::size_t count_of(const std::string& text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

Plot plot_of(std::vector<Vec2> points, bool logarithmic) {
  return {.title = "times & <sizes>",
          .x_label = "cells",
          .y_label = "s",
          .log_x = logarithmic,
          .log_y = logarithmic,
          .series = {{.name = "solve", .points = std::move(points)}}};
}

TEST(Plot, EveryPointHasAMarkAndTheLegendOneMore) {
  EXPECT_EQ(count_of(plot_svg(plot_of({{1, 1}, {2, 5}, {3, 2}}, false)), "<circle"), 4U);
}

TEST(Plot, WhatALogarithmCantShowIsLeftOut) {
  const std::string text = plot_svg(plot_of({{10, 1}, {100, 0}, {0, 5}, {-1, -1}, {1000, 2}}, true));
  EXPECT_EQ(count_of(text, "<circle"), 3U);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(Plot, EmptyAndSinglePointsStillGiveAPlot) {
  for (const std::vector<Vec2>& points : {std::vector<Vec2>{}, {{5, 5}}, {{0, 0}}, {{3, 7}, {3, 7}}}) {
    for (const bool logarithmic : {false, true}) {
      const std::string text = plot_svg(plot_of(points, logarithmic));
      EXPECT_TRUE(text.ends_with("</svg>\n"));
      EXPECT_EQ(text.find("nan"), std::string::npos) << text;
      EXPECT_EQ(text.find("inf"), std::string::npos) << text;
    }
  }
}

TEST(Plot, TheLevelIsInsideTheFrameAndNamed) {
  Plot plot = plot_of({{1, 1}, {10, 2}}, true);
  plot.level = 20.0;  // above all points
  plot.level_name = "budget 20 s";
  const std::string text = plot_svg(plot);
  EXPECT_NE(text.find("budget 20 s"), std::string::npos);
  EXPECT_EQ(text.find("=\"-"), std::string::npos) << "a place outside the picture";
}

/// The x of the right end of the frame, which is drawn as the last <rect>.
double frame_end(const std::string& text) {
  const std::size_t at = text.rfind("<rect x=\"");
  const double left = std::stod(text.substr(at + 9));
  return left + std::stod(text.substr(text.find("width=\"", at) + 7));
}

TEST(Plot, LongNamesHaveRoomBesideTheFrame) {
  Plot plot = plot_of({{1, 1}, {2, 2}}, false);
  const double usual = frame_end(plot_svg(plot));
  plot.series[0].name = std::string(40, 'w');
  EXPECT_LT(frame_end(plot_svg(plot)), usual);
  EXPECT_LE(frame_end(plot_svg(plot)) + 40 * 6.5, 760.0);
  plot.series[0].name = std::string(4000, 'w');
  EXPECT_GT(frame_end(plot_svg(plot)), 300.0) << "some of the plot is left";
}

TEST(Plot, WhatIsCountedHasNoTicksBetweenWholeNumbers) {
  Plot plot = plot_of({{1, 1}, {2, 2}}, false);
  EXPECT_NE(plot_svg(plot).find(">1.2<"), std::string::npos);
  plot.whole_x = true;
  plot.series[0].points = {{1, 3}, {2, 3}};
  EXPECT_EQ(plot_svg(plot).find(">1.2<"), std::string::npos);
  EXPECT_NE(plot_svg(plot).find(">1<"), std::string::npos);
  EXPECT_NE(plot_svg(plot).find(">2<"), std::string::npos);
}

TEST(Plot, SmallPowersOfTenAreShort) {
  const std::string text = plot_svg(plot_of({{1e-6, 1e-7}, {1e3, 1e-2}}, true));
  EXPECT_NE(text.find(">1e-6<"), std::string::npos);
  EXPECT_EQ(text.find("e-0"), std::string::npos);
}

TEST(Plot, TicksOfSecondsAreInTheUnitThatFits) {
  Plot plot = plot_of({{1e-5, 1e-5}, {1e3, 1e-2}}, true);
  EXPECT_NE(plot_svg(plot).find(">1e-5<"), std::string::npos);
  plot.y_label = "seconds (least)";
  const std::string text = plot_svg(plot);
  for (const char* tick : {">10 us<", ">100 us<", ">1 ms<", ">10 ms<"}) {
    EXPECT_NE(text.find(tick), std::string::npos) << tick;
  }
  EXPECT_NE(text.find(">1e-5<"), std::string::npos) << "the other axis counts no seconds";
}

TEST(Plot, TheLevelIsNamedBesideTheFrameWhereNoLineRuns) {
  Plot plot = plot_of({{1, 1}, {10, 2}}, true);
  plot.level = 1.0;
  plot.level_name = "as fast as the heap";
  const std::string text = plot_svg(plot);
  const std::size_t name = text.find(">as fast as the heap<");
  EXPECT_GT(std::stod(text.substr(text.rfind("x=\"", name) + 3)), frame_end(text));
}

TEST(Plot, OfSeriesThatCoincideBothAreSeen) {
  Plot plot = plot_of({{1, 1}, {2, 2}}, false);
  plot.series.push_back(plot.series.front());
  const std::string text = plot_svg(plot);
  EXPECT_EQ(count_of(text, "r=\"3.5\""), 3U);
  EXPECT_EQ(count_of(text, "r=\"4.5\""), 3U) << "rings around them";
  EXPECT_EQ(count_of(text, "stroke-width=\"2.6\""), 2U);
  EXPECT_EQ(count_of(text, "stroke-width=\"1.2\""), 3U + 2U) << "thin lines upon them";
}

TEST(Plot, StepsAreLevelAndHaveABandInsteadOfMarkers) {
  constexpr double never = std::numeric_limits<double>::infinity();
  Plot plot = plot_of({{1, never}, {2, 5}, {4, 3}}, false);
  plot.series[0].steps = true;
  plot.series[0].spans = {{4, never}, {3, 6}, {2, 4}};
  const std::string text = plot_svg(plot);
  EXPECT_EQ(count_of(text, "<circle"), 0U);
  const std::size_t line = text.find("<path d=\"M", text.find("opacity"));
  const std::string places = text.substr(line + 9, text.find('"', line + 9) - line - 9);
  EXPECT_EQ(count_of(places, "L"), 2U) << "from 2 to 4 at the height of 5, then down: " << places;
  EXPECT_EQ(count_of(text, "opacity="), 1U);
  EXPECT_EQ(text.find("inf"), std::string::npos) << "a band without an end is cut by the frame";
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(Plot, TextIsEscaped) {
  const std::string text = plot_svg(plot_of({{1, 1}}, false));
  EXPECT_NE(text.find("times &amp; &lt;sizes&gt;"), std::string::npos);
  EXPECT_EQ(text.find("<sizes>"), std::string::npos);
}

}  // namespace
}  // namespace warren
