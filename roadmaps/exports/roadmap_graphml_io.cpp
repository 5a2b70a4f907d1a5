// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include "roadmaps/exports/state_names.hpp"
#include "roadmaps/exports/write_in_pieces.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

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

void write_nodes(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
  const std::vector<std::string> names = state_names(parts.dimension);
  write_in_pieces(file, parts.vertex_count(), vertices_a_piece, execution, [&](Range range, std::string& text) {
    const auto out = std::back_inserter(text);
    for (std::size_t v = range.first; v < range.last; ++v) {
      fmt::format_to(out, FMT_COMPILE("<node id=\"{}\">"), v);
      const std::span<const double> state = parts.state(static_cast<VertexId>(v));
      for (std::size_t i = 0; i < state.size(); ++i) {
        fmt::format_to(out, FMT_COMPILE("<data key=\"{}\">{}</data>"), names[i], state[i]);
      }
      fmt::format_to(out, FMT_COMPILE("<data key=\"component\">{}</data></node>\n"), parts.component[v]);
    }
  });
}

void write_edges(const ExportedEdgesView& edges, OutputFile& file, const Execution& execution) {
  write_in_pieces(file, edges.ends(), edges.grain, execution, [&](Range range, std::string& text) {
    edges.visit(range, [&](const ExportedEdge& edge) {
      fmt::format_to(
          std::back_inserter(text),
          FMT_COMPILE(
              "<edge source=\"{}\" target=\"{}\"><data key=\"length\">{}</data><data key=\"state\">{}</data></edge>\n"),
          edge.from, edge.to, edges.length(edge), name_of(edge.state));
    });
  });
}

}  // namespace

ExportAccount write_roadmap_graphml(const ExportedRoadmapView& roadmap, const std::string& path,
                                    const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::once, execution);
  OutputFile file(path, execution);
  file.write(graphml_head(roadmap.parts));
  write_nodes(roadmap.parts, file, execution);
  write_edges(edges, file, execution);
  file.write("</graph>\n</graphml>\n");
  file.commit();
  return edges.account();
}

}  // namespace warren
