// SPDX-License-Identifier: BSD-3-Clause
// Route graphs and what is asked about them as JSON: what the page and the service say to each other. Files of Nav2
// are the other half of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/serve/graphs/edge_judge.hpp"
#include "apps/serve/graphs/route_graph.hpp"
#include "core/run/execution.hpp"

namespace warren::serve {

/// {"kind": "axis" | "roadmap", "samples", "neighbours", "seed"}. Throws HttpError, as all that follow.
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
