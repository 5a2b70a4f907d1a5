// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pictures/model/letters.hpp"
#include "pictures/plots/plot_axis.hpp"

namespace warren {
namespace {

constexpr Box widest_frame{{76.0, 40.0}, {540.0, 362.0}};  // of the data, y down
constexpr double narrowest = 300.0;
constexpr double legend_indent = 44.0;  // from the frame to a name
constexpr double margin_of_name = 8.0;  // at its end
constexpr double mark_radius = 3.5;
constexpr Vec2 dashed_line{3.0, 4.0};

/// Draws one plot from back to front.
class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot)
      : plot_(plot), frame_(frame_beside_legend()), x_(axis(true)), y_(axis(false)) {}

  PlotSheet sheet() {
    sheet_.begin(plot_.title, frame_, plot_.x_label, plot_.y_label, 18.0);
    grid();
    if (plot_.level && y_.shows(*plot_.level)) level(frame_.min.x, frame_.max.x, place_y(*plot_.level));
    for (std::size_t i = 0; i < plot_.series.size(); ++i) series(i);
    legend();
    return std::move(sheet_);
  }

 private:
  Box frame_beside_legend() const;
  PlotAxis axis(bool of_x) const;
  void grid();
  void level(double from, double to, double y);
  void series(std::size_t i);
  void legend();
  Rgb color_of(std::size_t i) const { return series_color(plot_.series[i].color.value_or(i)); }
  // Of series that coincide both are seen: every second one is thin, its marks are rings.
  Pen line_of(std::size_t i) const { return {.stroke = color_of(i), .width = i % 2 == 0 ? 2.6 : 1.2}; }
  void mark(std::size_t i, Vec2 at, const std::string& tip) {
    if (i % 2 == 0) return sheet_.disc(at, mark_radius, {.fill = color_of(i)}, tip);
    sheet_.disc(at, mark_radius + 1.0, {.stroke = color_of(i), .width = 1.2}, tip);
  }
  bool shows(Vec2 p) const { return x_.shows(p.x) && y_.shows(p.y); }
  double place_x(double value) const { return frame_.min.x + x_.at(value) * frame_.width(); }
  double place_y(double value) const { return frame_.max.y - y_.at(value) * frame_.height(); }

  const Plot& plot_;
  Box frame_;  // of the data
  PlotAxis x_;
  PlotAxis y_;
  PlotSheet sheet_;
};

/// As wide as the names of the series leave it.
Box PlotDrawing::frame_beside_legend() const {
  double widest = 0.0;
  for (const PlotSeries& s : plot_.series) widest = std::max(widest, text_width(s.name, plot_text_size));
  if (plot_.level) widest = std::max(widest, text_width(plot_.level_name, plot_text_size));
  const double right = plot_size.x - legend_indent - widest - margin_of_name;
  Box frame = widest_frame;
  frame.max.x = std::clamp(right, frame.min.x + narrowest, frame.max.x);
  return frame;
}

/// Wide enough for all that is shown and some room; never empty.
PlotAxis PlotDrawing::axis(bool of_x) const {
  const bool logarithmic = of_x ? plot_.log_x : plot_.log_y;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto include = [&](double value) {
    if (!std::isfinite(value) || (logarithmic && value <= 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const PlotSeries& s : plot_.series) {
    for (const Vec2 p : s.points) include(of_x ? p.x : p.y);
    for (const Vec2 span : s.spans) {
      if (!of_x) include(span.x), include(span.y);
    }
  }
  if (!of_x && plot_.level) include(*plot_.level);
  return axis_around(low, high, logarithmic, !of_x && plot_.from_zero, of_x && plot_.whole_x);
}

void PlotDrawing::grid() {
  for (const double tick : x_.ticks()) {
    sheet_.line({{place_x(tick), frame_.min.y}, {place_x(tick), frame_.max.y}}, faint_line);
    sheet_.label({place_x(tick), frame_.max.y + 17.0}, Anchor::middle, tick_on_axis(tick, plot_.x_label));
  }
  for (const double tick : y_.ticks()) {
    sheet_.line({{frame_.min.x, place_y(tick)}, {frame_.max.x, place_y(tick)}}, faint_line);
    sheet_.label({frame_.min.x - 7.0, place_y(tick) + 4.0}, Anchor::end, tick_on_axis(tick, plot_.y_label));
  }
  sheet_.box(frame_, frame_line);
}

void PlotDrawing::level(double from, double to, double y) {
  constexpr Rgb red{193, 18, 31};
  sheet_.line({{from, y}, {to, y}}, {.stroke = red, .width = 1.5}, {7.0, 4.0});
}

void PlotDrawing::series(std::size_t i) {
  const PlotSeries& series = plot_.series[i];
  std::vector<Vec2> places;
  std::vector<std::string> tips;
  for (std::size_t k = 0; k < series.points.size(); ++k) {
    const Vec2 p = series.points[k];
    if (!shows(p)) continue;
    places.push_back({place_x(p.x), place_y(p.y)});
    tips.push_back(
        fmt::format("{}: {} {}, {} {}", series.name, short_text(p.x), plot_.x_label, short_text(p.y), plot_.y_label));
    if (k >= series.spans.size()) continue;
    sheet_.line({{places.back().x, place_y(series.spans[k].x)}, {places.back().x, place_y(series.spans[k].y)}},
                {.stroke = color_of(i)});
  }
  if (places.empty()) return;
  if (series.joined) sheet_.line(places, line_of(i), series.dashed ? dashed_line : Vec2{});
  if (series.dashed) return;
  for (std::size_t k = 0; k < places.size(); ++k) mark(i, places[k], tips[k]);
}

void PlotDrawing::legend() {
  const double left = frame_.max.x + 16.0;
  const double at = frame_.max.x + legend_indent;
  double y = frame_.min.y + 10.0;
  for (std::size_t i = 0; i < plot_.series.size(); ++i, y += 20.0) {
    const PlotSeries& series = plot_.series[i];
    if (series.joined) sheet_.line({{left, y}, {left + 22.0, y}}, line_of(i), series.dashed ? dashed_line : Vec2{});
    if (!series.dashed) mark(i, {left + 11.0, y}, {});
    sheet_.label({at, y + 4.0}, Anchor::start,
                 fitting_text(series.name, plot_text_size, plot_size.x - at - margin_of_name));
  }
  if (!plot_.level) return;
  level(left, left + 22.0, y);
  sheet_.label({at, y + 4.0}, Anchor::start,
               fitting_text(plot_.level_name, plot_text_size, plot_size.x - at - margin_of_name));
}

}  // namespace

PlotSheet sheet_of(const Plot& plot) { return PlotDrawing(plot).sheet(); }

}  // namespace warren
