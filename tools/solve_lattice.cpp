// SPDX-License-Identifier: BSD-3-Clause
// A point, disc or turning polygon among walls and polygons, planned by the grid planner over a lattice of positions
// and headings.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "core/error.hpp"
#include "core/se2.hpp"
#include "planners/layer_search.hpp"
#include "tools/answer_json.hpp"
#include "tools/cell_drawing.hpp"
#include "tools/grid_options.hpp"
#include "tools/option_values.hpp"
#include "tools/solve_kind.hpp"
#include "tools/sweep_drawing.hpp"
#include "tools/verified_answer.hpp"
#include "worlds/orientation_layers.hpp"
#include "worlds/verify_se2.hpp"

namespace warren {
namespace {

constexpr PlannerChoice planners[] = {{PlannerKind::grid, "--cell --angles --face-motion --diagonal --layers"}};

bool fits_lattice(const Scene& scene, const RobotSpec& robot) {
  const bool fits = robot.kind == RobotKind::point || robot.kind == RobotKind::disc || robot.kind == RobotKind::polygon;
  return fits && !scene.map && !has_solids(scene);
}

PlannerKind usual_planner(const Arguments&, const Scene&, const ProblemOptions&) { return PlannerKind::grid; }

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
    problem.start.resize(3, 0.0);
  }
  return problem;
}

LayerOptions layer_options(const SolveRequest& request, const Problem& problem) {
  LayerOptions options;
  options.clearance = problem.clearance;
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
      : request_(request), problem_(problem), layer_options_(layer_options(request, problem)) {
    search_.diagonal = diagonal_option(request.arguments);
    search_.face_motion = request.arguments.has("--face-motion");
    answer_.problem = problem;
    answer_.planner = name_of(PlannerKind::grid);
    answer_.search = name_of(GridMethod::astar);
    describe_options();
  }

  void run() {
    {
      const StageTimer timer(request_.execution, "index", answer_.seconds.index);
      layers_ = orientation_layers(request_.scene, problem_.robot, layer_options_, request_.execution);
    }
    answer_.figures.emplace_back("states", std::to_string(layers_.states()));
    answer_.figures.emplace_back("free_states", std::to_string(layers_.free_states()));
    search();
    if (answer_.outcome == Outcome::solved) verify();
    if (request_.drawing != nullptr) draw(*request_.drawing);
  }
  Answer& answer() { return answer_; }

 private:
  bool turns() const { return problem_.robot.kind == RobotKind::polygon; }

  void describe_options() {
    const auto add = [&](const char* name, std::string value) { answer_.options.emplace_back(name, std::move(value)); };
    add("cell", json_number(layer_options_.grid.cell));
    if (turns()) add("angles", std::to_string(layer_options_.grid.angles));
    add("diagonal", json_string(name_of(search_.diagonal)));
    if (search_.face_motion) add("face_motion", "true");
    if (layer_options_.kind == LayerKind::report004) add("layers", "\"report004\"");
  }

  /// The position of the lattice at a point; it must be one, since the path begins there.
  Cell position_of(std::string_view option, const std::vector<double>& state) const {
    constexpr double rounding = 1e-6;
    const double i = (state[0] - layers_.origin.x) / layers_.cell;
    const double j = (state[1] - layers_.origin.y) / layers_.cell;
    const double column = std::round(i);
    const double row = std::round(j);
    const bool inside = column >= 0.0 && row >= 0.0 && column < layers_.width && row < layers_.height;
    if (!inside || std::abs(i - column) > rounding || std::abs(j - row) > rounding) {
      throw UsageError(fmt::format("{}: {}, {} is no position of the grid: {} + {} i, {} + {} j", option, state[0],
                                   state[1], layers_.origin.x, layers_.cell, layers_.origin.y, layers_.cell));
    }
    return {static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)};
  }
  std::uint32_t heading_of(std::string_view option, double theta) const {
    constexpr double rounding = 1e-6;
    const double full = 2.0 * std::numbers::pi;
    const double k = theta / full * layers_.angles;
    if (std::abs(k - std::round(k)) > rounding) {
      throw UsageError(fmt::format("{}: {} is none of the {} headings of the grid", option, theta, layers_.angles));
    }
    const double around = std::fmod(std::round(k), layers_.angles);
    return static_cast<std::uint32_t>(around < 0.0 ? around + layers_.angles : around);
  }

  void search() {
    const Cell start = position_of("--start", problem_.start);
    const Cell goal = position_of("--goal", problem_.goal);
    const std::uint32_t heading = turns() ? heading_of("--start", problem_.start[2]) : 0;
    std::optional<std::uint32_t> goal_heading;
    if (turns() && problem_.goal.size() == 3) goal_heading = heading_of("--goal", problem_.goal[2]);
    const StageTimer timer(request_.execution, "search", answer_.seconds.search, layers_.states());
    const LayerPath path =
        layer_search(layers_, {start.x, start.y, heading}, goal, goal_heading, search_, request_.execution);
    answer_.counters.expanded = path.expanded;
    answer_.outcome = !path.start_free                     ? Outcome::start_blocked
                      : !path.goal_free                    ? Outcome::goal_blocked
                      : path.status == SearchStatus::found ? Outcome::solved
                                                           : Outcome::not_connected;
    if (answer_.outcome == Outcome::solved) take(path);
  }

  void take(const LayerPath& path) {
    answer_.cost = path.cost;
    const auto figure = [&](const char* name, std::uint64_t n) {
      answer_.figures.emplace_back(name, std::to_string(n));
    };
    figure("cells", path.steps + 1);
    figure("moves", path.steps);
    figure("diagonal_moves", path.diagonals);
    figure("turn_steps", path.turns);
    answer_.states.width = 3;
    for (const LayerState& s : path.states) {
      const Se2 pose{layers_.origin.x + layers_.cell * s.i, layers_.origin.y + layers_.cell * s.j,
                     2.0 * std::numbers::pi * s.k / layers_.angles};
      answer_.path.push_back(pose.position());
      if (turns()) answer_.states.add(std::array{pose.x, pose.y, pose.theta});
      poses_.push_back(pose);
    }
  }

  void verify() {
    const StageTimer timer(request_.execution, "verify", answer_.seconds.verify, answer_.path.size());
    Verification verification;
    if (turns()) {
      const Se2Verification judged = verify_se2(request_.scene, problem_.robot.outline, poses_,
                                                {.clearance = problem_.clearance}, request_.execution);
      answer_.turn_rad = judged.turn_rad;
      verification = {judged.verified, judged.length, judged.min_clearance, judged.first_violation};
    } else {
      const VerifyOptions options{.clearance = problem_.clearance + problem_.robot.radius};
      verification = verify_path(request_.scene, answer_.path, options, request_.execution);
      verification.min_clearance -= problem_.robot.radius;
    }
    if (!verification.verified && layer_options_.kind == LayerKind::exact) {
      const Violation violation = verification.first_violation.value_or(Violation{});
      throw std::logic_error(fmt::format("the path of grid fails its verification at leg {}: {} is {} away",
                                         violation.leg, violation.obstacle, violation.distance));
    }
    answer_.verified = verification.verified;  // report 004's discs are no promise
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
      drawing.pages.push_back(cells_layer(fmt::format("layer_{}", degrees), blocked, at));
    }
  }

  const SolveRequest& request_;
  Problem problem_;
  LayerOptions layer_options_;
  LayerSearchOptions search_;
  HeadingLayers layers_;
  std::vector<Se2> poses_;
  Answer answer_;
};

Answer solve(const SolveRequest& request) {
  LatticeSolve solve(request, problem_of(request.scene, request.problem));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

}  // namespace

SolveKind lattice_kind() {
  return {"a body on a grid in a scene",
          fits_lattice,
          planners,
          grid_option_specs(),
          usual_planner,
          solve,
          nullptr,
          nullptr};
}

}  // namespace warren
