// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include "roadmaps/exports/state_names.hpp"
#include "roadmaps/exports/write_in_pieces.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

void write_vertex_table(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
  file.write(fmt::format("id,{},component\n", fmt::join(state_names(parts.dimension), ",")));
  write_in_pieces(file, parts.vertex_count(), vertices_a_piece, execution, [&](Range range, std::string& text) {
    const auto out = std::back_inserter(text);
    for (std::size_t v = range.first; v < range.last; ++v) {
      fmt::format_to(out, FMT_COMPILE("{}"), v);
      for (const double x : parts.state(static_cast<VertexId>(v))) fmt::format_to(out, FMT_COMPILE(",{}"), x);
      fmt::format_to(out, FMT_COMPILE(",{}\n"), parts.component[v]);
    }
  });
}

void write_edge_table(const ExportedEdgesView& edges, OutputFile& file, const Execution& execution) {
  file.write("from,to,length,state\n");
  write_in_pieces(file, edges.ends(), edges.grain, execution, [&](Range range, std::string& text) {
    edges.visit(range, [&](const ExportedEdge& edge) {
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("{},{},{},{}\n"), edge.from, edge.to, edges.length(edge),
                     name_of(edge.state));
    });
  });
}

}  // namespace

ExportAccount write_roadmap_csv(const ExportedRoadmapView& roadmap, const std::string& vertex_path,
                                const std::string& edge_path, const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::once, execution);
  OutputFile vertex_file(vertex_path, execution);
  OutputFile edge_file(edge_path, execution);
  write_vertex_table(roadmap.parts, vertex_file, execution);
  write_edge_table(edges, edge_file, execution);
  vertex_file.complete();
  edge_file.complete();
  FirstOfTwoFiles first(vertex_path);
  vertex_file.commit();
  edge_file.commit();
  first.keep();
  return edges.account();
}

}  // namespace warren
