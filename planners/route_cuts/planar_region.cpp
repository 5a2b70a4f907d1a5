// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/planar_region.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <vector>

namespace warren {

namespace {

/// [slots][slot]: the first slot that isn't empty before `slot`, going round to the right; `slot` itself comes last.
constexpr std::array<std::array<std::uint8_t, 4>, 16> slot_before = [] {
  std::array<std::array<std::uint8_t, 4>, 16> table{};
  for (unsigned slots = 0; slots < 16; ++slots) {
    for (unsigned slot = 0; slot < 4; ++slot) {
      unsigned turn = 3;
      while (turn > 0 && (slots >> ((slot + turn) & 3U) & 1U) == 0) --turn;
      table[slots][slot] = static_cast<std::uint8_t>((slot + turn) & 3U);
    }
  }
  return table;
}();

}  // namespace

/// The next half-edge along the face on the left, from the one that leads back.
HalfEdge RegionCut::next_around(HalfEdge back) const {
  return (back & ~HalfEdge{3}) + slot_before[region_->slots[back / 4]][back & 3U];
}

const RawVector<CutSide>& RegionCut::cut(const PlanarRegion& region) {
  region_ = &region;
  search_faces(trace_faces());
  grow_tree();
  const HalfEdge crossing = best_crossing();
  mark_inside(crossing);
  list_crossed(crossing);
  cover_crossed();
  return side_;
}

RegionCut::Face RegionCut::trace_faces() {
  face_.assign(region_->twin.size(), no_half_edge);
  first_.clear();
  Face longest = 0;
  std::size_t most = 0;
  for (JunctionId v = 0; v < region_->size(); ++v) {
    poll(v);
    for (unsigned left = region_->slots[v]; left != 0; left &= left - 1) {
      const HalfEdge h = 4 * v + static_cast<HalfEdge>(std::countr_zero(left));
      if (face_[h] != no_half_edge) continue;
      const auto face = static_cast<Face>(first_.size());
      first_.push_back(h);
      std::size_t length = 0;
      for (HalfEdge at = h; face_[at] == no_half_edge; at = next_around(region_->twin[at]), ++length) face_[at] = face;
      if (length <= most) continue;
      most = length;
      longest = face;
    }
  }
  return longest;
}

void RegionCut::search_faces(Face first) {
  constexpr std::uint32_t unseen = ~std::uint32_t{0};
  distance_.assign(first_.size(), unseen);
  entered_.resize(first_.size());
  in_search_.assign(region_->size(), 0);
  queue_.resize(first_.size());
  std::size_t end = 0;
  queue_[end++] = first;
  distance_[first] = 0;
  for (std::size_t i = 0; i < end; ++i) {
    poll(i);
    const Face face = queue_[i];
    const std::uint32_t next_distance = distance_[face] + 1;
    HalfEdge h = first_[face];
    do {
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
void RegionCut::grow_tree() {
  const std::size_t count = region_->size();
  above_.resize(count);
  above_[0] = no_half_edge;
  order_.resize(count);
  std::size_t end = 0;
  order_[end++] = 0;
  for (std::size_t i = 0; i < end; ++i) {
    poll(i);
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
  weight_.assign(count, 1);
  for (std::size_t i = count; i-- > 1;) weight_[above_[order_[i]] / 4] += weight_[order_[i]];
}

/// The least length for its smaller side, where a third of the junctions is as good as a half; then the better balance.
HalfEdge RegionCut::best_crossing() const {
  const std::size_t count = region_->size();
  const std::uint64_t enough = std::max<std::uint64_t>(1, count / 3);
  HalfEdge best = no_half_edge;
  std::uint64_t best_length = 0;
  std::uint64_t best_inside = 1;
  for (std::size_t i = 1; i < count; ++i) {
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

void RegionCut::mark_inside(HalfEdge crossing) {
  side_.assign(region_->size(), CutSide::outside);
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const JunctionId v = order_[i];
    if (above_[v] == crossing || side_[above_[v] / 4] == CutSide::inside) side_[v] = CutSide::inside;
  }
}

/// The chains from both faces back to the first one; what both ways share is not crossed.
void RegionCut::list_crossed(HalfEdge crossing) {
  crossed_.clear();
  crossed_.push_back(crossing);
  Face left = face_[crossing];
  Face right = face_[region_->twin[crossing]];
  while (left != right) {
    Face& deeper = distance_[left] >= distance_[right] ? left : right;
    crossed_.push_back(entered_[deeper]);
    deeper = face_[entered_[deeper]];
  }
}

/// One end of each crossed chain: all on the side where there are fewer.
void RegionCut::cover_crossed() {
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

}  // namespace warren
