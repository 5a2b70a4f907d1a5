// SPDX-License-Identifier: BSD-3-Clause
// From coordinates to the cells of a PathScreen, along one axis, in units of 1/256 of a cell.
#pragma once

#include <cstdint>

namespace warren {

inline constexpr int cell_quantum_bits = 8;  ///< a cell has 2^8 units

/// A coordinate times `per_unit` is in units. A wall that reaches from a to b, in units, covers the cells of a -
/// before_first .. b - before_last, each cut to 0 .. end.
struct CellAxis {
  double per_unit, before_first, before_last, end;
};

/// The same from the steps of a packed wall, in whole numbers.
struct CellStepAxis {
  int shift;  ///< left: from steps to units
  std::int32_t before_first, before_last, end;
};

/// The next whole numbers below and above |u| < 2^51: adding 1.5 * 2^52 leaves no room for fractions.
[[gnu::always_inline]] inline double whole_below(double u) {
  constexpr double magic = 6755399441055744.0;
  const double near = (u + magic) - magic;
  return near - (near > u ? 1.0 : 0.0);
}
[[gnu::always_inline]] inline double whole_above(double u) {
  constexpr double magic = 6755399441055744.0;
  const double near = (u + magic) - magic;
  return near + (near < u ? 1.0 : 0.0);
}

}  // namespace warren
