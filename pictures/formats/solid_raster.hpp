// SPDX-License-Identifier: BSD-3-Clause
// Solids in perspective, as pixels: whatever is nearest to the eye is seen, however the solids lie among each other.
#pragma once

#include <cstddef>

#include "parallel/execution.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/model/solids.hpp"

namespace warren {

/// Those of the parts that are shown. O(solids + pixels that each may cover). Throws Stopped.
Image draw_solids(const SolidView& view, Parts parts, std::size_t width, std::size_t height,
                  const Execution& execution);

}  // namespace warren
