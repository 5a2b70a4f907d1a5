// SPDX-License-Identifier: BSD-3-Clause
// The formats of exported roadmaps. All throw InputError for a length that is no number, and as OutputFile; where there
// are two files, both are put in place when both are whole. And what they are written by: whole numbers for real ones,
// zip archives.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/text/output_file_io.hpp"
#include "solve/kept/export_roadmap.hpp"

namespace warren {

/// Of a roadmap, as files_of_export() names them.
using ExportFiles = std::vector<std::string>;

/// A roadmap as a route graph of Nav2, by the rules of its loader (nav2_route's GeoJsonGraphFileLoader): nodes are
/// Points with id and frame, edges MultiLineStrings with id, startid, endid and cost, the length. Edges are directed,
/// so an undirected one stands twice. An id is given once, be it a node's or an edge's: node v has id v, edge i has
/// vertex_count + i. Headings are metadata of nodes, "state": "unchecked" of edges that are. One feature a line.
/// Nav2 holds coordinates and costs as floats and ids in 32 bits. Throws UsageError where its loader would refuse the
/// file (no edges, states that are no places of the plane), and InputError where ids run out, too.
ExportAccount write_roadmap_geojson(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                    const Execution& execution);

/// A roadmap as GraphML: nodes with x, y, theta or q1..qn and component, edges with length and, where they are
/// unchecked, state ("free" is its default). http://graphml.graphdrawing.org
ExportAccount write_roadmap_graphml(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                    const Execution& execution);

/// A roadmap in the formats of the 9th DIMACS implementation challenge (shortest paths, 2006): arcs with whole weights
/// (.gr) and whole coordinates (.co), vertices numbered from 1. Undirected edges are two arcs. Comment lines name the
/// units (roadmap_formats_io.hpp). Of a state the plane's x and y are written, of an arm's all joints.
/// Computes each length twice, first to find the longest.
ExportAccount write_roadmap_dimacs(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                   const Execution& execution);

/// A roadmap as two tables: vertices (id,x,y[,theta] or q1..qn,component) and edges (from,to,length,state), one line of
/// names above each. Undirected edges stand once, from the smaller vertex.
ExportAccount write_roadmap_csv(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                const Execution& execution);

/// A roadmap for SciPy and NumPy: the matrix of lengths in compressed rows as scipy.sparse.load_npz reads it (indices,
/// indptr, format, shape, data; both ways of an undirected edge), and by numpy.load also `states` (vertex_count x
/// dimension), `component`, and where unchecked edges are asked for `edge_states`, one a length: 0 unchecked, 1 free.
ExportAccount write_roadmap_npz(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                const Execution& execution);

/// A roadmap for Graphviz: `neato -n roadmap.dot -Tsvg`. Vertices stand where they are (pos, with ! so that neato
/// leaves them there), edges have their length (len), unchecked ones are dashed. Headings and joints are attributes by
/// their names; an arm's vertices have no pos.
ExportAccount write_roadmap_dot(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                const Execution& execution);

/// Real numbers as whole ones, for formats that have no others: multiples of a power of two, the finest that lets the
/// largest number stay below 2^31, which is what most readers' integers hold. A power of two, because scaling by it is
/// exact: the only error is that of rounding, at most half a unit.
class BinaryUnit {
 public:
  /// For numbers of magnitude 0 .. `largest`, which is finite. Without any but 0 the unit is 1.
  explicit BinaryUnit(double largest) {
    if (largest == 0) return;
    bits_ = 30 - std::ilogb(largest);
    if (multiple(largest) > std::numeric_limits<std::int32_t>::max()) --bits_;  // rounded up to 2^31
  }

  /// The nearest multiple, halves away from zero.
  std::int64_t multiple(double number) const { return std::llround(std::ldexp(number, bits_)); }
  /// "2^-20"
  std::string name() const { return "2^" + std::to_string(-bits_); }

 private:
  int bits_ = 0;  ///< the unit is 2^-bits_
};

/// A zip archive whose members are stored as they are, written in one pass: the check sum of a member follows it, its
/// size is said before. Members and archives of 4 GiB and more are ZIP64. Times are 1980-01-01, so that the same
/// members are the same bytes. PKWARE's APPNOTE.TXT 6.3. Writes to a file that outlives it, and does not commit that.
class StoredZip {
 public:
  /// What the plain format can't say, from this size or place on, is said in ZIP64; tests choose a smaller one.
  explicit StoredZip(OutputFile& file, std::uint64_t zip64_from = 0xffffffff) : file_(file), zip64_from_(zip64_from) {}

  /// A member of that many bytes follows, in calls of write().
  void begin(std::string_view name, std::uint64_t bytes);
  void write(std::string_view bytes);
  void end();
  /// The directory of all members. Nothing may follow.
  void close();

 private:
  struct Member {
    std::string name;
    std::uint64_t bytes;
    std::uint64_t place;
    std::uint32_t check_sum = 0;
    std::uint64_t written = 0;
  };
  bool is_long(std::uint64_t number) const { return number >= zip64_from_; }
  std::uint32_t short_form(std::uint64_t number) const;
  void append_entry(std::string& text, const Member& member) const;
  void append_end(std::string& text, std::uint64_t directory_bytes) const;
  void put(std::string_view bytes);

  OutputFile& file_;
  std::uint64_t zip64_from_;
  std::uint64_t place_ = 0;
  std::vector<Member> members_;
};

}  // namespace warren
