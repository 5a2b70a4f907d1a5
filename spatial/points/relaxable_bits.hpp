// SPDX-License-Identifier: BSD-3-Clause
// Which of some points in a row, up to 64, a search relaxes from p: those of a disc that the way through p reaches
// sooner than the label that they have. Of the 45 points that a roadmap's index looks at, one to six are left, so what
// costs are branches that can't be foreseen; here are none. With AVX-512 eight points at a time, with AVX2 four, else
// one by one; the same bits. All rows of a query together take 0.6 of the time (relaxable in
// bench/neighbours_bench.cpp).
#pragma once

#include <cstdint>

#include "core/base/types.hpp"
#include "spatial/points/disc_points.hpp"

namespace warren::detail {

/// A disc and the way to its middle.
struct Relaxation {
  Vec2 p;
  double square;   ///< of the radius, as SearchRadius::square() has it
  double through;  ///< length of the way to p, >= 0
};

/// Bit i is set where the squared distance d2 from p to points[i] is at most square, and through + sqrt(d2) <
/// labels[i]; labels that are negative or not above `through` never are. 1 to 64 points.
std::uint64_t relaxable_bits(const Vec2* points, const double* labels, std::uint32_t count, const Relaxation& by,
                             InstructionSet set = best_instruction_set()) noexcept;

}  // namespace warren::detail
