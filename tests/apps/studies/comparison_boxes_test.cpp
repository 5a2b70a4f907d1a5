// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "apps/studies/comparison_report.hpp"

namespace warren::studies {
namespace {

Comparison of_planners(std::size_t planners, const std::vector<double>& lengths, double slowest = 0.5) {
  Comparison comparison;
  comparison.problems = {{"maze:4x4", "", 0, 0}};
  for (std::size_t p = 0; p < planners; ++p) {
    Contender& c = comparison.contenders.emplace_back();
    c.planner = "planner" + std::to_string(p);
    c.library = "warren";
    for (const double length : lengths) {
      ComparedRun run;
      run.outcome = length > 0.0 ? Outcome::solved : Outcome::not_connected;
      run.length = length;
      run.time_s = length > 0.0 ? 0.25 : slowest;
      c.runs.push_back(run);
    }
  }
  return comparison;
}

TEST(BoxFigures, AreTukeys) {
  // numpy.percentile([1, 2, 3, 4, 5, 6, 7, 30], [25, 50, 75]) = 2.75, 4.5, 6.25; 1.5 * 3.5 beyond: -2.5, 11.5
  const auto box = box_figures_of({30, 7, 1, 6, 2, 5, 3, 4});
  ASSERT_TRUE(box);
  EXPECT_DOUBLE_EQ(box->q1, 2.75);
  EXPECT_DOUBLE_EQ(box->median, 4.5);
  EXPECT_DOUBLE_EQ(box->q3, 6.25);
  EXPECT_EQ(box->low, 1.0);
  EXPECT_EQ(box->high, 7.0);
  EXPECT_EQ(box->outliers, std::vector<double>{30.0});
  EXPECT_FALSE(box_figures_of({}));
}

TEST(BoxFigures, WhiskersNeverEndInsideTheBox) {
  const auto box = box_figures_of({0, 10, 10, 10});  // q1 7.5, the least value that is no outlier 10
  ASSERT_TRUE(box);
  EXPECT_EQ(box->low, 7.5);
  EXPECT_EQ(box->outliers, std::vector<double>{0.0});
}

TEST(BoxPanels, ShowWhatDiffersFromRunToRunAndSayFailures) {
  const auto panels = box_panels(of_planners(2, {10.0, 12.0, 0.0, 11.0}));
  ASSERT_EQ(panels.size(), 2U) << "length and time; no run has a clearance";
  EXPECT_NE(panels[0].svg().find("maze:4x4: length"), std::string::npos);
  EXPECT_NE(panels[0].svg().find(">3 of 4<"), std::string::npos);
  EXPECT_NE(panels[1].svg().find("seconds, of all runs"), std::string::npos);
  EXPECT_TRUE(box_panels(of_planners(2, {10.0})).empty()) << "one run is no spread";
}

TEST(BoxPanels, RowsAreNamedByWhatDiffersAlone) {
  Comparison comparison = of_planners(3, {10.0, 12.0});
  for (std::size_t i = 0; i < 3; ++i) {
    Contender& c = comparison.contenders[i];
    c.planner = "prm";
    c.dealt = {
        {"sampler", "uniform"}, {"samples", i == 0 ? "357" : "500"}, {"neighbours", std::to_string(4 * (i + 1))}};
  }
  const std::string svg = box_panels(comparison).at(0).svg();
  for (const char* name :
       {">samples 357, neighbours 4<", ">samples 500, neighbours 8<", ">samples 500, neighbours 12<"}) {
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  }
  comparison.contenders.resize(1);
  EXPECT_NE(box_panels(comparison).at(0).svg().find(">prm, sampler uniform"), std::string::npos)
      << "one is named whole";
  Comparison plain = of_planners(2, {10.0, 12.0});
  plain.contenders[1].planner = plain.contenders[0].planner;
  plain.contenders[1].options = {{"samples", "5"}};
  EXPECT_NE(box_panels(plain).at(0).svg().find(">planner0<"), std::string::npos) << "no row is without a name";
}

TEST(BoxPanels, TimesOverMoreThanADecadeAreLogarithmic) {
  const auto decades = [](double slowest) { return box_panels(of_planners(1, {1.0, 1.0, 0.0}, slowest)).at(0).svg(); };
  EXPECT_NE(decades(200.0).find(">100 s<"), std::string::npos);
  EXPECT_NE(decades(200.0).find(">1 s<"), std::string::npos) << "powers of ten";
  EXPECT_EQ(decades(1.0).find(">5 s<"), std::string::npos);
}

TEST(BoxPanels, MoreContendersThanRowsAreANote) {
  const Comparison many = of_planners(most_boxes + 1, {1.0, 2.0});
  EXPECT_TRUE(box_panels(many).empty());
  EXPECT_NE(note_on_box_plots(many).find("and here are 19"), std::string::npos);
  EXPECT_TRUE(note_on_box_plots(of_planners(most_boxes, {1.0, 2.0})).empty());
}

}  // namespace
}  // namespace warren::studies
