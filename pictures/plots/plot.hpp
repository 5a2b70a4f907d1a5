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
  /// The line keeps its height until the next point, and has no markers; spans are a band around it. What is infinite
  /// is above the frame.
  bool steps = false;
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

// A box plot: a row a box with its name before it and a remark behind it, one axis below. A box reaches from the first
// quartile to the third, its strong line is the median.

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

// A table of numbers as coloured cells, each with its number in it, as large as a plot.
// The colours (viridis) rise in lightness, so they are told apart by all eyes and in grey.

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

}  // namespace warren
