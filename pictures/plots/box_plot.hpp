// SPDX-License-Identifier: BSD-3-Clause
// A box plot: a row a box with its name before it and a remark behind it, one axis below. A box reaches from the first
// quartile to the third, its strong line is the median.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pictures/plots/plot_sheet.hpp"

namespace warren {

/// What a box plot shows of a sample.
struct BoxFigures {
  double low = 0.0;  ///< end of the lower whisker
  double q1 = 0.0;
  double median = 0.0;
  double q3 = 0.0;
  double high = 0.0;                  ///< end of the upper whisker
  std::vector<double> outliers = {};  ///< ascending; of those on one pixel one is drawn
};

struct PlottedBox {
  std::string name = {};
  std::string remark = {};                 ///< short: "18 of 20"
  std::optional<BoxFigures> figures = {};  ///< none: the row has name and remark alone
};

struct BoxPlot {
  std::string title = {};
  std::string label = {};                 ///< of the axis
  std::string remarks = {};               ///< above the remarks
  std::string (*text)(double) = nullptr;  ///< of a value where the pointer is told; nullptr: short_text()
  bool logarithmic = false;               ///< where all that is shown is > 0
  std::vector<PlottedBox> boxes = {};     ///< from above, at most most_boxes
};

/// More have no room for their names.
inline constexpr std::size_t most_boxes = 18;

PlotSheet sheet_of(const BoxPlot& plot);

}  // namespace warren
