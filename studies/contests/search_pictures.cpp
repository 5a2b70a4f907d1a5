// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/search_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "pictures/subtitle.hpp"
#include "planners/roadmap/planned_roadmap.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/world_account.hpp"
#include "studies/contests/paths_figure.hpp"
#include "worlds/rasters/map_borders.hpp"

namespace warren::studies {
namespace {

/// A path that one or more variants of a search found.
struct FoundPath {
  SearchVariant first;
  std::size_t variants = 1;
  std::uint64_t expanded = 0;
  RawVector<VertexId> path = {};
};

/// Those that found something, in the order of the options.
std::vector<FoundPath> found_paths(const SearchGraph& graph, const SearchContestOptions& options,
                                   const Execution& execution) {
  std::vector<FoundPath> all;
  for (const SearchVariant& variant : options.variants) {
    execution.check();
    const Deadline deadline(execution.deadline, options.budget_s);
    Execution within = execution;
    within.deadline = &deadline;
    SearchResult result = graph_search(graph, variant)->run(within);
    if (result.status != SearchStatus::found) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&](const FoundPath& f) {
      return f.first.search == variant.search && f.expanded == result.expanded && f.path == result.path;
    });
    if (same != all.end()) {
      ++same->variants;
    } else {
      all.push_back({.first = variant, .expanded = result.expanded, .path = std::move(result.path)});
    }
  }
  return all;
}

/// A search's name alone where all its variants found the same.
std::string label_of(const FoundPath& found, const std::vector<FoundPath>& all, const SearchGraph& graph) {
  std::string name{name_of(found.first.search)};
  const auto alike =
      std::count_if(all.begin(), all.end(), [&](const FoundPath& f) { return f.first.search == found.first.search; });
  if (alike > 1) {
    if (found.first.queue) name.append(", ").append(name_of(*found.first.queue));
    if (found.first.library != SearchLibrary::warren) name.append(", ").append(name_of(found.first.library));
    if (found.variants > 1) name += fmt::format(" and {} more", found.variants - 1);
  }
  return fmt::format("{}: length {}, {} settled", name, human_number(path_length(graph, found.path)),
                     grouped(found.expanded));
}

}  // namespace

std::vector<std::string> draw_searches(const Scene& world, const SearchGraph& graph,
                                       const SearchContestOptions& options, const std::string& folder,
                                       const PictureOptions& look, const Execution& execution) {
  Scene scene = world;
  add_map_walls(scene, execution);
  PlannedRoadmap<Vec2> roadmap{.states = {}, .graph = graph.graph, .search_tree = {}};
  for (const Vec2 p : graph.at) roadmap.states.push_back(p);
  PathsFigure figure{.roadmap = &roadmap,
                     .start = graph.at[graph.start],
                     .goal = graph.at[graph.goal],
                     .subtitle = fmt::format("{}\ngraph of {}: {}, {}", description_of(scene), graph.kind,
                                             counted(graph.graph.vertex_count(), "vertex", "vertices"),
                                             counted(graph.graph.edge_count(), "edge", "edges"))};
  const std::vector<FoundPath> all = found_paths(graph, options, execution);
  for (const FoundPath& found : all) {
    NamedPath& path = figure.paths.emplace_back(NamedPath{label_of(found, all, graph), {}});
    for (const VertexId v : found.path) path.points.push_back(graph.at[v]);
  }
  if (all.empty()) figure.subtitle += "; no search found a path";
  return draw_paths(folder, "searches.svg", scene, figure, look, execution);
}

}  // namespace warren::studies
