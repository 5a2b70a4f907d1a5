// SPDX-License-Identifier: BSD-3-Clause
// Route graphs as Nav2 loads them (nav2_route's GeoJsonGraphFileLoader; docs/file_formats.md): nodes are Points with an
// id, edges MultiLineStrings or LineStrings with id, startid and endid, which lead one way from node to node, whatever
// their lines are. Metadata, operations and all else that people have written stays as it was.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "parallel/execution.hpp"
#include "serve/graphs/json_body_io.hpp"
#include "serve/graphs/route_graph.hpp"

namespace warren::serve {

/// Throws HttpError (400) with the feature and what was expected where Nav2 would refuse the file or take something
/// else for what it says; nodes of several frames, too, since these coordinates are of one.
RouteGraph read_nav2_graph(std::string_view geojson, const Execution& execution);

/// Does Nav2 take these properties' metadata and operations? Throws HttpError (400) for the first that it would not.
void check_properties(const OrderedJson& properties, const std::string& where);

/// One feature a line; an edge without a cost gets its length. `ends`: ends_of(graph).
std::string nav2_graph_text(const RouteGraph& graph, const std::vector<RouteEnds>& ends, const Execution& execution);

}  // namespace warren::serve
