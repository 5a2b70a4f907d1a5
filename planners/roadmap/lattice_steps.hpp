// SPDX-License-Identifier: BSD-3-Clause
// Which steps from one lattice point to the next are free: found wall by wall together with the milestones, before the
// candidate edges are gone through, so that a candidate costs a look at a bit. The same answers as asking the world
// about each. 2 bits a point.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/roadmap_growth.hpp"
#include "planners/roadmap/roadmap_options.hpp"

namespace warren {

/// Are the candidates that a rule makes among lattice points steps to the next one, and no others?
inline bool are_lattice_steps(const RoadmapOptions& options, const ConnectionRule& rule) {
  return options.sampler == SamplerKind::lattice && rule.neighbours == 0 && rule.radius * rule.radius < 2.0;
}

class LatticeSteps {
 public:
  /// Nothing is known yet: lattice_milestones() fills it.
  void reset(std::size_t rows, std::size_t words_a_row) {
    words_a_row_ = words_a_row;
    right_.resize(rows * words_a_row);
    up_.resize(rows * words_a_row);
  }
  /// Of some rows, all set.
  std::span<std::uint64_t> right(Range rows) { return all_set(right_, rows); }
  std::span<std::uint64_t> up(Range rows) { return all_set(up_, rows); }

  /// Bit i is set if motions[i] is free. Each leads from a lattice point to the next along an axis.
  std::uint32_t free_motions(std::span<const Motion<Vec2>> motions) const {
    std::uint32_t free = 0;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const auto [from, to] = motions[i];
      const auto col = static_cast<std::size_t>(std::min(from.x, to.x)) - 1;
      const auto row = static_cast<std::size_t>(std::min(from.y, to.y)) - 1;
      const RawVector<std::uint64_t>& bits = from.y == to.y ? right_ : up_;
      free |= static_cast<std::uint32_t>(bits[row * words_a_row_ + col / 64] >> (col % 64) & 1U) << i;
    }
    return free;
  }

 private:
  std::span<std::uint64_t> all_set(RawVector<std::uint64_t>& bits, Range rows) const {
    const std::span<std::uint64_t> its(&bits[rows.first * words_a_row_], rows.size() * words_a_row_);
    std::fill(its.begin(), its.end(), ~std::uint64_t{0});
    return its;
  }

  std::size_t words_a_row_ = 0;
  RawVector<std::uint64_t> right_;
  RawVector<std::uint64_t> up_;
};

}  // namespace warren
