// SPDX-License-Identifier: BSD-3-Clause
// --show, --size, --dpi and --title of the verbs that draw.
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

TEST(PictureWords, WhatMeansNothingIsRefused) {
  const Folder folder;
  const std::string file = folder.path("a.svg");
  check({{"solve", "maze:5x5", "--svg", file, "--show", "world,paths"}, 2, "--show"});
  check({{"solve", "maze:5x5", "--svg", file, "--size", "300"}, 2, "--size: expected WxH"});
  check({{"solve", "maze:5x5", "--svg", file, "--size", "3x300"}, 2, "a side is from 40 to 20000 px (found: 3)"});
  check({{"solve", "maze:5x5", "--svg", file, "--dpi", "5"}, 2, "--dpi"});
  check({{"solve", "maze:5x5", "--title", "x"}, 2, "--title: goes with --svg FILE"});
  check({{"convert", "maze:5x5", "-o", folder.path("a.npy"), "--dpi", "96"}, 2, "--dpi: goes with -o FILE.svg"});
  check({{"compare", "maze:5x5", "--planners", "prm", "--size", "300x300"}, 2, "--size: goes with --pictures FOLDER"});
}

}  // namespace
}  // namespace warren::test
