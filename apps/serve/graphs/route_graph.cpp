// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/graphs/route_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <tuple>

#include "apps/serve/http/http_message.hpp"
#include "core/base/trigonometry.hpp"
#include "core/plane/se2.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_price.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren::serve {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw HttpError(400, "bad_graph", "graph", message); }

/// It turns at the nodes and goes straight along the edges, as the disc that it is.
bool is_round_drive(const RobotSpec& robot) {
  return robot.kind == RobotKind::car && robot.steering == SteeringKind::differential && robot.outline.empty();
}

RobotSpec disc_around(const RobotSpec& robot) {
  if (is_round_drive(robot)) return {.kind = RobotKind::disc, .radius = robot.radius};
  if (robot.kind != RobotKind::polygon) return robot;
  return {.kind = RobotKind::disc, .radius = outline_reach(robot.outline)};
}

void check_size(std::uint64_t nodes, std::uint64_t edge_ends) {
  if (nodes <= most_route_nodes && edge_ends <= most_route_edges) return;
  throw HttpError(413, "graph_too_large", "graph",
                  fmt::format("it has more than {} nodes or {} edges, each one way, which nobody edits by hand; "
                              "'warren build' and 'warren export' write it",
                              grouped(most_route_nodes), grouped(most_route_edges)));
}

/// Node v has id v; the i-th edge has that of all nodes and i.
RouteGraph graph_of(const RoadmapParts& parts, bool has_headings, const Execution& execution) {
  check_size(parts.vertex_count(), parts.to.size());
  RouteGraph graph;
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    const std::span<const double> state = parts.state(v);
    RouteNode node{.id = v, .at = {state[0], state[1]}};
    if (has_headings) node.theta = state[2];
    graph.nodes.push_back(std::move(node));
  }
  auto id = static_cast<std::uint32_t>(parts.vertex_count());
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    execution.check();
    for (EdgeEnd end = parts.first[v]; end < parts.first[v + 1]; ++end) {
      if (parts.state_of_end(end) != EdgeState::free) continue;
      const Vec2 from = graph.nodes[v].at;
      const Vec2 to = graph.nodes[parts.to[end]].at;
      graph.edges.push_back({.id = id++, .from = v, .to = parts.to[end], .cost = distance(from, to)});
    }
  }
  return graph;
}

double distance_to_leg(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double share = square > 0.0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return distance(p, a + share * along);
}

std::vector<Se2> poses_along(const DrawnEdge& edge) {
  const Vec2 way = edge.to.at - edge.from.at;
  const double along = portable::atan2(way.y, way.x);
  std::vector<Se2> path;
  for (const EdgePlace& end : {edge.from, edge.to}) {
    if (end.theta) {
      path.push_back({end.at.x, end.at.y, *end.theta});
    } else {  // all round and back, in legs that can be read one way only
      constexpr int parts = 3;
      for (int i = 0; i <= parts; ++i) {
        path.push_back({end.at.x, end.at.y, along + i * 2.0 * std::numbers::pi / parts});
      }
    }
  }
  return path;
}

EdgeVerdict verdict_of(const Verification& found, double needed) {
  if (found.verified) return {.free = true, .clearance = found.min_clearance};
  EdgeVerdict verdict{.needed = needed};
  if (found.first_violation) {
    verdict.by = found.first_violation->obstacle;
    verdict.distance = found.first_violation->distance;
  }
  return verdict;
}

class Simplifying {
 public:
  Simplifying(const RouteGraph& graph, double within, const MayLead& may_lead, const Execution& execution)
      : graph_(graph),
        ends_(ends_of(graph)),
        within_(within),
        may_lead_(may_lead),
        execution_(execution),
        around_(graph.nodes.size()),
        is_gone_(graph.nodes.size(), false) {
    for (std::size_t e = 0; e < ends_.size(); ++e) {
      execution_.poll(e);
      const auto [from, to] = ends_[e];
      between_[{from, to}].push_back(e);
      around_[from].insert(to);
      around_[to].insert(from);
    }
    for (std::size_t v = 0; v < around_.size(); ++v) is_passed_.push_back(is_passed(v));
  }

  RouteGraph made() {
    RouteGraph made = graph_;
    replace_chains();
    made.nodes.clear();
    made.edges.clear();
    for (std::size_t v = 0; v < is_gone_.size(); ++v) {
      if (!is_gone_[v]) made.nodes.push_back(graph_.nodes[v]);
    }
    for (std::size_t e = 0; e < ends_.size(); ++e) {
      const auto instead = instead_.find(e);
      if (instead != instead_.end()) {
        made.edges.push_back(instead->second);
      } else if (!is_gone_[ends_[e].from] && !is_gone_[ends_[e].to]) {
        made.edges.push_back(graph_.edges[e]);
      }
    }
    return made;
  }

 private:
  std::size_t count(std::size_t from, std::size_t to) const {
    const auto known = between_.find({from, to});
    return known == between_.end() ? 0 : known->second.size();
  }

  /// Does it lead on, from one neighbour to the other, in the same directions on both sides, with nothing said of it?
  bool is_passed(std::size_t v) const {
    const RouteNode& node = graph_.nodes[v];
    if (node.theta || node.more != "{}" || around_[v].size() != 2 || around_[v].contains(v)) return false;
    const std::size_t a = *around_[v].begin();
    const std::size_t b = *around_[v].rbegin();
    const bool goes_on = count(a, v) == count(v, b) && count(b, v) == count(v, a);
    if (!goes_on || count(a, v) > 1 || count(b, v) > 1) return false;
    for (const auto& [from, to] : {std::pair{a, v}, {v, b}, {b, v}, {v, a}}) {
      if (count(from, to) > 0 && graph_.edges[between_.at({from, to}).front()].more != "{}") return false;
    }
    return true;
  }

  /// From a node that stays to one, over nodes that need not; a round without one that stays begins at its first.
  void replace_chains() {
    std::vector<bool> seen(is_passed_.size(), false);
    const auto follow = [&](std::size_t first, std::size_t next) {
      std::vector<std::size_t> chain{first, next};
      while (is_passed_[chain.back()] && chain.back() != first) {
        const std::size_t v = chain.back();
        seen[v] = true;
        const std::size_t before = chain[chain.size() - 2];
        chain.push_back(*around_[v].begin() == before ? *around_[v].rbegin() : *around_[v].begin());
      }
      replace(chain);
    };
    for (std::size_t v = 0; v < is_passed_.size(); ++v) {
      if (is_passed_[v]) continue;
      for (const std::size_t next : around_[v]) {
        if (is_passed_[next] && !seen[next]) follow(v, next);
      }
    }
    for (std::size_t v = 0; v < is_passed_.size(); ++v) {
      if (!is_passed_[v] || seen[v]) continue;
      seen[v] = true;
      follow(v, *around_[v].begin());
    }
  }

  /// Part by part, for a chain may have as many as it has nodes; each costs its length.
  void replace(const std::vector<std::size_t>& chain) {
    std::vector<std::pair<std::size_t, std::size_t>> parts{{0, chain.size() - 1}};  // from node to node, the next last
    while (!parts.empty()) {
      execution_.check();
      const auto [first, last] = parts.back();
      parts.pop_back();
      const std::size_t at = last - first < 2 ? last : replaced_or_cut(chain, first, last);
      if (at < last) parts.insert(parts.end(), {{at, last}, {first, at}});
    }
  }
  /// One edge takes the part's place; or else gives the node at which to cut it.
  std::size_t replaced_or_cut(const std::vector<std::size_t>& chain, std::size_t first, std::size_t last) {
    const Vec2 a = graph_.nodes[chain[first]].at;
    const Vec2 b = graph_.nodes[chain[last]].at;
    std::size_t farthest = first + (last - first) / 2;
    double most = within_;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = distance_to_leg(graph_.nodes[chain[i]].at, a, b);
      if (off > most) std::tie(farthest, most) = std::pair{i, off};
    }
    const std::pair<std::size_t, std::size_t> joined = std::minmax(chain[first], chain[last]);
    const bool is_new = chain[first] != chain[last] && !around_[chain[first]].contains(chain[last]);
    if (most > within_ || !is_new || joined_.contains(joined) || (may_lead_ && !may_lead_(a, b))) {
      return farthest;
    }
    joined_.insert(joined);
    for (std::size_t i = first + 1; i < last; ++i) is_gone_[chain[i]] = true;
    const std::vector<std::size_t> there(chain.begin() + static_cast<std::ptrdiff_t>(first),
                                         chain.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    join(there);
    join({there.rbegin(), there.rend()});
    return last;
  }

  /// One edge for a chain, where it leads this way.
  void join(const std::vector<std::size_t>& chain) {
    if (count(chain[0], chain[1]) == 0) return;
    constexpr double of_floats = 1e-6;  // Nav2 keeps costs so
    double cost = 0.0;
    bool is_length = true;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const RouteEdge& edge = graph_.edges[between_.at({chain[i - 1], chain[i]}).front()];
      const double length = distance(graph_.nodes[chain[i - 1]].at, graph_.nodes[chain[i]].at);
      cost += edge.cost.value_or(length);
      is_length = is_length && (!edge.cost || std::abs(*edge.cost - length) <= of_floats * (1.0 + length));
    }
    const std::size_t first = between_.at({chain[0], chain[1]}).front();
    RouteEdge edge = graph_.edges[first];
    edge.to = graph_.nodes[chain.back()].id;
    edge.cost = is_length ? std::optional<double>() : cost;
    instead_.emplace(first, std::move(edge));
  }

  const RouteGraph& graph_;
  std::vector<RouteEnds> ends_;
  double within_;
  const MayLead& may_lead_;
  const Execution& execution_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> between_;  // edges, by their ends
  std::vector<std::set<std::size_t>> around_;
  std::vector<bool> is_passed_;
  std::vector<bool> is_gone_;
  std::set<std::pair<std::size_t, std::size_t>> joined_;
  std::map<std::size_t, RouteEdge> instead_;  // of the first edge of a chain
};

}  // namespace

void check_drives_edges(const RobotSpec& robot) {
  if (robot.kind == RobotKind::point || robot.kind == RobotKind::disc || robot.kind == RobotKind::polygon) return;
  if (is_round_drive(robot)) return;
  if (robot.kind != RobotKind::car) throw UsageError("route graphs are for bodies of the plane");
  throw UsageError(
      fmt::format("{}; serve the world with --robot of its body alone",
                  robot.steering == SteeringKind::differential
                      ? "a drive with an outline has room for some turns at a node and for others not, which a route "
                        "graph does not say"
                      : "a car drives curves, and the edges of a route graph are straight"));
}

RobotSpec body_on_edges(const Roadmap& roadmap) {
  RobotSpec robot = roadmap.robot;
  robot.steering = roadmap.options.car.steering.value_or(robot.steering);
  check_drives_edges(robot);
  return is_round_drive(robot) ? disc_around(robot) : robot;
}

EdgeJudge::EdgeJudge(const Scene& scene, const Box& room, RobotSpec robot, double clearance)
    : scene_(scene), room_(room), robot_(std::move(robot)), clearance_(clearance) {}

std::vector<EdgeVerdict> EdgeJudge::judge(const std::vector<DrawnEdge>& edges, const Execution& execution) const {
  check_drives_edges(robot_);
  execution.reserve(edges.size() * sizeof(EdgeVerdict));
  const ObstacleIndex* near = edges.empty() ? nullptr : index(execution);
  std::vector<EdgeVerdict> verdicts;
  for (const DrawnEdge& edge : edges) {
    execution.check();
    verdicts.push_back(judge(edge, near, execution));
  }
  return verdicts;
}

const ObstacleIndex* EdgeJudge::index(const Execution& execution) const {
  if (scene_.map) return nullptr;
  return &index_.get(execution, [&] { return std::make_unique<ObstacleIndex>(scene_, execution); });
}

double EdgeJudge::clearance_at(const EdgePlace& place, const Execution& execution) const {
  if (!robot_.outline.empty()) {
    const Se2 pose{place.at.x, place.at.y, place.theta.value()};
    const PoseVerifyOptions options{.clearance = clearance_};
    return verify_se2(scene_, robot_.outline, {&pose, 1}, options, execution, index(execution)).min_clearance;
  }
  const VerifyOptions options{.radius = robot_.radius, .clearance = clearance_};
  return verify_path(scene_, {&place.at, 1}, options, execution, index(execution)).min_clearance;
}

EdgeVerdict EdgeJudge::judge(const DrawnEdge& edge, const ObstacleIndex* index, const Execution& execution) const {
  for (const EdgePlace& end : {edge.from, edge.to}) {  // judges need not walk to where nothing is
    if (!room_.contains(end.at)) return {.by = fmt::format("{}, {} lies outside of the world", end.at.x, end.at.y)};
  }
  if (robot_.kind == RobotKind::polygon) {
    const PoseVerifyOptions options{.clearance = clearance_};
    return verdict_of(verify_se2(scene_, robot_.outline, poses_along(edge), options, execution, index), clearance_);
  }
  const VerifyOptions options{.radius = robot_.radius, .clearance = clearance_};
  const Vec2 path[] = {edge.from.at, edge.to.at};
  return verdict_of(verify_path(scene_, path, options, execution, index), options.reach());
}

std::string words_of(const EdgeVerdict& verdict) {
  if (verdict.free) return "free";
  if (verdict.needed > 0.0 && verdict.distance > 0.0) {
    return fmt::format("{} is {:.3g} away, and {:.3g} is needed", verdict.by, verdict.distance, verdict.needed);
  }
  return verdict.distance == 0.0 && verdict.by.find("outside") != std::string::npos ? verdict.by
                                                                                    : "it meets " + verdict.by;
}

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

RouteGraph graph_of_roadmap(const Roadmap& roadmap, const Execution& execution) {
  const bool turns = body_on_edges(roadmap).kind == RobotKind::polygon;
  if (roadmap.lattice == nullptr) return graph_of(roadmap.arrays.parts(), turns, execution);
  check_size(count_states(roadmap), 0);
  const RoadmapArrays arrays = arrays_of(roadmap.lattice->passages(), execution);
  return graph_of(arrays.parts(), turns, execution);
}

void check_has_axis(const Scene& scene, const RobotSpec& robot, double clearance) {
  check_buildable(scene, {.robot = disc_around(robot), .clearance = clearance}, {.planner = PlannerKind::voronoi});
}

Roadmap built_roadmap(const Scene& scene, const RobotSpec& robot, double clearance, const GraphOptions& options,
                      const Execution& execution) {
  if (options.samples) check_size(*options.samples, 0);
  const bool is_axis = options.kind == GraphKind::axis;
  const Question body{.robot = is_axis ? disc_around(robot) : robot, .clearance = clearance};
  SolveOptions how{.planner = is_axis ? PlannerKind::voronoi : PlannerKind::prm, .seed = options.seed};
  how.roadmap = {.samples = options.samples, .neighbours = options.neighbours};
  how.validate();
  check_buildable(scene, body, how);
  execution.reserve(scene.walls.size() * sizeof(Segment));
  return build_within(scene, body, how, execution, IndexChoice::none);
}

RouteGraph simplified(const RouteGraph& graph, double within, const MayLead& may_lead, const Execution& execution) {
  return Simplifying(graph, within, may_lead, execution).made();
}

RouteGraph simplified_in(const Scene& scene, const Question& body, const RouteGraph& graph, double within,
                         const Execution& execution) {
  const RobotSpec robot = robot_of(scene, body);
  check_drives_edges(robot);
  const std::optional<Scene> barred = effective_scene(scene, prices_of(scene, body), execution);
  const Scene& judged = barred ? *barred : scene;
  const EdgeJudge judge(judged, room_of(judged, execution), robot, clearance_of(scene, body));
  const auto is_free = [&](Vec2 a, Vec2 b) { return judge.judge({{{.at = a}, {.at = b}}}, execution).front().free; };
  return simplified(graph, within, is_free, execution);
}

}  // namespace warren::serve
