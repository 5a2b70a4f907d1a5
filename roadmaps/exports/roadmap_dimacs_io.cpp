// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>

#include "roadmaps/exports/binary_unit.hpp"
#include "roadmaps/exports/state_names.hpp"
#include "roadmaps/exports/write_in_pieces.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

void write_arcs(const ExportedEdgesView& edges, std::size_t vertices, OutputFile& file, const Execution& execution) {
  const BinaryUnit unit(edges.longest(execution));
  file.write(fmt::format("c weights are lengths in units of {}\np sp {} {}\n", unit.name(), vertices, edges.count()));
  write_in_pieces(file, edges.ends(), edges.grain, execution, [&](Range range, std::string& text) {
    edges.visit(range, [&](const ExportedEdge& edge) {
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("a {} {} {}\n"), std::uint64_t{edge.from} + 1,
                     std::uint64_t{edge.to} + 1, unit.multiple(edges.length(edge)));
    });
  });
}

/// The numbers of a state that are written.
std::span<const double> coordinates(const RoadmapParts& parts, std::size_t v) {
  const std::span<const double> state = parts.state(static_cast<VertexId>(v));
  return is_in_plane(parts.dimension) ? state.first(2) : state;
}

double largest_coordinate(const RoadmapParts& parts, const Execution& execution) {
  std::vector<double> largest_of(chunk_count(parts.vertex_count(), vertices_a_piece));
  for_chunks(parts.vertex_count(), vertices_a_piece, execution, [&](Range range) {
    double& largest = largest_of[range.first / vertices_a_piece];
    for (std::size_t v = range.first; v < range.last; ++v) {
      for (const double x : coordinates(parts, v)) largest = std::max(largest, std::abs(x));
    }
  });
  const auto largest = std::max_element(largest_of.begin(), largest_of.end());
  return largest == largest_of.end() ? 0 : *largest;
}

void write_coordinates(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
  const BinaryUnit unit(largest_coordinate(parts, execution));
  file.write(fmt::format("c coordinates are in units of {}\np aux sp co {}\n", unit.name(), parts.vertex_count()));
  write_in_pieces(file, parts.vertex_count(), vertices_a_piece, execution, [&](Range range, std::string& text) {
    const auto out = std::back_inserter(text);
    for (std::size_t v = range.first; v < range.last; ++v) {
      fmt::format_to(out, FMT_COMPILE("v {}"), v + 1);
      for (const double x : coordinates(parts, v)) fmt::format_to(out, FMT_COMPILE(" {}"), unit.multiple(x));
      text += '\n';
    }
  });
}

}  // namespace

ExportAccount write_roadmap_dimacs(const ExportedRoadmapView& roadmap, const std::string& arc_path,
                                   const std::string& coordinate_path, const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::both, execution);
  OutputFile arc_file(arc_path, execution);
  OutputFile coordinate_file(coordinate_path, execution);
  write_arcs(edges, roadmap.parts.vertex_count(), arc_file, execution);
  write_coordinates(roadmap.parts, coordinate_file, execution);
  arc_file.complete();
  coordinate_file.complete();
  FirstOfTwoFiles first(arc_path);
  arc_file.commit();
  coordinate_file.commit();
  first.keep();
  return edges.account();
}

}  // namespace warren
