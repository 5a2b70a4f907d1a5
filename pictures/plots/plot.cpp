// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "pictures/formats/markup.hpp"
#include "pictures/model/axis.hpp"
#include "pictures/model/letters.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

std::string svg_of(const PlotWords& words) {
  const PlacedText& text = words.text;
  std::string more;
  if (text.size != plot_text_size) more += fmt::format(" font-size=\"{}\"", text.size);
  if (text.bold) more += " font-weight=\"bold\"";
  if (text.upright) more += fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", text.at.x, text.at.y);
  if (!(words.color == colors::text)) more += fmt::format(" fill=\"{}\"", css_color(words.color));
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", text.at.x, text.at.y,
                     name_of(text.anchor), more, xml_text(text.text));
}

std::string svg_of(const PlotShape& shape) {
  std::string text;
  const Vec2 first = shape.points.front();
  if (shape.kind == PlotShape::Kind::disc) {
    text = fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"", first.x, first.y, shape.radius);
  } else if (shape.kind == PlotShape::Kind::box) {
    const Vec2 size = shape.points.back() - first;
    text = fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"", first.x, first.y, size.x,
                       size.y);
  } else {
    text = "<path d=\"";
    for (const Vec2 p : shape.points)
      fmt::format_to(std::back_inserter(text), "{}{:.1f} {:.1f}", text.back() == '"' ? 'M' : 'L', p.x, p.y);
    text += '"';
  }
  text += fmt::format(" fill=\"{}\"", shape.pen.fill ? css_color(*shape.pen.fill) : "none");
  if (shape.pen.stroke) text += fmt::format(" stroke=\"{}\"", css_color(*shape.pen.stroke));
  if (shape.pen.stroke && shape.pen.width != 1.0) text += fmt::format(" stroke-width=\"{}\"", shape.pen.width);
  if (shape.pen.opacity < 1.0) text += fmt::format(" opacity=\"{}\"", shape.pen.opacity);
  if (shape.dash.x > 0.0) text += fmt::format(" stroke-dasharray=\"{} {}\"", shape.dash.x, shape.dash.y);
  if (!shape.tip.empty()) text += fmt::format(" data-tip=\"{}\"", xml_text(shape.tip));
  return text + "/>\n";
}

std::vector<std::vector<Vec2>> dashes_of(const std::vector<Vec2>& line, Vec2 dash) {
  std::vector<std::vector<Vec2>> dashes{{line.front()}};
  bool is_drawn = true;
  double left = dash.x;
  for (std::size_t i = 1; i < line.size(); ++i) {
    Vec2 from = line[i - 1];
    for (double leg = distance(from, line[i]); left <= leg; leg = distance(from, line[i])) {
      from = from + left / leg * (line[i] - from);
      is_drawn ? dashes.back().push_back(from) : dashes.push_back({from});
      is_drawn = !is_drawn;
      left = is_drawn ? dash.x : dash.y;
    }
    left -= distance(from, line[i]);
    if (is_drawn) dashes.back().push_back(line[i]);
  }
  return dashes;
}

/// Its points are the page's.
void draw_shape(Surface& surface, const PlotShape& shape, const std::vector<Vec2>& points) {
  const Vec2 low = points.front();
  const Vec2 high = points.back();
  surface.take_pen(shape.pen);
  if (shape.kind == PlotShape::Kind::disc) return surface.chain(circle_outline(low, shape.radius, 24), {}, true);
  if (shape.kind == PlotShape::Kind::box) return surface.chain(Box{low, high}.corners(), {}, true);
  if (shape.dash.x <= 0.0) return surface.chain(points, {}, shape.pen.fill.has_value());
  for (const std::vector<Vec2>& dash : dashes_of(points, shape.dash)) surface.chain(dash, {}, false);
}

constexpr Box widest_frame{{76.0, 40.0}, {540.0, 362.0}};  // of the data, y down
constexpr double narrowest = 300.0;
constexpr double legend_indent = 44.0;  // from the frame to a name
constexpr double margin_of_name = 8.0;  // at its end
constexpr double mark_radius = 3.5;
constexpr Vec2 dashed_line{3.0, 4.0};

/// The least and the largest of what is included; low > high: nothing is.
struct PlotExtent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Draws one plot from back to front.
class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot)
      : plot_(plot), frame_(frame_beside_legend()), x_(axis(true)), y_(axis(false)) {}

  PlotSheet sheet() {
    sheet_.begin(plot_.title, frame_, plot_.x_label, plot_.y_label, 18.0);
    grid();
    if (plot_.level && y_.shows(*plot_.level)) level(frame_.min.x, frame_.max.x, place_y(*plot_.level));
    for (std::size_t i = 0; i < plot_.series.size(); ++i) band(i);
    for (std::size_t i = 0; i < plot_.series.size(); ++i) plot_.series[i].steps ? steps(i) : series(i);
    legend();
    return std::move(sheet_);
  }

 private:
  /// As wide as the names of the series leave it.
  Box frame_beside_legend() const {
    double widest = 0.0;
    for (const PlotSeries& s : plot_.series) widest = std::max(widest, text_width(s.name, plot_text_size));
    if (plot_.level) widest = std::max(widest, text_width(plot_.level_name, plot_text_size));
    const double right = plot_size.x - legend_indent - widest - margin_of_name;
    Box frame = widest_frame;
    frame.max.x = std::clamp(right, frame.min.x + narrowest, frame.max.x);
    return frame;
  }
  /// Wide enough for all that is shown and some room; never empty.
  PlotAxis axis(bool of_x) const {
    const bool logarithmic = of_x ? plot_.log_x : plot_.log_y;
    PlotExtent extent;
    const auto include = [&](double value) {
      if (std::isfinite(value) && (!logarithmic || value > 0.0)) extent.include(value);
    };
    for (const PlotSeries& s : plot_.series) {
      for (const Vec2 p : s.points) include(of_x ? p.x : p.y);
      for (const Vec2 span : s.spans) {
        if (!of_x) include(span.x), include(span.y);
      }
    }
    if (!of_x && plot_.level) include(*plot_.level);
    if (!of_x && plot_.all_y && !(extent.high > 0.0)) include(*plot_.all_y);
    return axis_around(extent.low, extent.high, logarithmic, !of_x && plot_.from_zero, of_x && plot_.whole_x);
  }

  void grid() {
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
  void level(double from, double to, double y) {
    constexpr Rgb red{193, 18, 31};
    sheet_.line({{from, y}, {to, y}}, {.stroke = red, .width = 1.5}, {7.0, 4.0});
  }
  void series(std::size_t i) {
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

  /// The points' places where they are known, each followed by the corner below or above the next.
  template <class Value>
  std::vector<Vec2> stairs(const PlotSeries& series, const Value& value_of) const {
    std::vector<Vec2> places;
    for (std::size_t k = 0; k < series.points.size(); ++k) {
      const std::optional<double> value = value_of(k);
      if (!value) continue;
      const double x = place_x(series.points[k].x);
      if (!places.empty()) places.push_back({x, places.back().y});
      places.push_back({x, std::isfinite(*value) ? place_y(*value) : frame_.min.y});
    }
    return places;
  }
  void steps(std::size_t i) {
    const PlotSeries& series = plot_.series[i];
    const std::vector<Vec2> line = stairs(series, [&](std::size_t k) {
      return shows(series.points[k]) ? std::optional(series.points[k].y) : std::nullopt;
    });
    if (!line.empty()) sheet_.line(line, line_of(i));
  }
  void band(std::size_t i) {
    constexpr double pale = 0.16;
    const PlotSeries& series = plot_.series[i];
    if (!series.steps || series.spans.size() != series.points.size()) return;
    const auto bound = [&](double Vec2::*end) {
      return stairs(series, [&, end](std::size_t k) {
        const bool is_known = shows({series.points[k].x, series.spans[k].x});
        return is_known ? std::optional(series.spans[k].*end) : std::nullopt;
      });
    };
    std::vector<Vec2> outline = bound(&Vec2::x);
    const std::vector<Vec2> above = bound(&Vec2::y);
    outline.insert(outline.end(), above.rbegin(), above.rend());
    if (!outline.empty()) sheet_.line(outline, {.fill = color_of(i), .opacity = pale});
  }

  void legend() {
    const double left = frame_.max.x + 16.0;
    const auto name = [&](const std::string& words, double y) {
      const double at = frame_.max.x + legend_indent;
      sheet_.label({at, y + 4.0}, Anchor::start,
                   fitting_text(words, plot_text_size, plot_size.x - at - margin_of_name));
    };
    double y = frame_.min.y + 10.0;
    for (std::size_t i = 0; i < plot_.series.size(); ++i, y += 20.0) {
      const PlotSeries& series = plot_.series[i];
      if (series.joined) sheet_.line({{left, y}, {left + 22.0, y}}, line_of(i), series.dashed ? dashed_line : Vec2{});
      if (!series.dashed && !series.steps) mark(i, {left + 11.0, y}, {});
      name(series.name, y);
    }
    if (!plot_.level) return;
    level(left, left + 22.0, y);
    name(plot_.level_name, y);
  }

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

constexpr double most_name = 300.0;      // pixels
constexpr double room_of_remark = 96.0;  // beside the frame, at least
constexpr double gap_before_remark = 10.0;

/// Draws one plot from back to front.
class BoxDrawing {
 public:
  explicit BoxDrawing(const BoxPlot& plot) : plot_(plot), frame_(frame_between_words()), axis_(axis()) {}

  PlotSheet sheet() {
    sheet_.begin(plot_.title, frame_, plot_.label, "", 0.0);
    sheet_.label({frame_.max.x + gap_before_remark, frame_.min.y - 8.0}, Anchor::start, plot_.remarks);
    for (const double tick : axis_.ticks()) {
      sheet_.line({{place(tick), frame_.min.y}, {place(tick), frame_.max.y}}, faint_line);
      sheet_.label({place(tick), frame_.max.y + 17.0}, Anchor::middle, tick_on_axis(tick, plot_.label));
    }
    sheet_.box(frame_, frame_line);
    for (std::size_t i = 0; i < plot_.boxes.size(); ++i) row(i);
    return std::move(sheet_);
  }

 private:
  Box frame_between_words() const {
    constexpr double least = 60.0;
    constexpr double margin = 20.0;
    double widest = least;
    double beside = room_of_remark;
    for (const PlottedBox& box : plot_.boxes) {
      widest = std::max(widest, text_width(box.name, plot_text_size));
      beside = std::max(beside, gap_before_remark + text_width(box.remark, plot_text_size) + margin_of_name);
    }
    return {{std::min(widest, most_name) + margin, 48.0}, {plot_size.x - beside, 366.0}};
  }
  PlotAxis axis() const {
    PlotExtent extent;
    for (const PlottedBox& box : plot_.boxes) {
      if (!box.figures) continue;
      extent.include(box.figures->low), extent.include(box.figures->high);
      for (const double value : box.figures->outliers) extent.include(value);
    }
    return axis_around(extent.low, extent.high, plot_.logarithmic && extent.low > 0.0);
  }
  void row(std::size_t i) {
    const PlottedBox& one = plot_.boxes[i];
    const double y = frame_.min.y + (static_cast<double>(i) + 0.5) * row_height();
    name(one.name, y);
    sheet_.label({frame_.max.x + gap_before_remark, y + 4.0}, Anchor::start, one.remark);
    if (one.figures) box(one, y, series_color(i));
  }
  /// In two lines where it needs them and the row has them, else without its middle: names often differ at their ends.
  void name(const std::string& text, double y) {
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
  void box(const PlottedBox& box, double y, Rgb color) {
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
  void outliers(const std::vector<double>& values, double y, Rgb color) {
    double last = -1.0;
    for (const double value : values) {
      const double x = 0.5 * std::round(2.0 * place(value));
      if (x == last) continue;
      last = x;
      sheet_.disc({x, y}, 2.5, {.stroke = color});
    }
  }
  double place(double value) const { return frame_.min.x + axis_.at(value) * frame_.width(); }
  double row_height() const { return frame_.height() / static_cast<double>(plot_.boxes.size()); }

  const BoxPlot& plot_;
  Box frame_;  // of the boxes
  PlotAxis axis_;
  PlotSheet sheet_;
};

constexpr Box frame{{150.0, 48.0}, {724.0, 350.0}};  // of the cells, y down

using HeatColor = std::array<double, 3>;
constexpr std::array<HeatColor, 5> viridis{{{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};

/// At a share from 0 to 1 of the scale.
HeatColor color_at(double share) {
  const double at = share * static_cast<double>(viridis.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  HeatColor color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = std::lerp(viridis[below][i], viridis[below + 1][i], at - static_cast<double>(below));
  }
  return color;
}

Rgb rounded(const HeatColor& c) {
  const auto part = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  return {part(c[0]), part(c[1]), part(c[2])};
}

bool is_dark(const HeatColor& c) { return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2] < 128.0; }

}  // namespace

void PlotSheet::begin(const std::string& title, const Box& frame, const std::string& x_label,
                      const std::string& y_label, double y_label_at) {
  constexpr double title_size = 15.0;
  title_ = title;
  add({{frame.min.x, frame.min.y - 16.0}, title, title_size, Anchor::start, true}, colors::text);
  label({(frame.min.x + frame.max.x) / 2.0, plot_size.y - 18.0}, Anchor::middle, x_label);
  if (y_label.empty()) return;
  add({{y_label_at, (frame.min.y + frame.max.y) / 2.0}, y_label, plot_text_size, Anchor::middle, false, true},
      colors::text);
}

std::string PlotSheet::svg() const {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "font-family=\"sans-serif\" font-size=\"{2}\" fill=\"{3}\"{5}>\n<title>{4}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      plot_size.x, plot_size.y, plot_text_size, css_color(colors::text), xml_text(title_),
      keeps_colors_ ? " class=\"kept\"" : "");
  for (const auto& part : parts_) text += std::visit([](const auto& one) { return svg_of(one); }, part);
  return text + "</svg>\n";
}

void PlotSheet::draw(Surface& surface, Vec2 at, const Execution& execution) const {
  surface.begin_group("plot", title_, {});
  for (const auto& part : parts_) {
    execution.check();
    if (const auto* shape = std::get_if<PlotShape>(&part)) {
      std::vector<Vec2> points = shape->points;
      for (Vec2& p : points) p = at + p;
      draw_shape(surface, *shape, points);
    } else {
      PlotWords words = std::get<PlotWords>(part);
      words.text.at = at + words.text.at;
      surface.take_pen({.fill = words.color});
      surface.text(words.text);
    }
  }
  surface.end_group();
}

Vec2 PlotsPage::size() const {
  const std::size_t count = std::max<std::size_t>(sheets.size(), 1);
  const std::size_t rows = (count + columns - 1) / columns;
  return {plot_size.x * static_cast<double>(std::min(columns, count)), plot_size.y * static_cast<double>(rows)};
}

Vec2 PlotsPage::place_of(std::size_t sheet) const {
  return {plot_size.x * static_cast<double>(sheet % columns), plot_size.y * static_cast<double>(sheet / columns)};
}

std::string PlotsPage::svg() const {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      size().x, size().y);
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    text += fmt::format("<g transform=\"translate({} {})\">\n", place_of(i).x, place_of(i).y);
    text += sheets[i].svg() + "</g>\n";
  }
  return text + "</svg>\n";
}

void PlotsPage::write(const std::string& file, const std::string& title, const Execution& execution) const {
  const std::string ending = ending_of(file);
  if (ending != ".png" && ending != ".pdf") return write_file(file, svg(), execution);
  constexpr double most_pixels = 8192.0;
  constexpr double density = 2.0;
  Page page;
  page.width = size().x;
  page.height = size().y;
  page.dpi = 96.0 * std::min(density, most_pixels / std::max(size().x, size().y));
  const DrawOn draw = [&](Surface& surface) {
    for (std::size_t i = 0; i < sheets.size(); ++i) sheets[i].draw(surface, place_of(i), execution);
    return std::vector<std::string>{};
  };
  OutputFile output(file, execution);
  const Write put = [&](std::string_view bytes) { output.write(bytes); };
  ending == ".png" ? draw_png(page, draw, execution, put) : draw_pdf(page, title, {}, draw, execution, put);
  output.commit();
}

PlotSheet sheet_of(const Plot& plot) { return PlotDrawing(plot).sheet(); }
PlotSheet sheet_of(const BoxPlot& plot) { return BoxDrawing(plot).sheet(); }

PlotSheet sheet_of(const HeatMap& map) {
  PlotExtent scale;
  for (const HeatMap::Cell& cell : map.cells) {
    if (cell.value) scale.include(*cell.value);
  }
  const double low = map.low.value_or(scale.low);
  const double high = map.high.value_or(scale.high);
  const auto color_of = [&](double value) {
    const double share = high > low ? (value - low) / (high - low) : 0.5;
    return color_at(map.less_is_better ? 1.0 - share : share);
  };
  const Vec2 size{frame.width() / static_cast<double>(map.columns.size()),
                  frame.height() / static_cast<double>(map.rows.size())};
  const auto corner = [&](std::size_t column, std::size_t row) {
    return Vec2{frame.min.x + size.x * static_cast<double>(column),
                frame.max.y - size.y * static_cast<double>(row + 1)};
  };
  PlotSheet sheet;
  sheet.keep_colors();
  sheet.begin(map.title, frame, map.x_label, map.y_label, 40.0);
  for (std::size_t i = 0; i < map.columns.size(); ++i) {
    sheet.label({corner(i, 0).x + 0.5 * size.x, frame.max.y + 18.0}, Anchor::middle, map.columns[i]);
  }
  for (std::size_t i = 0; i < map.rows.size(); ++i) {
    sheet.label({frame.min.x - 8.0, corner(0, i).y + 0.5 * size.y + 4.0}, Anchor::end, map.rows[i]);
  }
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const HeatMap::Cell& cell = map.cells[i];
    const std::size_t column = i % map.columns.size();
    const std::size_t row = i / map.columns.size();
    const HeatColor color = cell.value ? color_of(*cell.value) : HeatColor{232, 232, 232};
    const Vec2 at = corner(column, row);
    sheet.box({at, at + size}, {.stroke = colors::paper, .fill = rounded(color)},
              fmt::format("{} {}, {} {}: {}", map.x_label, map.columns[column], map.y_label, map.rows[row], cell.text));
    sheet.label(at + Vec2{0.5 * size.x, 0.5 * size.y + 4.0}, Anchor::middle, cell.text,
                is_dark(color) ? colors::paper : Rgb{0, 0, 0});  // a fill of its own, on dark pages, too
  }
  return sheet;
}

}  // namespace warren
