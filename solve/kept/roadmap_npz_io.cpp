// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_formats_io.hpp"

#include <limits>

#include "scenes/files/npy_io.hpp"
#include "solve/kept/stored_zip_io.hpp"

namespace warren {
namespace {

using Shape = std::vector<std::uint64_t>;

class NpzWriter {
 public:
  NpzWriter(const ExportedRoadmapView& roadmap, const ExportedEdgesView& edges, OutputFile& file,
            const Execution& execution)
      : parts_(roadmap.parts), edges_(edges), zip_(file), execution_(execution) {}

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
  void write_matrix() {
    const std::uint64_t widest = std::max<std::uint64_t>(parts_.vertex_count(), edges_.count());
    widest <= std::numeric_limits<std::int32_t>::max() ? write_indices<std::int32_t>() : write_indices<std::int64_t>();
    small("format", "|S3", {}, "csr");
    std::string shape;
    for (int axis = 0; axis < 2; ++axis) append_little_endian(shape, std::int64_t(parts_.vertex_count()));
    small("shape", "<i8", {2}, shape);
    of_edges<double>("data", "<f8", [&](const ExportedEdge& edge) { return edges_.length(edge); });
  }
  void write_vertices() {
    begin("states", "<f8", {parts_.vertex_count(), parts_.dimension}, sizeof(double));
    of_span(parts_.states);
    begin("component", "<u4", {parts_.vertex_count()}, sizeof(VertexId));
    of_span(parts_.component);
  }
  void write_edge_states() {
    of_edges<std::uint8_t>("edge_states", "|u1",
                           [](const ExportedEdge& edge) { return static_cast<std::uint8_t>(edge.state); });
  }
  void close() { zip_.close(); }

 private:
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

}  // namespace

ExportAccount write_roadmap_npz(const ExportedRoadmapView& roadmap, const std::string& path,
                                const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::both, execution);
  OutputFile file(path, execution);
  NpzWriter writer(roadmap, edges, file, execution);
  writer.write_matrix();
  writer.write_vertices();
  if (roadmap.options.with_unchecked) writer.write_edge_states();
  writer.close();
  file.commit();
  return edges.account();
}

}  // namespace warren
