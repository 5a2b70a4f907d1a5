// SPDX-License-Identifier: BSD-3-Clause
// A point or disc on an occupancy map: grid over its cells, voronoi along the skeleton of those that are free, and the
// planners that sample. Polygons on maps turn among the map's border walls (solve/kinds/solve_turning).

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "planners/grid/grid_search.hpp"
#include "planners/grid/skeleton_planner.hpp"
#include "planners/shorten/shortcut.hpp"
#include "planners/shorten/taut_path.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/goals_on_map.hpp"
#include "solve/kinds/kept_ways.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/question/planner_choice.hpp"
#include "spatial/maps/free_cells.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/plane/grid_world.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {
namespace {

/// A path cut where it first comes as near to a place.
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

/// Left empty where nothing is priced.
const MapPrices* take_prices(std::optional<MapPrices>& prices, const OccupancyMap& map, const WallProblem& problem,
                             const Execution& execution) {
  if (!problem.prices.empty()) prices.emplace(map, problem.robot.radius, problem.prices, execution);
  if (prices && !prices->is_priced()) prices.reset();
  return prices ? &*prices : nullptr;
}

/// Does the question name no goal but places to visit?
bool has_open_end(const SolveRequest& request) {
  const GoalRule& rule = request.question.rule;
  return !rule.visit.empty() && !rule.back && request.question.goal.empty() && request.scene.goal.empty();
}

/// What the cells have decided, in the answer; `outcome`: of who plans to it.
void take_choice(Answer& answer, const GoalChoice& choice, Outcome outcome) {
  answer.outcome = outcome;
  if (choice.outcome == Outcome::solved) take_goal(answer.problem, {choice.goal.x, choice.goal.y}, choice.goal_index);
  answer.goal_index = choice.goal_index;
  answer.goal_reached = choice.reached;
  answer.order = choice.order;
  if (choice.nearest) {
    answer.figures.push_back({"nearest_reachable_x", choice.nearest->x});
    answer.figures.push_back({"nearest_reachable_y", choice.nearest->y});
  }
}

/// What the cells do not join may be proved to be apart: all places that would do.
void prove_apart(Answer& answer, const OccupancyMap& map, const Bitmap& closed, const WallProblem& problem,
                 const std::vector<Vec2>& places, const Execution& execution) {
  if (answer.outcome != Outcome::not_connected || places.empty()) return;
  const StageTimer timer(execution, "proof", answer.seconds.search);
  const bool apart = std::ranges::all_of(places, [&](Vec2 place) {
    WallProblem to_place = problem;
    to_place.goal = place;
    return provably_apart(map, closed, to_place, execution);
  });
  if (apart) answer.outcome = Outcome::infeasible;
}

/// One solve by grid: the steps share the question and fill in the answer. What is not found may be proved infeasible.
class CellSolve {
 public:
  explicit CellSolve(const SolveRequest& request)
      : request_(request),
        map_(*request.scene.map),
        problem_(map_problem(request.scene, request.question)),
        chooses_(!problem_.rule.empty() || !request.options.trees.via.empty()) {
    {
      const StageTimer timer(request.execution, "index", answer_.seconds.index, map_.blocked.size());
      const bool keeps = request.kept != nullptr && !problem_.prices.empty() && map_.water.empty();
      if (keeps && request.kept->update(map_, problem_, request.execution)) {
        kept_ = request.kept;
        prices_ = &kept_->prices();
      } else {
        prices_ = take_prices(own_prices_, map_, problem_, request.execution);
      }
    }
    if (prices_ && request.options.grid.diagonal) {
      throw UsageError("@diagonal: where ways have a price steps weigh what they cost; leave it out");
    }
    if ((chooses_ || prices_) && request.options.search) {
      throw UsageError("@search: prices, choices of goals and stops take one field over the cells; leave it out");
    }
    grid_.diagonal = request.options.grid.diagonal.value_or(Diagonal::sqrt2);
    grid_.method =
        grid_method(request.options, grid_.diagonal == Diagonal::sqrt2 ? GridMethod::jump_points : GridMethod::astar);
    if (grid_.method == GridMethod::jump_points && grid_.diagonal != Diagonal::sqrt2) {
      throw UsageError("@search: jump points need @diagonal sqrt2");
    }
    answer_.problem = problem_.general();
    answer_.planner = name_of(PlannerKind::grid);
    answer_.seed = request.options.seed;
    if (request.options.optimise) answer_.options.push_back({"optimise", true});
    if (const auto gap = request.options.anytime.gap) answer_.options.push_back({"gap", *gap});
    if (request.options.grid.diagonal) answer_.options.push_back({"diagonal", std::string(name_of(grid_.diagonal))});
  }

  void run() {
    chooses_ || prices_ ? run_chosen() : run_to_goal();
    const RouteRule& route = request_.question.route;
    if (!route.alternatives || !answer_.verified) return;
    take_alternatives(answer_, route, ways(), distances(), request_.execution);
  }
  Answer& answer() { return answer_; }

 private:
  void run_to_goal() {
    answer_.outcome = judge_of(request_, problem_).settled(Outcome::start_blocked);
    if (answer_.outcome != Outcome::not_connected) return;
    index();
    choose_method();
    if (problem_.start == problem_.goal) {
      stay(answer_, problem_);
      count(1, 0.0);
    } else {
      search(joined(problem_.start), joined(problem_.goal));
      if (answer_.outcome != Outcome::solved)
        return prove_apart(answer_, map_, closed_, problem_, {problem_.goal}, request_.execution);
    }
    if (wants_taut()) optimise();
    judge_of(request_, problem_).verify_solved(answer_, true);
  }

  /// Where there is more to decide than the way to one place.
  void run_chosen() {
    if (!judge_of(request_, problem_).stands_free(problem_.start)) {
      answer_.outcome = Outcome::start_blocked;
      return;
    }
    index();
    const GoalChoice choice = choose();
    take_choice(answer_, choice, choice.outcome);
    if (choice.outcome != Outcome::solved)
      return prove_apart(answer_, map_, closed_, problem_, choice.unreached, request_.execution);
    WallProblem reached = problem_;
    reached.goal = choice.goal;
    take_ways(choice);
    if (problem_.rule.region) {
      const std::vector<double>& asked = answer_.goal_reached->asked;
      reached.goal = answer_.path.back();
      answer_.goal_reached->distance = distance(reached.goal, Vec2{asked[0], asked[1]});
      answer_.problem.goal = {reached.goal.x, reached.goal.y};
    }
    judge_of(request_, reached).verify_solved(answer_, true);
    if (!prices_ || !answer_.verified) return;
    answer_.lower_bound =
        bound_of_choice(problem_.start, problem_.goal, problem_.rule, has_open_end(request_), off_goal(answer_));
  }

  GoalChoice choose() {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search, map_.blocked.size());
    answer_.search = "field";
    GoalChoice choice = choose_goal(ways(), request_.options.trees.via, has_open_end(request_));
    answer_.counters.expanded += ways().expanded();
    return choice;
  }
  WaysOverCells& ways() {
    if (!ways_) {
      ways_.emplace(map_, problem_, closed_, blocked(), grid_.diagonal, prices_, &scratch(), request_.execution, kept_);
    }
    return *ways_;
  }

  /// Leg by leg, so that no stop is cut off; the last one ends where it comes into the region.
  void take_ways(const GoalChoice& choice) {
    std::uint64_t cells = 0;
    std::uint64_t weight = 0;
    double cost = 0.0;
    double raw = 0.0;
    Path<Vec2> whole{problem_.start};
    for (const WaysOverCells::Way& way : choice.ways) {
      cells += way.cells.size();
      weight += way.cost;
      cost += cost_of(way.cells, grid_.diagonal);
      answer_.path = path_over_cells(map_, way.from, way.cells, way.end.place);
      if (wants_taut()) optimise();
      raw += answer_.raw_length.value_or(0.0);
      if (problem_.rule.region && &way == &choice.ways.back()) {
        const std::vector<double>& asked = answer_.goal_reached->asked;
        answer_.path = cut_at_region(std::move(answer_.path), {asked[0], asked[1]}, *problem_.rule.region);
      }
      whole.insert(whole.end(), answer_.path.begin() + 1, answer_.path.end());
    }
    if (answer_.raw_length) answer_.raw_length = raw;
    answer_.path = std::move(whole);
    count(cells, cost);
    if (prices_) {
      const double in_cells = static_cast<double>(weight) / static_cast<double>(units_a_cell);
      answer_.path_figures.push_back({"cells_cost", in_cells * map_.cell});
    }
  }

  MapPrices::Scratch& scratch() { return kept_ != nullptr ? kept_->scratch() : scratch_; }
  /// Paths over cells alone are farther from any bound than gaps that are asked for.
  bool wants_taut() const { return prices_ || request_.options.optimise || request_.options.anytime.gap; }

  void index() {
    const StageTimer timer(request_.execution, "index", answer_.seconds.index, map_.blocked.size());
    closed_ = closed_cells(map_, problem_.start);
    const double reach = problem_.reach() / map_.cell;
    const DistanceField* made = distances();
    if (kept_ != nullptr) {
      blocked_ = kept_->wide();
    } else if (reach > 0.0) {
      blocked_ = made != nullptr ? blocked_for_disc(closed_, *made, reach, request_.execution)
                                 : blocked_for_disc(closed_, reach, request_.execution);
    }
  }
  /// Of closed_, where there are any; nullptr otherwise.
  const DistanceField* distances() const { return prices_ && map_.water.empty() ? prices_->distances() : nullptr; }
  const Bitmap& blocked() const { return blocked_.empty() ? closed_ : blocked_; }
  std::vector<Cell> joined(Vec2 p) const {
    return cells_joined_to(map_, blocked(), problem_.reach(), p, request_.execution);
  }

  void choose_method() {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search);
    const bool asked = request_.options.search || grid_.diagonal == Diagonal::none;
    if (!asked && !has_diagonal_steps(blocked(), request_.execution))
      grid_.method = GridMethod::bfs;  // mazes: as short, and faster
    answer_.search = name_of(grid_.method);
  }

  void search(const std::vector<Cell>& starts, const std::vector<Cell>& goals) {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search);
    GridSearch cells(blocked(), request_.execution);
    for (const Cell start : starts) {
      for (const Cell goal : goals) {
        const GridPath path = cells.find(start, goal, grid_, request_.execution);
        answer_.counters.expanded += path.expanded;
        if (path.status != SearchStatus::found) continue;
        answer_.outcome = Outcome::solved;
        count(path.cells.size(), path.cost);
        answer_.path = path_over_cells(map_, problem_.start, path.cells, problem_.goal);
        return;
      }
    }
  }

  void count(std::uint64_t cells, double cost) {
    answer_.cost = cost;
    answer_.path_figures.push_back({"cells", cells});
  }

  /// Off the grid: motions between any two points, certified against the closed cells.
  void optimise() {
    const StageTimer timer(request_.execution, "optimise", answer_.seconds.optimise, answer_.path.size());
    OccupancyMap map = map_;
    map.blocked = closed_;
    const GridWorld world = distances() != nullptr ? GridWorld(map, problem_.reach(), *distances())
                                                   : GridWorld(map, problem_.reach(), request_.execution);
    answer_.raw_length = path_length(answer_.path, GridWorld::distance);
    if (prices_) return pull(world);
    answer_.path = planned<Vec2>().shorter(WorldView(world), std::move(answer_.path), GridWorld::distance,
                                           {.seed = answer_.seed}, request_.execution, answer_.counters);
  }

  /// Under the price, off the grid.
  void pull(const GridWorld& world) {
    GridWorld::Query query = world.make_query();
    const PricedLegs legs{[&](Vec2 a, Vec2 b) {
                            if (kept_ == nullptr) return prices_->cost(a, b, scratch_);
                            std::optional<double>& known = kept_->leg(a, b).cost;
                            if (!known) known = prices_->cost(a, b, scratch());
                            return *known;
                          },
                          [&](Vec2 a, Vec2 b) {
                            ++answer_.counters.edges_checked;
                            std::optional<bool> known;
                            std::optional<bool>& told = kept_ != nullptr ? kept_->leg(a, b).is_free : known;
                            if (!told) told = world.is_free_motion(a, b, query);
                            const bool free = *told;
                            answer_.counters.edges_free += free ? 1 : 0;
                            return free;
                          },
                          map_.cell};
    answer_.path = priced_taut(std::move(answer_.path), legs, request_.execution);
  }

  const SolveRequest& request_;
  const OccupancyMap& map_;
  WallProblem problem_;
  bool chooses_;
  KeptWays* kept_ = nullptr;
  std::optional<MapPrices> own_prices_;  // where none are kept
  const MapPrices* prices_ = nullptr;    // where something is priced
  MapPrices::Scratch scratch_;
  GridSearchOptions grid_;
  Bitmap closed_;   // to a point
  Bitmap blocked_;  // to a disc's middle; empty: the robot is a point
  std::optional<WaysOverCells> ways_;
  Answer answer_;
};

/// For prm, lazy-prm, rrt and rrt-connect. Motions are certified against the closed squares of blocked cells, wherever
/// between them they lead.
class BodyOnMap : public PointBody<MapPrices> {
 public:
  using World = GridWorld;
  static void suit(RrtOptions& options) {
    if (!options.sampler) options.sampler = SamplerKind::uniform;
  }

  explicit BodyOnMap(const SolveRequest& request)
      : PointBody(request, map_problem(request.scene, request.question)), map_(*request.scene.map) {}

  SamplerKind choose_sampler(const SolveOptions& options, const RoadmapOptions& roadmap) const {
    const bool free_choice = !options.sampler && !roadmap.samples;
    return free_choice && is_narrow(map_.blocked) ? SamplerKind::cell_centres : roadmap.sampler;
  }
  void index(std::optional<World>& world, SamplerKind sampler) const {
    const MapMilestones milestones = sampler == SamplerKind::corridor       ? MapMilestones::corridors
                                     : sampler == SamplerKind::cell_centres ? MapMilestones::cell_centres
                                                                            : MapMilestones::anywhere;
    if (map_.water.empty()) {
      world.emplace(map_, problem_.reach(), execution_, milestones);
      return;
    }
    OccupancyMap map = map_;
    map.blocked = closed_cells(map_, problem_.start);
    world.emplace(map, problem_.reach(), execution_, milestones);
  }
  bool provably_apart(const World& world, const std::vector<Vec2>&) const {
    return warren::provably_apart(world.map(), world.map().blocked, problem_, execution_);
  }
  const MotionLength<Vec2>& price_motions(const World& world) { return price_in(world.map(), execution_); }
  Path<Vec2> shortened(const World& world, Path<Vec2> path, Answer& answer) const {
    if (cost_) return pulled_taut(world, std::move(path), cost_, map_.cell, execution_);
    return shortcut(world, std::move(path), World::distance, answer);
  }

 private:
  const OccupancyMap& map_;
};

/// By a planner that samples, or along the skeleton.
Answer solve_to_place(const SolveRequest& request) {
  return request.planner == PlannerKind::voronoi ? solve_on_skeleton(request) : solve_sampled<BodyOnMap>(request);
}

/// The planner reaches what the cells have chosen: the path's stops and its goal.
Answer solve_chosen(const SolveRequest& request) {
  const WallProblem problem = map_problem(request.scene, request.question);
  const OccupancyMap& map = *request.scene.map;
  Answer chosen;
  chosen.problem = problem.general();
  chosen.planner = name_of(request.planner);
  chosen.seed = request.options.seed;
  chosen.options = given_figures(request.options);
  GoalChoice choice;
  answer_within_limits(chosen, [&] {
    const StageTimer timer(request.execution, "search", chosen.seconds.search, map.blocked.size());
    if (!judge_of(request, problem).stands_free(problem.start)) {
      chosen.outcome = Outcome::start_blocked;
      return;
    }
    const Bitmap closed = closed_cells(map, problem.start);
    const Bitmap wide = blocked_for_disc(closed, problem.reach() / map.cell, request.execution);
    std::optional<MapPrices> prices;
    const MapPrices* priced = take_prices(prices, map, problem, request.execution);
    MapPrices::Scratch scratch;
    WaysOverCells ways(map, problem, closed, wide, Diagonal::sqrt2, priced, &scratch, request.execution);
    choice = choose_goal(ways, {}, has_open_end(request));
    chosen.counters.expanded += ways.expanded();
    take_choice(chosen, choice, choice.outcome);
    if (choice.outcome != Outcome::solved)
      prove_apart(chosen, map, closed, problem, choice.unreached, request.execution);
  });
  if (choice.outcome != Outcome::solved) return chosen;
  Question question = request.question;
  question.goal = {choice.goal.x, choice.goal.y};
  question.rule = {};
  std::vector<std::vector<double>> stops;
  for (const Vec2 stop : choice.stops) stops.push_back({stop.x, stop.y});
  const SolveRequest to_goal{request.options,   request.scene, question,     request.planner,
                             request.execution, request.keep,  request.asked};
  Answer answer =
      stops.empty() ? solve_to_place(to_goal) : solve_through(to_goal, stops, visited_place, solve_to_place);
  answer.options = given_figures(request.options);
  answer.problem = problem.general();
  answer.counters.expanded += chosen.counters.expanded;
  answer.seconds.search += chosen.seconds.search;
  answer.solve_s += chosen.solve_s;
  take_choice(answer, choice, answer.outcome);
  const bool is_one_place = problem.rule.others.empty() && !problem.rule.region;
  const auto bound =
      bound_of_choice(problem.start, problem.goal, problem.rule, has_open_end(request), off_goal(answer));
  if (answer.verified && (bound || !is_one_place)) take_bound_of_choice(answer, bound);
  return answer;
}

/// What was found along the skeleton, in the world's coordinates.
void take_skeleton_path(Answer& answer, const SkeletonPath& plan, const OccupancyMap& map, const WallProblem& problem) {
  answer.outcome = plan.outcome;
  answer.separation = plan.separation;
  answer.separation.nearest_gap *= map.cell;
  for (std::array<double, 2>* place : {&answer.separation.near_start, &answer.separation.near_goal}) {
    const Vec2 in_world = world_point(map, {(*place)[0], (*place)[1]});
    *place = {in_world.x, in_world.y};
  }
  answer.roadmap = plan.roadmap;
  answer.counters.expanded = plan.counters.expanded;
  answer.seconds += plan.seconds;
  if (plan.outcome != Outcome::solved) return;
  answer.path = path_over_cells(map, problem.start, plan.path, problem.goal);
  answer.path_figures.push_back({"cells", std::uint64_t{plan.path.size()}});
  answer.path_figures.push_back({"axis_clearance", plan.clearance * map.cell});
}

constexpr PlannerChoice occupancy_planners[] = {
    {PlannerKind::grid, OptionSet{Option::search, Option::diagonal, Option::optimise, Option::bound, Option::gap},
     choice_words | price_words | restriction_words | route_words},
    {PlannerKind::prm, prm_takes | point_takes, choice_words | price_words | restriction_words},
    {PlannerKind::lazy_prm, lazy_prm_takes | point_takes, choice_words | price_words | restriction_words},
    {PlannerKind::rrt, rrt_options, choice_words | restriction_words},
    {PlannerKind::rrt_connect, rrt_connect_options, choice_words | restriction_words},
    {PlannerKind::rrt_star, rrt_star_options, choice_words | restriction_words},
    {PlannerKind::informed_rrt_star, rrt_star_options, choice_words | restriction_words},
    {PlannerKind::anytime, anytime_options, choice_words | restriction_words},
    {PlannerKind::voronoi, OptionSet{Option::objective, Option::search, Option::queue, Option::bound},
     restriction_words | AskedWords{AskedWord::goal}}};

Answer solve_occupancy(const SolveRequest& request) {
  if (request.planner == PlannerKind::grid) return answered(CellSolve(request));
  const std::vector<std::vector<double>>& via = request.options.trees.via;
  if (!via.empty()) return solve_through(request, via, way_point, solve_occupancy);
  return rule_of(request.scene, request.question).empty() ? solve_to_place(request) : solve_chosen(request);
}

Verdict recheck_occupancy(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                          const Execution& execution) {
  check_state_width(answer, 2, "a point or disc");
  const WallProblem problem = map_problem(scene, question);
  return {verify_on_map(*scene.map, answer.path, verify_options(problem), execution), problem.general()};
}

}  // namespace

/// As far from what is blocked as a path can be. min_clearance of the answer is measured on the path by the
/// verification.
Answer solve_on_skeleton(const SolveRequest& request) {
  const WallProblem problem = map_problem(request.scene, request.question);
  const OccupancyMap& map = *request.scene.map;
  const SearchChoice search = search_choice(request.options);
  const SkeletonOptions options{.objective = request.options.axis.objective.value_or(AxisObjective::length),
                                .search = search.search,
                                .queue = search.queue};
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.push_back({"objective", std::string(name_of(options.objective))});
  answer_within_limits(answer, [&] {
    const PointJudge judge = judge_of(request, problem);
    answer.outcome = judge.settled(Outcome::start_blocked);
    if (is_blocked(answer.outcome)) return;  // what lies outside of the map is
    const Cell start = *cell_at(map, problem.start);
    const Cell goal = *cell_at(map, problem.goal);
    std::vector<std::pair<Cell, Cell>> steps;
    auto* kept = request.keep != nullptr ? &steps : nullptr;
    const SkeletonRoadmap* known = asked_roadmap<SkeletonRoadmap>(request);
    std::optional<SkeletonRoadmap> made;
    if (known == nullptr) {
      const StageTimer timer(request.execution, "index", answer.seconds.index, map.blocked.size());
      known = &made.emplace(closed_cells(map, problem.start), problem.reach() / map.cell, request.execution);
    }
    take_skeleton_path(answer, plan_on_skeleton(*known, start, goal, options, request.execution, kept), map, problem);
    // The skeleton was asked about the middles of the cells.
    if (is_blocked(answer.outcome)) answer.outcome = Outcome::not_connected;
    if (problem.start == problem.goal) stay(answer, problem);
    if (request.keep != nullptr) {
      NamedLines& axis = request.keep->lines.emplace_back(NamedLines{"medial_axis", {}});
      for (const auto& [from, to] : steps) axis.lines.add(std::array{cell_centre(map, from), cell_centre(map, to)});
    }
    judge.verify_solved(answer, true);
  });
  return answer;
}

SolveKind occupancy_kind() {
  SolveKind kind{"a point or disc on an occupancy map",
                 [](const Scene& scene, const RobotSpec& robot) { return scene.map && is_round(robot); },
                 occupancy_planners,
                 usually<PlannerKind::grid>,
                 solve_occupancy,
                 recheck_occupancy,
                 build_sampled_or_geometric<BodyOnMap>,
                 open_sampled_or_geometric<BodyOnMap>};
  kind.chooses_goal = true;
  return kind;
}

}  // namespace warren
