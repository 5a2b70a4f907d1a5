// SPDX-License-Identifier: BSD-3-Clause
#include "verify/exact/dyadic.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/whole.hpp"

namespace warren {
namespace {

using Limbs = std::vector<std::uint32_t>;

void trim(Limbs& limbs) {
  while (!limbs.empty() && limbs.back() == 0) limbs.pop_back();
}

int compare(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (std::size_t i = a.size(); i-- > 0;) {
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  }
  return 0;
}

Limbs sum(Limbs a, const Limbs& b) {
  a.resize(std::max(a.size(), b.size()) + 1);
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    carry += std::uint64_t{a[i]} + (i < b.size() ? b[i] : 0);
    a[i] = as_whole<std::uint32_t>(carry);
    carry >>= 32;
  }
  return a;
}

/// a - b, where a >= b.
Limbs difference(Limbs a, const Limbs& b) {
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::uint64_t taken = borrow + (i < b.size() ? b[i] : 0);
    borrow = taken > a[i] ? 1 : 0;
    a[i] = as_whole<std::uint32_t>(a[i] - taken);
  }
  return a;
}

Limbs product(const Limbs& a, const Limbs& b) {
  Limbs result(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.size(); ++j) {
      carry += std::uint64_t{a[i]} * b[j] + result[i + j];
      result[i + j] = as_whole<std::uint32_t>(carry);
      carry >>= 32;
    }
    result[i + b.size()] = as_whole<std::uint32_t>(carry);
  }
  return result;
}

}  // namespace

Dyadic::Dyadic(int sign, int exponent, Limbs limbs) : sign_(sign), exponent_(exponent), limbs_(std::move(limbs)) {
  trim(limbs_);
  if (limbs_.empty()) sign_ = 0;
}

Dyadic::Dyadic(double value) {
  if (value == 0.0) return;
  int binary_exponent = 0;
  const double fraction = std::frexp(std::abs(value), &binary_exponent);
  const auto mantissa = bounded_whole<std::uint64_t>(std::ldexp(fraction, 53));
  binary_exponent -= 53;
  const int shift = ((binary_exponent % 32) + 32) % 32;
  const std::uint64_t low = (mantissa & 0xffffffffU) << shift;
  const std::uint64_t high = ((mantissa >> 32) << shift) + (low >> 32);
  *this = Dyadic(value > 0.0 ? 1 : -1, (binary_exponent - shift) / 32,
                 {as_whole<std::uint32_t>(low), as_whole<std::uint32_t>(high), as_whole<std::uint32_t>(high >> 32)});
}

double Dyadic::rounded() const {
  const std::size_t parts = std::min<std::size_t>(limbs_.size(), 3);  // 65 bits or more, where there are as many
  double value = 0.0;
  for (std::size_t i = 1; i <= parts; ++i) value = 0x1p32 * value + limbs_[limbs_.size() - i];
  return sign_ * std::ldexp(value, 32 * (exponent_ + as_whole<int>(limbs_.size() - parts)));
}

Dyadic::Limbs Dyadic::limbs_from(int exponent) const {
  Limbs limbs(as_whole<std::size_t>(exponent_ - exponent));
  limbs.insert(limbs.end(), limbs_.begin(), limbs_.end());
  return limbs;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  if (a.sign_ == 0) return b;
  if (b.sign_ == 0) return a;
  const int exponent = std::min(a.exponent_, b.exponent_);
  const Limbs left = a.limbs_from(exponent);
  const Limbs right = b.limbs_from(exponent);
  if (a.sign_ == b.sign_) return {a.sign_, exponent, sum(left, right)};
  if (compare(left, right) >= 0) return {a.sign_, exponent, difference(left, right)};
  return {b.sign_, exponent, difference(right, left)};
}

Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + Dyadic(-b.sign_, b.exponent_, b.limbs_); }

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  return {a.sign_ * b.sign_, a.exponent_ + b.exponent_, product(a.limbs_, b.limbs_)};
}

}  // namespace warren
