// SPDX-License-Identifier: BSD-3-Clause
// Where segments between integer points have to be cut so that they share nothing but ends: at ends that lie inside
// another one (exact), and at crossings, which are rounded to integers. Rounding can bend pieces into new crossings, so
// who cuts must ask again until nothing is left. Every decision is exact; a rounded crossing lies within 0.71 of both.
// Time O(n + pairs that share a square of a grid with about as many squares as pieces).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// How far rounding to the nearest point of a grid moves a point at most, in units of the grid.
inline constexpr double rounding_units = 0.7072;

/// A segment between integers (of at most 2^45, held as doubles).
struct IntegerPiece {
  Vec2 a, b;
  std::uint32_t source;  ///< whatever it is a piece of
};

/// A place where a piece must be cut.
struct Cut {
  std::uint32_t piece;
  Vec2 at;
  friend bool operator==(const Cut&, const Cut&) = default;
};

struct CrossingCuts {
  RawVector<Cut> cuts;   ///< some more than once
  bool crossed = false;  ///< is one of them a rounded crossing?
};

/// What is left to cut. Throws Stopped at the deadline and the memory limit: crowded pieces have many cuts.
CrossingCuts find_cuts(const std::vector<IntegerPiece>& pieces, const Execution& execution);

}  // namespace warren
