// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/draw_answer.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pictures/formats/write_picture.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/solve.hpp"

namespace warren {
namespace {

std::vector<std::string> ids_of(const std::vector<PictureLayer>& layers) {
  std::vector<std::string> ids;
  for (const PictureLayer& layer : layers) ids.push_back(layer.id);
  return ids;
}

Scene room_with_a_block() {
  Scene scene;
  scene.polygons = {{{{3, 3}, {5, 3}, {5, 6}, {3, 6}}}};
  scene.bounds = {{{0, 0}, {10, 10}}};
  scene.start = {1, 5};
  scene.goal = {9, 5};
  return scene;
}

Picture drawn(const Scene& scene, const SolveOptions& options) {
  ByProducts made;
  const Answer answer = solve(scene, {}, options, {}, &made);
  EXPECT_TRUE(answer.verified);
  return drawing_of(scene, answer, std::move(made), {});
}

TEST(DrawAnswer, ShowsWhatEachPlannerOfThePlaneMade) {
  const Scene scene = room_with_a_block();
  EXPECT_EQ(ids_of(drawn(scene, {.planner = PlannerKind::cells}).layers), std::vector<std::string>{"cells"});
  EXPECT_EQ(ids_of(drawn(scene, {.planner = PlannerKind::voronoi}).layers), std::vector<std::string>{"medial_axis"});
  const Picture sampled = drawn(scene, {.planner = PlannerKind::visibility, .visibility = {.sampled_edges = 0.01}});
  EXPECT_EQ(ids_of(sampled.layers), (std::vector<std::string>{"visibility", "wrong_edges"}));
  const Picture roadmap = drawn(scene, {.planner = PlannerKind::prm});
  ASSERT_TRUE(roadmap.roadmap);
  EXPECT_GT(roadmap.roadmap->states.size(), 2U);
  EXPECT_TRUE(roadmap.layers.empty());
  EXPECT_EQ(roadmap.start, (Vec2{1, 5}));
  EXPECT_EQ(roadmap.goal, (Vec2{9, 5}));
  EXPECT_GE(roadmap.path.size(), 2U);
}

TEST(DrawAnswer, ShowsTheBodyAlongThePath) {
  Scene scene = room_with_a_block();
  scene.robot = RobotSpec{.kind = RobotKind::polygon, .outline = {{-0.5, -0.1}, {0.5, -0.1}, {0.5, 0.1}, {-0.5, 0.1}}};
  scene.start.push_back(0.0);
  scene.goal.push_back(1.0);
  const std::vector<std::string> along_the_path{"sweep", "bodies", "body_start", "body_goal", "fronts"};
  const Picture trees = drawn(scene, {.planner = PlannerKind::rrt_connect});
  EXPECT_EQ(ids_of(trees.layers), along_the_path);
  EXPECT_TRUE(trees.roadmap);
  EXPECT_TRUE(trees.path_turns.empty());
  const Picture grid = drawn(scene, {.planner = PlannerKind::grid, .grid = {.cell = 0.5, .angles = 8}});
  EXPECT_EQ(ids_of(grid.layers), along_the_path);
  ASSERT_EQ(grid.pages.size(), 3U) << "0, 45 and 90 degrees";
  EXPECT_EQ(grid.pages[1].id, "layer_45");
  EXPECT_EQ(ids_of(grid.pages[1].layers), (std::vector<std::string>{"layer_45", "headings"}));
  scene.goal.back() = 0.0;
  const Picture fixed = drawn(scene, {.planner = PlannerKind::cells});
  EXPECT_EQ(ids_of(fixed.layers),
            (std::vector<std::string>{"cells", "blocked", "sweep", "bodies", "body_start", "body_goal", "fronts"}));
}

/// 40 x 20 cells of 0.5 m, known in a room of 10 x 8 whose lower left corner is cell (20, 6).
Scene room_in_the_unknown(std::uint64_t between) {
  Scene scene;
  OccupancyMap& map = scene.map.emplace();
  map.format = MapFormat::ros;
  map.blocked = map.unknown = Bitmap(40, 20, true);
  map.cell = 0.5;
  map.origin = {-1.0, 0.0};
  map.between = between;
  for (std::uint32_t y = 6; y < 14; ++y) {
    for (std::uint32_t x = 20; x < 30; ++x) {
      map.unknown.clear(x, y);
      if (x > 20 && x < 29 && y > 6 && y < 13) map.blocked.clear(x, y);
    }
  }
  return scene;
}

double area_of(const PictureLayer& layer) {
  double area = 0.0;
  for (std::size_t i = 0; i < layer.lines.size(); ++i) {
    area += distance(layer.lines[i][0], layer.lines[i][1]) * distance(layer.lines[i][1], layer.lines[i][2]);
  }
  return area;
}

TEST(DrawAnswer, TellsUnknownCellsOfAMapFromOccupiedOnes) {
  Scene scene = room_in_the_unknown(0);
  scene.start = {10.0, 4.0};
  scene.goal = {12.0, 6.0};
  const Picture drawing = drawn(scene, {});
  ASSERT_EQ(ids_of(drawing.layers), (std::vector<std::string>{"occupied", "unknown"}));
  EXPECT_EQ(drawing.layers[0].label, "occupied cells");
  EXPECT_EQ(drawing.layers[1].label, "unknown cells");
  EXPECT_DOUBLE_EQ(area_of(drawing.layers[0]), 32 * 0.25);
  EXPECT_DOUBLE_EQ(area_of(drawing.layers[1]), (800 - 80) * 0.25);
  EXPECT_FALSE(drawing.layers[0].fill == drawing.layers[1].fill);
  EXPECT_EQ(cells_of_map(*room_in_the_unknown(3).map, {})[0].label, "occupied cells, and those between");
  scene.map->format = MapFormat::moving_ai;
  EXPECT_EQ(ids_of(drawn(scene, {}).layers), std::vector<std::string>{"blocked"});
}

TEST(DrawAnswer, CutsAMapToWhatIsKnownAndSaysSoAtTheAxes) {
  Scene scene = room_in_the_unknown(0);
  scene.start = {10.0, 4.0};
  scene.goal = {12.0, 6.0};
  const Picture drawing = drawn(scene, {});
  std::string svg;
  write_svg(drawing, {}, {}, [&](std::string_view bytes) { svg += bytes; });
  EXPECT_NE(svg.find(">x (m), part of -1 to 19: the rest is unknown<"), std::string::npos);
  EXPECT_NE(svg.find(">y (m), part of 0 to 10: the rest is unknown<"), std::string::npos);
  // Two cells around columns 20 to 30 and rows 6 to 14; what is drawn of the unknown ends there.
  const Canvas canvas = canvas_of(drawing, {});
  EXPECT_EQ(canvas.box.min, (Vec2{8.0, 2.0}));
  EXPECT_EQ(canvas.box.max, (Vec2{15.0, 8.0}));
  const std::size_t at = svg.find("id=\"unknown\"");
  const std::string unknown = svg.substr(at, svg.find("</g>", at) - at);
  EXPECT_EQ(unknown.find("19"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("15"), std::string::npos) << unknown;
  scene.start = {-0.75, 0.25};  // in the unknown: shown, all the same
  EXPECT_EQ(canvas_of({.scene = scene, .start = plane_point(scene.start)}, {}).box.min, (Vec2{-0.75, 0.25}));
}

TEST(DrawAnswer, DrawsCarsInCurves) {
  Scene scene = room_with_a_block();
  scene.robot = RobotSpec{.kind = RobotKind::car, .radius = 0.2};
  scene.robot->turning_radius = 0.7;
  scene.start.push_back(0.0);
  scene.goal.push_back(1.0);
  const Picture drawing = drawn(scene, {});
  EXPECT_EQ(ids_of(drawing.layers),
            (std::vector<std::string>{"edges", "search_tree", "sweep", "body_start", "body_goal", "fronts"}));
  EXPECT_EQ(drawing.path_turns.size(), drawing.path.size());
  ASSERT_TRUE(drawing.roadmap);
  EXPECT_EQ(drawing.roadmap->graph.vertex_count(), drawing.roadmap->states.size());
}

TEST(DrawAnswer, ShowsAnArmFromThreeSidesAndInPerspective) {
  Scene scene;
  scene.spheres = {{0.8, 0.2, -0.75, 0.1}};
  scene.robot = RobotSpec{.kind = RobotKind::puma560, .radius = 0.05};
  scene.start = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  scene.goal = {0.3, -0.2, -0.3, 0.0, 0.2, 0.0};
  const Picture drawing = drawn(scene, {});
  ASSERT_TRUE(drawing.stage);
  EXPECT_EQ(drawing.stage->polygons.size(), 3U);
  EXPECT_EQ(drawing.panels.size(), 4U);
  ASSERT_TRUE(drawing.solids);
  EXPECT_EQ(drawing.solids->solids.front().radius, 0.1);
  const double reach = drawing.solids->reach;
  for (const SeenSolid& solid : drawing.solids->solids) {
    EXPECT_LE((solid.b - drawing.solids->target).norm(), 1.5 * reach) << "all of it is seen";
  }
  ASSERT_TRUE(drawing.arm);
  EXPECT_EQ(drawing.arm->moments.front(), 0.0);
  EXPECT_DOUBLE_EQ(drawing.arm->moments.back(), 1.0);
  EXPECT_GE(drawing.arm->spines.size(), 120U);
  EXPECT_TRUE(drawing.path.empty());
  EXPECT_FALSE(drawing.start);
  EXPECT_EQ(ids_of(drawing.layers), (std::vector<std::string>{"sweep", "arm_at_start", "arm_at_goal", "trace"}));
  RecordedAnswer none;
  EXPECT_EQ(drawing_of(scene, none, {}).layers.size(), 1U) << "one posture: no goal, no way";
  Picture still = drawing_of(scene, none, {});
  animate(still);
  EXPECT_EQ(still.arm->moments.size(), 1U) << "nothing to move along";
}

TEST(DrawAnswer, ARefutedPathIsDrawnAsAnyOther) {
  const Scene scene = room_with_a_block();
  Answer answer;
  answer.planner = "visibility";
  answer.refuted.emplace();
  answer.refuted->path = {{1, 5}, {9, 5}};
  const Picture drawing = drawing_of(scene, answer, {}, {});
  EXPECT_EQ(drawing.path.size(), 2U);
  EXPECT_FALSE(drawing.roadmap);
}

TEST(DrawAnswer, APictureIsTheWorldsOrTheStages) {
  const Scene scene = room_with_a_block();
  const Picture drawing = drawing_of(scene, RecordedAnswer{}, {});
  EXPECT_EQ(&drawing.scene, &scene);
  EXPECT_EQ(drawing.start, (Vec2{1, 5})) << "the file's, where the answer says nothing";
  Scene arm;
  arm.robot = RobotSpec{.kind = RobotKind::puma560, .radius = 0.05};
  arm.start = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const Picture views = drawing_of(arm, RecordedAnswer{}, {});
  EXPECT_EQ(&views.scene, views.stage.get());
}

/// An answer with two paths before it, and what a planner that gets better would have kept.
Picture drawn_with_improvements(const Scene& scene, Answer answer) {
  answer.planner = name_of(PlannerKind::anytime);
  answer.iterations = 7;
  answer.improvements = {{.iterations = 1, .cost = 14.5, .length = 14.5, .by = "tree"},
                         {.iterations = 2, .cost = answer.length, .length = answer.length, .by = "shorten"}};
  ByProducts made;
  made.improved.add(std::vector<Vec2>{{1, 5}, {3, 8}, {9, 5}});
  made.improved.add(std::vector<Vec2>{{1, 5}, {4, 7}, {9, 5}});
  made.improved.add(answer.path);  // the last of them
  return drawing_of(scene, answer, std::move(made), {});
}

TEST(DrawAnswer, PathsBeforeFadeAndTheEllipseHoldsWhatIsShorter) {
  const Scene scene = room_with_a_block();
  const Answer answer = solve(scene, {}, {.planner = PlannerKind::visibility});
  const Picture drawing = drawn_with_improvements(scene, answer);
  ASSERT_EQ(ids_of(drawing.layers), (std::vector<std::string>{"informed_set", "improvements"}));
  const PictureLayer& ellipse = drawing.layers[0];
  ASSERT_FALSE(ellipse.lines.empty());
  for (const Vec2 p : ellipse.lines.corners) {
    EXPECT_NEAR(distance({1, 5}, p) + distance(p, {9, 5}), answer.length, 1e-9);
    EXPECT_TRUE(p.x >= 0 && p.x <= 10 && p.y >= 0 && p.y <= 10) << "the picture grows by no ellipse";
  }
  const PictureLayer& before = drawing.layers[1];
  EXPECT_EQ(before.label, "2 paths before it, the first 14.5 long");
  ASSERT_EQ(before.opacities.size(), 2U);
  EXPECT_LT(before.opacities[0], before.opacities[1]);
  EXPECT_TRUE(drawing.path_label.starts_with("path, ")) << drawing.path_label;
}

TEST(DrawAnswer, TheEllipseIsOfPointsAndDiscsThatBend) {
  Scene scene = room_with_a_block();
  scene.robot = RobotSpec{.kind = RobotKind::polygon, .outline = {{-0.5, -0.1}, {0.5, -0.1}, {0.5, 0.1}, {-0.5, 0.1}}};
  scene.start.push_back(0.0);
  scene.goal.push_back(0.0);
  const Answer turning = solve(scene, {}, {.planner = PlannerKind::rrt_connect});
  for (const std::string& id : ids_of(drawn_with_improvements(scene, turning).layers)) EXPECT_NE(id, "informed_set");
  scene = room_with_a_block();
  scene.polygons.clear();
  const Answer straight = solve(scene, {}, {.planner = PlannerKind::lazy_prm, .optimise = true});
  EXPECT_EQ(ids_of(drawn_with_improvements(scene, straight).layers), std::vector<std::string>{"improvements"});
}

}  // namespace
}  // namespace warren
