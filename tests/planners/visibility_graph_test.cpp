// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility_graph.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "planners/lazy_visibility.hpp"
#include "planners/visibility_path.hpp"
#include "tests/planners/degenerate_worlds.hpp"
#include "tests/planners/visibility_oracle.hpp"

namespace warren {
namespace {

oracle::Point grid_point(Vec2 p) { return {static_cast<std::int64_t>(p.x), static_cast<std::int64_t>(p.y)}; }

oracle::Vertex oracle_vertex(const VisibleCorners& corners, VertexId v) {
  return {grid_point(corners.position(v)), static_cast<int>(v - corners.vertices_first(corners.point(v)))};
}

using VertexPairs = std::set<std::pair<oracle::Vertex, oracle::Vertex>>;

VertexPairs edges_of(const VisibleCorners& corners, const Graph& graph) {
  VertexPairs pairs;
  for (VertexId v = 0; v < graph.vertex_count(); ++v) {
    for (const VertexId w : graph.neighbours(v)) pairs.insert({oracle_vertex(corners, v), oracle_vertex(corners, w)});
  }
  return pairs;
}

VertexPairs edges_by_definition(const oracle::Plane& plane) {
  VertexPairs pairs;
  for (const oracle::Point p : plane.corners()) {
    for (const oracle::Point q : plane.corners()) {
      for (const auto& [i, j] : plane.ways(p, q)) pairs.insert({{p, i}, {q, j}});
    }
  }
  return pairs;
}

std::string text(const VertexPairs& pairs) {
  std::string line;
  const auto add = [&](const oracle::Vertex& v) {
    line += "(" + std::to_string(v.at.x) + "," + std::to_string(v.at.y) + ")#" + std::to_string(v.sector) + " ";
  };
  for (const auto& [v, w] : pairs) {
    add(v);
    add(w);
    line += "\n";
  }
  return line;
}

VertexPairs minus(const VertexPairs& a, const VertexPairs& b) {
  VertexPairs result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(result, result.end()));
  return result;
}

TEST(VisibilityGraph, FullEdgesAreThoseByDefinitionInDegenerateWorlds) {
  std::size_t crossing_worlds = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles world = DegenerateWorlds(seed).make(seed % 3 == 0);
    const VisibleCorners corners(world, {});
    const VisibilityGraph visibility(corners, VisibilityEdges::full, {});
    const oracle::Plane plane(world);
    std::set<oracle::Vertex> vertices;
    for (VertexId v = 0; v < corners.size(); ++v) vertices.insert(oracle_vertex(corners, v));
    ASSERT_EQ(vertices.size(), plane.vertices().size());
    EXPECT_TRUE(vertices == plane.vertices());
    const VertexPairs mine = edges_of(corners, visibility.graph());
    const VertexPairs theirs = edges_by_definition(plane);
    ASSERT_TRUE(mine == theirs) << "missing:\n"
                                << text(minus(theirs, mine)) << "too many:\n"
                                << text(minus(mine, theirs));
    crossing_worlds += corners.pieces().crosses() ? 1 : 0;
  }
  EXPECT_GT(crossing_worlds, 40);
  EXPECT_LT(crossing_worlds, 160);
}

/// A side so short, straight to the right, that it hides no whole direction.
TEST(VisibilityPath, TakesSidesThatAreHardlyWiderThanAPoint) {
  PlaneObstacles plane;
  plane.polygons.add(std::vector<Vec2>{{1, -0.5}, {2, 0}, {1, 0.5}, {1, 1e-10}, {1, 0}});
  plane.bounds = Box{{-1, -2}, {4, 2}};
  const auto solution = visibility_path(plane, {0, 0}, {3, 0}, {}, {});
  ASSERT_EQ(solution.outcome, Outcome::solved);
  EXPECT_EQ(solution.path.size(), 3U);
}

}  // namespace
}  // namespace warren
