// SPDX-License-Identifier: BSD-3-Clause
#include "serve/graphs/nav2_graph_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/base/types.hpp"
#include "scenes/text/json_text.hpp"
#include "serve/http/http_message.hpp"

namespace warren::serve {
namespace {

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
    if (!json_.contains(key)) refuse_json(where_ + ": " + key, "a whole number, the id of a node or edge");
    const auto number = static_cast<std::uint32_t>(whole_number(json_[key], where_ + ": " + key, largest_route_id));
    json_.erase(key);
    return number;
  }
  std::optional<std::string> text(const char* key) {
    if (!json_.contains(key)) return std::nullopt;
    if (!json_[key].is_string()) refuse_json(where_ + ": " + key, "a text");
    const std::string text = json_[key];
    json_.erase(key);
    return text;
  }
  std::optional<double> number(const char* key) {
    if (!json_.contains(key)) return std::nullopt;
    const double number = finite_number(json_[key], where_ + ": " + key);
    json_.erase(key);
    return number;
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

class Reader {
 public:
  void take(const OrderedJson& feature, std::size_t number) {
    const std::string where = fmt::format("feature {}", number + 1);
    const OrderedJson* geometry = feature.is_object() ? member(feature, "geometry") : nullptr;
    if (geometry == nullptr || !geometry->is_object()) refuse_json(where, "a feature with a geometry");
    const OrderedJson* type = member(*geometry, "type");
    if (type != nullptr && *type == "Point") {
      take_node(feature, *geometry, where);
    } else if (type != nullptr && (*type == "MultiLineString" || *type == "LineString")) {
      take_edge(feature, where);
    } else {
      ++graph.left_out;
    }
  }
  RouteGraph graph;

 private:
  void take_node(const OrderedJson& feature, const OrderedJson& geometry, const std::string& where) {
    Properties properties(feature, where);
    RouteNode node{.id = properties.id("id")};
    const OrderedJson* at = member(geometry, "coordinates");
    if (at == nullptr || !at->is_array() || at->size() < 2) refuse_json(where, "coordinates x, y");
    node.at = {finite_number((*at)[0], where + ": x"), finite_number((*at)[1], where + ": y")};
    const std::string frame = properties.text("frame").value_or("map");
    if (graph.nodes.empty()) graph.frame = frame;
    if (frame != graph.frame) {
      refuse_json(where + ": frame", fmt::format("{}, as nodes before have it", graph.frame));
    }
    node.theta = properties.heading();
    node.more = properties.rest();
    const auto [place, is_new] = places_.emplace(node.id, graph.nodes.size());
    if (is_new) {
      graph.nodes.push_back(std::move(node));
    } else {  // to Nav2 the last of them is the one that edges lead to
      graph.nodes[place->second] = std::move(node);
      ++graph.left_out;
    }
  }
  void take_edge(const OrderedJson& feature, const std::string& where) {
    Properties properties(feature, where);
    RouteEdge edge{.id = properties.id("id")};
    edge.from = properties.id("startid");
    edge.to = properties.id("endid");
    edge.cost = properties.number("cost");
    edge.more = properties.rest();
    graph.edges.push_back(std::move(edge));
  }

  std::map<std::uint32_t, std::size_t> places_;  // of nodes, by their ids
};

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

}  // namespace

void check_properties(const OrderedJson& properties, const std::string& where) {
  const auto says = [&](const char* key) { return properties.contains(key) && !properties[key].is_null(); };
  if (says("metadata")) check_metadata(properties["metadata"], where + ": metadata");
  if (!says("operations")) return;
  for (const OrderedJson& operation : properties["operations"]) {
    const std::string place = where + ": operations";
    for (const char* key : {"type", "trigger"}) {
      if (!operation.is_object() || !operation.contains(key) || !operation[key].is_string()) {
        refuse_json(place, fmt::format("{} as a text in each of them", key));
      }
    }
    if (operation.contains("metadata")) check_metadata(operation["metadata"], place + ".metadata");
  }
}

RouteGraph read_nav2_graph(std::string_view geojson, const Execution& execution) {
  OrderedJson file = json_object_of(geojson, deepest_geojson, execution);
  if (!file.contains("features"))
    refuse_json("body", "a FeatureCollection of GeoJSON, as Nav2's route server loads it");
  const OrderedJson& features = list_of(file["features"], "features", most_route_nodes + most_route_edges);
  Reader reader;
  for (std::size_t i = 0; i < features.size(); ++i) {
    execution.check();
    reader.take(features[i], i);
  }
  file.erase("features");
  file.erase("type");
  reader.graph.more = file.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  return std::move(reader.graph);
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
