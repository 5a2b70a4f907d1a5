// SPDX-License-Identifier: BSD-3-Clause
#include "tools/verbs/run_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "pictures/layers/heading_layer.hpp"
#include "studies/contests/contest_pictures.hpp"
#include "studies/contests/graph_of_world.hpp"
#include "studies/contests/search_pictures.hpp"
#include "worlds/rasters/map_borders.hpp"

namespace warren::tools {
namespace {

/// What is wrong with the planner of one run is wrong with the list.
std::string about_planners(const UsageError& error) {
  std::string text = error.spelled("@", '_');
  constexpr std::string_view one = "@planner:";
  if (text.starts_with(one)) text.replace(0, one.size(), "@planners:");
  return text;
}

/// Bodies that turn plan among a map's borders, and pictures show them.
bool needs_map_walls(const Scene& scene, const studies::PlannerContestOptions& contest) {
  const RobotKind body = robot_of(scene, contest.contenders.front().question).kind;
  return !contest.pictures.empty() || (body != RobotKind::point && body != RobotKind::disc);
}

void add_pictures(studies::Comparison& comparison, const std::string& folder, std::vector<std::string> notes) {
  comparison.notes.push_back("pictures: " + folder);
  std::move(notes.begin(), notes.end(), std::back_inserter(comparison.notes));
}

void compare_planners(const Scene& scene, const studies::PlannerContestOptions& contest, const Execution& execution,
                      studies::Comparison& comparison) {
  std::optional<Scene> bordered;
  if (scene.map && scene.walls.size() == 0 && needs_map_walls(scene, contest)) {
    bordered = scene;
    add_map_walls(*bordered, execution);
  }
  const Scene& world = bordered ? *bordered : scene;
  try {
    studies::run_planner_contest(world, contest, execution, comparison);
  } catch (const UsageError& error) {
    throw UsageError(about_planners(error));
  }
  if (contest.pictures.empty()) return;
  add_pictures(comparison, contest.pictures,
               studies::draw_contest(world, contest, comparison, contest.pictures, execution));
}

/// The planner that was asked for, else the one that `solve` would take, with those of the options that it takes.
SolveOptions graph_options(const CompareOptions& options, const Scene& scene) {
  studies::PlannerDeal deal = options.graph_deal;
  if (!options.graph) {
    SolveOptions all = deal.common;
    for (const studies::DealtOption& list : deal.lists)
      studies::copy_option(list.option, all, list.values.front().value);
    deal.planners = {studies::usual_graph_planner(scene, deal.question, all)};
  }
  SolveOptions graph = studies::deal_planners(deal).front().options;
  if (graph.planner == PlannerKind::prm) graph.roadmap.pipeline = PipelineKind::plain;  // tiles leave no roadmap
  return graph;
}

std::optional<Outcome> compare_searches(const CompareOptions& options, const Scene& scene, const Execution& execution,
                                        studies::Comparison& comparison,
                                        const std::function<void(std::string_view)>& note) {
  const Deadline deadline(execution.deadline, options.budget_s);
  Execution within = execution;
  within.deadline = &deadline;
  const studies::WorldGraph made =
      studies::world_graph(scene, options.graph_deal.question, graph_options(options, scene), within);
  if (made.graph.at.empty()) {
    comparison.notes.push_back(fmt::format("{}: {}", scene.source, name_of(made.outcome)));
    return made.outcome;
  }
  note(fmt::format("{}: {} vertices, {} edges, {} searches", scene.source, made.graph.graph.vertex_count(),
                   made.graph.graph.edge_count(), options.searches.variants.size()));
  studies::run_search_contest(made.graph, options.searches, execution, comparison);
  if (options.pictures.empty()) return std::nullopt;
  add_pictures(comparison, options.pictures,
               studies::draw_searches(scene, made.graph, options.searches, options.pictures, options.look, execution));
  return std::nullopt;
}

void check_heading(const CompareOptions& options, const Scene& scene) {
  const PictureOptions& look = options.planners ? options.planners->look : options.look;
  if (!look.heading) return;
  check_has_headings(
      robot_of(scene, options.planners ? options.planners->contenders.front().question : options.graph_deal.question));
}

}  // namespace

std::optional<Outcome> run_comparison(const CompareOptions& options, const Scene* scene, const Execution& execution,
                                      studies::Comparison& comparison,
                                      const std::function<void(std::string_view)>& note) {
  std::optional<Outcome> no_graph;
  if (scene != nullptr) check_heading(options, *scene);
  try {
    if (scene != nullptr && options.planners) compare_planners(*scene, *options.planners, execution, comparison);
    if (scene != nullptr && !options.planners) {
      no_graph = compare_searches(options, *scene, execution, comparison, note);
    }
    if (options.sweep) studies::run_size_sweep(*options.sweep, execution, comparison, note);
  } catch (const Stopped& stopped) {
    comparison.stopped = stopped.reason;
  }
  return no_graph;
}

}  // namespace warren::tools
