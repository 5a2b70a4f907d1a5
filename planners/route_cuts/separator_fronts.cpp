// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/separator_fronts.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "parallel/chunks.hpp"
#include "planners/route_cuts/leaf_elimination.hpp"
#include "planners/route_cuts/min_plus.hpp"

namespace warren {
namespace {

/// Fronts of consecutive nodes, offsets from their own beginning.
struct FrontPart {
  RawVector<Front> fronts;
  RawVector<GateRank> bounds;
  RawVector<std::uint32_t> lengths;
  RawVector<std::uint16_t> short_lengths;
};

/// A node's place in the arrays of the dissection.
struct NodePlace {
  std::uint64_t first_member;
  std::uint64_t junctions;  // its own and those below
  GateRank first_rank;
  std::uint32_t first_node;  // of all below
};

class FrontBuilder {
 public:
  FrontBuilder(const CoreGraph& graph, const Dissection& dissection, const Execution& execution)
      : graph_(graph), dissection_(dissection), execution_(execution) {}

  FrontArrays build() {
    rank_gates();
    choose_tasks();
    std::vector<FrontPart> parts(tasks_.size() + 1);
    std::vector<std::vector<BoundLengths>> left(tasks_.size());
    for_chunks(tasks_.size(), 1, execution_, [&](Range r) {
      LeafElimination leaves(graph_, rank_);
      const std::size_t root = tasks_[r.first];
      for (std::size_t node = place_[root].first_node; node <= root; ++node) {
        do_node(node, leaves, left[r.first], parts[r.first]);
      }
    });
    return join(parts, left);
  }

 private:
  std::span<const JunctionId> members(std::size_t node) const {
    return std::span(dissection_.member).subspan(place_[node].first_member, dissection_.node[node].members);
  }
  void rank_gates();
  void choose_tasks();
  void do_node(std::size_t node, LeafElimination& leaves, std::vector<BoundLengths>& open, FrontPart& part) const;
  std::vector<GateRank> bounds_of(std::size_t node, std::span<const BoundLengths> children) const;
  void add_chains(std::size_t node, std::span<const GateRank> bounds, FrontMatrix& matrix) const;
  void add_child(const BoundLengths& child, std::size_t node, std::span<const GateRank> bounds,
                 FrontMatrix& matrix) const;
  std::size_t index_of(GateRank rank, std::size_t node, std::span<const GateRank> bounds) const;
  void store(std::size_t node, std::span<const GateRank> bounds, const FrontMatrix& matrix, FrontPart& part) const;
  FrontArrays join(std::vector<FrontPart>& parts, std::vector<std::vector<BoundLengths>>& left);
  static void link(RawVector<Front>& fronts, const RawVector<GateRank>& bounds);

  const CoreGraph& graph_;
  const Dissection& dissection_;
  const Execution& execution_;
  RawVector<GateRank> rank_;  // of a junction
  RawVector<LatticePlace> gate_place_;
  std::vector<NodePlace> place_;
  std::vector<std::size_t> tasks_;  // nodes whose whole region one thread does, ascending
};

void FrontBuilder::rank_gates() {
  rank_.assign(graph_.size(), no_rank);
  place_.reserve(dissection_.node.size());
  std::vector<std::size_t> open;
  std::uint64_t member = 0;
  GateRank next = 0;
  for (std::size_t node = 0; node < dissection_.node.size(); ++node) {
    const DissectionNode& n = dissection_.node[node];
    NodePlace place{member, n.members, next, static_cast<std::uint32_t>(node)};
    for (std::uint32_t i = 0; i < n.children; ++i, open.pop_back()) {
      place.junctions += place_[open.back()].junctions;
      place.first_node = place_[open.back()].first_node;
    }
    open.push_back(node);
    place_.push_back(place);
    if (n.is_leaf == 0) {
      for (const JunctionId v : members(node)) {
        rank_[v] = next++;
        gate_place_.push_back(graph_.place[v]);
      }
    }
    member += n.members;
  }
}

void FrontBuilder::choose_tasks() {
  const std::uint64_t enough = std::max<std::uint64_t>(1024, graph_.size() / 128);
  for (std::size_t node = place_.size(); node > 0;) {
    --node;
    if (place_[node].junctions > enough) continue;
    tasks_.push_back(node);
    node = place_[node].first_node;
  }
  std::reverse(tasks_.begin(), tasks_.end());
}

/// The children's lengths are the last ones of `open`; the node's take their place.
void FrontBuilder::do_node(std::size_t node, LeafElimination& leaves, std::vector<BoundLengths>& open,
                           FrontPart& part) const {
  const DissectionNode& n = dissection_.node[node];
  if (n.is_leaf != 0) return open.push_back(leaves.eliminate(members(node), execution_));
  const std::span<const BoundLengths> children(open.data() + (open.size() - n.children), n.children);
  const std::vector<GateRank> bounds = bounds_of(node, children);
  FrontMatrix matrix(n.members + bounds.size(), execution_);
  for (const BoundLengths& child : children) add_child(child, node, bounds, matrix);
  add_chains(node, bounds, matrix);
  matrix.eliminate(n.members, execution_);
  store(node, bounds, matrix, part);
  open.erase(open.end() - static_cast<std::ptrdiff_t>(n.children), open.end());
  FrontMatrix rest(bounds.size(), execution_);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    std::copy_n(matrix.row(n.members + i), bounds.size() - i, rest.row(i));
  }
  open.push_back({bounds, std::move(rest)});
}

std::vector<GateRank> FrontBuilder::bounds_of(std::size_t node, std::span<const BoundLengths> children) const {
  const GateRank end = place_[node].first_rank + dissection_.node[node].members;
  std::vector<GateRank> bounds;
  for (const BoundLengths& child : children) {
    bounds.insert(bounds.end(), std::lower_bound(child.bounds.begin(), child.bounds.end(), end), child.bounds.end());
  }
  for (const JunctionId v : members(node)) {
    for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
      const HalfEdge twin = graph_.twin[h];
      if (twin == no_half_edge || rank_[twin / 4] == no_rank || rank_[twin / 4] < end) continue;
      bounds.push_back(rank_[twin / 4]);
    }
  }
  std::sort(bounds.begin(), bounds.end());
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  return bounds;
}

/// Row of a gate of the node or of one of its bounds.
std::size_t FrontBuilder::index_of(GateRank rank, std::size_t node, std::span<const GateRank> bounds) const {
  const GateRank end = place_[node].first_rank + dissection_.node[node].members;
  if (rank < end) return rank - place_[node].first_rank;
  const auto* at = &*std::lower_bound(bounds.begin(), bounds.end(), rank);
  return dissection_.node[node].members + static_cast<std::size_t>(at - bounds.data());
}

void FrontBuilder::add_chains(std::size_t node, std::span<const GateRank> bounds, FrontMatrix& matrix) const {
  const GateRank first = place_[node].first_rank;
  for (const JunctionId v : members(node)) {
    for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
      const HalfEdge twin = graph_.twin[h];
      if (twin == no_half_edge || rank_[twin / 4] == no_rank || rank_[twin / 4] < first) continue;
      matrix.lessen(index_of(rank_[v], node, bounds), index_of(rank_[twin / 4], node, bounds), graph_.length[h]);
    }
  }
}

void FrontBuilder::add_child(const BoundLengths& child, std::size_t node, std::span<const GateRank> bounds,
                             FrontMatrix& matrix) const {
  std::vector<std::size_t> index(child.bounds.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = index_of(child.bounds[i], node, bounds);
  for (std::size_t i = 0; i < index.size(); ++i) {
    const std::uint32_t* const from = child.lengths.row(i);
    std::uint32_t* const to = matrix.row(index[i]);
    for (std::size_t j = i + 1; j < index.size(); ++j) {
      std::uint32_t& entry = to[index[j] - index[i]];
      entry = std::min(entry, from[j - i]);
    }
  }
}

void FrontBuilder::store(std::size_t node, std::span<const GateRank> bounds, const FrontMatrix& matrix,
                         FrontPart& part) const {
  const std::uint32_t gates = dissection_.node[node].members;
  bool fits = true;
  for (std::size_t i = 0; i < gates; ++i) {
    fits = fits && std::all_of(matrix.row(i) + 1, matrix.row(i) + (matrix.size() - i),
                               [](std::uint32_t length) { return length < no_short_way || length == no_way; });
  }
  const std::uint64_t rows = fits ? 2 * part.short_lengths.size() + 1 : 2 * part.lengths.size();
  part.fronts.push_back({part.bounds.size(), rows, place_[node].first_rank, gates,
                         static_cast<std::uint32_t>(bounds.size()), no_front, no_front, no_front});
  part.bounds.insert(part.bounds.end(), bounds.begin(), bounds.end());
  for (std::size_t i = 0; i < gates; ++i) {
    const std::uint32_t* const first = matrix.row(i) + 1;
    const std::uint32_t* const last = matrix.row(i) + (matrix.size() - i);
    if (fits) {
      std::transform(first, last, std::back_inserter(part.short_lengths), [](std::uint32_t length) {
        return length == no_way ? no_short_way : static_cast<std::uint16_t>(length);
      });
    } else {
      part.lengths.insert(part.lengths.end(), first, last);
    }
  }
}

/// Does what is left, the nodes above the tasks, in order, and puts all parts one behind the other.
FrontArrays FrontBuilder::join(std::vector<FrontPart>& parts, std::vector<std::vector<BoundLengths>>& left) {
  FrontPart all;
  const auto append = [&all](FrontPart part) {
    for (Front front : part.fronts) {
      front.first_bound += all.bounds.size();
      front.rows += 2 * (front.is_short() ? all.short_lengths.size() : all.lengths.size());
      all.fronts.push_back(front);
    }
    all.bounds.insert(all.bounds.end(), part.bounds.begin(), part.bounds.end());
    all.lengths.insert(all.lengths.end(), part.lengths.begin(), part.lengths.end());
    all.short_lengths.insert(all.short_lengths.end(), part.short_lengths.begin(), part.short_lengths.end());
  };
  std::size_t entries = 0;
  for (const FrontPart& part : parts) entries += part.short_lengths.size();
  execution_.reserve(entries * sizeof(std::uint16_t) * 3 / 2);
  all.short_lengths.reserve(entries * 3 / 2);
  LeafElimination leaves(graph_, rank_);
  std::vector<BoundLengths> open;
  std::size_t task = 0;
  for (std::size_t node = 0; node < place_.size(); ++node) {
    if (task < tasks_.size() && place_[tasks_[task]].first_node == node) {
      node = tasks_[task];
      append(std::exchange(parts[task], {}));
      for (BoundLengths& lengths : left[task]) open.push_back(std::move(lengths));
      left[task++].clear();
      continue;
    }
    FrontPart one;
    do_node(node, leaves, open, one);
    append(std::move(one));
  }
  link(all.fronts, all.bounds);
  return {ArrayOrView<Front>(std::move(all.fronts)), ArrayOrView<GateRank>(std::move(all.bounds)),
          ArrayOrView<std::uint32_t>(std::move(all.lengths)), ArrayOrView<std::uint16_t>(std::move(all.short_lengths)),
          ArrayOrView<LatticePlace>(std::move(gate_place_))};
}

void FrontBuilder::link(RawVector<Front>& fronts, const RawVector<GateRank>& bounds) {
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    Front& front = fronts[i];
    if (front.bounds == 0) continue;
    const GateRank lowest = bounds[front.first_bound];
    const auto after = std::upper_bound(fronts.begin(), fronts.end(), lowest,
                                        [](GateRank rank, const Front& f) { return rank < f.first; });
    front.parent = static_cast<FrontId>(after - fronts.begin() - 1);
    front.sibling = std::exchange(fronts[front.parent].last_child, static_cast<FrontId>(i));
  }
}

}  // namespace

FrontArrays build_fronts(const CoreGraph& graph, const Dissection& dissection, const Execution& execution) {
  return FrontBuilder(graph, dissection, execution).build();
}

}  // namespace warren
