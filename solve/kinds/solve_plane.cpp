// SPDX-License-Identifier: BSD-3-Clause
// A point or disc among polygons and walls: joins worlds/plane/polygon_world with the planners that sample it, the
// planner cells (a route through vertical cells, and a path through its doors; that there is no route proves that there
// is no path) and the planner voronoi (along the medial axis, as far from all obstacles as a path can be; min_clearance
// of the answer is measured on the path by the verification). The planner visibility is solve_visibility.cpp's.

#include <fmt/format.h>

#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "planners/axis/medial_axis_planner.hpp"
#include "planners/shorten/taut_path.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/plane/polygon_world.hpp"
#include "worlds/prices/side_prices.hpp"

namespace warren {
namespace {

Answer solve_by_cells(const SolveRequest& request) {
  const WallProblem problem = touching_problem(request);
  const SearchChoice search = search_choice(request.options);
  const CellOptions options = cell_options(request.options, search);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.push_back(doors_option(options));
  answer_within_limits(answer, [&] {
    const CellRoadmap* known = asked_roadmap<CellRoadmap>(request);
    PlaneObstacles obstacles;
    if (known == nullptr) obstacles = indexed_obstacles(request, answer);
    if (stand_on_seams(request, problem, answer)) return;
    CellPlan plan;
    Solution<Vec2> solution;
    without_clashes(request, [&] {
      const auto& [start, goal] = std::tie(problem.start, problem.goal);
      solution = known != nullptr ? plan_through_cells(*known, start, goal, options, request.execution)
                                  : plan_through_cells(obstacles, start, goal, options, request.execution, &plan);
    });
    take_solution(answer, std::move(solution));
    const CellDecomposition& cells = known != nullptr ? known->cells : plan.cells;
    answer.cells = CellCount{cells.cells.size(), cells.doors.size()};
    if (answer.outcome == Outcome::not_connected) answer.outcome = Outcome::infeasible;  // cells miss no way
    if (request.keep != nullptr) request.keep->lines.push_back(doors_of(cells));
    verify_solved(answer, request.scene, problem, request.execution, request.asked.judged());
  });
  return answer;
}

Solution<Vec2> plan_from_nothing(const SolveRequest& request, const WallProblem& problem,
                                 const MedialAxisOptions& options, Answer& answer, MedialAxisPlan& plan) {
  check_axis_box(request.scene);
  const PlaneObstacles obstacles = indexed_obstacles(request, answer);
  Solution<Vec2> solution;
  without_clashes(request, [&] {
    solution = plan_on_medial_axis(obstacles, problem.start, problem.goal, options, request.execution, &plan);
  });
  return solution;
}

NamedLines lines_of(const MedialAxis& axis) {
  NamedLines lines{"medial_axis", {}};
  std::vector<Vec2> points;
  for (const AxisEdge& edge : axis.edges()) {
    points.assign(1, axis.vertices()[edge.from]);
    axis.curve(edge).append_polyline(points);
    lines.lines.add(points);
  }
  return lines;
}

constexpr AskedWords plane_words = restriction_words | choice_words;
constexpr PlannerChoice plane_planners[] = {
    {PlannerKind::prm, plane_takes, price_words | plane_words},
    {PlannerKind::lazy_prm, plane_takes, price_words | plane_words},
    {PlannerKind::rrt, rrt_options, plane_words},
    {PlannerKind::rrt_connect, rrt_connect_options, plane_words},
    {PlannerKind::rrt_star, rrt_star_options, plane_words},
    {PlannerKind::informed_rrt_star, rrt_star_options, plane_words},
    {PlannerKind::anytime, anytime_options, plane_words},
    {PlannerKind::visibility,
     OptionSet{Option::full, Option::lazy, Option::sampled_edges, Option::search, Option::queue, Option::bound},
     plane_words},
    {PlannerKind::cells, OptionSet{Option::doors, Option::search, Option::queue, Option::bound}, plane_words},
    {PlannerKind::voronoi, OptionSet{Option::objective, Option::search, Option::queue, Option::bound},
     restriction_words | AskedWords{AskedWord::goal}}};

bool fits_plane(const Scene&, const RobotSpec& robot) { return is_round(robot); }

/// The shortest path there is: of a point, which may touch what it goes around, unless the contrary is asked for, and
/// of a disc, unless there are very many corners, or options are given that are none of its.
PlannerKind usual_plane_planner(const SolveOptions& options, const Scene& scene, const Question& question) {
  constexpr std::size_t most_corners_around_discs = 50'000;
  const double reach = clearance_of(scene, question) + robot_of(scene, question).radius;
  if (!(reach > 0.0)) return question.contact == Contact::blocked ? PlannerKind::lazy_prm : PlannerKind::visibility;
  const OptionSet said = given(options);
  constexpr OptionSet of_discs{Option::bound, Option::search};
  const bool is_else_searched = options.search && *options.search != SearchMethod::astar;
  const bool by_samples = !((said | of_discs) == of_discs) || is_else_searched;
  return by_samples || corner_count(scene) > most_corners_around_discs ? PlannerKind::lazy_prm
                                                                       : PlannerKind::visibility;
}

/// For all planners that sample.
class PointAmongPolygons : public UsualBody<WallProblem> {
 public:
  using World = PolygonWorld;
  static constexpr bool names_pipeline = true;
  static constexpr bool judged_by_index = true;
  static constexpr bool improves_by_draws = false;

  explicit PointAmongPolygons(const SolveRequest& request)
      : UsualBody(request, keeping_off(request.scene, request.question,
                                       fmt::format("{} keeps off the walls", name_of(request.planner)))) {}

  std::vector<Vec2> goals(const World&) const { return {problem_.goal}; }
  void index(std::optional<World>& world, SamplerKind) const { world.emplace(scene_, problem_.reach(), execution_); }
  bool start_stands_free() const { return stands_free(scene_, problem_, problem_.start, execution_, judged_); }
  bool goal_stands_free(Vec2 goal) const { return stands_free(scene_, problem_, goal, execution_, judged_); }
  void take_prices(const MotionCost& cost) { cost_ = cost; }
  const MotionCost& price_motions(const World& world) {
    if (!problem_.prices.empty()) {
      cost_ = motion_cost(prices_.emplace(world.sides(), problem_.robot.radius, problem_.prices));
    }
    return cost_;
  }
  Path<Vec2> shortened(const World& world, const Path<Vec2>& path, Answer&) const {
    constexpr double steps_a_path = 100.0;
    const double step = path_length(path, World::distance) / steps_a_path;
    if (cost_ && step > 0.0) return pulled_taut(world, Path<Vec2>(path), cost_, step, execution_);
    return taut_path(world.sides(), path, world.planning_clearance(), execution_);
  }
  static Path<Vec2> improved(const World& world, const Path<Vec2>& path, const ImproveOptions&,
                             const Execution& execution, Counters&) {
    return taut_path(world.sides(), path, world.planning_clearance(), execution);
  }
  void judge(const World&, Path<Vec2> path, Answer& answer) const {
    answer.path = std::move(path);
    verify_solved(answer, scene_, problem_, execution_, judged_);
  }

 private:
  std::optional<SidePrices> prices_;
  MotionCost cost_;  // empty: nothing has a price
};

Answer solve_plane(const SolveRequest& request) {
  if (request.planner == PlannerKind::visibility) return solve_by_visibility(request);
  if (request.planner == PlannerKind::cells) return solve_by_cells(request);
  if (request.planner == PlannerKind::voronoi) return solve_on_medial_axis(request);
  return solve_sampled<PointAmongPolygons>(request);
}

Verdict recheck_plane(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                      const Execution& execution) {
  check_polygons(scene, execution);
  return verify_plane_answer(scene, wall_problem(scene, question), answer, execution);
}

}  // namespace

CellOptions cell_options(const SolveOptions& asked, const SearchChoice& search) {
  const CellOptions options{
      .doors = asked.cells.doors.value_or(DoorKind::midpoint), .search = search.search, .queue = search.queue};
  if (options.doors == DoorKind::funnel && asked.queue) {
    throw UsageError("@queue: @doors funnel searches with a queue of its own; @doors midpoint takes others");
  }
  return options;
}

NamedFigure doors_option(const CellOptions& options) { return {"doors", std::string(name_of(options.doors))}; }

NamedLines doors_of(const CellDecomposition& cells) {
  NamedLines doors{"cells", {}};
  for (std::uint32_t door = 0; door < cells.doors.size(); ++door) {
    const Segment line = cells.door_line(door);
    doors.lines.add(std::array{line.a, line.b});
  }
  return doors;
}

WallProblem voronoi_problem(const Scene& scene, const Question& question) {
  return keeping_off(scene, question, "voronoi keeps off the obstacles");
}

double axis_clearance(const WallProblem& problem) {
  constexpr double planning_room = 1 + 1e-9;
  return problem.reach() * planning_room;
}

void check_axis_box(const Scene& scene) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  if (box.empty() || (box.width() > 0.0 && box.height() > 0.0)) return;
  throw InputError(scene.source, "voronoi needs bounds, or obstacles, that span an area",
                   fmt::format("{} x {}", box.width(), box.height()));
}

Answer solve_on_medial_axis(const SolveRequest& request) {
  const WallProblem problem = voronoi_problem(request.scene, request.question);
  const SearchChoice search = search_choice(request.options);
  const MedialAxisOptions options{.clearance = axis_clearance(problem),
                                  .objective = request.options.axis.objective.value_or(AxisObjective::length),
                                  .search = search.search,
                                  .queue = search.queue};
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.push_back({"objective", std::string(name_of(options.objective))});
  answer_within_limits(answer, [&] {
    MedialAxisPlan plan;
    const AxisRoadmap* known = asked_roadmap<AxisRoadmap>(request);
    take_solution(answer, known != nullptr ? plan_on_medial_axis(*known, problem.start, problem.goal, options,
                                                                 request.execution, &plan)
                                           : plan_from_nothing(request, problem, options, answer, plan));
    settle_blocked_ends(answer, request.scene, problem, request.execution, request.asked.judged());
    if (problem.start == problem.goal && !is_blocked(answer.outcome) && answer.outcome != Outcome::stopped) {
      stay(answer, problem);
    } else if (answer.outcome == Outcome::solved) {
      answer.path_figures.push_back({"axis_length", plan.axis_length});
      answer.path_figures.push_back({"axis_clearance", plan.axis_clearance});
    }
    const MedialAxis* axis = known != nullptr ? &known->axis : plan.axis ? &*plan.axis : nullptr;
    if (request.keep != nullptr && axis != nullptr) request.keep->lines.push_back(lines_of(*axis));
    verify_solved(answer, request.scene, problem, request.execution, request.asked.judged());
  });
  return answer;
}

SolveKind plane_kind() {
  return {"a point or disc among polygons",
          fits_plane,
          plane_planners,
          usual_plane_planner,
          solve_plane,
          recheck_plane,
          build_sampled_or_geometric<PointAmongPolygons>,
          open_sampled_or_geometric<PointAmongPolygons>};
}

}  // namespace warren
