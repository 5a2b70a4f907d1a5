// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/goals_on_map.hpp"

#include <fmt/format.h>

#include <set>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "planners/grid/path_classes.hpp"
#include "planners/grid/price_field.hpp"
#include "planners/grid/visiting_order.hpp"
#include "planners/shorten/taut_path.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "verify/judges/verify_classes.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren {
namespace {

class Choosing {
 public:
  Choosing(WaysOverCells& ways, bool open_end)
      : ways_(ways), problem_(ways.problem()), rule_(problem_.rule), open_end_(open_end) {
    goals_.push_back(problem_.goal);
    for (const std::vector<double>& other : rule_.others) goals_.push_back({other[0], other[1]});
    choice_.goal = problem_.goal;
  }

  GoalChoice chosen(std::span<const std::vector<double>> via) {
    for (std::size_t i = 0; i < via.size(); ++i) {
      choice_.stops.push_back({via[i][0], via[i][1]});
      check_stop("@via", "way-point", i, choice_.stops.back());
    }
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
    const OccupancyMap& map = ways_.map();
    return cell_at(map, place) &&
           ((starts_on_water(map, problem_.start) && starts_on_water(map, place)) || ways_.stands_free(place));
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
      if (rule_.region) {
        ways_.add_region(ends_, goals_[i], *rule_.region, i);
      } else if (is_free(goals_[i])) {
        std::ranges::copy(ways_.entries(goals_[i], i), std::back_inserter(ends_));
      }
    }
    first_ = stay_in_region();
    if (!first_) first_ = ways_.cheapest(problem_.start, ends_);
    if (first_) return true;
    const auto found = rule_.tolerance ? nearest() : std::nullopt;
    if (!found || !(found->first.distance <= *rule_.tolerance)) return fail();
    ends_ = {ways_.entry(found->first.place, found->first.cell, found->second)};
    first_ = ways_.cheapest(problem_.start, ends_);
    return first_ ? true : fail();
  }

  /// Whoever starts in a region is there.
  std::optional<WaysOverCells::Way> stay_in_region() const {
    const Vec2 start = problem_.start;
    const auto own = cell_at(ways_.map(), start);
    for (std::size_t i = 0; own && rule_.region && i < goals_.size(); ++i) {
      if (distance(start, goals_[i]) <= *rule_.region) return WaysOverCells::Way{{*own}, 0, start, {*own, 0, start, i}};
    }
    return std::nullopt;
  }

  std::optional<std::pair<WaysOverCells::Nearest, std::size_t>> nearest() {
    std::optional<std::pair<WaysOverCells::Nearest, std::size_t>> best;
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      const auto place = ways_.nearest_place(goals_[i]);
      if (place && (!best || place->distance < best->first.distance)) best = {*place, i};
    }
    return best;
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

// The cheapest path of each of the cheapest homotopy classes on a map, pulled taut in its class, for points and discs.

constexpr double usual_stretch = 1.5;

OccupancyMap with_cells(const OccupancyMap& map, const Bitmap& blocked) {
  OccupancyMap other;
  other.blocked = blocked;
  other.cell = map.cell;
  other.origin = map.origin;
  other.yaw_rad = map.yaw_rad;
  return other;
}

class Routes {
 public:
  Routes(const RouteRule& route, WaysOverCells& ways, Vec2 goal, const DistanceField* distances,
         const Execution& execution)
      : ways_(ways),
        map_(ways.map()),
        problem_(ways.problem()),
        execution_(execution),
        stretch_(route.stretch.value_or(usual_stretch)),
        hole_(route.hole.value_or(2.0 * problem_.robot.radius)),
        cuts_(ways.wide(), hole_ / map_.cell * (1.0 - 1e-12), execution),
        closed_(with_cells(map_, ways.closed())),
        world_(distances != nullptr ? GridWorld(closed_, problem_.reach(), *distances)
                                    : GridWorld(closed_, problem_.reach(), execution, MapMilestones::none)) {
    problem_.goal = goal;
    if (problem_.reach() > 0.0) {
      holes_.emplace(with_cells(map_, cuts_.cells()), 0.0, execution, MapMilestones::none);
    }
  }

  /// The cheapest first. plain: found where no other ways are asked; it stands for its class where it is as cheap.
  std::vector<AlternativePath> find(std::size_t count, const Path<Vec2>& plain) {
    std::vector<AlternativePath> paths;
    if (auto path = verified(plain)) paths.push_back(std::move(*path));
    for (const ClassPath& way : over_cells(count)) {
      if (auto path = verified(pulled_between_cells(path_over_cells(map_, problem_.start, way.cells, problem_.goal)))) {
        paths.push_back(std::move(*path));
      }
    }
    std::ranges::stable_sort(paths, [](const AlternativePath& a, const AlternativePath& b) { return a.cost < b.cost; });
    while (!paths.empty() && paths.back().cost > stretch_ * paths.front().cost) paths.pop_back();
    keep_one_a_class(paths);
    if (paths.size() > count) paths.resize(count);
    return paths;
  }

  std::vector<MapHole> named(const std::vector<AlternativePath>& paths) const {
    std::set<std::int32_t> ids;
    for (const AlternativePath& path : paths) {
      for (const std::int32_t letter : path.passed) ids.insert(std::abs(letter));
    }
    std::vector<MapHole> holes;
    for (const std::int32_t id : ids) {
      const HoleCuts::Hole& cells = cuts_.holes()[as_whole<std::size_t>(id - 1)];
      const Box box{{1.0 * cells.low.x, 1.0 * cells.low.y}, {cells.high.x + 1.0, cells.high.y + 1.0}};
      holes.push_back({as_whole<std::uint32_t>(id), world_box(map_, box)});
    }
    return holes;
  }
  std::uint64_t expanded() const { return expanded_; }
  double hole() const { return hole_; }

 private:
  std::vector<ClassPath> over_cells(std::size_t count) {
    const auto joined = [&](Vec2 place) {
      return cells_joined_to(map_, ways_.wide(), problem_.reach(), place, execution_);
    };
    // Over cells a way is longer than pulled taut, by up to 1 / cos(pi / 8): so much more may be within the stretch.
    constexpr double longer = 1.0824;
    const ClassChoice choice{count, stretch_ * longer};
    for (const Cell goal : joined(problem_.goal)) {
      const PriceField::Goal goals[] = {{goal}};
      for (const Cell start : joined(problem_.start)) {
        const Cell towards[] = {start};
        PriceField field(ways_.weights(), goals, towards, execution_);
        auto found = cheapest_classes(ways_.weights(), field, cuts_, start, goal, choice, execution_);
        expanded_ += field.expanded();
        if (!found.empty()) return found;
      }
    }
    return {};
  }

  std::vector<std::int32_t> word(const Path<Vec2>& path) const {
    Path<Vec2> in_cells;
    for (const Vec2 p : path) in_cells.push_back(map_point(map_, p));
    return cuts_.word(in_cells);
  }
  bool keeps_off_holes(Vec2 a, Vec2 b) const {
    GridWorld::Query query;
    return !holes_ || holes_->is_free_motion(a, b, query);
  }

  /// In its class: where pulling the whole leads over a hole, its halves are pulled.
  Path<Vec2> pulled(const Path<Vec2>& path) const {
    GridWorld::Query query;
    const PricedLegs legs{[this](Vec2 a, Vec2 b) { return ways_.cost(a, b); },
                          [&](Vec2 a, Vec2 b) { return world_.is_free_motion(a, b, query) && keeps_off_holes(a, b); },
                          map_.cell};
    const Path<Vec2> whole = priced_taut(path, legs, execution_);
    if (path.size() < 3 || word(whole) == word(path)) return whole;
    if (path.size() < 4) return path;
    const auto half = path.begin() + static_cast<std::ptrdiff_t>(path.size() / 2);
    Path<Vec2> both = pulled({path.begin(), half + 1});
    const Path<Vec2> rest = pulled({half, path.end()});
    both.insert(both.end(), rest.begin() + 1, rest.end());
    Path<Vec2> again = priced_taut(both, legs, execution_);
    return word(again) == word(both) ? again : both;
  }

  /// A disc may stand where the middle of its cell may not be: the legs that join it to the cells stay as they are.
  Path<Vec2> pulled_between_cells(const Path<Vec2>& raw) const {
    const bool first = raw.size() > 2 && !keeps_off_holes(raw[0], raw[1]);
    const bool last = raw.size() > 3 && !keeps_off_holes(raw[raw.size() - 2], raw.back());
    if (!first && !last) return pulled(raw);
    Path<Vec2> path = pulled({raw.begin() + (first ? 1 : 0), raw.end() - (last ? 1 : 0)});
    if (first) path.insert(path.begin(), raw.front());
    if (last) path.push_back(raw.back());
    return path;
  }

  /// none: not free between an end and the middle of its cell.
  std::optional<AlternativePath> verified(Path<Vec2> way) const {
    AlternativePath path;
    path.path = std::move(way);
    path.passed = word(path.path);
    const Verification verdict = verify_on_map(map_, path.path, verify_options(problem_), execution_);
    if (!verdict.verified) return std::nullopt;
    path.length = verdict.length;
    path.min_clearance = verdict.min_clearance;
    for (std::size_t i = 1; ways_.is_priced() && i < path.path.size(); ++i) {
      const PriceParts leg = ways_.parts(path.path[i - 1], path.path[i]);
      path.price.clearance += leg.clearance;
      path.price.areas += leg.areas;
    }
    path.cost = path.length + path.price.sum();
    return path;
  }

  /// The cheapest, by the judge's cuts as well as by those that answers tell: the path that was found without
  /// alternatives is of another one's class, and one over the cells of a hole may be of two.
  void keep_one_a_class(std::vector<AlternativePath>& paths) const {
    std::vector<Path<Vec2>> all;
    for (const AlternativePath& path : paths) all.push_back(path.path);
    const ClassRule rule{problem_.reach(), hole_};
    JudgedClasses judged = judged_classes(closed_, rule, all, execution_);
    for (auto* classes : {&judged.classes, &judged.told}) {
      while (const auto same = same_class(*classes)) {
        const auto dearer = static_cast<std::ptrdiff_t>(same->second);
        paths.erase(paths.begin() + dearer);
        for (auto* list : {&judged.classes, &judged.told}) list->erase(list->begin() + dearer);
      }
    }
  }

  WaysOverCells& ways_;
  const OccupancyMap& map_;
  WallProblem problem_;  // its goal is the one that is reached
  const Execution& execution_;
  double stretch_;
  double hole_;
  HoleCuts cuts_;
  OccupancyMap closed_;
  GridWorld world_;                 // of the body's middle
  std::optional<GridWorld> holes_;  // what makes classes, to a point; none: world_ says it
  std::uint64_t expanded_ = 0;
};

}  // namespace

GoalChoice choose_goal(WaysOverCells& ways, std::span<const std::vector<double>> via, bool open_end) {
  return Choosing(ways, open_end).chosen(via);
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

void take_alternatives(Answer& answer, const RouteRule& route, WaysOverCells& ways, const DistanceField* distances,
                       const Execution& execution) {
  const GoalRule& rule = ways.problem().rule;
  if (!rule.visit.empty() || rule.back || rule.region) {
    throw UsageError(
        "@alternatives: are of ways from a start to a goal; places to visit and regions leave no such two");
  }
  const Vec2 goal = answer.path.back();
  if (ways.problem().start == goal) return;
  const StageTimer timer(execution, "alternatives", answer.seconds.optimise, ways.map().blocked.size());
  Routes routes(route, ways, goal, distances, execution);
  std::vector<AlternativePath> paths = routes.find(std::size_t{1} + *route.alternatives, answer.path);
  answer.counters.expanded += routes.expanded();
  if (paths.empty()) return;
  answer.holes = routes.named(paths);
  AlternativePath& own = paths.front();
  answer.path = std::move(own.path);
  answer.length = own.length;
  answer.min_clearance = own.min_clearance;
  answer.passed = std::move(own.passed);
  if (ways.is_priced()) {
    answer.price = own.price;
    answer.cost = own.cost;
  }
  paths.erase(paths.begin());
  answer.alternatives = std::move(paths);
  if (!answer.passed.empty() || !answer.alternatives.empty()) answer.hole_size = routes.hole();
}

}  // namespace warren
