// SPDX-License-Identifier: BSD-3-Clause
// A point, disc or turning polygon among walls and polygons, or a turning polygon on an occupancy map, planned by the
// grid planner over a lattice of positions and headings. What begins or ends off the lattice is joined to it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"
#include "pictures/draw_cells.hpp"
#include "pictures/draw_sweep.hpp"
#include "planners/grid/heading_layer_search.hpp"
#include "solve/kinds/ends_on_lattice.hpp"
#include "solve/question/grid_choice.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/settled_ends.hpp"
#include "solve/question/solve_steps.hpp"
#include "solve/question/write_answer_io.hpp"
#include "tools/words/option_values.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/rasters/heading_layers_of_map.hpp"
#include "worlds/rasters/heading_layers_of_scene.hpp"

namespace warren {
namespace {

constexpr PlannerChoice lattice_planners[] = {
    {PlannerKind::grid, "--cell --angles --face-motion --step-cost --turn-cost --diagonal --layers"}};

bool fits_lattice(const Scene& scene, const RobotSpec& robot) {
  const bool fits = robot.kind == RobotKind::point || robot.kind == RobotKind::disc || robot.kind == RobotKind::polygon;
  return fits && (!scene.map || robot.kind == RobotKind::polygon);
}

PlannerKind usual_lattice_planner(const Arguments&, const Scene&, const ProblemOptions&) { return PlannerKind::grid; }

Problem problem_of(const Scene& scene, const ProblemOptions& options) {
  if (options.contact == Contact::allowed) throw UsageError("--contact: grid keeps off walls and polygons");
  Problem problem;
  problem.robot = robot_of(scene, options);
  problem.start = state_or_heading("--start", options.start, scene.start);
  problem.goal = state_or_heading("--goal", options.goal, scene.goal);
  problem.clearance = clearance_of(scene, options);
  if (problem.robot.kind != RobotKind::polygon) {
    problem.start.resize(2);
    problem.goal.resize(2);
  } else {
    check_heading("--start", problem.start);
    check_heading("--goal", problem.goal);
    problem.start.resize(3, 0.0);
  }
  return problem;
}

/// What only a body that turns takes.
void refuse_turns(const Arguments& arguments) {
  for (const char* option : {"--angles", "--face-motion", "--turn-cost"}) {
    if (arguments.has(option)) throw UsageError(fmt::format("{}: a point and a disc do not turn", option));
  }
}

LayerOptions layer_options(const SolveRequest& request, const Problem& problem) {
  LayerOptions options;
  if (problem.robot.kind != RobotKind::polygon) refuse_turns(request.arguments);
  options.clearance = problem.clearance;
  if (request.scene.map && request.arguments.has("--cell")) {
    throw UsageError("--cell: on a map the grid's positions are the middles of its cells");
  }
  if (request.scene.map && request.arguments.has("--layers")) {
    throw UsageError("--layers: those of a map are exact; report 004's are for walls");
  }
  options.grid = grid_spec(request.arguments, request.scene);
  if (const auto text = request.arguments.value("--layers")) {
    constexpr std::array<std::string_view, 2> words{"exact", "report004"};
    options.kind = static_cast<LayerKind>(choice_value("--layers", *text, words));
  }
  if (options.kind == LayerKind::report004 && options.clearance > 0.0) {
    throw UsageError("--clearance: the layers of report 004 know none; exact ones do");
  }
  return options;
}

/// One solve: the steps share the question and fill in the answer.
class LatticeSolve {
 public:
  LatticeSolve(const SolveRequest& request, const Problem& problem)
      : request_(request), problem_(problem), layer_options_(layer_options(request, problem)), frame_(request.scene) {
    search_.diagonal = diagonal_option(request.arguments);
    search_.face_motion = request.arguments.has("--face-motion");
    search_.step_cost = cost_option("--step-cost");
    search_.turn_cost = cost_option("--turn-cost");
    answer_.problem = problem;
    answer_.planner = name_of(PlannerKind::grid);
    answer_.search = name_of(GridMethod::astar);
    describe_options();
  }

  void run() {
    {
      const StageTimer timer(request_.execution, "index", answer_.seconds.index);
      layers_ = layers();
    }
    answer_.figures.emplace_back("states", std::to_string(layers_.states()));
    answer_.figures.emplace_back("free_states", std::to_string(layers_.free_states()));
    describe_layers();
    search();
    if (answer_.outcome == Outcome::solved) verify();
    if (request_.drawing != nullptr) draw(*request_.drawing);
  }
  Answer& answer() { return answer_; }

 private:
  bool turns() const { return problem_.robot.kind == RobotKind::polygon; }

  double cost_option(std::string_view name) const {
    const auto text = request_.arguments.value(name);
    return text ? positive_value(name, *text) : 1.0;
  }

  void describe_options() {
    const auto add = [&](const char* name, std::string value) { answer_.options.emplace_back(name, std::move(value)); };
    add("cell", json_number(layer_options_.grid.cell));
    if (turns()) add("angles", std::to_string(layer_options_.grid.angles));
    add("diagonal", json_string(name_of(search_.diagonal)));
    if (search_.face_motion) add("face_motion", "true");
    if (search_.step_cost != 1.0) add("step_cost", json_number(search_.step_cost));
    if (search_.turn_cost != 1.0) add("turn_cost", json_number(search_.turn_cost));
    if (layer_options_.kind == LayerKind::report004) add("layers", "\"report004\"");
  }

  /// Free states heading by heading, and how many headings differ.
  void describe_layers() {
    if (!turns()) return;
    std::string free;
    for (std::uint32_t k = 0; k < layers_.angles; ++k) {
      free += (k == 0 ? "[" : ", ") + std::to_string(layers_.free_at(k));
    }
    answer_.figures.emplace_back("free_at_headings", free + "]");
    const std::set<std::uint32_t> distinct(layers_.standing.begin(), layers_.standing.end());
    answer_.figures.emplace_back("distinct_layers", std::to_string(distinct.size()));
  }

  HeadingLayers layers() const {
    if (!request_.scene.map) {
      return orientation_layers(request_.scene, problem_.robot, layer_options_, request_.execution);
    }
    return map_layers(*request_.scene.map, problem_.robot.outline, layer_options_.grid.angles, problem_.clearance,
                      request_.execution);
  }

  Se2 start_pose() const { return {problem_.start[0], problem_.start[1], turns() ? problem_.start[2] : 0.0}; }
  bool any_heading() const { return turns() && problem_.goal.size() == 2; }
  Se2 goal_pose() const {
    return {problem_.goal[0], problem_.goal[1], turns() && !any_heading() ? problem_.goal[2] : 0.0};
  }

  /// The states of the lattice by which a path may begin or end.
  std::vector<LayerEnd> ends_at(std::string_view option, const Se2& pose, bool any_heading) const {
    const LatticeEnd end{frame_.in_lattice(pose), any_heading};
    std::vector<LayerEnd> states = states_at(layers_, end);
    const bool is_report = layer_options_.kind == LayerKind::report004;
    if (states.empty() && is_report) {
      throw UsageError(
          fmt::format("{}: {}, {}, {} is no state of the grid, and report 004's layers join no others: {} "
                      "+ {} i, {} + {} j, {} headings",
                      option, pose.x, pose.y, pose.theta, layers_.origin.x, layers_.cell, layers_.origin.y,
                      layers_.cell, layers_.angles));
    }
    const bool any_free = std::any_of(states.begin(), states.end(), [&](const LayerEnd& e) {
      return layers_.is_free(e.state.i, e.state.j, e.state.k);
    });
    if (any_free || is_report) return states;
    return EndWorld(request_.scene, problem_, layers_, end, request_.execution).joined(search_);
  }

  /// Does the body fit at an end, in some heading where any will do, as the verification sees it?
  bool stands_free(const Se2& pose, bool any_heading) const {
    const std::uint32_t headings = any_heading ? layers_.angles : 1;
    for (std::uint32_t k = 0; k < headings; ++k) {
      const Se2 turned{pose.x, pose.y, pose.theta + 2.0 * std::numbers::pi * k / headings};
      if (judged(std::span(&turned, 1), false).verified) return true;
    }
    return false;
  }

  void search() {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search, layers_.states());
    const std::vector<LayerEnd> starts = ends_at("--start", start_pose(), false);
    const std::vector<LayerEnd> goals = ends_at("--goal", goal_pose(), any_heading());
    const LayerPath path = layer_search(layers_, starts, goals, search_, request_.execution);
    answer_.counters.expanded = path.expanded;
    const Outcome found = !path.start_free                     ? Outcome::start_blocked
                          : !path.goal_free                    ? Outcome::goal_blocked
                          : path.status == SearchStatus::found ? Outcome::solved
                                                               : Outcome::not_connected;
    const bool is_report = layer_options_.kind == LayerKind::report004;  // its discs say what is blocked
    answer_.outcome = is_report ? found
                                : settled_ends(
                                      found, [&] { return stands_free(start_pose(), false); },
                                      [&] { return stands_free(goal_pose(), any_heading()); });
    if (answer_.outcome == Outcome::solved) take(path);
  }

  void take(const LayerPath& path) {
    answer_.cost = path.cost;
    const auto figure = [&](const char* name, std::uint64_t n) {
      answer_.path_figures.emplace_back(name, std::to_string(n));
    };
    figure("cells", path.steps + 1);
    figure("moves", path.steps);
    figure("diagonal_moves", path.diagonals);
    figure("turn_steps", path.turns);
    take_poses(path.states);
    answer_.states.width = 3;
    for (const Se2& pose : poses_) {
      answer_.path.push_back(pose.position());
      if (turns()) answer_.states.add(std::array{pose.x, pose.y, pose.theta});
    }
  }

  /// The path begins and ends where it was asked to, on the lattice or off it.
  void take_poses(const std::vector<LayerState>& states) {
    const auto pose = [&](const LayerState& s) { return frame_.in_world(pose_of(layers_, s)); };
    const auto is_there = [&](const Se2& end, const Se2& state, bool any_heading) {
      constexpr double rounding = 1e-9;  // of a cell, and of a radian
      return distance(end.position(), state.position()) <= rounding * layers_.cell &&
             (any_heading || std::abs(turn_between(end.theta, state.theta)) <= rounding);
    };
    Se2 goal = goal_pose();
    if (any_heading()) goal.theta = pose(states.back()).theta;
    poses_.push_back(start_pose());
    for (const LayerState& s : states) {
      const Se2 next = pose(s);
      const bool is_end = (s == states.front() && is_there(start_pose(), next, !turns())) ||
                          (s == states.back() && is_there(goal, next, !turns()));
      if (!is_end) poses_.push_back(next);
    }
    if (poses_.size() > 1 || !is_there(goal, start_pose(), !turns())) poses_.push_back(goal);
  }

  Verification judged(std::span<const Se2> poses, bool ends_too) const {
    if (turns()) {
      PoseVerifyOptions options{.clearance = problem_.clearance};
      if (ends_too) {
        options.start = start_pose();
        options.goal = goal_pose();
        options.any_heading = any_heading();
      }
      return verify_se2(request_.scene, problem_.robot.outline, poses, options, request_.execution);
    }
    std::vector<Vec2> path;
    for (const Se2& pose : poses) path.push_back(pose.position());
    const VerifyOptions options{.clearance = problem_.clearance + problem_.robot.radius};
    Verification verification = verify_path(request_.scene, path, options, request_.execution);
    verification.min_clearance -= problem_.robot.radius;
    return verification;
  }

  void verify() {
    const StageTimer timer(request_.execution, "verify", answer_.seconds.verify, answer_.path.size());
    const Verification verification = judged(poses_, layer_options_.kind == LayerKind::exact);
    if (!verification.verified) {
      if (layer_options_.kind == LayerKind::exact) fail_verification(answer_, verification.first_violation);
      return refute(answer_, verification);  // report 004's discs are no promise
    }
    answer_.verified = true;
    if (turns()) answer_.turn_rad = verification.turn_rad;
    answer_.length = verification.length;
    answer_.min_clearance = verification.min_clearance;
  }

  /// The body along the path; and the layers of some headings, which course reports show, each on a page of its own.
  void draw(Drawing& drawing) const {
    if (!turns()) return;
    if (!poses_.empty()) drawing.layers.push_back(sweep_of(poses_, problem_.robot.outline));
    for (const std::uint32_t degrees : {0U, 45U, 90U}) {
      const std::uint64_t heading = std::uint64_t{degrees} * layers_.angles;
      if (heading % 360 != 0 || heading / 360 >= layers_.angles) continue;
      const Bitmap& blocked = layers_.bitmaps[layers_.standing[heading / 360]];
      const auto at = [&](Vec2 p) { return layers_.origin + layers_.cell * (p - Vec2{0.5, 0.5}); };
      drawing.pages.push_back(cells_layer(fmt::format("layer_{}", degrees), blocked, at, request_.execution));
    }
  }

  const SolveRequest& request_;
  Problem problem_;
  LayerOptions layer_options_;
  LayerSearchOptions search_;
  LatticeFrame frame_;
  HeadingLayers layers_;
  std::vector<Se2> poses_;
  Answer answer_;
};

Answer solve_lattice(const SolveRequest& request) {
  LatticeSolve solve(request, problem_of(request.scene, request.problem));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

}  // namespace

SolveKind lattice_kind() {
  return {"a body on a grid in a scene", fits_lattice,  lattice_planners, grid_option_specs(),
          usual_lattice_planner,         solve_lattice, nullptr,          nullptr};
}

}  // namespace warren
