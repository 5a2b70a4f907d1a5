// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "pictures/formats/markup.hpp"
#include "pictures/formats/surface.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

std::string svg_of(const PlotWords& words) {
  constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
  const PlacedText& text = words.text;
  std::string more;
  if (text.size != plot_text_size) more += fmt::format(" font-size=\"{}\"", text.size);
  if (text.bold) more += " font-weight=\"bold\"";
  if (text.upright) more += fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", text.at.x, text.at.y);
  if (!(words.color == colors::text)) more += fmt::format(" fill=\"{}\"", css_color(words.color));
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", text.at.x, text.at.y,
                     anchors[static_cast<std::size_t>(text.anchor)], more, xml_text(text.text));
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

/// The parts of a line that are drawn.
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
  if (shape.kind == PlotShape::Kind::box)
    return surface.chain(std::array{low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}}, {}, true);
  if (shape.dash.x <= 0.0) return surface.chain(points, {}, shape.pen.fill.has_value());
  for (const std::vector<Vec2>& dash : dashes_of(points, shape.dash)) surface.chain(dash, {}, false);
}

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

namespace {

Page page_for(Vec2 size) {
  constexpr double most_pixels = 8192.0;
  constexpr double density = 2.0;
  Page page;
  page.width = size.x;
  page.height = size.y;
  page.dpi = 96.0 * std::min(density, most_pixels / std::max(size.x, size.y));
  return page;
}

}  // namespace

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
  const DrawOn draw = [&](Surface& surface) {
    for (std::size_t i = 0; i < sheets.size(); ++i) sheets[i].draw(surface, place_of(i), execution);
    return std::vector<std::string>{};
  };
  OutputFile output(file, execution);
  const Write put = [&](std::string_view bytes) { output.write(bytes); };
  if (ending == ".png") {
    draw_png(page_for(size()), draw, execution, put);
  } else {
    draw_pdf(page_for(size()), {title, {}}, draw, execution, put);
  }
  output.commit();
}

}  // namespace warren
