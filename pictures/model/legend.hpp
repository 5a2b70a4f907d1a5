// SPDX-License-Identifier: BSD-3-Clause
// What a legend says of a picture: an entry for everything that is really drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pictures/model/colors.hpp"
#include "pictures/model/marks.hpp"
#include "pictures/model/picture.hpp"

namespace warren {

struct LegendEntry {
  std::string label;
  std::vector<Rgb> lines = {};         ///< pieces of a line, each in one colour
  double width = 0.0;                  ///< of the line, pixels
  std::optional<Rgb> fill = {};        ///< of an area, outlined by the first of `lines`
  std::optional<Rgb> dot = {};         ///< on the line
  std::optional<MarkShape> mark = {};  ///< alone, filled with `fill`
};

/// Throws Stopped.
std::vector<LegendEntry> legend_of(const Picture& picture, Parts parts, const Execution& execution);

}  // namespace warren
