// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plot_svg.hpp"

#include <gtest/gtest.h>

namespace warren {
namespace {

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

TEST(PlotSvg, EveryPointHasAMarkAndTheLegendOneMore) {
  EXPECT_EQ(count_of(plot_svg(plot_of({{1, 1}, {2, 5}, {3, 2}}, false)), "<circle"), 4U);
}

TEST(PlotSvg, WhatALogarithmCantShowIsLeftOut) {
  const std::string text = plot_svg(plot_of({{10, 1}, {100, 0}, {0, 5}, {-1, -1}, {1000, 2}}, true));
  EXPECT_EQ(count_of(text, "<circle"), 3U);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(PlotSvg, EmptyAndSinglePointsStillGiveAPlot) {
  for (const std::vector<Vec2>& points : {std::vector<Vec2>{}, {{5, 5}}, {{0, 0}}, {{3, 7}, {3, 7}}}) {
    for (const bool logarithmic : {false, true}) {
      const std::string text = plot_svg(plot_of(points, logarithmic));
      EXPECT_TRUE(text.ends_with("</svg>\n"));
      EXPECT_EQ(text.find("nan"), std::string::npos) << text;
      EXPECT_EQ(text.find("inf"), std::string::npos) << text;
    }
  }
}

TEST(PlotSvg, TheLevelIsInsideTheFrameAndNamed) {
  Plot plot = plot_of({{1, 1}, {10, 2}}, true);
  plot.level = 20.0;  // above all points
  plot.level_name = "budget 20 s";
  const std::string text = plot_svg(plot);
  EXPECT_NE(text.find("budget 20 s"), std::string::npos);
  EXPECT_EQ(text.find("=\"-"), std::string::npos) << "a place outside the picture";
}

TEST(PlotSvg, TextIsEscaped) {
  const std::string text = plot_svg(plot_of({{1, 1}}, false));
  EXPECT_NE(text.find("times &amp; &lt;sizes&gt;"), std::string::npos);
  EXPECT_EQ(text.find("<sizes>"), std::string::npos);
}

}  // namespace
}  // namespace warren
