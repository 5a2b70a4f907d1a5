// SPDX-License-Identifier: BSD-3-Clause
// Joins Se2World with the planners that take it: a polygon that turns among walls, polygons and bounds. A goal X,Y
// without a heading is met in any: trees have it as 16 goals, evenly turned; roadmaps take the one of these that has
// the most room. `visibility` and `cells` don't turn the body at all (tools/fixed_angle.hpp).
#include <fmt/format.h>

#include <array>
#include <optional>
#include <stdexcept>

#include "core/error.hpp"
#include "planners/guided.hpp"
#include "planners/lazy_prm.hpp"
#include "planners/prm.hpp"
#include "planners/rrt.hpp"
#include "planners/rrt_connect.hpp"
#include "planners/shortcut.hpp"
#include "tools/fixed_angle.hpp"
#include "tools/plane_planners.hpp"
#include "tools/solve_kind.hpp"
#include "tools/sweep_drawing.hpp"
#include "tools/tree_options.hpp"
#include "tools/verified_answer.hpp"
#include "worlds/plane_obstacles.hpp"
#include "worlds/se2_world.hpp"
#include "worlds/verify_se2.hpp"

namespace warren {
namespace {

struct TurningProblem {
  RobotSpec robot;
  Se2 start;
  std::vector<double> goal;  // 2 or 3 numbers
  double clearance = 0.0;

  bool any_heading() const { return goal.size() == 2; }
  Se2VerifyOptions verify_options() const {
    return {.clearance = clearance,
            .start = start,
            .goal = Se2{goal[0], goal[1], any_heading() ? 0.0 : goal[2]},
            .any_heading = any_heading()};
  }
  Problem general() const { return {robot, {start.x, start.y, start.theta}, goal, clearance, Contact::blocked}; }
};

std::vector<double> state_of(std::string_view option, const std::vector<double>& given,
                             const std::vector<double>& in_file, std::size_t fewest) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y,THETA", option));
  if (state.size() >= fewest && state.size() <= 3) return state;
  throw UsageError(fmt::format("{}: a turning body takes X,Y,THETA{} (found: {} numbers)", option,
                               fewest == 2 ? ", or X,Y for any heading" : "", state.size()));
}

TurningProblem turning_problem(const Scene& scene, const ProblemOptions& options) {
  if (options.contact == Contact::allowed) {
    throw UsageError(
        "--contact: the planners of turning bodies keep off the obstacles, so 'allowed' would change nothing");
  }
  TurningProblem problem;
  problem.robot = robot_of(scene, options);
  const std::vector<double> start = state_of("--start", options.start, scene.start, 3);
  problem.start = {start[0], start[1], start[2]};
  problem.goal = state_of("--goal", options.goal, scene.goal, 2);
  problem.clearance = clearance_of(scene, options);
  return problem;
}

/// The poses that will do for a state of 2 or 3 numbers.
std::vector<Se2> poses_of(const std::vector<double>& state) {
  constexpr int headings = 16;
  if (state.size() == 3) return {{state[0], state[1], state[2]}};
  std::vector<Se2> poses;
  for (int i = 0; i < headings; ++i) {
    poses.push_back({state[0], state[1], wrapped_angle(2.0 * std::numbers::pi * i / headings)});
  }
  return poses;
}

double plane_length(const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }

/// A leg of about half a turn could be read either way: it gets a pose in the middle.
std::vector<Se2> without_half_turns(const std::vector<Se2>& path) {
  constexpr double most_rad = 3.0;
  std::vector<Se2> cut;
  for (const Se2& pose : path) {
    if (!cut.empty() && std::abs(turn_between(cut.back().theta, pose.theta)) > most_rad) {
      cut.push_back(interpolate(Se2(cut.back()), pose, 0.5));
    }
    cut.push_back(pose);
  }
  return cut;
}

/// One solve: the steps share the question and fill in the answer.
class TurningSolve {
 public:
  explicit TurningSolve(const SolveRequest& request)
      : request_(request), problem_(turning_problem(request.scene, request.problem)) {
    answer_.problem = problem_.general();
    answer_.planner = name_of(request.planner);
    if (is_roadmap_planner(request.planner)) {
      describe_roadmap();
    } else if (keeps_angle()) {
      describe_fixed_angle();
    } else {
      describe_trees();
    }
  }

  void run() {
    index();
    take(plan());
    settle_blocked_ends();
    if (answer_.outcome == Outcome::solved) finish_path();
    if (request_.drawing != nullptr) draw(*request_.drawing);
  }
  Answer& answer() { return answer_; }

 private:
  const Scene& scene() const { return request_.scene; }
  const Execution& execution() const { return request_.execution; }
  bool keeps_angle() const {
    return request_.planner == PlannerKind::visibility || request_.planner == PlannerKind::cells;
  }
  void index();
  Solution<Se2> plan();
  void describe_roadmap();
  void describe_trees();
  void describe_fixed_angle();
  Solution<Se2> plan_fixed_angle();
  Solution<Se2> plan_roadmap();
  Solution<Se2> plan_trees();
  std::vector<std::vector<Se2>> stops() const;
  Se2 roomiest_goal() const;
  void take(Solution<Se2> solution);
  void settle_blocked_ends();
  bool stands_free(const Se2& pose) const;
  void finish_path();
  void optimise();
  void verify();
  void draw(Drawing& drawing) const;

  const SolveRequest& request_;
  TurningProblem problem_;
  RoadmapOptions roadmap_options_;  // of prm and lazy-prm
  RrtOptions tree_options_;         // of the others
  std::vector<std::vector<double>> via_;
  std::optional<Se2World> world_;
  std::vector<Roadmap<Se2>> roadmaps_;  // for the picture
  std::optional<CellOptions> cells_;    // of cells
  std::vector<Se2> path_;
  Answer answer_;
};

void TurningSolve::index() {
  const StageTimer timer(execution(), "index", answer_.seconds.index);
  check_polygons(scene(), execution());
  world_.emplace(scene(), problem_.robot.outline, Se2Options{.clearance = problem_.clearance});
}

Solution<Se2> TurningSolve::plan() {
  if (is_roadmap_planner(request_.planner)) return plan_roadmap();
  return keeps_angle() ? plan_fixed_angle() : plan_trees();
}

void TurningSolve::describe_roadmap() {
  const PlannerOptions options = planner_options(request_.arguments, scene(), WallProblem{});
  roadmap_options_ = options.roadmap;
  if (sampler_asked(request_.arguments) == SamplerKind::lattice) {
    throw UsageError("--sampler: lattice is for points and discs in mazes; a turning body takes the others");
  }
  if (roadmap_options_.sampler == SamplerKind::lattice) roadmap_options_.sampler = SamplerKind::uniform;
  answer_.sampler = name_of(roadmap_options_.sampler);
  answer_.search = name_of(roadmap_options_.search);
  answer_.seed = roadmap_options_.seed;
  answer_.options = options.given;
}

void TurningSolve::describe_trees() {
  tree_options_ = tree_options(request_.arguments);
  via_ = way_points(request_.arguments);
  for (const auto& point : via_) {
    if (point.size() > 3) throw UsageError("--via: a turning body takes X,Y or X,Y,THETA");
  }
  answer_.sampler = name_of(tree_options_.sampler);
  answer_.seed = tree_options_.seed;
  answer_.options = given_tree_options(request_.arguments);
}

void TurningSolve::describe_fixed_angle() {
  constexpr double same_rad = 1e-9;
  if (!problem_.any_heading() && std::abs(turn_between(problem_.start.theta, problem_.goal[2])) > same_rad) {
    throw UsageError(
        fmt::format("--planner: {} does not turn the body; start and goal have different angles", answer_.planner));
  }
  const SearchChoice search = search_choice(request_.arguments);
  answer_.search = name_of(search.search);
  if (request_.planner != PlannerKind::cells) return;
  cells_ = cell_options(request_.arguments, search);
  answer_.options.push_back(doors_option(*cells_));
}

Solution<Se2> TurningSolve::plan_fixed_angle() {
  const FixedAngleProblem problem{
      problem_.robot.outline, problem_.start, {problem_.goal[0], problem_.goal[1]}, problem_.clearance, cells_};
  Solution<Se2> solution = plan_at_fixed_angle(scene(), problem, execution(), request_.drawing);
  if (cells_) answer_.cells = CellCount{solution.roadmap.milestones, solution.roadmap.edges};
  return solution;
}

Solution<Se2> TurningSolve::plan_roadmap() {
  const Se2 goal = problem_.any_heading() ? roomiest_goal() : poses_of(problem_.goal).front();
  const auto planner = request_.planner == PlannerKind::prm ? prm<Se2World> : lazy_prm<Se2World>;
  Roadmap<Se2>* keep = request_.drawing != nullptr ? &roadmaps_.emplace_back() : nullptr;
  return planner(*world_, problem_.start, goal, roadmap_options_, execution(), keep);
}

Se2 TurningSolve::roomiest_goal() const {
  auto query = world_->make_query();
  const std::vector<Se2> poses = poses_of(problem_.goal);
  std::vector<double> room;
  for (const Se2& pose : poses) room.push_back(world_->clearance(pose, largest_coordinate, query));
  return poses[static_cast<std::size_t>(std::max_element(room.begin(), room.end()) - room.begin())];
}

/// Way-points and goal as the poses that will do.
std::vector<std::vector<Se2>> TurningSolve::stops() const {
  std::vector<std::vector<Se2>> stops;
  for (const auto& point : via_) {
    stops.push_back(detail::free_states(*world_, std::span<const Se2>(poses_of(point))));
    if (stops.back().empty()) {
      throw UsageError(fmt::format("--via: the body does not fit at way-point {}", stops.size()));
    }
  }
  stops.push_back(poses_of(problem_.goal));
  return stops;
}

Solution<Se2> TurningSolve::plan_trees() {
  const auto planner = request_.planner == PlannerKind::rrt ? rrt<Se2World> : rrt_connect<Se2World>;
  const auto plan = [&](const Se2& start, std::span<const Se2> goals, std::size_t) {
    Roadmap<Se2>* keep = request_.drawing != nullptr ? &roadmaps_.emplace_back() : nullptr;
    return planner(*world_, start, goals, tree_options_, execution(), keep);
  };
  return plan_through<Se2>(problem_.start, stops(), plan);
}

void TurningSolve::take(Solution<Se2> solution) {
  path_ = std::move(solution.path);
  Solution<Vec2> plane{.outcome = solution.outcome,
                       .stop_reason = solution.stop_reason,
                       .path = {},
                       .roadmap = solution.roadmap,
                       .separation = solution.separation,
                       .counters = solution.counters,
                       .seconds = solution.seconds};
  take_solution(answer_, std::move(plane));
}

/// Planning keeps a little more room than it must, so a body that fits exactly is no blocked one: nobody proved that.
void TurningSolve::settle_blocked_ends() {
  bool doubtful = answer_.outcome == Outcome::start_blocked && stands_free(problem_.start);
  if (answer_.outcome == Outcome::goal_blocked) {
    for (const Se2& pose : poses_of(problem_.goal)) doubtful = doubtful || stands_free(pose);
  }
  if (doubtful) answer_.outcome = Outcome::not_connected;
}

bool TurningSolve::stands_free(const Se2& pose) const {
  const Se2VerifyOptions options{.clearance = problem_.clearance};
  return verify_se2(scene(), problem_.robot.outline, std::span(&pose, 1), options, execution()).verified;
}

void TurningSolve::finish_path() {
  if (request_.arguments.has("--optimise")) optimise();
  path_ = without_half_turns(path_);
  verify();
}

void TurningSolve::optimise() {
  const StageTimer timer(execution(), "optimise", answer_.seconds.optimise, path_.size());
  answer_.raw_length = path_length(path_, plane_length);
  const ShortcutOptions options{.seed = answer_.seed};
  path_ = shortcut_path(*world_, path_, plane_length, options, execution(), answer_.counters);
}

void TurningSolve::verify() {
  const StageTimer timer(execution(), "verify", answer_.seconds.verify, path_.size());
  const Se2Verification verification =
      verify_se2(scene(), problem_.robot.outline, path_, problem_.verify_options(), execution());
  if (!verification.verified) {
    const Violation violation = verification.first_violation.value_or(Violation{});
    throw std::logic_error(fmt::format("the path of {} fails its verification at leg {}: {} is {} away",
                                       answer_.planner, violation.leg, violation.obstacle, violation.distance));
  }
  answer_.verified = true;
  answer_.length = verification.length;
  answer_.turn_rad = verification.turn_rad;
  answer_.min_clearance = verification.min_clearance;
  answer_.states.width = 3;
  for (const Se2& pose : path_) {
    answer_.path.push_back(pose.position());
    answer_.states.add(std::array{pose.x, pose.y, pose.theta});
  }
}

void TurningSolve::draw(Drawing& drawing) const {
  drawing.roadmap = in_the_plane(roadmaps_);
  if (!path_.empty()) drawing.layers.push_back(sweep_of(path_, problem_.robot.outline));
}

constexpr std::string_view roadmap_options = "--sampler --samples --neighbours --radius --search --queue --optimise";
constexpr std::string_view lazy_options =
    "--sampler --samples --neighbours --radius --search --queue --lazy --optimise";
constexpr PlannerChoice planners[] = {{PlannerKind::rrt_connect, rrt_connect_options},
                                      {PlannerKind::rrt, rrt_options},
                                      {PlannerKind::prm, roadmap_options},
                                      {PlannerKind::lazy_prm, lazy_options},
                                      {PlannerKind::visibility, ""},
                                      {PlannerKind::cells, "--doors --search --queue"}};

bool fits_turning(const Scene& scene, const RobotSpec& robot) {
  return robot.kind == RobotKind::polygon && scene.spheres.empty();
}

PlannerKind usual_planner(const Arguments&, const Scene&, const ProblemOptions&) { return PlannerKind::rrt_connect; }

Answer solve(const SolveRequest& request) {
  TurningSolve turning(request);
  answer_within_limits(turning.answer(), [&] { turning.run(); });
  return std::move(turning.answer());
}

Verdict verify(const Scene& scene, const ProblemOptions& options, const RecordedAnswer& answer,
               const Execution& execution) {
  check_state_width(answer, 3, "a turning body");
  const TurningProblem problem = turning_problem(scene, options);
  std::vector<Se2> path;
  for (std::size_t i = 0; i < answer.states.size(); ++i) {
    const auto state = answer.states[i];
    path.push_back({state[0], state[1], state[2]});
  }
  const Se2Verification found = verify_se2(scene, problem.robot.outline, path, problem.verify_options(), execution);
  return {{found.verified, found.length, found.min_clearance, found.first_violation}, problem.general()};
}

}  // namespace

SolveKind turning_kind() {
  return {"a polygon that turns", fits_turning, planners, tree_option_specs(), usual_planner, solve, nullptr, verify};
}

}  // namespace warren
