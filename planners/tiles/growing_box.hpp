// SPDX-License-Identifier: BSD-3-Clause
// The box of all walls, found while they are gone through for another reason: four coordinates at once.
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "planners/tiles/wall_steps.hpp"

namespace warren {

/// The box of the walls that it has been shown.
class GrowingBox {
 public:
  void include(const PackedWall& w) { include(detail::WallSteps(w).numbers() * (1.0F / narrow_unit)); }
  void include(const FloatWall& w) {
    detail::Four ends;
    std::memcpy(&ends, &w, sizeof ends);
    include(ends);
  }
  void include(const DoubleWall& w) { doubles_.include(box_of(w.segment())); }
  Box box() const {
    Box box = doubles_;
    box.include({{std::min(low_[0], low_[2]), std::min(low_[1], low_[3])},
                 {std::max(high_[0], high_[2]), std::max(high_[1], high_[3])}});
    return box;
  }

 private:
  void include(detail::Four ends) {
    low_ = low_ < ends ? low_ : ends;
    high_ = high_ > ends ? high_ : ends;
  }

  detail::Four low_ = detail::Four{} + std::numeric_limits<float>::infinity();
  detail::Four high_ = detail::Four{} - std::numeric_limits<float>::infinity();
  Box doubles_;
};

}  // namespace warren
