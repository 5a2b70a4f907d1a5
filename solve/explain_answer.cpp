// SPDX-License-Identifier: BSD-3-Clause
#include "solve/explain_answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "solve/explain/blocked_end.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question_of_arm.hpp"

namespace warren {
namespace {

ComponentFacts facts_of(const Graph& graph, const Execution& execution) {
  const Components parts = components(graph, execution);
  const auto vertices = static_cast<VertexId>(graph.vertex_count());
  execution.reserve(vertices * sizeof(std::uint32_t));
  std::vector<std::uint32_t> size(vertices, 0);
  for (VertexId v = 0; v < vertices; ++v) {
    execution.poll(v);
    ++size[parts.label[v]];
  }
  ComponentFacts facts{.count = parts.count, .milestones = vertices};
  for (const std::uint32_t n : size) {
    facts.largest = std::max<std::uint64_t>(facts.largest, n);
    facts.alone += n == 1 ? 1 : 0;
  }
  facts.of_start = size[parts.label[vertices - 2]];
  facts.of_goal = size[parts.label[vertices - 1]];
  facts.joined = parts.connected(vertices - 2, vertices - 1);
  return facts;
}

/// The graph of the roadmap, whatever its states are; nullptr: none was kept, or its edges lead one way.
const Graph* graph_of(const ByProducts& made, const Answer& answer) {
  if (answer.problem.robot.kind == RobotKind::car) return nullptr;
  const Graph* graphs[] = {&made.roadmap.graph,
                           made.pose_roadmaps.size() == 1 ? &made.pose_roadmaps.front().graph : nullptr,
                           &made.joint_roadmap.graph};
  for (const Graph* graph : graphs) {
    if (graph != nullptr && graph->vertex_count() >= 2) return graph;
  }
  return nullptr;
}

/// Where a verified path has the least room: part by part, among the obstacles that are near the part which is looked
/// at.
class NarrowestSearch {
 public:
  /// `room`: the least.
  NarrowestSearch(const Scene& scene, Question question, const RecordedAnswer& answer, double room,
                  const Execution& execution)
      : question_(std::move(question)),
        answer_(answer),
        execution_(execution),
        kind_(verifying_kind(scene, question_)),
        room_(room),
        reach_(2.0 * room + extent_of(*question_.robot)) {
    look_at(scene, 0, answer.state_count() - 1);
  }

  /// By the half that has it, again and again.
  std::size_t narrowest_leg() {
    std::size_t first = 0;
    std::size_t last = answer_.state_count() - 1;
    while (last - first > 1) {
      const std::size_t middle = first + (last - first) / 2;
      const double before = clearance(first, middle);
      const bool is_before = before <= room_ || before <= clearance(middle, last);
      (is_before ? last : first) = middle;
      look_at(near_, first, last);
    }
    return first;
  }
  /// The same along a straight leg, to a thousandth of it.
  Vec2 place_on(std::size_t leg) const {
    constexpr int halvings = 10;
    Vec2 from{answer_.numbers(leg)[0], answer_.numbers(leg)[1]};
    Vec2 to{answer_.numbers(leg + 1)[0], answer_.numbers(leg + 1)[1]};
    if (!answer_.states.empty()) return from;
    const auto room = [&](Vec2 p, Vec2 q) { return clearance({{p.x, p.y}, {q.x, q.y}}); };
    for (int i = 0; i < halvings; ++i) {
      const Vec2 middle = 0.5 * (from + to);
      (room(from, middle) <= room(middle, to) ? to : from) = middle;
    }
    return 0.5 * (from + to);
  }

 private:
  double clearance(std::size_t first, std::size_t last) const {
    constexpr std::size_t bytes_a_state = 128;  // with what is recorded of it
    execution_.reserve((last - first + 1) * bytes_a_state);
    std::vector<std::vector<double>> states;
    for (std::size_t i = first; i <= last; ++i) {
      execution_.poll(i);
      states.push_back(answer_.state(i));
    }
    return clearance(states);
  }
  double clearance(const std::vector<std::vector<double>>& states) const {
    execution_.check();
    Question question = question_;
    question.start = states.front();
    question.goal = states.back();
    return kind_.verify(near_, question, recorded(states), execution_).min_clearance;
  }
  /// From now on obstacles of the scene that are far from the states first .. last are left out.
  void look_at(const Scene& scene, std::size_t first, std::size_t last) {
    if (is_arm(*question_.robot)) {
      near_ = scene;
      return;
    }
    std::vector<Vec2> way;
    double longest = 0.0;  // a car's curve bends away from its chord by no more
    for (std::size_t i = first; i <= last; ++i) {
      execution_.poll(i);
      const std::span<const double> at = answer_.numbers(i);
      push_asked(way, {at[0], at[1]}, execution_);
      if (i > first) longest = std::max(longest, distance(way.end()[-2], way.back()));
    }
    const double bend = question_.robot->kind == RobotKind::car ? longest : 0.0;
    near_ = obstacles_near(scene, way, reach_ + bend, execution_);
  }

  Question question_;
  const RecordedAnswer& answer_;
  const Execution& execution_;
  const SolveKind& kind_;
  double room_;
  double reach_;  // of obstacles that are looked at
  Scene near_;
};

/// The square lies in the box of all.
std::optional<double> one_sample_in(const Scene& scene, const Answer& answer, const Execution& execution) {
  const Problem& problem = answer.problem;
  const double free = 2.0 * (answer.min_clearance - problem.clearance);
  if (!is_round(problem.robot) || answer.sampler.empty() || answer.raw_length || !(free > 0.0)) return std::nullopt;
  const Box box = room_of(scene, execution);
  return std::max(1.0, box.width() * box.height() / (free * free));
}

std::uint64_t four_times(std::uint64_t n) { return n > most_samples / 4 ? most_samples : 4 * n; }

class Hints {
 public:
  Hints(const Scene& scene, const AskedWith& asked, const Answer& answer)
      : scene_(scene), asked_(asked), options_(asked.options), answer_(answer) {
    if (!options_.planner) options_.planner = enum_named<PlannerKind>(answer.planner);
  }

  std::vector<Hint> all() && {
    add_stopped();
    add_free_place();
    add_iterations();
    if (answer_.outcome == Outcome::not_connected && !answer_.refuted) add_connecting();
    return std::move(hints_);
  }

 private:
  void add_stopped() {
    if (answer_.outcome != Outcome::stopped) return;
    if (answer_.stop_reason == StopReason::time) say("a longer --budget: 'time went to' says which stage took it");
    if (answer_.stop_reason == StopReason::memory) say("more --memory, or a question that takes less of it");
    if (const std::string_view less = what_takes_less_memory(answer_); !less.empty()) say(std::string{less});
  }
  /// Of planners that get better, where all their turns are done and a better path may be.
  void add_iterations() {
    if (answer_.ended_by != "iterations" || !options_.anytime.iterations) return;
    const std::uint64_t more = four_times(*options_.anytime.iterations);
    const bool is_found = answer_.outcome == Outcome::solved;
    constexpr double hardly = 1e-3;
    if (is_found && gap_of(answer_).value_or(1.0) <= hardly) return;
    if (more <= *options_.anytime.iterations || (!is_found && answer_.outcome != Outcome::not_connected)) return;
    offer({"--iterations", fmt::format("{}", more)},
          is_found ? "the path may get better with more" : "all turns are done, and none has found a way yet",
          [&](SolveOptions& options) { options.anytime.iterations = more; });
  }
  void say(std::string why) { hints_.push_back({{}, {}, std::move(why)}); }

  void add_free_place() {
    if (!answer_.blocked || answer_.blocked->free_place.empty()) return;
    const std::string option = answer_.blocked->is_start ? "--start" : "--goal";
    std::string state = fmt::format("{}", fmt::join(answer_.blocked->free_place, ","));
    std::vector<std::string> words{option, state};
    if (state.starts_with('-')) words = {option + "=" + state};
    hints_.push_back({{}, std::move(words), "the nearest place where the body fits"});
  }

  void add_connecting() {
    const PlannerKind planner = *options_.planner;
    if (is_roadmap_planner(planner)) add_for_roadmaps();
    if (is_tree_planner(planner)) add_for_trees();
    if (planner == PlannerKind::grid) add_for_grids();
    if (answer_.problem.clearance > 0.0) {
      hints_.push_back(
          {verb(), {"--clearance", fmt::format("{:.3g}", 0.5 * answer_.problem.clearance)}, "if less room will do"});
    }
    add_planners();
  }

  void add_for_roadmaps() {
    const auto sampler = enum_named<SamplerKind>(answer_.sampler);
    const bool all_places = sampler && takes_all_places(*sampler);
    const bool seeks = sampler == SamplerKind::bridge || sampler == SamplerKind::gaussian;
    const bool none_kept = answer_.counters.samples > 0 && answer_.counters.kept == 0;
    const bool some_dropped = answer_.counters.samples > answer_.counters.kept;
    const auto take = [](SamplerKind kind) { return [kind](SolveOptions& options) { options.sampler = kind; }; };
    if (all_places || seeks || none_kept) {
      offer({"--sampler", "uniform"},
            all_places ? "milestones between the middles of cells, too" : "milestones everywhere",
            take(SamplerKind::uniform));
    }
    if (!all_places) {
      const std::uint64_t drawn = asked_.samples > 0 ? asked_.samples : answer_.roadmap.samples;
      const std::uint64_t more = four_times(std::max<std::uint64_t>(drawn, options_.roadmap.samples.value_or(1)));
      const bool any_drawn = drawn > 0 || answer_.counters.samples > 0;
      if (any_drawn && more > drawn) {
        offer({"--samples", fmt::format("{}", more)},
              options_.roadmap.samples ? "without --samples the roadmap grows until start and goal connect"
                                       : "the roadmap gave up at a fourth of that",
              [&](SolveOptions& options) { options.roadmap.samples = more; });
      }
    }
    if (!all_places && !seeks && some_dropped) {
      offer({"--sampler", "bridge"}, "milestones in narrow passages", take(SamplerKind::bridge));
    }
    if (options_.roadmap.radius) {
      const double gap = answer_.separation.nearest_gap;
      const bool too_far = gap > *options_.roadmap.radius;
      const std::string text = fmt::format("{:.3g}", 2.0 * (too_far ? gap : *options_.roadmap.radius));
      offer({"--radius", text},
            too_far ? "the gap is wider than the one asked for" : "each milestone is joined to more",
            [&](SolveOptions& options) { options.roadmap.radius = 2.0 * *options_.roadmap.radius; });
    }
    if (options_.roadmap.neighbours) {
      const std::uint32_t more = 2 * *options_.roadmap.neighbours;
      offer({"--neighbours", fmt::format("{}", more)}, "each milestone is joined to more",
            [&](SolveOptions& options) { options.roadmap.neighbours = more; });
    }
  }
  void add_for_trees() {
    constexpr std::uint64_t usual_nodes = 100'000;
    const std::uint64_t nodes = options_.trees.nodes.value_or(usual_nodes);
    if (four_times(nodes) > nodes) {
      offer({"--nodes", fmt::format("{}", four_times(nodes))}, "the trees gave up at a fourth of that",
            [&](SolveOptions& options) { options.trees.nodes = four_times(nodes); });
    }
    if (options_.trees.step) {
      const double step = 0.5 * *options_.trees.step;
      offer({"--step", fmt::format("{:.3g}", step)}, "shorter motions squeeze through narrower passages",
            [&](SolveOptions& options) { options.trees.step = step; });
    }
    if (!options_.trees.trees) {
      offer({"--trees", "4"}, "the first of them to arrive answers", [](SolveOptions& o) { o.trees.trees = 4; });
    }
  }
  void add_for_grids() {
    try {
      const GridSpec grid = grid_spec(options_.grid, scene_);
      if (!scene_.map)
        offer({"--cell", fmt::format("{:.3g}", 0.5 * grid.cell)}, "what is narrower than a cell is not seen",
              [&](SolveOptions& options) { options.grid.cell = 0.5 * grid.cell; });
      if (answer_.problem.robot.outline.empty()) return;
      const auto angles = static_cast<std::uint32_t>(2 * grid.angles);
      offer({"--angles", fmt::format("{}", angles)}, "the body turns in smaller steps",
            [&](SolveOptions& options) { options.grid.angles = angles; });
    } catch (const UsageError&) {  // there is no raster
    }
  }
  /// One that proves what it says, else one of another kind.
  void add_planners() {
    const RobotKind body = answer_.problem.robot.kind;
    const bool in_plane = !scene_.map && is_round(answer_.problem.robot);
    const auto offer_planner = [&](PlannerKind planner, std::string_view why) {
      if (planner == options_.planner) return false;
      const auto change = [&](SolveOptions& options) { options.planner = planner; };
      return offer({"--planner", std::string{name_of(planner)}}, why, change);
    };
    if (in_plane && offer_planner(PlannerKind::visibility, "finds every way that there is, or proves that none is"))
      return;
    const bool is_car = body == RobotKind::car;  // of which its lattice proves nothing
    if (scene_.map && !is_car &&
        offer_planner(PlannerKind::grid, "finds what the map's cells allow, or proves that none is"))
      return;
    for (const PlannerKind other : {PlannerKind::lazy_prm, PlannerKind::rrt_connect, PlannerKind::prm}) {
      if (is_roadmap_planner(other) && is_roadmap_planner(*options_.planner)) continue;
      if (offer_planner(other, "looks for a way by other means")) return;
    }
  }

  /// Where this world takes the options as `change` makes them.
  template <class Change>
  bool offer(std::initializer_list<std::string> words, std::string_view why, const Change& change) {
    SolveOptions changed = options_;
    change(changed);
    if (!is_taken(changed)) return false;
    hints_.push_back({verb(), words, std::string{why}});
    return true;
  }
  bool is_taken(const SolveOptions& options) const {
    const Question question = answer_.problem.question();
    try {
      options.validate();
      check_solver_options(options);
      choose_solver(options, scene_, question);
      if (asked_.is_kept) check_buildable(scene_, question, options);
      if (options.grid.cell) check_cell(*options.grid.cell, scene_);
      return true;
    } catch (const UsageError&) {
      return false;
    }
  }
  std::string verb() const { return asked_.is_kept ? "build" : ""; }

  const Scene& scene_;
  const AskedWith& asked_;
  SolveOptions options_;
  const Answer& answer_;
  std::vector<Hint> hints_;
};

}  // namespace

std::optional<NarrowPlace> narrowest_place(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                                           double min_clearance, const Execution& execution) {
  if (answer.state_count() < 2 || !(min_clearance > 0.0) || !std::isfinite(min_clearance)) return std::nullopt;
  NarrowestSearch search(scene, question, answer, min_clearance, execution);
  NarrowPlace narrow{.leg = search.narrowest_leg(), .place = {}, .clearance = min_clearance, .one_sample_in = {}};
  if (!is_arm(*question.robot)) narrow.place = search.place_on(narrow.leg);
  return narrow;
}

void explain_answer(const Scene& scene, const AskedWith& asked, Answer& answer, const ByProducts& made,
                    const Execution& execution) {
  Explanation& explained = answer.explained.emplace();
  explained.hints = hints_for(scene, asked, answer);
  const auto planner = enum_named<PlannerKind>(answer.planner);
  if (planner == PlannerKind::prm && answer.outcome != Outcome::stopped) {
    if (const Graph* graph = graph_of(made, answer)) explained.components = facts_of(*graph, execution);
  }
  if (!answer.verified) return;
  explained.narrowest =
      narrowest_place(scene, answer.problem.question(), recorded(answer), answer.min_clearance, execution);
  if (explained.narrowest) explained.narrowest->one_sample_in = one_sample_in(scene, answer, execution);
}

std::string_view what_takes_less_memory(const Answer& answer) {
  const bool is_out = answer.outcome == Outcome::stopped && answer.stop_reason == StopReason::memory;
  if (!is_out || !answer.world.source.starts_with("maze:")) return {};
  return "mazes of algorithm=mst are forgotten tile by tile with --pipeline streamed --no-path";
}

void explain_in_time(Answer& answer, const std::function<void()>& explain) {
  const auto reason = stopped_by(explain);
  if (!reason) return;
  if (!answer.explained) answer.explained.emplace();
  answer.explained->stopped = reason;
}

std::vector<Hint> hints_for(const Scene& scene, const AskedWith& asked, const Answer& answer) {
  return Hints(scene, asked, answer).all();
}

}  // namespace warren
