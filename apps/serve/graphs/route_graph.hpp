// SPDX-License-Identifier: BSD-3-Clause
// A route graph as Nav2 has it, as plain data: nodes where a robot may go, edges that it may drive, each one way. What
// people have written beside places and ends is kept as the JSON that it was. Which of its edges are free, how such
// graphs are built, made simpler, and told as JSON: what the page and the service say to each other, and files of Nav2
// (route_graph_io.cpp).
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
#include "parallel/once.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/question/question.hpp"
#include "verify/near/obstacle_index.hpp"

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

// May this body go straight from here to there? Asked of the judges of verify/, which share nothing with planners,
// about edges that people draw.
//
// A body that turns stands at a place without a heading in all of them: it turns there on the spot, all round, and
// faces along the edges that it drives. Between two headings it goes straight while it turns evenly the shorter way, as
// the edges of its roadmaps do. A car can do neither, so it has no such edges; a round differential drive is its disc.

struct EdgePlace {
  Vec2 at;
  std::optional<double> theta = {};  ///< radians; of bodies that turn
};

struct DrawnEdge {
  EdgePlace from;
  EdgePlace to;
};

struct EdgeVerdict {
  bool free = false;
  double clearance = 0.0;  ///< least distance between the body and anything, where it is free
  std::string by = {};     ///< what is in the way, where it is not: Violation::obstacle
  double distance = 0.0;   ///< to that, of the edge or of the body that turns
  double needed = 0.0;     ///< what that should be
};

/// Whether bodies of the plane fit along edges, and how much room they have. Refers to the scene. Any number of threads
/// may ask.
class EdgeJudge {
 public:
  /// room: the box of all that there is; nothing is free outside of it.
  EdgeJudge(const Scene& scene, const Box& room, RobotSpec robot, double clearance);

  /// One verdict an edge. Throws UsageError for bodies that have none, InputError for places that are no numbers,
  /// Stopped.
  std::vector<EdgeVerdict> judge(const std::vector<DrawnEdge>& edges, const Execution& execution) const;
  /// Least distance between the body that stands there, in the room, and anything; infinite where there is nothing.
  /// theta is there where the body's outline turns. No arm's. Throws Stopped.
  double clearance_at(const EdgePlace& place, const Execution& execution) const;

 private:
  const ObstacleIndex* index(const Execution& execution) const;
  EdgeVerdict judge(const DrawnEdge& edge, const ObstacleIndex* index, const Execution& execution) const;

  const Scene& scene_;
  Box room_;
  RobotSpec robot_;
  double clearance_;
  MadeOnce<ObstacleIndex> index_;
};

/// Throws UsageError for bodies that drive no straight edges: cars but for round differential drives, and arms.
void check_drives_edges(const RobotSpec& robot);
/// A roadmap's body as its route graph has it: a differential drive is a disc. Throws UsageError as above.
RobotSpec body_on_edges(const Roadmap& roadmap);

/// "cell 3, 4 is 0.1 away, and 0.25 is needed"
std::string words_of(const EdgeVerdict& verdict);

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

// Route graphs and what is asked about them as JSON. All that reads it throws HttpError.

/// {"kind": "axis" | "roadmap", "samples", "neighbours", "seed"}.
GraphOptions read_graph_options(std::string_view json);

/// {"edges": [[x, y, x, y], ...]}, or [x, y, theta, x, y, theta] with null for no heading. At most most_route_edges.
std::vector<DrawnEdge> read_drawn_edges(std::string_view json, const Execution& execution);
/// {"edges": [{"free": true, "clearance"} | {"free": false, "why", "by", "distance", "needed"}, ...]}
std::string verdicts_json(const std::vector<EdgeVerdict>& verdicts);

/// warren.graph/1, and verdicts of its edges.
std::string graph_json(const RouteGraph& graph, const std::vector<EdgeVerdict>& verdicts, const Execution& execution);
/// The same read back; what else it holds means nothing.
RouteGraph read_graph_json(std::string_view json, const Execution& execution);

// Route graphs as Nav2 loads them (nav2_route's GeoJsonGraphFileLoader; docs/file_formats.md): nodes are Points with an
// id, edges MultiLineStrings or LineStrings with id, startid and endid, which lead one way from node to node, whatever
// their lines are. Metadata, operations and all else that people have written stays as it was.

/// Throws HttpError (400) with the feature and what was expected where Nav2 would refuse the file or take something
/// else for what it says; nodes of several frames, too, since these coordinates are of one.
RouteGraph read_nav2_graph(std::string_view geojson, const Execution& execution);

/// One feature a line; an edge without a cost gets its length. `ends`: ends_of(graph).
std::string nav2_graph_text(const RouteGraph& graph, const std::vector<RouteEnds>& ends, const Execution& execution);

}  // namespace warren::serve
