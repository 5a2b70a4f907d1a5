// SPDX-License-Identifier: BSD-3-Clause
// The planner visibility: the shortest path of a point, or of what keeps a distance, and that it is the shortest is
// said. Of a disc that is the path with its arcs; what is verified and answered is a polyline around them. Worlds with
// very many corners are searched lazily, unless something is asked for that needs the whole graph. With --sampled-edges
// the graph is made as the report made it, and the answer says which of its edges are wrong.

#include <algorithm>
#include <array>
#include <tuple>

#include "core/base/error.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/queue_choice.hpp"
#include "planners/visibility/disc_path.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "planners/visibility/visibility_path.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/solve_steps.hpp"

namespace warren {
namespace {

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

/// The polygons as the file has them, for edges that are told by their corners' numbers there.
PolygonSet polygons_of(const Scene& scene) {
  PolygonSet set;
  for (const ScenePolygon& polygon : scene.polygons) set.add(polygon.corners);
  return set;
}

/// Solves on the graph of sampled edges and says what is wrong with them. The path is verified like any other; what is
/// refuted is answered as such.
class SampledVisibilitySolve {
 public:
  SampledVisibilitySolve(const SolveRequest& request, const WallProblem& problem, const VisibilityOptions& how)
      : request_(request), problem_(problem), how_(how) {}

  void run(Answer& answer) {
    const Execution& execution = request_.execution;
    const PolygonIndex polygons(polygons_of(request_.scene), execution);
    points_ = polygons.polygons().corners;
    points_.push_back(problem_.start);
    points_.push_back(problem_.goal);
    {
      const StageTimer timer(execution, "connect", answer.seconds.connect, points_.size());
      edges_ = sampled_visibility(polygons, problem_.start, problem_.goal, *request_.options.visibility.sampled_edges,
                                  execution);
    }
    answer.roadmap = {points_.size(), edges_.size(), 0};
    search(answer);
    {
      const StageTimer timer(execution, "proof", proof_s_, edges_.size());
      tell_wrong_edges(polygons, answer);
    }
    answer.figures.push_back({"proof_s", proof_s_});
    if (request_.keep != nullptr) keep_edges(*request_.keep);
    judge(answer);
  }
  /// What finding the wrong edges took: of the proof that sampling is wrong, not of the solving.
  double proof_s() const { return proof_s_; }

 private:
  SearchResult search(const Graph& graph, VertexId start, VertexId goal) const {
    SearchState state;
    if (!has_queue(how_.search)) return search_blindly(how_.search, graph, start, goal, state, request_.execution);
    const auto neighbours = [&](VertexId v, const auto& visit) {
      for (const VertexId w : graph.neighbours(v)) visit(w, distance(points_[v], points_[w]));
    };
    const bool informed = how_.search == SearchKind::astar;
    const auto remaining = [&](VertexId v) { return informed ? distance(points_[v], points_[goal]) : 0.0; };
    return search_best_first(how_.queue, graph.vertex_count(), start, goal, neighbours, remaining, state,
                             request_.execution);
  }

  void search(Answer& answer) {
    const StageTimer timer(request_.execution, "search", answer.seconds.search);
    const Graph graph = assemble_graph(points_.size(), edges_, request_.execution);
    const auto goal = static_cast<VertexId>(points_.size() - 1);
    const SearchResult found = search(graph, goal - 1, goal);
    answer.counters.expanded = found.expanded;
    if (found.status == SearchStatus::stopped) request_.execution.check();
    answer.outcome = found.status == SearchStatus::found ? Outcome::solved : Outcome::not_connected;
    for (const VertexId v : found.path) answer.path.push_back(points_[v]);
  }

  void tell_wrong_edges(const PolygonIndex& polygons, Answer& answer) {
    constexpr std::size_t places = 4096;
    const Box& box = polygons.box();
    const double rounding = 1e-12 * std::max(box.width(), box.height());
    for (const Edge& edge : edges_) {
      request_.execution.check();
      const double depth = depth_inside(polygons, {points_[edge.from], points_[edge.to]}, places);
      if (depth <= rounding) continue;
      wrong_.push_back({edge.from, edge.to, depth});
    }
    answer.figures.push_back({"wrong_edges", wrong_});
  }

  void keep_edges(ByProducts& keep) const {
    NamedLines all{"visibility", {}};
    for (const Edge& edge : edges_) all.lines.add(std::array{points_[edge.from], points_[edge.to]});
    NamedLines wrong{"wrong_edges", {}};
    for (const WrongEdge& edge : wrong_) wrong.lines.add(std::array{points_[edge.from], points_[edge.to]});
    keep.lines.push_back(std::move(all));
    keep.lines.push_back(std::move(wrong));
  }

  void judge(Answer& answer) const {
    if (answer.outcome != Outcome::solved) return;
    const StageTimer timer(request_.execution, "verify", answer.seconds.verify);
    const Verification judged = verify_plane_answer(request_.scene, problem_, recorded(answer), request_.execution);
    if (!judged.verified) return refute(answer, judged);
    take_verdict(answer, judged);
  }

  const SolveRequest& request_;
  const WallProblem& problem_;
  const VisibilityOptions& how_;
  std::vector<Vec2> points_;  // corners in the file's order, start, goal
  std::vector<Edge> edges_;
  std::vector<WrongEdge> wrong_;
  double proof_s_ = 0.0;
};

void solve_whole(const SolveRequest& request, const WallProblem& problem, const VisibilityOptions& options,
                 Answer& answer) {
  const VisibilityRoadmap* known = asked_roadmap<VisibilityRoadmap>(request);
  PlaneObstacles obstacles;
  if (known == nullptr) obstacles = indexed_obstacles(request, answer);
  if (stand_on_seams(request, problem, answer)) return;
  PlannedRoadmap<Vec2>* keep = request.keep != nullptr ? &request.keep->roadmap : nullptr;
  const auto& [start, goal] = std::tie(problem.start, problem.goal);
  take_solution(answer, known != nullptr
                            ? visibility_path(*known, start, goal, options, request.execution, keep)
                            : confined_visibility_path(obstacles, start, goal, options, request.execution, keep));
  if (answer.outcome == Outcome::not_connected) answer.outcome = Outcome::infeasible;  // the graph misses no path
  verify_solved(answer, request.scene, problem, request.execution, request.asked.judged());
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
  return known != nullptr ? shortest_disc_path(*known, problem.start, problem.goal, problem.reach(), execution)
                          : shortest_disc_path(*ground, problem.start, problem.goal, problem.reach(), execution);
}

ArcPath arcs_of(const DiscPath& path) {
  ArcPath arcs{{path.pieces.front().from}, {0.0}};
  for (const DiscPiece& piece : path.pieces) {
    arcs.points.push_back(piece.to);
    arcs.turns.push_back(piece.anticlockwise ? piece.angle : -piece.angle);
  }
  return arcs;
}

void tell_bracket(const DiscPath& path, Answer& answer) {
  const double drawn = path_length(answer.path, [](Vec2 a, Vec2 b) { return distance(a, b); });
  answer.path_figures.push_back({"arcs", path.arcs()});
  answer.path_figures.push_back({"excess", std::max(0.0, drawn - path.length)});
  answer.lower_bound = path.lower_bound;
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
    tell_bracket(path, answer);
    if (request.keep != nullptr) request.keep->arcs = arcs_of(path);
  }
  settle_blocked_ends(answer, request.scene, problem, request.execution, request.asked.judged());
  verify_solved(answer, request.scene, problem, request.execution, request.asked.judged());
  constexpr double bracket = 1e-9;  // of the length: more than the trifles by which it is open
  answer.optimal = answer.verified && path.length - path.lower_bound <= bracket * path.length;
}

}  // namespace

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
  SampledVisibilitySolve sampled(request, problem, options);
  answer_within_limits(answer, [&] {
    if (sample_step) return sampled.run(answer);
    solve_whole(request, problem, options, answer);
  });
  answer.solve_s -= sampled.proof_s();
  return answer;
}

}  // namespace warren
