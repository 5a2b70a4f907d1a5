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
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "core/plane/heading_layers.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/grid/heading_layer_search.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/plane/maze_world.hpp"
#include "worlds/plane/polygon_world.hpp"
#include "worlds/poses/se2_world.hpp"
#include "worlds/rasters/heading_layers.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

// How start and goal of the grid planner get onto its lattice. A pose that is one of the lattice's states is that
// state. Any other is joined to the free states around it, as a roadmap would join it: by motions that are certified
// against the obstacles themselves, at the cost of their way and turn in steps.

/// A start or a goal, in the lattice's coordinates.
struct LatticeEnd {
  Se2 pose;
  bool any_heading = false;  ///< pose.theta does not matter
};

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr std::int64_t widest_join = 4;  // cells to each side

double heading_step(const HeadingLayers& layers) { return full_turn / layers.angles; }

std::uint32_t wrapped(std::int64_t k, std::uint32_t angles) {
  const std::int64_t n = angles;
  return static_cast<std::uint32_t>((k % n + n) % n);
}

/// The whole number that this is, but for rounding.
std::optional<std::int64_t> whole(double x) {
  constexpr double rounding = 1e-9;
  constexpr double largest = 9e15;
  const double nearest = std::round(x);
  if (!(std::abs(x) < largest) || std::abs(x - nearest) > rounding) return std::nullopt;
  return static_cast<std::int64_t>(nearest);
}

/// The first of the numbers below and above x, `reach` of each.
std::int64_t first_around(double x, std::int64_t reach) { return static_cast<std::int64_t>(std::floor(x)) - reach + 1; }

/// The headings to which an end may be joined.
std::vector<std::uint32_t> headings_around(const HeadingLayers& layers, const LatticeEnd& end) {
  constexpr std::uint32_t few = 4;
  const bool all = end.any_heading || layers.angles <= few;
  const std::int64_t first = all ? 0 : first_around(end.pose.theta / heading_step(layers), few / 2);
  std::vector<std::uint32_t> headings;
  for (std::uint32_t i = 0; i < (all ? layers.angles : few); ++i) headings.push_back(wrapped(first + i, layers.angles));
  return headings;
}

/// The cells around a pose that a body can reach on its way to the lattice, in the lattice's coordinates.
OccupancyMap cut_out(const OccupancyMap& map, const Se2& pose, double reach, const Execution& execution) {
  const double room = std::min(std::ceil(reach / map.cell) + widest_join + 2, 4294967295.0);
  const auto clamped = [](double x, std::uint32_t end) { return bounded_whole<std::uint32_t>(x, 0.0, end); };
  const std::uint32_t left = clamped(std::floor(pose.x / map.cell) - room, map.width() - 1);
  const std::uint32_t low = clamped(std::floor(pose.y / map.cell) - room, map.height() - 1);
  const std::uint32_t right = clamped(std::floor(pose.x / map.cell) + room + 1, map.width());
  const std::uint32_t high = clamped(std::floor(pose.y / map.cell) + room + 1, map.height());
  OccupancyMap cut;
  cut.cell = map.cell;
  cut.origin = {left * map.cell, low * map.cell};
  cut.blocked = cell_bitmap(std::max(right, left + 1) - left, std::max(high, low + 1) - low, execution);
  for (std::uint32_t y = 0; y < cut.height(); ++y) {
    execution.check();
    for (std::uint32_t x = 0; x < cut.width(); ++x) {
      if (map.blocked.test(left + x, low + y)) cut.blocked.set(x, y);
    }
  }
  return cut;
}

/// Around an end of a body that turns.
Se2World turning_world(const Scene& scene, const PoseProblem& problem, const Se2& pose, const Execution& execution) {
  if (!scene.map) return {scene, problem.robot.outline, problem.clearance, execution};
  Scene around;
  around.map = cut_out(*scene.map, pose, problem.clearance + outline_reach(problem.robot.outline), execution);
  add_map_walls(around, execution);
  return {around, problem.robot.outline, problem.clearance, execution};
}

/// Where a lattice's coordinates lie in the world: those of a scene are the world's own, those of a map begin in its
/// corner and turn with it.
struct LatticeFrame {
  Se2 corner;
  Rotation turn{corner.theta};
  Rotation turn_back{-corner.theta};

  Se2 in_world(const Se2& pose) const {
    const Vec2 p = corner.position() + turn(pose.position());
    return {p.x, p.y, pose.theta + corner.theta};
  }
  Se2 in_lattice(const Se2& pose) const {
    const Vec2 p = turn_back(pose.position() - corner.position());
    return {p.x, p.y, pose.theta - corner.theta};
  }
};

/// The pose of a state, in the lattice's coordinates.
Se2 pose_of(const HeadingLayers& layers, const LayerState& state) {
  return {layers.origin.x + layers.cell * state.i, layers.origin.y + layers.cell * state.j,
          full_turn * state.k / layers.angles};
}
/// The states of the lattice at a pose: one, or one a heading; none if it lies between them.
std::vector<LayerEnd> states_at(const HeadingLayers& layers, const LatticeEnd& end) {
  const auto i = whole((end.pose.x - layers.origin.x) / layers.cell);
  const auto j = whole((end.pose.y - layers.origin.y) / layers.cell);
  if (!i || !j || *i < 0 || *j < 0 || *i >= layers.width || *j >= layers.height) return {};
  const auto state = [&](std::uint32_t k) {
    return LayerEnd{{static_cast<std::uint32_t>(*i), static_cast<std::uint32_t>(*j), k}};
  };
  std::vector<LayerEnd> states;
  if (end.any_heading || layers.angles == 1) {
    for (std::uint32_t k = 0; k < layers.angles; ++k) states.push_back(state(k));
  } else if (const auto k = whole(end.pose.theta / heading_step(layers))) {
    states.push_back(state(wrapped(*k, layers.angles)));
  }
  return states;
}

template <class World>
bool is_free_motion(const World& world, const Se2& from, const Se2& to) {
  const auto state = [](const Se2& pose) {
    if constexpr (std::is_same_v<World, Se2World>) {
      return pose;
    } else {
      return pose.position();
    }
  };
  auto query = world.make_query();
  return world.is_free(state(from), query) && world.is_free_motion(state(from), state(to), query);
}

constexpr PlannerChoice lattice_planners[] = {
    {PlannerKind::grid,
     OptionSet{Option::cell, Option::angles, Option::face_motion, Option::step_cost, Option::turn_cost,
               Option::diagonal, Option::layers},
     restriction_words | pose_choice_words}};

bool fits_lattice(const Scene& scene, const RobotSpec& robot) {
  return robot.kind == RobotKind::polygon || (is_round(robot) && !scene.map);
}

/// Of what does not turn all headings are 0.
PoseProblem problem_of(const Scene& scene, const Question& options) {
  if (options.contact == Contact::allowed) throw UsageError("@contact: grid keeps off walls and polygons");
  PoseProblem problem;
  problem.robot = robot_of(scene, options);
  std::vector<double> start = state_or_heading("@start", options.start, scene.start);
  problem.goal = state_or_heading("@goal", options.goal, scene.goal);
  problem.clearance = clearance_of(scene, options);
  if (is_round(problem.robot)) {
    start.resize(2);
    problem.goal = {problem.goal[0], problem.goal[1], 0.0};
  } else {
    check_heading("@start", start);
    check_heading("@goal", problem.goal);
  }
  start.resize(3, 0.0);
  problem.start = {start[0], start[1], start[2]};
  return problem;
}

LayerOptions layer_options(const SolveRequest& request, const PoseProblem& problem) {
  LayerOptions options;
  if (is_round(problem.robot)) {
    for (const Option option : {Option::angles, Option::face_motion, Option::turn_cost}) {
      if (!given(request.options).has(option)) continue;
      throw UsageError(fmt::format("@{}: a point and a disc do not turn", name_of(option)));
    }
  }
  options.clearance = problem.clearance;
  if (request.scene.map && request.options.grid.cell) {
    throw UsageError("@cell: on a map the grid's positions are the middles of its cells");
  }
  if (request.scene.map && request.options.grid.layers) {
    throw UsageError("@layers: those of a map are exact; report 004's are for walls");
  }
  options.grid = grid_spec(request.options.grid, request.scene);
  options.kind = request.options.grid.layers.value_or(LayerKind::exact);
  if (options.kind == LayerKind::report004 && options.clearance > 0.0) {
    throw UsageError("@clearance: the layers of report 004 know none; exact ones do");
  }
  return options;
}

class LatticeSolve {
 public:
  explicit LatticeSolve(const SolveRequest& request)
      : request_(request),
        problem_(problem_of(request.scene, request.question)),
        layer_options_(layer_options(request, problem_)),
        frame_{request.scene.map
                   ? Se2{request.scene.map->origin.x, request.scene.map->origin.y, request.scene.map->yaw_rad}
                   : Se2{}} {
    search_.diagonal = request.options.grid.diagonal.value_or(Diagonal::sqrt2);
    search_.face_motion = request.options.grid.face_motion;
    search_.step_cost = request.options.grid.step_cost.value_or(1.0);
    search_.turn_cost = request.options.grid.turn_cost.value_or(1.0);
    answer_.problem = problem_.general();
    if (!turns()) {
      answer_.problem.start.resize(2);
      answer_.problem.goal.resize(2);
    }
    answer_.planner = name_of(PlannerKind::grid);
    answer_.search = name_of(GridMethod::astar);
    const auto add = [&](const char* name, auto value) { answer_.options.push_back({name, Figure(std::move(value))}); };
    add("cell", layer_options_.grid.cell);
    if (turns()) add("angles", std::uint64_t{layer_options_.grid.angles});
    add("diagonal", std::string(name_of(search_.diagonal)));
    if (search_.face_motion) add("face_motion", true);
    if (search_.step_cost != 1.0) add("step_cost", search_.step_cost);
    if (search_.turn_cost != 1.0) add("turn_cost", search_.turn_cost);
    if (is_report()) add("layers", std::string("report004"));
  }

  void run() {
    {
      const StageTimer timer(request_.execution, "index", answer_.seconds.index);
      layers_ = layers();
    }
    answer_.figures.push_back({"states", std::uint64_t{layers_.states()}});
    answer_.figures.push_back({"free_states", std::uint64_t{layers_.free_states()}});
    if (turns()) {
      std::vector<std::uint64_t> free;
      for (std::uint32_t k = 0; k < layers_.angles; ++k) free.push_back(layers_.free_at(k));
      answer_.figures.push_back({"free_at_headings", std::move(free)});
      const std::set<std::uint32_t> distinct(layers_.standing.begin(), layers_.standing.end());
      answer_.figures.push_back({"distinct_layers", std::uint64_t{distinct.size()}});
    }
    search();
    if (answer_.outcome == Outcome::solved) verify();
    if (request_.keep != nullptr) keep_headings(*request_.keep);
  }
  Answer& answer() { return answer_; }

  /// Where a tolerance or region lets the path end, of what the lattice joins to the start: the nearest to the goals;
  /// in a region the cheapest alone.
  std::vector<GoalPlace> places() {
    if (is_report()) {
      throw UsageError("@layers: report 004's promise nothing; where the goal is a choice they must be exact");
    }
    layers_ = layers();
    const GoalRule rule = rule_of(request_.scene, request_.question);
    GoalPlaces places(goals_of(request_.scene, request_.question), rule, turns() ? 0.5 * heading_step(layers_) : 0.0);
    const auto in_world = [&](const LayerState& s) { return frame_.in_world(pose_of(layers_, s)); };
    const std::vector<LayerEnd> starts = ends_at("@start", problem_.start, false);
    if (rule.region) {
      const std::vector<LayerEnd> ends = ends_in_region(places, *rule.region);
      const LayerPath path = layer_search(layers_, starts, ends, search_, request_.execution);
      if (path.status == SearchStatus::found) places.offer(in_world(path.states.back()));
    } else {
      for_each_reached(layers_, starts, search_, request_.execution,
                       [&](const LayerState& s) { places.offer(in_world(s)); });
    }
    std::vector<GoalPlace> taken = places.taken();
    if (!turns()) std::ranges::for_each(taken, [](GoalPlace& place) { place.state.resize(2); });
    return taken;
  }

 private:
  bool turns() const { return problem_.robot.kind == RobotKind::polygon; }
  /// Its discs say what is blocked, and promise nothing.
  bool is_report() const { return layer_options_.kind == LayerKind::report004; }
  std::vector<LayerEnd> ends_in_region(const GoalPlaces& places, double radius) const {
    std::vector<LayerEnd> ends;
    for (const std::vector<double>& goal : goals_of(request_.scene, request_.question)) {
      const Vec2 at = frame_.in_lattice({goal[0], goal[1], 0.0}).position() - layers_.origin;
      const auto from = [&](double x) { return std::max(0.0, std::ceil((x - radius) / layers_.cell)); };
      const auto to = [&](double x, std::uint32_t end) {
        return std::min(end - 1.0, std::floor((x + radius) / layers_.cell));
      };
      for (double j = from(at.y); j <= to(at.y, layers_.height); ++j) {
        request_.execution.check();
        for (double i = from(at.x); i <= to(at.x, layers_.width); ++i) {
          for (std::uint32_t k = 0; k < layers_.angles; ++k) {
            const LayerState s{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), k};
            if (!layers_.is_free(s.i, s.j, k) || !places.place(frame_.in_world(pose_of(layers_, s)))) continue;
            push_asked(ends, LayerEnd{s}, request_.execution);
          }
        }
      }
    }
    return ends;
  }

  HeadingLayers layers() const {
    if (!request_.scene.map) {
      return orientation_layers(request_.scene, problem_.robot, layer_options_, request_.execution);
    }
    return map_layers(*request_.scene.map, problem_.robot.outline, layer_options_.grid.angles, problem_.clearance,
                      request_.execution);
  }

  /// The free states so near to the end to which its motion is certified, with what it costs; none if the end is not
  /// free.
  template <class World>
  std::vector<LayerEnd> joined_within(const World& world, const LatticeEnd& end, std::int64_t reach) const {
    const std::int64_t left = first_around((end.pose.x - layers_.origin.x) / layers_.cell, reach);
    const std::int64_t low = first_around((end.pose.y - layers_.origin.y) / layers_.cell, reach);
    const std::int64_t right = std::min<std::int64_t>(left + 2 * reach, layers_.width);
    const std::int64_t high = std::min<std::int64_t>(low + 2 * reach, layers_.height);
    const std::vector<std::uint32_t> headings = headings_around(layers_, end);
    std::vector<LayerEnd> ends;
    for (std::int64_t j = std::max<std::int64_t>(low, 0); j < high; ++j) {
      for (std::int64_t i = std::max<std::int64_t>(left, 0); i < right; ++i) {
        request_.execution.check();
        for (const std::uint32_t k : headings) {
          const LayerState state{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), k};
          if (!layers_.is_free(state.i, state.j, k)) continue;
          const Se2 to = pose_of(layers_, state);
          const Se2 from{end.pose.x, end.pose.y, end.any_heading ? to.theta : end.pose.theta};
          if (!is_free_motion(world, from, to)) continue;
          const double turn = layers_.angles > 1 ? std::abs(turn_between(from.theta, to.theta)) : 0.0;
          ends.push_back({state, search_.step_cost * distance(from.position(), to.position()) / layers_.cell +
                                     search_.turn_cost * turn / heading_step(layers_)});
        }
      }
    }
    return ends;
  }
  /// In the robot's world around the end, of a map as far as the body may reach from there. Throws what the worlds
  /// throw.
  std::vector<LayerEnd> joined(const LatticeEnd& end) const {
    const auto in = [&](const auto& world) {
      constexpr std::int64_t usual_join = 2;
      std::vector<LayerEnd> ends = joined_within(world, end, usual_join);
      return ends.empty() ? joined_within(world, end, widest_join) : ends;
    };
    const Scene& scene = request_.scene;
    const double radius = problem_.robot.radius + problem_.clearance;
    if (turns()) return in(turning_world(scene, problem_, end.pose, request_.execution));
    if (scene.polygons.empty()) return in(MazeWorld(scene, radius, request_.execution));
    return in(PolygonWorld(scene, radius, request_.execution));
  }

  /// The states of the lattice by which a path may begin or end.
  std::vector<LayerEnd> ends_at(std::string_view option, const Se2& pose, bool any_heading) const {
    const LatticeEnd end{frame_.in_lattice(pose), any_heading};
    std::vector<LayerEnd> states = states_at(layers_, end);
    if (states.empty() && is_report()) {
      throw UsageError(
          fmt::format("{}: {}, {}, {} is no state of the grid, and report 004's layers join no others: {} "
                      "+ {} i, {} + {} j, {} headings",
                      option, pose.x, pose.y, pose.theta, layers_.origin.x, layers_.cell, layers_.origin.y,
                      layers_.cell, layers_.angles));
    }
    const bool any_free = std::ranges::any_of(
        states, [&](const LayerEnd& e) { return layers_.is_free(e.state.i, e.state.j, e.state.k); });
    return any_free || is_report() ? states : joined(end);
  }

  /// Does the body fit at its ends, in some heading where any will do, as the verification sees it?
  Outcome settled_ends() const {
    const Scene& scene = request_.scene;
    if (turns()) return PoseJudge{scene, problem_, request_.execution}.settled(Outcome::start_blocked);
    const WallProblem round{problem_.robot, problem_.start.position(), problem_.goal_pose().position(),
                            problem_.clearance};
    return PointJudge{scene, round, request_.execution}.settled(Outcome::start_blocked);
  }

  void search() {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search, layers_.states());
    if (!is_report()) answer_.outcome = settled_ends();
    if (is_blocked(answer_.outcome)) return;
    if (!is_report() && problem_.is_at_goal()) {
      answer_.outcome = Outcome::solved;
      return take({});  // without a move, whatever the states around it would say
    }
    const std::vector<LayerEnd> starts = ends_at("@start", problem_.start, false);
    const std::vector<LayerEnd> goals = ends_at("@goal", problem_.goal_pose(), problem_.any_heading());
    const LayerPath path = layer_search(layers_, starts, goals, search_, request_.execution);
    answer_.counters.expanded = path.expanded;
    const Outcome found = !path.start_free                     ? Outcome::start_blocked
                          : !path.goal_free                    ? Outcome::goal_blocked
                          : path.status == SearchStatus::found ? Outcome::solved
                                                               : Outcome::not_connected;
    answer_.outcome = is_blocked(found) && !is_report() ? Outcome::not_connected : found;
    if (answer_.outcome == Outcome::solved) take(path);
  }

  void take(const LayerPath& path) {
    answer_.cost = path.cost;
    const auto figure = [&](const char* name, std::uint64_t n) { answer_.path_figures.push_back({name, n}); };
    figure("cells", path.steps + 1);
    figure("moves", path.steps);
    figure("diagonal_moves", path.diagonals);
    figure("turn_steps", path.turns);
    // It begins and ends where it was asked to, on the lattice or off it.
    const auto posed = [&](const LayerState& s) { return frame_.in_world(pose_of(layers_, s)); };
    Se2 goal = problem_.goal_pose();
    if (problem_.any_heading())
      goal.theta = path.states.empty() ? problem_.start.theta : posed(path.states.back()).theta;
    poses_.push_back(problem_.start);
    for (const LayerState& s : path.states) {
      const Se2 next = posed(s);
      const bool is_end = (s == path.states.front() && is_there(problem_.start, next, !turns())) ||
                          (s == path.states.back() && is_there(goal, next, !turns()));
      if (!is_end) poses_.push_back(next);
    }
    if (poses_.size() > 1 || !is_there(goal, problem_.start, !turns())) poses_.push_back(goal);
    answer_.states.width = 3;
    for (const Se2& pose : poses_) {
      answer_.path.push_back(pose.position());
      if (turns()) answer_.states.add(std::array{pose.x, pose.y, pose.theta});
    }
  }

  bool is_there(const Se2& end, const Se2& state, bool any_heading) const {
    constexpr double rounding = 1e-9;  // of a cell, and of a radian
    return distance(end.position(), state.position()) <= rounding * layers_.cell &&
           (any_heading || std::abs(turn_between(end.theta, state.theta)) <= rounding);
  }

  /// Of a point or disc wherever the path begins and ends.
  void verify() {
    const Execution& execution = request_.execution;
    const StageTimer timer(execution, "verify", answer_.seconds.verify, answer_.path.size());
    const VerifyOptions round{.radius = problem_.robot.radius, .clearance = problem_.clearance};
    const PoseVerifyOptions anywhere{.clearance = problem_.clearance};
    const Verification found = turns() ? verify_se2(request_.scene, problem_.robot.outline, poses_,
                                                    is_report() ? anywhere : verify_options(problem_), execution)
                                       : verify_path(request_.scene, answer_.path, round, execution);
    if (!found.verified && is_report()) return refute(answer_, found);
    take_verdict(answer_, found);
    if (turns()) answer_.turn_rad = found.turn_rad;
  }

  /// The layers nearest to some headings, which course reports show.
  void keep_headings(ByProducts& keep) const {
    if (!turns()) return;
    const Vec2 corner = layers_.origin - layers_.cell * Vec2{0.5, 0.5};
    const Se2 in_world = frame_.in_world({corner.x, corner.y, 0.0});
    std::set<std::uint32_t> nearest;
    for (const double degrees : {0.0, 45.0, 90.0}) {
      nearest.insert(static_cast<std::uint32_t>(std::lround(degrees / 360.0 * layers_.angles)) % layers_.angles);
    }
    for (const std::uint32_t k : nearest) {
      const double degrees = 360.0 * k / layers_.angles;
      const Bitmap& blocked = layers_.bitmaps[layers_.standing[k]];
      keep.headings.push_back({degrees, blocked, in_world.position(), layers_.cell, in_world.theta});
    }
  }

  const SolveRequest& request_;
  PoseProblem problem_;
  LayerOptions layer_options_;
  LayerSearchOptions search_;
  LatticeFrame frame_;
  HeadingLayers layers_;
  std::vector<Se2> poses_;
  Answer answer_;
};

}  // namespace

std::vector<GoalPlace> places_on_layers(const SolveRequest& request) { return LatticeSolve(request).places(); }

SolveKind lattice_kind() {
  return {"a body on a grid in a scene", fits_lattice, lattice_planners, usually<PlannerKind::grid>,
          [](const SolveRequest& request) { return answered(LatticeSolve(request)); }};
}

}  // namespace warren
