// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/box_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pictures/model/letters.hpp"
#include "pictures/plots/plot_axis.hpp"

namespace warren {
namespace {

constexpr double most_name = 300.0;      // pixels
constexpr double room_of_remark = 96.0;  // beside the frame

/// Draws one plot from back to front.
class BoxDrawing {
 public:
  explicit BoxDrawing(const BoxPlot& plot) : plot_(plot), frame_(frame_between_words()), axis_(axis()) {}

  PlotSheet sheet() {
    sheet_.begin(plot_.title, frame_, plot_.label, "", 0.0);
    sheet_.label({frame_.max.x + 10.0, frame_.min.y - 8.0}, Anchor::start, plot_.remarks);
    for (const double tick : axis_.ticks()) {
      sheet_.line({{place(tick), frame_.min.y}, {place(tick), frame_.max.y}}, faint_line);
      sheet_.label({place(tick), frame_.max.y + 17.0}, Anchor::middle, tick_on_axis(tick, plot_.label));
    }
    sheet_.box(frame_, frame_line);
    for (std::size_t i = 0; i < plot_.boxes.size(); ++i) row(i);
    return std::move(sheet_);
  }

 private:
  Box frame_between_words() const;
  PlotAxis axis() const;
  void row(std::size_t i);
  void name(const std::string& text, double y);
  void box(const PlottedBox& box, double y, Rgb color);
  void outliers(const std::vector<double>& values, double y, Rgb color);
  double place(double value) const { return frame_.min.x + axis_.at(value) * frame_.width(); }
  double row_height() const { return frame_.height() / static_cast<double>(plot_.boxes.size()); }

  const BoxPlot& plot_;
  Box frame_;  // of the boxes
  PlotAxis axis_;
  PlotSheet sheet_;
};

Box BoxDrawing::frame_between_words() const {
  constexpr double least = 60.0;
  constexpr double margin = 20.0;
  double widest = least;
  for (const PlottedBox& box : plot_.boxes) widest = std::max(widest, text_width(box.name, plot_text_size));
  return {{std::min(widest, most_name) + margin, 48.0}, {plot_size.x - room_of_remark, 366.0}};
}

PlotAxis BoxDrawing::axis() const {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto include = [&](double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const PlottedBox& box : plot_.boxes) {
    if (!box.figures) continue;
    include(box.figures->low), include(box.figures->high);
    for (const double value : box.figures->outliers) include(value);
  }
  return axis_around(low, high, plot_.logarithmic && low > 0.0);
}

void BoxDrawing::row(std::size_t i) {
  const PlottedBox& one = plot_.boxes[i];
  const double y = frame_.min.y + (static_cast<double>(i) + 0.5) * row_height();
  name(one.name, y);
  sheet_.label({frame_.max.x + 10.0, y + 4.0}, Anchor::start, one.remark);
  if (one.figures) box(one, y, series_color(i));
}

/// In two lines where it needs them and the row has them, else without its middle: names often differ at their ends.
void BoxDrawing::name(const std::string& text, double y) {
  constexpr double line_height = 14.0;
  std::vector<std::string> lines = wrapped_text(text, plot_text_size, most_name);
  const bool has_room = static_cast<double>(lines.size()) * line_height <= row_height();
  const bool is_cut = std::any_of(lines.begin(), lines.end(), [](const auto& line) { return line.ends_with("..."); });
  if (lines.size() > 2 || !has_room || is_cut) lines = {fitting_ends(text, plot_text_size, most_name)};
  const double first = y + 4.0 - 0.5 * line_height * static_cast<double>(lines.size() - 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    sheet_.label({frame_.min.x - 8.0, first + line_height * static_cast<double>(i)}, Anchor::end, lines[i]);
  }
}

void BoxDrawing::box(const PlottedBox& box, double y, Rgb color) {
  constexpr double thickest = 26.0;
  constexpr unsigned pale = 25;
  const BoxFigures& f = *box.figures;
  const double half = 0.5 * std::min(0.6 * row_height(), thickest);
  const Pen line{.stroke = color, .width = 1.5};
  const auto upright = [&](double value, double height, const Pen& pen) {
    sheet_.line({{place(value), y - height}, {place(value), y + height}}, pen);
  };
  sheet_.line({{place(f.low), y}, {place(f.q1), y}}, line);
  sheet_.line({{place(f.q3), y}, {place(f.high), y}}, line);
  upright(f.low, 0.5 * half, line);
  upright(f.high, 0.5 * half, line);
  const auto said = [&](double value) { return plot_.text != nullptr ? plot_.text(value) : short_text(value); };
  sheet_.box({{place(f.q1), y - half}, {place(f.q3), y + half}},
             {.stroke = color, .width = 1.5, .fill = mixed(color, colors::paper, pale)},
             fmt::format("{}: median {}, half of the runs from {} to {}; {} {}", box.name, said(f.median), said(f.q1),
                         said(f.q3), box.remark, plot_.remarks));
  upright(f.median, half, {.stroke = color, .width = 3.0});
  outliers(f.outliers, y, color);
}

/// One of those that lie on the same half pixel.
void BoxDrawing::outliers(const std::vector<double>& values, double y, Rgb color) {
  double last = -1.0;
  for (const double value : values) {
    const double x = 0.5 * std::round(2.0 * place(value));
    if (x == last) continue;
    last = x;
    sheet_.disc({x, y}, 2.5, {.stroke = color});
  }
}

}  // namespace

PlotSheet sheet_of(const BoxPlot& plot) { return BoxDrawing(plot).sheet(); }

}  // namespace warren
