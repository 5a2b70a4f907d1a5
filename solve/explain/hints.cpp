// SPDX-License-Identifier: BSD-3-Clause
#include "solve/explain/hints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "solve/question/grid_choice.hpp"
#include "solve/roadmaps/roadmap.hpp"
#include "solve/steps/kind_of_problem.hpp"

namespace warren {
namespace {

constexpr std::uint64_t most_milestones = std::uint64_t{1} << 31;  // as samples and nodes may be

std::uint64_t four_times(std::uint64_t n) { return n > most_milestones / 4 ? most_milestones : 4 * n; }

class Hints {
 public:
  Hints(const Scene& scene, const AskedWith& asked, const Answer& answer)
      : scene_(scene), asked_(asked), options_(asked.options), answer_(answer) {
    if (!options_.planner) options_.planner = enum_named<PlannerKind>(answer.planner);
  }

  std::vector<Hint> all() && {
    add_stopped();
    add_free_place();
    if (answer_.outcome == Outcome::not_connected && !answer_.refuted) add_connecting();
    return std::move(hints_);
  }

 private:
  void add_stopped() {
    if (answer_.outcome != Outcome::stopped) return;
    if (answer_.stop_reason == StopReason::time) say("a longer --budget: 'time went to' says which stage took it");
    if (answer_.stop_reason == StopReason::memory) say("more --memory, or a question that takes less of it");
    if (answer_.stop_reason == StopReason::memory && answer_.world.source.starts_with("maze:"))
      say("mazes of algorithm=mst are forgotten tile by tile with --pipeline streamed --no-path");
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
    if (planner == PlannerKind::rrt || planner == PlannerKind::rrt_connect) add_for_trees();
    if (planner == PlannerKind::grid) add_for_grids();
    if (answer_.problem.clearance > 0.0) {
      hints_.push_back(
          {verb(), {"--clearance", fmt::format("{:.3g}", 0.5 * answer_.problem.clearance)}, "if less room will do"});
    }
    add_planners();
  }

  void add_for_roadmaps();
  void add_for_trees();
  void add_for_grids();
  void add_planners();

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

void Hints::add_for_roadmaps() {
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
    offer({"--radius", text}, too_far ? "the gap is wider than the one asked for" : "each milestone is joined to more",
          [&](SolveOptions& options) { options.roadmap.radius = 2.0 * *options_.roadmap.radius; });
  }
  if (options_.roadmap.neighbours) {
    const std::uint32_t more = 2 * *options_.roadmap.neighbours;
    offer({"--neighbours", fmt::format("{}", more)}, "each milestone is joined to more",
          [&](SolveOptions& options) { options.roadmap.neighbours = more; });
  }
}

void Hints::add_for_trees() {
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

void Hints::add_for_grids() {
  try {
    const GridSpec grid = grid_spec(options_.grid, scene_);
    offer({"--cell", fmt::format("{:.3g}", 0.5 * grid.cell)}, "what is narrower than a cell is not seen",
          [&](SolveOptions& options) { options.grid.cell = 0.5 * grid.cell; });
    if (answer_.problem.robot.outline.empty()) return;
    const auto angles = static_cast<std::uint32_t>(2 * grid.angles);
    offer({"--angles", fmt::format("{}", angles)}, "the body turns in smaller steps",
          [&](SolveOptions& options) { options.grid.angles = angles; });
  } catch (const UsageError&) {  // a map has no raster but its own
  }
}

/// One that proves what it says, else one of another kind.
void Hints::add_planners() {
  const bool in_plane =
      !scene_.map && answer_.problem.robot.kind == RobotKind::point && answer_.problem.clearance == 0.0;
  const auto offer_planner = [&](PlannerKind planner, std::string_view why) {
    if (planner == options_.planner) return false;
    const auto change = [&](SolveOptions& options) { options.planner = planner; };
    return offer({"--planner", std::string{name_of(planner)}}, why, change);
  };
  if (in_plane && offer_planner(PlannerKind::visibility, "finds every way that there is, or proves that none is"))
    return;
  if (scene_.map && offer_planner(PlannerKind::grid, "finds what the map's cells allow, or proves that none is"))
    return;
  for (const PlannerKind other : {PlannerKind::lazy_prm, PlannerKind::rrt_connect, PlannerKind::prm}) {
    if (is_roadmap_planner(other) && is_roadmap_planner(*options_.planner)) continue;
    if (offer_planner(other, "looks for a way by other means")) return;
  }
}

}  // namespace

std::vector<Hint> hints_for(const Scene& scene, const AskedWith& asked, const Answer& answer) {
  return Hints(scene, asked, answer).all();
}

}  // namespace warren
