// SPDX-License-Identifier: BSD-3-Clause
// Edges near a box: all that meet it, each once, and not many more, however long the longest are.
#include "apps/serve/tiles/roadmap_layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "tests/apps/serve/tiles/network.hpp"

namespace warren::serve {
namespace {

constexpr VertexId side = 60;
constexpr std::uint64_t steps = 2 * side * (side - 1);

/// Milestones at whole numbers with an edge to the next in each row and column, and some long edges.
test::Network lattice_with(const std::vector<test::Link>& long_edges) {
  std::vector<Vec2> places;
  std::vector<test::Link> links = long_edges;
  for (VertexId v = 0; v < side * side; ++v) {
    places.push_back({static_cast<double>(v % side), static_cast<double>(v / side)});
    if (v % side + 1 < side) links.push_back({v, v + 1});
    if (v + side < side * side) links.push_back({v, v + side});
  }
  return test::network_of(places, links);
}

std::vector<test::Link> any_edges(std::size_t count) {
  std::vector<test::Link> edges;
  for (std::uint64_t i = 0; edges.size() < count; ++i) {
    const auto from = static_cast<VertexId>(uniform(3, i, 0) * side * side);
    const auto to = static_cast<VertexId>(uniform(3, i, 1) * side * side);
    if (from != to) edges.push_back({from, to, i % 5 == 0 ? EdgeState::blocked : EdgeState::free});
  }
  return edges;
}

using Ends = std::pair<VertexId, VertexId>;

std::multiset<Ends> edges_near(const PlacedRoadmap& placed, const Box& box) {
  std::multiset<Ends> edges;
  placed.for_each_edge_near(box, {}, [&](PlacedRoadmap::Edge edge) {
    edges.emplace(edge.from, edge.to);
    return true;
  });
  return edges;
}

TEST(PlacedRoadmap, FewLongEdgesDontLetEachBoxLookAtAll) {
  const Box box{{20.2, 20.2}, {22.8, 22.8}};
  for (const std::size_t count : {0U, 1U, 25U}) {
    const test::Network net = lattice_with(any_edges(count));
    const PlacedRoadmap placed(net.parts(), {});
    EXPECT_EQ(placed.free_edges(), steps + count - (count + 4) / 5) << count;
    // The lattice's edges up to a step away, and the long ones.
    EXPECT_LE(edges_near(placed, box).size(), 2U * 5U * 5U + count) << count;
  }
}

TEST(PlacedRoadmap, EachEdgeThatMeetsTheBoxIsVisitedOnce) {
  for (const std::size_t count : {0U, 1U, 25U, 300U}) {
    const test::Network net = lattice_with(any_edges(count));
    const PlacedRoadmap placed(net.parts(), {});
    const RoadmapParts parts = net.parts();
    for (const Box& box : {Box{{20.2, 20.2}, {22.8, 22.8}}, Box{{-5, 30}, {70, 30}}, Box{{0, 0}, {0, 0}},
                           Box{{-9, -9}, {-1, 99}}, Box{{59, 10}, {80, 11}}}) {
      const std::multiset<Ends> near = edges_near(placed, box);
      for (VertexId v = 0; v < parts.vertex_count(); ++v) {
        for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
          const VertexId to = parts.to[end];
          const bool is_free = v < to && parts.state_of_end(end) == EdgeState::free;
          const bool meets = box.meets(box_of({net.at(v), net.at(to)}));
          EXPECT_GE(near.count({v, to}), is_free && meets ? 1U : 0U) << v << "-" << to;
          EXPECT_LE(near.count({v, to}), is_free ? 1U : 0U) << v << "-" << to;
        }
      }
      EXPECT_EQ(std::set(near.begin(), near.end()).size(), near.size());
    }
  }
}

TEST(PlacedRoadmap, AnEdgeOfNoLengthIsVisitedOnce) {
  std::vector<Vec2> places;
  std::vector<test::Link> links;
  for (VertexId v = 0; v < 600; ++v) {
    places.push_back({0.1 * std::min(v, 598U), 0.0});  // the last two at one place
    if (v > 0) links.push_back({v - 1, v});
  }
  const test::Network net = test::network_of(places, links);
  EXPECT_EQ(edges_near(PlacedRoadmap(net.parts(), {}), {{59.7, -1}, {60, 1}}).count({598, 599}), 1U);
}

TEST(PlacedRoadmap, VisitsEndWhenTheyAreToldTo) {
  const test::Network net = lattice_with(any_edges(25));
  std::size_t visits = 0;
  PlacedRoadmap(net.parts(), {}).for_each_edge_near({{0, 0}, {60, 60}}, {}, [&](PlacedRoadmap::Edge) {
    return ++visits < 100;
  });
  EXPECT_EQ(visits, 100U);
}

}  // namespace
}  // namespace warren::serve
