// SPDX-License-Identifier: BSD-3-Clause
// Which goal, and which places in which order: what GoalRule leaves open on a map, decided over the cells, where the
// cheapest way to a set of places is one field (planners/grid/price_field). The choice is geometry: the grid planner
// takes the ways over cells, those that sample plan to the chosen places. And other ways to a place than the cheapest.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "planners/grid/price_field.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kept_ways.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// What ways over the cells cost beyond their length; empty: nothing.
struct LegPrices {
  std::function<double(Vec2, Vec2)> cost;  ///< of a straight leg, its length included; world coordinates and units
  StepWeights::Weigh step;                 ///< between the middles of cells, rounded up
};

/// Ways of a point or disc over the cells of a map, and how the places beside the middles are joined to them. One
/// thread.
class WaysOverCells {
 public:
  /// Refers to map and problem, and to what is kept of solves before, where something is. closed: cells that the body
  /// may not touch; wide: where its middle may not be.
  WaysOverCells(const OccupancyMap& map, const WallProblem& problem, const Bitmap& closed, const Bitmap& wide,
                Diagonal diagonal, LegPrices prices, const Execution& execution, KeptWays* kept = nullptr);

  /// A cell by which a place is reached, and what the leg between them costs.
  struct Entry {
    Cell cell;
    std::uint64_t cost = 0;  ///< units
    Vec2 place;
    std::size_t goal = 0;  ///< its number among those that were asked
  };
  /// By a cell to whose middle the place is joined.
  Entry entry(Vec2 place, Cell cell, std::size_t goal) const {
    return {cell, leg_cost(place, cell_centre(map_, cell)), place, goal};
  }
  /// Of a place: a point's own cell; a disc may fit where it stands and not at the middle of its cell, but at one of
  /// those around it.
  std::vector<Entry> entries(Vec2 place, std::size_t goal = 0) const;
  /// All middles within the radius of the place (world units), and the place.
  std::vector<Entry> region(Vec2 place, double radius, std::size_t goal) const;

  struct Way {
    std::vector<Cell> cells;
    std::uint64_t cost = 0;  ///< units
    Vec2 from;
    Entry end;
  };
  /// The cheapest of the ways to an entry; none: the cells join them to none.
  std::optional<Way> cheapest(Vec2 from, std::span<const Entry> ends);
  /// What the ways to an entry cost, place by place; none: there is no way.
  std::vector<std::optional<std::uint64_t>> costs(std::span<const Vec2> from, std::span<const Entry> ends);

  /// The place nearest to another, of those that are joined to the start.
  struct Nearest {
    Vec2 place;
    Cell cell;              ///< to whose middle it is joined
    double distance = 0.0;  ///< world units
  };
  /// none: no cell is joined to the start.
  std::optional<Nearest> nearest_place(Vec2 to);
  /// Proved: nothing that can be reached from the start is nearer.
  double distance_bound(Vec2 to);

  bool stands_free(Vec2 place) const;
  std::uint64_t expanded() const { return expanded_; }
  /// Of the steps, known so far.
  StepWeights& weights() { return weights_; }

 private:
  std::uint64_t leg_cost(Vec2 a, Vec2 b) const;
  Bitmap cells_from_start(StepWeights& weights, std::span<const PriceField::Goal> from);
  std::optional<Nearest> slid(Vec2 to, Cell from) const;

  const OccupancyMap& map_;
  const WallProblem& problem_;
  const Bitmap& closed_;
  const Bitmap& wide_;
  const Execution& execution_;
  LegPrices prices_;
  KeptWays* kept_;
  std::optional<StepWeights> own_weights_;  // where none are kept
  StepWeights& weights_;
  std::optional<Bitmap> joined_;  // cells that steps join to the start
  std::uint64_t expanded_ = 0;
};

/// What is decided of a question.
struct GoalChoice {
  Outcome outcome = Outcome::not_connected;  ///< solved: cells join all of it
  Vec2 goal;                                 ///< where the path shall end
  std::optional<std::uint64_t> goal_index;
  std::optional<GoalReached> reached;
  std::vector<std::uint64_t> order;
  std::vector<Vec2> stops;               ///< in their order, the goal excluded
  std::vector<WaysOverCells::Way> ways;  ///< from stop to stop
  std::optional<Vec2> nearest;           ///< where nothing that is asked can be reached: what can
  std::vector<Vec2> unreached;           ///< where a stop, or each of the goals, can't be reached over the cells
};

/// Decides. via: way-points in the order that is asked; open_end: the question names no goal, its visits are all.
/// Throws UsageError where the body does not fit at a stop, Stopped.
GoalChoice choose_goal(WaysOverCells& ways, const OccupancyMap& map, const WallProblem& problem,
                       std::span<const Vec2> via, bool open_end);

/// No path that does what is asked is shorter: straight ways between what may be chosen, world units. off: how far from
/// a goal a path may end under a tolerance, as the answer's own does. none: where there is nothing to choose.
std::optional<double> bound_of_choice(Vec2 start, Vec2 goal, const GoalRule& rule, bool open_end, double off = 0.0);

/// How far from the goal that was asked for its path ends.
inline double off_goal(const Answer& answer) { return answer.goal_reached ? answer.goal_reached->distance : 0.0; }

/// The bound of an answer whose planner was given one of the places that would have done, of which alone it knows the
/// best, and how near to it the path is.
void take_bound_of_choice(Answer& answer, std::optional<double> bound);

/// A path cut where it first comes as near to a place.
Path<Vec2> cut_at_region(Path<Vec2> path, Vec2 place, double radius);

/// What a solve over cells holds when it has found a path.
struct RoutesAsked {
  const OccupancyMap& map;                      ///< as the question closes and opens it
  const WallProblem& problem;                   ///< its goal is the one that is reached
  const Bitmap& closed;                         ///< cells that the body may not touch
  const Bitmap& wide;                           ///< cells where its middle may not be
  StepWeights& weights;                         ///< of steps between the others
  const DistanceField* distances;               ///< of the closed cells; nullptr: not made
  LegPrices prices;                             ///< empty: ways cost their length
  std::function<PriceParts(Vec2, Vec2)> parts;  ///< of a leg, where there are prices
};

/// Takes the cheapest of the paths as the answer's own, and the others as its alternatives, all of them verified, of
/// different classes by the judge's own cuts. answer: has the path that is found without alternatives, which is never
/// cheaper than what is taken. Throws UsageError where the question has stops or a region, Stopped.
void take_alternatives(Answer& answer, const RouteRule& route, const RoutesAsked& asked, const Execution& execution);

}  // namespace warren
