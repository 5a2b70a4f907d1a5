// SPDX-License-Identifier: BSD-3-Clause
// A point or disc among polygons and walls: joins worlds/plane/polygon_world with the planners that sample it, and the
// planners that don't (docs/algorithms.md). What is verified and answered of a disc's shortest path is a polyline
// around its arcs. Worlds with very many corners are searched lazily, unless something is asked for that needs the
// whole graph. With --sampled-edges the graph is made as the report made it, and the answer says which of its edges are
// wrong.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/axis/medial_axis_planner.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "planners/shorten/taut_path.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "planners/visibility/disc_path.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "worlds/plane/polygon_world.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {
namespace {

/// Does start or goal stand on a seam, strictly inside of a polygon that was cut there? Says so in the answer.
bool stand_on_seams(const SolveRequest& request, const WallProblem& problem, Answer& answer) {
  if (stands_on_seam(request.scene, problem.goal)) answer.outcome = Outcome::goal_blocked;
  if (stands_on_seam(request.scene, problem.start)) answer.outcome = Outcome::start_blocked;
  return is_blocked(answer.outcome);
}

/// The scene's obstacles for planners; the time is that of the stage `index`.
PlaneObstacles indexed_obstacles(const SolveRequest& request, Answer& answer) {
  const StageTimer timer(request.execution, "index", answer.seconds.index, request.scene.polygons.size());
  return plane_obstacles(request.scene, request.execution);
}

/// Room for so many lines of two corners.
void reserve_lines(PolygonSet& lines, std::size_t count, const Execution& execution) {
  execution.reserve(count * (2 * sizeof(Vec2) + sizeof(std::uint32_t)));
  lines.corners.reserve(2 * count);
  lines.first.reserve(count + 1);
}

constexpr std::size_t most_corners_at_once = 20'000;

VisibilityOptions options_of(const SolveRequest& request, const SearchChoice& search) {
  const VisibilityFields& fields = request.options.visibility;
  VisibilityOptions options;
  options.search = search.search;
  options.queue = search.queue;
  if (fields.full) options.edges = VisibilityEdges::full;
  if (fields.sampled_edges && fields.full) {
    throw UsageError("@full: @sampled_edges makes a graph of its own, of all edges");
  }
  const bool plain =
      !fields.full && search.search == SearchKind::astar && search.queue == QueueKind::heap && !fields.sampled_edges;
  if (request.options.roadmap.lazy) throw UsageError("@lazy: takes no value with visibility");
  if (fields.lazy && !plain) {
    throw UsageError("@lazy: finds edges as A* needs them; @full, @sampled_edges, @search and @queue need all of them");
  }
  const bool is_kept = request.asked.session != nullptr;
  options.lazy = fields.lazy || (plain && !is_kept && corner_count(request.scene) > most_corners_at_once);
  return options;
}

/// Of the graph of sampled edges, whose last two points are start and goal.
void search_edges(const std::vector<Vec2>& points, const std::vector<Edge>& edges, const VisibilityOptions& how,
                  const Execution& execution, Answer& answer) {
  const StageTimer timer(execution, "search", answer.seconds.search);
  const Graph graph = assemble_graph(points.size(), edges, execution);
  const auto goal = static_cast<VertexId>(points.size() - 1);
  const auto length = [&](VertexId v, VertexId w) { return distance(points[v], points[w]); };
  const VertexDistance apart(length);
  const SearchResult found = search_roadmap(graph, {.start = goal - 1,
                                                    .goal = goal,
                                                    .length = apart,
                                                    .estimate = apart,
                                                    .search = how.search,
                                                    .queue = how.queue,
                                                    .execution = execution,
                                                    .estimate_fits = false});  // from the start alone
  answer.counters.expanded = found.expanded;
  answer.outcome = found.status == SearchStatus::found ? Outcome::solved : Outcome::not_connected;
  for (const VertexId v : found.path) answer.path.push_back(points[v]);
}

std::vector<WrongEdge> wrong_edges(const PolygonIndex& polygons, const std::vector<Vec2>& points,
                                   const std::vector<Edge>& edges, const Execution& execution) {
  constexpr std::size_t places = 4096;
  const Box& box = polygons.box();
  const double rounding = 1e-12 * std::max(box.width(), box.height());
  std::vector<WrongEdge> wrong;
  for (const Edge& edge : edges) {
    execution.check();
    const double depth = depth_inside(polygons, {points[edge.from], points[edge.to]}, places);
    if (!(depth <= rounding)) push_asked(wrong, {edge.from, edge.to, depth}, execution);
  }
  return wrong;
}

/// Solves on the graph of sampled edges and says what is wrong with them. The path is verified like any other; what is
/// refuted is answered as such. proof_s: what finding the wrong edges took, of the proof that sampling is wrong, not of
/// the solving.
void solve_on_sampled_edges(const SolveRequest& request, const WallProblem& problem, const VisibilityOptions& how,
                            double& proof_s, Answer& answer) {
  const Execution& execution = request.execution;
  std::size_t corners = 2;
  for (const ScenePolygon& polygon : request.scene.polygons) corners += polygon.corners.size();
  execution.reserve(2 * corners * sizeof(Vec2));
  PolygonSet as_in_file;  // edges are told by the numbers of their corners there
  as_in_file.corners.reserve(corners);
  for (const ScenePolygon& polygon : request.scene.polygons) as_in_file.add(polygon.corners);
  const PolygonIndex polygons(std::move(as_in_file), execution);
  std::vector<Vec2> points;
  points.reserve(corners);
  points = polygons.polygons().corners;
  points.push_back(problem.start);
  points.push_back(problem.goal);
  std::vector<Edge> edges;
  {
    const StageTimer timer(execution, "connect", answer.seconds.connect, points.size());
    edges =
        sampled_visibility(polygons, problem.start, problem.goal, *request.options.visibility.sampled_edges, execution);
  }
  answer.roadmap = {points.size(), edges.size(), 0};
  search_edges(points, edges, how, execution, answer);
  std::vector<WrongEdge> wrong;
  {
    const StageTimer timer(execution, "proof", proof_s, edges.size());
    wrong = wrong_edges(polygons, points, edges, execution);
    answer.figures.push_back({"wrong_edges", wrong});
  }
  answer.figures.push_back({"proof_s", proof_s});
  const auto keep = [&](const char* name, const auto& some) {
    NamedLines& kept = request.keep->lines.emplace_back(NamedLines{name, {}});
    reserve_lines(kept.lines, some.size(), execution);
    for (const auto& edge : some) {
      execution.poll(kept.lines.size());
      kept.lines.add(std::array{points[edge.from], points[edge.to]});
    }
  };
  if (request.keep != nullptr) {
    keep("visibility", edges);
    keep("wrong_edges", wrong);
  }
  if (answer.outcome != Outcome::solved) return;
  const StageTimer timer(execution, "verify", answer.seconds.verify);
  const Verification judged = verify_path(request.scene, answer.path, verify_options(problem), execution);
  judged.verified ? take_verdict(answer, judged) : refute(answer, judged);
}

void solve_whole(const SolveRequest& request, const WallProblem& problem, const VisibilityOptions& options,
                 Answer& answer) {
  const VisibilityRoadmap* known = asked_roadmap<VisibilityRoadmap>(request);
  const PlaneObstacles obstacles = known == nullptr ? indexed_obstacles(request, answer) : PlaneObstacles();
  if (stand_on_seams(request, problem, answer)) return;
  PlannedRoadmap<Vec2>* keep = request.keep != nullptr ? &request.keep->roadmap : nullptr;
  const auto& [start, goal] = std::tie(problem.start, problem.goal);
  take_solution(answer, known != nullptr
                            ? visibility_path(*known, start, goal, options, request.execution, keep)
                            : confined_visibility_path(obstacles, start, goal, options, request.execution, keep));
  if (answer.outcome == Outcome::not_connected) answer.outcome = Outcome::infeasible;  // the graph misses no path
  judge_of(request, problem).verify_solved(answer);
  answer.optimal = answer.verified && has_queue(options.search);
}

// The same for a disc, or a point that keeps a clearance.

DiscPath plan_disc(const SolveRequest& request, const WallProblem& problem, Answer& answer) {
  const DiscRoadmap* known = asked_roadmap<DiscRoadmap>(request);
  const Execution& execution = request.execution;
  std::optional<DiscGround> ground;
  if (known == nullptr) {
    const PlaneObstacles obstacles = indexed_obstacles(request, answer);
    const StageTimer timer(execution, "index", answer.seconds.index);
    ground.emplace(obstacles, execution);
  }
  const StageTimer timer(execution, "search", answer.seconds.search);
  return shortest_disc_path(known != nullptr ? known->ground : *ground, problem.start, problem.goal, problem.reach(),
                            execution, known != nullptr ? &known->graph.graph() : nullptr);
}

void solve_disc(const SolveRequest& request, const WallProblem& problem, Answer& answer) {
  const DiscPath path = plan_disc(request, problem, answer);
  answer.outcome = path.outcome;
  answer.roadmap = {path.circles + 2, path.candidates, 0};
  answer.counters.edges_checked = path.checked;
  answer.counters.edges_free = path.free;
  answer.counters.expanded = path.arrivals;
  if (path.outcome == Outcome::solved) {
    answer.path = polyline_of(path, request.execution);
    const double drawn = path_length(answer.path, [](Vec2 a, Vec2 b) { return distance(a, b); });
    answer.path_figures.push_back({"arcs", path.arcs()});
    answer.path_figures.push_back({"excess", std::max(0.0, drawn - path.length)});
    answer.lower_bound = path.lower_bound;
    if (request.keep != nullptr) {
      ArcPath& arcs = request.keep->arcs;
      arcs = {{path.pieces.front().from}, {0.0}};
      for (const DiscPiece& piece : path.pieces) {
        arcs.points.push_back(piece.to);
        arcs.turns.push_back(piece.anticlockwise ? piece.angle : -piece.angle);
      }
    }
  }
  const PointJudge judge = judge_of(request, problem);
  answer.outcome = judge.settled(answer.outcome);
  judge.verify_solved(answer);
  constexpr double bracket = 1e-9;  // of the length: more than the trifles by which it is open
  answer.optimal = answer.verified && path.length - path.lower_bound <= bracket * path.length;
}

Answer solve_by_visibility(const SolveRequest& request) {
  const WallProblem problem = touching_problem(request);
  const SearchChoice search = search_choice(request.options);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  if (problem.reach() > 0.0) {
    answer_within_limits(answer, [&] { solve_disc(request, problem, answer); });
    return answer;
  }
  const VisibilityOptions options = options_of(request, search);
  const std::optional<double>& sample_step = request.options.visibility.sampled_edges;
  if (options.edges == VisibilityEdges::full) answer.options.push_back({"full", true});
  if (options.lazy) answer.options.push_back({"lazy", true});
  if (sample_step) answer.options.push_back({"sampled_edges", *sample_step});
  double proof_s = 0.0;
  answer_within_limits(answer, [&] {
    if (sample_step) return solve_on_sampled_edges(request, problem, options, proof_s, answer);
    solve_whole(request, problem, options, answer);
  });
  answer.solve_s -= proof_s;
  return answer;
}

Answer solve_by_cells(const SolveRequest& request) {
  const WallProblem problem = touching_problem(request);
  const SearchChoice search = search_choice(request.options);
  const CellOptions options = cell_options(request.options, search);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.push_back({"doors", std::string(name_of(options.doors))});
  answer_within_limits(answer, [&] {
    const CellRoadmap* known = asked_roadmap<CellRoadmap>(request);
    const PlaneObstacles obstacles = known == nullptr ? indexed_obstacles(request, answer) : PlaneObstacles();
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
    if (request.keep != nullptr) request.keep->lines.push_back(doors_of(cells, request.execution));
    judge_of(request, problem).verify_solved(answer);
  });
  return answer;
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
class PointAmongPolygons : public PointBody<SidePrices> {
 public:
  using World = PolygonWorld;
  static constexpr bool names_pipeline = true;
  static constexpr bool improves_by_draws = false;

  explicit PointAmongPolygons(const SolveRequest& request)
      : PointBody(request, keeping_off(request.scene, request.question,
                                       fmt::format("{} keeps off the walls", name_of(request.planner)))) {}

  void index(std::optional<World>& world, SamplerKind) const { world.emplace(scene_, problem_.reach(), execution_); }
  const MotionLength<Vec2>& price_motions(const World& world) { return price_in(world.sides()); }
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
  const WallProblem problem = wall_problem(scene, question);
  check_state_width(answer, 2, "a point or disc");
  return {verify_path(scene, answer.path, verify_options(problem), execution), problem.general()};
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

NamedLines doors_of(const CellDecomposition& cells, const Execution& execution) {
  NamedLines doors{"cells", {}};
  reserve_lines(doors.lines, cells.doors.size(), execution);
  for (std::uint32_t door = 0; door < cells.doors.size(); ++door) {
    execution.poll(door);
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

void check_axis_box(const Scene& scene, const Execution& execution) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
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
    Solution<Vec2> solution;
    if (known != nullptr) {
      solution = plan_on_medial_axis(*known, problem.start, problem.goal, options, request.execution, &plan);
    } else {
      check_axis_box(request.scene, request.execution);
      const PlaneObstacles obstacles = indexed_obstacles(request, answer);
      without_clashes(request, [&] {
        solution = plan_on_medial_axis(obstacles, problem.start, problem.goal, options, request.execution, &plan);
      });
    }
    take_solution(answer, std::move(solution));
    const PointJudge judge = judge_of(request, problem);
    answer.outcome = judge.settled(answer.outcome);
    if (problem.start == problem.goal && !is_blocked(answer.outcome) && answer.outcome != Outcome::stopped) {
      stay(answer, problem);
    } else if (answer.outcome == Outcome::solved) {
      answer.path_figures.push_back({"axis_length", plan.axis_length});
      answer.path_figures.push_back({"axis_clearance", plan.axis_clearance});
    }
    const MedialAxis* axis = known != nullptr ? &known->axis : plan.made ? &plan.made->axis : nullptr;
    if (request.keep != nullptr && axis != nullptr) {
      NamedLines& lines = request.keep->lines.emplace_back(NamedLines{"medial_axis", {}});
      std::vector<Vec2> points;
      for (const AxisEdge& edge : axis->edges) {
        const std::size_t held = lines.lines.corners.size() * sizeof(Vec2);
        if (lines.lines.size() % 4096 == 0) request.execution.reserve(2 * held);
        points.assign(1, axis->vertices[edge.from]);
        axis->curve(edge).append_polyline(points);
        lines.lines.add(points);
      }
    }
    judge.verify_solved(answer);
  });
  return answer;
}

SolveKind plane_kind() {
  return {"a point or disc among polygons",
          [](const Scene&, const RobotSpec& robot) { return is_round(robot); },
          plane_planners,
          usual_plane_planner,
          solve_plane,
          recheck_plane,
          build_sampled_or_geometric<PointAmongPolygons>,
          open_sampled_or_geometric<PointAmongPolygons>};
}

}  // namespace warren
