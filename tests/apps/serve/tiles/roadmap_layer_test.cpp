// SPDX-License-Identifier: BSD-3-Clause
// Layers of roadmaps against each edge in turn: what lies on a tile is drawn, and nothing else is.
#include "apps/serve/tiles/roadmap_layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "tests/apps/serve/tiles/network.hpp"
#include "tests/apps/serve/tiles/read_inks.hpp"
#include "tests/seeds.hpp"

namespace warren::serve {
namespace {

using test::Link;
using test::Network;
using test::network_of;

unsigned covered(const std::string& png) {
  const auto pixels = test::read_inks(png);
  return static_cast<unsigned>(std::ranges::count_if(pixels, [](const test::InkPixel& p) { return p[3] > 0; }));
}

TEST(RoadmapLayer, DrawsWhatLiesOnTheTileAndNothingElse) {
  std::uint64_t drawn = 0;
  const auto any = [&] { return 100.0 * uniform(7, drawn++, 0); };
  std::vector<Vec2> places;
  for (int i = 0; i < 300; ++i) {
    const double x = any();
    places.push_back({x, any()});
  };
  std::vector<Link> links;
  for (VertexId v = 1; v < 300; v += 3) {
    const auto other = static_cast<VertexId>(any());
    if (other != v) links.push_back({v, other, static_cast<EdgeState>(v % 9 / 3)});
  }
  const Network net = network_of(places, links);
  const RoadmapLayer layer(net.parts(), {});
  for (const double side : {100.0, 9.0, 1.0}) {
    const double pixel = side / TileGrid::pixels;
    for ([[maybe_unused]] const std::uint64_t trial : test::seeds(12)) {
      const double left = any() - side / 2;
      const Vec2 low{left, any() - side / 2};
      const Box box{low, low + Vec2{side, side}};
      const auto pixels = test::read_inks(layer.draw(box, pixel, RoadmapInk::one, {}));
      for (std::size_t y = 3; y < TileGrid::pixels; y += 11) {
        for (std::size_t x = 3; x < TileGrid::pixels; x += 11) {
          const Vec2 p{low.x + (static_cast<double>(x) + 0.5) * pixel,
                       box.max.y - (static_cast<double>(y) + 0.5) * pixel};
          double near = 1e9;
          for (const Vec2 place : places) near = std::min(near, distance(p, place) - 1.5 * pixel);
          for (const Link& link : links) {
            if (link.state != EdgeState::free) continue;
            near = std::min(near, distance(p, Segment{net.at(link.a), net.at(link.b)}));
          }
          const unsigned opacity = pixels[y * TileGrid::pixels + x][3];
          if (near < 0.4 * pixel) {
            EXPECT_GT(opacity, 60U) << p.x << "," << p.y << " of " << side;
          } else if (near > 1.3 * pixel) {
            EXPECT_EQ(opacity, 0U) << p.x << "," << p.y << " of " << side;
          }
        }
      }
    }
  }
}

TEST(RoadmapLayer, WhereThereAreTooManyEdgesShowsMilestonesAlone) {
  std::vector<Vec2> places;
  std::vector<Link> links;
  for (VertexId v = 0; v < 210; ++v) places.push_back({v % 15 * 3.0, v / 15 * 3.0});
  for (VertexId a = 0; a < 210; ++a) {
    for (VertexId b = a + 1; b < 210; ++b) links.push_back({a, b});
  }
  ASSERT_GT(links.size(), most_drawn_edges);
  const Network net = network_of(places, links);
  const RoadmapLayer layer(net.parts(), {});
  const Box whole{{-1, -1}, {99, 99}};
  EXPECT_LE(covered(layer.draw(whole, 100.0 / TileGrid::pixels, RoadmapInk::one, {})), 210U * 9U);
  links.resize(most_drawn_edges - 100);
  const Network fewer = network_of(places, links);
  EXPECT_GT(covered(RoadmapLayer(fewer.parts(), {}).draw(whole, 100.0 / TileGrid::pixels, RoadmapInk::one, {})),
            30'000U);  // of the places' 215 x 200 pixels
}

TEST(RoadmapLayer, TheLargestComponentsHaveColoursAndSmallOnesAreGrey) {
  std::vector<Vec2> places;
  std::vector<Link> links;
  std::vector<VertexId> component;
  for (VertexId number = 0; number < 10; ++number) {  // the last one has most milestones
    const auto root = static_cast<VertexId>(places.size());
    for (VertexId i = 0; i <= number; ++i) {
      places.push_back({10.0 * i + 5, 10.0 * number + 5});
      component.push_back(root);
      if (i > 0) links.push_back({root + i - 1, root + i});
    }
  }
  const Network net = network_of(places, links, component);
  const RoadmapLayer layer(net.parts(), {});
  const auto pixels =
      test::read_inks(layer.draw({{0, 0}, {100, 100}}, 100.0 / TileGrid::pixels, RoadmapInk::by_component, {}));
  EXPECT_EQ(layer.milestones(), 55U);
  EXPECT_EQ(layer.free_edges(), 45U);
  EXPECT_EQ(layer.milestones_of_ink(), (std::array<std::uint64_t, 8>{10, 9, 8, 7, 6, 5, 4, 6}));
  EXPECT_EQ(layer.small_components(), 3U);
  for (VertexId number = 0; number < 10; ++number) {
    const std::size_t rank = std::min<std::size_t>(9 - number, component_inks.size() - 1);
    const Rgb ink = component_inks[rank];
    const auto x = static_cast<std::size_t>(5.0 / 100.0 * TileGrid::pixels);
    const auto y = static_cast<std::size_t>((95.0 - 10.0 * number) / 100.0 * TileGrid::pixels);
    EXPECT_EQ(pixels[y * TileGrid::pixels + x], (test::InkPixel{ink.red, ink.green, ink.blue, 255})) << number;
  }
}

TEST(RoadmapLayer, ARoadmapWithoutMilestonesIsEmpty) {
  const Network net = network_of({}, {});
  EXPECT_EQ(covered(RoadmapLayer(net.parts(), {}).draw({{0, 0}, {1, 1}}, 1.0 / TileGrid::pixels, RoadmapInk::one, {})),
            0U);
}

TEST(RoadmapLayer, PassagesOfALatticeAreLines) {
  PassageWords words = LatticePassages::closed({2, 3}, {});
  words.right[0] = 1;  // (1, 1) to (2, 1)
  words.up[0] = 2;     // (2, 1) to (2, 2)
  const LatticePassages passages({2, 3}, std::move(words));
  const double pixel = 4.0 / TileGrid::pixels;
  const Box box{{0, 0}, {4, 4}};
  const auto pixels = test::read_inks(draw_passages(passages, box, pixel, {}));
  const auto opacity = [&](double x, double y) {
    return pixels[static_cast<std::size_t>((4 - y) / pixel) * TileGrid::pixels + static_cast<std::size_t>(x / pixel)]
                 [3];
  };
  EXPECT_GT(opacity(1.5, 1.0), 60U);
  EXPECT_GT(opacity(2.0, 1.5), 60U);
  for (const Vec2 closed : {Vec2{2.5, 1.0}, {1.0, 1.5}, {3.0, 1.5}, {1.5, 2.0}, {3.0, 1.0}}) {
    EXPECT_EQ(opacity(closed.x, closed.y), 0U) << closed.x << "," << closed.y;
  }
  EXPECT_EQ(covered(draw_passages(passages, {{0, 0}, {512, 512}}, 1.0, {})), 0U) << "too far away";
}

}  // namespace
}  // namespace warren::serve
