// SPDX-License-Identifier: BSD-3-Clause
// Joins Se2World with the planners that take it: a polygon that turns among walls, polygons and bounds; what it shares
// with cars is in solve/question/question_of_pose.hpp. `visibility` and `cells` don't turn the body
// at all (solve/kinds/at_fixed_angle.hpp).
#include <fmt/format.h>

#include <optional>

#include "core/base/error.hpp"
#include "pictures/draw_sweep.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/shorten/shortcut.hpp"
#include "solve/kinds/at_fixed_angle.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/question_of_pose.hpp"
#include "solve/question/solve_steps.hpp"
#include "solve/question/tree_choice.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {
namespace {

constexpr std::string_view body_words = "a turning body";

PoseVerifyOptions verify_options(const PoseProblem& problem) {
  return {.clearance = problem.clearance,
          .start = problem.start,
          .goal = problem.goal_pose(),
          .any_heading = problem.any_heading()};
}

double plane_length(const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }

/// A leg of about half a turn could be read either way: it gets a pose in the middle.
Path<Se2> without_half_turns(const Path<Se2>& path) {
  constexpr double most_rad = 3.0;
  Path<Se2> cut;
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
      : request_(request), problem_(pose_problem(request.scene, request.problem, body_words)) {
    answer_.problem = problem_.general();
    answer_.planner = name_of(request.planner);
    if (is_roadmap_planner(request.planner)) {
      roadmap_options_ = pose_roadmap_options(request, answer_);
    } else if (keeps_angle()) {
      describe_fixed_angle();
    } else {
      tree_options_ = pose_tree_options(request, answer_);
    }
  }

  void run() {
    index();
    bound_growth();
    take(plan());
    settle_blocked_poses(answer_, problem_, [this](const Se2& pose) { return stands_free(pose); });
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
  void bound_growth();
  Solution<Se2> plan();
  void describe_fixed_angle();
  Solution<Se2> plan_fixed_angle();
  Solution<Se2> plan_roadmap();
  void take(Solution<Se2> solution);
  bool stands_free(const Se2& pose) const;
  void finish_path();
  void optimise();
  void verify();
  void draw(Drawing& drawing) const;

  const SolveRequest& request_;
  PoseProblem problem_;
  RoadmapOptions roadmap_options_;  // of prm and lazy-prm
  PoseTreeOptions tree_options_;    // of the others
  std::optional<Se2World> world_;
  std::vector<Roadmap<Se2>> roadmaps_;  // for the picture
  std::optional<CellOptions> cells_;    // of cells
  Path<Se2> path_;
  Answer answer_;
};

void TurningSolve::index() {
  const StageTimer timer(execution(), "index", answer_.seconds.index);
  world_.emplace(scene(), problem_.robot.outline, Se2Options{.clearance = problem_.clearance}, execution());
}

Solution<Se2> TurningSolve::plan() {
  if (is_roadmap_planner(request_.planner)) return plan_roadmap();
  if (keeps_angle()) return plan_fixed_angle();
  return plan_pose_trees(*world_, request_.planner, problem_, tree_options_, execution(),
                         request_.drawing != nullptr ? &roadmaps_ : nullptr);
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

/// On a map where it is proved that the body never gets from one pose to the other, one round of a roadmap or a few
/// nodes of a tree are enough.
void TurningSolve::bound_growth() {
  const bool is_roadmap = is_roadmap_planner(request_.planner);
  const bool grows = is_roadmap ? !roadmap_options_.samples : !request_.arguments.has("--nodes");
  if (!scene().map || !grows || keeps_angle()) return;
  const StageTimer timer(execution(), "proof", answer_.seconds.search);
  for (const Se2& goal : poses_of(problem_.goal)) {
    if (!provably_apart(*scene().map, problem_.robot.outline, problem_.start, goal, execution())) return;
  }
  if (is_roadmap) {
    roadmap_options_.samples = first_samples(*world_, roadmap_options_, execution());
  } else {
    tree_options_.trees.nodes = nodes_where_apart;
  }
}

Solution<Se2> TurningSolve::plan_roadmap() {
  const Se2 goal = roomiest(*world_, poses_of(problem_.goal));
  const auto planner = request_.planner == PlannerKind::prm ? prm<Se2World> : lazy_prm<Se2World>;
  Roadmap<Se2>* keep = request_.drawing != nullptr ? &roadmaps_.emplace_back() : nullptr;
  return planner(*world_, problem_.start, goal, roadmap_options_, execution(), keep);
}

void TurningSolve::take(Solution<Se2> solution) {
  path_ = std::move(solution.path);
  take_pose_solution(answer_, solution);
}

bool TurningSolve::stands_free(const Se2& pose) const {
  const PoseVerifyOptions options{.clearance = problem_.clearance};
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
  const Verification verification =
      verify_se2(scene(), problem_.robot.outline, path_, verify_options(problem_), execution());
  if (!verification.verified) fail_verification(answer_, verification.first_violation);
  answer_.verified = true;
  answer_.length = verification.length;
  answer_.turn_rad = verification.turn_rad;
  answer_.min_clearance = verification.min_clearance;
  record_poses(answer_, path_);
}

void TurningSolve::draw(Drawing& drawing) const {
  drawing.roadmap = in_the_plane(roadmaps_, execution());
  if (!path_.empty()) drawing.layers.push_back(sweep_of(path_, problem_.robot.outline));
}

constexpr PlannerChoice turning_planners[] = {{PlannerKind::rrt_connect, rrt_connect_options},
                                              {PlannerKind::rrt, rrt_options},
                                              {PlannerKind::prm, pose_roadmap_option_names},
                                              {PlannerKind::lazy_prm, pose_lazy_option_names}};
constexpr PlannerChoice fixed_angle_planners[] = {{PlannerKind::visibility, ""},
                                                  {PlannerKind::cells, "--doors --search --queue"}};

bool fits_turning(const Scene&, const RobotSpec& robot) { return robot.kind == RobotKind::polygon; }

bool fits_fixed_angle(const Scene& scene, const RobotSpec& robot) {
  return robot.kind == RobotKind::polygon && !scene.map;
}

PlannerKind usual_fixed_angle_planner(const Arguments&, const Scene&, const ProblemOptions&) {
  return PlannerKind::visibility;
}

PlannerKind usual_turning_planner(const Arguments&, const Scene&, const ProblemOptions&) {
  return PlannerKind::rrt_connect;
}

Answer solve_turning(const SolveRequest& request) {
  TurningSolve turning(request);
  answer_within_limits(turning.answer(), [&] { turning.run(); });
  return std::move(turning.answer());
}

Verdict recheck_turning(const Scene& scene, const ProblemOptions& options, const RecordedAnswer& answer,
                        const Execution& execution) {
  const PoseProblem problem = pose_problem(scene, options, body_words);
  const std::vector<Se2> path = recorded_poses(answer, body_words);
  const Verification found = verify_se2(scene, problem.robot.outline, path, verify_options(problem), execution);
  return {found, problem.general()};
}

}  // namespace

SolveKind turning_kind() {
  return {"a polygon that turns", fits_turning,  turning_planners, tree_option_specs(),
          usual_turning_planner,  solve_turning, nullptr,          recheck_turning};
}

SolveKind fixed_angle_kind() {
  return {"a polygon at a fixed angle",
          fits_fixed_angle,
          fixed_angle_planners,
          {},
          usual_fixed_angle_planner,
          solve_turning,
          nullptr,
          nullptr};
}

}  // namespace warren
