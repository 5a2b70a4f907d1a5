// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/dissection.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "parallel/chunks.hpp"
#include "planners/route_index/planar_region.hpp"

namespace warren {
namespace {

/// A region of the upper levels, and what became of it.
struct LargeRegion {
  PlanarRegion region;
  RawVector<JunctionId> members;      // of its cut
  std::vector<PlanarRegion> parts;    // until they have numbers
  std::vector<std::size_t> children;  // their numbers
  Dissection whole;                   // where it was small enough to be done at once
};

/// Splits a region into its connected parts, in the order of their first junctions; cut junctions belong to none.
std::vector<PlanarRegion> connected_parts(const PlanarRegion& region, const RawVector<CutSide>& side,
                                          const Execution& execution) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  const std::size_t count = region.size();
  RawVector<std::uint32_t> part(count);
  std::fill(part.begin(), part.end(), none);
  RawVector<JunctionId> stack;
  std::vector<std::uint32_t> sizes;
  for (JunctionId first = 0; first < count; ++first) {
    if (side[first] == CutSide::cut || part[first] != none) continue;
    execution.check();
    const auto number = static_cast<std::uint32_t>(sizes.size());
    sizes.push_back(0);
    part[first] = number;
    stack.push_back(first);
    while (!stack.empty()) {
      const JunctionId v = stack.back();
      stack.pop_back();
      ++sizes.back();
      for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
        const HalfEdge twin = region.twin[h];
        if (twin == no_half_edge || part[twin / 4] != none || side[twin / 4] == CutSide::cut) continue;
        part[twin / 4] = number;
        stack.push_back(twin / 4);
      }
    }
  }
  std::vector<PlanarRegion> parts(sizes.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].junction.reserve(sizes[i]);
    parts[i].twin.reserve(4 * std::size_t{sizes[i]});
  }
  RawVector<JunctionId> number(count);
  for (JunctionId v = 0; v < count; ++v) {
    if (part[v] == none) continue;
    number[v] = static_cast<JunctionId>(parts[part[v]].junction.size());
    parts[part[v]].junction.push_back(region.junction[v]);
  }
  for (JunctionId v = 0; v < count; ++v) {
    if (part[v] == none) continue;
    for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
      const HalfEdge twin = region.twin[h];
      const bool kept = twin != no_half_edge && part[twin / 4] == part[v];
      parts[part[v]].twin.push_back(kept ? 4 * number[twin / 4] + twin % 4 : no_half_edge);
    }
  }
  return parts;
}

class Dissector {
 public:
  Dissector(const CoreGraph& graph, std::size_t leaf, const Execution& execution)
      : graph_(graph), leaf_(leaf), execution_(execution), task_(std::max<std::size_t>(4096, graph.size() / 64)) {}

  Dissection run() {
    execution_.reserve(graph_.size() * 80);
    open_whole();
    for (std::size_t first = 0; first < large_.size();) {
      const std::size_t last = large_.size();
      for_chunks(last - first, 1, execution_, [&](Range r) { divide(large_[first + r.first]); });
      for (; first < last; ++first) number_parts(first);
    }
    for (const std::size_t root : roots_) list(root);
    return std::move(result_);
  }

 private:
  void open_whole();
  void divide(LargeRegion& large) const;
  void number_parts(std::size_t large);
  void cut_down(PlanarRegion region, RegionCut& cutter, Dissection& into) const;
  static RawVector<JunctionId> cut_members(const PlanarRegion& region, const RawVector<CutSide>& side);
  void list(std::size_t large);

  const CoreGraph& graph_;
  const std::size_t leaf_;
  const Execution& execution_;
  const std::size_t task_;  // regions of so many junctions are done at once
  std::vector<LargeRegion> large_;
  std::vector<std::size_t> roots_;
  Dissection result_;
};

void Dissector::open_whole() {
  PlanarRegion whole;
  whole.junction.resize(graph_.size());
  for (JunctionId v = 0; v < graph_.size(); ++v) whole.junction[v] = v;
  whole.twin = graph_.twin;
  RawVector<CutSide> nothing_cut;
  nothing_cut.assign(graph_.size(), CutSide::outside);
  for (PlanarRegion& part : connected_parts(whole, nothing_cut, execution_)) {
    roots_.push_back(large_.size());
    large_.emplace_back().region = std::move(part);
  }
}

void Dissector::divide(LargeRegion& large) const {
  RegionCut cutter(execution_);
  if (large.region.size() <= task_) return cut_down(std::move(large.region), cutter, large.whole);
  const RawVector<CutSide>& side = cutter.cut(large.region);
  large.members = cut_members(large.region, side);
  large.parts = connected_parts(large.region, side, execution_);
  large.region = {};
}

void Dissector::number_parts(std::size_t large) {
  std::vector<PlanarRegion> parts = std::move(large_[large].parts);
  for (PlanarRegion& part : parts) {
    large_[large].children.push_back(large_.size());
    large_.emplace_back().region = std::move(part);
  }
}

RawVector<JunctionId> Dissector::cut_members(const PlanarRegion& region, const RawVector<CutSide>& side) {
  RawVector<JunctionId> members;
  for (std::size_t v = 0; v < region.size(); ++v) {
    if (side[v] == CutSide::cut) members.push_back(region.junction[v]);
  }
  return members;
}

void Dissector::cut_down(PlanarRegion region, RegionCut& cutter, Dissection& into) const {
  const bool is_leaf = region.size() <= leaf_;
  RawVector<JunctionId> members;
  std::uint32_t children = 0;
  if (is_leaf) {
    members = std::move(region.junction);
  } else {
    const RawVector<CutSide>& side = cutter.cut(region);
    members = cut_members(region, side);
    std::vector<PlanarRegion> parts = connected_parts(region, side, execution_);
    region = {};
    children = static_cast<std::uint32_t>(parts.size());
    for (PlanarRegion& part : parts) cut_down(std::move(part), cutter, into);
  }
  into.member.insert(into.member.end(), members.begin(), members.end());
  into.node.push_back({static_cast<std::uint32_t>(members.size()), children, is_leaf ? 1U : 0U});
}

/// Children first. Regions of the upper levels are cut a few dozen deep at most.
void Dissector::list(std::size_t number) {  // NOLINT(misc-no-recursion)
  for (const std::size_t child : large_[number].children) list(child);
  LargeRegion& large = large_[number];
  const Dissection& whole = large.whole;
  result_.node.insert(result_.node.end(), whole.node.begin(), whole.node.end());
  result_.member.insert(result_.member.end(), whole.member.begin(), whole.member.end());
  if (whole.node.empty()) {
    result_.member.insert(result_.member.end(), large.members.begin(), large.members.end());
    result_.node.push_back(
        {static_cast<std::uint32_t>(large.members.size()), static_cast<std::uint32_t>(large.children.size()), 0});
  }
  large = {};
}

}  // namespace

Dissection dissect(const CoreGraph& graph, std::size_t leaf, const Execution& execution) {
  return Dissector(graph, leaf, execution).run();
}

}  // namespace warren
