// SPDX-License-Identifier: BSD-3-Clause
// From what a planner found to what the program answers, for points and discs of the plane: the solution is taken over,
// its path verified, and a stop is made an answer. And what no path of a problem can be shorter than (lower_bound.cpp).
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

class LookedUpWalls;  // verify/streamed/verify_cells.hpp

/// SolveKind::usual of a kind whose questions all have the same usual planner.
template <PlannerKind planner>
PlannerKind usually(const SolveOptions&, const Scene&, const Question&) {
  return planner;
}

/// The options that planner_options() gives planners that build roadmaps of samples; problem, planner and options as
/// the answer repeats them.
PlannerOptions describe_roadmap_planner(Answer& answer, const Scene& scene, const WallProblem& problem,
                                        const SolveOptions& asked);

/// The options that are given as answers repeat them: all but sampler and search, which answers name anyway.
std::vector<NamedFigure> given_figures(const SolveOptions& options);

/// Outcome, path, sizes, counters and times of a solution.
void take_solution(Answer& answer, Solution<Vec2> solution);

/// The same without the path, for states of any kind.
template <class State>
void take_account(Answer& answer, const Solution<State>& solution) {
  answer.outcome = solution.outcome;
  answer.roadmap = solution.roadmap;
  answer.separation = solution.separation;
  answer.counters = solution.counters;
  if (solution.outcome == Outcome::stopped) answer.stop_reason = solution.stop_reason;
  answer.seconds += solution.seconds;
}

/// What the judge of points is asked for the problem, and for a place of it as an end where no map is.
VerifyOptions verify_options(const WallProblem& problem);
VerifyOptions end_options(const WallProblem& problem);

/// The judge of a point or disc, as solves ask it: among walls and polygons, on a map, or by walls that are looked up.
/// Refers to all of it.
struct PointJudge {
  const Scene& scene;
  const WallProblem& problem;
  const Execution& execution;
  const ObstacleIndex* index = nullptr;  ///< of the scene, where there is one
  const LookedUpWalls* cells = nullptr;  ///< instead of the scene's walls

  Verification judged(std::span<const Vec2> path, const VerifyOptions& options) const;
  /// Does the body fit there as an end?
  bool stands_free(Vec2 p) const;
  bool goal_stands_free(Vec2 goal) const;  ///< on a map who starts on water may stay there
  /// What is said of the ends where the outcome calls one blocked.
  Outcome settled(Outcome outcome) const;
  /// Verifies the path of a solved answer and fills in length and clearance. A path that fails is a bug: throws as
  /// fail_verification(). On a map a disc's path over_cells may fail between an end and the middle of its cell, and an
  /// end may be blocked by rounding alone: then there is none.
  void verify_solved(Answer& answer, bool over_cells = false) const;
};
inline PointJudge judge_of(const SolveRequest& request, const WallProblem& problem) {
  return {request.scene, problem, request.execution, request.asked.judged()};
}

/// Why a roadmap or trees do not join start and goal, one word a cause; empty where nobody measured how far they are
/// apart.
std::string_view cause_of_separation(const Answer& answer, bool by_roadmap);

/// What an estimate that was asked for costs in length: the same question is answered once more by A* with the straight
/// line, which finds the shortest path of the same roadmap. Adds to the path's figures `searched_length` (before
/// shortening), `shortest_length` and `shortest_expanded` of the straight line, where another estimate was asked for
/// and a path was found. `ask` answers with the estimate that it is given, without shortening. What stops meanwhile
/// adds nothing.
void price_heuristic(Answer& answer, std::optional<HeuristicKind> asked,
                     const std::function<Answer(HeuristicKind)>& ask);

/// Forgets all that an answer says of a path: only what a judge has verified is claimed.
void claim_nothing(Answer& answer);

/// What stops the work on an answer, or on what is told of it, makes it a stopped one, which claims nothing.
void make_stopped(Answer& answer, StopReason reason);

/// The path of a method that promises nothing has failed its verification: it is told as refuted, and as nothing else.
void refute(Answer& answer, const Verification& found);

/// A path that its judge refuses.
struct RefutedPathError : std::logic_error {
  using std::logic_error::logic_error;
};

/// A planner's path that its judge refuses is a bug: throws RefutedPathError with what the judge found.
[[noreturn]] void fail_verification(const Answer& answer, const std::optional<Violation>& found);

/// Bytes that the judge of a path holds, whatever the path: an index of its own of what is in the way, or a map with
/// prices, and what the answer takes. Planners that get better keep them back.
std::size_t judge_bytes(const Scene& scene);

/// The judge's word on the path of a solved answer: as PointJudge::verify_solved().
void take_verdict(Answer& answer, const Verification& verdict);

/// Takes the time limit off an execution: what ended a search does not end the work on its path. `last` is its deadline
/// then, of the memory alone.
inline void untime(Execution& execution, std::optional<Deadline>& last) {
  if (execution.deadline == nullptr) return;
  execution.deadline = &last.emplace(std::numeric_limits<double>::infinity(), execution.deadline->memory_bytes());
}

/// Runs `solve`, which fills in `answer`; its seconds are solve_s, and whatever stops it is an answer. One that is not
/// verified claims nothing.
template <class Solve>
void answer_within_limits(Answer& answer, const Solve& solve) {
  const auto begin = std::chrono::steady_clock::now();
  if (const auto reason = stopped_by(solve)) make_stopped(answer, *reason);
  if (!answer.verified) claim_nothing(answer);
  answer.solve_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The same of a solve whose steps share its answer.
template <class Solve>
Answer answered(Solve solve) {
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

// What is said of start and goal where a planner calls one of them blocked. A planner may take a disc for the body that
// it holds; so the verification decides: an end that it takes is not blocked, the start comes first, and where both
// stand free nobody has proved anything. Planning keeps a little more room than a path must, and so must ends: the
// verification is asked with end_margin() more, so that all planners say the same of an end that only touches.

/// Of an end that has its room, but none to spare.
inline constexpr std::string_view touching_hint =
    "the body has its room there but only just: an end needs a billionth to spare, as planning keeps it";

/// Of a point or disc that keeps `reach`; on a map `cell` is a cell's side. Above what planning keeps there
/// (worlds/plane): a billionth.
inline double end_margin(double reach, double cell = 0.0) { return 2e-9 * std::max(reach, cell); }

/// Of any body that reaches as far as `extent` from its reference point, an arm's base: above what planning keeps
/// (worlds/poses/obstacle_tree, worlds/arms/arm_world). Of bodies that turn and arms one pass over the obstacles.
/// Throws Stopped.
double end_margin(const Scene& scene, const RobotSpec& robot, double clearance, double extent,
                  const Execution& execution);

/// start_stands_free(), goal_stands_free(): by the verification; asked only where the outcome is about an end.
template <class StartStandsFree, class GoalStandsFree>
Outcome settled_ends(Outcome outcome, const StartStandsFree& start_stands_free,
                     const GoalStandsFree& goal_stands_free) {
  if (!is_blocked(outcome)) return outcome;
  if (!start_stands_free()) return Outcome::start_blocked;
  return goal_stands_free() ? Outcome::not_connected : Outcome::goal_blocked;
}

/// What a path costs beside its length, by its judge; none: nothing that has a price is asked, or the body is an arm.
/// Throws Stopped.
std::optional<PriceParts> judged_price(const Scene& scene, const Prices& prices, const RobotSpec& robot,
                                       const RecordedAnswer& answer, const Execution& execution);

/// What driving costs, as the answer says that it was asked, by what the judge has counted; none: nobody asked.
/// places_too: do they have prices?
std::optional<PriceParts> driving_price(const RecordedAnswer& answer, const Verdict& verdict, bool places_too);

/// Price and cost of a verified answer, by the verification's own view of what the prices close and open. has_stops: a
/// car's gear may change where the legs meet. Throws RefutedPathError, Stopped.
void judge_prices(Answer& answer, const Scene& scene, const Question& question, bool has_stops,
                  const Execution& execution);

/// What is bounded: the length that answers tell, or what planners that get better tell as cost, the body's metric:
/// they differ for polygons that turn alone (worlds/poses/se2_world.hpp, with the usual weight of a turn).
enum class BoundOf : std::uint8_t { length, metric };

/// simple: costs nothing. exact: milliseconds, and seconds where there are many corners.
enum class BoundEffort : std::uint8_t { simple, exact };

/// Above, shortest ways take too long for what they tell.
inline constexpr std::size_t largest_bounded_corners = 100'000;

/// What no path of the problem can be shorter than; >= 0. `scene`: as it is planned in, with a map's borders as walls
/// or without. Never throws Stopped. Throws as table_of() where an arm's table can't be read.
double proved_bound(const Scene& scene, const Problem& problem, BoundOf of, BoundEffort effort,
                    const Execution& execution);

/// The bound of a verified answer, and whether that proves its path the shortest. One that has a bound, or was found
/// to be optimal, keeps that. None is told of paths through way-points, nor where the cost is in units of the planner's
/// own.
void tell_bound(Answer& answer, const Scene& scene, const SolveOptions& options, const Execution& execution);

/// Where a bound, a gap or a certificate is asked of a verified answer of grid on a map: the best bound of all paths
/// that is found until the gap is reached; of a certificate that is asked for, what it proves. `scene`: as it is
/// planned in. Stops leave the bound that there is.
void prove_on_map(Answer& answer, const Scene& scene, const SolveOptions& options, ByProducts* keep,
                  const Execution& execution);

/// The box in which reference points of bodies of the plane may be: map, bounds, or what the obstacles fill. Throws
/// Stopped.
Box room_of(const Scene& scene, const Execution& execution);

}  // namespace warren
