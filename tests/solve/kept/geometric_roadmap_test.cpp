// SPDX-License-Identifier: BSD-3-Clause
// Roadmaps of planners that draw no samples are kept, too: they answer as solve() does, all their edges are free, and
// one whose graph is not that of its world is refused.
#include "solve/kinds/geometric_roadmaps.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/kept/same_answers.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

using test::expect_same;

std::string example_file(const std::string& name) { return test::source_dir() + "/examples/worlds/" + name; }

struct GeometricCase {
  std::string name;
  std::string world;
  Question question;  // its body, and where it stands free
  SolveOptions options;
};

std::vector<GeometricCase> geometric_cases() {
  const RobotSpec point{.kind = RobotKind::point};
  const RobotSpec disc{.kind = RobotKind::disc, .radius = 0.05};
  const RobotSpec bar{.kind = RobotKind::polygon, .outline = {{-0.1, -0.05}, {0.1, -0.05}, {0.1, 0.05}, {-0.1, 0.05}}};
  const SolveOptions visibility{.planner = PlannerKind::visibility};
  const SolveOptions full{.planner = PlannerKind::visibility, .visibility = {.full = true}};
  const SolveOptions cells{.planner = PlannerKind::cells};
  const SolveOptions funnel{.planner = PlannerKind::cells, .cells = {.doors = DoorKind::funnel}};
  const SolveOptions axis{.planner = PlannerKind::voronoi};
  const SolveOptions wide{.planner = PlannerKind::voronoi, .axis = {.objective = AxisObjective::clearance}};
  const std::string town = example_file("town.geojson");
  const std::string sparse = test::source_dir() + "/tests/data/sparse.scene";
  const std::string flat = example_file("flat.yaml");
  const Question in_town{.robot = point, .start = {1.5, 1.5}};
  const Question disc_in_town{.robot = disc, .start = {1.5, 1.5}};
  const Question bar_in_town{.robot = bar, .start = {1.5, 1.5, 0.0}};
  const Question in_the_sparse{.robot = point};
  return {{"visibility", town, in_town, visibility},
          {"full", sparse, in_the_sparse, full},
          {"cells", town, in_town, cells},
          {"funnel", sparse, in_the_sparse, funnel},
          {"axis", town, in_town, axis},
          {"disc", town, disc_in_town, wide},
          {"turning", town, bar_in_town, axis},
          {"map", flat, {.robot = disc, .start = {1.0, 1.0}}, axis},
          {"wide on a map", flat, {.robot = point, .start = {1.0, 1.0}}, wide},
          {"turning on a map", flat, {.robot = bar, .start = {1.0, 1.0, 0.0}}, axis}};
}

/// Somewhere in the world's box or next to it; `i` says where.
std::vector<double> somewhere(const Scene& scene, const RobotSpec& robot, std::uint64_t i) {
  Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  if (scene.map) {
    const Bitmap& cells = scene.map->blocked;
    box = {};
    box.include(cell_centre(*scene.map, {0, 0}));
    box.include(cell_centre(*scene.map, {cells.width() - 1, cells.height() - 1}));
  }
  const auto at = [&](double low, double size, std::uint32_t axis) {
    return low + (1.1 * uniform(7, i, axis) - 0.05) * size;
  };
  std::vector<double> numbers{at(box.min.x, box.width(), 0), at(box.min.y, box.height(), 1)};
  if (robot.kind == RobotKind::polygon) numbers.push_back(uniform(7, i, 2));
  return numbers;
}

TEST(GeometricRoadmap, AnswersAsSolveDoes) {
  const std::vector<GeometricCase> cases = geometric_cases();
  for (const std::uint64_t number : test::seeds(cases.size(), cases.size() / 2, 0)) {
    const GeometricCase& c = cases[number];
    SCOPED_TRACE(c.name);
    const Scene scene = read_world(c.world);
    const Roadmap roadmap = build(scene, c.question, c.options);
    const RoadmapQuery query(roadmap);
    std::size_t solved = 0;
    std::uint64_t asked = 0;
    for (const std::uint64_t i : test::seeds(24, 24, 0)) {
      if (asked++ >= test::share(24, 4) && solved >= test::share(3)) break;  // by day a share may have none
      SCOPED_TRACE(i);
      Question question = c.question;
      if (i % 3 == 0) question.start = somewhere(scene, *c.question.robot, 2 * i);
      question.goal = somewhere(scene, *c.question.robot, 2 * i + 1);
      SolveOptions options = c.options;
      constexpr SearchMethod methods[] = {SearchMethod::astar, SearchMethod::dijkstra, SearchMethod::bfs,
                                          SearchMethod::dfs};
      options.search = methods[i % 4];
      const Answer expected = solve(scene, question, options);
      const Answer answer = query.ask(question.start, question.goal, {.search = options.search});
      expect_same(answer, expected);
      EXPECT_EQ(answer.roadmap.edges, expected.roadmap.edges);
      solved += expected.outcome == Outcome::solved ? 1U : 0U;
    }
    EXPECT_GE(solved, test::share(3));
  }
}

/// Every edge of the graph may be driven, straight, as the judge sees it.
TEST(GeometricRoadmap, AllEdgesAreFree) {
  for (const GeometricCase& c : geometric_cases()) {
    SCOPED_TRACE(c.name);
    const Scene scene = read_world(c.world);
    const Roadmap roadmap = build(scene, c.question, c.options);
    const RoadmapParts parts = roadmap.arrays.parts();
    ASSERT_GT(parts.edge_count(), 10U);
    double radius = c.question.robot->radius;
    for (const Vec2 corner : c.question.robot->outline) radius = std::max(radius, norm(corner));
    const bool may_touch = c.options.planner != PlannerKind::voronoi;
    const VerifyOptions asked{.radius = radius, .contact = may_touch ? Contact::allowed : Contact::blocked};
    for (VertexId v = 0; v < parts.vertex_count(); ++v) {
      for (const VertexId w : parts.neighbours(v)) {
        const std::vector<Vec2> leg{{parts.state(v)[0], parts.state(v)[1]}, {parts.state(w)[0], parts.state(w)[1]}};
        const Verification found =
            scene.map ? verify_on_map(*scene.map, leg, {.radius = radius}, {}) : verify_path(scene, leg, asked, {});
        EXPECT_TRUE(found.verified) << v << " to " << w;
      }
    }
  }
}

/// Takes the edge at a vertex in the middle out of the roadmap, and leaves all else as it should be.
void take_out_an_edge(RoadmapArrays& arrays) {
  std::vector<Edge> edges;
  for (VertexId v = 0; v < arrays.candidates.vertex_count(); ++v) {
    for (const VertexId w : arrays.candidates.neighbours(v)) {
      if (v < w) edges.push_back({v, w});
    }
  }
  edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2));
  arrays.candidates = assemble_graph(arrays.candidates.vertex_count(), edges, {});
  arrays.edge_states.assign(edge_state_words(2 * edges.size()), 0);
  for (std::size_t end = 0; end < 2 * edges.size(); ++end) set_edge_state(arrays.edge_states, end, EdgeState::free);
  arrays.component = free_components(arrays.parts(), {});
}

TEST(GeometricRoadmap, AGraphThatIsNotItsWorldsIsRefused) {
  for (const GeometricCase& c : geometric_cases()) {
    SCOPED_TRACE(c.name);
    Roadmap roadmap = build(read_world(c.world), c.question, c.options);
    const auto expect_refusal = [&] {
      check_parts(roadmap.arrays.parts(), "it is sound by itself", {});
      EXPECT_THROW(RoadmapQuery{roadmap}, InputError);
    };
    const double x = roadmap.arrays.states[4];
    roadmap.arrays.states[4] += 1e-9;
    expect_refusal();
    roadmap.arrays.states[4] = x;
    EXPECT_NO_THROW(RoadmapQuery{roadmap});
    take_out_an_edge(roadmap.arrays);
    expect_refusal();
  }
}

/// Small triangles on a grid: more corners than are made anew when a roadmap is opened.
Scene many_triangles() {
  Scene scene;
  scene.source = "triangles";
  constexpr std::size_t side = 20;
  for (std::size_t i = 0; i < side * side; ++i) {
    const Vec2 at{static_cast<double>(i % side), static_cast<double>(i / side)};
    ScenePolygon triangle;
    triangle.corners = {at, at + Vec2{0.9, 0.1 * uniform(3, i, 0)}, at + Vec2{0.4 * uniform(3, i, 1), 0.9}};
    scene.polygons.push_back(std::move(triangle));
  }
  return scene;
}

TEST(GeometricRoadmap, ALargeVisibilityGraphIsTakenAsItIsAndItsPathsAreJudged) {
  const Scene scene = many_triangles();
  const Question point{.robot = RobotSpec{.kind = RobotKind::point}, .start = {0.95, 0.95}, .goal = {18.95, 18.95}};
  const SolveOptions visibility{.planner = PlannerKind::visibility};
  Roadmap roadmap = build(scene, point, visibility);
  ASSERT_GT(count_states(roadmap), 1000U);
  const Answer expected = solve(scene, point, visibility);
  ASSERT_EQ(expected.outcome, Outcome::solved);
  expect_same(RoadmapQuery(roadmap).ask(point.start, point.goal), expected);
  RoadmapArrays& arrays = roadmap.arrays;
  const auto n = static_cast<VertexId>(arrays.candidates.vertex_count());
  std::vector<RawVector<Edge>> edges(2);
  for (VertexId v = 0; v < arrays.candidates.vertex_count(); ++v) {
    for (const VertexId w : arrays.candidates.neighbours(v)) {
      if (v < w) edges[0].push_back({v, w});
    }
  }
  for (VertexId v = 0; v < 400; ++v) edges[1].push_back({v, n - 1 - v});  // bridges over everything
  arrays.candidates = assemble_graph(arrays.candidates.vertex_count(), edges, {});
  arrays.edge_states.assign(edge_state_words(arrays.candidates.targets().size()), 0);
  for (std::size_t end = 0; end < arrays.candidates.targets().size(); ++end) {
    set_edge_state(arrays.edge_states, end, EdgeState::free);
  }
  const RoadmapQuery query(roadmap);
  EXPECT_THROW(query.ask(point.start, point.goal), InputError);
  arrays.states[0] += 1e-9;
  EXPECT_THROW(RoadmapQuery{roadmap}, InputError);
}

}  // namespace
}  // namespace warren
