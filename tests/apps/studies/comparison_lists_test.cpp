// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "apps/studies/comparison_report.hpp"
#include "pictures/plots/plot.hpp"

namespace warren::studies {
namespace {

using Words = std::vector<std::pair<std::string, std::string>>;

Contender contender(const std::string& planner, Words dealt, std::size_t solved, double length) {
  Contender c;
  c.planner = planner;
  c.dealt = std::move(dealt);
  for (std::size_t i = 0; i < 4; ++i) {
    ComparedRun run;
    run.outcome = i < solved ? Outcome::solved : Outcome::not_connected;
    run.time_s = 0.25;
    run.length = length;
    c.runs.push_back(run);
  }
  return c;
}

Comparison of(std::vector<Contender> contenders) {
  Comparison comparison;
  comparison.problems = {{"maze:4x4", "", 0, 0}};
  comparison.contenders = std::move(contenders);
  return comparison;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(ListPanels, TwoListsMakeHeatMapsOfSuccessLengthAndTime) {
  const auto panels = list_panels(of({contender("prm", {{"samples", "50"}, {"neighbours", "4"}}, 0, 0.0),
                                      contender("prm", {{"samples", "50"}, {"neighbours", "8"}}, 1, 17.5),
                                      contender("prm", {{"samples", "90"}, {"neighbours", "4"}}, 2, 16.5),
                                      contender("prm", {{"samples", "90"}, {"neighbours", "8"}}, 4, 15.5)}));
  ASSERT_EQ(panels.size(), 6U) << "the same as lines";
  for (const char* text : {">0 %<", ">25 %<", ">50 %<", ">100 %<", ">samples<", ">neighbours<"}) {
    EXPECT_EQ(count(panels[0].svg(), text), 1U) << text;
  }
  EXPECT_EQ(count(panels[1].svg(), ">none<"), 1U) << "no path, no length";
  EXPECT_EQ(count(panels[1].svg(), ">17.5<"), 1U);
  EXPECT_EQ(count(panels[2].svg(), ">250 ms<"), 4U);
}

TEST(ListPanels, TheListsWithMostValuesAreTheAxesAndOthersMakeMapsOfTheirOwn) {
  std::vector<Contender> all;
  for (const char* sampler : {"uniform", "halton"}) {
    for (const char* k : {"4", "8", "12"}) {
      for (const char* n : {"50", "90", "120"}) {
        all.push_back(contender("prm", {{"sampler", sampler}, {"samples", n}, {"neighbours", k}}, 4, 1.0));
      }
    }
  }
  const auto panels = list_panels(of(all));
  ASSERT_EQ(panels.size(), 12U);
  EXPECT_EQ(count(panels[0].svg(), "prm, sampler uniform: runs solved"), 2U) << "title and heading";
  EXPECT_EQ(count(panels[5].svg(), "prm, sampler halton: median time"), 2U);
}

TEST(ListPanels, TwoListsAreLinesWithIntervalsOverOneOfThemToo) {
  std::vector<Contender> all;
  for (const char* n : {"50", "90"}) {
    for (const char* k : {"4", "8", "12"}) all.push_back(contender("prm", {{"samples", n}, {"neighbours", k}}, 2, 1.0));
  }
  const auto panels = list_panels(of(all));
  ASSERT_EQ(panels.size(), 6U);
  const std::string svg = panels[3].svg();
  EXPECT_EQ(count(svg, "prm: runs solved against neighbours"), 2U) << "over the option with most values";
  EXPECT_EQ(count(svg, ">samples 50<") + count(svg, ">samples 90<"), 2U) << "a line a value of the other";
  EXPECT_EQ(count(svg, "<circle"), 6U + 2U) << "points and legend";
  all.clear();
  for (const char* sampler : {"uniform", "halton"}) {
    for (const char* k : {"4", "8"}) all.push_back(contender("prm", {{"sampler", sampler}, {"neighbours", k}}, 2, 1.0));
  }
  EXPECT_EQ(count(list_panels(of(all)).at(3).svg(), "runs solved against neighbours"), 2U) << "words are no axis";
}

TEST(ListPanels, OneListOfNumbersIsALineAPlannerWithBars) {
  const auto panels =
      list_panels(of({contender("prm", {{"samples", "100"}}, 4, 15.0), contender("prm", {{"samples", "50"}}, 1, 17.5),
                      contender("lazy-prm", {{"samples", "50"}}, 2, 17.0),
                      contender("lazy-prm", {{"samples", "100"}}, 4, 15.5), contender("voronoi", {}, 4, 20.0)}));
  ASSERT_EQ(panels.size(), 3U);
  EXPECT_EQ(count(panels[0].svg(), "<circle"), 4U + 2U) << "points and legend";
  EXPECT_EQ(count(panels[0].svg(), ">voronoi<"), 0U);
}

TEST(ListPanels, OptionsAreSpelledAsOnTheCommandLine) {
  const auto panels = list_panels(of({contender("rrt", {{"goal_bias", "0.1"}, {"step", "1"}}, 2, 1.0),
                                      contender("rrt", {{"goal_bias", "0.2"}, {"step", "2"}}, 2, 1.0)}));
  ASSERT_FALSE(panels.empty());
  for (const PlotSheet& panel : panels) EXPECT_EQ(count(panel.svg(), "goal_bias"), 0U) << panel.svg();
  EXPECT_GT(count(panels[0].svg(), ">goal-bias<"), 0U);
}

TEST(ListPanels, APlannerHasOneColourInAllPlots) {
  std::vector<Contender> all;
  for (const char* value : {"1", "2"}) {
    all.push_back(contender("rrt", {{"step", value}}, 2, 1.0));
    all.push_back(contender("rrt-connect", {{"step", value}}, value[0] == '1' ? 2 : 0, 1.0));
    all.push_back(contender("prm", {{"samples", value}}, 0, 1.0));
    all.push_back(contender("lazy-prm", {{"samples", value}}, 2, 1.0));
  }
  const auto panels = list_panels(of(all));
  const auto color_of = [](const std::string& svg, const std::string& name) {
    return svg.substr(svg.find("stroke=", svg.rfind("<path", svg.find(">" + name + "<"))), 16);
  };
  std::map<std::string, std::string> colors;
  for (const PlotSheet& panel : panels) {
    for (const char* name : {"rrt", "rrt-connect", "prm", "lazy-prm"}) {
      const std::string svg = panel.svg();
      if (count(svg, ">" + std::string(name) + "<") == 0) continue;
      const auto [seen, is_first] = colors.emplace(name, color_of(svg, name));
      EXPECT_EQ(seen->second, color_of(svg, name)) << name << " in " << panel.title();
    }
  }
  EXPECT_EQ(colors.size(), 4U);
  EXPECT_NE(colors["prm"], colors["rrt"]);
  EXPECT_NE(colors["lazy-prm"], colors["rrt-connect"]) << "beside each other on one page";
}

TEST(ListPanels, WordsAndOptionsThatNobodyListsHaveNone) {
  EXPECT_TRUE(list_panels(of({contender("prm", {}, 4, 15.0)})).empty());
  EXPECT_TRUE(list_panels(of({contender("prm", {{"sampler", "uniform"}}, 4, 15.0),
                              contender("prm", {{"sampler", "halton"}}, 4, 15.0)}))
                  .empty());
}

TEST(HeatMap, TheBrightColourIsTheGoodOne) {
  HeatMap map{.columns = {"1", "2"}, .rows = {"x"}, .cells = {{1.0, "least"}, {2.0, "most"}}};
  const auto fill_of = [&](const std::string& cell) {
    const std::string svg = sheet_of(map).svg();
    const std::size_t rect = svg.rfind("<rect", svg.find(": " + cell));
    return svg.substr(svg.find("fill=", rect), 14);
  };
  const std::string bright = fill_of("most");
  EXPECT_NE(fill_of("least"), bright);
  map.less_is_better = true;
  EXPECT_EQ(fill_of("least"), bright);
}

TEST(HeatMap, KeepsItsColoursOnDarkPages) {
  const std::string svg = sheet_of(HeatMap{.columns = {"1"}, .rows = {"x"}, .cells = {{2.0, "2"}}}).svg();
  EXPECT_EQ(count(svg, " class=\"kept\""), 1U);
  const std::size_t words = svg.rfind("<text", svg.find(">2<"));
  EXPECT_NE(svg.substr(words, svg.find('>', words) - words).find(" fill="), std::string::npos) << "not the page's ink";
}

TEST(HeatMap, EqualValuesAndNoneAreDrawnToo) {
  const std::string svg =
      sheet_of(HeatMap{.title = "a < b", .columns = {"1", "2"}, .rows = {"x"}, .cells = {{}, {2.0, "2"}}}).svg();
  EXPECT_EQ(count(svg, "<rect"), 3U);
  EXPECT_EQ(count(svg, "nan"), 0U);
  EXPECT_EQ(count(svg, "a &lt; b"), 2U);
}

}  // namespace
}  // namespace warren::studies
