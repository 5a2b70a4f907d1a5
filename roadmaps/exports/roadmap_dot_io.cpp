// SPDX-License-Identifier: BSD-3-Clause
// Numbers are quoted: a bare numeral of the language has no exponent.
#include "roadmaps/exports/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include "roadmaps/exports/state_names.hpp"
#include "roadmaps/exports/write_in_pieces.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

void write_dot_vertices(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
  const std::vector<std::string> names = state_names(parts.dimension);
  const std::size_t said_by_pos = is_in_plane(parts.dimension) ? 2 : 0;
  write_in_pieces(file, parts.vertex_count(), vertices_a_piece, execution, [&](Range range, std::string& text) {
    const auto out = std::back_inserter(text);
    for (std::size_t v = range.first; v < range.last; ++v) {
      const std::span<const double> state = parts.state(static_cast<VertexId>(v));
      fmt::format_to(out, FMT_COMPILE("{} [component={}"), v, parts.component[v]);
      if (said_by_pos != 0) fmt::format_to(out, FMT_COMPILE(", pos=\"{},{}!\""), state[0], state[1]);
      for (std::size_t i = said_by_pos; i < state.size(); ++i) {
        fmt::format_to(out, FMT_COMPILE(", {}=\"{}\""), names[i], state[i]);
      }
      text += "];\n";
    }
  });
}

void write_dot_edges(const ExportedEdgesView& edges, std::string_view arrow, OutputFile& file,
                     const Execution& execution) {
  write_in_pieces(file, edges.ends(), edges.grain, execution, [&](Range range, std::string& text) {
    edges.visit(range, [&](const ExportedEdge& edge) {
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("{} {} {} [len=\"{}\"{}];\n"), edge.from, arrow, edge.to,
                     edges.length(edge), edge.state == EdgeState::free ? "" : ", style=dashed");
    });
  });
}

}  // namespace

ExportAccount write_roadmap_dot(const ExportedRoadmapView& roadmap, const std::string& path,
                                const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::once, execution);
  OutputFile file(path, execution);
  file.write(roadmap.parts.directed ? "digraph roadmap {\n" : "graph roadmap {\n");
  file.write("node [shape=point];\n");
  write_dot_vertices(roadmap.parts, file, execution);
  write_dot_edges(edges, roadmap.parts.directed ? "->" : "--", file, execution);
  file.write("}\n");
  file.commit();
  return edges.account();
}

}  // namespace warren
