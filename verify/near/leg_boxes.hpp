// SPDX-License-Identifier: BSD-3-Clause
// The legs of a path in boxes: one around 8 legs in a row, one around 8 of these, and so on. Consecutive legs are near
// each other, so a search by boxes finds the legs near a place without any index of the plane.
//
// Built in one pass over the path by all threads, 4.6 bytes a leg. A search for what is near a wall looks at some tens
// to hundreds of boxes: dearer than a lookup in verify/near/leg_index, but nothing needs to be built for it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// Refers to the path, which must outlive it. Immutable: any number of threads may ask.
class LegBoxes {
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

  /// Calls visit(leg) for legs first .. last, leaving out blocks of them where skip(box of the block) is true.
  template <class Skip, class Visit>
  void for_each_in(std::size_t first, std::size_t last, const Skip& skip, const Visit& visit) const;

 private:
  template <class Skip, class Visit>
  void visit_block(std::size_t level, std::size_t block, std::size_t first, std::size_t last, const Skip& skip,
                   const Visit& visit) const;

  std::span<const Vec2> path_;
  double length_ = 0.0;
  bool has_skew_ = false;
  std::vector<RawVector<Box>> levels_;  ///< levels_[k][i]: of legs i * 8^(k+1) and the 8^(k+1) - 1 after it
};

template <class Skip, class Visit>
void LegBoxes::for_each_in(std::size_t first, std::size_t last, const Skip& skip, const Visit& visit) const {
  if (last - first < 16) {
    for (std::size_t i = first; i <= last; ++i) visit(i);
    return;
  }
  const std::size_t top = levels_.size() - 1;
  const std::size_t shift = 3 * (top + 1);
  for (std::size_t block = first >> shift; block <= last >> shift; ++block) {
    visit_block(top, block, first, last, skip, visit);
  }
}

template <class Skip, class Visit>
void LegBoxes::visit_block(std::size_t level, std::size_t block, std::size_t first, std::size_t last, const Skip& skip,
                           const Visit& visit) const {
  if (skip(levels_[level][block])) return;
  const std::size_t shift = 3 * level;  // of this block's eight parts
  const std::size_t from = std::max(first >> shift, 8 * block);
  const std::size_t to = std::min(last >> shift, 8 * block + 7);
  for (std::size_t part = from; part <= to; ++part) {
    if (level == 0) {
      visit(part);
    } else {
      visit_block(level - 1, part, first, last, skip, visit);
    }
  }
}

}  // namespace warren
