// SPDX-License-Identifier: BSD-3-Clause
// Polygons with holes as obstacles: cut along lines between their own corners into simple polygons that touch, so that
// what is blocked and what is free stays the same to the last bit, holes included, and all planners know the pieces.
//
// Each hole is tied by two cuts, from its leftmost and from its rightmost corner (of equal x: the lower and the upper
// one), so every piece is bounded by one outline. A sweep (scenes/scene/rings) finds the cuts as those of polygons
// into monotone ones are found (de Berg et al., Computational Geometry, ch. 3), and rings that cross. Rings that touch
// at a point are tied there: of any corner all that is left without it hangs together, so each outline still passes a
// corner once. Every decision is exact. O(n log n) for n corners in all, however many holes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// What is wrong where without_holes() gives nothing.
inline constexpr std::string_view misplaced_hole =
    "a hole must have an area, lie inside its polygon and meet its outline and other holes in single points at most";

/// outer, holes: rings of either orientation, not closed. The pieces run anticlockwise. Empty where the rings can't be
/// those of a polygon with holes: a hole without area, outside of the polygon, or one that crosses another ring or
/// shares more than a point with it. A ring that meets itself is handed back alone, as the one piece: whoever takes it
/// says what is wrong. Throws Stopped.
std::vector<std::vector<Vec2>> without_holes(const std::vector<Vec2>& outer, std::span<const std::vector<Vec2>> holes,
                                             const Execution& execution);

/// Adds the pieces as polygons of that line, and the cuts between them as seams. False: the rings can't be those of a
/// polygon with holes, and nothing is added.
bool add_without_holes(Scene& scene, std::size_t line, const std::vector<Vec2>& outer,
                       std::span<const std::vector<Vec2>> holes, const Execution& execution);

/// Is the point on a seam, between its ends? Then it is strictly inside of the polygon that was cut there.
bool stands_on_seam(const Scene& scene, Vec2 p);

// Is a closed outline simple: does it neither cross nor touch itself? Small ones by comparing all sides, others by a
// sweep (scenes/scene/rings), which stops at the first contact: O(n log n), exact, whatever the shape.

/// Two sides that meet where they must not; side i begins in corner i.
struct SideContact {
  std::size_t first;
  std::size_t second;
};

/// At least three corners, no two in a row equal. Sides that follow each other may meet in their corner alone. Throws
/// Stopped.
std::optional<SideContact> self_contact(std::span<const Vec2> corners, const Execution& execution);

// A line swept over closed rings of corners (Shamos, Hoey 1976). It stops at the first contact of two sides that must
// not meet, and tells at each corner which side lies directly below: O(n log n), exact, whatever the rings: neighbours
// on the line are compared, and where rings meet first, two neighbours meet. Corners are ordered by x, then y, as if
// the line leaned a little, so vertical sides and equal x need no rule of their own. Where rings may touch at points,
// the corners of one place are passed together; that they touch and do not cross there is seen by what is inside: of
// the sides on the line every second one has the inside above it.

/// Closed rings, one after the other; side i runs from corner i to the next one of its ring.
class RingSides {
 public:
  /// first: the number of each ring's first corner, ascending from 0. Refers to the corners.
  RingSides(std::span<const Vec2> corners, std::span<const std::uint32_t> first);

  std::size_t size() const { return corners_.size(); }
  std::uint32_t next(std::size_t i) const { return next_[i]; }
  std::uint32_t previous(std::size_t i) const { return previous_[i]; }
  Vec2 corner(std::size_t i) const { return corners_[i]; }
  Segment side(std::size_t i) const { return {corners_[i], corners_[next_[i]]}; }
  /// Does the side run with the sweep?
  bool ahead(std::size_t i) const { return is_before(corners_[i], corners_[next_[i]]); }
  /// The end of a side that the sweep reaches first, and the other.
  Vec2 low(std::size_t i) const { return ahead(i) ? corners_[i] : corners_[next_[i]]; }
  Vec2 high(std::size_t i) const { return ahead(i) ? corners_[next_[i]] : corners_[i]; }

  /// Do the sides share more than a corner in which one follows the other?
  bool meet(std::size_t i, std::size_t j) const;
  /// Do they cross, or share more than a point? Where one ends on the other they do not.
  bool cross(std::size_t i, std::size_t j) const;
  /// Does the ring turn back on itself in corner i?
  bool fold(std::size_t i) const;

 private:
  std::span<const Vec2> corners_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
};

/// May rings meet? At points: from the inside that they bound, which lies left of their sides.
enum class RingContacts : std::uint8_t { none, at_points };

/// The sides on the sweep line, lowest first. They do not cross left of it, or the sweep would have ended.
class RingSweep {
 public:
  static constexpr std::uint32_t no_side = 0xffffffffU;

  /// Refers to both. No ring folds.
  RingSweep(const RingSides& rings, const Execution& execution, RingContacts contacts = RingContacts::none)
      : rings_(rings),
        execution_(execution),
        may_touch_(contacts == RingContacts::at_points),
        order_(Order{&rings, &contact_, may_touch_}),
        place_(rings.size(), order_.end()) {}

  /// Calls visit(corners, below, touched) once the sweep has passed the corners of a place, one where rings may not
  /// touch. below: the side that lies directly below, or no_side; touched: the side that the place lies on, between its
  /// ends, or no_side. The first contact that may not be, where the sweep ended, if there is one. Throws Stopped.
  template <class Visit>
  std::optional<SideContact> run(const Visit& visit);

 private:
  /// Compares a side that begins in the corner that the line has reached with those on the line.
  struct Order {
    const RingSides* rings;
    std::optional<SideContact>* contact;
    bool may_touch;
    bool operator()(std::uint32_t i, std::uint32_t j) const;
  };
  using Status = std::set<std::uint32_t, Order>;

  std::uint32_t pass(std::span<const std::uint32_t> corners);
  void look_around(Vec2 here, Status::iterator lowest);
  void compare(std::uint32_t i, std::uint32_t j) {
    if (!contact_ && (may_touch_ ? rings_.cross(i, j) : rings_.meet(i, j))) contact_ = SideContact{i, j};
  }
  Status::iterator remove(std::uint32_t side);
  void insert(std::uint32_t side);

  const RingSides& rings_;
  const Execution& execution_;
  bool may_touch_;
  std::optional<SideContact> contact_;
  std::uint32_t touched_ = no_side;
  Status order_;
  std::vector<Status::iterator> place_;
};

template <class Visit>
std::optional<SideContact> RingSweep::run(const Visit& visit) {
  std::vector<std::uint32_t> corners(rings_.size());
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
  std::sort(corners.begin(), corners.end(),
            [&](std::uint32_t i, std::uint32_t j) { return is_before(rings_.corner(i), rings_.corner(j)); });
  constexpr std::size_t batch = 4096;
  std::size_t end = 0;
  std::size_t places = 0;
  for (std::size_t k = 0; k < corners.size(); k = end) {
    if (places++ % batch == 0) execution_.check();
    const auto here = [&](std::size_t other) { return rings_.corner(corners[other]) == rings_.corner(corners[k]); };
    if (!may_touch_ && k > 0 && here(k - 1)) return SideContact{corners[k - 1], corners[k]};
    for (end = k + 1; may_touch_ && end < corners.size() && here(end);) ++end;
    const std::span<const std::uint32_t> place(corners.data() + k, end - k);
    const std::uint32_t below = pass(place);
    if (contact_) return contact_;
    visit(place, below, touched_);
  }
  return std::nullopt;
}

}  // namespace warren
