// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plot_sheet.hpp"

#include <fmt/format.h>

#include <iterator>

#include "pictures/model/colors.hpp"
#include "pictures/model/xml_text.hpp"
#include "pictures/plots/plot_svg.hpp"

namespace warren {

void PlotSheet::begin(const std::string& title, const Box& frame, const std::string& x_label,
                      const std::string& y_label, double y_label_at) {
  text_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "font-family=\"sans-serif\" font-size=\"12\" fill=\"#222222\">\n<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      plot_size.x, plot_size.y, xml_text(title));
  label(frame.min.x, frame.min.y - 16.0, "start", title, " font-size=\"15\" font-weight=\"bold\"");
  label((frame.min.x + frame.max.x) / 2.0, plot_size.y - 18.0, "middle", x_label);
  if (y_label.empty()) return;
  const double middle = (frame.min.y + frame.max.y) / 2.0;
  label(y_label_at, middle, "middle", y_label, fmt::format(" transform=\"rotate(-90 {} {:.1f})\"", y_label_at, middle));
}

void PlotSheet::label(double x, double y, std::string_view anchor, std::string_view text, std::string_view more) {
  fmt::format_to(std::back_inserter(text_), "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                 anchor, more, xml_text(text));
}

void PlotSheet::line(Vec2 from, Vec2 to, std::string_view style) {
  fmt::format_to(std::back_inserter(text_), "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", from.x, from.y, to.x,
                 to.y, style);
}

void PlotSheet::box(const Box& box, std::string_view style) {
  fmt::format_to(std::back_inserter(text_), "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n",
                 box.min.x, box.min.y, box.width(), box.height(), style);
}

std::string series_color(std::size_t i) {
  const Rgb c = colors::series[i % colors::series.size()];
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

}  // namespace warren
