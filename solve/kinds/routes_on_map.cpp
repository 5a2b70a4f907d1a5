// SPDX-License-Identifier: BSD-3-Clause
// The cheapest path of each of the cheapest homotopy classes on a map, pulled taut in its class, for points and discs
// (goals_on_map.hpp).

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "planners/grid/path_classes.hpp"
#include "planners/shorten/priced_taut.hpp"
#include "solve/kinds/goals_on_map.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "verify/judges/verify_classes.hpp"
#include "verify/judges/verify_map.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren {
namespace {

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
  Routes(const RouteRule& route, const RoutesAsked& asked, const Execution& execution)
      : asked_(asked),
        execution_(execution),
        stretch_(route.stretch.value_or(usual_stretch)),
        hole_(route.hole.value_or(2.0 * asked.problem.robot.radius)),
        cuts_(asked.wide, hole_ / asked.map.cell * (1.0 - 1e-12), execution),
        closed_(with_cells(asked.map, asked.closed)),
        world_(asked.distances != nullptr ? GridWorld(closed_, asked.problem.reach(), *asked.distances)
                                          : GridWorld(closed_, asked.problem.reach(), execution, MapMilestones::none)) {
    if (asked.problem.reach() > 0.0) {
      holes_.emplace(with_cells(asked.map, cuts_.cells()), 0.0, execution, MapMilestones::none);
    }
  }

  /// The cheapest first. plain: found where no other ways are asked; it stands for its class where it is as cheap.
  std::vector<AlternativePath> find(std::size_t count, const Path<Vec2>& plain) {
    std::vector<AlternativePath> paths;
    if (auto path = verified(plain)) paths.push_back(std::move(*path));
    for (const ClassPath& way : over_cells(count)) {
      if (auto path = verified(pulled_between_cells(
              path_over_cells(asked_.map, asked_.problem.start, way.cells, asked_.problem.goal)))) {
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
      holes.push_back({as_whole<std::uint32_t>(id), world_box(asked_.map, box)});
    }
    return holes;
  }
  std::uint64_t expanded() const { return expanded_; }
  double hole() const { return hole_; }

 private:
  std::vector<ClassPath> over_cells(std::size_t count) {
    const auto own_start = cell_at(asked_.map, asked_.problem.start);
    const auto own_goal = cell_at(asked_.map, asked_.problem.goal);
    if (!own_start || !own_goal) return {};
    const auto joined = [&](Vec2 place, Cell own) {
      return cells_joined_to(asked_.map, asked_.wide, asked_.problem.reach(), place, own, execution_);
    };
    // Over cells a way is longer than pulled taut, by up to 1 / cos(pi / 8): so much more may be within the stretch.
    constexpr double longer = 1.0824;
    const ClassChoice choice{count, stretch_ * longer};
    for (const Cell goal : joined(asked_.problem.goal, *own_goal)) {
      const PriceField::Goal goals[] = {{goal}};
      for (const Cell start : joined(asked_.problem.start, *own_start)) {
        const Cell towards[] = {start};
        PriceField field(asked_.weights, goals, towards, execution_);
        auto found = cheapest_classes(asked_.weights, field, cuts_, start, goal, choice, execution_);
        expanded_ += field.expanded();
        if (!found.empty()) return found;
      }
    }
    return {};
  }

  double cost(Vec2 a, Vec2 b) const { return asked_.prices.cost ? asked_.prices.cost(a, b) : distance(a, b); }
  std::vector<std::int32_t> word(const Path<Vec2>& path) const {
    Path<Vec2> in_cells;
    for (const Vec2 p : path) in_cells.push_back(map_point(asked_.map, p));
    return cuts_.word(in_cells);
  }
  bool keeps_off_holes(Vec2 a, Vec2 b) const {
    GridWorld::Query query;
    return !holes_ || holes_->is_free_motion(a, b, query);
  }

  /// In its class: where pulling the whole leads over a hole, its halves are pulled.
  Path<Vec2> pulled(const Path<Vec2>& path) const {
    GridWorld::Query query;
    const PricedLegs legs{[this](Vec2 a, Vec2 b) { return cost(a, b); },
                          [&](Vec2 a, Vec2 b) { return world_.is_free_motion(a, b, query) && keeps_off_holes(a, b); },
                          asked_.map.cell};
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
    const Verification verdict = verify_on_map(asked_.map, path.path, verify_options(asked_.problem), execution_);
    if (!verdict.verified) return std::nullopt;
    path.length = verdict.length;
    path.min_clearance = verdict.min_clearance;
    if (asked_.parts) {
      for (std::size_t i = 1; i < path.path.size(); ++i) {
        const PriceParts leg = asked_.parts(path.path[i - 1], path.path[i]);
        path.price.clearance += leg.clearance;
        path.price.areas += leg.areas;
      }
    }
    path.cost = path.length + path.price.sum();
    return path;
  }

  /// The cheapest, by the judge's cuts as well as by those that answers tell. Only the path that was found without
  /// alternatives is of another one's class.
  void keep_one_a_class(std::vector<AlternativePath>& paths) const {
    std::vector<Path<Vec2>> all;
    for (const AlternativePath& path : paths) all.push_back(path.path);
    const ClassRule rule{asked_.problem.reach(), hole_};
    JudgedClasses judged = judged_classes(closed_, rule, all, execution_);
    for (auto* classes : {&judged.classes, &judged.told}) {
      while (const auto same = same_class(*classes)) {
        const auto dearer = static_cast<std::ptrdiff_t>(same->second);
        paths.erase(paths.begin() + dearer);
        for (auto* list : {&judged.classes, &judged.told}) list->erase(list->begin() + dearer);
      }
    }
    if (paths.size() + 1 < all.size()) throw std::logic_error("two alternatives are of one class by the judge's cuts");
  }

  const RoutesAsked& asked_;
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

void take_alternatives(Answer& answer, const RouteRule& route, const RoutesAsked& asked, const Execution& execution) {
  const GoalRule& rule = asked.problem.rule;
  if (!rule.visit.empty() || rule.back || rule.region) {
    throw UsageError(
        "@alternatives: are of ways from a start to a goal; places to visit and regions leave no such two");
  }
  if (asked.problem.start == asked.problem.goal) return;
  const StageTimer timer(execution, "alternatives", answer.seconds.optimise, asked.map.blocked.size());
  Routes routes(route, asked, execution);
  std::vector<AlternativePath> paths = routes.find(std::size_t{1} + *route.alternatives, answer.path);
  answer.counters.expanded += routes.expanded();
  if (paths.empty()) return;
  answer.holes = routes.named(paths);
  AlternativePath& own = paths.front();
  answer.path = std::move(own.path);
  answer.length = own.length;
  answer.min_clearance = own.min_clearance;
  answer.passed = std::move(own.passed);
  if (asked.parts) {
    answer.price = own.price;
    answer.cost = own.cost;
  }
  paths.erase(paths.begin());
  answer.alternatives = std::move(paths);
  if (!answer.passed.empty() || !answer.alternatives.empty()) answer.hole_size = routes.hole();
}

}  // namespace warren
