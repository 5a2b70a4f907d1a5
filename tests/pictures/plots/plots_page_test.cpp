// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>

#include "pictures/formats/surface.hpp"
#include "pictures/plots/plot.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

/// What is drawn, as words.
class SaidSurface : public Surface {
 public:
  void enter_world() override {}
  void leave_world() override {}
  void begin_group(std::string_view, std::string_view, const Pen&) override {}
  void end_group() override {}
  void take_pen(const Pen& pen) override { pen_ = pen; }
  void segment(Vec2, Vec2) override {}
  void chain(std::span<const Vec2> points, std::span<const double>, bool) override {
    chains.push_back({points.begin(), points.end()});
  }
  void text(const PlacedText& text) override { texts.push_back(text); }
  bool takes_as_mask(std::size_t) const override { return false; }
  void mask(const Mask&, Rgb) override {}
  double image_density() const override { return 1.0; }
  void image(const Image&, const Box&) override {}

  std::vector<std::vector<Vec2>> chains;
  std::vector<PlacedText> texts;

 private:
  Pen pen_;
};

PlotSheet some_plot(bool dashed) {
  return sheet_of(Plot{.title = "times",
                       .x_label = "cells",
                       .y_label = "s",
                       .series = {{.name = "solve", .points = {{1, 1}, {2, 4}, {3, 9}}, .dashed = dashed}}});
}

std::string bytes_of(const PlotsPage& page, const std::string& ending) {
  const TemporaryDirectory folder;
  page.write(folder.file("page" + ending), "warren compare", Execution{});
  return folder.read("page" + ending);
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

TEST(PlotsPage, TheEndingChoosesTheFormat) {
  const PlotsPage page{{some_plot(false), some_plot(true), some_plot(false)}, 2};
  EXPECT_TRUE(bytes_of(page, ".svg").starts_with("<svg "));
  const std::string png = bytes_of(page, ".PNG");
  EXPECT_TRUE(png.starts_with("\x89PNG"));
  EXPECT_EQ(big_endian(png, 16), 4 * 760U) << "two columns, two pixels for one";
  EXPECT_EQ(big_endian(png, 20), 4 * 420U) << "two rows";
  EXPECT_GT(png.size(), 5000U) << "there is something on it";
  if (!can_write_pdf()) return;
  const std::string pdf = bytes_of(page, ".pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF"));
  EXPECT_NE(pdf.find("/MediaBox [ 0 0 1140 630 ]"), std::string::npos);
  EXPECT_NE(pdf.find("warren compare"), std::string::npos);
}

TEST(PlotsPage, ManyPlotsTakeFewerPixelsEach) {
  const std::string png = bytes_of(PlotsPage{std::vector<PlotSheet>(12, some_plot(false)), 1}, ".png");
  EXPECT_EQ(big_endian(png, 20), 8192U);
}

TEST(PlotsPage, NoPlotIsAnEmptySheet) {
  EXPECT_NE(PlotsPage{}.svg().find("viewBox=\"0 0 760 420\""), std::string::npos);
  EXPECT_EQ(big_endian(bytes_of({}, ".png"), 16), 2 * 760U);
}

TEST(PlotsPage, AllThatTheSvgSaysIsDrawnElsewhereAtItsPlace) {
  const PlotSheet sheet = some_plot(false);
  const std::string svg = sheet.svg();
  SaidSurface surface;
  sheet.draw(surface, {760.0, 420.0}, Execution{});
  EXPECT_GT(surface.texts.size(), 8U) << "title, names, ticks, legend";
  for (const PlacedText& text : surface.texts) {
    EXPECT_NE(svg.find(">" + text.text + "<"), std::string::npos) << text.text;
    EXPECT_GT(text.at.x, 760.0) << text.text;
    EXPECT_GT(text.at.y, 420.0) << text.text;
  }
  for (const auto& chain : surface.chains) {
    for (const Vec2 p : chain) EXPECT_TRUE(p.x > 760.0 && p.x < 1520.0 && p.y > 420.0 && p.y < 840.0);
  }
}

TEST(PlotsPage, ADashedLineIsDrawnInDashesOfOneLength) {
  SaidSurface surface;
  PlotSheet sheet;
  sheet.line({{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}, {.stroke = colors::text}, {3.0, 4.0});
  sheet.draw(surface, {}, Execution{});
  ASSERT_EQ(surface.chains.size(), 3U);
  EXPECT_EQ(surface.chains[0], (std::vector<Vec2>{{0.0, 0.0}, {3.0, 0.0}}));
  EXPECT_EQ(surface.chains[1], (std::vector<Vec2>{{7.0, 0.0}, {10.0, 0.0}}));
  EXPECT_EQ(surface.chains[2], (std::vector<Vec2>{{10.0, 4.0}, {10.0, 7.0}}));
}

TEST(PlotsPage, LongNamesInTheLegendAreCutAtTheSheetsEnd) {
  const PlotSheet sheet = sheet_of(Plot{.title = "times",
                                        .x_label = "cells",
                                        .y_label = "s",
                                        .series = {{.name = std::string(200, 'w'), .points = {{1, 1}, {2, 4}}}}});
  EXPECT_NE(sheet.svg().find("...<"), std::string::npos);
}

TEST(PlotsPage, BoxesAreDrawnWithTheirMedianAndOutliers) {
  SaidSurface surface;
  sheet_of(BoxPlot{.title = "time", .boxes = {{"prm", "9 of 9", BoxFigures{1.0, 2.0, 3.0, 4.0, 6.0, {20.0}}}}})
      .draw(surface, {}, Execution{});
  const auto has = [&](std::size_t corners) {
    return std::any_of(surface.chains.begin(), surface.chains.end(),
                       [&](const auto& c) { return c.size() == corners; });
  };
  EXPECT_TRUE(has(4)) << "a box";
  EXPECT_TRUE(has(24)) << "an outlier's circle";
}

}  // namespace
}  // namespace warren
