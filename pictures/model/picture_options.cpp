// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/picture_options.hpp"

#include <fmt/format.h>

#include "core/base/enum_names.hpp"
#include "core/base/error.hpp"

namespace warren {
namespace {

struct ValueRange {
  double low, high;
  bool holds(double value) const { return value >= low && value <= high; }
};

}  // namespace

void PictureOptions::validate() const {
  constexpr ValueRange dpis{10.0, 2400.0};
  if (dpi && !dpis.holds(*dpi))
    throw UsageError(fmt::format("@dpi: from {} to {} (found: {})", dpis.low, dpis.high, *dpi));
  if (!size) return;
  const ValueRange sides = size->unit == LengthUnit::mm ? ValueRange{10.0, 5000.0} : ValueRange{40.0, 20'000.0};
  for (const double side : {size->width, size->height}) {
    if (sides.holds(side)) continue;
    throw UsageError(
        fmt::format("@size: a side is from {} to {} {} (found: {})", sides.low, sides.high, name_of(size->unit), side));
  }
}

}  // namespace warren
