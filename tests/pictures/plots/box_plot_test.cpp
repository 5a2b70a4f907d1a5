// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot.hpp"

#include <gtest/gtest.h>

#include "pictures/model/letters.hpp"

namespace warren {
namespace {

std::string box_plot_svg(const BoxPlot& plot) { return sheet_of(plot).svg(); }

std::size_t times_in(const std::string& text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

BoxPlot boxes_with(std::vector<double> outliers, bool logarithmic) {
  BoxPlot plot{.title = "maze & more: time", .label = "seconds", .remarks = "solved", .logarithmic = logarithmic};
  plot.boxes.push_back({"prm", "9 of 9", BoxFigures{1.0, 2.0, 3.0, 4.0, 6.0, std::move(outliers)}});
  plot.boxes.push_back({"rrt", "none of 9", {}});
  return plot;
}

TEST(BoxPlot, EveryRowHasItsNameAndRemarkAndOnlyFiguresABox) {
  const std::string text = box_plot_svg(boxes_with({20.0}, false));
  for (const char* word : {">prm<", ">rrt<", ">9 of 9<", ">none of 9<", ">solved<", ">seconds<"}) {
    EXPECT_EQ(times_in(text, word), 1U) << word;
  }
  EXPECT_EQ(times_in(text, "data-tip"), 1U);
  EXPECT_EQ(times_in(text, "<circle"), 1U);
  EXPECT_NE(text.find("maze &amp; more"), std::string::npos);
}

TEST(BoxPlot, OutliersOnOnePixelAreDrawnOnce) {
  EXPECT_EQ(times_in(box_plot_svg(boxes_with(std::vector<double>(100'000, 20.0), false)), "<circle"), 1U);
  EXPECT_EQ(times_in(box_plot_svg(boxes_with({10.0, 15.0, 20.0}, false)), "<circle"), 3U);
}

TEST(BoxPlot, ALogarithmicAxisShowsDecadesAndZeroKeepsItLinear) {
  EXPECT_NE(box_plot_svg(boxes_with({5000.0}, true)).find(">1k s<"), std::string::npos);
  const std::string linear = box_plot_svg(boxes_with({0.0, 5000.0}, true));
  EXPECT_EQ(linear.find("nan"), std::string::npos);
  EXPECT_EQ(linear.find("inf"), std::string::npos);
}

TEST(BoxPlot, PlacesAreInsideTheElementWithAnyNamesAndFigures) {
  for (const double value : {0.0, 1e-9, 7.0, 1e12}) {
    BoxPlot plot{.title = "one",
                 .boxes = {{std::string(400, 'w'), "1 of 1", BoxFigures{value, value, value, value, value}}}};
    const std::string text = box_plot_svg(plot);
    EXPECT_EQ(text.find("nan"), std::string::npos) << value;
    EXPECT_EQ(text.find("=\"-"), std::string::npos) << value;
    EXPECT_NE(text.find("w...w"), std::string::npos) << "a name that is cut says so";
  }
}

TEST(BoxPlot, LongNamesThatDifferAtTheirEndsAreToldApart) {
  BoxPlot plot{.title = "one"};
  const std::string name = "prm, sampler uniform, samples 357, shortened by a long procedure, neighbours ";
  for (std::size_t k = 1; k <= most_boxes; ++k) plot.boxes.push_back({name + std::to_string(k), "1 of 1", {}});
  const std::string many = box_plot_svg(plot);
  EXPECT_EQ(times_in(many, "..."), most_boxes);
  for (std::size_t k = 1; k <= most_boxes; ++k)
    EXPECT_EQ(times_in(many, "neighbours " + std::to_string(k) + "<"), 1U) << k;
  plot.boxes.resize(2);  // with room for two lines each
  const std::string few = box_plot_svg(plot);
  EXPECT_EQ(times_in(few, "..."), 0U);
  EXPECT_EQ(times_in(few, "neighbours 1<") + times_in(few, "neighbours 2<"), 2U);
}

TEST(BoxPlot, LongRemarksEndOnTheSheet) {
  BoxPlot plot = boxes_with({}, false);
  plot.boxes[1].remark = "none of 1000000";
  const std::string text = box_plot_svg(plot);
  const std::size_t word = text.find(">none of 1000000<");
  ASSERT_NE(word, std::string::npos);
  const std::size_t at = text.rfind("<text x=\"", word) + std::string_view("<text x=\"").size();
  EXPECT_LE(std::stod(text.substr(at)) + text_width("none of 1000000", plot_text_size), plot_size.x);
}

}  // namespace
}  // namespace warren
