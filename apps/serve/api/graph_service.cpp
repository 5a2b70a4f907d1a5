// SPDX-License-Identifier: BSD-3-Clause
// What is asked about route graphs of the served world.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/serve/api/world_service.hpp"
#include "core/base/error.hpp"

namespace warren::serve {
namespace {

std::vector<DrawnEdge> edges_of(const RouteGraph& graph, const std::vector<RouteEnds>& ends) {
  const auto place = [&](std::size_t node) { return EdgePlace{graph.nodes[node].at, graph.nodes[node].theta}; };
  std::vector<DrawnEdge> edges;
  for (const RouteEnds& e : ends) edges.push_back({place(e.from), place(e.to)});
  return edges;
}

void refuse_blocked(const RouteGraph& graph, const std::vector<EdgeVerdict>& verdicts) {
  const auto first = std::ranges::find(verdicts, false, &EdgeVerdict::free);
  if (first == verdicts.end()) return;
  const auto blocked = std::ranges::count(verdicts, false, &EdgeVerdict::free);
  const RouteEdge& edge = graph.edges[static_cast<std::size_t>(first - verdicts.begin())];
  throw HttpError(422, "not_free", "edges",
                  fmt::format("{} of {} edges are not free, so nothing is saved; edge {} from node {} to {}: {}",
                              blocked, verdicts.size(), edge.id, edge.from, edge.to, words_of(*first)));
}

const EdgeJudge& judge_of(const ServedWorld& world, const Execution& execution) {
  if (world.query() != nullptr) body_on_edges(world.query()->roadmap());  // which may steer otherwise
  check_drives_edges(world.robot());
  if (world.query() != nullptr && world.query()->roadmap().lattice != nullptr) {
    throw UsageError("a large maze is asked by its lattice, and route graphs are for maps and scenes");
  }
  return world.judge(execution);
}

RouteGraph asked_graph(const ServedWorld& world, std::string_view body, const Execution& execution) {
  const GraphOptions options = read_graph_options(body);
  judge_of(world, execution);  // or there are no such graphs
  const bool is_as_it_is = options.kind == GraphKind::roadmap && !options.samples && !options.neighbours;
  if (world.query() != nullptr && is_as_it_is) return graph_of_roadmap(world.query()->roadmap(), execution);
  return graph_of_roadmap(built_roadmap(world.barred(execution), world.robot(), world.clearance(), options, execution),
                          execution);
}

}  // namespace

HttpResponse answer_of_graphs(const ServedWorld& world, Place place, std::string_view body,
                              const Execution& execution) {
  if (place == Place::check) {
    return {.body = verdicts_json(judge_of(world, execution).judge(read_drawn_edges(body, execution), execution))};
  }
  const bool is_saved = place == Place::save_graph;
  const RouteGraph graph = is_saved                     ? read_graph_json(body, execution)
                           : place == Place::open_graph ? read_nav2_graph(body, execution)
                                                        : asked_graph(world, body, execution);
  if (!is_saved) judge_of(world, execution);  // or there are no such graphs
  const std::vector<RouteEnds> ends = ends_of(graph);
  const std::vector<EdgeVerdict> verdicts = judge_of(world, execution).judge(edges_of(graph, ends), execution);
  if (!is_saved) return {.body = graph_json(graph, verdicts, execution)};
  refuse_blocked(graph, verdicts);
  return {.type = "application/geo+json", .body = nav2_graph_text(graph, ends, execution)};
}

}  // namespace warren::serve
