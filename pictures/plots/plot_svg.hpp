// SPDX-License-Identifier: BSD-3-Clause
// A plot of a few series as one <svg> element: axes with round ticks, linear or logarithmic, legend at the right. Needs
// nothing but what is in it, so it stands alone in a file and inside an HTML page.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

struct PlotSeries {
  std::string name;          ///< in the legend
  std::vector<Vec2> points;  ///< in the order in which the line joins them; on a logarithmic axis only those > 0 show
  bool joined = true;        ///< by a line
  bool dashed = false;       ///< the line alone, without markers: what is expected, not measured
  std::vector<Vec2> spans = {};  ///< of each point a low and a high y, which a bar joins; empty: no bars
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

inline constexpr Vec2 plot_size{760.0, 420.0};

/// The element with its namespace, of that size.
std::string plot_svg(const Plot& plot);

/// Elements of that size, row by row, as one element.
std::string panels_svg(std::span<const std::string> panels, std::size_t columns);
std::string plots_svg(std::span<const Plot> plots, std::size_t columns);

}  // namespace warren
