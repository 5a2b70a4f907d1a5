// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/text/json_text.hpp"

namespace warren {
namespace {

/// Vertices in a piece: at most half a megabyte of text.
constexpr std::size_t vertices_a_piece = 2048;

/// Long texts, made piece by piece on all cores and written in their order: a file of any size goes through 16 pieces
/// of memory, and its bytes are the same for any number of threads. Calls make(Range, std::string&), which appends, for
/// each piece of `grain` indices of 0 .. n - 1, and sink.write() with what it made, one after the other. Throws
/// Stopped, and as make and the sink do.
template <class Sink, class Make>
void write_in_pieces(Sink& sink, std::size_t n, std::size_t grain, const Execution& execution, const Make& make) {
  constexpr std::size_t pieces_at_once = 16;
  std::array<std::string, pieces_at_once> texts;
  std::array<std::exception_ptr, pieces_at_once> errors;  // the first by number, not by time
  for (std::size_t begin = 0; begin < n; begin += pieces_at_once * grain) {
    const std::size_t count = std::min(pieces_at_once * grain, n - begin);
    for_chunks(count, grain, execution, [&](Range range) {
      std::string& text = texts[range.first / grain];
      text.clear();
      try {
        make(Range{begin + range.first, begin + range.last}, text);
      } catch (...) {
        errors[range.first / grain] = std::current_exception();
      }
    });
    for (std::size_t piece = 0; piece < chunk_count(count, grain); ++piece) {
      if (errors[piece]) std::rethrow_exception(errors[piece]);
      sink.write(texts[piece]);
    }
  }
}

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

/// append(v, its state, out) says what stands of each vertex.
template <class Append>
void write_each_vertex(const RoadmapParts& parts, OutputFile& file, const Execution& execution, const Append& append) {
  write_in_pieces(file, parts.vertex_count(), vertices_a_piece, execution, [&](Range range, std::string& text) {
    for (std::size_t v = range.first; v < range.last; ++v) {
      append(v, parts.state(static_cast<VertexId>(v)), std::back_inserter(text));
    }
  });
}

/// The same of each edge: append(edge, out).
template <class Append>
void write_each_edge(const ExportedEdgesView& edges, OutputFile& file, const Execution& execution,
                     const Append& append) {
  write_in_pieces(file, edges.ends(), edges.grain, execution, [&](Range range, std::string& text) {
    edges.visit(range, [&](const ExportedEdge& edge) { append(edge, std::back_inserter(text)); });
  });
}

/// Both are put in place when both are whole.
void commit_both(const std::string& first_path, OutputFile& first, OutputFile& second) {
  first.complete();
  second.complete();
  FirstOfTwoFiles in_place(first_path);
  first.commit();
  second.commit();
  in_place.keep();
}

/// The numbers of a state that are written.
ExportedState coordinates(ExportedState state) { return is_in_plane(state.size()) ? state.first(2) : state; }

double largest_of_states(const RoadmapParts& parts, const Execution& execution) {
  std::vector<double> largest_of(chunk_count(parts.vertex_count(), vertices_a_piece));
  for_chunks(parts.vertex_count(), vertices_a_piece, execution, [&](Range range) {
    double& largest = largest_of[range.first / vertices_a_piece];
    for (std::size_t v = range.first; v < range.last; ++v) {
      for (const double x : coordinates(parts.state(static_cast<VertexId>(v))))
        largest = std::max(largest, std::abs(x));
    }
  });
  const auto largest = std::ranges::max_element(largest_of);
  return largest == largest_of.end() ? 0 : *largest;
}

void check_loadable(const ExportedRoadmapView& roadmap, const ExportedEdgesView& edges, const std::string& path) {
  constexpr std::uint64_t most_ids = std::numeric_limits<std::uint32_t>::max();  // the last one means "none" there
  if (!is_in_plane(roadmap.parts.dimension)) {
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
  if (roadmap.parts.vertex_count() + edges.count() > most_ids) {
    throw InputError(path, "Nav2 numbers at most 4294967295 nodes and edges; export to another format",
                     fmt::format("{} nodes, {} edges", roadmap.parts.vertex_count(), edges.count()));
  }
}

std::string key_line(std::string_view name, std::string_view of, std::string_view type) {
  return fmt::format("<key id=\"{0}\" for=\"{1}\" attr.name=\"{0}\" attr.type=\"{2}\"/>\n", name, of, type);
}

std::string graphml_head(const RoadmapParts& parts) {
  std::string head =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  for (const std::string& name : state_names(parts.dimension)) head += key_line(name, "node", "double");
  head += key_line("component", "node", "long") + key_line("length", "edge", "double") +
          key_line("state", "edge", "string");
  return head + fmt::format("<graph edgedefault=\"{}\">\n", parts.directed ? "directed" : "undirected");
}

using Shape = std::vector<std::uint64_t>;

class NpzWriter {
 public:
  NpzWriter(const ExportedRoadmapView& roadmap, const ExportedEdgesView& edges, OutputFile& file,
            const Execution& execution)
      : parts_(roadmap.parts), edges_(edges), zip_(file), execution_(execution) {}

  void write(bool with_edge_states) {
    const std::uint64_t widest = std::max<std::uint64_t>(parts_.vertex_count(), edges_.count());
    widest <= std::numeric_limits<std::int32_t>::max() ? write_indices<std::int32_t>() : write_indices<std::int64_t>();
    small("format", "|S3", {}, "csr");
    std::string shape;
    for (int axis = 0; axis < 2; ++axis) append_little_endian(shape, std::int64_t(parts_.vertex_count()));
    small("shape", "<i8", {2}, shape);
    of_edges<double>("data", "<f8", [&](const ExportedEdge& edge) { return edges_.length(edge); });
    begin("states", "<f8", {parts_.vertex_count(), parts_.dimension}, sizeof(double));
    of_span(parts_.states);
    begin("component", "<u4", {parts_.vertex_count()}, sizeof(VertexId));
    of_span(parts_.component);
    if (with_edge_states) {
      of_edges<std::uint8_t>("edge_states", "|u1",
                             [](const ExportedEdge& edge) { return static_cast<std::uint8_t>(edge.state); });
    }
    zip_.close();
  }

 private:
  /// Index is int32, what SciPy calculates with, or int64 where that is too narrow.
  template <class Index>
  void write_indices() {
    const std::string_view type = sizeof(Index) == 4 ? "<i4" : "<i8";
    of_edges<Index>("indices", type, [](const ExportedEdge& edge) { return static_cast<Index>(edge.to); });
    begin("indptr", type, {parts_.vertex_count() + 1}, sizeof(Index));
    constexpr std::size_t grain = vertices_a_piece / 2;  // up to a block of ends is counted for each
    write_in_pieces(zip_, parts_.vertex_count() + 1, grain, execution_, [&](Range range, std::string& bytes) {
      edges_.visit_rows(range, [&](std::uint64_t number) { append_little_endian(bytes, static_cast<Index>(number)); });
    });
    zip_.end();
  }
  void begin(const std::string& name, std::string_view type, const Shape& shape, std::uint64_t bytes_a_number) {
    std::uint64_t bytes = bytes_a_number;
    for (const std::uint64_t extent : shape) bytes *= extent;
    const std::string header = npy_header(type, shape);
    zip_.begin(name + ".npy", header.size() + bytes);
    zip_.write(header);
  }
  void small(const std::string& name, std::string_view type, const Shape& shape, std::string_view bytes) {
    begin(name, type, shape, shape.empty() ? bytes.size() : bytes.size() / shape.front());
    zip_.write(bytes);
    zip_.end();
  }
  /// One number an edge.
  template <class Number, class Value>
  void of_edges(const std::string& name, std::string_view type, const Value& value) {
    begin(name, type, {edges_.count()}, sizeof(Number));
    write_in_pieces(zip_, edges_.ends(), edges_.grain, execution_, [&](Range range, std::string& bytes) {
      edges_.visit(range, [&](const ExportedEdge& edge) { append_little_endian<Number>(bytes, value(edge)); });
    });
    zip_.end();
  }
  template <class Number>
  void of_span(std::span<const Number> numbers) {
    constexpr std::size_t block = std::size_t{1} << 17;
    for (std::size_t first = 0; first < numbers.size(); first += block) {
      execution_.check();
      const std::span<const Number> some = numbers.subspan(first, std::min(block, numbers.size() - first));
      zip_.write({reinterpret_cast<const char*>(some.data()), some.size_bytes()});
      execution_.advance(some.size());
    }
    zip_.end();
  }

  const RoadmapParts& parts_;
  const ExportedEdgesView& edges_;
  StoredZip zip_;
  const Execution& execution_;
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
constexpr std::uint32_t said_in_zip64 = 0xffffffff;

/// The fields of a record, one after the other, each as wide as its type.
template <class... Fields>
void append_fields(std::string& text, Fields... fields) {
  (append_little_endian(text, fields), ...);
}

std::uint16_t size_16(std::string_view text) { return static_cast<std::uint16_t>(text.size()); }

}  // namespace

ExportAccount write_roadmap_csv(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                const Execution& execution) {
  const RoadmapParts& parts = roadmap.parts;
  const ExportedEdgesView edges(roadmap, EdgeWays::once, execution);
  OutputFile vertex_file(files.front(), execution);
  OutputFile edge_file(files.back(), execution);
  vertex_file.write(fmt::format("id,{},component\n", fmt::join(state_names(parts.dimension), ",")));
  write_each_vertex(parts, vertex_file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{}"), v);
    for (const double x : state) fmt::format_to(out, FMT_COMPILE(",{}"), x);
    fmt::format_to(out, FMT_COMPILE(",{}\n"), parts.component[v]);
  });
  edge_file.write("from,to,length,state\n");
  write_each_edge(edges, edge_file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("{},{},{},{}\n"), edge.from, edge.to, edges.length(edge), name_of(edge.state));
  });
  commit_both(files.front(), vertex_file, edge_file);
  return edges.account();
}

/// Numbers are quoted: a bare numeral of the language has no exponent.
ExportAccount write_roadmap_dot(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                const Execution& execution) {
  const RoadmapParts& parts = roadmap.parts;
  const ExportedEdgesView edges(roadmap, EdgeWays::once, execution);
  OutputFile file(files.front(), execution);
  file.write(parts.directed ? "digraph roadmap {\n" : "graph roadmap {\n");
  file.write("node [shape=point];\n");
  const std::vector<std::string> names = state_names(parts.dimension);
  const std::size_t said_by_pos = is_in_plane(parts.dimension) ? 2 : 0;
  write_each_vertex(parts, file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{} [component={}"), v, parts.component[v]);
    if (said_by_pos != 0) fmt::format_to(out, FMT_COMPILE(", pos=\"{},{}!\""), state[0], state[1]);
    for (std::size_t i = said_by_pos; i < state.size(); ++i) {
      fmt::format_to(out, FMT_COMPILE(", {}=\"{}\""), names[i], state[i]);
    }
    fmt::format_to(out, FMT_COMPILE("];\n"));
  });
  const std::string_view arrow = parts.directed ? "->" : "--";
  write_each_edge(edges, file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("{} {} {} [len=\"{}\"{}];\n"), edge.from, arrow, edge.to, edges.length(edge),
                   edge.state == EdgeState::free ? "" : ", style=dashed");
  });
  file.write("}\n");
  file.commit();
  return edges.account();
}

ExportAccount write_roadmap_dimacs(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                   const Execution& execution) {
  const std::size_t vertices = roadmap.parts.vertex_count();
  const ExportedEdgesView edges(roadmap, EdgeWays::both, execution);
  OutputFile arc_file(files.front(), execution);
  OutputFile coordinate_file(files.back(), execution);
  const BinaryUnit weight(edges.longest(execution));
  arc_file.write(
      fmt::format("c weights are lengths in units of {}\np sp {} {}\n", weight.name(), vertices, edges.count()));
  write_each_edge(edges, arc_file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("a {} {} {}\n"), std::uint64_t{edge.from} + 1, std::uint64_t{edge.to} + 1,
                   weight.multiple(edges.length(edge)));
  });
  const BinaryUnit unit(largest_of_states(roadmap.parts, execution));
  coordinate_file.write(fmt::format("c coordinates are in units of {}\np aux sp co {}\n", unit.name(), vertices));
  write_each_vertex(roadmap.parts, coordinate_file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("v {}"), v + 1);
    for (const double x : coordinates(state)) fmt::format_to(out, FMT_COMPILE(" {}"), unit.multiple(x));
    fmt::format_to(out, FMT_COMPILE("\n"));
  });
  commit_both(files.front(), arc_file, coordinate_file);
  return edges.account();
}

/// Metadata keep the point of whole numbers: Nav2 tells the type of a value by it.
ExportAccount write_roadmap_geojson(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                    const Execution& execution) {
  const RoadmapParts& parts = roadmap.parts;
  const ExportedEdgesView edges(roadmap, EdgeWays::both, execution);
  check_loadable(roadmap, edges, files.front());
  OutputFile file(files.front(), execution);
  file.write("{\"type\":\"FeatureCollection\",\"name\":\"graph\",\"features\":[\n");
  const std::string frame = json_string(roadmap.options.frame);
  write_each_vertex(parts, file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"frame\":{}"), v, frame);
    if (parts.dimension == 3) fmt::format_to(out, FMT_COMPILE(",\"metadata\":{{\"theta\":{}}}"), json_number(state[2]));
    fmt::format_to(out, FMT_COMPILE("}},\"geometry\":{{\"type\":\"Point\",\"coordinates\":[{},{}]}}}},\n"), state[0],
                   state[1]);
  });
  write_each_edge(edges, file, execution, [&](const ExportedEdge& edge, auto out) {
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
  file.commit();
  return edges.account();
}

ExportAccount write_roadmap_graphml(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                    const Execution& execution) {
  const RoadmapParts& parts = roadmap.parts;
  const ExportedEdgesView edges(roadmap, EdgeWays::once, execution);
  OutputFile file(files.front(), execution);
  file.write(graphml_head(parts));
  const std::vector<std::string> names = state_names(parts.dimension);
  write_each_vertex(parts, file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("<node id=\"{}\">"), v);
    for (std::size_t i = 0; i < state.size(); ++i) {
      fmt::format_to(out, FMT_COMPILE("<data key=\"{}\">{}</data>"), names[i], state[i]);
    }
    fmt::format_to(out, FMT_COMPILE("<data key=\"component\">{}</data></node>\n"), parts.component[v]);
  });
  write_each_edge(edges, file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(
        out,
        FMT_COMPILE(
            "<edge source=\"{}\" target=\"{}\"><data key=\"length\">{}</data><data key=\"state\">{}</data></edge>\n"),
        edge.from, edge.to, edges.length(edge), name_of(edge.state));
  });
  file.write("</graph>\n</graphml>\n");
  file.commit();
  return edges.account();
}

ExportAccount write_roadmap_npz(const ExportedRoadmapView& roadmap, const ExportFiles& files,
                                const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::both, execution);
  OutputFile file(files.front(), execution);
  NpzWriter(roadmap, edges, file, execution).write(roadmap.options.with_unchecked);
  file.commit();
  return edges.account();
}

std::uint32_t StoredZip::short_form(std::uint64_t number) const {
  return is_long(number) ? said_in_zip64 : static_cast<std::uint32_t>(number);
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

void StoredZip::append_end(std::string& text, std::uint64_t directory_bytes) const {
  const std::uint64_t count = members_.size();
  if (is_long(place_) || is_long(directory_bytes)) {
    append_fields(text, std::uint32_t{0x06064b50}, std::uint64_t{44}, zip64_version, zip64_version, nothing_32,
                  nothing_32, count, count, directory_bytes, place_);
    append_fields(text, std::uint32_t{0x07064b50}, nothing_32, place_ + directory_bytes, std::uint32_t{1});
  }
  const auto short_count = static_cast<std::uint16_t>(count);
  append_fields(text, std::uint32_t{0x06054b50}, nothing_16, nothing_16, short_count, short_count,
                short_form(directory_bytes), short_form(place_), nothing_16);
}

void StoredZip::close() {
  std::string directory;
  for (const Member& member : members_) append_entry(directory, member);
  append_end(directory, directory.size());
  put(directory);
}

}  // namespace warren
