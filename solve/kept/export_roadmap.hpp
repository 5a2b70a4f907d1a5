// SPDX-License-Identifier: BSD-3-Clause
// A roadmap for other programs; the ending of the path says in which format, and the format's own head what it holds.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_search.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {

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

/// How often an undirected edge is written. Directed ones are written as they are.
enum class EdgeWays : std::uint8_t { once, both };

struct ExportedEdge {
  std::uint64_t number;  ///< in the order of writing, from 0
  VertexId from;         ///< its begin
  VertexId to;           ///< its end
  EdgeState state;       ///< what is known of it
};

/// Edges of a roadmap, by their ends, in a piece of an export: less than a megabyte of text.
inline constexpr std::size_t edge_ends_a_block = 4096;

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

// What the formats are written by: whole numbers for real ones, zip archives.

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
  void put(std::string_view bytes);

  OutputFile& file_;
  std::uint64_t zip64_from_;
  std::uint64_t place_ = 0;
  std::vector<Member> members_;
};

}  // namespace warren
