// SPDX-License-Identifier: BSD-3-Clause
// Two small worlds of polygons and their figures, which a script without any of this code computed: by definition, in
// fractions. Two corners see each other if no side crosses the way between them and its middle lies in no polygon;
// an edge is reduced if at both ends the neighbouring corners lie on one side of its line and the corner is convex;
// then plain Dijkstra. Settled are the vertices not farther than the goal; by A* those whose distance and straight rest
// are not longer than the shortest path. (The same script gives the known figures of two published worlds.)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "planners/visibility/visibility_graph.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "tests/paths.hpp"

namespace warren {
namespace {

/// What is known about one of the worlds.
struct Figures {
  const char* file;
  std::size_t vertices, full_edges, reduced_edges;
  double shortest, by_bfs;  ///< only one path has so few edges as the latter
  std::uint64_t bfs_hops, settled_by_dijkstra, settled_by_astar;
};
constexpr Figures sparse{"sparse.scene", 15, 44, 30, 0.984660989043, 1.614079501570, 3, 15, 7};
constexpr Figures dense{"dense.scene", 45, 223, 128, 0.826491095336, 1.281945865151, 3, 38, 7};

class KnownWorld : public testing::Test {
 protected:
  void read(const char* file) {
    const std::string path = test::source_dir() + "/tests/data/" + file;
    const Scene scene = read_scene_text(InputFile(path, {}), {});
    obstacles_ = plane_obstacles(scene, {});
    start_ = {scene.start[0], scene.start[1]};
    goal_ = {scene.goal[0], scene.goal[1]};
  }
  Solution<Vec2> plan(VisibilityEdges edges, SearchKind search) {
    VisibilityOptions options;
    options.edges = edges;
    options.search = search;
    return visibility_path(obstacles_, start_, goal_, options, {});
  }
  static double length_of(const Solution<Vec2>& s) {
    return path_length(s.path, [](Vec2 a, Vec2 b) { return distance(a, b); });
  }

  PlaneObstacles obstacles_;
  Vec2 start_, goal_;
};

class DenseWorld : public KnownWorld {
 protected:
  void SetUp() override { read(dense.file); }
};

class VisibilityFigures : public KnownWorld, public testing::WithParamInterface<Figures> {
 protected:
  void SetUp() override { read(GetParam().file); }
};

TEST_P(VisibilityFigures, EdgesAreThoseThatWereCounted) {
  const Solution<Vec2> full = plan(VisibilityEdges::full, SearchKind::astar);
  const Solution<Vec2> reduced = plan(VisibilityEdges::reduced, SearchKind::astar);
  EXPECT_EQ(full.roadmap.milestones, GetParam().vertices);
  EXPECT_EQ(full.roadmap.edges, GetParam().full_edges);
  EXPECT_EQ(reduced.roadmap.edges, GetParam().reduced_edges);
}

TEST_P(VisibilityFigures, PathsAreAsLongAsComputedIndependently) {
  for (const VisibilityEdges edges : {VisibilityEdges::full, VisibilityEdges::reduced}) {
    for (const SearchKind search : {SearchKind::astar, SearchKind::dijkstra}) {
      EXPECT_NEAR(length_of(plan(edges, search)), GetParam().shortest, 1e-9);
    }
  }
  const Solution<Vec2> bfs = plan(VisibilityEdges::full, SearchKind::bfs);
  EXPECT_NEAR(length_of(bfs), GetParam().by_bfs, 1e-9);
  EXPECT_EQ(bfs.path.size(), GetParam().bfs_hops + 1);
  VisibilityOptions lazy;
  lazy.lazy = true;
  EXPECT_NEAR(length_of(visibility_path(obstacles_, start_, goal_, lazy, {})), GetParam().shortest, 1e-9);
}

TEST_P(VisibilityFigures, SearchesSettleAsManyVerticesAsCounted) {
  EXPECT_EQ(plan(VisibilityEdges::full, SearchKind::dijkstra).counters.expanded, GetParam().settled_by_dijkstra);
  EXPECT_EQ(plan(VisibilityEdges::full, SearchKind::astar).counters.expanded, GetParam().settled_by_astar);
}

// Three corners lie on one line in the file's decimals; as doubles the middle one reaches over it by 3.4e-17.
TEST_F(DenseWorld, GrazedCornerIsTurnedInstead) {
  const VisibleCorners corners(obstacles_, {});
  const VisibilityGraph visibility(corners, VisibilityEdges::full, {});
  const auto vertex_at = [&](double x, double y) {
    VertexId v = 0;
    while (distance(corners.position(v), Vec2{x, y}) > 1e-6) ++v;
    return v;
  };
  const VertexId from = vertex_at(0.708752, 0.742622);
  const VertexId grazed = vertex_at(0.743552, 0.690122);
  const VertexId to = vertex_at(0.896324, 0.459647);
  const auto joined = [&](VertexId v, VertexId w) {
    const auto row = visibility.graph().neighbours(v);
    return std::find(row.begin(), row.end(), w) != row.end();
  };
  EXPECT_FALSE(joined(from, to));
  EXPECT_TRUE(joined(from, grazed));
  EXPECT_TRUE(joined(grazed, to));
  EXPECT_LT(
      std::abs(cross(corners.position(to) - corners.position(from), corners.position(grazed) - corners.position(from))),
      1e-16);
}

INSTANTIATE_TEST_SUITE_P(Worlds, VisibilityFigures, testing::Values(sparse, dense),
                         [](const auto& world) { return std::string(world.index == 0 ? "sparse" : "dense"); });

}  // namespace
}  // namespace warren
