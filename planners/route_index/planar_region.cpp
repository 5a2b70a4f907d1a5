// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/planar_region.hpp"

#include <algorithm>
#include <cassert>

namespace warren {

/// Along the face on the left: at the other end, the first slot to the left of the way back.
HalfEdge RegionCut::next_around(HalfEdge h) const {
  const HalfEdge back = region_->twin[h];
  for (unsigned turn = 3; turn > 0; --turn) {
    const HalfEdge next = (back & ~HalfEdge{3}) | ((back + turn) & 3U);
    if (region_->twin[next] != no_half_edge) return next;
  }
  return back;
}

const RawVector<CutSide>& RegionCut::cut(const PlanarRegion& region) {
  region_ = &region;
  trace_faces();
  search_faces(longest_face());
  grow_tree();
  const HalfEdge crossing = best_crossing();
  mark_inside(crossing);
  list_crossed(crossing);
  cover_crossed();
  return side_;
}

void RegionCut::trace_faces() {
  const std::size_t half_edges = region_->twin.size();
  face_.assign(half_edges, no_half_edge);
  first_.clear();
  for (HalfEdge h = 0; h < half_edges; ++h) {
    poll(h);
    if (region_->twin[h] == no_half_edge || face_[h] != no_half_edge) continue;
    const auto face = static_cast<Face>(first_.size());
    first_.push_back(h);
    for (HalfEdge at = h; face_[at] == no_half_edge; at = next_around(at)) face_[at] = face;
  }
}

RegionCut::Face RegionCut::longest_face() const {
  RawVector<std::uint32_t> length(first_.size());
  std::fill(length.begin(), length.end(), 0U);
  for (const Face face : face_) {
    if (face != no_half_edge) ++length[face];
  }
  return static_cast<Face>(std::max_element(length.begin(), length.end()) - length.begin());
}

void RegionCut::search_faces(Face first) {
  constexpr std::uint32_t unseen = ~std::uint32_t{0};
  distance_.assign(first_.size(), unseen);
  entered_.resize(first_.size());
  in_search_.assign(face_.size(), 0);
  queue_.clear();
  queue_.push_back(first);
  distance_[first] = 0;
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    poll(i);
    const Face face = queue_[i];
    HalfEdge h = first_[face];
    do {
      const HalfEdge twin = region_->twin[h];
      const Face other = face_[twin];
      if (distance_[other] == unseen) {
        distance_[other] = distance_[face] + 1;
        entered_[other] = h;
        in_search_[h] = in_search_[twin] = 1;
        queue_.push_back(other);
      }
      h = next_around(h);
    } while (h != first_[face]);
  }
}

/// The chains that the search didn't take are a tree of all junctions.
void RegionCut::grow_tree() {
  const std::size_t count = region_->size();
  above_.assign(count, no_half_edge);
  order_.clear();
  order_.push_back(0);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    poll(i);
    const JunctionId v = order_[i];
    for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
      const HalfEdge twin = region_->twin[h];
      if (twin == no_half_edge || in_search_[h] != 0 || twin == above_[v]) continue;
      above_[twin / 4] = h;
      order_.push_back(twin / 4);
    }
  }
  assert(order_.size() == count);
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
