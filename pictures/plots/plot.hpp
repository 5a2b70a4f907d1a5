// SPDX-License-Identifier: BSD-3-Clause
// Plots: of a few series, of boxes and of tables, the sheets that they are drawn on, and pages of such sheets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "pictures/formats/surface.hpp"

namespace warren {

// What all plots are written on: lines, areas and words in the order in which they are drawn, on a sheet of plot_size.
// Places are pixels, y down. A sheet is an <svg> element for pages of HTML, or is drawn on any surface.

inline constexpr Vec2 plot_size{760.0, 420.0};
inline constexpr double plot_text_size = 12.0;

/// A line through its points, a box between two corners, or a disc.
struct PlotShape {
  enum class Kind : std::uint8_t { line, box, disc };
  Kind kind = Kind::line;
  std::vector<Vec2> points = {};  ///< of a disc its middle
  Pen pen = {};                   ///< of a line with a fill: the area between its ends
  double radius = 0.0;            ///< of a disc
  Vec2 dash = {};                 ///< of a line: how long it is drawn and left out in turn; 0: drawn wholly
  std::string tip = {};           ///< what a page tells of it at the pointer; empty: nothing
};

struct PlotWords {
  PlacedText text;
  Rgb color = colors::text;
};

class PlotSheet {
 public:
  /// The title above the frame, the axes' names below it and, unless empty, upright at `y_label_at`.
  void begin(const std::string& title, const Box& frame, const std::string& x_label, const std::string& y_label,
             double y_label_at);
  void label(Vec2 at, Anchor anchor, std::string text, Rgb color = colors::text) {
    add({at, std::move(text), plot_text_size, anchor}, color);
  }
  void line(std::vector<Vec2> points, const Pen& pen, Vec2 dash = {}) {
    parts_.emplace_back(PlotShape{.points = std::move(points), .pen = pen, .dash = dash});
  }
  void box(const Box& box, const Pen& pen, std::string tip = {}) {
    parts_.emplace_back(
        PlotShape{.kind = PlotShape::Kind::box, .points = {box.min, box.max}, .pen = pen, .tip = std::move(tip)});
  }
  void disc(Vec2 at, double radius, const Pen& pen, std::string tip = {}) {
    parts_.emplace_back(
        PlotShape{.kind = PlotShape::Kind::disc, .points = {at}, .pen = pen, .radius = radius, .tip = std::move(tip)});
  }

  /// On dark pages, too: they mean values.
  void keep_colors() { keeps_colors_ = true; }

  const std::string& title() const { return title_; }
  /// One element with its namespace; it needs nothing but what is in it.
  std::string svg() const;
  /// With the upper left corner at a point of the page. Throws Stopped.
  void draw(Surface& surface, Vec2 at, const Execution& execution) const;

 private:
  void add(PlacedText text, Rgb color) { parts_.emplace_back(PlotWords{std::move(text), color}); }

  std::string title_;
  bool keeps_colors_ = false;
  std::vector<std::variant<PlotShape, PlotWords>> parts_;
};

/// Of the i-th series; after the ninth they come again.
inline Rgb series_color(std::size_t i) { return colors::series[i % colors::series.size()]; }

inline constexpr Pen faint_line{.stroke = Rgb{226, 226, 226}};
inline constexpr Pen frame_line{.stroke = colors::frame};

// Plots side by side on one page, as a file: SVG, PNG or PDF, all drawn from the same sheets.

/// The endings that PlotsPage::write knows.
inline constexpr std::string_view plot_endings = ".svg .png .pdf";

struct PlotsPage {
  std::vector<PlotSheet> sheets = {};
  std::size_t columns = 1;  ///< at least one; the sheets fill row by row

  /// As large as its sheets need; that of one where there is none.
  Vec2 size() const;
  Vec2 place_of(std::size_t sheet) const;  ///< its upper left corner
  std::string svg() const;
  /// By the file's ending: .png, .pdf, and SVG for all others. A PNG has two pixels for one of the page, fewer where it
  /// would be wider or higher than 8192. Throws WriteError, Stopped; UsageError for a PDF where can_write_pdf() is
  /// false.
  void write(const std::string& file, const std::string& title, const Execution& execution) const;
};

// A plot of a few series: axes with round ticks, linear or logarithmic, legend at the right.

struct PlotSeries {
  std::string name;               ///< in the legend
  std::vector<Vec2> points = {};  ///< in the order in which the line joins them; a logarithmic axis shows those > 0
  bool joined = true;             ///< by a line
  bool dashed = false;            ///< the line alone, without markers: what is expected, not measured
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
  std::vector<PlotSeries> series = {};
  std::optional<double> level = {};  ///< a horizontal line
  std::string level_name = {};
  std::optional<double> all_y = {};  ///< so far the y axis reaches where nothing is above 0
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
