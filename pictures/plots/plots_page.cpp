// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/plots/plots_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "pictures/formats/drawn_files.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
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
