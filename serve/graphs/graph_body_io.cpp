// SPDX-License-Identifier: BSD-3-Clause
#include "serve/graphs/graph_body_io.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "core/plane/se2.hpp"
#include "scenes/text/json_text.hpp"
#include "serve/graphs/json_body_io.hpp"
#include "serve/graphs/nav2_graph_io.hpp"
#include "serve/http/json_nesting.hpp"

namespace warren::serve {
namespace {

double heading_of(const OrderedJson& json, const std::string& where) {
  const double theta = finite_number(json, where);
  if (std::abs(theta) > largest_heading) refuse_json(where, "radians, at most 1000");
  return theta;
}

DrawnEdge drawn_edge(const OrderedJson& json, const std::string& where) {
  if (!json.is_array() || (json.size() != 4 && json.size() != 6)) {
    refuse_json(where, "x, y, x, y, or x, y, theta, x, y, theta");
  }
  const auto end = [&](std::size_t first) {
    EdgePlace place{{finite_number(json[first], where), finite_number(json[first + 1], where)}};
    if (json.size() == 6 && !json[first + 2].is_null()) place.theta = heading_of(json[first + 2], where);
    return place;
  };
  return {end(0), end(json.size() / 2)};
}

std::string verdict_json(const EdgeVerdict& verdict) {
  JsonObject json;
  json.add("free", verdict.free);
  if (verdict.free) {
    json.add("clearance", verdict.clearance);
  } else {
    json.add("why", std::string_view(words_of(verdict)));
    json.add("by", std::string_view(verdict.by));
    json.add("distance", verdict.distance);
    json.add("needed", verdict.needed);
  }
  return json.closed();
}

std::string list_of_verdicts(const std::vector<EdgeVerdict>& verdicts) {
  std::string text = "[";
  for (const EdgeVerdict& verdict : verdicts) text.append(text.size() > 1 ? ",\n" : "").append(verdict_json(verdict));
  return text + "]";
}

std::string node_json(const RouteNode& node) {
  JsonObject json;
  json.add("id", node.id);
  json.add_json("at", json_list(std::span<const double>(std::array{node.at.x, node.at.y})));
  if (node.theta) json.add("theta", *node.theta);
  if (node.more != "{}") json.add("more", std::string_view(node.more));
  return json.closed();
}

std::string edge_json(const RouteEdge& edge) {
  JsonObject json;
  json.add("id", edge.id);
  json.add("from", edge.from);
  json.add("to", edge.to);
  if (edge.cost) json.add("cost", *edge.cost);
  if (edge.more != "{}") json.add("more", std::string_view(edge.more));
  return json.closed();
}

std::uint32_t id_of(const OrderedJson& json, const char* key, const std::string& where) {
  const OrderedJson* id = member(json, key);
  if (id == nullptr) refuse_json(where + ": " + key, "a whole number");
  return static_cast<std::uint32_t>(whole_number(*id, where + ": " + key, largest_route_id));
}

/// JSON in a text, as it was told but for what is told beside it; nobody is trusted to have left it so.
std::string more_of(const OrderedJson& json, const std::string& where, std::initializer_list<const char*> told,
                    const Execution& execution) {
  const OrderedJson* more = member(json, "more");
  if (more == nullptr) return "{}";
  if (!more->is_string()) refuse_json(where + ": more", "a text");
  constexpr std::size_t deepest_more = 16;
  OrderedJson kept = json_object_of(more->get<std::string>(), deepest_more, execution);
  for (const char* key : told) kept.erase(key);
  check_properties(kept, where);
  return kept.dump();
}

RouteNode node_of(const OrderedJson& json, const std::string& where, const Execution& execution) {
  if (!json.is_object()) refuse_json(where, "an object");
  const OrderedJson* at = member(json, "at");
  if (at == nullptr || !at->is_array() || at->size() != 2) refuse_json(where + ": at", "x, y");
  RouteNode node{.id = id_of(json, "id", where),
                 .at = {finite_number((*at)[0], where + ": at"), finite_number((*at)[1], where + ": at")}};
  if (const OrderedJson* theta = member(json, "theta")) node.theta = heading_of(*theta, where + ": theta");
  node.more = more_of(json, where, {"id", "frame"}, execution);
  return node;
}

RouteEdge edge_of(const OrderedJson& json, const std::string& where, const Execution& execution) {
  if (!json.is_object()) refuse_json(where, "an object");
  RouteEdge edge{.id = id_of(json, "id", where), .from = id_of(json, "from", where), .to = id_of(json, "to", where)};
  if (const OrderedJson* cost = member(json, "cost")) edge.cost = finite_number(*cost, where + ": cost");
  edge.more = more_of(json, where, {"id", "startid", "endid", "cost"}, execution);
  return edge;
}

}  // namespace

GraphOptions read_graph_options(std::string_view text) {
  constexpr std::uint64_t most = std::uint64_t{1} << 31U;
  GraphOptions options;
  const OrderedJson json = json_object_of(text, deepest_json, {});
  for (const auto& [key, value] : json.items()) {
    if (key == "kind") {
      const auto kind = value.is_string() ? enum_named<GraphKind>(value.get<std::string>()) : std::nullopt;
      if (!kind) refuse_json("kind", "\"axis\" or \"roadmap\"");
      options.kind = *kind;
    } else if (key == "samples") {
      options.samples = whole_number(value, key, most);
    } else if (key == "neighbours") {
      options.neighbours = static_cast<std::uint32_t>(whole_number(value, key, most));
    } else if (key == "seed") {
      options.seed = whole_number(value, key, std::numeric_limits<std::uint64_t>::max());
    } else {
      refuse_json("body", "the keys kind, samples, neighbours, seed");
    }
  }
  return options;
}

std::vector<DrawnEdge> read_drawn_edges(std::string_view text, const Execution& execution) {
  const OrderedJson json = json_object_of(text, deepest_json, execution);
  if (json.size() != 1 || !json.contains("edges")) refuse_json("body", "the key edges");
  const OrderedJson& list = list_of(json["edges"], "edges", most_route_edges);
  std::vector<DrawnEdge> edges;
  for (std::size_t i = 0; i < list.size(); ++i) edges.push_back(drawn_edge(list[i], fmt::format("edges[{}]", i)));
  return edges;
}

std::string verdicts_json(const std::vector<EdgeVerdict>& verdicts) {
  JsonObject json;
  json.add_json("edges", list_of_verdicts(verdicts));
  return json.closed() + "\n";
}

std::string graph_json(const RouteGraph& graph, const std::vector<EdgeVerdict>& verdicts, const Execution& execution) {
  const auto list = [&](const auto& items, auto json_of_item) {
    std::string text = "[";
    for (const auto& item : items) {
      execution.check();
      text.append(text.size() > 1 ? ",\n" : "").append(json_of_item(item));
    }
    return text + "]";
  };
  JsonObject json;
  json.add("schema", "warren.graph/1");
  json.add("frame", std::string_view(graph.frame));
  json.add("left_out", std::uint64_t{graph.left_out});
  if (graph.more != "{}") json.add("more", std::string_view(graph.more));
  json.add_json("nodes", list(graph.nodes, node_json));
  json.add_json("edges", list(graph.edges, edge_json));
  json.add_json("verdicts", list_of_verdicts(verdicts));
  return json.closed() + "\n";
}

RouteGraph read_graph_json(std::string_view text, const Execution& execution) {
  const OrderedJson json = json_object_of(text, deepest_json, execution);
  const OrderedJson* nodes = member(json, "nodes");
  const OrderedJson* edges = member(json, "edges");
  if (nodes == nullptr || edges == nullptr) refuse_json("body", "the keys nodes and edges, as warren.graph/1 has them");
  RouteGraph graph;
  if (const OrderedJson* frame = member(json, "frame")) {
    if (!frame->is_string()) refuse_json("frame", "a text");
    graph.frame = *frame;
  }
  graph.more = more_of(json, "body", {"type", "features"}, execution);
  std::size_t number = 0;
  for (const OrderedJson& node : list_of(*nodes, "nodes", most_route_nodes)) {
    execution.check();
    graph.nodes.push_back(node_of(node, fmt::format("nodes[{}]", number++), execution));
  }
  number = 0;
  for (const OrderedJson& edge : list_of(*edges, "edges", most_route_edges)) {
    execution.check();
    graph.edges.push_back(edge_of(edge, fmt::format("edges[{}]", number++), execution));
  }
  return graph;
}

}  // namespace warren::serve
