// SPDX-License-Identifier: BSD-3-Clause
// A plot of a few series: axes with round ticks, linear or logarithmic, legend at the right.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "pictures/plots/plot_sheet.hpp"

namespace warren {

struct PlotSeries {
  std::string name;          ///< in the legend
  std::vector<Vec2> points;  ///< in the order in which the line joins them; on a logarithmic axis only those > 0 show
  bool joined = true;        ///< by a line
  bool dashed = false;       ///< the line alone, without markers: what is expected, not measured
  std::vector<Vec2> spans = {};           ///< of each point a low and a high y, which a bar joins; empty: no bars
  std::optional<std::size_t> color = {};  ///< as series_color() has it; none: its place among the series
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_x = false;
  bool log_y = false;
  bool from_zero = false;  ///< a linear y axis starts at 0
  bool whole_x = false;    ///< a linear x axis counts something: ticks at whole numbers alone
  std::vector<PlotSeries> series;
  std::optional<double> level = {};  ///< a horizontal line
  std::string level_name = {};
};

PlotSheet sheet_of(const Plot& plot);

}  // namespace warren
