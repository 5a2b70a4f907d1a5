// SPDX-License-Identifier: BSD-3-Clause
// One solve by a planner that samples, whatever the body: index, plan, settle what is said of blocked ends, shorten,
// verify. Roadmaps try the states that will do as the goal one after the other, the best first, until one is reached;
// trees have all of them as goals at once. What can't be reached at all, where that is proved, bounds the growth. Where
// there is no path, the answer's `cause` says why.
//
// A Body is what differs:
//   World, and State = World::State
//   has_cost                               do planners that get better make another measure small than the length?
//   improved(world, path, how, execution, counters)   the path with less cost, on any thread
//   improves_by_draws                      else improved() of an improved path is that path
//   problem()                              as the answer repeats it
//   start(), goals(world)                  all states that will do as the goal; of those that are too many, free ones
//   knows_all_goals(), goals_tried()       where it has no goal: is there none, and else how many were tried?
//   best_first(world, goals)               in the order in which roadmaps try them
//   choose_sampler(options)                what is asked for, or what suits; throws UsageError for what is not for it
//   index(world, sampler)                  emplaces the world
//   provably_apart(world, goals)           is it proved that no path leads to any of the goals?
//   start_stands_free(), goal_stands_free(state)   by the verification
//   length(world, a, b)                    of a motion: what shortening shortens
//   shortened(world, path, answer)         the path made shorter
//   on_lattice(world, goals, answer)       of planner grid, where there is one: a path over its lattice
//   judge(world, path, answer)             verifies; fills in the path and what is said of it
//   cause_of_blocked(world, outcome, goals)
//   price_motions(world)                   what motions cost beyond their distance; empty: nothing, or not there
//   take_prices(cost)                      the same of a roadmap that is asked, where shortening needs it
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "planners/anytime/anytime.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/grid/motion_lattice.hpp"
#include "planners/shorten/shortcut.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "solve/kinds/priced_motions.hpp"
#include "solve/kinds/sampled_roadmap.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {
/// What most bodies of sampled_solve.hpp and sampled_roadmap.hpp have in common. Asked: WallProblem, PoseProblem or
/// ArmProblem.
template <class Asked>
class UsualBody {
 public:
  static constexpr bool names_pipeline = false;
  static constexpr bool has_cost = false;          ///< is what the planners make small another measure than the length?
  static constexpr bool improves_by_draws = true;  ///< does improved() make use of its seed?

  Problem problem() const { return problem_.general(); }
  const auto& start() const { return problem_.start; }
  /// What nobody asked for of the trees.
  static void suit(RrtOptions&) {}
  static SamplerKind choose_sampler(const SolveOptions&, const RoadmapOptions& roadmap) { return roadmap.sampler; }

  template <class World, class State>
  static std::vector<State> best_first(const World&, const std::vector<State>& goals) {
    return goals;
  }
  template <class World, class State>
  static bool provably_apart(const World&, const std::vector<State>&) {
    return false;
  }
  template <class World, class State>
  static double length(const World& world, const State& a, const State& b) {
    return world.distance(a, b);
  }
  template <class World>
  static Path<typename World::State> improved(const World& world, const Path<typename World::State>& path,
                                              const ImproveOptions& how, const Execution& execution,
                                              Counters& counters) {
    using State = typename World::State;
    const auto cost = [&](const State& a, const State& b) { return world.distance(a, b); };
    return planned_in<World>().improved(WorldView(world), path, cost, how, execution, counters);
  }
  static std::uint64_t goals_tried() { return 0; }
  static bool knows_all_goals() { return true; }
  static std::optional<GrowingAttach> attach(const SolveOptions&) { return std::nullopt; }
  template <class World, class Goals>
  static std::string_view cause_of_blocked(const World&, Outcome outcome, const Goals&) {
    return outcome == Outcome::start_blocked ? "start_in_collision" : "goal_in_collision";
  }

 protected:
  /// Refers to what the request does.
  UsualBody(const SolveRequest& request, Asked problem)
      : scene_(request.scene),
        execution_(request.execution),
        judged_(request.asked.judged()),
        problem_(std::move(problem)) {}
  template <class World, class State, class Length>
  Path<State> shortcut(const World& world, Path<State> path, const Length& length, Answer& answer) const {
    return planned_in<World>().shorter(WorldView(world), std::move(path), length, {.seed = answer.seed}, execution_,
                                       answer.counters);
  }

  const Scene& scene_;
  const Execution& execution_;
  const ObstacleIndex* judged_;  // of the scene, or nullptr
  Asked problem_;
};

/// A point or disc, whatever is around it. Prices: what legs cost there.
template <class Prices>
class PointBody : public UsualBody<WallProblem> {
 public:
  template <class World>
  std::vector<Vec2> goals(const World&) const {
    return {problem_.goal};
  }
  bool start_stands_free() const { return point_judge().stands_free(problem_.start); }
  bool goal_stands_free(Vec2 goal) const { return point_judge().goal_stands_free(goal); }
  void take_prices(const MotionLength<Vec2>& cost) { cost_ = cost; }
  template <class World>
  void judge(const World&, Path<Vec2> path, Answer& answer) const {
    answer.path = std::move(path);
    point_judge().verify_solved(answer);
  }

 protected:
  using UsualBody::UsualBody;
  PointJudge point_judge() const { return {scene_, problem_, execution_, judged_}; }
  /// where, more: as the prices take them.
  template <class Where, class... More>
  const MotionLength<Vec2>& price_in(const Where& where, const More&... more) {
    if (problem_.prices.empty()) return cost_;
    return cost_ = motion_cost(prices_.emplace(where, problem_.robot.radius, problem_.prices, more...));
  }

  MotionLength<Vec2> cost_;  // empty: nothing has a price

 private:
  std::optional<Prices> prices_;
};

/// A polygon or car: a goal X,Y without a heading is met in any: as the body started, and as poses_to_meet() has them.
/// Roadmaps try those first that have at least half of the most room, the nearest to the start of them first, so that
/// in the open nothing turns for nothing; then the others, the roomiest first.
class PoseBody : public UsualBody<PoseProblem> {
 public:
  PoseBody(const SolveRequest& request, PoseProblem problem)
      : UsualBody(request, std::move(problem)),
        prices_(prices_of(scene_, request.question)),
        pose_prices_(std::make_unique<PosePrices>(scene_, prices_, problem_.clearance)) {}

  bool start_stands_free() const { return pose_judge().stands_free(problem_.start); }
  bool goal_stands_free(const Se2& pose) const { return pose_judge().stands_free(pose); }
  template <class World>
  std::vector<Se2> goals(const World& world) const {
    auto query = world.make_query();
    std::vector<Se2> poses =
        poses_to_meet(scene_, problem_, execution_, [&](const Se2& pose) { return world.is_free(pose, query); });
    if (!problem_.any_heading()) return poses;
    const Se2 as_started{problem_.goal[0], problem_.goal[1], wrapped_angle(problem_.start.theta)};
    if (std::ranges::find(poses, as_started) == poses.end()) poses.insert(poses.begin(), as_started);
    return poses;
  }
  static SamplerKind choose_sampler(const SolveOptions& options, const RoadmapOptions& roadmap) {
    if (options.sampler && takes_all_places(*options.sampler)) {
      throw UsageError(
          fmt::format("@sampler: {} is for points and discs in mazes and on maps; a turning body takes the others",
                      name_of(*options.sampler)));
    }
    return roadmap.sampler == SamplerKind::lattice ? SamplerKind::uniform : roadmap.sampler;
  }
  template <class World>
  std::vector<Se2> best_first(const World& world, const std::vector<Se2>& goals) const {
    if (goals.size() < 2) return goals;
    auto query = world.make_query();
    std::vector<std::pair<double, Se2>> by_room;
    for (const Se2& goal : goals) by_room.emplace_back(world.clearance(goal, largest_coordinate, query), goal);
    std::ranges::stable_sort(by_room, [](const auto& a, const auto& b) { return a.first > b.first; });
    const auto is_roomy = [enough = 0.5 * by_room.front().first](const auto& goal) { return goal.first >= enough; };
    const auto roomy = std::ranges::partition_point(by_room, is_roomy);
    std::stable_sort(by_room.begin(), roomy, [&](const auto& a, const auto& b) {
      return world.distance(problem_.start, a.second) < world.distance(problem_.start, b.second);
    });
    std::vector<Se2> sorted;
    for (const auto& [room, goal] : by_room) sorted.push_back(goal);
    return sorted;
  }
  template <class World>
  bool provably_apart(const World&, const std::vector<Se2>& goals) const {
    return std::ranges::all_of(goals, [&](const Se2& goal) {
      return warren::provably_apart(*scene_.map, problem_.robot, problem_.start, goal, execution_);
    });
  }

 protected:
  PoseJudge pose_judge() const { return {scene_, problem_, execution_, judged_}; }

  Prices prices_;
  std::unique_ptr<PosePrices> pose_prices_;  // motions refer to it
};

template <class Body>
class SampledSolve {
 public:
  using World = typename Body::World;
  using State = typename World::State;

  /// Throws UsageError. Refers to the request. `own`: its execution; the limits of planners that get better end with
  /// the search, so that its path is judged.
  SampledSolve(const SolveRequest& request, Body body, Execution& own)
      : request_(request), own_(own), body_(std::move(body)) {
    answer_.problem = body_.problem();
    answer_.planner = name_of(request.planner);
    answer_.seed = request.options.seed;
    if (gets_better(request.planner)) {
      describe_better();
    } else if (by_roadmap()) {
      roadmap_options_ = detail::roadmap_options_of(request_, body_);
      if (body_.names_pipeline && request_.planner == PlannerKind::prm) answer_.pipeline = name_of(PipelineKind::plain);
      answer_.sampler = name_of(roadmap_options_.sampler);
      answer_.search = name_of(roadmap_options_.search);
    } else if (!on_lattice()) {
      tree_options_ = tree_options(request_.options);
      body_.suit(tree_options_);
      answer_.sampler = tree_options_.sampler ? name_of(*tree_options_.sampler) : "uniform-gaussian";
    }
    answer_.options = given_figures(request.options);
  }

  Answer run() {
    answer_within_limits(answer_, [this] {
      index();
      if (goals_.empty()) {
        answer_.outcome = !body_.start_stands_free() ? Outcome::start_blocked
                          : body_.knows_all_goals()  ? Outcome::goal_blocked
                                                     : Outcome::not_connected;
      } else if (!ends_touch()) {
        bound_growth();
        plan();
        settle_ends();
      }
      finish();
    });
    return std::move(answer_);
  }

 private:
  bool on_lattice() const { return request_.planner == PlannerKind::grid; }
  void plan() {
    if (gets_better(request_.planner)) return plan_better();
    if (on_lattice()) return plan_on_lattice();
    by_roadmap() ? plan_roadmaps() : take(grow_trees());
  }
  bool by_roadmap() const { return is_roadmap_planner(request_.planner); }
  /// rrt-star is the textbook's; what anytime draws is its own business.
  void describe_better() {
    tree_options_ = tree_options(request_.options);
    tree_options_.nodes = request_.options.trees.nodes.value_or(std::uint64_t{1} << 24U);
    body_.suit(tree_options_);
    roadmap_options_.seed = request_.options.seed;
    roadmap_options_.sampler = body_.choose_sampler(request_.options, roadmap_options_);
    if (takes_all_places(roadmap_options_.sampler))
      roadmap_options_.sampler = SamplerKind::uniform;  // denser ones follow
    roadmap_options_.attach = body_.attach(request_.options);
    const std::vector<AnytimePart>& parts = request_.options.anytime.parts;
    if (std::ranges::count(parts, AnytimePart::shorten) == std::ranges::ssize(parts) && !parts.empty())
      throw UsageError("@parts: shorten alone finds no path; add tree, restarts or roadmap");
  }
  void index() {
    const StageTimer timer(own_, "index", answer_.seconds.index);
    if (request_.asked.session != nullptr) {
      const auto& session = static_cast<const SessionIn<World>&>(*request_.asked.session);
      world_ = &*session.world;
      asked_ = &*session.roadmap;
    } else {
      body_.index(own_world_, roadmap_options_.sampler);
      world_ = &*own_world_;
    }
    view_.emplace(*world_);
    if constexpr (requires { body_.price_motions(*world_); }) {
      if (asked_ == nullptr) {
        view_->motion_cost = body_.price_motions(*world_);
      } else if constexpr (requires { body_.take_prices(view_->motion_cost); }) {
        body_.take_prices(asked_->world.motion_cost);
      }
    }
    goals_ = body_.goals(*world_);
  }
  /// What grows until start and goal connect, where they never can: a roadmap for one round and trees for a few nodes.
  void bound_growth() {
    if (asked_ != nullptr || on_lattice()) return;
    const bool grows = by_roadmap() ? !roadmap_options_.samples && !takes_all_places(roadmap_options_.sampler)
                                    : !request_.options.trees.nodes;
    if (!grows || !request_.scene.map) return;
    const StageTimer timer(own_, "proof", answer_.seconds.search);
    if (!body_.provably_apart(*world_, goals_)) return;
    apart_ = true;
    if (by_roadmap()) {
      roadmap_options_.samples = first_samples(*view_, roadmap_options_, own_);
    } else {
      tree_options_.nodes = 1000;  // they need not fill what they can reach
    }
  }
  /// The counts are those of all goals that were tried.
  void plan_roadmaps() {
    const std::vector<State> in_order = body_.best_first(*world_, goals_);
    std::vector<State> goals = detail::free_states(*world_, std::span<const State>(in_order), own_);
    if (goals.empty()) goals.push_back(in_order.front());
    const bool lazy = request_.planner == PlannerKind::lazy_prm;
    Counters before;
    for (const State& goal : goals) {
      take(asked_ != nullptr
               ? planners_.ask(*asked_, body_.start(), goal, roadmap_options_, own_, *request_.asked.scratch, kept())
               : planners_.on_roadmap(*view_, body_.start(), goal, roadmap_options_, lazy, own_, kept()));
      answer_.counters += before;
      before = answer_.counters;
      if (answer_.outcome != Outcome::not_connected || apart_) break;
    }
  }
  AnytimeOptions better_options() const {
    constexpr std::uint64_t usual_iterations = 20;
    const AnytimeFields& asked = request_.options.anytime;
    AnytimeOptions options;
    options.trees = tree_options_;
    options.roadmap = roadmap_options_;
    options.informed = request_.planner != PlannerKind::rrt_star;
    const auto has = [&](AnytimePart part) {
      return asked.parts.empty() || std::ranges::find(asked.parts, part) != asked.parts.end();
    };
    const bool whole = request_.planner == PlannerKind::anytime;
    options.parts = {.tree = !whole || has(AnytimePart::tree),
                     .restarts = whole && has(AnytimePart::restarts),
                     .roadmap = whole && has(AnytimePart::roadmap),
                     .shorten = whole && has(AnytimePart::shorten)};
    options.iterations = asked.iterations;
    options.gap = asked.gap;
    const bool is_endless = !asked.iterations && !asked.gap && own_.seconds_left() > 1e9;
    if (is_endless) options.iterations = usual_iterations;
    if (apart_) options.iterations = std::min<std::uint64_t>(options.iterations.value_or(4), 4);
    return options;
  }
  /// Makes an execution at its end what it was.
  struct Restored {
    Execution& execution;
    const Execution whole = execution;
    ~Restored() { execution = whole; }
  };
  AnytimeBody<State> body_of_better() {
    AnytimeBody<State> body;
    body.shortened = [this](const Path<State>& path, double hopeless, std::uint64_t seed, const Execution& on,
                            Counters& counters) {
      return body_.improved(*world_, path, {.seed = seed, .hopeless = hopeless}, on, counters);
    };
    body.draws = Body::improves_by_draws;
    body.length = [this](const Path<State>& path) { return length_of(path); };
    if (request_.keep != nullptr) body.kept = [this](const Path<State>& path) { keep_improved(path); };
    constexpr std::size_t few = 2'000;  // corners: where nobody asks how good a path is, and it takes little to know
    const bool is_small = !request_.scene.map && corner_count(request_.scene) <= few;
    if (request_.options.bound || request_.options.anytime.gap || is_small)
      body.lower_bound = [this] { return bound(BoundEffort::exact); };
    body.judge_bytes = judge_bytes(request_.scene);
    body.judged_s = [this](const Path<State>& path) {
      Answer judged;
      judged.outcome = Outcome::solved;
      const auto begin = std::chrono::steady_clock::now();
      const Restored restored{own_};
      own_.progress = nullptr;  // nobody is told of the stages meanwhile
      own_.trace = nullptr;
      own_.account = nullptr;
      body_.judge(*world_, Path<State>(path), judged);
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    return body;
  }
  /// Where the reference point went; curves as chords.
  void keep_improved(const Path<State>& path) {
    constexpr std::size_t pieces = 16;  // a leg of a car
    PolygonSet& kept = request_.keep->improved;
    std::vector<Vec2> line;
    if constexpr (std::is_same_v<State, Vec2>) {
      line.assign(path.begin(), path.end());
    } else if constexpr (std::is_same_v<State, Se2>) {
      line.push_back(path.front().position());
      for (std::size_t i = 1; i < path.size(); ++i) {
        for (std::size_t k = 1; k <= pieces; ++k)
          line.push_back(world_->interpolate(path[i - 1], path[i], static_cast<double>(k) / pieces).position());
      }
    }
    if (line.empty()) return;
    if (kept.size() == most_improved) {
      PolygonSet fewer;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        if (i % 2 == 0 || i + 1 == kept.size()) fewer.add(kept[i]);
      }
      kept = std::move(fewer);
    }
    kept.add(line);
  }
  double bound(BoundEffort effort) const {
    return proved_bound(request_.scene, answer_.problem, BoundOf::metric, effort, own_);
  }
  /// None where start or all of them are blocked, which the answer says.
  std::vector<State> free_goals() {
    std::vector<State> goals = detail::free_states(*world_, std::span<const State>(goals_), own_);
    auto query = world_->make_query();
    const bool is_free = world_->is_free(body_.start(), query);
    if (is_free && !goals.empty()) return goals;
    answer_.outcome = is_free ? Outcome::goal_blocked : Outcome::start_blocked;
    return {};
  }
  /// What ends the search does not end the work: its path is judged and told in the memory that there is.
  void plan_better() {
    const std::vector<State> goals = free_goals();
    if (goals.empty()) return;
    AnytimeOptions options = better_options();
    options.lower_bound = bound(BoundEffort::simple);
    options.all_goals = answer_.problem.goal.size() == answer_.problem.start.size();  // else some headings or postures
    const auto begin = std::chrono::steady_clock::now();
    AnytimeSolution<State> found =
        planners_.anytime(*view_, State(body_.start()), goals, options, body_of_better(), own_);
    answer_.lower_bound = found.lower_bound;
    answer_.improvements = std::move(found.improvements);
    answer_.iterations = found.iterations;
    answer_.ended_by = found.ended_by;
    answer_.optimal = found.ended_by == "optimum";
    end_limits(found.stop_reason);
    take(std::move(found));
    if (request_.options.optimise && answer_.outcome == Outcome::solved) shorten_better(begin);
  }
  /// Where a stop ended the search: its path is judged in the time that it takes.
  void end_limits(StopReason reason) {
    if (!enum_named<StopReason>(answer_.ended_by)) return;
    answer_.stop_reason = reason;
    untime(own_, last_);
  }
  void plan_on_lattice() {
    if constexpr (requires { body_.on_lattice(*world_, goals_, answer_); }) {
      const std::vector<State> goals = free_goals();
      if (goals.empty()) return;
      path_ = body_.on_lattice(*world_, goals, answer_);
      answer_.outcome = path_.empty() ? Outcome::not_connected : Outcome::solved;
      if (!path_.empty()) answer_.lower_bound = bound(BoundEffort::simple);
      end_limits(answer_.stop_reason.value_or(StopReason::time));
    }
  }
  /// Of planners that leave it to who asks: in the metric that they make small, and never to a path that costs more.
  /// begin: of the search.
  void shorten_better(std::chrono::steady_clock::time_point begin) {
    const StageTimer timer(own_, "optimise", answer_.seconds.optimise, path_.size());
    answer_.raw_length = length_of(path_);
    stopped_by([&] {  // it stays as it is then
      const ImproveOptions how{.seed = answer_.seed};
      Path<State> shorter = body_.improved(*world_, path_, how, own_, answer_.counters);
      if (!(cost_of(shorter) < cost_of(path_))) return;
      path_ = std::move(shorter);
      if (answer_.improvements.empty()) return;
      Improvement better = answer_.improvements.back();
      better.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      better.cost = cost_of(path_);
      better.length = length_of(path_);
      better.by = "optimise";
      answer_.improvements.push_back(std::move(better));
    });
  }
  double cost_of(const Path<State>& path) const {
    return path_length(path, [this](const State& a, const State& b) { return world_->distance(a, b); });
  }
  double length_of(const Path<State>& path) const {
    return path_length(path, [this](const State& a, const State& b) { return body_.length(*world_, a, b); });
  }
  Solution<State> grow_trees() {
    const auto planner = request_.planner == PlannerKind::rrt ? planners_.rrt : planners_.rrt_connect;
    return planner(*view_, State(body_.start()), goals_, tree_options_, own_, kept());
  }
  /// A roadmap takes the place of the one before; trees stand beside each other.
  PlannedRoadmap<State>* kept() {
    if (request_.keep == nullptr) return nullptr;
    if constexpr (std::is_same_v<State, Vec2>) {
      return by_roadmap() ? &request_.keep->roadmap : &request_.keep->trees.emplace_back();
    } else if constexpr (std::is_same_v<State, Se2>) {
      if (by_roadmap()) request_.keep->pose_roadmaps.clear();
      return &request_.keep->pose_roadmaps.emplace_back();
    } else {
      return by_roadmap() ? &request_.keep->joint_roadmap : nullptr;
    }
  }
  void take(Solution<State> solution) {
    path_ = std::move(solution.path);
    take_account(answer_, solution);
  }
  void settle_ends() {
    const bool has_none = std::is_same_v<State, Se2> && asked_ != nullptr && answer_.outcome == Outcome::not_connected;
    if (has_none) answer_.outcome = Outcome::start_blocked;
    answer_.outcome = settled_ends(
        answer_.outcome, [this] { return body_.start_stands_free(); },
        [this] {
          return std::ranges::any_of(goals_, [this](const State& goal) { return body_.goal_stands_free(goal); });
        });
  }
  /// A world of poses takes ends with less to spare than others do, from which then nothing leads. Of a roadmap that is
  /// asked they are looked at where it has no way.
  bool ends_touch() {
    if (!std::is_same_v<State, Se2> || asked_ != nullptr) return false;
    answer_.outcome = Outcome::start_blocked;
    settle_ends();
    return is_blocked(answer_.outcome);
  }
  /// Of bodies whose ways have a price beyond their length: the cheapest of several trees' paths, each shortened a
  /// little; what is told of work and sizes is of all trees. What is dear then stays so, since one that wanders is made
  /// better only near where it goes.
  void choose_path() {
    const std::size_t count = by_roadmap() || on_lattice() ? 1 : body_.paths_weighed();
    if (count < 2) return;
    double least = body_.price_once_shorter(*world_, path_, answer_);
    constexpr double as_cheap = 1e-6;  // rounding does not choose
    const std::uint64_t seed = tree_options_.seed;
    for (std::size_t i = 1; i < count; ++i) {
      tree_options_.seed = random_bits(seed, i);
      Solution<State> other = grow_trees();
      own_.check();
      answer_.counters += other.counters;
      answer_.roadmap.milestones += other.roadmap.milestones;
      answer_.roadmap.edges += other.roadmap.edges;
      if (other.outcome != Outcome::solved) continue;
      const double price = body_.price_once_shorter(*world_, other.path, answer_);
      if (!(price < least * (1.0 - as_cheap))) continue;
      least = price;
      path_ = std::move(other.path);
    }
    tree_options_.seed = seed;
  }
  void finish() {
    if (answer_.outcome == Outcome::stopped) return;
    if (answer_.outcome != Outcome::solved) {
      if (const std::string_view why = cause(); !why.empty()) answer_.figures.push_back({"cause", std::string(why)});
      if (goals_.empty() && answer_.outcome == Outcome::not_connected)
        answer_.figures.push_back({"goals_tried", body_.goals_tried()});
      return;
    }
    if (request_.options.optimise && !gets_better(request_.planner)) {
      const StageTimer timer(own_, "optimise", answer_.seconds.optimise, path_.size());
      if constexpr (requires { body_.paths_weighed(); }) choose_path();
      answer_.raw_length = length_of(path_);
      path_ = body_.shortened(*world_, std::move(path_), answer_);
    }
    std::optional<double> cost;
    if (Body::has_cost && gets_better(request_.planner)) cost = cost_of(path_);
    body_.judge(*world_, std::move(path_), answer_);
    if (!on_lattice()) {
      answer_.cost = cost;
    } else if (answer_.lower_bound) {
      constexpr double as_good = 1e-9;
      const double paid = answer_.cost.value_or(answer_.length);
      answer_.optimal = paid - *answer_.lower_bound <= as_good * paid;
    }
    const std::optional<double> told = gap_of(answer_);
    const bool is_within_gap = told && *told <= request_.options.anytime.gap.value_or(LatticeSearchOptions{}.gap);
    // It was measured over the lattice.
    if (on_lattice() && answer_.ended_by == "gap" && !is_within_gap) answer_.ended_by = "lattice_gap";
  }
  /// Why there is no path, one word a cause.
  std::string_view cause() const {
    if (is_blocked(answer_.outcome)) return body_.cause_of_blocked(*world_, answer_.outcome, goals_);
    if (goals_.empty()) return "goal_not_found";
    return cause_of_separation(answer_, by_roadmap());
  }

  const Planned<State, is_one_way<World>>& planners_ = planned_in<World>();
  const SolveRequest& request_;
  Execution& own_;
  std::optional<Deadline> last_;  // without the time
  Body body_;
  RoadmapOptions roadmap_options_;  // of prm and lazy-prm
  RrtOptions tree_options_;         // of the others
  std::optional<World> own_world_;
  const World* world_ = nullptr;                            // its own, or that of the roadmap that is asked
  std::optional<WorldView<World>> view_;                    // as planners see it
  const AskedRoadmap<AnyWorldOf<World>>* asked_ = nullptr;  // none: one is planned
  std::vector<State> goals_;
  bool apart_ = false;  // proved: no goal can be reached
  Path<State> path_;
  Answer answer_;
};

/// SolveKind::solve for a body.
template <class Body>
Answer solve_sampled(const SolveRequest& request) {
  Execution execution = request.execution;
  const SolveRequest own{request.options, request.scene, request.question, request.planner,
                         execution,       request.keep,  request.asked};
  return SampledSolve(own, Body(own), execution).run();
}

}  // namespace warren
