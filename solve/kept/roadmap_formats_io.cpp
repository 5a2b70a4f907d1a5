// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/sampler.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/text/json_text.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren {
namespace {

/// Vertices in a piece: at most half a megabyte of text.
constexpr std::size_t vertices_a_piece = 2048;

/// A number as bytes of a file, the least significant first (roadmap_file.hpp).
template <class Number>
void append_little_endian(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

/// What the numbers of a state are called: "x", "y" of two, "theta" (radians) with them of three; else "q1", "q2" and
/// so on (radians).
std::vector<std::string> state_names(unsigned dimension) {
  if (dimension == 2) return {"x", "y"};
  if (dimension == 3) return {"x", "y", "theta"};
  std::vector<std::string> names;
  for (unsigned joint = 1; joint <= dimension; ++joint) names.push_back("q" + std::to_string(joint));
  return names;
}

/// Do the first two numbers of a state say a place in the plane?
constexpr bool is_in_plane(std::size_t dimension) { return dimension == 2 || dimension == 3; }

using ExportedState = std::span<const double>;

/// How often an undirected edge is written. Directed ones are written as they are.
enum class EdgeWays : std::uint8_t { once, both };

struct ExportedEdge {
  std::uint64_t number;  ///< in the order of writing, from 0
  VertexId from, to;
  EdgeState state;
};

/// The edges that an export writes, in the order of their rows, numbered from 0: what the formats share. A first pass
/// over the states of the ends counts them in blocks, so that heads can say how many follow, and any block can be
/// written without those before it, on any thread: any number of them may ask. O(E) time a pass; memory: 40 bytes for
/// 4096 edge ends.
class ExportedEdgesView {
 public:
  static constexpr std::size_t grain = edge_ends_a_block;

  /// Counts. length: of an edge; of one that leads both ways from its smaller vertex. Throws Stopped.
  ExportedEdgesView(const RoadmapParts& parts, const VertexDistance& length, const ExportOptions& options,
                    EdgeWays ways, const Execution& execution)
      : parts_(parts),
        length_(length),
        with_unchecked_(options.with_unchecked),
        every_end_(parts.directed || ways == EdgeWays::both) {
    assert(parts_.states.size() == parts_.vertex_count() * parts_.dimension);
    assert(parts_.component.size() == parts_.vertex_count());
    assert(parts_.edge_states.size() >= edge_state_words(ends()));
    const std::size_t blocks = chunk_count(ends(), grain);
    execution.reserve(blocks * (sizeof(ExportAccount) + sizeof(std::uint64_t)));
    const auto tallies = parts_of_chunks(ends(), grain, execution, [&](Range range) { return tally(range); });
    numbers_.assign(1, 0);
    numbers_.reserve(blocks + 1);
    for (const ExportAccount& tally : tallies) {
      numbers_.push_back(numbers_.back() + tally.edges);
      account_.unchecked_left_out += tally.unchecked_left_out;
      account_.blocked_left_out += tally.blocked_left_out;
    }
    account_.vertices = parts_.vertex_count();
    account_.edges = every_end_ && !parts_.directed ? count() / 2 : count();
  }

  std::uint64_t count() const { return numbers_.back(); }  ///< of lines: with EdgeWays::both two an undirected edge
  const ExportAccount& account() const { return account_; }
  /// Edge ends of the roadmap, written or not.
  std::size_t ends() const { return parts_.to.size(); }
  /// Throws InputError where it is no finite number, zero or more.
  double length(const ExportedEdge& edge) const {
    const double length = length_or_infinity(edge);
    if (length < infinity) return length;
    throw InputError(fmt::format("edge {} -> {} of the roadmap", edge.from, edge.to),
                     "the length of an edge that is exported must be a finite number, zero or more",
                     fmt::format("{}", length_(edge.from, edge.to)));
  }
  /// The largest length, 0 without edges; those that length() throws for don't count.
  double longest(const Execution& execution) const {
    const std::vector<double> of_blocks = parts_of_chunks(ends(), grain, execution, [&](Range range) {
      double longest = 0;
      visit(range, [&](const ExportedEdge& edge) {
        if (const double length = length_or_infinity(edge); length < infinity) longest = std::max(longest, length);
      });
      return longest;
    });
    return of_blocks.empty() ? 0 : *std::ranges::max_element(of_blocks);
  }

  /// Calls body(ExportedEdge) for what is written of these ends: one block, as for_chunks with this grain gives them.
  template <class Body>
  void visit(Range ends, const Body& body) const {
    std::uint64_t number = numbers_[ends.first / grain];
    visit_ends(ends, [&](VertexId from, VertexId to, EdgeState state) {
      if (is_written(from, to, state)) body(ExportedEdge{number++, from, to, state});
    });
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  bool is_written(VertexId from, VertexId to, EdgeState state) const {
    const bool is_kept = state == EdgeState::free || (with_unchecked_ && state == EdgeState::unchecked);
    return is_kept && (every_end_ || from < to);
  }
  double length_or_infinity(const ExportedEdge& edge) const {
    const bool turned = !parts_.directed && edge.from > edge.to;  // so that both ways are equally long, to the bit
    const double length = turned ? length_(edge.to, edge.from) : length_(edge.from, edge.to);
    return length >= 0 ? length : infinity;  // a NaN is no more than 0
  }
  template <class Body>
  void visit_ends(Range ends, const Body& body) const {
    const auto behind = std::upper_bound(parts_.first.begin() + 1, parts_.first.end(), ends.first);
    auto from = static_cast<VertexId>(behind - parts_.first.begin() - 1);
    for (std::size_t end = ends.first; end < ends.last; ++end) {
      while (end >= parts_.first[from + 1]) ++from;
      body(from, parts_.to[end], parts_.state_of_end(end));
    }
  }
  /// Of lines, not of edges.
  ExportAccount tally(Range ends) const {
    ExportAccount tally;
    visit_ends(ends, [&](VertexId from, VertexId to, EdgeState state) {
      if (is_written(from, to, state)) ++tally.edges;
      if (!parts_.directed && from > to) return;  // the edge is told at its other end
      if (state == EdgeState::blocked) ++tally.blocked_left_out;
      if (state == EdgeState::unchecked && !with_unchecked_) ++tally.unchecked_left_out;
    });
    return tally;
  }

  RoadmapParts parts_;
  VertexDistance length_;
  bool with_unchecked_;
  bool every_end_;
  std::vector<std::uint64_t> numbers_;  ///< of the first edge of each block; then of all
  ExportAccount account_;
};

/// A roadmap and where it goes; what each format holds: docs/file_formats.md, "Exports". All throw InputError for a
/// length that is no number, and as OutputFile.
struct RoadmapExport {
  const RoadmapParts& parts;
  const ExportOptions& options;
  const ExportedEdgesView& edges;
  OutputFile& file;
  OutputFile* second;  ///< beside it; nullptr: the format has none
  const Execution& execution;

  void geojson() const;
  void graphml() const;
  void dimacs() const;
  void csv() const;
  void npz() const;
  void dot() const;

  /// append(v, its state, out) says what stands of each vertex.
  template <class Append>
  void each_vertex(OutputFile& to, const Append& append) const {
    write_in_pieces(to, parts.vertex_count(), vertices_a_piece, execution, [&](Range range, std::string& text) {
      for (std::size_t v = range.first; v < range.last; ++v) {
        append(v, parts.state(static_cast<VertexId>(v)), std::back_inserter(text));
      }
    });
  }
  /// The same of each edge: append(edge, out).
  template <class Append>
  void each_edge(OutputFile& to, const Append& append) const {
    write_in_pieces(to, edges.ends(), edges.grain, execution, [&](Range range, std::string& text) {
      edges.visit(range, [&](const ExportedEdge& edge) { append(edge, std::back_inserter(text)); });
    });
  }
};

struct ExportFormat {
  std::string_view ending;
  std::string_view second_ending;  ///< of the file beside it, if there is one
  EdgeWays ways;
  void (RoadmapExport::*write)() const;
};

constexpr std::array<ExportFormat, 6> export_formats{{{".geojson", "", EdgeWays::both, &RoadmapExport::geojson},
                                                      {".graphml", "", EdgeWays::once, &RoadmapExport::graphml},
                                                      {".gr", ".co", EdgeWays::both, &RoadmapExport::dimacs},
                                                      {".csv", ".edges.csv", EdgeWays::once, &RoadmapExport::csv},
                                                      {".npz", "", EdgeWays::both, &RoadmapExport::npz},
                                                      {".dot", "", EdgeWays::once, &RoadmapExport::dot}}};

const ExportFormat& format_of(const std::string& path) {
  std::string endings;
  for (const ExportFormat& format : export_formats) {
    if (path.ends_with(format.ending)) return format;
    endings.append(" ").append(format.ending);
  }
  throw UsageError(path + ": a roadmap is exported to a file that ends in one of" + endings +
                   ", and drawn by .svg .png .pdf .html");
}

/// The numbers of a state that are written.
ExportedState coordinates(ExportedState state) { return is_in_plane(state.size()) ? state.first(2) : state; }

double largest_of_states(const RoadmapParts& parts, const Execution& execution) {
  double largest = 0;
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    execution.poll(v);
    for (const double x : coordinates(parts.state(v))) largest = std::max(largest, std::abs(x));
  }
  return largest;
}

/// By Nav2.
void check_loadable(const RoadmapParts& parts, const ExportedEdgesView& edges, const std::string& path) {
  constexpr std::uint64_t most_ids = std::numeric_limits<std::uint32_t>::max();  // the last one means "none" there
  if (!is_in_plane(parts.dimension)) {
    throw UsageError(path +
                     ": Nav2's route graphs lie in the plane, and these states are an arm's; export to .graphml,"
                     " .csv or .npz");
  }
  if (edges.count() == 0) {
    throw UsageError(path + (edges.account().unchecked_left_out == 0
                                 ? ": Nav2 loads no route graph without edges, and this roadmap has none that are free"
                                 : ": Nav2 loads no route graph without edges, and this roadmap has unchecked ones "
                                   "alone; ask for @with_unchecked"));
  }
  if (parts.vertex_count() + edges.count() > most_ids) {
    throw InputError(path, "Nav2 numbers at most 4294967295 nodes and edges; export to another format",
                     fmt::format("{} nodes, {} edges", parts.vertex_count(), edges.count()));
  }
}

using Shape = std::vector<std::uint64_t>;

class NpzWriter : RoadmapExport {
 public:
  explicit NpzWriter(const RoadmapExport& to) : RoadmapExport(to), zip_(file) {}

  void write() {
    const std::uint64_t widest = std::max<std::uint64_t>(parts.vertex_count(), edges.count());
    widest <= std::numeric_limits<std::int32_t>::max() ? write_indices<std::int32_t>() : write_indices<std::int64_t>();
    of_span("format", {}, std::span<const char>("csr", 3), "|S3");
    const auto vertices = static_cast<std::int64_t>(parts.vertex_count());
    of_span("shape", {2}, std::span<const std::int64_t>(std::array{vertices, vertices}));
    of_edges<double>("data", [&](const ExportedEdge& edge) { return edges.length(edge); });
    of_span("states", {parts.vertex_count(), parts.dimension}, parts.states);
    of_span("component", {parts.vertex_count()}, parts.component);
    if (options.with_unchecked) {
      of_edges<std::uint8_t>("edge_states",
                             [](const ExportedEdge& edge) { return static_cast<std::uint8_t>(edge.state); });
    }
    zip_.close();
  }

 private:
  /// Index is int32, what SciPy calculates with, or int64 where that is too narrow.
  template <class Index>
  void write_indices() {
    of_edges<Index>("indices", [](const ExportedEdge& edge) { return static_cast<Index>(edge.to); });
    const std::size_t vertices = parts.vertex_count();
    RawVector<Index> rows;  // of each vertex the number of the first edge from it or from a later one; then of all
    execution.reserve((vertices + 1) * sizeof(Index));
    rows.reserve(vertices + 1);
    for (std::size_t first = 0; first < edges.ends(); first += edges.grain) {
      execution.check();
      edges.visit({first, std::min(first + edges.grain, edges.ends())}, [&](const ExportedEdge& edge) {
        if (rows.size() <= edge.from) rows.resize(std::size_t{edge.from} + 1, static_cast<Index>(edge.number));
      });
    }
    rows.resize(vertices + 1, static_cast<Index>(edges.count()));
    of_span("indptr", {rows.size()}, std::span<const Index>(rows));
  }
  /// bytes: of the numbers that follow.
  void begin(const std::string& name, const Shape& shape, std::string_view type, std::uint64_t bytes) {
    const std::string header = npy_header(type, shape);
    zip_.begin(name + ".npy", header.size() + bytes);
    zip_.write(header);
  }
  /// One number an edge.
  template <class Number, class Value>
  void of_edges(const std::string& name, const Value& value) {
    begin(name, {edges.count()}, element_type<Number>().name(), edges.count() * sizeof(Number));
    write_in_pieces(zip_, edges.ends(), edges.grain, execution, [&](Range range, std::string& bytes) {
      edges.visit(range, [&](const ExportedEdge& edge) { append_little_endian<Number>(bytes, value(edge)); });
    });
    zip_.end();
  }
  template <class Number>
  void of_span(const std::string& name, const Shape& shape, std::span<const Number> numbers,
               std::string_view type = element_type<Number>().name()) {
    begin(name, shape, type, numbers.size_bytes());
    constexpr std::size_t block = std::size_t{1} << 17;
    for (std::size_t first = 0; first < numbers.size(); first += block) {
      execution.check();
      const std::span<const Number> some = numbers.subspan(first, std::min(block, numbers.size() - first));
      zip_.write({reinterpret_cast<const char*>(some.data()), some.size_bytes()});
      execution.advance(some.size());
    }
    zip_.end();
  }

  StoredZip zip_;
};

constexpr std::uint16_t plain_version = 20;
constexpr std::uint16_t zip64_version = 45;
constexpr std::uint16_t sum_follows = 8;  // flag: check sum and sizes stand behind the member
constexpr std::uint16_t stored = 0;
constexpr std::uint16_t midnight = 0;
constexpr std::uint16_t first_day = 0x21;  // 1980-01-01
constexpr std::uint16_t zip64_field = 1;
constexpr std::uint16_t nothing_16 = 0;
constexpr std::uint32_t nothing_32 = 0;
constexpr std::uint64_t nothing_64 = 0;

/// The fields of a record, one after the other, each as wide as its type.
template <class... Fields>
void append_fields(std::string& text, Fields... fields) {
  (append_little_endian(text, fields), ...);
}

std::uint16_t size_16(std::string_view text) { return static_cast<std::uint16_t>(text.size()); }

void RoadmapExport::csv() const {
  file.write(fmt::format("id,{},component\n", fmt::join(state_names(parts.dimension), ",")));
  each_vertex(file, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{}"), v);
    for (const double x : state) fmt::format_to(out, FMT_COMPILE(",{}"), x);
    fmt::format_to(out, FMT_COMPILE(",{}\n"), parts.component[v]);
  });
  second->write("from,to,length,state\n");
  each_edge(*second, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("{},{},{},{}\n"), edge.from, edge.to, edges.length(edge), name_of(edge.state));
  });
}

/// Numbers are quoted: a bare numeral of the language has no exponent.
void RoadmapExport::dot() const {
  file.write(parts.directed ? "digraph roadmap {\n" : "graph roadmap {\n");
  file.write("node [shape=point];\n");
  const std::vector<std::string> names = state_names(parts.dimension);
  const std::size_t said_by_pos = is_in_plane(parts.dimension) ? 2 : 0;
  each_vertex(file, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{} [component={}"), v, parts.component[v]);
    if (said_by_pos != 0) fmt::format_to(out, FMT_COMPILE(", pos=\"{},{}!\""), state[0], state[1]);
    for (std::size_t i = said_by_pos; i < state.size(); ++i) {
      fmt::format_to(out, FMT_COMPILE(", {}=\"{}\""), names[i], state[i]);
    }
    fmt::format_to(out, FMT_COMPILE("];\n"));
  });
  const std::string_view arrow = parts.directed ? "->" : "--";
  each_edge(file, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("{} {} {} [len=\"{}\"{}];\n"), edge.from, arrow, edge.to, edges.length(edge),
                   edge.state == EdgeState::free ? "" : ", style=dashed");
  });
  file.write("}\n");
}

/// The 9th DIMACS implementation challenge (shortest paths, 2006). Computes each length twice, first to find the
/// longest.
void RoadmapExport::dimacs() const {
  const std::size_t vertices = parts.vertex_count();
  const BinaryUnit weight(edges.longest(execution));
  file.write(fmt::format("c weights are lengths in units of {}\np sp {} {}\n", weight.name(), vertices, edges.count()));
  each_edge(file, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("a {} {} {}\n"), std::uint64_t{edge.from} + 1, std::uint64_t{edge.to} + 1,
                   weight.multiple(edges.length(edge)));
  });
  const BinaryUnit unit(largest_of_states(parts, execution));
  second->write(fmt::format("c coordinates are in units of {}\np aux sp co {}\n", unit.name(), vertices));
  each_vertex(*second, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("v {}"), v + 1);
    for (const double x : coordinates(state)) fmt::format_to(out, FMT_COMPILE(" {}"), unit.multiple(x));
    fmt::format_to(out, FMT_COMPILE("\n"));
  });
}

/// By the rules of nav2_route's GeoJsonGraphFileLoader. Metadata keep the point of whole numbers: it tells the type of
/// a value by that.
void RoadmapExport::geojson() const {
  file.write("{\"type\":\"FeatureCollection\",\"name\":\"graph\",\"features\":[\n");
  const std::string frame = json_string(options.frame);
  each_vertex(file, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"frame\":{}"), v, frame);
    if (parts.dimension == 3) fmt::format_to(out, FMT_COMPILE(",\"metadata\":{{\"theta\":{}}}"), json_number(state[2]));
    fmt::format_to(out, FMT_COMPILE("}},\"geometry\":{{\"type\":\"Point\",\"coordinates\":[{},{}]}}}},\n"), state[0],
                   state[1]);
  });
  each_edge(file, [&](const ExportedEdge& edge, auto out) {
    const std::span<const double> a = parts.state(edge.from);
    const std::span<const double> b = parts.state(edge.to);
    fmt::format_to(
        out,
        FMT_COMPILE("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"startid\":{},\"endid\":{},\"cost\":{}{}}},"
                    "\"geometry\":{{\"type\":\"MultiLineString\",\"coordinates\":[[[{},{}],[{},{}]]]}}}}{}\n"),
        parts.vertex_count() + edge.number, edge.from, edge.to, edges.length(edge),
        edge.state == EdgeState::free ? "" : ",\"metadata\":{\"state\":\"unchecked\"}", a[0], a[1], b[0], b[1],
        edge.number + 1 == edges.count() ? "" : ",");
  });
  file.write("]}\n");
}

void RoadmapExport::graphml() const {
  file.write("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
  const auto key = [&](std::string_view name, std::string_view of, std::string_view type) {
    file.write(fmt::format("<key id=\"{0}\" for=\"{1}\" attr.name=\"{0}\" attr.type=\"{2}\"/>\n", name, of, type));
  };
  const std::vector<std::string> names = state_names(parts.dimension);
  for (const std::string& name : names) key(name, "node", "double");
  key("component", "node", "long");
  key("length", "edge", "double");
  key("state", "edge", "string");
  file.write(fmt::format("<graph edgedefault=\"{}\">\n", parts.directed ? "directed" : "undirected"));
  each_vertex(file, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("<node id=\"{}\">"), v);
    for (std::size_t i = 0; i < state.size(); ++i) {
      fmt::format_to(out, FMT_COMPILE("<data key=\"{}\">{}</data>"), names[i], state[i]);
    }
    fmt::format_to(out, FMT_COMPILE("<data key=\"component\">{}</data></node>\n"), parts.component[v]);
  });
  each_edge(file, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(
        out,
        FMT_COMPILE(
            "<edge source=\"{}\" target=\"{}\"><data key=\"length\">{}</data><data key=\"state\">{}</data></edge>\n"),
        edge.from, edge.to, edges.length(edge), name_of(edge.state));
  });
  file.write("</graph>\n</graphml>\n");
}

void RoadmapExport::npz() const { NpzWriter(*this).write(); }

}  // namespace

std::vector<std::string> files_of_export(const std::string& path) {
  const ExportFormat& format = format_of(path);
  if (format.second_ending.empty()) return {path};
  return {path, path.substr(0, path.size() - format.ending.size()).append(format.second_ending)};
}

ExportAccount export_roadmap(const std::string& path, const RoadmapParts& parts, const VertexDistance& length,
                             const ExportOptions& options, const Execution& execution) {
  const ExportFormat& format = format_of(path);
  if (execution.progress != nullptr) execution.progress->begin("export", parts.vertex_count() + 2 * parts.to.size());
  const ExportedEdgesView edges(parts, length, options, format.ways, execution);
  if (format.write == &RoadmapExport::geojson) check_loadable(parts, edges, path);
  OutputFile file(path, execution);
  std::optional<OutputFile> second;
  if (!format.second_ending.empty()) second.emplace(files_of_export(path).back(), execution);
  (RoadmapExport{parts, options, edges, file, second ? &*second : nullptr, execution}.*format.write)();
  if (!second) {
    file.commit();
    return edges.account();
  }
  file.complete();  // both are put in place when both are whole
  second->complete();
  FirstOfTwoFiles in_place(path);
  file.commit();
  second->commit();
  in_place.keep();
  return edges.account();
}

RoadmapArrays arrays_of(const LatticePassages& passages, const Execution& execution) {
  constexpr std::size_t most_ends = 4;
  const std::uint64_t cells = passages.cell_count();
  execution.reserve(cells * (sizeof(EdgeEnd) + (most_ends + 1) * sizeof(VertexId)));
  RawVector<EdgeEnd> offsets;
  offsets.reserve(cells + 1);
  RawVector<VertexId> targets;
  targets.reserve(cells * most_ends);  // growing would move gigabytes at once
  for (std::uint64_t i = 0; i < cells; ++i) {
    execution.poll(i);
    offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    passages.for_each_neighbour(static_cast<CellId>(i), [&](CellId to) { targets.push_back(to); });
    std::sort(targets.begin() + offsets.back(), targets.end());
  }
  offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  const auto at = [&](VertexId v) { return lattice_point(passages.size(), v); };
  RoadmapArrays arrays = free_arrays(at, Graph(std::move(offsets), std::move(targets)), execution);
  arrays.component = free_components(arrays.parts(), execution);
  return arrays;
}

ExportAccount export_of_roadmap(const Roadmap& roadmap, const std::string& path, const ExportOptions& options,
                                const Execution& execution) {
  if (roadmap.lattice != nullptr) {
    const RoadmapArrays arrays = arrays_of(roadmap.lattice->passages(), execution);
    const auto one_step = [](VertexId, VertexId) { return 1.0; };
    ExportAccount account = export_roadmap(path, arrays.parts(), VertexDistance(one_step), options, execution);
    account.blocked_left_out = count_edges(roadmap, execution).blocked;
    return account;
  }
  const RoadmapQuery query(roadmap, execution, Questions::one);
  const auto length = [&](VertexId v, VertexId w) { return query.distance(v, w); };
  return export_roadmap(path, roadmap.arrays.parts(), VertexDistance(length), options, execution);
}

void StoredZip::put(std::string_view bytes) {
  file_.write(bytes);
  place_ += bytes.size();
}

void StoredZip::begin(std::string_view name, std::uint64_t bytes) {
  members_.push_back({std::string{name}, bytes, place_});
  const bool zip64 = is_long(bytes);
  std::string extra;
  if (zip64) append_fields(extra, zip64_field, std::uint16_t{16}, nothing_64, nothing_64);
  const std::uint32_t size = zip64 ? said_in_zip64 : nothing_32;
  std::string head;
  append_fields(head, std::uint32_t{0x04034b50}, zip64 ? zip64_version : plain_version, sum_follows, stored, midnight,
                first_day, nothing_32, size, size, size_16(name), size_16(extra));
  put(head.append(name).append(extra));
}

void StoredZip::write(std::string_view bytes) {
  Member& member = members_.back();
  member.check_sum = static_cast<std::uint32_t>(
      ::crc32_z(member.check_sum, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
  member.written += bytes.size();
  put(bytes);
}

void StoredZip::end() {
  const Member& member = members_.back();
  assert(member.written == member.bytes);
  std::string tail;
  append_fields(tail, std::uint32_t{0x08074b50}, member.check_sum);
  if (is_long(member.bytes)) {
    append_fields(tail, member.bytes, member.bytes);
  } else {
    append_fields(tail, static_cast<std::uint32_t>(member.bytes), static_cast<std::uint32_t>(member.bytes));
  }
  put(tail);
}

void StoredZip::append_entry(std::string& text, const Member& member) const {
  std::string extra;
  if (is_long(member.bytes)) append_fields(extra, member.bytes, member.bytes);
  if (is_long(member.place)) append_fields(extra, member.place);
  std::string field;
  if (!extra.empty()) append_fields(field, zip64_field, size_16(extra));
  field += extra;
  const std::uint16_t version = field.empty() ? plain_version : zip64_version;
  append_fields(text, std::uint32_t{0x02014b50}, version, version, sum_follows, stored, midnight, first_day,
                member.check_sum, short_form(member.bytes), short_form(member.bytes), size_16(member.name),
                size_16(field), nothing_16, nothing_16, nothing_16, nothing_32, short_form(member.place));
  text.append(member.name).append(field);
}

void StoredZip::close() {
  std::string text;
  for (const Member& member : members_) append_entry(text, member);
  const std::uint64_t directory_bytes = text.size();
  const std::uint64_t count = members_.size();
  if (is_long(place_) || is_long(directory_bytes)) {
    append_fields(text, std::uint32_t{0x06064b50}, std::uint64_t{44}, zip64_version, zip64_version, nothing_32,
                  nothing_32, count, count, directory_bytes, place_);
    append_fields(text, std::uint32_t{0x07064b50}, nothing_32, place_ + directory_bytes, std::uint32_t{1});
  }
  const auto short_count = static_cast<std::uint16_t>(count);
  append_fields(text, std::uint32_t{0x06054b50}, nothing_16, nothing_16, short_count, short_count,
                short_form(directory_bytes), short_form(place_), nothing_16);
  put(text);
}

}  // namespace warren
