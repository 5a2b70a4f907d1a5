// SPDX-License-Identifier: BSD-3-Clause
// Real numbers as whole ones, for formats that have no others: multiples of a power of two, the finest that lets the
// largest number stay below 2^31, which is what most readers' integers hold. A power of two, because scaling by it is
// exact: the only error is that of rounding, at most half a unit.
#pragma once

#include <cstdint>
#include <string>

namespace warren {

class BinaryUnit {
 public:
  /// For numbers of magnitude 0 .. `largest`, which is finite. Without any but 0 the unit is 1.
  explicit BinaryUnit(double largest);

  /// The nearest multiple, halves away from zero.
  std::int64_t multiple(double number) const;
  /// "2^-20"
  std::string name() const;

 private:
  int bits_ = 0;  ///< the unit is 2^-bits_
};

}  // namespace warren
