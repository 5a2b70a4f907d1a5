// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/joined_parts.hpp"

#include <algorithm>
#include <limits>

#include "core/base/let_go.hpp"
#include "scenes/mazes/disjoint_regions.hpp"

namespace warren::maze {
namespace {

constexpr std::uint32_t not_on_rim = std::numeric_limits<std::uint32_t>::max();

/// Joins a rectangle of parts to one.
class Joining {
 public:
  Joining(std::uint64_t seed, std::span<RimPart> parts, std::size_t cols, unsigned side_log2)
      : weights_(seed), parts_(parts), cols_(cols), last_((1U << side_log2) - 1) {}

  JoinedParts run(const Execution& execution) {
    JoinedParts joined;
    RimPart& whole = joined.whole;
    whole.at = frame();
    number_vertices(whole.at);
    take_edges();
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.weight < b.weight; });
    execution.check();
    Regions<std::uint32_t> regions(first_.back(), {1, execution.deadline});
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (i % 65536 == 0) execution.check();
      join(edges_[i], regions, joined);
    }
    return joined;
  }

 private:
  struct Edge {
    std::uint64_t weight;
    RimEdge between;  // vertices
  };

  GridPiece frame() const {
    const GridPiece& low = parts_.front().at;
    const GridPiece& high = parts_.back().at;
    return {low.first_col, low.first_row, high.first_col + high.width - low.first_col,
            high.first_row + high.height - low.first_row, (low.more & 12U) | (high.more & 3U)};
  }

  /// A vertex is a cell on a side of a part; on_rim_ says which of the whole's it is.
  void number_vertices(const GridPiece& whole) {
    first_.assign(1, 0);
    for (const RimPart& part : parts_) first_.push_back(first_.back() + 2 * (part.at.width + part.at.height));
    on_rim_.assign(first_.back(), not_on_rim);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const GridPiece& at = parts_[p].at;
      at.each_on_sides([&](std::uint32_t col, std::uint32_t row) {
        const std::uint32_t whole_col = at.first_col - whole.first_col + col;
        const std::uint32_t whole_row = at.first_row - whole.first_row + row;
        if (!whole.on_rim(whole_col, whole_row)) return;
        on_rim_[first_[p] + at.side_number(col, row)] = whole.side_number(whole_col, whole_row);
      });
    }
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint64_t edge) { edges_.push_back({weights_(edge), {a, b, edge}}); }

  void take_edges() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      RimPart& part = parts_[p];
      const GridPiece& at = part.at;
      for (const RimEdge& e : part.edges) add(first_[p] + e.a, first_[p] + e.b, e.edge);
      let_go(part.edges);
      if ((p + 1) % cols_ != 0) {
        const GridPiece& other = parts_[p + 1].at;
        for (std::uint32_t row = 0; row < at.height; ++row) {
          add(first_[p] + at.side_number(at.width - 1, row), first_[p + 1] + other.side_number(0, row),
              edge_number(at.first_col + at.width - 1, at.first_row + row, 0));
        }
      }
      if (p + cols_ < parts_.size()) {
        const GridPiece& other = parts_[p + cols_].at;
        for (std::uint32_t col = 0; col < at.width; ++col) {
          add(first_[p] + at.side_number(col, at.height - 1), first_[p + cols_] + other.side_number(col, 0),
              edge_number(at.first_col + col, at.first_row + at.height - 1, 1));
        }
      }
    }
  }

  void join(const Edge& edge, Regions<std::uint32_t>& regions, JoinedParts& joined) {
    const std::uint32_t a = regions.root(edge.between.a);
    const std::uint32_t b = regions.root(edge.between.b);
    if (!regions.join(a, b)) return note(edge.between.edge, false, joined);
    const std::uint32_t kept = std::min(a, b);
    const std::uint32_t gone = std::max(a, b);
    if (on_rim_[kept] != not_on_rim && on_rim_[gone] != not_on_rim) {
      joined.whole.edges.push_back({on_rim_[kept], on_rim_[gone], edge.between.edge});
      return;
    }
    on_rim_[kept] = std::min(on_rim_[kept], on_rim_[gone]);
    note(edge.between.edge, true, joined);
  }
  void note(std::uint64_t edge, bool is_in, JoinedParts& joined) const {
    const bool leaves = ((edge_direction(edge) == 0 ? edge_col(edge) : edge_row(edge)) & last_) == last_;
    if (leaves == is_in) joined.turned.push_back(edge);
  }

  const EdgeWeights weights_;
  std::span<RimPart> parts_;
  std::size_t cols_;
  const std::uint32_t last_;  // column or row of a tile
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> on_rim_;  // of a region's root: the side number of one of its cells, or none
  std::vector<Edge> edges_;
};

}  // namespace

void RimPart::pack(ValuePacker& to) const {
  to.add(at);
  to.add_list(edges);
}

RimPart RimPart::unpack(ValueUnpacker& from) {
  RimPart part{from.take<GridPiece>(), from.take_list<RimEdge>()};
  const std::uint64_t cells = 2 * (std::uint64_t{part.at.width} + part.at.height);
  const auto is_beyond = [&](const RimEdge& edge) { return edge.a >= cells || edge.b >= cells; };
  if (std::any_of(part.edges.begin(), part.edges.end(), is_beyond)) from.refuse();
  return part;
}

JoinedParts join_parts(std::uint64_t seed, std::span<RimPart> parts, std::size_t cols, unsigned side_log2,
                       const Execution& execution) {
  return Joining(seed, parts, cols, side_log2).run(execution);
}

}  // namespace warren::maze
