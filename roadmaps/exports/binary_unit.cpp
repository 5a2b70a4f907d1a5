// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/exports/binary_unit.hpp"

#include <cmath>
#include <limits>

namespace warren {

BinaryUnit::BinaryUnit(double largest) {
  if (largest == 0) return;
  bits_ = 30 - std::ilogb(largest);
  if (multiple(largest) > std::numeric_limits<std::int32_t>::max()) --bits_;  // rounded up to 2^31
}

std::int64_t BinaryUnit::multiple(double number) const { return std::llround(std::ldexp(number, bits_)); }

std::string BinaryUnit::name() const { return "2^" + std::to_string(-bits_); }

}  // namespace warren
