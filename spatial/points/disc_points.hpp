// SPDX-License-Identifier: BSD-3-Clause
// The k nearest of the few points of a disc, without branches on their distances: gather, then count for each point how
// many are nearer. Counting compares 32-bit keys, which are all different: the leading bits of the squared distance as
// a float, and the point's index below them. What such keys cannot tell apart the caller decides in double, so the
// answer does not depend on them, nor on the instruction set. For 12 points (k = 8) counting costs 40 ns, sorting 200
// ns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/instruction_set.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"

namespace warren::detail {

struct DiscPoints {
  static constexpr std::size_t capacity = 128;
  static constexpr std::uint32_t index_mask = capacity - 1;
  static constexpr std::size_t padding = 16;

  std::size_t count = 0;
  double square[capacity + padding];
  std::uint32_t place[capacity + padding];
  alignas(64) std::int32_t key[capacity + padding];
  alignas(64) std::int32_t rank[capacity + padding];
  std::uint32_t by_rank[capacity];

  /// Adds the points first .. last - 1 but `skip` with squared distances <= limit. There must be room for all.
  void add_run(Vec2 p, double limit, std::span<const Vec2> points, std::uint32_t first, std::uint32_t last,
               std::uint32_t skip) noexcept {
    std::size_t end = count;
    for (std::uint32_t i = first; i < last; ++i) {
      const double dx = points[i].x - p.x;
      const double dy = points[i].y - p.y;
      const double sum = dx * dx + dy * dy;
      square[end] = sum;
      place[end] = i;
      end += as_whole<std::size_t>(sum <= limit) & as_whole<std::size_t>(i != skip);
    }
    count = end;
  }

  /// Fills by_rank with the indices of the points, ordered by the first 16 bits of the mantissa of square * scale,
  /// which is at most about one; returns how many of them may be among the k nearest by (distance, id): all whose key
  /// is at most one step above the k-th, since the roots of squares that are further apart differ. 1 <= k <= count.
  std::size_t sort_roughly(std::size_t k, double scale, InstructionSet set = best_instruction_set()) noexcept;
};

}  // namespace warren::detail
