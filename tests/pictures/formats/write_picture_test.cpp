// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/write_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

using Writer = std::vector<std::string> (*)(const Picture&, const PictureOptions&, const Execution&, const Write&);

std::string written(Writer writer, const Picture& picture, const PictureOptions& options = {}) {
  std::string all;
  writer(picture, options, {}, [&](std::string_view bytes) { all += bytes; });
  return all;
}

Scene bare_room() {
  Scene scene;
  scene.bounds = {{{0, 0}, {30, 20}}};
  scene.polygons = {{{{3, 3}, {5, 3}, {5, 6}}}};
  return scene;
}

Picture titled_picture(const Scene& scene) {
  Picture picture{.scene = scene};
  picture.start = {2, 2};
  picture.goal = {28, 18};
  picture.title = "a < b";
  return picture;
}

bool holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// The longest attribute, and the whole.
std::pair<std::size_t, std::size_t> sizes_of(const std::string& svg) {
  std::size_t longest = 0;
  std::size_t last = 0;
  for (std::size_t at = 0; (at = svg.find('"', at)) != std::string::npos; last = at++)
    longest = std::max(longest, at - last);
  return {longest, svg.size()};
}

TEST(WritePicture, AllFormatsAreTheSameBytesEachTime) {
  const Scene scene = bare_room();
  for (const Writer writer : {write_svg, write_png, write_html}) {
    EXPECT_EQ(written(writer, titled_picture(scene)), written(writer, titled_picture(scene)));
  }
  if (!can_write_pdf()) {
    EXPECT_THROW(written(write_pdf, titled_picture(scene)), UsageError);
    return;
  }
  const std::string pdf = written(write_pdf, titled_picture(scene));
  EXPECT_EQ(pdf, written(write_pdf, titled_picture(scene)));
  EXPECT_TRUE(pdf.starts_with("%PDF-1."));
  EXPECT_TRUE(holds(pdf, "/Helvetica"));
  EXPECT_TRUE(holds(pdf, "/Title "));
  EXPECT_FALSE(holds(pdf, "Date")) << "nothing of the hour";
}

TEST(WritePicture, PartsThatAreNotShownAreNotThere) {
  const Scene scene = bare_room();
  const std::string all = written(write_svg, titled_picture(scene));
  for (const char* id : {"polygons", "walls", "start", "goal", "axes", "scale", "legend"}) {
    EXPECT_TRUE(holds(all, std::string("<g id=\"") + id + "\"")) << id;
  }
  PictureOptions path;
  path.parts = {Part::path};
  const std::string some = written(write_svg, titled_picture(scene), path);
  EXPECT_TRUE(holds(some, "<g id=\"goal\""));
  for (const char* id : {"polygons", "walls", "axes", "scale", "legend"}) {
    EXPECT_FALSE(holds(some, std::string("<g id=\"") + id + "\"")) << id;
  }
  EXPECT_TRUE(holds(all, "<title>a &lt; b</title>"));
  EXPECT_TRUE(holds(written(write_svg, titled_picture(scene), {.title = "mine"}), "<title>mine</title>"));
}

TEST(WritePicture, APngHasAPaletteAndTellsItsResolution) {
  const Scene scene = bare_room();
  const std::string png = written(write_png, titled_picture(scene), {.size = PageSize{320, 200}, .dpi = 254.0});
  const auto number = [&](std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(png[at + i]);
    return value;
  };
  EXPECT_EQ(number(16), 320U);
  EXPECT_EQ(number(20), 200U);
  EXPECT_EQ(png[24], 8) << "bits";
  EXPECT_EQ(png[25], 3) << "by palette";
  const std::size_t physical = png.find("pHYs");
  ASSERT_NE(physical, std::string::npos);
  EXPECT_EQ(number(physical + 4), 10'000U) << "a metre";
}

/// librsvg reads attributes and files of at most ten megabytes.
TEST(WritePicture, ReadersOfSvgAreNotAskedTooMuch) {
  const Scene few = maze_scene({.rows = 300, .cols = 300}, false, {});
  const std::string lines = written(write_svg, titled_picture(few));
  EXPECT_LT(sizes_of(lines).first, 1'000'000U);
  EXPECT_GT(sizes_of(lines).second, 900'000U);
  EXPECT_FALSE(holds(lines, "<image"));
  const Scene many = maze_scene({.rows = 800, .cols = 800}, false, {});
  const std::string image = written(write_svg, titled_picture(many));
  EXPECT_TRUE(holds(image, "<image"));
  EXPECT_LT(sizes_of(image).second, 10'000'000U);
}

TEST(WritePicture, ALongPathGoesOnInTheNextAttribute) {
  const Scene scene = bare_room();
  Picture picture = titled_picture(scene);
  std::vector<Vec2> path;
  for (int i = 0; i <= 90'000; ++i) path.push_back({1e-3 * (i % 17) + 3e-4 * i, 10.0 + (i % 2)});
  picture.path.assign(path.begin(), path.end());
  const std::string svg = written(write_svg, picture);
  EXPECT_LT(sizes_of(svg).first, 1'000'000U);
  EXPECT_TRUE(holds(svg, "27.004 10L"));  // somewhere on its way
}

TEST(WritePicture, EndingsNameFormats) {
  EXPECT_TRUE(is_picture(".pdf"));
  EXPECT_FALSE(is_picture(".pd"));
  EXPECT_FALSE(is_picture(""));
  EXPECT_EQ(ending_of("a.b/c"), "");
  EXPECT_EQ(ending_of("a.PnG"), ".png");
}

}  // namespace
}  // namespace warren
