// SPDX-License-Identifier: BSD-3-Clause
// Which goal, and which places in which order: what GoalRule leaves open on a map, decided over the cells, where the
// cheapest way to a set of places is one field (planners/grid/price_field). The choice is geometry: the grid planner
// takes the ways over cells, those that sample plan to the chosen places. And other ways to a place than the cheapest.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/grid/price_field.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kept_ways.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/question.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {

/// Ways of a point or disc over the cells of a map, and how the places beside the middles are joined to them. One
/// thread.
class WaysOverCells {
 public:
  /// Refers to map and problem, and to what is kept of solves before, where something is. closed: cells that the body
  /// may not touch; wide: where its middle may not be. prices, with what asks them: of ways; nullptr: they cost their
  /// length.
  WaysOverCells(const OccupancyMap& map, const WallProblem& problem, const Bitmap& closed, const Bitmap& wide,
                Diagonal diagonal, const MapPrices* prices, MapPrices::Scratch* scratch, const Execution& execution,
                KeptWays* kept = nullptr)
      : map_(map),
        problem_(problem),
        closed_(closed),
        wide_(wide),
        execution_(execution),
        prices_(prices),
        scratch_(scratch),
        kept_(kept),
        weights_(kept != nullptr     ? kept->weights()
                 : prices != nullptr ? own_weights_.emplace(
                                           wide,
                                           [prices, scratch](Cell from, unsigned direction) {
                                             return prices->step_up(from, direction, *scratch);
                                           },
                                           execution)
                                     : own_weights_.emplace(wide, diagonal, execution)) {}

  /// A cell by which a place is reached, and what the leg between them costs.
  struct Entry {
    Cell cell;
    std::uint64_t cost = 0;  ///< units
    Vec2 place;
    std::size_t goal = 0;  ///< its number among those that were asked
  };
  Entry entry(Vec2 place, Cell cell, std::size_t goal) const {
    return {cell, leg_cost(place, cell_centre(map_, cell)), place, goal};
  }
  std::vector<Entry> entries(Vec2 place, std::size_t goal = 0) const {
    std::vector<Entry> entries;
    for (const Cell cell : cells_joined_to(map_, wide_, problem_.reach(), place, execution_)) {
      if (!wide_.test(cell.x, cell.y)) entries.push_back(entry(place, cell, goal));
    }
    return entries;
  }
  /// Adds all middles within the radius of the place (world units), and the place.
  void add_region(std::vector<Entry>& found, Vec2 place, double radius, std::size_t goal) const {
    if (cell_at(map_, place) && stands_free(place)) {
      for (const Entry& own : entries(place, goal)) found.push_back(own);
    }
    const Vec2 centre = map_point(map_, place);
    const double reach = radius / map_.cell;
    const auto rows = std::pair{std::max(0.0, std::floor(centre.y - reach)),
                                std::min<double>(map_.height(), std::ceil(centre.y + reach))};
    for (double row = rows.first; row < rows.second; ++row) {
      execution_.check();
      const double high = row + 0.5 - centre.y;
      if (std::abs(high) > reach) continue;
      const double half = std::sqrt(reach * reach - high * high);
      const double first = std::max(0.0, std::ceil(centre.x - half - 0.5));
      const double last = std::min<double>(map_.width() - 1.0, std::floor(centre.x + half - 0.5));
      for (double column = first; column <= last; ++column) {
        const Cell cell{static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)};
        const Vec2 at = cell_centre(map_, cell);
        if (!wide_.test(cell.x, cell.y) && distance(at, place) <= radius)
          push_asked(found, {cell, 0, at, goal}, execution_);
      }
    }
  }

  struct Way {
    std::vector<Cell> cells;
    std::uint64_t cost = 0;  ///< units
    Vec2 from;
    Entry end;
  };
  /// The cheapest of the ways to an entry; none: the cells join them to none.
  std::optional<Way> cheapest(Vec2 from, std::span<const Entry> ends) {
    const auto there = std::ranges::find(ends, from, &Entry::place);
    if (there != ends.end()) return Way{{}, 0, from, *there};
    const std::vector<Entry> begins = entries(from);
    std::vector<PriceField::Goal> goals;
    execution_.reserve(ends.size() * 3 * sizeof(PriceField::Goal));  // the field keeps two copies
    for (const Entry& end : ends) goals.push_back({end.cell, end.cost});
    std::vector<Cell> towards;
    for (const Entry& begin : begins) towards.push_back(begin.cell);
    if (goals.empty() || begins.empty()) return std::nullopt;
    std::optional<PriceField> own;
    PriceField& field =
        kept_ != nullptr ? kept_->field(goals, towards, execution_) : own.emplace(weights_, goals, towards, execution_);
    const std::uint64_t before = field.expanded();
    std::optional<Way> best;
    Cell first;
    for (const Entry& begin : begins) {
      const auto cost = field.cost(begin.cell, execution_);
      if (!cost || (best && best->cost <= *cost + begin.cost)) continue;
      best = Way{{}, *cost + begin.cost, from, {}};
      first = begin.cell;
    }
    expanded_ += field.expanded() - before;
    if (!best) return std::nullopt;
    auto [cells, end] = field.path(first, execution_);
    best->cells = std::move(cells);
    best->end = ends[end];
    return best;
  }
  /// What the ways to an entry cost, place by place; none: there is no way.
  std::vector<std::optional<std::uint64_t>> costs(std::span<const Vec2> from, std::span<const Entry> ends) {
    std::vector<PriceField::Goal> goals;
    for (const Entry& end : ends) goals.push_back({end.cell, end.cost});
    PriceField field(weights_, goals, {}, execution_);
    std::vector<std::optional<std::uint64_t>> least;
    for (const Vec2 place : from) {
      std::optional<std::uint64_t>& best = least.emplace_back();
      for (const Entry& begin : entries(place)) {
        const auto cost = field.cost(begin.cell, execution_);
        if (cost && (!best || *cost + begin.cost < *best)) best = *cost + begin.cost;
      }
      if (std::ranges::count(ends, place, &Entry::place) > 0) best = 0;
    }
    expanded_ += field.expanded();
    return least;
  }

  /// The place nearest to another, of those that are joined to the start.
  struct Nearest {
    Vec2 place;
    Cell cell;              ///< to whose middle it is joined
    double distance = 0.0;  ///< world units
  };
  /// none: no cell is joined to the start.
  std::optional<Nearest> nearest_place(Vec2 to) {
    if (!joined_) {
      std::vector<PriceField::Goal> from;
      for (const Entry& begin : entries(problem_.start)) from.push_back({begin.cell});
      StepWeights lengths(wide_, StepRule::four, execution_);
      joined_ = cells_from_start(lengths, from);
    }
    const Vec2 in_map = map_point(map_, to);
    constexpr double off = 1e-6;  // cells: what planners keep is far less
    const bool is_point = problem_.reach() == 0.0;
    // A point is wherever its cell is. A disc is at the middles, and leaves those that are nearest to be nearer.
    const auto distance_of = [&](Cell c) {
      return distance(in_map, is_point ? nearest_in(c, in_map, off) : middle(c));
    };
    double least = std::numeric_limits<double>::infinity();
    for_each_set(*joined_, [&](Cell c) { least = std::min(least, distance_of(c)); });
    if (std::isinf(least)) return std::nullopt;
    const double near = is_point ? least : least + 1.5;
    std::vector<std::pair<double, Cell>> candidates;
    for_each_set(*joined_, [&](Cell c) {
      if (const double d = distance_of(c); d <= near) candidates.emplace_back(d, c);
    });
    std::ranges::stable_sort(candidates, [](const auto& a, const auto& b) { return a.first < b.first; });
    constexpr std::size_t most = 16;
    if (candidates.size() > most) candidates.resize(most);
    std::optional<Nearest> best;
    for (const auto& candidate : candidates) {
      execution_.check();
      std::optional<Nearest> place;
      if (is_point) {
        const Vec2 at = world_point(map_, nearest_in(candidate.second, in_map, off));
        place = Nearest{at, candidate.second, distance(at, to)};
      } else {
        place = slid(to, candidate.second);
      }
      if (place && (!best || place->distance < best->distance)) best = place;
    }
    return best;
  }
  /// Proved: nothing that can be reached from the start is nearer.
  double distance_bound(Vec2 to) {
    const auto start = cell_at(map_, problem_.start);
    constexpr double half_diagonal = 0.7071067811865476 + 1e-9;
    const double radius = problem_.reach() / map_.cell - half_diagonal;
    const bool is_point = problem_.reach() == 0.0;
    const Bitmap may_be = is_point ? closed_ : blocked_for_disc(closed_, radius, execution_);
    StepWeights steps(may_be, is_point ? StepRule::four : StepRule::eight_squeezing, execution_);
    const PriceField::Goal from[] = {{*start}};
    const Bitmap joined = cells_from_start(steps, from);
    const Vec2 in_map = map_point(map_, to);
    double least = std::numeric_limits<double>::infinity();
    for_each_set(joined, [&](Cell c) { least = std::min(least, distance(in_map, nearest_in(c, in_map, 0.0))); });
    constexpr double rounding = 1e-12;
    const double bound = least * map_.cell * (1.0 - rounding) - rounding * (std::abs(to.x) + std::abs(to.y));
    return std::isinf(least) ? 0.0 : std::max(0.0, bound);
  }

  bool stands_free(Vec2 place) const { return stands_free_on_map(map_, problem_, place, execution_); }
  /// Of a straight leg, its length included.
  double cost(Vec2 a, Vec2 b) const { return is_priced() ? prices_->cost(a, b, *scratch_) : distance(a, b); }
  bool is_priced() const { return prices_ != nullptr; }
  /// Of that cost, but for the length; where it is priced.
  PriceParts parts(Vec2 a, Vec2 b) const { return prices_->parts(a, b, *scratch_); }
  const OccupancyMap& map() const { return map_; }
  const WallProblem& problem() const { return problem_; }
  const Bitmap& closed() const { return closed_; }
  const Bitmap& wide() const { return wide_; }
  std::uint64_t expanded() const { return expanded_; }
  /// Of the steps, known so far.
  StepWeights& weights() { return weights_; }

 private:
  static Vec2 middle(Cell c) { return {c.x + 0.5, c.y + 0.5}; }
  /// Calls visit(cell) for all cells that are set, by rows.
  template <class Visit>
  void for_each_set(const Bitmap& set, const Visit& visit) const {
    for_each_differing(
        set, {}, [&] { execution_.check(); }, visit);
  }
  /// The point of a cell that is nearest to another, off its sides; map coordinates.
  static Vec2 nearest_in(Cell cell, Vec2 to, double off) {
    const auto inside = [off](double x, double low) { return std::clamp(x, low + off, low + 1.0 - off); };
    return {inside(to.x, cell.x), inside(to.y, cell.y)};
  }
  std::uint64_t leg_cost(Vec2 a, Vec2 b) const {
    return static_cast<std::uint64_t>(std::ceil(cost(a, b) / map_.cell * static_cast<double>(units_a_cell)));
  }
  Bitmap cells_from_start(StepWeights& weights, std::span<const PriceField::Goal> from) {
    PriceField field(weights, from, {}, execution_);
    field.settle_all(execution_);
    expanded_ += field.expanded();
    Bitmap joined = cell_bitmap(map_.width(), map_.height(), execution_);
    for (std::uint32_t y = 0; y < joined.height(); ++y) {
      if (y % 16 == 0) execution_.check();
      for (std::uint32_t x = 0; x < joined.width(); ++x) {
        if (field.reached({x, y})) joined.set(x, y);
      }
    }
    return joined;
  }
  /// From the middle of a cell straight towards a place, as far as the body gets; then as near as straight legs from
  /// that middle get by small moves.
  std::optional<Nearest> slid(Vec2 to, Cell from) const {
    const Vec2 centre = cell_centre(map_, from);
    const auto may = [&](Vec2 place) {
      return stands_free(place) && is_joined(map_, problem_.reach(), place, from, execution_);
    };
    if (!may(centre)) return std::nullopt;
    double share = 0.0;
    const auto at = [&](double t) { return centre + t * (to - centre); };
    if (may(to)) {
      share = 1.0;
    } else {
      for (double part = 0.5; part > 1e-4; part *= 0.5) {
        if (may(at(share + part))) share += part;
      }
    }
    Vec2 best = share == 1.0 ? to : at(share);
    for (double step = 0.5 * map_.cell; step > 1e-3 * map_.cell;) {
      execution_.check();
      bool moved = false;
      for (const auto& [dx, dy] : cell_steps) {
        const Vec2 place = best + Vec2{step * dx, step * dy};
        if (!(distance(place, to) < distance(best, to)) || distance(place, centre) > 2.0 * map_.cell || !may(place))
          continue;
        best = place;
        moved = true;
        break;
      }
      if (!moved) step *= 0.5;
    }
    return Nearest{best, from, distance(best, to)};
  }

  const OccupancyMap& map_;
  const WallProblem& problem_;
  const Bitmap& closed_;
  const Bitmap& wide_;
  const Execution& execution_;
  const MapPrices* prices_;
  MapPrices::Scratch* scratch_;
  KeptWays* kept_;
  std::optional<StepWeights> own_weights_;  // where none are kept
  StepWeights& weights_;
  std::optional<Bitmap> joined_;  // cells that steps join to the start
  std::uint64_t expanded_ = 0;
};

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
GoalChoice choose_goal(WaysOverCells& ways, std::span<const std::vector<double>> via, bool open_end);

/// No path that does what is asked is shorter: straight ways between what may be chosen, world units. off: how far from
/// a goal a path may end under a tolerance, as the answer's own does. none: where there is nothing to choose.
std::optional<double> bound_of_choice(Vec2 start, Vec2 goal, const GoalRule& rule, bool open_end, double off = 0.0);

/// How far from the goal that was asked for its path ends.
inline double off_goal(const Answer& answer) { return answer.goal_reached ? answer.goal_reached->distance : 0.0; }

/// The bound of an answer whose planner was given one of the places that would have done, of which alone it knows the
/// best, and how near to it the path is.
void take_bound_of_choice(Answer& answer, std::optional<double> bound);

/// Takes the cheapest of the paths as the answer's own, and the others as its alternatives, all of them verified, of
/// different classes by the judge's own cuts. answer: has the path that is found without alternatives, which is never
/// cheaper than what is taken. distances: of the closed cells; nullptr: not made. Throws UsageError where the question
/// has stops or a region, Stopped.
void take_alternatives(Answer& answer, const RouteRule& route, WaysOverCells& ways, const DistanceField* distances,
                       const Execution& execution);

}  // namespace warren
