// SPDX-License-Identifier: BSD-3-Clause
// A roadmap for other programs; the ending of the path says in which format, and the format's own head what it holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {

/// What is written.
struct ExportOptions {
  bool with_unchecked = false;  ///< edges that nobody has asked about, too; else free ones alone
  std::string frame = "map";    ///< of the coordinates, for .geojson: a frame that Nav2 knows
};

/// What was written and what was not. An edge that leads both ways is one.
struct ExportAccount {
  std::uint64_t vertices = 0;            ///< all of them
  std::uint64_t edges = 0;               ///< those that are written
  std::uint64_t unchecked_left_out = 0;  ///< edges that nobody has asked about
  std::uint64_t blocked_left_out = 0;    ///< edges that are not free
  friend bool operator==(const ExportAccount&, const ExportAccount&) = default;
};

/// What is exported. Refers to arrays and a function that live elsewhere.
struct ExportedRoadmapView {
  RoadmapParts parts;          ///< the roadmap
  VertexDistance length;       ///< of an edge; of one that leads both ways from its smaller vertex
  ExportOptions options = {};  ///< what of it
};

/// How often an undirected edge is written. Directed ones are written as they are.
enum class EdgeWays : std::uint8_t { once, both };

/// An edge of an export.
struct ExportedEdge {
  std::uint64_t number;  ///< in the order of writing, from 0
  VertexId from;         ///< its begin
  VertexId to;           ///< its end
  EdgeState state;       ///< what is known of it
};

/// The edges that an export writes, in the order of their rows, numbered from 0: what the formats share. A first pass
/// over the states of the ends counts them in blocks, so that heads can say how many follow, and any block can be
/// written without those before it, on any thread: any number of them may ask. O(E) time a pass; memory: 24 bytes for
/// 4096 edge ends.
class ExportedEdgesView {
 public:
  static constexpr std::size_t grain = 4096;  ///< edge ends a block: less than a megabyte of text

  /// Counts. Throws Stopped.
  ExportedEdgesView(const ExportedRoadmapView& roadmap, EdgeWays ways, const Execution& execution);

  std::uint64_t count() const { return numbers_.back(); }  ///< of lines: with EdgeWays::both two an undirected edge
  /// How many are written, and how many are not.
  const ExportAccount& account() const { return account_; }
  /// Edge ends of the roadmap, written or not.
  std::size_t ends() const { return parts_.to.size(); }
  /// Throws InputError where it is no finite number, zero or more.
  double length(const ExportedEdge& edge) const;
  /// The largest length; 0 without edges. Throws for the first edge that length() throws for.
  double longest(const Execution& execution) const;

  /// Calls body(ExportedEdge) for what is written of these ends: one block, as for_chunks with this grain gives them.
  template <class Body>
  void visit(Range ends, const Body& body) const {
    std::uint64_t number = numbers_[ends.first / grain];
    visit_ends(ends, [&](VertexId from, VertexId to, EdgeState state) {
      if (is_written(from, to, state)) body(ExportedEdge{number++, from, to, state});
    });
  }
  /// Calls body(number) for each vertex of the range: the number of the first edge from it or from a later one, so for
  /// vertex_count() all of them. Only where each end is written or left out by its state: not with EdgeWays::once.
  template <class Body>
  void visit_rows(Range vertices, const Body& body) const {
    std::size_t end = 0;
    std::uint64_t number = 0;
    for (std::size_t v = vertices.first; v < vertices.last; ++v) {
      const std::size_t first = parts_.first.empty() ? 0 : parts_.first[v];
      if (v == vertices.first || first / grain != end / grain) {  // numbers are counted to the blocks' beginnings
        end = first / grain * grain;
        number = numbers_[first / grain];
      }
      for (; end < first; ++end) number += is_kept(parts_.state_of_end(end)) ? 1 : 0;
      body(number);
    }
  }

 private:
  struct Tally {
    std::uint64_t written = 0;
    std::uint64_t unchecked = 0;
    std::uint64_t blocked = 0;
  };
  bool is_kept(EdgeState state) const {
    return state == EdgeState::free || (with_unchecked_ && state == EdgeState::unchecked);
  }
  bool is_written(VertexId from, VertexId to, EdgeState state) const {
    return (every_end_ || from < to) && is_kept(state);
  }
  double length_or_infinity(const ExportedEdge& edge) const;
  template <class Body>
  void visit_ends(Range ends, const Body& body) const {
    VertexId from = 0;
    for (std::size_t end = ends.first; end < ends.last; ++end) {
      from = row_of(end, from);
      body(from, parts_.to[end], parts_.state_of_end(end));
    }
  }
  /// The first vertex, not before v, whose ends reach beyond this one.
  VertexId row_of(std::size_t end, VertexId v) const {
    if (end < parts_.first[v + 1]) return v;
    const auto after = parts_.first.begin() + v + 1;
    return static_cast<VertexId>(std::upper_bound(after, parts_.first.end(), end) - parts_.first.begin() - 1);
  }
  Tally tally(Range ends) const;

  RoadmapParts parts_;
  VertexDistance length_;
  bool with_unchecked_;
  bool every_end_;
  std::vector<std::uint64_t> numbers_;  ///< of the first edge of each block; then of all
  ExportAccount account_;
};

/// The files that an export to this path writes: the path, and beside X.gr X.co, beside X.csv X.edges.csv. Throws
/// UsageError, which names the endings, for others than .geojson .graphml .gr .csv .npz .dot.
std::vector<std::string> files_of_export(const std::string& path);

/// Writes them: the same bytes for any number of threads. O(V + E); two files are put in place when both are whole.
/// `length` of an edge is called by several threads at once. Throws UsageError (as above, and what a format can't
/// hold), InputError (a length that is no finite number, zero or more), WriteError, Stopped.
ExportAccount export_roadmap(const std::string& path, const RoadmapParts& parts, const VertexDistance& length,
                             const ExportOptions& options, const Execution& execution);

/// With the lengths that its world's metric gives its edges, by the file's ending. Throws UsageError for other endings
/// and for what a format can't hold, WriteError, Stopped.
ExportAccount export_of_roadmap(const Roadmap& roadmap, const std::string& path, const ExportOptions& options = {},
                                const Execution& execution = {});

/// The states of a lattice and its free edges. Throws Stopped.
RoadmapArrays arrays_of(const LatticePassages& passages, const Execution& execution);

}  // namespace warren
