// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/core_graph.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>
#include <vector>

#include "core/base/page_pool.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// A connected part of the map: junctions numbered from 0, slots around them in the order of the plane.
struct PlanarRegion {
  RawVector<JunctionId> junction;  ///< of the whole map
  RawVector<HalfEdge> twin;        ///< four slots each, within the region; any number where a slot is empty
  RawVector<std::uint8_t> slots;   ///< a bit for each slot that isn't

  std::size_t size() const { return junction.size(); }
};

/// Which side of a cut a junction is on.
enum class CutSide : std::uint8_t { inside, outside, cut };

/// Small regions are many, and none of them is worth a look at the clock.
template <class T>
void assign_large(RawVector<T>& block, std::size_t n, T value, const Execution& execution) {
  constexpr std::size_t large = std::size_t{1} << 16;
  if (n < large) return block.assign(n, value);
  assign_polled(block, n, value, [&] { execution.check(); });
}

/// How a balanced set of junctions that cuts a region in two is found. Between the chains lie faces; a closed curve
/// through faces that crosses k chains cuts the map with k junctions or fewer. Shortest curves are shortest paths in
/// the dual graph, whose vertices are the faces (Reif 1983): a breadth-first search from the longest face, which is
/// where the region was cut from the rest, or the outside, gives each face its least number of chains to cross. The
/// chains that are no edges of that search tree are a spanning tree of the junctions; each of them, put into the search
/// tree, closes one curve through the first face, and what the curve holds is the subtree below the chain (Lipton and
/// Tarjan 1979; the tree and its cotree). So one sum over the spanning tree gives the length and the balance of every
/// such curve, and the best one is taken: O(junctions) in all. Corridors of mazes make these curves far shorter than
/// straight lines. As junctions have at most four chains, some curve has a quarter of the junctions inside. Scratch of
/// one thread; regions one after the other.
class RegionCut {
 public:
  explicit RegionCut(const Execution& execution) : execution_(execution) {}

  /// The side of each junction; the region has at least two. Throws Stopped.
  const RawVector<CutSide>& cut(const PlanarRegion& region) {
    region_ = &region;
    search_faces(trace_faces());
    grow_tree();
    const HalfEdge crossing = best_crossing();
    mark_inside(crossing);
    list_crossed(crossing);
    cover_crossed();
    region_ = nullptr;  // it may end before this
    return side_;
  }

 private:
  using Face = std::uint32_t;

  /// The next half-edge along the face on the left, from the one that leads back: of the first slot before it that
  /// isn't empty, going round to the right; its own comes last.
  HalfEdge next_around(HalfEdge back) const {
    const unsigned twice_around = region_->slots[back / 4] * 0x11U;
    const auto turns = static_cast<HalfEdge>(std::bit_width(twice_around >> back % 4 & 15U)) - 1;
    return (back & ~HalfEdge{3}) + ((back + turns) & 3U);
  }
  /// Returns the longest one.
  Face trace_faces() {
    assign_polled(face_, region_->twin.size(), no_half_edge, [this] { execution_.check(); });
    first_.clear();
    Face longest = 0;
    std::size_t most = 0;
    std::uint64_t steps = 0;
    for (JunctionId v = 0; v < region_->size(); ++v) {
      execution_.poll(v);
      for (unsigned left = region_->slots[v]; left != 0; left &= left - 1) {
        const HalfEdge h = 4 * v + static_cast<HalfEdge>(std::countr_zero(left));
        if (face_[h] != no_half_edge) continue;
        const auto face = static_cast<Face>(first_.size());
        first_.push_back(h);
        std::size_t length = 0;
        for (HalfEdge at = h; face_[at] == no_half_edge; at = next_around(region_->twin[at]), ++length) {
          execution_.poll(++steps);
          face_[at] = face;
        }
        if (length <= most) continue;
        most = length;
        longest = face;
      }
    }
    return longest;
  }

  void search_faces(Face first) {
    constexpr std::uint32_t unseen = ~std::uint32_t{0};
    assign_large(distance_, first_.size(), unseen, execution_);
    entered_.resize(first_.size());
    assign_large(in_search_, region_->size(), std::uint8_t{0}, execution_);
    queue_.resize(first_.size());
    std::size_t end = 0;
    queue_[end++] = first;
    distance_[first] = 0;
    std::uint64_t steps = 0;
    for (std::size_t i = 0; i < end; ++i) {
      const Face face = queue_[i];
      const std::uint32_t next_distance = distance_[face] + 1;
      HalfEdge h = first_[face];
      do {
        execution_.poll(++steps);
        const HalfEdge twin = region_->twin[h];
        const Face other = face_[twin];
        if (distance_[other] == unseen) {
          distance_[other] = next_distance;
          entered_[other] = h;
          in_search_[h / 4] = static_cast<std::uint8_t>(in_search_[h / 4] | 1U << h % 4);
          in_search_[twin / 4] = static_cast<std::uint8_t>(in_search_[twin / 4] | 1U << twin % 4);
          queue_[end++] = other;
        }
        h = next_around(twin);
      } while (h != first_[face]);
    }
  }

  /// The chains that the search didn't take are a tree of all junctions.
  void grow_tree() {
    const std::size_t count = region_->size();
    above_.resize(count);
    above_[0] = no_half_edge;
    order_.resize(count);
    std::size_t end = 0;
    order_[end++] = 0;
    for (std::size_t i = 0; i < end; ++i) {
      execution_.poll(i);
      const JunctionId v = order_[i];
      const unsigned up = i == 0 ? 0 : 1U << region_->twin[above_[v]] % 4;
      for (unsigned left = region_->slots[v] & ~in_search_[v] & ~up; left != 0; left &= left - 1) {
        const HalfEdge h = 4 * v + static_cast<HalfEdge>(std::countr_zero(left));
        const JunctionId below = region_->twin[h] / 4;
        above_[below] = h;
        order_[end++] = below;
      }
    }
    assert(end == count);
    assign_large(weight_, count, std::uint32_t{1}, execution_);
    for (std::size_t i = count; i-- > 1;) {
      execution_.poll(i);
      weight_[above_[order_[i]] / 4] += weight_[order_[i]];
    }
  }

  /// The least length for its smaller side, where a third of the junctions is as good as a half; then the better
  /// balance.
  HalfEdge best_crossing() const {
    const std::size_t count = region_->size();
    const std::uint64_t enough = std::max<std::uint64_t>(1, count / 3);
    HalfEdge best = no_half_edge;
    std::uint64_t best_length = 0;
    std::uint64_t best_inside = 1;
    for (std::size_t i = 1; i < count; ++i) {
      execution_.poll(i);
      const JunctionId v = order_[i];
      const Face left = face_[above_[v]];
      const Face right = face_[region_->twin[above_[v]]];
      const std::uint64_t length = left == right ? 1 : std::uint64_t{distance_[left]} + distance_[right] + 1;
      const std::uint64_t inside = std::min<std::uint64_t>(weight_[v], count - weight_[v]);
      const std::uint64_t ours = length * std::min(best_inside, enough);
      const std::uint64_t theirs = best_length * std::min(inside, enough);
      if (best != no_half_edge && (ours > theirs || (ours == theirs && inside <= best_inside))) continue;
      best = above_[v];
      best_length = length;
      best_inside = inside;
    }
    return best;
  }

  void mark_inside(HalfEdge crossing) {
    assign_large(side_, region_->size(), CutSide::outside, execution_);
    for (std::size_t i = 1; i < order_.size(); ++i) {
      execution_.poll(i);
      const JunctionId v = order_[i];
      if (above_[v] == crossing || side_[above_[v] / 4] == CutSide::inside) side_[v] = CutSide::inside;
    }
  }

  /// The chains from both faces back to the first one; what both ways share is not crossed.
  void list_crossed(HalfEdge crossing) {
    crossed_.assign(1, crossing);
    Face left = face_[crossing];
    Face right = face_[region_->twin[crossing]];
    while (left != right) {
      Face& deeper = distance_[left] >= distance_[right] ? left : right;
      crossed_.push_back(entered_[deeper]);
      deeper = face_[entered_[deeper]];
    }
  }

  /// One end of each crossed chain: all on the side where there are fewer.
  void cover_crossed() {
    const auto ends_on = [&](CutSide side) {
      std::vector<JunctionId> ends;
      for (const HalfEdge h : crossed_) {
        const JunctionId one = h / 4;
        ends.push_back(side_[one] == side ? one : region_->twin[h] / 4);
        assert(side_[ends.back()] == side && side_[one] != side_[region_->twin[h] / 4]);
      }
      std::sort(ends.begin(), ends.end());
      ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
      return ends;
    };
    const std::vector<JunctionId> inside = ends_on(CutSide::inside);
    const std::vector<JunctionId> outside = ends_on(CutSide::outside);
    for (const JunctionId v : inside.size() <= outside.size() ? inside : outside) side_[v] = CutSide::cut;
  }

  const Execution& execution_;
  const PlanarRegion* region_ = nullptr;
  RawVector<Face> face_;               // left of a half-edge
  RawVector<HalfEdge> first_;          // half-edge of a face
  RawVector<std::uint32_t> distance_;  // of a face: chains between it and the first one
  RawVector<HalfEdge> entered_;        // by which half-edge of the face before a face was entered
  RawVector<std::uint8_t> in_search_;  // slots of a junction whose chains are in the search tree
  RawVector<Face> queue_;
  RawVector<HalfEdge> above_;        // half-edge of the junction above that leads to a junction
  RawVector<JunctionId> order_;      // of junctions, parents first
  RawVector<std::uint32_t> weight_;  // junctions below and at one
  RawVector<HalfEdge> crossed_;      // by the curve
  RawVector<CutSide> side_;
};

/// A region of the upper levels, and what became of it.
struct LargeRegion {
  PlanarRegion region;
  std::vector<LargeRegion> parts;
  Dissection done;  // its cut, or all of it where it was small enough to be done at once
};

/// Cuts regions, and splits what is left into its connected parts. Scratch of one thread.
class RegionDivision {
 public:
  explicit RegionDivision(const Execution& execution) : execution_(execution), cut_(execution) {}

  /// The region's parts; the junctions of its cut become `members`.
  std::vector<PlanarRegion> divide(PlanarRegion region, RawVector<JunctionId>& members) {
    const RawVector<CutSide>& side = cut_.cut(region);
    for (std::size_t v = 0; v < region.size(); ++v) {
      execution_.poll(v + 1);
      if (side[v] == CutSide::cut) members.push_back(region.junction[v]);
    }
    return split(region, side);
  }

  /// In the order of their first junctions; cut junctions belong to none.
  std::vector<PlanarRegion> split(const PlanarRegion& region, const RawVector<CutSide>& side) {
    number_parts(region, side);
    std::vector<PlanarRegion> parts(sizes_.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].junction.resize(sizes_[i]);
      parts[i].twin.resize(4 * std::size_t{sizes_[i]});
      parts[i].slots.resize(sizes_[i]);
      sizes_[i] = 0;
    }
    number_.resize(region.size());
    for (JunctionId v = 0; v < region.size(); ++v) {
      execution_.poll(v);
      if (part_[v] != none) number_[v] = sizes_[part_[v]]++;
    }
    for (JunctionId v = 0; v < region.size(); ++v) {
      execution_.poll(v);
      if (part_[v] != none) copy(v, region, parts[part_[v]]);
    }
    return parts;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  void number_parts(const PlanarRegion& region, const RawVector<CutSide>& side) {
    assign_large(part_, region.size(), none, execution_);
    stack_.resize(region.size());
    sizes_.clear();
    for (JunctionId first = 0; first < region.size(); ++first) {
      execution_.poll(first);
      if (part_[first] != none || side[first] == CutSide::cut) continue;
      const auto number = static_cast<std::uint32_t>(sizes_.size());
      std::uint32_t size = 0;
      std::size_t open = 0;
      part_[first] = number;
      stack_[open++] = first;
      while (open > 0) {
        const JunctionId v = stack_[--open];
        execution_.poll(++size);
        for (unsigned left = region.slots[v]; left != 0; left &= left - 1) {
          const JunctionId near = region.twin[4 * v + static_cast<HalfEdge>(std::countr_zero(left))] / 4;
          if (part_[near] != none || side[near] == CutSide::cut) continue;
          part_[near] = number;
          stack_[open++] = near;
        }
      }
      sizes_.push_back(size);
    }
  }

  void copy(JunctionId v, const PlanarRegion& region, PlanarRegion& part) const {
    const JunctionId own = number_[v];
    unsigned slots = 0;
    for (unsigned left = region.slots[v]; left != 0; left &= left - 1) {
      const auto slot = static_cast<HalfEdge>(std::countr_zero(left));
      const HalfEdge twin = region.twin[4 * v + slot];
      if (part_[twin / 4] != part_[v]) continue;
      part.twin[4 * own + slot] = 4 * number_[twin / 4] + twin % 4;
      slots |= 1U << slot;
    }
    part.junction[own] = region.junction[v];
    part.slots[own] = static_cast<std::uint8_t>(slots);
  }

  const Execution& execution_;
  RegionCut cut_;
  RawVector<std::uint32_t> part_;  // of a junction
  RawVector<JunctionId> number_;   // in its part
  RawVector<JunctionId> stack_;
  std::vector<std::uint32_t> sizes_;
};

class Dissector {
 public:
  Dissector(const CoreGraph& graph, std::size_t leaf, const Execution& execution)
      : graph_(graph), leaf_(leaf), execution_(execution), task_(std::max<std::size_t>(4096, graph.size() / 64)) {}

  Dissection run() {
    execution_.reserve(graph_.size() * 80);
    LargeRegion whole = open_whole();
    for (std::vector<LargeRegion*> level{&whole}; !level.empty();) {
      std::vector<LargeRegion*> next;
      for (LargeRegion* const large : level) {
        for (LargeRegion& part : large->parts) next.push_back(&part);
      }
      level = std::move(next);
      for_chunks(level.size(), 1, execution_, [&](Range r) { divide(*level[r.first]); });
    }
    list(whole);
    return std::move(result_);
  }

 private:
  /// Its parts are those of the graph that hang together.
  LargeRegion open_whole() const {
    PlanarRegion whole;
    whole.junction.resize(graph_.size());
    whole.twin.resize(4 * graph_.size());
    whole.slots.resize(graph_.size());
    for (JunctionId v = 0; v < graph_.size(); ++v) {
      execution_.poll(v);
      whole.junction[v] = v;
      std::copy_n(graph_.twin.data() + 4 * v, 4, whole.twin.data() + 4 * v);
      whole.slots[v] = slots_of(graph_, v);
    }
    RawVector<CutSide> nothing_cut;
    assign_large(nothing_cut, graph_.size(), CutSide::outside, execution_);
    return {{}, as_large(RegionDivision(execution_).split(whole, nothing_cut)), {}};
  }

  static std::vector<LargeRegion> as_large(std::vector<PlanarRegion> regions) {
    std::vector<LargeRegion> large(regions.size());
    for (std::size_t i = 0; i < regions.size(); ++i) large[i].region = std::move(regions[i]);
    return large;
  }

  void divide(LargeRegion& large) const {
    const PagePool pages;  // what is cut leaves room for its parts
    RegionDivision division(execution_);
    if (large.region.size() <= task_) return cut_down(std::move(large.region), division, large.done);
    large.parts = as_large(division.divide(std::move(large.region), large.done.member));
    large.done.node.push_back(
        {static_cast<std::uint32_t>(large.done.member.size()), static_cast<std::uint32_t>(large.parts.size())});
  }

  void cut_down(PlanarRegion region, RegionDivision& division, Dissection& into) const {  // NOLINT(misc-no-recursion)
    RawVector<JunctionId> members;
    std::uint32_t children = 0;
    if (region.size() <= leaf_) {
      members = std::move(region.junction);
    } else {
      std::vector<PlanarRegion> parts = division.divide(std::move(region), members);
      children = static_cast<std::uint32_t>(parts.size());
      for (PlanarRegion& part : parts) cut_down(std::move(part), division, into);
    }
    into.member.insert(into.member.end(), members.begin(), members.end());
    into.node.push_back({static_cast<std::uint32_t>(members.size()), children});
  }

  /// Children first. Regions of the upper levels are cut a few dozen deep at most.
  void list(LargeRegion& large) {  // NOLINT(misc-no-recursion)
    for (LargeRegion& part : large.parts) list(part);
    const Dissection& done = large.done;
    result_.node.insert(result_.node.end(), done.node.begin(), done.node.end());
    result_.member.insert(result_.member.end(), done.member.begin(), done.member.end());
    large = {};
  }

  const CoreGraph& graph_;
  const std::size_t leaf_;
  const Execution& execution_;
  const std::size_t task_;  // regions of so many junctions are done at once
  Dissection result_;
};

}  // namespace

Dissection dissect(const CoreGraph& graph, std::size_t leaf, const Execution& execution) {
  return Dissector(graph, leaf, execution).run();
}

}  // namespace warren
