// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as a route graph of Nav2, by the rules of its loader (nav2_route's GeoJsonGraphFileLoader): nodes are
// Points with id and frame, edges MultiLineStrings with id, startid, endid and cost, the length. Edges are directed, so
// an undirected one stands twice. An id is given once, be it a node's or an edge's: node v has id v, edge i has
// vertex_count + i. Headings are metadata of nodes, "state": "unchecked" of edges that are. One feature a line.
#pragma once

#include <string>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// Nav2 holds coordinates and costs as floats and ids in 32 bits. Throws UsageError where its loader would refuse the
/// file (no edges, states that are no places of the plane), InputError where ids run out or a length is no number, and
/// as OutputFile.
ExportAccount write_roadmap_geojson(const ExportedRoadmapView& roadmap, const std::string& path,
                                    const Execution& execution);

}  // namespace warren
