// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/separator_fronts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>

#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

template <class Length>
[[gnu::always_inline]] inline void lessen(std::uint32_t* __restrict least, const Length* __restrict rest,
                                          std::uint32_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t length = rest[i];
    const bool is_none = std::is_same_v<Length, std::uint16_t> && length == no_short_way;
    const std::uint32_t sum = is_none ? no_way : first + length;
    least[i] = sum < least[i] ? sum : least[i];
  }
}

[[gnu::always_inline]] inline void lessen_by(std::uint32_t* __restrict least, std::uint32_t* __restrict by,
                                             const std::uint32_t* __restrict rest, std::uint32_t first,
                                             std::uint32_t gate, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t sum = first + rest[i];
    by[i] = sum < least[i] ? gate : by[i];
    least[i] = sum < least[i] ? sum : least[i];
  }
}

}  // namespace

LessenRowBy lessen_row_by(detail::InstructionSet set) { return detail::VersionsOf<&lessen_by>::up_to_avx2(set); }

template <class Length>
LessenRow<Length> lessen_row(detail::InstructionSet set) {
  return detail::VersionsOf<&lessen<Length>>::up_to_avx2(set);
}
template LessenRow<std::uint32_t> lessen_row<std::uint32_t>(detail::InstructionSet);
template LessenRow<std::uint16_t> lessen_row<std::uint16_t>(detail::InstructionSet);

namespace {

constexpr GateRank no_rank = ~GateRank{0};
constexpr std::size_t block = 32;  // gates: their rows of up to some thousand entries stay in the second-level cache
constexpr std::size_t front_row_grain = 32;  // rows a chunk
constexpr std::size_t many_rows = 256;       // are worth waking other threads for
constexpr std::size_t rows_per_poll = 64;    // each of a few thousand entries at most

/// The gate that a way goes over; or hop_bit and the number of a hop.
using WayBy = std::uint32_t;
constexpr WayBy hop_bit = WayBy{1} << 31;

/// Lengths between the gates and bounds of one front while it is made: the upper triangle of a symmetric matrix, row by
/// row; and of each way by what it goes: over a gate of lower rank, or as a hop. Eliminating a gate makes each later
/// pair the shorter of itself and the way by the gate; rows of gates are done in blocks, so that the rows below meet a
/// block while it is in cache, side by side on all threads where they are many.
class FrontMatrix {
 public:
  /// size x size, no ways at all. Asks `execution` for the memory.
  FrontMatrix(std::size_t size, const Execution& execution) : size_(size) {
    const std::size_t entries = size * (size + 1) / 2;
    execution.reserve(entries * (sizeof(std::uint32_t) + sizeof(WayBy)));
    const auto poll = [&] { execution.check(); };
    assign_polled(lengths_, entries, no_way, poll);
    assign_polled(by_, entries, WayBy{0}, poll);
  }

  std::size_t size() const { return size_; }
  /// Entries i .. size - 1 of row i.
  std::uint32_t* row(std::size_t i) { return lengths_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  const std::uint32_t* row(std::size_t i) const { return lengths_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  /// By what the ways of row i go, where there are any.
  const WayBy* by(std::size_t i) const { return by_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  HopTurns hop(WayBy by) const { return hops_[by & ~hop_bit]; }
  /// A hop from i to j > i.
  void lessen_by_hop(std::size_t i, std::size_t j, std::uint32_t length, HopTurns turns) {
    if (length >= row(i)[j - i]) return;
    row(i)[j - i] = length;
    by(i)[j - i] = hop_bit | static_cast<WayBy>(hops_.size());
    hops_.push_back(turns);
  }
  /// The way from `from` to `to` > `from` of another matrix, here i and j > i.
  void lessen_as(std::size_t i, std::size_t j, const FrontMatrix& other, std::size_t from, std::size_t to) {
    const std::uint32_t length = other.row(from)[to - from];
    if (length >= row(i)[j - i]) return;
    const WayBy by_what = other.by(from)[to - from];
    if ((by_what & hop_bit) != 0) return lessen_by_hop(i, j, length, other.hop(by_what));
    row(i)[j - i] = length;
    by(i)[j - i] = by_what;
  }
  /// The first `gates` of all, whose ranks begin at `first`.
  void eliminate(std::size_t gates, GateRank first, const Execution& execution) {
    for (std::size_t begin = 0; begin < gates; begin += block) {
      eliminate_block(begin, std::min(begin + block, gates), first, execution);
    }
  }

 private:
  WayBy* by(std::size_t i) { return by_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }

  void eliminate_block(std::size_t first, std::size_t last, GateRank rank, const Execution& execution) {
    for (std::size_t i = first + 1; i < last; ++i) pass_by(i, first, i, rank);
    if (size_ - last < many_rows) {
      execution.check();
      for (std::size_t i = last; i < size_; ++i) pass_by(i, first, last, rank);
      return;
    }
    for_chunks(size_ - last, front_row_grain, execution.quiet(), [&](Range r) {
      for (std::size_t i = last + r.first; i < last + r.last; ++i) pass_by(i, first, last, rank);
    });
  }

  /// The ways from `i` by gates first .. last - 1, whose rows are done; `rank` is that of gate 0.
  void pass_by(std::size_t i, std::size_t first, std::size_t last, GateRank rank) {
    const LessenRowBy lessen_all = lessen_row_by();
    std::uint32_t* const own = row(i);
    for (std::size_t gate = first; gate < last; ++gate) {
      const std::uint32_t* const from_i = row(gate) + (i - gate);
      if (*from_i < no_way) lessen_all(own, by(i), from_i, *from_i, rank + static_cast<GateRank>(gate), size_ - i);
    }
  }

  std::size_t size_;
  RawVector<std::uint32_t> lengths_;
  RawVector<WayBy> by_;
  RawVector<HopTurns> hops_;
};

std::size_t place_in(std::span<const std::uint32_t> ascending, std::uint32_t value) {
  return static_cast<std::size_t>(std::lower_bound(ascending.begin(), ascending.end(), value) - ascending.begin());
}

/// Adds the gates from `first` on that chains of these junctions lead to, and puts all in order, each once.
void add_bounds(const CoreGraph& graph, const RawVector<GateRank>& rank, std::span<const JunctionId> junctions,
                GateRank first, std::vector<GateRank>& bounds) {
  for (const JunctionId v : junctions) {
    for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
      const HalfEdge twin = graph.twin[h];
      if (twin == no_half_edge || rank[twin / 4] == no_rank || rank[twin / 4] < first) continue;
      bounds.push_back(rank[twin / 4]);
    }
  }
  std::sort(bounds.begin(), bounds.end());
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
}

/// What a node hands to its parent.
struct BoundLengths {
  std::vector<GateRank> bounds;  ///< ascending
  FrontMatrix lengths;           ///< between them; a leaf's ways are hops
};

/// The lengths between the bounds of a leaf by ways through its junctions: they are eliminated one by one, the one with
/// the fewest neighbours first, each joining its neighbours pairwise. Neighbours are bits of two words, lengths a small
/// dense matrix, all in first-level cache. Who joined whom says at last by which chains the ways between bounds go.
/// About 200 ns a junction. Scratch of one thread.
class LeafElimination {
 public:
  /// rank: of each junction, none of those in leaves.
  LeafElimination(const CoreGraph& graph, const RawVector<GateRank>& rank) : graph_(graph), rank_(rank) {}

  BoundLengths eliminate(std::span<const JunctionId> leaf, const Execution& execution) {
    bounds_.clear();
    add_bounds(graph_, rank_, leaf, 0, bounds_);
    load(leaf);
    std::uint64_t left = (std::uint64_t{1} << leaf.size()) - 1;
    while (left != 0) {
      std::size_t least = most;
      int fewest = most + 1;
      for (std::uint64_t rest = left; rest != 0; rest &= rest - 1) {
        const auto junction = static_cast<std::size_t>(std::countr_zero(rest));
        const int degree = std::popcount(neighbours_[junction][0]) + std::popcount(neighbours_[junction][1]);
        if (degree >= fewest) continue;
        fewest = degree;
        least = junction;
      }
      take_out(least);
      left &= ~(std::uint64_t{1} << least);
    }
    BoundLengths result{bounds_, FrontMatrix(bounds_.size(), execution)};
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      for (std::size_t j = i + 1; j < bounds_.size(); ++j) {
        const std::size_t to = leaf.size() + j;
        const bool joined = (neighbours_[leaf.size() + i][to / 64] >> to % 64 & 1U) != 0;
        if (!joined) continue;
        result.lengths.lessen_by_hop(i, j, length_[leaf.size() + i][to], turns(leaf.size() + i, to));
      }
    }
    return result;
  }

 private:
  static constexpr std::size_t most = 128;
  static_assert(3 * most_leaf_junctions + 2 <= most, "a connected leaf of n junctions has at most 2 n + 2 bounds");
  using Neighbours = std::array<std::uint64_t, 2>;

  void load(std::span<const JunctionId> leaf) {
    assert(leaf.size() + bounds_.size() <= most);
    std::fill_n(neighbours_.begin(), leaf.size() + bounds_.size(), Neighbours{});
    for (std::size_t v = 0; v < leaf.size(); ++v) {
      slots_[v] = slots_of(graph_, leaf[v]);
      for (HalfEdge h = 4 * leaf[v]; h < 4 * leaf[v] + 4; ++h) {
        const HalfEdge twin = graph_.twin[h];
        if (twin == no_half_edge) continue;
        const GateRank rank = rank_[twin / 4];
        const std::size_t end = rank == no_rank ? place_in(leaf, twin / 4) : leaf.size() + place_in(bounds_, rank);
        if (rank != no_rank) slots_[end] = slots_of(graph_, twin / 4);
        join(v, end, graph_.length[h], {chain, static_cast<std::uint8_t>(h % 4), static_cast<std::uint8_t>(twin % 4)});
      }
    }
  }

  /// By a junction, or `chain`, which leaves a and b by these slots.
  struct Join {
    std::uint8_t by;
    std::uint8_t from_slot;
    std::uint8_t to_slot;
  };
  static constexpr std::uint8_t chain = most;

  void join(std::size_t a, std::size_t b, std::uint32_t length, Join how) {
    const bool joined = (neighbours_[a][b / 64] >> b % 64 & 1U) != 0;
    if (joined && length_[a][b] <= length) return;
    neighbours_[a][b / 64] |= std::uint64_t{1} << b % 64;
    neighbours_[b][a / 64] |= std::uint64_t{1} << a % 64;
    length_[a][b] = length_[b][a] = length;
    join_[a][b] = how;
    join_[b][a] = {how.by, how.to_slot, how.from_slot};
  }

  void take_out(std::size_t junction) {
    std::array<std::uint8_t, most> near;
    std::size_t count = 0;
    for (std::size_t word = 0; word < 2; ++word) {
      for (std::uint64_t rest = neighbours_[junction][word]; rest != 0; rest &= rest - 1) {
        near[count++] = static_cast<std::uint8_t>(64 * word + static_cast<std::size_t>(std::countr_zero(rest)));
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      neighbours_[near[i]][junction / 64] &= ~(std::uint64_t{1} << junction % 64);
      for (std::size_t j = i + 1; j < count; ++j) {
        join(near[i], near[j], length_[junction][near[i]] + length_[junction][near[j]],
             {static_cast<std::uint8_t>(junction), 0, 0});
      }
    }
  }

  /// What was joined by a junction is that way in two parts, however either was joined: both were never joined anew
  /// since the junction was taken out.
  HopTurns turns(std::size_t from, std::size_t to) {
    TurnWriter writer;
    unsigned exits = slots_[from];
    todo_.assign(1, {static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to)});
    while (!todo_.empty()) {
      const auto [a, b] = todo_.back();
      todo_.pop_back();
      const Join& how = join_[a][b];
      if (how.by != chain) {
        todo_.emplace_back(how.by, b);
        todo_.emplace_back(a, how.by);
        continue;
      }
      writer.take(exits, how.from_slot);
      exits = slots_[b] & ~(1U << how.to_slot);
    }
    return writer.turns();
  }

  const CoreGraph& graph_;
  const RawVector<GateRank>& rank_;
  std::vector<GateRank> bounds_;
  std::array<Neighbours, most> neighbours_{};
  std::array<std::array<std::uint32_t, most>, most> length_{};
  std::array<std::array<Join, most>, most> join_{};
  std::array<std::uint8_t, most> slots_{};                   // with chains, of a junction or a bound
  std::vector<std::pair<std::uint8_t, std::uint8_t>> todo_;  // parts of a way, the first one last
};

/// Fronts of consecutive nodes as they are made: offsets from their own beginning, until parts are put one behind the
/// other.
class FrontPart {
 public:
  /// The front of gates first .. first + gates - 1: the rows that these have in the matrix, eliminated.
  void add(GateRank first, std::uint32_t gates, std::span<const GateRank> bounds, const FrontMatrix& matrix) {
    fronts_.push_back({bounds_.size(), add_lengths(gates, matrix), add_ways(first, gates, matrix), first, gates,
                       static_cast<std::uint32_t>(bounds.size()), no_front});
    bounds_.insert(bounds_.end(), bounds.begin(), bounds.end());
  }
  /// Room for all of them and what may be above. Asks `execution` for it.
  void reserve_for(std::span<const FrontPart> parts, const Execution& execution) {
    std::size_t shorts = 0;
    std::size_t ways = 0;
    for (const FrontPart& part : parts) {
      shorts += part.short_lengths_.size();
      ways += part.ways_.size();
    }
    execution.reserve((shorts + ways) * sizeof(std::uint16_t) * 3 / 2);
    short_lengths_.reserve(shorts * 3 / 2);
    ways_.reserve(ways * 3 / 2);
  }

  void append(const FrontPart& next) {
    for (Front front : next.fronts_) {
      front.first_bound += bounds_.size();
      front.rows += 2 * (front.is_short() ? short_lengths_.size() : lengths_.size());
      front.ways += 4 * ways_.size();
      fronts_.push_back(front);
    }
    bounds_.insert(bounds_.end(), next.bounds_.begin(), next.bounds_.end());
    lengths_.insert(lengths_.end(), next.lengths_.begin(), next.lengths_.end());
    short_lengths_.insert(short_lengths_.end(), next.short_lengths_.begin(), next.short_lengths_.end());
    ways_.insert(ways_.end(), next.ways_.begin(), next.ways_.end());
  }

  /// Once all fronts are there: their parents.
  void link(const Execution& execution) {
    for (std::size_t i = 0; i < fronts_.size(); ++i) {
      execution.poll(i);
      Front& front = fronts_[i];
      if (front.bounds == 0) continue;
      const GateRank lowest = bounds_[front.first_bound];
      const auto after = std::ranges::upper_bound(fronts_, lowest, {}, &Front::first);
      front.parent = static_cast<FrontId>(after - fronts_.begin() - 1);
    }
  }

  /// Leaves nothing here.
  FrontArrays arrays(RawVector<LatticePlace> gate_place) {
    return {ArrayOrView<Front>(std::move(fronts_)),          ArrayOrView<GateRank>(std::move(bounds_)),
            ArrayOrView<std::uint32_t>(std::move(lengths_)), ArrayOrView<std::uint16_t>(std::move(short_lengths_)),
            ArrayOrView<std::uint16_t>(std::move(ways_)),    ArrayOrView<LatticePlace>(std::move(gate_place))};
  }

 private:
  /// In two bytes each where all fit; returns Front::rows.
  std::uint64_t add_lengths(std::uint32_t gates, const FrontMatrix& matrix) {
    bool fits = true;
    for (std::size_t i = 0; i < gates; ++i) {
      fits = fits && std::all_of(matrix.row(i) + 1, matrix.row(i) + (matrix.size() - i),
                                 [](std::uint32_t length) { return length < no_short_way || length == no_way; });
    }
    const std::uint64_t rows = fits ? 2 * short_lengths_.size() + 1 : 2 * lengths_.size();
    for (std::size_t i = 0; i < gates; ++i) {
      const std::uint32_t* const first = matrix.row(i) + 1;
      const std::uint32_t* const last = matrix.row(i) + (matrix.size() - i);
      if (fits) {
        std::transform(first, last, std::back_inserter(short_lengths_), [](std::uint32_t length) {
          return length == no_way ? no_short_way : static_cast<std::uint16_t>(length);
        });
      } else {
        lengths_.insert(lengths_.end(), first, last);
      }
    }
    return rows;
  }

  /// In as few bits as the largest one needs; returns Front::ways.
  std::uint64_t add_ways(GateRank first, std::uint32_t gates, const FrontMatrix& matrix) {
    const auto for_each_way = [&](const auto& visit) {
      for (std::uint32_t i = 0; i < gates; ++i) {
        const WayBy* const by = matrix.by(i);
        for (std::size_t j = 1; j < matrix.size() - i; ++j) {
          if (matrix.row(i)[j] >= no_way) {
            visit(0);
          } else {
            visit((by[j] & hop_bit) != 0 ? 2 * matrix.hop(by[j]) + 1 : 2 * std::uint64_t{first + i - by[j]});
          }
        }
      }
    };
    std::uint64_t all = 0;
    for_each_way([&](std::uint64_t way) { all |= way; });
    const unsigned width = unsigned{all >> 16U != 0} + unsigned{all >> 32U != 0};
    const std::uint64_t ways = 4 * ways_.size() + width;
    for_each_way([&](std::uint64_t way) {
      for (unsigned left = 1U << width; left > 0; --left, way >>= 16U) {
        ways_.push_back(static_cast<std::uint16_t>(way & 0xffffU));
      }
    });
    return ways;
  }

  RawVector<Front> fronts_;
  RawVector<GateRank> bounds_;
  RawVector<std::uint32_t> lengths_;
  RawVector<std::uint16_t> short_lengths_;
  RawVector<std::uint16_t> ways_;
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

  void rank_gates() {
    execution_.reserve(graph_.size() * sizeof(GateRank) + dissection_.node.size() * sizeof(NodePlace));
    assign_polled(rank_, graph_.size(), no_rank, [&] { execution_.check(); });
    place_.reserve(dissection_.node.size());
    std::vector<std::size_t> open;
    std::uint64_t member = 0;
    GateRank next = 0;
    for (std::size_t node = 0; node < dissection_.node.size(); ++node) {
      execution_.poll(node);
      const DissectionNode& n = dissection_.node[node];
      NodePlace place{member, n.members, next, static_cast<std::uint32_t>(node)};
      for (std::uint32_t i = 0; i < n.children; ++i, open.pop_back()) {
        place.junctions += place_[open.back()].junctions;
        place.first_node = place_[open.back()].first_node;
      }
      open.push_back(node);
      place_.push_back(place);
      if (n.children > 0) {
        for (const JunctionId v : members(node)) {
          rank_[v] = next++;
          push_asked(gate_place_, graph_.place[v], execution_);
        }
      }
      member += n.members;
    }
  }

  void choose_tasks() {
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
  void do_node(std::size_t node, LeafElimination& leaves, std::vector<BoundLengths>& open, FrontPart& part) const {
    const DissectionNode& n = dissection_.node[node];
    if (n.children == 0) return open.push_back(leaves.eliminate(members(node), execution_));
    const std::span<const BoundLengths> children(open.data() + (open.size() - n.children), n.children);
    const std::vector<GateRank> bounds = bounds_of(node, children);
    FrontMatrix matrix(n.members + bounds.size(), execution_);
    for (const BoundLengths& child : children) add_child(child, node, bounds, matrix);
    add_chains(node, bounds, matrix);
    matrix.eliminate(n.members, place_[node].first_rank, execution_);
    part.add(place_[node].first_rank, n.members, bounds, matrix);
    open.erase(open.end() - static_cast<std::ptrdiff_t>(n.children), open.end());
    FrontMatrix rest(bounds.size(), execution_);
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (i % rows_per_poll == rows_per_poll - 1) execution_.check();
      for (std::size_t j = i + 1; j < bounds.size(); ++j) rest.lessen_as(i, j, matrix, n.members + i, n.members + j);
    }
    open.push_back({bounds, std::move(rest)});
  }

  std::vector<GateRank> bounds_of(std::size_t node, std::span<const BoundLengths> children) const {
    const GateRank end = place_[node].first_rank + dissection_.node[node].members;
    std::vector<GateRank> bounds;
    for (const BoundLengths& child : children) {
      bounds.insert(bounds.end(), std::lower_bound(child.bounds.begin(), child.bounds.end(), end), child.bounds.end());
    }
    add_bounds(graph_, rank_, members(node), end, bounds);
    return bounds;
  }

  void add_chains(std::size_t node, std::span<const GateRank> bounds, FrontMatrix& matrix) const {
    for (const JunctionId v : members(node)) {
      for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
        const HalfEdge twin = graph_.twin[h];
        if (twin == no_half_edge || rank_[twin / 4] == no_rank || rank_[twin / 4] < rank_[v]) continue;
        TurnWriter turns;
        turns.take(slots_of(graph_, v), h % 4);
        matrix.lessen_by_hop(index_of(rank_[v], node, bounds), index_of(rank_[twin / 4], node, bounds),
                             graph_.length[h], turns.turns());
      }
    }
  }

  void add_child(const BoundLengths& child, std::size_t node, std::span<const GateRank> bounds,
                 FrontMatrix& matrix) const {
    std::vector<std::size_t> index(child.bounds.size());
    for (std::size_t i = 0; i < index.size(); ++i) index[i] = index_of(child.bounds[i], node, bounds);
    for (std::size_t i = 0; i < index.size(); ++i) {
      if (i % rows_per_poll == rows_per_poll - 1) execution_.check();
      for (std::size_t j = i + 1; j < index.size(); ++j) matrix.lessen_as(index[i], index[j], child.lengths, i, j);
    }
  }

  /// Row of a gate of the node or of one of its bounds.
  std::size_t index_of(GateRank rank, std::size_t node, std::span<const GateRank> bounds) const {
    const GateRank end = place_[node].first_rank + dissection_.node[node].members;
    if (rank < end) return rank - place_[node].first_rank;
    return dissection_.node[node].members + place_in(bounds, rank);
  }

  /// Does what is left, the nodes above the tasks, in order, and puts all parts one behind the other.
  FrontArrays join(std::vector<FrontPart>& parts, std::vector<std::vector<BoundLengths>>& left) {
    FrontPart all;
    all.reserve_for(parts, execution_);
    LeafElimination leaves(graph_, rank_);
    std::vector<BoundLengths> open;
    std::size_t task = 0;
    for (std::size_t node = 0; node < place_.size(); ++node) {
      if (task < tasks_.size() && place_[tasks_[task]].first_node == node) {
        node = tasks_[task];
        execution_.check();
        all.append(std::exchange(parts[task], {}));
        for (BoundLengths& lengths : left[task]) open.push_back(std::move(lengths));
        left[task++].clear();
        continue;
      }
      do_node(node, leaves, open, all);
    }
    all.link(execution_);
    return all.arrays(std::move(gate_place_));
  }

  const CoreGraph& graph_;
  const Dissection& dissection_;
  const Execution& execution_;
  RawVector<GateRank> rank_;  // of a junction
  RawVector<LatticePlace> gate_place_;
  std::vector<NodePlace> place_;
  std::vector<std::size_t> tasks_;  // nodes whose whole region one thread does, ascending
};

}  // namespace

FrontArrays build_fronts(const CoreGraph& graph, const Dissection& dissection, const Execution& execution) {
  return FrontBuilder(graph, dissection, execution).build();
}

}  // namespace warren
