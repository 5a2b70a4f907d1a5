// SPDX-License-Identifier: BSD-3-Clause
// Route graphs as JSON, between page and service, and as files of Nav2.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "apps/serve/graphs/json_body_io.hpp"
#include "apps/serve/graphs/route_graph.hpp"
#include "apps/serve/http/http_message.hpp"
#include "core/plane/se2.hpp"

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
  if (verdict.free) return json_object("free", true, "clearance", verdict.clearance);
  return json_object("free", false, "why", words_of(verdict), "by", verdict.by, "distance", verdict.distance, "needed",
                     verdict.needed);
}

std::string node_json(const RouteNode& node) {
  JsonObject json;
  json.add("id", node.id, "at", numbers_json(std::array{node.at.x, node.at.y}));
  if (node.theta) json.add("theta", *node.theta);
  if (node.more != "{}") json.add("more", std::string_view(node.more));
  return json.closed();
}

std::string edge_json(const RouteEdge& edge) {
  JsonObject json;
  json.add("id", edge.id, "from", edge.from, "to", edge.to);
  if (edge.cost) json.add("cost", *edge.cost);
  if (edge.more != "{}") json.add("more", std::string_view(edge.more));
  return json.closed();
}

bool is_plain(const OrderedJson& value) { return value.is_number() || value.is_boolean() || value.is_string(); }

void check_metadata(const OrderedJson& metadata, const std::string& where) {
  if (!metadata.is_object()) refuse_json(where, "an object");
  for (const auto& [key, value] : metadata.items()) {
    const std::string place = where + "." + key;
    if (value.is_object()) {
      check_metadata(value, place);
    } else if (value.is_array() ? !std::all_of(value.begin(), value.end(), is_plain) : !is_plain(value)) {
      refuse_json(place, "a number, a text, true, false, a list of them or an object; Nav2 loads nothing else");
    }
  }
}

/// Does Nav2 take these properties' metadata and operations? Throws HttpError (400) for the first that it would not.
void check_properties(const OrderedJson& properties, const std::string& where) {
  if (const OrderedJson* metadata = member(properties, "metadata")) check_metadata(*metadata, where + ": metadata");
  const OrderedJson* operations = member(properties, "operations");
  if (operations == nullptr) return;
  for (const OrderedJson& operation : *operations) {
    const std::string place = where + ": operations";
    for (const char* key : {"type", "trigger"}) {
      if (!operation.is_object() || !operation.contains(key) || !operation[key].is_string()) {
        refuse_json(place, fmt::format("{} as a text in each of them", key));
      }
    }
    if (operation.contains("metadata")) check_metadata(operation["metadata"], place + ".metadata");
  }
}

std::uint32_t route_id(const OrderedJson& json, const std::string& where) {
  return static_cast<std::uint32_t>(whole_number(json, where, largest_route_id));
}

std::uint32_t id_of(const OrderedJson& json, const char* key, const std::string& where) {
  const OrderedJson* id = member(json, key);
  if (id == nullptr) refuse_json(where + ": " + key, "a whole number");
  return route_id(*id, where + ": " + key);
}

/// JSON in a text, as it was told but for what is told beside it; nobody is trusted to have left it so.
std::string more_of(const OrderedJson& json, const std::string& where, std::initializer_list<const char*> told,
                    const Execution& execution) {
  const OrderedJson* more = member(json, "more");
  if (more == nullptr) return "{}";
  constexpr std::size_t deepest_more = 16;
  OrderedJson kept = json_object_of(text_in(*more, where + ": more"), deepest_more, execution);
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

constexpr std::size_t deepest_geojson = 16;

/// A feature's properties, from which what has been read is taken away.
class Properties {
 public:
  Properties(const OrderedJson& feature, std::string where) : where_(std::move(where)) {
    const OrderedJson* properties = member(feature, "properties");
    if (properties == nullptr || !properties->is_object()) refuse_json(where_, "properties");
    json_ = *properties;
  }
  std::uint32_t id(const char* key) {
    const auto id = take(key, route_id);
    if (!id) refuse_json(where_ + ": " + key, "a whole number, the id of a node or edge");
    return *id;
  }
  /// What read(value, place) makes of it, if it is there.
  template <class Read>
  auto take(const char* key, const Read& read) -> std::optional<decltype(read(OrderedJson(), key))> {
    if (!json_.contains(key)) return std::nullopt;
    std::optional taken(read(json_[key], where_ + ": " + key));
    json_.erase(key);
    return taken;
  }
  std::optional<double> heading() {
    if (!json_.contains("metadata") || !json_["metadata"].is_object()) return std::nullopt;
    const auto theta = json_["metadata"].find("theta");
    if (theta == json_["metadata"].end() || !theta->is_number()) return std::nullopt;
    const double heading = *theta;
    json_["metadata"].erase("theta");
    if (json_["metadata"].empty()) json_.erase("metadata");
    return heading;
  }
  std::string rest() const {
    check_properties(json_, where_);
    return json_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  }

 private:
  std::string where_;
  OrderedJson json_;
};

/// places: of the graph's nodes, by their ids.
void take_feature(RouteGraph& graph, std::map<std::uint32_t, std::size_t>& places, const OrderedJson& feature,
                  const std::string& where) {
  const OrderedJson* geometry = feature.is_object() ? member(feature, "geometry") : nullptr;
  if (geometry == nullptr || !geometry->is_object()) refuse_json(where, "a feature with a geometry");
  const OrderedJson* type = member(*geometry, "type");
  const bool is_node = type != nullptr && *type == "Point";
  const bool is_edge = type != nullptr && (*type == "MultiLineString" || *type == "LineString");
  if (!is_node && !is_edge) {
    ++graph.left_out;
    return;
  }
  Properties properties(feature, where);
  if (is_edge) {
    graph.edges.push_back({.id = properties.id("id"),
                           .from = properties.id("startid"),
                           .to = properties.id("endid"),
                           .cost = properties.take("cost", finite_number),
                           .more = properties.rest()});
    return;
  }
  RouteNode node{.id = properties.id("id")};
  const OrderedJson* at = member(*geometry, "coordinates");
  if (at == nullptr || !at->is_array() || at->size() < 2) refuse_json(where, "coordinates x, y");
  node.at = {finite_number((*at)[0], where + ": x"), finite_number((*at)[1], where + ": y")};
  const std::string frame = properties.take("frame", text_in).value_or("map");
  if (graph.nodes.empty()) graph.frame = frame;
  if (frame != graph.frame) refuse_json(where + ": frame", fmt::format("{}, as nodes before have it", graph.frame));
  node.theta = properties.heading();
  node.more = properties.rest();
  const auto [place, is_new] = places.emplace(node.id, graph.nodes.size());
  if (is_new) {
    graph.nodes.push_back(std::move(node));
  } else {  // to Nav2 the last of them is the one that edges lead to
    graph.nodes[place->second] = std::move(node);
    ++graph.left_out;
  }
}

/// What `more` holds, to stand in an object after other members.
void append_members(std::string& text, std::string_view more) {
  if (more.size() > 2) text.append(",").append(more.substr(1, more.size() - 2));
}

/// Metadata keep the point of whole numbers: Nav2 tells the type of a value by it.
std::string with_heading(const RouteNode& node) {
  if (!node.theta) return node.more;
  OrderedJson json = OrderedJson::parse(node.more);
  if (!json["metadata"].is_object()) json["metadata"] = OrderedJson::object();
  json["metadata"]["theta"] = *node.theta;
  return json.dump();
}

void append_place(std::string& text, Vec2 at) { append_json_list(text, std::array{at.x, at.y}); }

}  // namespace

GraphOptions read_graph_options(std::string_view text) {
  constexpr std::uint64_t most = std::uint64_t{1} << 31U;
  GraphOptions options;
  const OrderedJson json = json_object_of(text, deepest_json, {});
  const auto kind_of = [](const OrderedJson& value, const std::string& key) {
    const auto kind = value.is_string() ? enum_named<GraphKind>(value.get<std::string>()) : std::nullopt;
    if (!kind) refuse_json(key, "\"axis\" or \"roadmap\"");
    return *kind;
  };
  const auto up_to = [](std::uint64_t largest) {
    return [=](const OrderedJson& value, const std::string& key) { return whole_number(value, key, largest); };
  };
  take_keys(json, "body",
            {{"kind", into(options.kind, kind_of)},
             {"samples", into(options.samples, up_to(most))},
             {"neighbours", into(options.neighbours, up_to(most))},
             {"seed", into(options.seed, up_to(std::numeric_limits<std::uint64_t>::max()))}});
  return options;
}

std::vector<DrawnEdge> read_drawn_edges(std::string_view text, const Execution& execution) {
  const OrderedJson json = json_object_of(text, deepest_json, execution);
  if (json.size() != 1 || !json.contains("edges")) refuse_json("body", "the key edges");
  return items_of(json["edges"], "edges", most_route_edges, drawn_edge);
}

std::string verdicts_json(const std::vector<EdgeVerdict>& verdicts) {
  return json_object("edges", JsonText{json_list_of(verdicts, ",\n", verdict_json)}) + "\n";
}

std::string graph_json(const RouteGraph& graph, const std::vector<EdgeVerdict>& verdicts, const Execution& execution) {
  const auto list = [&](const auto& items, auto json_of_item) {
    return json_list_of(items, ",\n", [&](const auto& item) { return execution.check(), json_of_item(item); });
  };
  JsonObject json;
  json.add("schema", "warren.graph/1", "frame", graph.frame, "left_out", std::uint64_t{graph.left_out});
  if (graph.more != "{}") json.add("more", std::string_view(graph.more));
  json.add_json("nodes", list(graph.nodes, node_json));
  json.add_json("edges", list(graph.edges, edge_json));
  json.add_json("verdicts", json_list_of(verdicts, ",\n", verdict_json));
  return json.closed() + "\n";
}

RouteGraph read_graph_json(std::string_view text, const Execution& execution) {
  const OrderedJson json = json_object_of(text, deepest_json, execution);
  const OrderedJson* nodes = member(json, "nodes");
  const OrderedJson* edges = member(json, "edges");
  if (nodes == nullptr || edges == nullptr) refuse_json("body", "the keys nodes and edges, as warren.graph/1 has them");
  RouteGraph graph;
  if (const OrderedJson* frame = member(json, "frame")) graph.frame = text_in(*frame, "frame");
  graph.more = more_of(json, "body", {"type", "features"}, execution);
  graph.nodes = items_of(*nodes, "nodes", most_route_nodes, [&](const OrderedJson& node, const std::string& where) {
    execution.check();
    return node_of(node, where, execution);
  });
  graph.edges = items_of(*edges, "edges", most_route_edges, [&](const OrderedJson& edge, const std::string& where) {
    execution.check();
    return edge_of(edge, where, execution);
  });
  return graph;
}

RouteGraph read_nav2_graph(std::string_view geojson, const Execution& execution) {
  OrderedJson file = json_object_of(geojson, deepest_geojson, execution);
  if (!file.contains("features"))
    refuse_json("body", "a FeatureCollection of GeoJSON, as Nav2's route server loads it");
  const OrderedJson& features = list_of(file["features"], "features", most_route_nodes + most_route_edges);
  RouteGraph graph;
  std::map<std::uint32_t, std::size_t> places;
  for (std::size_t i = 0; i < features.size(); ++i) {
    execution.check();
    take_feature(graph, places, features[i], fmt::format("feature {}", i + 1));
  }
  file.erase("features");
  file.erase("type");
  graph.more = file.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  return graph;
}

std::string nav2_graph_text(const RouteGraph& graph, const std::vector<RouteEnds>& ends, const Execution& execution) {
  std::string text = "{\"type\":\"FeatureCollection\"";
  append_members(text, graph.more == "{}" ? "{\"name\":\"graph\"}" : graph.more);
  text += ",\"features\":[\n";
  const std::string frame = json_string(graph.frame);
  for (const RouteNode& node : graph.nodes) {
    execution.check();
    text += fmt::format("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"frame\":{}", node.id, frame);
    append_members(text, with_heading(node));
    text += "},\"geometry\":{\"type\":\"Point\",\"coordinates\":";
    append_place(text, node.at);
    text += "}},\n";
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    execution.check();
    const RouteEdge& edge = graph.edges[i];
    const Vec2 from = graph.nodes[ends[i].from].at;
    const Vec2 to = graph.nodes[ends[i].to].at;
    text += fmt::format("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"startid\":{},\"endid\":{},\"cost\":{}",
                        edge.id, edge.from, edge.to, json_number(edge.cost.value_or(distance(from, to))));
    append_members(text, edge.more);
    text += "},\"geometry\":{\"type\":\"MultiLineString\",\"coordinates\":[[";
    append_place(text, from);
    text += ",";
    append_place(text, to);
    text += i + 1 < graph.edges.size() ? "]]}},\n" : "]]}}\n";
  }
  return text + "]}\n";
}

}  // namespace warren::serve
