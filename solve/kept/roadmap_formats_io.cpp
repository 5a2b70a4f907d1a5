// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_formats_io.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

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

void write_vertex_table(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
  file.write(fmt::format("id,{},component\n", fmt::join(state_names(parts.dimension), ",")));
  write_each_vertex(parts, file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{}"), v);
    for (const double x : state) fmt::format_to(out, FMT_COMPILE(",{}"), x);
    fmt::format_to(out, FMT_COMPILE(",{}\n"), parts.component[v]);
  });
}

void write_edge_table(const ExportedEdgesView& edges, OutputFile& file, const Execution& execution) {
  file.write("from,to,length,state\n");
  write_each_edge(edges, file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("{},{},{},{}\n"), edge.from, edge.to, edges.length(edge), name_of(edge.state));
  });
}

// Numbers are quoted: a bare numeral of the language has no exponent.

void write_dot_vertices(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
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
}

void write_dot_edges(const ExportedEdgesView& edges, std::string_view arrow, OutputFile& file,
                     const Execution& execution) {
  write_each_edge(edges, file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("{} {} {} [len=\"{}\"{}];\n"), edge.from, arrow, edge.to, edges.length(edge),
                   edge.state == EdgeState::free ? "" : ", style=dashed");
  });
}

void write_arcs(const ExportedEdgesView& edges, std::size_t vertices, OutputFile& file, const Execution& execution) {
  const BinaryUnit unit(edges.longest(execution));
  file.write(fmt::format("c weights are lengths in units of {}\np sp {} {}\n", unit.name(), vertices, edges.count()));
  write_each_edge(edges, file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(out, FMT_COMPILE("a {} {} {}\n"), std::uint64_t{edge.from} + 1, std::uint64_t{edge.to} + 1,
                   unit.multiple(edges.length(edge)));
  });
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
  const auto largest = std::max_element(largest_of.begin(), largest_of.end());
  return largest == largest_of.end() ? 0 : *largest;
}

void write_coordinates(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
  const BinaryUnit unit(largest_of_states(parts, execution));
  file.write(fmt::format("c coordinates are in units of {}\np aux sp co {}\n", unit.name(), parts.vertex_count()));
  write_each_vertex(parts, file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("v {}"), v + 1);
    for (const double x : coordinates(state)) fmt::format_to(out, FMT_COMPILE(" {}"), unit.multiple(x));
    fmt::format_to(out, FMT_COMPILE("\n"));
  });
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

/// Metadata keep the point of whole numbers: Nav2 tells the type of a value by it.
void write_points(const ExportedRoadmapView& roadmap, OutputFile& file, const Execution& execution) {
  const RoadmapParts& parts = roadmap.parts;
  const std::string frame = json_string(roadmap.options.frame);
  write_each_vertex(parts, file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("{{\"type\":\"Feature\",\"properties\":{{\"id\":{},\"frame\":{}"), v, frame);
    if (parts.dimension == 3) fmt::format_to(out, FMT_COMPILE(",\"metadata\":{{\"theta\":{}}}"), json_number(state[2]));
    fmt::format_to(out, FMT_COMPILE("}},\"geometry\":{{\"type\":\"Point\",\"coordinates\":[{},{}]}}}},\n"), state[0],
                   state[1]);
  });
}

void write_lines(const RoadmapParts& parts, const ExportedEdgesView& edges, OutputFile& file,
                 const Execution& execution) {
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

void write_nodes(const RoadmapParts& parts, OutputFile& file, const Execution& execution) {
  const std::vector<std::string> names = state_names(parts.dimension);
  write_each_vertex(parts, file, execution, [&](std::size_t v, ExportedState state, auto out) {
    fmt::format_to(out, FMT_COMPILE("<node id=\"{}\">"), v);
    for (std::size_t i = 0; i < state.size(); ++i) {
      fmt::format_to(out, FMT_COMPILE("<data key=\"{}\">{}</data>"), names[i], state[i]);
    }
    fmt::format_to(out, FMT_COMPILE("<data key=\"component\">{}</data></node>\n"), parts.component[v]);
  });
}

void write_edges(const ExportedEdgesView& edges, OutputFile& file, const Execution& execution) {
  write_each_edge(edges, file, execution, [&](const ExportedEdge& edge, auto out) {
    fmt::format_to(
        out,
        FMT_COMPILE(
            "<edge source=\"{}\" target=\"{}\"><data key=\"length\">{}</data><data key=\"state\">{}</data></edge>\n"),
        edge.from, edge.to, edges.length(edge), name_of(edge.state));
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
  commit_both(vertex_path, vertex_file, edge_file);
  return edges.account();
}

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

ExportAccount write_roadmap_dimacs(const ExportedRoadmapView& roadmap, const std::string& arc_path,
                                   const std::string& coordinate_path, const Execution& execution) {
  const ExportedEdgesView edges(roadmap, EdgeWays::both, execution);
  OutputFile arc_file(arc_path, execution);
  OutputFile coordinate_file(coordinate_path, execution);
  write_arcs(edges, roadmap.parts.vertex_count(), arc_file, execution);
  write_coordinates(roadmap.parts, coordinate_file, execution);
  commit_both(arc_path, arc_file, coordinate_file);
  return edges.account();
}

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

BinaryUnit::BinaryUnit(double largest) {
  if (largest == 0) return;
  bits_ = 30 - std::ilogb(largest);
  if (multiple(largest) > std::numeric_limits<std::int32_t>::max()) --bits_;  // rounded up to 2^31
}

std::int64_t BinaryUnit::multiple(double number) const { return std::llround(std::ldexp(number, bits_)); }

std::string BinaryUnit::name() const { return "2^" + std::to_string(-bits_); }

}  // namespace warren
