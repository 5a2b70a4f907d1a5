// SPDX-License-Identifier: BSD-3-Clause
// A line swept over closed rings of corners (Shamos, Hoey 1976). It stops at the first contact of two sides that must
// not meet, and tells at each corner which side lies directly below: O(n log n), exact, whatever the rings: neighbours
// on the line are compared, and where rings meet first, two neighbours meet. Corners are ordered by x, then y, as if
// the line leaned a little, so vertical sides and equal x need no rule of their own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/is_simple_outline.hpp"

namespace warren {

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
  /// Does the ring turn back on itself in corner i?
  bool fold(std::size_t i) const;

 private:
  std::span<const Vec2> corners_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
};

/// The sides on the sweep line, lowest first. They do not cross left of it, or the sweep would have ended.
class RingSweep {
 public:
  static constexpr std::uint32_t no_side = 0xffffffffU;

  /// Refers to both. No ring folds.
  RingSweep(const RingSides& rings, const Execution& execution)
      : rings_(rings), execution_(execution), order_(Order{&rings, &contact_}), place_(rings.size(), order_.end()) {}

  /// Calls visit(corner, below) once the sweep has passed the corner; below: the side that lies directly below it, or
  /// no_side. The first contact, where the sweep ended, if there is one. Throws Stopped.
  template <class Visit>
  std::optional<SideContact> run(const Visit& visit);

 private:
  /// Compares a side that begins in the corner that the line has reached with those on the line.
  struct Order {
    const RingSides* rings;
    std::optional<SideContact>* contact;
    bool operator()(std::uint32_t i, std::uint32_t j) const;
  };
  using Status = std::set<std::uint32_t, Order>;

  std::uint32_t pass(std::uint32_t corner);
  void compare(std::uint32_t i, std::uint32_t j) {
    if (!contact_ && rings_.meet(i, j)) contact_ = SideContact{i, j};
  }
  Status::iterator remove(std::uint32_t side);
  void insert(std::uint32_t side);

  const RingSides& rings_;
  const Execution& execution_;
  std::optional<SideContact> contact_;
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
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (k % batch == 0) execution_.check();
    if (k > 0 && rings_.corner(corners[k]) == rings_.corner(corners[k - 1])) {
      return SideContact{corners[k - 1], corners[k]};
    }
    const std::uint32_t below = pass(corners[k]);
    if (contact_) return contact_;
    visit(corners[k], below);
  }
  return std::nullopt;
}

}  // namespace warren
