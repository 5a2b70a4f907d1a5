// SPDX-License-Identifier: BSD-3-Clause
// A route graph as Nav2 has it, as plain data: nodes where a robot may go, edges that it may drive, each one way. What
// people have written beside places and ends is kept as the JSON that it was. And
// how such graphs are built, and made simpler.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/question/question.hpp"

namespace warren::serve {

/// An id is one node's; edges may share theirs with each other and with nodes, for Nav2 tells them by their ends, and
/// an edge may lead from a node to itself. The largest number of 32 bits means "none" to Nav2.
struct RouteNode {
  std::uint32_t id = 0;
  Vec2 at = {};                      ///< metres of the map's frame
  std::optional<double> theta = {};  ///< radians; none: whoever stands there may turn
  std::string more = "{}";           ///< further properties, one JSON object
};

struct RouteEdge {
  std::uint32_t id = 0;
  std::uint32_t from = 0;  ///< ids of nodes
  std::uint32_t to = 0;
  std::optional<double> cost = {};  ///< none: its length
  std::string more = "{}";
};

struct RouteGraph {
  std::string frame = "map";
  std::vector<RouteNode> nodes = {};
  std::vector<RouteEdge> edges = {};
  std::string more = "{}";   ///< of the file
  std::size_t left_out = 0;  ///< features that are neither, and nodes whose id a later one has: no edge leads there
};

inline constexpr std::uint64_t largest_route_id = 0xfffffffeU;
inline constexpr std::size_t most_route_nodes = 20'000;
inline constexpr std::size_t most_route_edges = 100'000;

/// Where each edge leads, as places in graph.nodes. Throws HttpError (400, "bad_graph") where Nav2 would not take the
/// graph: no nodes, no edges, ends that are no nodes; where two nodes have one id; and where it is too large to be
/// edited.
struct RouteEnds {
  std::size_t from = 0;
  std::size_t to = 0;
};
std::vector<RouteEnds> ends_of(const RouteGraph& graph);

// Route graphs that nobody has to draw: the axis of what is free, or a roadmap of samples, built as `warren build` does
// and numbered as `warren export` does.

/// axis: as far from all obstacles as can be; of a body that turns, that of the disc around it, where it may stand in
/// all headings. roadmap: of samples.
enum class GraphKind : std::uint8_t { axis, roadmap };
constexpr auto enum_names(GraphKind) { return std::array<std::string_view, 2>{"axis", "roadmap"}; }

struct GraphOptions {
  GraphKind kind = GraphKind::axis;
  std::optional<std::uint64_t> samples = {};     ///< of a roadmap; none: it grows until what is joined stays joined
  std::optional<std::uint32_t> neighbours = {};  ///< of a roadmap; none: by its rule
  std::uint64_t seed = 1;
};

/// Throws UsageError where there is no axis in such a world; any walls will do.
void check_has_axis(const Scene& scene, const RobotSpec& robot, double clearance);
/// Throws UsageError for what can't be built in this world, HttpError for more samples than can be edited, Stopped.
Roadmap built_roadmap(const Scene& scene, const RobotSpec& robot, double clearance, const GraphOptions& options,
                      const Execution& execution);

/// The free edges of a roadmap. Throws UsageError for bodies that drive no straight edges, HttpError for more than can
/// be edited, Stopped.
RouteGraph graph_of_roadmap(const Roadmap& roadmap, const Execution& execution);

// Route graphs with fewer nodes: where a chain of nodes leads on without a choice and nobody has written anything on
// them, straight edges replace it that it stays near to (Douglas and Peucker, 1973). What people have written stays:
// nodes with a heading, metadata or operations, edges with more than ends and a cost, edges that lead one way.

/// May a new edge lead straight from one place to the other?
using MayLead = std::function<bool(Vec2, Vec2)>;

/// No place of a chain is farther than `within` (metres, >= 0) from the edge that replaces it, which costs what the
/// chain costs in that direction; an edge whose cost is its length gets its own. Two edges never join the same two
/// nodes that were joined by a chain. may_lead: empty, everywhere. Throws HttpError as ends_of() does, Stopped.
RouteGraph simplified(const RouteGraph& graph, double within, const MayLead& may_lead, const Execution& execution);

/// The same, but that new edges lead only where the verification finds the body of the question free in the scene, with
/// all that closes places of it. Throws UsageError for bodies that drive no straight edges, too.
RouteGraph simplified_in(const Scene& scene, const Question& body, const RouteGraph& graph, double within,
                         const Execution& execution);

}  // namespace warren::serve
