// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/simple_outline.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "core/geometry.hpp"

namespace warren {
namespace {

bool before(Vec2 p, Vec2 q) { return p.x < q.x || (p.x == q.x && p.y < q.y); }

/// A closed outline and when two of its sides meet unlawfully.
class Outline {
 public:
  explicit Outline(std::span<const Vec2> corners) : corners_(corners) {}

  std::size_t size() const { return corners_.size(); }
  std::size_t next(std::size_t i) const { return i + 1 < size() ? i + 1 : 0; }
  std::size_t previous(std::size_t i) const { return i > 0 ? i - 1 : size() - 1; }
  Vec2 corner(std::size_t i) const { return corners_[i]; }
  Segment side(std::size_t i) const { return {corners_[i], corners_[next(i)]}; }
  /// The end of a side that the sweep reaches first, and the other.
  Vec2 low(std::size_t i) const { return before(corners_[i], corners_[next(i)]) ? corners_[i] : corners_[next(i)]; }
  Vec2 high(std::size_t i) const { return before(corners_[i], corners_[next(i)]) ? corners_[next(i)] : corners_[i]; }

  bool meet(std::size_t i, std::size_t j) const {
    if (next(i) == j) return fold(j);
    if (next(j) == i) return fold(i);
    return segments_touch(side(i), side(j));
  }
  /// Does the outline turn back on itself in corner i?
  bool fold(std::size_t i) const {
    const Vec2 p = corner(previous(i));
    const Vec2 q = corner(next(i));
    return on_segment(q, {p, corner(i)}) || on_segment(p, {corner(i), q});
  }

 private:
  std::span<const Vec2> corners_;
};

/// The sides on the sweep line, lowest first. They do not cross left of it, or the sweep would have ended.
class Sweep {
 public:
  Sweep(const Outline& outline, const Execution& execution)
      : outline_(outline),
        execution_(execution),
        order_(Order{&outline, &contact_}),
        place_(outline.size(), order_.end()) {}

  std::optional<SideContact> run() {
    std::vector<std::uint32_t> corners(outline_.size());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    std::sort(corners.begin(), corners.end(),
              [&](std::size_t i, std::size_t j) { return before(outline_.corner(i), outline_.corner(j)); });
    constexpr std::size_t batch = 4096;
    for (std::size_t k = 0; k < corners.size() && !contact_; ++k) {
      if (k % batch == 0) execution_.check();
      if (k > 0 && outline_.corner(corners[k]) == outline_.corner(corners[k - 1])) {
        return SideContact{corners[k - 1], corners[k]};
      }
      pass(corners[k]);
    }
    return contact_;
  }

 private:
  /// Compares a side that begins in the corner that the line has reached with those on the line.
  struct Order {
    const Outline* outline;
    std::optional<SideContact>* contact;
    bool operator()(std::uint32_t i, std::uint32_t j) const {
      if (i == j) return false;
      const Vec2 a = outline->low(i);
      const Vec2 b = outline->low(j);
      int side = 0;  // of j, seen from i
      if (before(b, a)) {
        side = -orient2d(b, outline->high(j), a);
        if (side == 0) *contact = SideContact{i, j};  // i begins on j
      } else if (before(a, b)) {
        side = orient2d(a, outline->high(i), b);
        if (side == 0) *contact = SideContact{i, j};
      } else {
        side = orient2d(a, outline->high(i), outline->high(j));
        if (side == 0 || !(outline->next(i) == j || outline->next(j) == i)) *contact = SideContact{i, j};
      }
      return side > 0 || (side == 0 && i < j);
    }
  };
  using Status = std::set<std::uint32_t, Order>;

  void pass(std::size_t corner) {
    const auto leaving = static_cast<std::uint32_t>(outline_.previous(corner));
    const auto entering = static_cast<std::uint32_t>(corner);
    const Vec2 here = outline_.corner(corner);
    for (const std::uint32_t side : {leaving, entering}) {
      if (outline_.high(side) == here) remove(side);
    }
    for (const std::uint32_t side : {leaving, entering}) {
      if (outline_.low(side) == here && !contact_) insert(side);
    }
  }
  void remove(std::uint32_t side) {
    const auto at = place_[side];
    if (at == order_.end()) return;
    const auto after = order_.erase(at);
    place_[side] = order_.end();
    if (after != order_.begin() && after != order_.end()) compare(*std::prev(after), *after);
  }
  void insert(std::uint32_t side) {
    const auto at = order_.insert(side).first;
    place_[side] = at;
    if (contact_) return;
    if (at != order_.begin()) compare(*std::prev(at), side);
    if (std::next(at) != order_.end()) compare(side, *std::next(at));
  }
  void compare(std::uint32_t i, std::uint32_t j) {
    if (!contact_ && outline_.meet(i, j)) contact_ = SideContact{i, j};
  }

  const Outline& outline_;
  const Execution& execution_;
  std::optional<SideContact> contact_;
  Status order_;
  std::vector<Status::iterator> place_;
};

std::optional<SideContact> compare_all(const Outline& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (std::size_t j = i + 1; j < outline.size(); ++j) {
      if (outline.meet(i, j)) return SideContact{i, j};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SideContact> self_contact(std::span<const Vec2> corners, const Execution& execution) {
  constexpr std::size_t few = 24;
  const Outline outline(corners);
  if (outline.size() <= few) return compare_all(outline);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (outline.fold(i)) return SideContact{outline.previous(i), i};
  }
  return Sweep(outline, execution).run();
}

}  // namespace warren
