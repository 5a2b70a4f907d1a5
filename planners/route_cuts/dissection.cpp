// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/dissection.hpp"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "core/base/page_pool.hpp"
#include "parallel/chunks.hpp"
#include "planners/route_cuts/planar_region.hpp"

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

/// Splits regions into their connected parts. Scratch of one thread.
class RegionParts {
 public:
  explicit RegionParts(const Execution& execution) : execution_(execution) {}

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
    number_junctions(region);
    for (JunctionId v = 0; v < region.size(); ++v) {
      if (v % (1U << 16) == 0) execution_.check();
      if (part_[v] != none) copy(v, region, parts[part_[v]]);
    }
    return parts;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  void number_parts(const PlanarRegion& region, const RawVector<CutSide>& side);
  void number_junctions(const PlanarRegion& region);
  void copy(JunctionId v, const PlanarRegion& region, PlanarRegion& part) const;

  const Execution& execution_;
  RawVector<std::uint32_t> part_;  // of a junction
  RawVector<JunctionId> number_;   // in its part
  RawVector<JunctionId> stack_;
  std::vector<std::uint32_t> sizes_;
};

void RegionParts::number_parts(const PlanarRegion& region, const RawVector<CutSide>& side) {
  part_.assign(region.size(), none);
  stack_.resize(region.size());
  sizes_.clear();
  for (JunctionId first = 0; first < region.size(); ++first) {
    if (first % (1U << 16) == 0) execution_.check();
    if (part_[first] != none || side[first] == CutSide::cut) continue;
    const auto number = static_cast<std::uint32_t>(sizes_.size());
    std::uint32_t size = 0;
    std::size_t open = 0;
    part_[first] = number;
    stack_[open++] = first;
    while (open > 0) {
      const JunctionId v = stack_[--open];
      if (++size % (1U << 16) == 0) execution_.check();
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

void RegionParts::number_junctions(const PlanarRegion& region) {
  number_.resize(region.size());
  for (JunctionId v = 0; v < region.size(); ++v) {
    if (part_[v] != none) number_[v] = sizes_[part_[v]]++;
  }
}

void RegionParts::copy(JunctionId v, const PlanarRegion& region, PlanarRegion& part) const {
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

/// What cuts and splits regions: scratch of one thread.
struct RegionTools {
  explicit RegionTools(const Execution& execution) : cut(execution), parts(execution) {}
  RegionCut cut;
  RegionParts parts;
};

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
  void cut_down(PlanarRegion region, RegionTools& tools, Dissection& into) const;
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
  whole.slots.resize(graph_.size());
  for (JunctionId v = 0; v < graph_.size(); ++v) whole.slots[v] = slots_of(graph_, v);
  RawVector<CutSide> nothing_cut;
  nothing_cut.assign(graph_.size(), CutSide::outside);
  for (PlanarRegion& part : RegionParts(execution_).split(whole, nothing_cut)) {
    roots_.push_back(large_.size());
    large_.emplace_back().region = std::move(part);
  }
}

void Dissector::divide(LargeRegion& large) const {
  const PagePool pages;  // what is cut leaves room for its parts
  RegionTools tools(execution_);
  if (large.region.size() <= task_) return cut_down(std::move(large.region), tools, large.whole);
  const RawVector<CutSide>& side = tools.cut.cut(large.region);
  large.members = cut_members(large.region, side);
  large.parts = tools.parts.split(large.region, side);
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

void Dissector::cut_down(PlanarRegion region, RegionTools& tools,
                         Dissection& into) const {  // NOLINT(misc-no-recursion)
  const bool is_leaf = region.size() <= leaf_;
  RawVector<JunctionId> members;
  std::uint32_t children = 0;
  if (is_leaf) {
    members = std::move(region.junction);
  } else {
    const RawVector<CutSide>& side = tools.cut.cut(region);
    members = cut_members(region, side);
    std::vector<PlanarRegion> parts = tools.parts.split(region, side);
    region = {};
    children = static_cast<std::uint32_t>(parts.size());
    for (PlanarRegion& part : parts) cut_down(std::move(part), tools, into);
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
