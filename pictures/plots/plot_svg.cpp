// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "pictures/model/xml_text.hpp"
#include "pictures/plots/plot_axis.hpp"
#include "pictures/plots/plot_sheet.hpp"

namespace warren {
namespace {

constexpr double width = plot_size.x;
constexpr double height = plot_size.y;
constexpr Box widest_frame{{76.0, 40.0}, {540.0, 362.0}};  // of the data, y down
constexpr double narrowest = 300.0;
constexpr double legend_indent = 52.0;  // from the frame to the end of a name, letters apart

/// Draws one plot from back to front.
class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot)
      : plot_(plot), frame_(frame_beside_legend()), x_(axis(true)), y_(axis(false)) {}

  std::string text() {
    sheet_.begin(plot_.title, frame_, plot_.x_label, plot_.y_label, 18.0);
    grid();
    level();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) series(i);
    legend();
    return sheet_.take();
  }

 private:
  Box frame_beside_legend() const;
  PlotAxis axis(bool of_x) const;
  void grid();
  void level();
  void series(std::size_t i);
  void legend();
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
  constexpr double width_of_letter = 6.7;
  std::size_t longest = 0;
  for (const PlotSeries& s : plot_.series) longest = std::max(longest, s.name.size());
  const double right = width - legend_indent - width_of_letter * static_cast<double>(longest);
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
    sheet_.line({place_x(tick), frame_.min.y}, {place_x(tick), frame_.max.y}, faint_line);
    sheet_.label(place_x(tick), frame_.max.y + 17.0, "middle", short_text(tick));
  }
  for (const double tick : y_.ticks()) {
    sheet_.line({frame_.min.x, place_y(tick)}, {frame_.max.x, place_y(tick)}, faint_line);
    sheet_.label(frame_.min.x - 7.0, place_y(tick) + 4.0, "end", short_text(tick));
  }
  sheet_.box(frame_, frame_line);
}

void PlotDrawing::level() {
  if (!plot_.level || !y_.shows(*plot_.level)) return;
  const double y = place_y(*plot_.level);
  sheet_.line({frame_.min.x, y}, {frame_.max.x, y}, "stroke=\"#c1121f\" stroke-width=\"1.5\" stroke-dasharray=\"7 4\"");
  sheet_.label(frame_.min.x + 6.0, y - 6.0, "start", plot_.level_name, " style=\"fill:#c1121f\"");
}

void PlotDrawing::series(std::size_t i) {
  const PlotSeries& series = plot_.series[i];
  std::string path;
  std::string marks;
  for (std::size_t k = 0; k < series.points.size(); ++k) {
    const Vec2 p = series.points[k];
    if (!shows(p)) continue;
    const double x = place_x(p.x);
    if (k < series.spans.size()) {
      sheet_.line({x, place_y(series.spans[k].x)}, {x, place_y(series.spans[k].y)},
                  fmt::format("stroke=\"{}\"", series_color(i)));
    }
    const double y = place_y(p.y);
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
    fmt::format_to(std::back_inserter(marks), "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" data-tip=\"{}\"/>", x, y,
                   xml_text(fmt::format("{}: {} {}, {} {}", series.name, short_text(p.x), plot_.x_label,
                                        short_text(p.y), plot_.y_label)));
  }
  if (path.empty()) return;
  if (series.joined) {
    sheet_.add(fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}/>\n", path,
                           series_color(i), series.dashed ? " stroke-dasharray=\"3 4\"" : ""));
  }
  if (!series.dashed) sheet_.add(fmt::format("<g fill=\"{}\">{}</g>\n", series_color(i), marks));
}

void PlotDrawing::legend() {
  const double left = frame_.max.x + 16.0;
  double y = frame_.min.y + 10.0;
  for (std::size_t i = 0; i < plot_.series.size(); ++i, y += 20.0) {
    const PlotSeries& series = plot_.series[i];
    const std::string dash = series.dashed ? " stroke-dasharray=\"3 4\"" : "";
    if (series.joined)
      sheet_.line({left, y}, {left + 22.0, y},
                  fmt::format("stroke=\"{}\" stroke-width=\"1.8\"{}", series_color(i), dash));
    if (!series.dashed) {
      sheet_.add(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", left + 11.0, y,
                             series_color(i)));
    }
    sheet_.label(left + 28.0, y + 4.0, "start", series.name);
  }
}

}  // namespace

std::string plot_svg(const Plot& plot) { return PlotDrawing(plot).text(); }

std::string panels_svg(std::span<const std::string> panels, std::size_t columns) {
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      width * static_cast<double>(std::min(columns, panels.size())), height * static_cast<double>(rows));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    text += fmt::format("<g transform=\"translate({} {})\">\n", width * static_cast<double>(i % columns),
                        height * static_cast<double>(i / columns));
    text += panels[i] + "</g>\n";
  }
  return text + "</svg>\n";
}

std::string plots_svg(std::span<const Plot> plots, std::size_t columns) {
  std::vector<std::string> panels;
  for (const Plot& plot : plots) panels.push_back(plot_svg(plot));
  return panels_svg(panels, columns);
}

}  // namespace warren
