// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <limits>

#include "core/base/error.hpp"
#include "roadmaps/exports/state_names.hpp"
#include "roadmaps/exports/write_in_pieces.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

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

/// Metadata keep the point of whole numbers: Nav2 tells the type of a value by it.
void write_points(const ExportedRoadmapView& roadmap, OutputFile& file, const Execution& execution) {
  const RoadmapParts& parts = roadmap.parts;
  const std::string frame = json_string(roadmap.options.frame);
  write_in_pieces(file, parts.vertex_count(), vertices_a_piece, execution, [&](Range range, std::string& text) {
    const auto out = std::back_inserter(text);
    for (std::size_t v = range.first; v < range.last; ++v) {
      const std::span<const double> state = parts.state(static_cast<VertexId>(v));
      fmt::format_to(out, FMT_COMPILE("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"frame\":{}"), v, frame);
      if (parts.dimension == 3) text.append(",\"metadata\":{\"theta\":").append(json_number(state[2])).append("}");
      fmt::format_to(out, FMT_COMPILE("}},\"geometry\":{{\"type\":\"Point\",\"coordinates\":[{},{}]}}}},\n"), state[0],
                     state[1]);
    }
  });
}

void write_lines(const RoadmapParts& parts, const ExportedEdgesView& edges, OutputFile& file,
                 const Execution& execution) {
  const auto write_line = [&](const ExportedEdge& edge, std::string& text) {
    const std::span<const double> a = parts.state(edge.from);
    const std::span<const double> b = parts.state(edge.to);
    fmt::format_to(
        std::back_inserter(text),
        FMT_COMPILE("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"startid\":{},\"endid\":{},\"cost\":{}{}}},"
                    "\"geometry\":{{\"type\":\"MultiLineString\",\"coordinates\":[[[{},{}],[{},{}]]]}}}}{}\n"),
        parts.vertex_count() + edge.number, edge.from, edge.to, edges.length(edge),
        edge.state == EdgeState::free ? "" : ",\"metadata\":{\"state\":\"unchecked\"}", a[0], a[1], b[0], b[1],
        edge.number + 1 == edges.count() ? "" : ",");
  };
  write_in_pieces(file, edges.ends(), edges.grain, execution, [&](Range range, std::string& text) {
    edges.visit(range, [&](const ExportedEdge& edge) { write_line(edge, text); });
  });
}

}  // namespace

ExportAccount write_roadmap_geojson(const ExportedRoadmapView& roadmap, const std::string& path,
                                    const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::both, execution);
  check_loadable(roadmap, edges, path);
  OutputFile file(path, execution);
  file.write("{\"type\":\"FeatureCollection\",\"name\":\"graph\",\"features\":[\n");
  write_points(roadmap, file, execution);
  write_lines(roadmap.parts, edges, file, execution);
  file.write("]}\n");
  file.commit();
  return edges.account();
}

}  // namespace warren
