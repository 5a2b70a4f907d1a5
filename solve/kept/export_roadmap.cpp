// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/export_roadmap.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <limits>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "planners/roadmap/milestones.hpp"
#include "solve/kept/roadmap_formats_io.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren {
namespace {

struct ExportFormat {
  std::string_view ending;
  std::string_view second_ending;  ///< of the file beside it, if there is one
  ExportAccount (*write)(const ExportedRoadmapView&, const ExportFiles&, const Execution&);
};

constexpr std::array<ExportFormat, 6> formats{{{".geojson", "", write_roadmap_geojson},
                                               {".graphml", "", write_roadmap_graphml},
                                               {".gr", ".co", write_roadmap_dimacs},
                                               {".csv", ".edges.csv", write_roadmap_csv},
                                               {".npz", "", write_roadmap_npz},
                                               {".dot", "", write_roadmap_dot}}};

const ExportFormat& format_of(const std::string& path) {
  std::string endings;
  for (const ExportFormat& format : formats) {
    if (path.ends_with(format.ending)) return format;
    endings.append(" ").append(format.ending);
  }
  throw UsageError(path + ": a roadmap is exported to a file that ends in one of" + endings +
                   ", and drawn by .svg .png .pdf .html");
}

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<std::string> files_of_export(const std::string& path) {
  const ExportFormat& format = format_of(path);
  ExportFiles files{path};
  if (!format.second_ending.empty()) {
    files.push_back(path.substr(0, path.size() - format.ending.size()).append(format.second_ending));
  }
  return files;
}

ExportAccount export_roadmap(const std::string& path, const RoadmapParts& parts, const VertexDistance& length,
                             const ExportOptions& options, const Execution& execution) {
  const ExportFiles files = files_of_export(path);
  if (execution.progress != nullptr) execution.progress->begin("export", parts.vertex_count() + 2 * parts.to.size());
  return format_of(path).write({parts, length, options}, files, execution);
}

ExportedEdgesView::ExportedEdgesView(const ExportedRoadmapView& roadmap, EdgeWays ways, const Execution& execution)
    : parts_(roadmap.parts),
      length_(roadmap.length),
      with_unchecked_(roadmap.options.with_unchecked),
      every_end_(roadmap.parts.directed || ways == EdgeWays::both) {
  assert(parts_.states.size() == parts_.vertex_count() * parts_.dimension);
  assert(parts_.component.size() == parts_.vertex_count());
  assert(parts_.edge_states.size() >= edge_state_words(ends()));
  const std::size_t blocks = chunk_count(ends(), grain);
  execution.reserve(blocks * (sizeof(Tally) + sizeof(std::uint64_t)));
  const auto tallies = parts_of_chunks(ends(), grain, execution, [&](Range range) { return tally(range); });
  numbers_.assign(1, 0);
  numbers_.reserve(blocks + 1);
  for (const Tally& tally : tallies) {
    numbers_.push_back(numbers_.back() + tally.written);
    account_.unchecked_left_out += tally.unchecked;
    account_.blocked_left_out += tally.blocked;
  }
  account_.vertices = parts_.vertex_count();
  account_.edges = every_end_ && !parts_.directed ? count() / 2 : count();
}

ExportedEdgesView::Tally ExportedEdgesView::tally(Range ends) const {
  Tally tally;
  visit_ends(ends, [&](VertexId from, VertexId to, EdgeState state) {
    if (is_written(from, to, state)) ++tally.written;
    if (!parts_.directed && from > to) return;  // the edge is told at its other end
    if (state == EdgeState::blocked) ++tally.blocked;
    if (state == EdgeState::unchecked && !with_unchecked_) ++tally.unchecked;
  });
  return tally;
}

double ExportedEdgesView::length_or_infinity(const ExportedEdge& edge) const {
  const bool turned = !parts_.directed && edge.from > edge.to;  // so that both ways are equally long, to the bit
  const double length = turned ? length_(edge.to, edge.from) : length_(edge.from, edge.to);
  return length >= 0 ? length : infinity;  // a NaN is no more than 0
}

double ExportedEdgesView::length(const ExportedEdge& edge) const {
  const double length = length_or_infinity(edge);
  if (length < infinity) return length;
  throw InputError(fmt::format("edge {} -> {} of the roadmap", edge.from, edge.to),
                   "the length of an edge that is exported must be a finite number, zero or more",
                   fmt::format("{}", length_(edge.from, edge.to)));
}

double ExportedEdgesView::longest(const Execution& execution) const {
  std::vector<double> longest_of(chunk_count(ends(), grain));
  for_chunks(ends(), grain, execution, [&](Range range) {
    double& longest = longest_of[range.first / grain];
    visit(range, [&](const ExportedEdge& edge) { longest = std::max(longest, length_or_infinity(edge)); });
  });
  double longest = 0;
  for (std::size_t block = 0; block < longest_of.size(); ++block) {
    const Range range{block * grain, std::min(ends(), (block + 1) * grain)};
    if (longest_of[block] == infinity) visit(range, [&](const ExportedEdge& edge) { length(edge); });  // throws
    longest = std::max(longest, longest_of[block]);
  }
  return longest;
}

RoadmapArrays arrays_of(const LatticePassages& passages, const Execution& execution) {
  constexpr std::size_t polled = std::size_t{1} << 16;
  constexpr std::size_t most_ends = 4;
  const std::uint64_t cells = passages.cell_count();
  execution.reserve(cells * (sizeof(EdgeEnd) + (most_ends + 1) * sizeof(VertexId)));
  RawVector<EdgeEnd> offsets;
  offsets.reserve(cells + 1);
  RawVector<VertexId> targets;
  for (std::uint64_t i = 0; i < cells; ++i) {
    if (i % polled == 0) execution.check();
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

}  // namespace warren
