// SPDX-License-Identifier: BSD-3-Clause
// Route graphs and what is asked about them as JSON: what the page and the service say to each other. Files of Nav2 are
// nav2_graph_io's.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "parallel/execution.hpp"
#include "serve/graphs/built_graph.hpp"
#include "serve/graphs/edge_judge.hpp"
#include "serve/graphs/route_graph.hpp"

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

}  // namespace warren::serve
