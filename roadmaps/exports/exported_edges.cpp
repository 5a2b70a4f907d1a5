// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/exported_edges.hpp"

#include <fmt/format.h>

#include <cassert>
#include <limits>

#include "core/base/error.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

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
  std::vector<Tally> tallies(blocks);
  for_chunks(ends(), grain, execution, [&](Range range) { tallies[range.first / grain] = tally(range); });
  add(tallies);
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

void ExportedEdgesView::add(const std::vector<Tally>& tallies) {
  numbers_.assign(1, 0);
  numbers_.reserve(tallies.size() + 1);
  for (const Tally& tally : tallies) {
    numbers_.push_back(numbers_.back() + tally.written);
    account_.unchecked_left_out += tally.unchecked;
    account_.blocked_left_out += tally.blocked;
  }
  account_.vertices = parts_.vertex_count();
  account_.edges = every_end_ && !parts_.directed ? count() / 2 : count();
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

}  // namespace warren
