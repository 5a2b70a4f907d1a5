// SPDX-License-Identifier: BSD-3-Clause
#include "serve/graphs/route_graph.hpp"

#include <fmt/format.h>

#include <map>

#include "scenes/text/human_units.hpp"
#include "serve/http/http_message.hpp"

namespace warren::serve {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw HttpError(400, "bad_graph", "graph", message); }

void check_id(std::uint32_t id, std::map<std::uint32_t, std::size_t>& known, std::size_t place) {
  if (!known.emplace(id, place).second)
    refuse(fmt::format("the id {} is given twice; each is for one node or edge", id));
}

std::size_t place_of(const std::map<std::uint32_t, std::size_t>& known, std::size_t nodes, std::uint32_t id,
                     const RouteEdge& edge) {
  const auto found = known.find(id);
  if (found != known.end() && found->second < nodes) return found->second;
  refuse(fmt::format("edge {}: there is no node {}", edge.id, id));
}

}  // namespace

std::vector<RouteEnds> ends_of(const RouteGraph& graph) {
  if (graph.nodes.empty()) refuse("Nav2 loads no route graph without nodes, and this one has none");
  if (graph.edges.empty()) refuse("Nav2 loads no route graph without edges, and this one has none");
  if (graph.nodes.size() > most_route_nodes || graph.edges.size() > most_route_edges) {
    throw HttpError(413, "graph_too_large", "graph",
                    fmt::format("at most {} nodes and {} edges, each one way, are edited here",
                                grouped(most_route_nodes), grouped(most_route_edges)));
  }
  std::map<std::uint32_t, std::size_t> known;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) check_id(graph.nodes[i].id, known, i);
  for (const RouteEdge& edge : graph.edges) check_id(edge.id, known, graph.nodes.size());
  std::vector<RouteEnds> ends;
  for (const RouteEdge& edge : graph.edges) {
    ends.push_back(
        {place_of(known, graph.nodes.size(), edge.from, edge), place_of(known, graph.nodes.size(), edge.to, edge)});
    if (edge.from == edge.to) refuse(fmt::format("edge {}: leads from node {} to itself", edge.id, edge.from));
  }
  return ends;
}

}  // namespace warren::serve
