// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "pictures/model/colors.hpp"
#include "pictures/model/ticks.hpp"
#include "pictures/model/xml_text.hpp"

namespace warren {
namespace {

constexpr double width = plot_size.x;
constexpr double height = plot_size.y;
constexpr Box widest_frame{{76.0, 40.0}, {540.0, 362.0}};  // of the data, y down
constexpr double narrowest = 300.0;
constexpr double legend_indent = 52.0;  // from the frame to the end of a name, letters apart
/// One axis: values to 0 … 1.
class Axis {
 public:
  Axis(double low, double high, bool logarithmic, bool whole)
      : logarithmic_(logarithmic), whole_(whole), low_(scaled(low)), high_(scaled(high)) {}
  double at(double value) const { return (scaled(value) - low_) / (high_ - low_); }
  bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0.0); }
  std::vector<double> ticks() const;

 private:
  double scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }
  std::vector<double> round_ticks() const;

  bool logarithmic_;
  bool whole_;
  double low_;
  double high_;
};

/// Powers of ten, with 2 and 5 between them where there are few.
std::vector<double> Axis::ticks() const {
  if (!logarithmic_) return round_ticks();
  std::vector<double> ticks;
  const bool few = high_ - low_ < 2.5;
  for (int decade = static_cast<int>(std::floor(low_)); decade <= static_cast<int>(std::ceil(high_)); ++decade) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10.0, decade);
      const bool inside = scaled(value) > low_ - 1e-9 && scaled(value) < high_ + 1e-9;
      if (inside && (few || digit == 1.0)) ticks.push_back(value);
    }
  }
  return ticks;
}

/// Five or so of them.
std::vector<double> Axis::round_ticks() const {
  const double step = tick_step(high_ - low_, 5.0);
  return ticks_between(low_, high_, whole_ ? std::max(1.0, step) : step);
}

std::string short_text(double value) {
  constexpr std::array<std::string_view, 4> units{"", "k", "M", "G"};
  std::size_t unit = 0;
  for (; std::abs(value) >= 1000.0 && unit + 1 < units.size(); ++unit) value /= 1000.0;
  std::string text = fmt::format("{:.4g}{}", value, units[unit]);
  if (const std::size_t at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return text;
}

/// Draws one plot from back to front.
class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot)
      : plot_(plot), frame_(frame_beside_legend()), x_(axis(true)), y_(axis(false)) {}

  std::string text() {
    begin();
    grid();
    level();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) series(i);
    legend();
    return text_ + "</svg>\n";
  }

 private:
  Box frame_beside_legend() const;
  Axis axis(bool of_x) const;
  void begin();
  void grid();
  void level();
  void series(std::size_t i);
  void legend();
  void label(double x, double y, std::string_view anchor, std::string_view text, std::string_view more = "") {
    fmt::format_to(std::back_inserter(text_), "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                   anchor, more, xml_text(text));
  }
  void line(double x1, double y1, double x2, double y2, std::string_view style) {
    fmt::format_to(std::back_inserter(text_), "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", x1, y1, x2, y2, style);
  }
  bool shows(Vec2 p) const { return x_.shows(p.x) && y_.shows(p.y); }
  double place_x(double value) const { return frame_.min.x + x_.at(value) * frame_.width(); }
  double place_y(double value) const { return frame_.max.y - y_.at(value) * frame_.height(); }
  static std::string color(std::size_t i) {
    const Rgb c = colors::series[i % colors::series.size()];
    return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
  }

  const Plot& plot_;
  Box frame_;  // of the data
  Axis x_;
  Axis y_;
  std::string text_;
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
Axis PlotDrawing::axis(bool of_x) const {
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
  if (low > high) low = high = 1.0;
  if (logarithmic) {
    const double room = std::max(1.15, std::pow(high / low, 0.05));
    return {low / room, high * room, true, false};
  }
  if (!of_x && plot_.from_zero) low = std::min(low, 0.0);
  const double room = high > low ? 0.06 * (high - low) : std::max(1.0, 0.5 * std::abs(high));
  return {!of_x && plot_.from_zero && low >= 0.0 ? 0.0 : low - room, high + room, false, of_x && plot_.whole_x};
}

void PlotDrawing::begin() {
  text_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "font-family=\"sans-serif\" font-size=\"12\" fill=\"#222222\">\n<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      width, height, xml_text(plot_.title));
  label(frame_.min.x, 24.0, "start", plot_.title, " font-size=\"15\" font-weight=\"bold\"");
  label((frame_.min.x + frame_.max.x) / 2.0, height - 18.0, "middle", plot_.x_label);
  const double middle = (frame_.min.y + frame_.max.y) / 2.0;
  label(18.0, middle, "middle", plot_.y_label, fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle));
}

void PlotDrawing::grid() {
  constexpr std::string_view faint = "stroke=\"#e2e2e2\"";
  for (const double tick : x_.ticks()) {
    line(place_x(tick), frame_.min.y, place_x(tick), frame_.max.y, faint);
    label(place_x(tick), frame_.max.y + 17.0, "middle", short_text(tick));
  }
  for (const double tick : y_.ticks()) {
    line(frame_.min.x, place_y(tick), frame_.max.x, place_y(tick), faint);
    label(frame_.min.x - 7.0, place_y(tick) + 4.0, "end", short_text(tick));
  }
  fmt::format_to(std::back_inserter(text_),
                 "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888888\"/>\n",
                 frame_.min.x, frame_.min.y, frame_.width(), frame_.height());
}

void PlotDrawing::level() {
  if (!plot_.level || !y_.shows(*plot_.level)) return;
  const double y = place_y(*plot_.level);
  line(frame_.min.x, y, frame_.max.x, y, "stroke=\"#c1121f\" stroke-width=\"1.5\" stroke-dasharray=\"7 4\"");
  label(frame_.min.x + 6.0, y - 6.0, "start", plot_.level_name, " style=\"fill:#c1121f\"");
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
      line(x, place_y(series.spans[k].x), x, place_y(series.spans[k].y), fmt::format("stroke=\"{}\"", color(i)));
    }
    const double y = place_y(p.y);
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
    fmt::format_to(std::back_inserter(marks), "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" data-tip=\"{}\"/>", x, y,
                   xml_text(fmt::format("{}: {} {}, {} {}", series.name, short_text(p.x), plot_.x_label,
                                        short_text(p.y), plot_.y_label)));
  }
  if (path.empty()) return;
  if (series.joined) {
    fmt::format_to(std::back_inserter(text_), "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}/>\n",
                   path, color(i), series.dashed ? " stroke-dasharray=\"3 4\"" : "");
  }
  if (!series.dashed) fmt::format_to(std::back_inserter(text_), "<g fill=\"{}\">{}</g>\n", color(i), marks);
}

void PlotDrawing::legend() {
  const double left = frame_.max.x + 16.0;
  double y = frame_.min.y + 10.0;
  for (std::size_t i = 0; i < plot_.series.size(); ++i, y += 20.0) {
    const PlotSeries& series = plot_.series[i];
    const std::string dash = series.dashed ? " stroke-dasharray=\"3 4\"" : "";
    if (series.joined)
      line(left, y, left + 22.0, y, fmt::format("stroke=\"{}\" stroke-width=\"1.8\"{}", color(i), dash));
    if (!series.dashed) {
      fmt::format_to(std::back_inserter(text_), "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n",
                     left + 11.0, y, color(i));
    }
    label(left + 28.0, y + 4.0, "start", series.name);
  }
}

}  // namespace

std::string plot_svg(const Plot& plot) { return PlotDrawing(plot).text(); }

std::string panels_svg(std::span<const std::string> panels, std::size_t columns) {
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  std::string text =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n",
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
