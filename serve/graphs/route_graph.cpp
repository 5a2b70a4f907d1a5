// SPDX-License-Identifier: BSD-3-Clause
#include "serve/graphs/route_graph.hpp"

#include <fmt/format.h>

#include <map>

#include "scenes/text/human_units.hpp"
#include "serve/http/http_message.hpp"

namespace warren::serve {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw HttpError(400, "bad_graph", "graph", message); }

}  // namespace

std::vector<RouteEnds> ends_of(const RouteGraph& graph) {
  if (graph.nodes.empty()) refuse("Nav2 loads no route graph without nodes, and this one has none");
  if (graph.edges.empty()) refuse("Nav2 loads no route graph without edges, and this one has none");
  if (graph.nodes.size() > most_route_nodes || graph.edges.size() > most_route_edges) {
    throw HttpError(413, "graph_too_large", "graph",
                    fmt::format("at most {} nodes and {} edges, each one way, are edited here",
                                grouped(most_route_nodes), grouped(most_route_edges)));
  }
  std::map<std::uint32_t, std::size_t> places;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const std::uint32_t id = graph.nodes[i].id;
    if (!places.emplace(id, i).second) refuse(fmt::format("the id {} is given to two nodes", id));
  }
  const auto place_of = [&](std::uint32_t id, const RouteEdge& edge) {
    const auto found = places.find(id);
    if (found == places.end()) refuse(fmt::format("edge {}: there is no node {}", edge.id, id));
    return found->second;
  };
  std::vector<RouteEnds> ends;
  for (const RouteEdge& edge : graph.edges) ends.push_back({place_of(edge.from, edge), place_of(edge.to, edge)});
  return ends;
}

}  // namespace warren::serve
