// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/page.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "pictures/model/letters.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {
namespace {

Scene room(double width, double height) {
  Scene scene;
  scene.bounds = {{{0, 0}, {width, height}}};
  scene.polygons = {{{{0.2 * width, 0.2 * height}, {0.4 * width, 0.2 * height}, {0.3 * width, 0.5 * height}}}};
  return scene;
}

Picture picture_in(const Scene& scene) {
  Picture picture{.scene = scene};
  picture.start = scene.bounds->min;
  picture.goal = scene.bounds->max;
  picture.title = "a room";
  picture.subtitle = "1 polygon; a point\nprm, 100 samples, length 12.25, clearance 0.1, seed 1";
  return picture;
}

Page laid_out(const Picture& picture, const PictureOptions& options = {}, bool in_pixels = false) {
  return page_of(picture, options, in_pixels, {});
}

Box place_of(const PlacedText& text) {
  const double width = text_width(text.text, text.size);
  const double back = text.anchor == Anchor::start ? 0.0 : text.anchor == Anchor::middle ? 0.5 * width : width;
  Box box{{-back, -0.72 * text.size}, {width - back, 0.0}};
  if (text.upright) box = Box{{box.min.y, -box.max.x}, {box.max.y, -box.min.x}};
  return {box.min + text.at, box.max + text.at};
}

std::vector<std::string> labels_of(const Page& page) {
  std::vector<std::string> labels;
  for (const LegendEntry& entry : page.legend) labels.push_back(entry.label);
  return labels;
}

const std::vector<PictureOptions> sizes{
    {}, {.size = PageSize{400, 300}}, {.size = PageSize{300, 500}}, {.size = PageSize{180, 120, LengthUnit::mm}}};

TEST(Page, NoWordStandsOnAnotherOrOffThePage) {
  for (const Vec2 extent : {Vec2{10, 10}, Vec2{1000, 20}, Vec2{3, 400}, Vec2{1e-3, 2e-3}, Vec2{7e6, 3e6}}) {
    const Scene scene = room(extent.x, extent.y);
    const Picture picture = picture_in(scene);
    for (const PictureOptions& options : sizes) {
      const Page page = laid_out(picture, options);
      SCOPED_TRACE(testing::Message() << extent.x << " x " << extent.y << " on " << page.width << " x " << page.height);
      for (std::size_t i = 0; i < page.texts.size(); ++i) {
        const Box one = place_of(page.texts[i]);
        EXPECT_TRUE(Box({{0, 0}, {page.width, page.height}}).contains(one.min)) << page.texts[i].text;
        EXPECT_TRUE(Box({{0, 0}, {page.width, page.height}}).contains(one.max)) << page.texts[i].text;
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_FALSE(one.meets(place_of(page.texts[j]))) << page.texts[i].text << " on " << page.texts[j].text;
        }
      }
    }
  }
}

TEST(Page, MarksAtTheRimAreWhole) {
  const Scene scene = room(30, 20);
  const Picture picture = picture_in(scene);
  for (const PictureOptions& options : sizes) {
    const Page page = laid_out(picture, options);
    for (const Vec2 end : {*picture.start, *picture.goal}) {
      const Vec2 at = page.view.at(end);
      EXPECT_GT(at.x - widths::mark, page.data.min.x);
      EXPECT_LT(at.x + widths::mark, page.data.max.x);
      EXPECT_GT(at.y - widths::mark, page.data.min.y);
      EXPECT_LT(at.y + widths::mark, page.data.max.y);
    }
  }
}

TEST(Page, TheLegendTellsWhatIsDrawnAndNothingElse) {
  const Scene scene = room(10, 10);
  Picture picture = picture_in(scene);
  EXPECT_EQ(labels_of(laid_out(picture)), (std::vector<std::string>{"obstacle", "bounds", "start", "goal"}));
  const std::vector<Vec2> path{{0, 0}, {10, 10}};
  PictureLayer empty{.id = "nothing", .label = "nothing"};
  PictureLayer axis{.id = "medial_axis", .label = "medial axis"};
  axis.lines.add(path);
  const std::vector<PictureLayer> layers{empty, axis};
  picture.layers = layers;
  picture.path.assign(path.begin(), path.end());
  picture.goal.reset();
  EXPECT_EQ(labels_of(laid_out(picture)),
            (std::vector<std::string>{"obstacle", "bounds", "medial axis", "path", "start"}));
  PictureOptions some;
  some.parts = {Part::path, Part::legend};
  const Page page = laid_out(picture, some);
  EXPECT_EQ(labels_of(page), (std::vector<std::string>{"path", "start"}));
  EXPECT_TRUE(page.frame.empty());
  some.parts = {Part::path};
  EXPECT_TRUE(laid_out(picture, some).legend.empty());
}

TEST(Page, SizeAndResolutionAreThoseAskedFor) {
  const Scene scene = room(10, 10);
  const Picture picture = picture_in(scene);
  const Page pixels = laid_out(picture, {.size = PageSize{640, 480}}, true);
  EXPECT_EQ(std::lround(pixels.width * pixels.density()), 640);
  EXPECT_EQ(std::lround(pixels.height * pixels.density()), 480);
  const Page dense = laid_out(picture, {.size = PageSize{640, 480}, .dpi = 192.0}, true);
  EXPECT_EQ(std::lround(dense.width * dense.density()), 640);
  EXPECT_NEAR(dense.width, 320, 1e-9);
  const Page print = laid_out(picture, {.size = PageSize{254, 127, LengthUnit::mm}, .dpi = 300.0}, true);
  EXPECT_EQ(std::lround(print.width * print.density()), 3000);
  EXPECT_THROW((PictureOptions{.size = PageSize{5, 100}}).validate(), UsageError);
  EXPECT_THROW((PictureOptions{.size = PageSize{100, 1e9}}).validate(), UsageError);
  EXPECT_THROW((PictureOptions{.dpi = 3.0}).validate(), UsageError);
}

TEST(Page, AnEmptyTitleLeavesItOutAndALongOneIsCut) {
  const Scene scene = room(10, 10);
  const Picture picture = picture_in(scene);
  const auto texts = [&](const std::optional<std::string>& title) {
    std::string all;
    for (const PlacedText& text : laid_out(picture, {.title = title}).texts) all += text.text + "|";
    return all;
  };
  EXPECT_EQ(texts(std::nullopt).find("a room|1 polygon; a point|prm, 100 samples"), 0U) << texts(std::nullopt);
  EXPECT_EQ(texts("").find("prm"), std::string::npos);
  EXPECT_EQ(texts("other").find("other|1 polygon"), 0U);
  EXPECT_NE(texts(std::string(400, 'x')).find("x...|"), std::string::npos);
}

TEST(Page, AMazeHasCellsOnItsAxesAndAMapMetres) {
  const Scene maze = maze_scene({.rows = 5, .cols = 7}, true, {});
  EXPECT_EQ(unit_of(maze), "cells");
  Scene map;
  map.map.emplace();
  EXPECT_EQ(unit_of(map), "cells");
  map.map->format = MapFormat::ros;
  EXPECT_EQ(unit_of(map), "m");
  EXPECT_EQ(unit_of(room(1, 1)), "");
}

}  // namespace
}  // namespace warren
