// SPDX-License-Identifier: BSD-3-Clause
// Three bits a cell, laid out so that a tile of 64 x 64 cells is 24 lines of cache: is the cell in the core, and if it
// isn't, which way its root is; if it is, whether it is a gate, a cell that the search of the core stops at. Gates are
// numbered in the order of their places by counts of the bits before them.
#pragma once

#include <bit>
#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/route_trees/array_or_view.hpp"
#include "planners/route_trees/lattice_places.hpp"

namespace warren {

/// Words of row r of the lattice of tiles (a tile has 64): three each.
namespace mark_word {
inline constexpr std::size_t low = 0;   ///< lower bit of the direction; in the core: is a gate
inline constexpr std::size_t high = 1;  ///< upper bit of the direction; in the core: 0
inline constexpr std::size_t core = 2;
inline constexpr std::size_t count = 3;
}  // namespace mark_word

/// Looks at the words; any number of threads may.
class CellMarks {
 public:
  explicit CellMarks(const std::uint64_t* words) : words_(words) {}

  bool is_core(LatticePlace p) const { return bit(p, mark_word::core); }
  bool is_gate(LatticePlace p) const { return is_core(p) && bit(p, mark_word::low); }
  /// Of a cell outside the core.
  unsigned direction(LatticePlace p) const {
    const std::uint64_t* const row = row_of(p);
    const unsigned at = p % 64;
    return static_cast<unsigned>(row[mark_word::low] >> at & 1U) |
           static_cast<unsigned>(row[mark_word::high] >> at & 1U) << 1;
  }
  /// Gates in the row of the tile before the place.
  std::uint32_t gates_before(LatticePlace p) const {
    const std::uint64_t* const row = row_of(p);
    const std::uint64_t below = (std::uint64_t{1} << p % 64) - 1;
    return static_cast<std::uint32_t>(std::popcount(row[mark_word::low] & row[mark_word::core] & below));
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

/// The words for peeled bytes (planners/route_trees/peeling.hpp); no gates yet. Throws Stopped.
RawVector<std::uint64_t> mark_words(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places,
                                    const Execution& execution);

}  // namespace warren
