// SPDX-License-Identifier: BSD-3-Clause
// What all plots are written on: lines, areas and words in the order in which they are drawn, on a sheet of plot_size.
// Places are pixels, y down. A sheet is an <svg> element for pages of HTML, or is drawn on any surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "pictures/formats/surface.hpp"

namespace warren {

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

}  // namespace warren
