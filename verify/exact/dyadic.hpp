// SPDX-License-Identifier: BSD-3-Clause
// Numbers m * 2^e with m of any size: sums, differences and products of doubles without rounding. About a microsecond
// an operation, so it only decides what a filter in doubles leaves open. Deliberately plain (schoolbook arithmetic on
// 32-bit limbs): it is the last word of the verification.
#pragma once

#include <cstdint>
#include <vector>

namespace warren {

class Dyadic {
 public:
  Dyadic() = default;
  /// Exactly `value`, which is finite.
  explicit Dyadic(double value);

  /// +1, 0 or -1.
  int sign() const { return sign_; }
  /// As a double, to some roundings; within the range of doubles.
  double rounded() const;

  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

 private:
  using Limbs = std::vector<std::uint32_t>;
  Dyadic(int sign, int exponent, Limbs limbs);
  Limbs limbs_from(int exponent) const;

  // value = sign * (limbs_[0] + limbs_[1] * 2^32 + ...) * 2^(32 * exponent_); the highest limb is not zero
  int sign_ = 0;
  int exponent_ = 0;
  Limbs limbs_;
};

}  // namespace warren
