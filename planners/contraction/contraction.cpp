// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/contraction.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "planners/contraction/contraction_rounds.hpp"
#include "planners/contraction/hierarchy_query.hpp"

namespace warren {
namespace {

// What is left may become somewhat denser than the graph was while it is large, and as dense as a few hundred vertices
// can be in the end; a question may look at so many arcs, a fifth of a millisecond.
constexpr double most_growth = 1.25;
constexpr double most_density = 256.0;
constexpr std::size_t small_rest = std::size_t{1} << 13;
constexpr std::uint64_t most_looks = 40'000;

/// Four pieces of vertices that follow each other, which lie together in the plane, and the edges within them.
Graph sample_of(const Graph& graph) {
  constexpr std::size_t pieces = 4;
  const std::size_t n = graph.vertex_count();
  const std::size_t piece = std::min<std::size_t>(n / pieces, 2048);
  RawVector<EdgeEnd> offsets;
  RawVector<VertexId> targets;
  RawVector<double> lengths;
  offsets.push_back(0);
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::size_t begin = i * n / pieces;
    for (std::size_t v = begin; v < begin + piece; ++v) {
      const auto row = graph.neighbours(static_cast<VertexId>(v));
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (row[k] < begin || row[k] >= begin + piece) continue;
        targets.push_back(static_cast<VertexId>(row[k] - begin + i * piece));
        lengths.push_back(graph.lengths(static_cast<VertexId>(v))[k]);
      }
      offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    }
  }
  return {std::move(offsets), std::move(targets), std::move(lengths)};
}

/// Does what is left of a sample grow denser while it shrinks to a quarter?
bool grows_denser(const Graph& graph, const Execution& execution) {
  ContractionRounds rounds(sample_of(graph), execution);
  const double before = rounds.density();
  const std::size_t last = rounds.left().size() / 4;
  while (rounds.left().size() > last) rounds.next_round();
  return rounds.density() > most_growth * before + 1.0;
}

/// Arcs that a question looks at, of some.
std::uint64_t looks_of_questions(const Hierarchy& hierarchy, const Execution& execution) {
  constexpr std::uint64_t questions = 64;
  HierarchyScratch scratch;
  HierarchyQuery query(hierarchy, scratch, execution);
  SequentialRng rng(1);
  const auto any = [&] { return HierarchyEnd{static_cast<VertexId>(rng.below(hierarchy.vertex_count())), 0.0}; };
  std::uint64_t looks = 0;
  for (std::uint64_t i = 0; i < questions; ++i) {
    const HierarchyEnd start = any();
    const HierarchyEnd goal = any();
    query.search({&start, 1}, {&goal, 1}, std::numeric_limits<double>::infinity());
    looks += query.looks();
  }
  return looks / questions;
}

}  // namespace

std::optional<Hierarchy> contract(const Graph& graph, const Execution& execution) {
  if (grows_denser(graph, execution)) return std::nullopt;
  ContractionRounds rounds(graph, execution);
  const double densest = 2.0 * rounds.density() + 8.0;
  while (rounds.left().size() > 0) {
    rounds.next_round();
    const double limit = rounds.left().size() > small_rest ? densest : most_density;
    if (rounds.density() > limit) return std::nullopt;
  }
  Hierarchy hierarchy = rounds.hierarchy();
  if (looks_of_questions(hierarchy, execution) > most_looks) return std::nullopt;
  return hierarchy;
}

}  // namespace warren
