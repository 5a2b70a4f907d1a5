// SPDX-License-Identifier: BSD-3-Clause
// The legs of a path in boxes: one around 8 legs in a row, one around 8 of these, and so on. Consecutive legs are near
// each other, so a search by boxes finds the legs near a place without any index of the plane.
//
// Built in one pass over the path by all threads, 4.6 bytes a leg. A search for what is near a wall looks at some tens
// to hundreds of boxes, unless those near several walls in a row are looked for once
// (verify/judges/legs_against_obstacles).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// Boxes in blocks of eight in a row, eight of these in one above, and so on up to one around all.
class BoxLevels {
 public:
  /// Calls visit(block) for blocks of the lowest level, leaving out those in blocks for whose box skip(box) is true.
  template <class Skip, class Visit>
  void for_each_block(const Skip& skip, const Visit& visit) const {
    if (!levels_.empty()) visit_block(levels_.size() - 1, 0, skip, visit);
  }
  const Box& block_box(std::size_t block) const { return levels_[0][block]; }

 protected:
  void build_on(RawVector<Box> blocks);

  std::vector<RawVector<Box>> levels_;  ///< the blocks, and what is above them; none where there are no boxes

 private:
  template <class Skip, class Visit>
  void visit_block(std::size_t level, std::size_t block, const Skip& skip, const Visit& visit) const {
    if (skip(levels_[level][block])) return;
    if (level == 0) return visit(block);
    const std::size_t end = std::min(8 * (block + 1), levels_[level - 1].size());
    for (std::size_t part = 8 * block; part < end; ++part) visit_block(level - 1, part, skip, visit);
  }
};

/// Refers to the path, which must outlive it. Immutable: any number of threads may ask.
class LegBoxes : public BoxLevels {
 public:
  static constexpr std::size_t legs_a_sum = 8192;  ///< of length()
  /// path: at least two points.
  LegBoxes(std::span<const Vec2> path, const Execution& execution);

  std::span<const Vec2> path() const { return path_; }
  std::size_t leg_count() const { return path_.size() - 1; }
  Segment leg(std::size_t i) const { return {path_[i], path_[i + 1]}; }
  Box box() const { return levels_.back().front(); }  ///< of the whole path
  double length() const { return length_; }           ///< of the path: sums of legs_a_sum legs in a row, added up
  /// Does some leg run along an axis but for a millionth of its length?
  bool has_skew() const { return has_skew_; }

  /// Calls visit(leg) for all legs but those in blocks whose box skip(box) says to leave out.
  template <class Skip, class Visit>
  void for_each(const Skip& skip, const Visit& visit) const {
    for_each_block(skip, [&](std::size_t block) { for_each_in(block, visit); });
  }

  /// The second step after for_each_block(), for who asks several questions of one neighbourhood.
  template <class Visit>
  void for_each_in(std::size_t block, const Visit& visit) const {
    const std::size_t end = std::min(8 * (block + 1), leg_count());
    for (std::size_t leg = 8 * block; leg < end; ++leg) visit(leg);
  }

 private:
  std::span<const Vec2> path_;
  double length_ = 0.0;
  bool has_skew_ = false;
};

}  // namespace warren
