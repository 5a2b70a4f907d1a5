// SPDX-License-Identifier: BSD-3-Clause
// `warren render` and `warren export` of a roadmap as a picture.
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Words = std::vector<std::string>;

std::size_t count_of(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// The SVG group with this id; empty where there is none.
std::string group(const std::string& svg, const std::string& id) {
  const std::size_t first = svg.find("<g id=\"" + id + "\"");
  return first == std::string::npos ? "" : svg.substr(first, svg.find("</g>", first) - first);
}

class RoadmapPictures : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  void build(const std::string& world, const Words& more) const {
    Words words{"build", world, "-o", path("r.roadmap"), "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  std::string svg() const {
    const Outcome outcome = run({"render", path("r.roadmap"), "-o", path("r.svg")});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return folder_.read("r.svg");
  }

  Folder folder_;
};

TEST_F(RoadmapPictures, EachEdgeIsDrawnOnceInTheColourOfItsState) {
  build("maze:7x9", {"--planner", "prm", "--seed", "4"});  // 62 free edges, 48 blocked
  const std::string all = svg();
  EXPECT_EQ(count_of(group(all, "edges"), "M"), 62U);
  EXPECT_EQ(count_of(group(all, "blocked"), "M"), 48U);
  EXPECT_EQ(count_of(group(all, "milestones"), "M"), 63U);
  EXPECT_EQ(group(all, "unchecked"), "");
  EXPECT_NE(group(all, "blocked").substr(0, 80), group(all, "edges").substr(0, 80));
  build("maze:7x9", {"--planner", "lazy-prm", "--sampler", "lattice"});
  EXPECT_EQ(count_of(group(svg(), "unchecked"), "M"), 110U);
  EXPECT_EQ(count_of(group(svg(), "edges"), "M"), 0U);
}

TEST_F(RoadmapPictures, TurningBodiesHaveArrowsCarsCurvesAndArmsThreeViews) {
  build(world_file("poly-easy.scene"), {"--planner", "prm", "--samples", "40"});
  EXPECT_GT(count_of(group(svg(), "headings"), "M"), 10U);
  build(world_file("car-20.scene"), {"--planner", "prm", "--samples", "60"});
  EXPECT_GT(count_of(group(svg(), "free"), "A"), 10U);
  EXPECT_GT(count_of(group(svg(), "blocked"), "A"), 0U);
  build(world_file("puma.scene"), {"--planner", "prm", "--samples", "30"});
  const std::string arm = svg();
  EXPECT_EQ(count_of(group(arm, "milestones"), "M") % 3, 0U);
  EXPECT_GT(count_of(group(arm, "milestones"), "M"), 30U);
  EXPECT_GT(count_of(group(arm, "free"), "M"), 10U);
}

TEST_F(RoadmapPictures, ExportDrawsWhatRenderDraws) {
  build(world_file("walls.scene"), {"--planner", "prm", "--samples", "50"});
  const std::string drawn = svg();
  ASSERT_EQ(run({"export", path("r.roadmap"), "-o", path("x.svg")}).code, 0);
  const std::string exported = folder_.read("x.svg");
  EXPECT_EQ(exported.substr(exported.find("</desc>")), drawn.substr(drawn.find("</desc>")));
  for (const char* name : {"x.png", "x.html"}) ASSERT_EQ(run({"export", path("r.roadmap"), "-o", path(name)}).code, 0);
  EXPECT_EQ(folder_.read("x.png").substr(1, 3), "PNG");
  EXPECT_NE(folder_.read("x.html").find("</html>"), std::string::npos);
  const Outcome straight = run({"render", path("r.roadmap"), "-o", "-"});
  EXPECT_EQ(straight.out.substr(straight.out.find("</desc>")), drawn.substr(drawn.find("</desc>")));
}

TEST_F(RoadmapPictures, WhatNoPictureShowsIsRefused) {
  build("maze:700x700,loops=0.01", {"--index", "none", "--planner", "prm"});
  check({{"render", path("r.roadmap"), "-o", path("x.svg")}, 2, "and a picture of more than 900 000 shows nothing"});
  build("maze:9x9", {"--no-world"});
  check({{"render", path("r.roadmap"), "-o", path("x.svg")}, 65, "has no world inside"});
  EXPECT_EQ(run({"render", path("r.roadmap"), "--world", "maze:9x9", "-o", path("x.svg")}).code, 0);
  check({{"render", "maze:9x9", "--world", "maze:9x9", "-o", path("y.svg")}, 2, "--world: is for a roadmap"});
  check({{"export", path("r.roadmap"), "-o", path("y.svg"), "--unchecked"}, 2, "--unchecked: means nothing"});
  check({{"export", path("r.roadmap"), "-o", path("y.svg"), "--frame", "map"}, 2, "--frame: means nothing"});
  check({{"render", path("r.roadmap"), "--answer", path("x.svg"), "-o", path("y.svg")}, 2, "--answer: is drawn on"});
  check({{"render", path("r.roadmap"), "-o", path("r.roadmap")}, 2, "would overwrite"});
}

}  // namespace
}  // namespace warren::test
