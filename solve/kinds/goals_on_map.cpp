// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/goals_on_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "planners/grid/visiting_order.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {
namespace {

constexpr double half_diagonal = 0.7071067811865476 + 1e-9;

Vec2 middle(Cell c) { return {c.x + 0.5, c.y + 0.5}; }

/// Calls visit(cell) for all cells that are set, by rows.
template <class Visit>
void for_each_set(const Bitmap& set, const Execution& execution, const Visit& visit) {
  for_each_differing(
      set, {}, [&] { execution.check(); }, visit);
}

/// The point of a cell that is nearest to another, off its sides; map coordinates.
Vec2 nearest_in(Cell cell, Vec2 to, double off) {
  const auto inside = [off](double x, double low) { return std::clamp(x, low + off, low + 1.0 - off); };
  return {inside(to.x, cell.x), inside(to.y, cell.y)};
}

/// One question's decisions, in their order.
class Choosing {
 public:
  Choosing(WaysOverCells& ways, const OccupancyMap& map, const WallProblem& problem, bool open_end)
      : ways_(ways), map_(map), problem_(problem), rule_(problem.rule), open_end_(open_end) {
    goals_.push_back(problem.goal);
    for (const std::vector<double>& other : rule_.others) goals_.push_back({other[0], other[1]});
    choice_.goal = problem.goal;
  }

  GoalChoice chosen(std::span<const Vec2> via) {
    for (std::size_t i = 0; i < via.size(); ++i) check_stop("@via", "way-point", i, via[i]);
    choice_.stops.assign(via.begin(), via.end());
    if (!open_end_ && !find_ends()) return std::move(choice_);
    if (!rule_.visit.empty() && !find_order()) return std::move(choice_);
    if (open_end_) {
      ends_ = ways_.entries(choice_.stops.back());
      choice_.stops.pop_back();
    }
    walk();
    return std::move(choice_);
  }

 private:
  bool is_free(Vec2 place) const {
    const auto cell = cell_at(map_, place);
    return cell &&
           ((starts_on_water(map_, problem_.start) && starts_on_water(map_, place)) || ways_.stands_free(place));
  }
  void check_stop(std::string_view option, std::string_view noun, std::size_t number, Vec2 place) const {
    if (is_free(place)) return;
    throw UsageError(
        fmt::format("{}: the {} does not fit at {} {}", option, name_of(problem_.robot.kind), noun, number + 1));
  }

  /// Where the path may end. A tolerance needs to know whether any of that can be reached.
  bool find_ends() {
    if (rule_.back) {
      ends_ = ways_.entries(problem_.start);
      return true;
    }
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      std::vector<WaysOverCells::Entry> more;
      if (rule_.region) {
        more = ways_.region(goals_[i], *rule_.region, i);
      } else if (is_free(goals_[i])) {
        more = ways_.entries(goals_[i], i);
      }
      ends_.insert(ends_.end(), more.begin(), more.end());
    }
    first_ = stay_in_region();
    if (!first_) first_ = ways_.cheapest(problem_.start, ends_);
    if (first_) return true;
    return rule_.tolerance ? take_nearest() : fail();
  }

  /// Whoever starts in a region is there.
  std::optional<WaysOverCells::Way> stay_in_region() const {
    const Vec2 start = problem_.start;
    const auto own = cell_at(map_, start);
    for (std::size_t i = 0; own && rule_.region && i < goals_.size(); ++i) {
      if (distance(start, goals_[i]) <= *rule_.region) return WaysOverCells::Way{{*own}, 0, start, {*own, 0, start, i}};
    }
    return std::nullopt;
  }

  /// The place that is nearest to any of the goals.
  std::optional<std::pair<WaysOverCells::Nearest, std::size_t>> nearest() {
    std::optional<std::pair<WaysOverCells::Nearest, std::size_t>> best;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      const auto place = ways_.nearest_place(goals_[i]);
      if (place && (!best || place->distance < best->first.distance)) best = {*place, i};
    }
    return best;
  }

  bool take_nearest() {
    const auto found = nearest();
    if (!found || !(found->first.distance <= *rule_.tolerance)) return fail();
    ends_ = {ways_.entry(found->first.place, found->first.cell, found->second)};
    first_ = ways_.cheapest(problem_.start, ends_);
    return first_ ? true : fail();
  }

  /// What is said where nothing that was asked can be reached: the whole is looked at before it is called so.
  bool fail() {
    const bool blocked = std::ranges::none_of(goals_, [&](Vec2 goal) { return is_free(goal); });
    if (!rule_.tolerance && !rule_.region) {
      if (blocked) choice_.outcome = Outcome::goal_blocked;
      std::ranges::copy_if(goals_, std::back_inserter(choice_.unreached), [&](Vec2 goal) { return is_free(goal); });
      return false;
    }
    double bound = std::numeric_limits<double>::infinity();
    for (const Vec2 goal : goals_) bound = std::min(bound, ways_.distance_bound(goal));
    if (bound > rule_.tolerance.value_or(rule_.region.value_or(0.0))) {
      choice_.outcome = blocked ? Outcome::goal_blocked : Outcome::infeasible;
    }
    if (const auto place = nearest()) {
      choice_.nearest = place->first.place;
      tell_reached(place->second, place->first.distance, bound);
    }
    return false;
  }

  void tell_reached(std::size_t goal, double distance, std::optional<double> bound) {
    choice_.reached = GoalReached{{goals_[goal].x, goals_[goal].y}, distance, bound};
  }

  /// One field a stop.
  bool find_order() {
    std::vector<Vec2> places{problem_.start};
    for (std::size_t i = 0; i < rule_.visit.size(); ++i) {
      const Vec2 place{rule_.visit[i][0], rule_.visit[i][1]};
      check_stop("@visit", "place", i, place);
      places.push_back(place);
    }
    const std::size_t count = rule_.visit.size();
    const std::vector<std::uint64_t> row(count, no_leg);
    TourCosts costs{row, std::vector(count, row), std::vector<std::uint64_t>(count, open_end_ ? 0 : no_leg)};
    for (std::size_t j = 0; j < count; ++j) {
      const auto found = ways_.costs(places, ways_.entries(places[j + 1]));
      if (!found[0]) {
        choice_.unreached = {places[j + 1]};
        return false;
      }
      costs.from_start[j] = *found[0];
      for (std::size_t i = 0; i < count; ++i) costs.between[i][j] = found[i + 1].value_or(no_leg);
    }
    if (!open_end_) {
      const auto found = ways_.costs(std::span(places).subspan(1), ends_);
      for (std::size_t i = 0; i < count; ++i) costs.to_end[i] = found[i].value_or(no_leg);
    }
    const auto best = best_order(costs);
    if (!best) return false;
    choice_.order = best->order;
    for (const std::uint64_t i : best->order) choice_.stops.push_back(places[i + 1]);
    return true;
  }

  void walk() {
    Vec2 from = problem_.start;
    for (std::size_t leg = 0; leg <= choice_.stops.size(); ++leg) {
      const bool is_last = leg == choice_.stops.size();
      const std::vector<WaysOverCells::Entry> ends = is_last ? ends_ : ways_.entries(choice_.stops[leg]);
      auto way = leg == 0 && is_last && first_ ? std::move(first_) : ways_.cheapest(from, ends);
      if (!way) {
        choice_.unreached = is_last ? goals_ : std::vector{choice_.stops[leg]};
        choice_.ways.clear();
        return;
      }
      from = way->end.place;
      choice_.ways.push_back(std::move(*way));
    }
    choice_.outcome = Outcome::solved;
    const WaysOverCells::Entry& end = choice_.ways.back().end;
    choice_.goal = end.place;
    if (rule_.back || open_end_) return;
    if (!rule_.others.empty()) choice_.goal_index = end.goal;
    if (!rule_.tolerance && !rule_.region) return;
    const double off = distance(end.place, goals_[end.goal]);
    const bool at_goal = off == 0.0 || rule_.region;
    tell_reached(end.goal, off, at_goal ? std::optional<double>() : ways_.distance_bound(goals_[end.goal]));
    if (off == 0.0) choice_.reached->distance_bound = 0.0;
  }

  WaysOverCells& ways_;
  const OccupancyMap& map_;
  const WallProblem& problem_;
  const GoalRule& rule_;
  bool open_end_;
  std::vector<Vec2> goals_;
  std::vector<WaysOverCells::Entry> ends_;
  std::optional<WaysOverCells::Way> first_;  // from the start to the ends
  GoalChoice choice_;
};

/// Straight from the start over all places, in any order, to one of the ends; without ends to nowhere else.
double tour_bound(Vec2 start, std::span<const Vec2> places, std::span<const Vec2> ends) {
  double longest = 0.0;
  for (const auto list : {places, ends}) {
    for (const Vec2 place : list) longest = std::max(longest, distance(start, place));
  }
  if (!(longest > 0.0)) return 0.0;
  const double unit = longest * 0x1p-40;  // no leg is longer than twice that
  const auto units = [&](Vec2 a, Vec2 b) {
    return static_cast<std::uint64_t>(distance(a, b) / unit * (1.0 - 0x1p-50));
  };
  const auto to_ends = [&](Vec2 from) {
    std::uint64_t least = ends.empty() ? 0 : no_leg;
    for (const Vec2 end : ends) least = std::min(least, units(from, end));
    return least;
  };
  if (places.empty()) return static_cast<double>(to_ends(start)) * unit * (1.0 - 0x1p-50);
  TourCosts costs;
  for (const Vec2 place : places) {
    costs.from_start.push_back(units(start, place));
    costs.to_end.push_back(to_ends(place));
    std::vector<std::uint64_t>& row = costs.between.emplace_back();
    for (const Vec2 next : places) row.push_back(units(place, next));
  }
  return static_cast<double>(best_order(costs)->cost) * unit * (1.0 - 0x1p-50);
}

}  // namespace

WaysOverCells::WaysOverCells(const OccupancyMap& map, const WallProblem& problem, const Bitmap& closed,
                             const Bitmap& wide, Diagonal diagonal, LegPrices prices, const Execution& execution,
                             KeptWays* kept)
    : map_(map),
      problem_(problem),
      closed_(closed),
      wide_(wide),
      execution_(execution),
      prices_(std::move(prices)),
      kept_(kept),
      weights_(kept != nullptr ? kept->weights()
               : prices_.step  ? own_weights_.emplace(wide, prices_.step, execution)
                               : own_weights_.emplace(wide, diagonal, execution)) {}

bool WaysOverCells::stands_free(Vec2 place) const { return stands_free_on_map(map_, problem_, place, execution_); }

std::uint64_t WaysOverCells::leg_cost(Vec2 a, Vec2 b) const {
  const double cost = prices_.cost ? prices_.cost(a, b) : distance(a, b);
  return static_cast<std::uint64_t>(std::ceil(cost / map_.cell * static_cast<double>(units_a_cell)));
}

std::vector<WaysOverCells::Entry> WaysOverCells::entries(Vec2 place, std::size_t goal) const {
  const auto own = cell_at(map_, place);
  if (!own) return {};
  std::vector<Entry> entries;
  for (const Cell cell : cells_joined_to(map_, wide_, problem_.reach(), place, *own, execution_)) {
    if (!wide_.test(cell.x, cell.y)) entries.push_back(entry(place, cell, goal));
  }
  return entries;
}

std::vector<WaysOverCells::Entry> WaysOverCells::region(Vec2 place, double radius, std::size_t goal) const {
  std::vector<Entry> found;
  if (cell_at(map_, place) && stands_free(place)) found = entries(place, goal);
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
      if (!wide_.test(cell.x, cell.y) && distance(at, place) <= radius) found.push_back({cell, 0, at, goal});
    }
    execution_.reserve(found.size() * sizeof(Entry));
  }
  return found;
}

std::optional<WaysOverCells::Way> WaysOverCells::cheapest(Vec2 from, std::span<const Entry> ends) {
  const auto there = std::ranges::find_if(ends, [&](const Entry& end) { return end.place == from; });
  if (there != ends.end()) return Way{{}, 0, from, *there};
  const std::vector<Entry> begins = entries(from);
  std::vector<PriceField::Goal> goals;
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

std::vector<std::optional<std::uint64_t>> WaysOverCells::costs(std::span<const Vec2> from,
                                                               std::span<const Entry> ends) {
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
    if (std::ranges::any_of(ends, [&](const Entry& end) { return end.place == place; })) best = 0;
  }
  expanded_ += field.expanded();
  return least;
}

Bitmap WaysOverCells::cells_from_start(StepWeights& weights, std::span<const PriceField::Goal> from) {
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

std::optional<WaysOverCells::Nearest> WaysOverCells::nearest_place(Vec2 to) {
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
  const auto distance_of = [&](Cell c) { return distance(in_map, is_point ? nearest_in(c, in_map, off) : middle(c)); };
  double least = std::numeric_limits<double>::infinity();
  for_each_set(*joined_, execution_, [&](Cell c) { least = std::min(least, distance_of(c)); });
  if (std::isinf(least)) return std::nullopt;
  const double near = is_point ? least : least + 1.5;
  std::vector<std::pair<double, Cell>> candidates;
  for_each_set(*joined_, execution_, [&](Cell c) {
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

/// From the middle of a cell straight towards a place, as far as the body gets; then as near as straight legs from that
/// middle get by small moves.
std::optional<WaysOverCells::Nearest> WaysOverCells::slid(Vec2 to, Cell from) const {
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

double WaysOverCells::distance_bound(Vec2 to) {
  const auto start = cell_at(map_, problem_.start);
  const double radius = problem_.reach() / map_.cell - half_diagonal;
  const bool is_point = problem_.reach() == 0.0;
  const Bitmap may_be = is_point ? closed_ : blocked_for_disc(closed_, radius, execution_);
  StepWeights steps(may_be, is_point ? StepRule::four : StepRule::eight_squeezing, execution_);
  const PriceField::Goal from[] = {{*start}};
  const Bitmap joined = cells_from_start(steps, from);
  const Vec2 in_map = map_point(map_, to);
  double least = std::numeric_limits<double>::infinity();
  for_each_set(joined, execution_,
               [&](Cell c) { least = std::min(least, distance(in_map, nearest_in(c, in_map, 0.0))); });
  constexpr double rounding = 1e-12;
  const double bound = least * map_.cell * (1.0 - rounding) - rounding * (std::abs(to.x) + std::abs(to.y));
  return std::isinf(least) ? 0.0 : std::max(0.0, bound);
}

GoalChoice choose_goal(WaysOverCells& ways, const OccupancyMap& map, const WallProblem& problem,
                       std::span<const Vec2> via, bool open_end) {
  return Choosing(ways, map, problem, open_end).chosen(via);
}

std::optional<double> bound_of_choice(Vec2 start, Vec2 goal, const GoalRule& rule, bool open_end, double off) {
  const bool one_place = rule.others.empty() && !rule.region && rule.visit.empty() && !rule.back;
  if (one_place && off == 0.0) return std::nullopt;
  std::vector<Vec2> places;
  for (const std::vector<double>& place : rule.visit) places.push_back({place[0], place[1]});
  std::vector<Vec2> ends;
  if (!open_end) ends.push_back(rule.back ? start : goal);
  if (!open_end && !rule.back) {
    for (const std::vector<double>& other : rule.others) ends.push_back({other[0], other[1]});
  }
  constexpr double rounding = 0x1p-40;
  return std::max(0.0, (tour_bound(start, places, ends) - rule.region.value_or(off)) * (1.0 - rounding));
}

void take_bound_of_choice(Answer& answer, std::optional<double> bound) {
  answer.lower_bound = bound;
  answer.optimal = false;
  if (answer.ended_by == "optimum") answer.ended_by = "goal";
  if (answer.ended_by == "gap") answer.ended_by = "goal_gap";
}

Path<Vec2> cut_at_region(Path<Vec2> path, Vec2 place, double radius) {
  if (distance(path.front(), place) <= radius) return {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 from = path[i - 1] - place;
    const Vec2 leg = path[i] - path[i - 1];
    const double a = dot(leg, leg);
    const double b = dot(from, leg);
    const double inside = b * b - a * (dot(from, from) - radius * radius);
    if (!(a > 0.0) || !(inside > 0.0) || b >= 0.0) continue;
    double share = (-b - std::sqrt(inside)) / a;
    constexpr double step_in = 1e-12;
    for (double in = step_in; distance(path[i - 1] + share * leg, place) > radius && in < 1e-3; in *= 4.0) share += in;
    if (!(share < 1.0) || distance(path[i - 1] + share * leg, place) > radius) continue;
    path.resize(i);
    path.push_back(path[i - 1] + share * leg);
    return path;
  }
  return path;
}

}  // namespace warren
