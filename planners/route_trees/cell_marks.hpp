// SPDX-License-Identifier: BSD-3-Clause
// Three bits a cell, laid out so that a tile of 64 x 64 cells is 24 lines of cache: is the cell in the core, and if it
// isn't, which way its root is; if it is, where the chains of the reduced core that it lies on go on
// (planners/route_cuts/core_reduction.hpp): to the right, upwards. To the left and downwards the neighbours know.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/route_trees/array_or_view.hpp"
#include "planners/route_trees/lattice_places.hpp"

namespace warren {

/// Words of row r of the lattice of tiles (a tile has 64): three each.
namespace mark_word {
inline constexpr std::size_t low = 0;   ///< lower bit of the direction; in the core: a chain goes on to the right
inline constexpr std::size_t high = 1;  ///< upper bit of the direction; in the core: a chain goes on upwards
inline constexpr std::size_t core = 2;
inline constexpr std::size_t count = 3;
}  // namespace mark_word

/// Looks at the words; any number of threads may.
class CellMarks {
 public:
  explicit CellMarks(const std::uint64_t* words) : words_(words) {}

  bool is_core(LatticePlace p) const { return bit(p, mark_word::core); }
  /// Of a cell outside the core.
  unsigned direction(LatticePlace p) const {
    const std::uint64_t* const row = row_of(p);
    const unsigned at = p % 64;
    return static_cast<unsigned>(row[mark_word::low] >> at & 1U) |
           static_cast<unsigned>(row[mark_word::high] >> at & 1U) << 1;
  }

  /// The words of a tile, row by row.
  const std::uint64_t* tile(std::uint32_t number) const {
    return words_ + std::size_t{number} * LatticePlaces::side * mark_word::count;
  }
  void prefetch_tile(std::uint32_t number) const {
    constexpr std::size_t line = 8;  // words
    const std::uint64_t* const words = tile(number);
    for (std::size_t i = 0; i < LatticePlaces::side * mark_word::count; i += line) __builtin_prefetch(words + i);
  }

 private:
  const std::uint64_t* row_of(LatticePlace p) const { return words_ + std::size_t{p / 64} * mark_word::count; }
  bool bit(LatticePlace p, std::size_t word) const { return (row_of(p)[word] >> p % 64 & 1U) != 0; }

  const std::uint64_t* words_;
};

/// The words for peeled bytes (planners/route_trees/peeling.hpp), after reduce_core(). Throws Stopped.
RawVector<std::uint64_t> mark_words(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places,
                                    const Execution& execution);

}  // namespace warren
