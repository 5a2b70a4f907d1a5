// SPDX-License-Identifier: BSD-3-Clause
// --show, --heading, --size, --dpi and --title of the verbs that draw.
#include "pictures/formats/write_picture.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

TEST(PictureWords, SayHowAPictureLooks) {
  const Folder folder;
  const std::string file = folder.path("a.svg");
  ASSERT_EQ(
      run({"solve", "maze:5x5", "--svg", file, "--show", "world,path", "--size", "300x200", "--title", "five"}).code,
      0);
  const std::string svg = folder.read("a.svg");
  EXPECT_NE(svg.find("width=\"300\" height=\"200\""), std::string::npos);
  EXPECT_NE(svg.find("<title>five</title>"), std::string::npos);
  EXPECT_NE(svg.find("<g id=\"walls\""), std::string::npos);
  for (const char* id : {"edges", "search_tree", "axes", "legend"}) {
    EXPECT_EQ(svg.find(std::string("<g id=\"") + id), std::string::npos) << id;
  }
  ASSERT_EQ(run({"render", "maze:5x5", "-o", folder.path("b.svg"), "--size", "90x60mm"}).code, 0);
  EXPECT_NE(folder.read("b.svg").find("width=\"90mm\" height=\"60mm\""), std::string::npos);
  ASSERT_EQ(run({"generate", "maze", "5x5", "-o", folder.path("c.png"), "--size", "200x150", "--dpi", "192"}).code, 0);
  EXPECT_EQ(folder.read("c.png").substr(16, 8), std::string("\0\0\0\xc8\0\0\0\x96", 8));
}

TEST(PictureWords, APageHasNoPixels) {
  const Folder folder;
  const std::string file = folder.path("a.html");
  check({{"solve", "maze:5x5", "--svg", file, "--dpi", "96"}, 2, "--dpi: a page fills its window"});
  check({{"render", "maze:5x5", "-o", file, "--size", "300x300"}, 2, "--size: a page fills its window"});
}

TEST(PictureWords, APdfIsAPdf) {
  const Folder folder;
  const Outcome outcome = run({"solve", "maze:5x5", "--svg", folder.path("a.pdf")});
  if (!can_write_pdf()) {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("libharu"), std::string::npos);
    return;
  }
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(folder.read("a.pdf").substr(0, 5), "%PDF-");
}

constexpr const char* bar_scene =
    "bounds 0 0 8 8\nrobot polygon -1 -0.2 1 -0.2 1 0.2 -1 0.2\nstart 1.5 1.5 0\ngoal 6 6 0\nwall 3 4 5 4\n";

TEST(PictureWords, AHeadingShowsItsLayerAndStatesAsArrows) {
  const Folder folder;
  const std::string scene = folder.write("bar.scene", bar_scene);
  ASSERT_EQ(
      run({"solve", scene, "--planner", "prm", "--samples", "200", "--heading", "45deg", "--svg", folder.path("a.svg")})
          .code,
      0);
  const std::string svg = folder.read("a.svg");
  for (const char* part :
       {"<g id=\"layer_45\"", "no room at 45 degrees", "<g id=\"near_headings\"", "<g id=\"other_headings\""}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
  ASSERT_EQ(run({"render", scene, "--heading", "0", "-o", folder.path("b.svg")}).code, 0);
  EXPECT_NE(folder.read("b.svg").find("<g id=\"layer_0\""), std::string::npos);
  ASSERT_EQ(run({"convert", scene, "--heading=-90deg", "-o", folder.path("c.svg")}).code, 0);
  EXPECT_NE(folder.read("c.svg").find("<g id=\"layer_-90\""), std::string::npos);
  const std::string kept = folder.path("k.roadmap");
  ASSERT_EQ(run({"build", scene, "--samples", "100", "-o", kept}).code, 0);
  ASSERT_EQ(run({"render", kept, "--heading", "1", "-o", folder.path("d.svg")}).code, 0);
  EXPECT_NE(folder.read("d.svg").find("no room at 57.3 degrees"), std::string::npos);
}

TEST(PictureWords, AHeadingOfABodyWithoutOneIsRefusedBeforeAnythingIsSolved) {
  const Folder folder;
  const std::string file = folder.path("a.svg");
  check({{"solve", "maze:50x50", "--svg", file, "--heading", "0"}, 2, "--heading: a point and a disc"});
  check({{"render", "maze:5x5", "-o", file, "--heading", "0"}, 2, "--heading: a point and a disc"});
  check({{"convert", "maze:5x5", "-o", file, "--heading", "0"}, 2, "--heading: a point and a disc"});
  check({{"solve", "maze:5x5", "--svg", file, "--heading", "north"},
         2,
         "--heading: expected an angle in radians, or as 90deg"});
  EXPECT_TRUE(folder.is_empty());
  check(
      {{"compare", "maze:5x5", "--pictures", folder.path("p"), "--heading", "0"}, 2, "--heading: a point and a disc"});
}

TEST(PictureWords, WhatIsThinnedOrDrawnAsPixelsIsSaid) {
  const Folder folder;
  const std::vector<std::string> crowded{"solve",   "maze:12x12", "--planner", "prm",   "--sampler",
                                         "uniform", "--samples",  "3000",      "--svg", folder.path("a.svg")};
  const Outcome outcome = run(crowded);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("warren: note: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("drawn thinner and paler, being so many: roadmap edges"), std::string::npos)
      << outcome.err;
  EXPECT_NE(folder.read("a.svg").find("thinner and paler, being so many: roadmap edges"), std::string::npos);
  EXPECT_EQ(run({"render", "maze:12x12", "-o", folder.path("b.svg")}).err, "");
}

TEST(PictureWords, AllSearchesOfARoadmapAreInOneFigure) {
  const Folder folder;
  ASSERT_EQ(run({"compare", "maze:9x9,loops=0.3", "--graph", "prm", "--trials", "1", "--queues", "heap,sorted-array",
                 "--pictures", folder.path("p")})
                .code,
            0);
  const std::string svg = folder.read("p/searches.svg");
  for (const char* label : {">bfs: length ", ">dfs: length ", ">dijkstra: length ", ">astar: length ", " settled<"}) {
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  }
  check({{"compare", "--sizes", "50", "--pictures", folder.path("p")}, 2, "--pictures: is about a world"});
}

TEST(PictureWords, WhatMeansNothingIsRefused) {
  const Folder folder;
  const std::string file = folder.path("a.svg");
  check({{"solve", "maze:5x5", "--svg", file, "--show", "world,paths"}, 2, "--show"});
  check({{"solve", "maze:5x5", "--svg", file, "--size", "300"}, 2, "--size: expected WxH"});
  check({{"solve", "maze:5x5", "--svg", file, "--size", "3x300"}, 2, "a side is from 40 to 20000 px (found: 3)"});
  check({{"solve", "maze:5x5", "--svg", file, "--dpi", "5"}, 2, "--dpi"});
  check({{"solve", "maze:5x5", "--title", "x"}, 2, "--title: goes with --picture FILE"});
  check({{"convert", "maze:5x5", "-o", folder.path("a.npy"), "--dpi", "96"}, 2, "--dpi: goes with -o FILE.svg"});
  check({{"compare", "maze:5x5", "--planners", "prm", "--size", "300x300"}, 2, "--size: goes with --pictures FOLDER"});
}

}  // namespace
}  // namespace warren::test
