// SPDX-License-Identifier: BSD-3-Clause
// The formats of exported roadmaps, one a file roadmap_FORMAT_io.cpp. All throw InputError for a length that is no
// number, and as OutputFile; where there are two files, both are put in place when both are whole.
#pragma once

#include <string>

#include "roadmaps/exports/exported_edges.hpp"

namespace warren {

/// A roadmap as a route graph of Nav2, by the rules of its loader (nav2_route's GeoJsonGraphFileLoader): nodes are
/// Points with id and frame, edges MultiLineStrings with id, startid, endid and cost, the length. Edges are directed,
/// so an undirected one stands twice. An id is given once, be it a node's or an edge's: node v has id v, edge i has
/// vertex_count + i. Headings are metadata of nodes, "state": "unchecked" of edges that are. One feature a line.
/// Nav2 holds coordinates and costs as floats and ids in 32 bits. Throws UsageError where its loader would refuse the
/// file (no edges, states that are no places of the plane), and InputError where ids run out, too.
ExportAccount write_roadmap_geojson(const ExportedRoadmapView& roadmap, const std::string& path,
                                    const Execution& execution);

/// A roadmap as GraphML: nodes with x, y, theta or q1..qn and component, edges with length and, where they are
/// unchecked, state ("free" is its default). http://graphml.graphdrawing.org
ExportAccount write_roadmap_graphml(const ExportedRoadmapView& roadmap, const std::string& path,
                                    const Execution& execution);

/// A roadmap in the formats of the 9th DIMACS implementation challenge (shortest paths, 2006): arcs with whole weights
/// (.gr) and whole coordinates (.co), vertices numbered from 1. Undirected edges are two arcs. Comment lines name the
/// units (binary_unit.hpp). Of a state the plane's x and y are written, of an arm's all joints.
/// Computes each length twice, first to find the longest.
ExportAccount write_roadmap_dimacs(const ExportedRoadmapView& roadmap, const std::string& arc_path,
                                   const std::string& coordinate_path, const Execution& execution);

/// A roadmap as two tables: vertices (id,x,y[,theta] or q1..qn,component) and edges (from,to,length,state), one line of
/// names above each. Undirected edges stand once, from the smaller vertex.
ExportAccount write_roadmap_csv(const ExportedRoadmapView& roadmap, const std::string& vertex_path,
                                const std::string& edge_path, const Execution& execution);

/// A roadmap for SciPy and NumPy: the matrix of lengths in compressed rows as scipy.sparse.load_npz reads it (indices,
/// indptr, format, shape, data; both ways of an undirected edge), and by numpy.load also `states` (vertex_count x
/// dimension), `component`, and where unchecked edges are asked for `edge_states`, one a length: 0 unchecked, 1 free.
ExportAccount write_roadmap_npz(const ExportedRoadmapView& roadmap, const std::string& path,
                                const Execution& execution);

/// A roadmap for Graphviz: `neato -n roadmap.dot -Tsvg`. Vertices stand where they are (pos, with ! so that neato
/// leaves them there), edges have their length (len), unchecked ones are dashed. Headings and joints are attributes by
/// their names; an arm's vertices have no pos.
ExportAccount write_roadmap_dot(const ExportedRoadmapView& roadmap, const std::string& path,
                                const Execution& execution);

}  // namespace warren
