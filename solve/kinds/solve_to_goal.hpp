// SPDX-License-Identifier: BSD-3-Clause
// What a question asks beyond a way to one goal, for kinds that don't decide it themselves (on maps points and discs
// do, goals_on_map.hpp): several goals, a tolerance or a region (docs/algorithms.md). Stops on the way: the planner
// plans from one to the next; where their order is open, it plans between all of them first, and the order is the
// cheapest one over what it found.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/plane/se2.hpp"
#include "scenes/scene/arm_model.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// A place that will do as the goal.
struct GoalPlace {
  std::vector<double> state;  ///< 2 numbers of points and discs, else 3
  std::size_t goal = 0;       ///< the number of the goal that it is near
  double distance = 0.0;      ///< to that, world units
  double rank = 0.0;          ///< the least are taken: the distance, or what who offers it says
  double turn_rad = 0.0;      ///< how far the heading that was offered is off

  /// In the order in which places are taken.
  friend bool operator<(const GoalPlace& a, const GoalPlace& b) {
    return std::pair{a.rank, a.turn_rad} < std::pair{b.rank, b.turn_rad};
  }
};

/// Of the poses that are offered, those that a tolerance or region takes: a few of the least rank. The heading is as
/// asked, or off by the angle that may be; a pose whose heading is off by no more than `coarse` besides is taken with
/// the heading that was asked.
class GoalPlaces {
 public:
  /// goals: 2 or 3 numbers each. rule: of a tolerance or a region. coarse: radians, >= 0.
  GoalPlaces(std::vector<std::vector<double>> goals, const GoalRule& rule, double coarse)
      : goals_(std::move(goals)),
        reach_(rule.region ? *rule.region : rule.tolerance.value_or(0.0)),
        most_off_rad_(rule.heading_rad.value_or(0.0) + rounding_rad),
        coarse_rad_(coarse) {}

  /// As the nearest goal takes it; none: no goal does.
  std::optional<GoalPlace> place(const Se2& pose) const {
    std::optional<GoalPlace> best;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      const std::vector<double>& goal = goals_[i];
      const double off = distance(pose.position(), Vec2{goal[0], goal[1]});
      if (off > reach_) continue;
      const double turn = goal.size() == 3 ? std::abs(turn_between(pose.theta, goal[2])) : 0.0;
      if (turn > std::max(most_off_rad_, coarse_rad_)) continue;
      const double heading = turn <= most_off_rad_ ? pose.theta : goal[2];
      GoalPlace here{{pose.x, pose.y, heading}, i, off, off, turn};
      if (!best || here < *best) best = std::move(here);
    }
    return best;
  }
  /// Of equal ranks the one whose heading is less off counts, and then the first. No rank: its distance.
  void offer(const Se2& pose, std::optional<double> rank = {}) {
    constexpr std::size_t most = 16;
    std::optional<GoalPlace> found = place(pose);
    if (!found) return;
    found->rank = rank.value_or(found->rank);
    kept_.insert(std::upper_bound(kept_.begin(), kept_.end(), *found), std::move(*found));
    if (kept_.size() > most) kept_.pop_back();
  }
  /// The least rank first.
  const std::vector<GoalPlace>& taken() const { return kept_; }

 private:
  static constexpr double rounding_rad = 1e-9;
  std::vector<std::vector<double>> goals_;
  double reach_;         // world units
  double most_off_rad_;  // of headings
  double coarse_rad_;
  std::vector<GoalPlace> kept_;  // sorted
};

/// All goals of a question, the first first.
std::vector<std::vector<double>> goals_of(const Scene& scene, const Question& question);

/// Places that a lattice joins to the start: of points, discs and polygons (solve_lattice.cpp), of cars
/// (solve_car.cpp). Throws UsageError, Stopped.
std::vector<GoalPlace> places_on_layers(const SolveRequest& request);
std::vector<GoalPlace> places_of_car(const SolveRequest& request);

/// What an answer says that its path costs.
inline double told_cost(const Answer& answer) { return answer.cost.value_or(answer.length); }
/// The same with what places make dear, which solve() judges when all is planned. Where its judge is stopped: the same.
double paid_for(const Answer& answer, const SolveRequest& request);

/// SolveKind::solve, whatever the question leaves open of its goal. Throws as that.
Answer solve_without_stops(const SolveKind& kind, const SolveRequest& request);

/// Leg by leg through stops, in their order, each leg planned from the state in which the one before ended; the whole
/// path is judged once more. Of a stop whose heading is open the plan to it chooses one; where nothing leads on from
/// that, seven others are tried (not by planners that get better), and a leg without a way proves nothing. solve_leg:
/// of a question without stops; the last leg has the request's goal, with what that leaves open. stop: "@via: ... at
/// way-point". Throws UsageError where the body does not fit at one of them.
Answer solve_through(const SolveRequest& request, std::span<const std::vector<double>> stops,
                     std::pair<std::string_view, std::string_view> stop,
                     const std::function<Answer(const SolveRequest&)>& solve_leg);

/// The stops of `--via`, as solve_through() names them.
inline constexpr std::pair<std::string_view, std::string_view> way_point{"@via", "way-point"};
/// The same of places to visit.
inline constexpr std::pair<std::string_view, std::string_view> visited_place{"@visit", "place"};

/// SolveKind::solve, whatever the question leaves open of its goal, and whatever stops it has. Throws as that.
Answer solve_to_goal(const SolveKind& kind, const SolveRequest& request);

// A route is kept (docs/algorithms.md): the rest of an older path, where that is still free and a new one is not much
// cheaper.

/// What is left of a route for a robot that stands at `start`: from there to the route's place nearest to it, then on.
/// Of places that are as near but for `slack` the first counts, so that nobody jumps to where the route comes by again.
/// is_cut: may the route begin within one of its motions? else it begins with the state after. States are numbers of
/// one count; of bodies of the plane the first two are their place, of arms all are joints, of which those without end
/// go the shorter way. Empty: the route is.
std::vector<std::vector<double>> rest_of_route(const std::vector<std::vector<double>>& route,
                                               const std::vector<double>& start, double slack, bool is_cut,
                                               bool of_arm = false, std::span<const ArmVariable> joints = {});

/// Decides, where the question asks, and tells in the answer. Throws UsageError for routes of another body or to
/// another goal, and where costs can't be compared; Stopped.
void keep_to_route(Answer& answer, const Scene& scene, const Question& question, const SolveOptions& options,
                   const Execution& execution);

}  // namespace warren
