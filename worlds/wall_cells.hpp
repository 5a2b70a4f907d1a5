// SPDX-License-Identifier: BSD-3-Clause
// The cells of a lattice that walls cover once they are grown, many walls at once: the vector part of
// worlds/path_screen. Compilers turn its loops into the vector code of several instruction sets; the fastest that the
// processor has is chosen once. All give the same numbers: nothing here rounds differently.
//
// A coordinate is multiplied by a power of two (exact), then rounded down or up to a whole number by adding and
// subtracting 1.5 * 2^52 (exact below 2^51, monotone above); whole numbers are subtracted (exact below 2^53). About 2
// ns a wall with SSE2, 1 with AVX2 (bench/verify_bench).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/types.hpp"
#include "core/wall_set.hpp"

namespace warren {

/// x rounded down (up) to a whole number; exact below 2^51, and never decreasing.
[[gnu::always_inline]] inline double whole_below(double x) {
  constexpr double no_room_for_fractions = 6755399441055744.0;  // 1.5 * 2^52
  const double near = (x + no_room_for_fractions) - no_room_for_fractions;
  return near - (near > x ? 1.0 : 0.0);
}
[[gnu::always_inline]] inline double whole_above(double x) { return -whole_below(-x); }

/// From a coordinate to its cell, by way of 2^unit_bits units a cell.
struct CellAxis {
  static constexpr int unit_bits = 8;
  double per_unit;      ///< units a coordinate unit: a power of two
  double before_first;  ///< the unit of cell 0's beginning, plus the units by which walls are grown
  double before_last;   ///< the same minus that, plus 1
  double end;           ///< the last unit of the last cell
};

/// The cells of one block of walls; those outside the lattice count as its first or last ones.
struct WallCells {
  static constexpr std::size_t size = 128;
  alignas(64) std::array<std::int32_t, size> column_first, column_last, row_first, row_last;
};

/// The box of all walls seen, in as many parts as make it fast. T: float or double, as the walls hold them.
template <class T>
struct BoxLanes {
  static constexpr std::size_t count = 8;
  std::array<T, count> x_min, y_min, x_max, y_max;

  BoxLanes() {
    x_min.fill(std::numeric_limits<T>::infinity());
    y_min = x_min;
    x_max.fill(-std::numeric_limits<T>::infinity());
    y_max = x_max;
  }
  Box box() const;
};

/// walls: WallCells::size of them.
template <class T>
using FindWallCells = void (*)(const WallOf<T>* walls, const CellAxis& x, const CellAxis& y, WallCells& cells,
                               BoxLanes<T>& lanes);

/// The same work for one instruction set.
struct WallCellWork {
  const char* instruction_set;
  FindWallCells<float> find_floats;
  FindWallCells<double> find_doubles;

  void find(const FloatWall* walls, const CellAxis& x, const CellAxis& y, WallCells& cells, BoxLanes<float>& l) const {
    find_floats(walls, x, y, cells, l);
  }
  void find(const DoubleWall* walls, const CellAxis& x, const CellAxis& y, WallCells& cells,
            BoxLanes<double>& l) const {
    find_doubles(walls, x, y, cells, l);
  }
};

/// Those that this processor can run, the fastest last.
struct WallCellVariants {
  std::array<WallCellWork, 3> list;
  std::size_t count = 0;
};
WallCellVariants wall_cell_variants();

/// The fastest of them.
const WallCellWork& wall_cell_work();

}  // namespace warren
