// SPDX-License-Identifier: BSD-3-Clause
// A table of numbers as coloured cells, each with its number in it, as large as a plot.
// The colours (viridis) rise in lightness, so they are told apart by all eyes and in grey.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pictures/plots/plot_sheet.hpp"

namespace warren::studies {

struct HeatMap {
  struct Cell {
    std::optional<double> value = {};  ///< finite; none: an empty cell
    std::string text = {};             ///< what is written in it
  };
  std::string title = {};
  std::string x_label = {};
  std::string y_label = {};
  std::vector<std::string> columns = {};  ///< from left to right, at least one
  std::vector<std::string> rows = {};     ///< from below, at least one
  std::optional<double> low = {};         ///< where the colours begin; none: at the least value
  std::optional<double> high = {};        ///< where they end; none: at the largest
  bool less_is_better = false;            ///< the colours the other way around: bright is good
  std::vector<Cell> cells = {};           ///< row by row, columns.size() * rows.size() of them
};

PlotSheet sheet_of(const HeatMap& map);

}  // namespace warren::studies
