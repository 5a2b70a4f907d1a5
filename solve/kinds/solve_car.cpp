// SPDX-License-Identifier: BSD-3-Clause
// Joins CarWorld with the planners that take it: a car, with Dubins or Reeds-Shepp curves, among walls, polygons and
// bounds, or among the cells of a map. Dubins curves have a direction: their roadmaps are
// planners/roadmap/one_way_prm.hpp's. The answer's path has a pose wherever the steering or the gear changes, and one a
// quarter turn, so each leg is a straight or an arc that its two poses tell wholly.
#include <optional>

#include "core/base/error.hpp"
#include "pictures/curve_drawing.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/one_way_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/shorten/shortcut.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/question_of_pose.hpp"
#include "solve/question/solve_steps.hpp"
#include "solve/question/tree_choice.hpp"
#include "solve/question/write_answer_io.hpp"
#include "tools/words/option_values.hpp"
#include "verify/judges/verify_car.hpp"
#include "worlds/poses/car_world.hpp"

namespace warren {
namespace {

constexpr std::string_view body_words = "a car";
constexpr std::array<std::string_view, 2> steering_words{"dubins", "reeds-shepp"};

/// The file's car, and what the options say otherwise.
PoseProblem car_problem(const Scene& scene, const ProblemOptions& options, const Arguments& arguments) {
  PoseProblem problem = pose_problem(scene, options, body_words);
  if (const auto text = arguments.value("--turning-radius")) {
    problem.robot.turning_radius = positive_value("--turning-radius", *text);
  }
  if (const auto text = arguments.value("--steering")) {
    problem.robot.steering = static_cast<SteeringKind>(choice_value("--steering", *text, steering_words));
  }
  return problem;
}

VerifiedCar verified_car(const RobotSpec& robot) {
  return {.turning_radius = robot.turning_radius,
          .reverses = robot.steering == SteeringKind::reeds_shepp,
          .radius = robot.radius,
          .outline = robot.outline};
}

PoseVerifyOptions verify_options(const PoseProblem& problem) {
  return {.clearance = problem.clearance,
          .start = problem.start,
          .goal = problem.goal_pose(),
          .any_heading = problem.any_heading()};
}

/// One solve: the steps share the question and fill in the answer.
template <class Curve>
class CarSolve {
 public:
  CarSolve(const SolveRequest& request, const PoseProblem& problem) : request_(request), problem_(problem) {
    answer_.problem = problem_.general();
    answer_.planner = name_of(request.planner);
    if (is_roadmap_planner(request.planner)) {
      roadmap_options_ = pose_roadmap_options(request, answer_);
    } else {
      tree_options_ = pose_tree_options(request, answer_);
    }
    if (request.arguments.has("--steering")) {
      answer_.options.emplace_back("steering", json_string(name_of(problem_.robot.steering)));
    }
    if (request.arguments.has("--turning-radius")) {
      answer_.options.emplace_back("turning_radius", json_number(problem_.robot.turning_radius));
    }
  }

  void run() {
    index();
    take(plan());
    settle_blocked_poses(answer_, problem_, [this](const Se2& pose) { return stands_free(pose); });
    if (answer_.outcome == Outcome::solved) finish_path();
    if (request_.drawing != nullptr) draw(*request_.drawing);
  }
  Answer& answer() { return answer_; }

 private:
  using World = CarWorld<Curve>;

  const Scene& scene() const { return request_.scene; }
  const Execution& execution() const { return request_.execution; }
  std::vector<Roadmap<Se2>>* kept() { return request_.drawing != nullptr ? &roadmaps_ : nullptr; }
  void index();
  Solution<Se2> plan();
  Solution<Se2> plan_roadmap();
  void take(Solution<Se2> solution);
  bool stands_free(const Se2& pose) const;
  double length(const Se2& a, const Se2& b) const { return world_->distance(a, b); }
  void finish_path();
  void optimise();
  void verify();
  void draw(Drawing& drawing) const;

  const SolveRequest& request_;
  PoseProblem problem_;
  RoadmapOptions roadmap_options_;  // of prm and lazy-prm
  PoseTreeOptions tree_options_;    // of the others
  std::optional<World> world_;
  std::vector<Roadmap<Se2>> roadmaps_;  // for the picture
  Path<Se2> path_;                      // a curve leads from each to the next
  std::vector<Se2> poses_;              // with the joints of the curves
  Answer answer_;
};

template <class Curve>
void CarSolve<Curve>::index() {
  const StageTimer timer(execution(), "index", answer_.seconds.index);
  const RobotSpec& robot = problem_.robot;
  world_.emplace(scene(),
                 CarOptions{.turning_radius = robot.turning_radius,
                            .radius = robot.radius,
                            .outline = robot.outline,
                            .clearance = problem_.clearance},
                 execution());
}

template <class Curve>
Solution<Se2> CarSolve<Curve>::plan() {
  if (is_roadmap_planner(request_.planner)) return plan_roadmap();
  return plan_pose_trees(*world_, request_.planner, problem_, tree_options_, execution(), kept());
}

template <class Curve>
Solution<Se2> CarSolve<Curve>::plan_roadmap() {
  const Se2 goal = roomiest(*world_, poses_of(problem_.goal));
  const bool lazy = request_.planner == PlannerKind::lazy_prm;
  Roadmap<Se2>* keep = request_.drawing != nullptr ? &roadmaps_.emplace_back() : nullptr;
  if constexpr (World::one_way) {
    return one_way_prm(*world_, problem_.start, goal, roadmap_options_, lazy, execution(), keep);
  } else {
    const auto planner = lazy ? lazy_prm<World> : prm<World>;
    return planner(*world_, problem_.start, goal, roadmap_options_, execution(), keep);
  }
}

template <class Curve>
void CarSolve<Curve>::take(Solution<Se2> solution) {
  path_ = std::move(solution.path);
  take_pose_solution(answer_, solution);
}

template <class Curve>
bool CarSolve<Curve>::stands_free(const Se2& pose) const {
  const PoseVerifyOptions options{.clearance = problem_.clearance};
  return verify_car(scene(), verified_car(problem_.robot), std::span(&pose, 1), options, execution()).verified;
}

template <class Curve>
void CarSolve<Curve>::finish_path() {
  if (request_.arguments.has("--optimise")) optimise();
  poses_ = {path_.front()};
  for (std::size_t i = 1; i < path_.size(); ++i) append_joints(poses_, world_->curve(path_[i - 1], path_[i]));
  verify();
}

template <class Curve>
void CarSolve<Curve>::optimise() {
  const StageTimer timer(execution(), "optimise", answer_.seconds.optimise, path_.size());
  const auto curve_length = [this](const Se2& a, const Se2& b) { return length(a, b); };
  answer_.raw_length = path_length(path_, curve_length);
  const ShortcutOptions options{.seed = answer_.seed};
  path_ = shortcut_path(*world_, path_, curve_length, options, execution(), answer_.counters);
}

template <class Curve>
void CarSolve<Curve>::verify() {
  const StageTimer timer(execution(), "verify", answer_.seconds.verify, poses_.size());
  const Verification verification =
      verify_car(scene(), verified_car(problem_.robot), poses_, verify_options(problem_), execution());
  if (!verification.verified) fail_verification(answer_, verification.first_violation);
  answer_.verified = true;
  answer_.length = verification.length;
  answer_.turn_rad = verification.turn_rad;
  answer_.min_clearance = verification.min_clearance;
  answer_.path_figures.emplace_back("steering", json_string(name_of(problem_.robot.steering)));
  answer_.path_figures.emplace_back("cusps", std::to_string(verification.cusps));
  answer_.path_figures.emplace_back("reversed_length", json_number(verification.reversed));
  record_poses(answer_, poses_);
}

template <class Curve>
void CarSolve<Curve>::draw(Drawing& drawing) const {
  const auto curve = [this](const Se2& a, const Se2& b) { return world_->curve(a, b); };
  draw_curves(drawing, roadmaps_, World::one_way, curve, execution());
  drawing.layers.push_back(car_sweep(poses_, problem_.robot));
}

std::span<const OptionSpec> car_option_specs() {
  static const std::vector<OptionSpec> specs = [] {
    std::vector<OptionSpec> all(tree_option_specs().begin(), tree_option_specs().end());
    all.push_back({"--steering", "WORD",
                   "a car's curves: forwards only, or backwards too (default: the file's, else dubins)",
                   "dubins reeds-shepp"});
    all.push_back({"--turning-radius", "RHO", "a car's, > 0 (default: the file's)"});
    return all;
  }();
  return specs;
}

constexpr PlannerChoice car_planners[] = {
    {PlannerKind::rrt_connect, "--sampler --step --nodes --trees --via --optimise --steering --turning-radius"},
    {PlannerKind::rrt, "--sampler --step --goal-bias --nodes --trees --via --optimise --steering --turning-radius"},
    {PlannerKind::prm,
     "--sampler --samples --neighbours --radius --search --queue --optimise --steering --turning-radius"},
    {PlannerKind::lazy_prm,
     "--sampler --samples --neighbours --radius --search --queue --lazy --optimise --steering --turning-radius"}};

bool fits_car(const Scene&, const RobotSpec& robot) { return robot.kind == RobotKind::car; }

PlannerKind usual_car_planner(const Arguments&, const Scene&, const ProblemOptions&) {
  return PlannerKind::rrt_connect;
}

template <class Curve>
Answer solve_with(const SolveRequest& request, const PoseProblem& problem) {
  CarSolve<Curve> car(request, problem);
  answer_within_limits(car.answer(), [&] { car.run(); });
  return std::move(car.answer());
}

Answer solve_car(const SolveRequest& request) {
  const PoseProblem problem = car_problem(request.scene, request.problem, request.arguments);
  return problem.robot.steering == SteeringKind::dubins ? solve_with<DubinsCurve>(request, problem)
                                                        : solve_with<ReedsSheppCurve>(request, problem);
}

Verdict recheck_car(const Scene& scene, const ProblemOptions& options, const RecordedAnswer& answer,
                    const Execution& execution) {
  const PoseProblem problem = pose_problem(scene, options, body_words);
  const std::vector<Se2> path = recorded_poses(answer, body_words);
  const Verification found = verify_car(scene, verified_car(problem.robot), path, verify_options(problem), execution);
  return {found, problem.general()};
}

}  // namespace

SolveKind car_kind() {
  return {body_words, fits_car, car_planners, car_option_specs(), usual_car_planner, solve_car, nullptr, recheck_car};
}

}  // namespace warren
