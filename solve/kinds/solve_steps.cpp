// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/solve_steps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <type_traits>

#include "solve/kinds/plane_steps.hpp"
#include "solve/question/asked_words.hpp"
#include "verify/judges/verify_price.hpp"
#include "verify/streamed/verify_cells.hpp"

namespace warren {
namespace {

double largest_coordinate_of(const Scene& scene, const Execution& execution) {
  double largest = 0.0;
  if (const Box box = room_of(scene, execution); !box.empty()) {
    for (const double c : {box.min.x, box.min.y, box.max.x, box.max.y}) largest = std::max(largest, std::abs(c));
  }
  for (const Sphere& s : scene.spheres) {
    largest = std::max({largest, std::abs(s.x) + s.radius, std::abs(s.y) + s.radius, std::abs(s.z) + s.radius});
  }
  for (const SolidBox& box : scene.boxes) {
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
  }
  for (const Solid& solid : scene.solids) {
    double reach = solid.half.lpNorm<1>();
    for (const Vec3& corner : solid.corners) reach = std::max(reach, corner.lpNorm<1>());
    largest = std::max(largest, solid.pose.translation().lpNorm<Eigen::Infinity>() + reach);
  }
  return largest;
}

Figure option_figure(bool value) { return value; }
template <class T>
Figure option_figure(const std::optional<T>& value) {
  if constexpr (NamedEnum<T>) return std::string(name_of(*value));
  if constexpr (std::is_same_v<T, double>) return *value;
  if constexpr (std::is_integral_v<T>) return std::uint64_t{*value};
}
/// "0.5" or "0.5,0.1".
Figure option_figure(const std::optional<GrowingAttach>& attach) {
  const std::string radius = attach->radius ? fmt::format("{}", *attach->radius) : "";
  return attach->step ? fmt::format("{},{}", radius, *attach->step) : radius;
}
/// "1,2;3,4,0.5"
Figure option_figure(const std::vector<std::vector<double>>& via) {
  std::string text;
  for (const std::vector<double>& state : via)
    text += fmt::format("{}{}", text.empty() ? "" : ";", fmt::join(state, ","));
  return text;
}

/// "tree,restarts"
Figure option_figure(const std::vector<AnytimePart>& parts) {
  std::string text;
  for (const AnytimePart part : parts) text.append(text.empty() ? "" : ",").append(name_of(part));
  return text;
}

}  // namespace

std::vector<NamedFigure> given_figures(const SolveOptions& options) {
  std::vector<NamedFigure> figures;
  const auto add = [&]<class T>(Option option, OptionRange, const T& field) {
    const bool is_star = star_option(options) == option;
    if (option == Option::sampler || option == Option::search || (field == T{} && !is_star)) return;
    figures.push_back({std::string(name_of(option)), is_star ? Figure(std::string("star")) : option_figure(field)});
  };
  visit_options(add, options);
  return figures;
}

std::size_t judge_bytes(const Scene& scene) {
  constexpr std::size_t fixed = std::size_t{1} << 20U;
  constexpr std::size_t a_corner = 128;
  constexpr std::size_t a_solid = 512;
  if (scene.map) return fixed + 4 * scene.map->blocked.bytes();
  std::size_t corners = corner_count(scene);
  for (const Solid& solid : scene.solids) corners += solid.corners.size();
  return fixed + a_corner * corners + a_solid * (scene.spheres.size() + scene.boxes.size() + scene.solids.size());
}

VerifyOptions verify_options(const WallProblem& problem) {
  return {.radius = problem.robot.radius,
          .clearance = problem.clearance,
          .contact = problem.contact,
          .start = problem.start,
          .goal = problem.goal};
}

PlannerOptions describe_roadmap_planner(Answer& answer, const Scene& scene, const WallProblem& problem,
                                        const SolveOptions& asked) {
  const PlannerOptions options = planner_options(asked, scene, problem);
  answer.problem = problem.general();
  answer.planner = name_of(options.planner);
  if (options.planner == PlannerKind::prm) answer.pipeline = name_of(options.pipeline);
  answer.sampler = name_of(options.roadmap.sampler);
  answer.search = name_of(options.roadmap.search);
  answer.seed = options.roadmap.seed;
  answer.options = given_figures(asked);
  return options;
}

void take_solution(Answer& answer, Solution<Vec2> solution) {
  answer.path = std::move(solution.path);
  take_account(answer, solution);
}

VerifyOptions end_options(const WallProblem& problem) {
  return {.radius = problem.robot.radius,
          .clearance = problem.clearance + end_margin(problem.reach()),
          .contact = problem.contact};
}

Verification PointJudge::judged(std::span<const Vec2> path, const VerifyOptions& options) const {
  if (cells != nullptr) return verify_steps(*cells, path, options, execution);
  if (scene.map) return verify_on_map(*scene.map, path, options, execution);
  return verify_path(scene, path, options, execution, index);
}

bool PointJudge::stands_free(Vec2 p) const {
  if (scene.map) return stands_free_on_map(*scene.map, problem, p, execution);
  return judged(std::span(&p, 1), end_options(problem)).verified;
}

bool PointJudge::goal_stands_free(Vec2 goal) const {
  const bool stays_on_water = scene.map && starts_on_water(*scene.map, problem.start) && cell_at(*scene.map, goal);
  return stays_on_water || stands_free(goal);
}

Outcome PointJudge::settled(Outcome outcome) const {
  return settled_ends(
      outcome, [&] { return stands_free(problem.start); }, [&] { return goal_stands_free(problem.goal); });
}

std::string_view cause_of_separation(const Answer& answer, bool by_roadmap) {
  if (by_roadmap && answer.roadmap.milestones <= 2) return "no_free_sample";
  if (!answer.separation.is_known()) return {};
  if (answer.separation.start_size <= 1) return "start_unconnected";
  return answer.separation.goal_size <= 1 ? "goal_unconnected" : "different_components";
}

void price_heuristic(Answer& answer, std::optional<HeuristicKind> asked,
                     const std::function<Answer(HeuristicKind)>& ask) {
  if (!asked || asked == HeuristicKind::euclidean || !answer.verified) return;
  stopped_by([&] {
    const Answer exact = ask(HeuristicKind::euclidean);
    if (!exact.verified) return;
    answer.path_figures.push_back({"searched_length", answer.raw_length.value_or(answer.length)});
    answer.path_figures.push_back({"shortest_length", exact.length});
    answer.path_figures.push_back({"shortest_expanded", exact.counters.expanded});
  });
}

void claim_nothing(Answer& answer) {
  answer.verified = false;
  answer.optimal = false;
  answer.lower_bound.reset();
  answer.length = 0.0;
  answer.min_clearance = 0.0;
  answer.raw_length.reset();
  answer.cost.reset();
  answer.turn_rad.reset();
  answer.path_figures.clear();
  answer.path.clear();
  answer.handed.reset();
  answer.states = {};
}

void make_stopped(Answer& answer, StopReason reason) {
  answer.outcome = Outcome::stopped;
  answer.stop_reason = reason;
  answer.refuted.reset();
  claim_nothing(answer);
}

void refute(Answer& answer, const Verification& found) {
  answer.refuted = RefutedPath{.violation = found.first_violation.value_or(Violation{}),
                               .length = found.length,
                               .cost = answer.cost,
                               .path = std::move(answer.path),
                               .states = std::move(answer.states)};
  answer.outcome = Outcome::not_connected;
  claim_nothing(answer);
}

void fail_verification(const Answer& answer, const std::optional<Violation>& found) {
  const Violation violation = found.value_or(Violation{});
  throw RefutedPathError(fmt::format("the path of {} fails its verification at leg {}: {} is {} away", answer.planner,
                                     violation.leg, violation.obstacle, violation.distance));
}

void PointJudge::verify_solved(Answer& answer, bool over_cells) const {
  if (answer.outcome != Outcome::solved) return;
  const StageTimer timer(execution, "verify", answer.seconds.verify, answer.path.size() + scene.walls.size());
  const Verification verdict = judged(answer.path, verify_options(problem));
  if (verdict.verified || !scene.map) return take_verdict(answer, verdict);
  const Violation violation = verdict.first_violation.value_or(Violation{});
  const bool at_an_end = violation.leg == 0 || violation.leg + 2 == answer.path.size();
  const bool may_miss = over_cells && problem.reach() > 0.0 && at_an_end;
  answer.outcome = settled(Outcome::start_blocked);
  if (answer.outcome == Outcome::not_connected && !may_miss) fail_verification(answer, violation);
  answer.path.clear();
}

void take_verdict(Answer& answer, const Verification& verdict) {
  if (!verdict.verified) fail_verification(answer, verdict.first_violation);
  answer.verified = true;
  answer.length = verdict.length;
  answer.min_clearance = verdict.min_clearance;
}

Box room_of(const Scene& scene, const Execution& execution) {
  if (scene.map) return world_box(*scene.map);
  return scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
}

double end_margin(const Scene& scene, const RobotSpec& robot, double clearance, double extent,
                  const Execution& execution) {
  const double round = end_margin(clearance + robot.radius, scene.map ? scene.map->cell : 0.0);
  if (is_round(robot)) return round;
  constexpr double rounding = 4e-12;  // of coordinates
  return 2.0 * round + 2e-9 * extent + rounding * largest_coordinate_of(scene, execution);
}

std::optional<PriceParts> judged_price(const Scene& scene, const Prices& prices, const RobotSpec& robot,
                                       const RecordedAnswer& answer, const Execution& execution) {
  const bool turns = robot.kind == RobotKind::polygon || robot.kind == RobotKind::car;
  const bool only_restricts = (words_in(prices) | restriction_words) == restriction_words;
  if (only_restricts || answer.path.empty()) return std::nullopt;
  if (turns) return verify_body_price(scene, poses_of(answer.states), robot, prices, execution);
  if (!is_round(robot)) return std::nullopt;
  return verify_price(scene, answer.path, prices, robot.radius, execution);
}

std::optional<PriceParts> driving_price(const RecordedAnswer& answer, const Verdict& verdict, bool places_too) {
  const AskedDriving& asked = answer.driving;
  const RobotSpec& robot = verdict.problem.robot;
  const bool is_asked = asked.turn_cost || asked.cusp_cost || asked.reverse_cost;
  if (robot.kind != RobotKind::car || !is_asked) return std::nullopt;
  const double usual_cusp =
      asked.optimise && !places_too && robot.steering == SteeringKind::reeds_shepp ? robot.turning_radius : 0.0;
  return PriceParts{.turning = asked.turn_cost.value_or(0.0) * verdict.turn_rad,
                    .cusps = asked.cusp_cost.value_or(usual_cusp) * static_cast<double>(verdict.cusps),
                    .reverse = (asked.reverse_cost.value_or(1.0) - 1.0) * verdict.reversed};
}

void judge_prices(Answer& answer, const Scene& scene, const Question& question, bool has_stops,
                  const Execution& execution) {
  const Prices prices = prices_of(scene, question);
  const bool is_driven_on = has_stops && answer.price;  // a car's gear may change where legs meet
  if (!answer.verified || (prices.empty() && !is_driven_on)) return;
  Execution judging = execution;
  std::optional<Deadline> untimed;
  if (answer.stop_reason) untime(judging, untimed);
  const StageTimer timer(judging, "verify", answer.seconds.verify, path_points(answer));
  const std::optional<Scene> effective = effective_scene(scene, prices, judging);
  const Scene& judged = effective ? *effective : scene;
  const RecordedAnswer record = recorded(answer);
  const Question asked = answer.problem.question();
  const Verdict verdict = verifying_kind(judged, asked).verify(judged, asked, record, judging);
  if (!verdict.verified) fail_verification(answer, verdict.first_violation.value_or(Violation{}));
  const auto of_places = judged_price(judged, prices, answer.problem.robot, record, judging);
  const auto driving = is_driven_on ? driving_price(record, verdict, of_places.has_value()) : answer.price;
  if (!of_places && !driving) return;
  PriceParts price = of_places.value_or(PriceParts{});
  if (driving) {  // of a car: what its judge has counted
    price.turning = driving->turning;
    price.cusps = driving->cusps;
    price.reverse = driving->reverse;
  }
  answer.price = price;
  answer.cost = answer.length + price.sum();
  constexpr double rounding = 1e-9;  // who planned may have proved what it costs without
  answer.optimal &= answer.lower_bound && *answer.cost - *answer.lower_bound <= rounding * *answer.cost;
}

}  // namespace warren
