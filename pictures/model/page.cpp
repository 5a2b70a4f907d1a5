// SPDX-License-Identifier: BSD-3-Clause
// The legend stands beside the world or below it, wherever the world becomes larger. Margins are as wide as the numbers
// in them need; the world keeps its proportions.

#include "pictures/model/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/printable.hpp"
#include "pictures/model/axis.hpp"
#include "pictures/model/letters.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/human_units.hpp"

namespace warren {
namespace {

// Axes around a part of a page, and the scale bar.

constexpr double text_size = 12.5;  ///< of all but the title
constexpr double tick_length = 4.0;
constexpr double swatch_gap = 8.0;  ///< between a swatch and its words

void add_text(Page& page, Vec2 at, std::string words, Anchor anchor = Anchor::start, double size = text_size,
              bool bold = false, bool upright = false) {
  if (!words.empty()) page.texts.push_back({at, std::move(words), size, anchor, bold, upright});
}

/// Frame, ticks and names around `at`; the page's view is there. name_at: where the name of the upright axis stands;
/// none: both names stand inside.
void add_axes(Page& page, const AxesPanel& panel, Box at, std::optional<double> name_at) {
  const Vec2 low = at.min;
  const Vec2 high = at.max;
  const auto line = [&](Vec2 a, Vec2 b) { page.frame.push_back({a, b}); };
  for_each_side(at.corners(), line);
  const auto names_inside = [&] {
    add_text(page, {high.x - 6.0, high.y - 7.0}, panel.x_label, Anchor::end);
    add_text(page, {low.x + 6.0, low.y + text_size + 5.0}, panel.y_label);
  };
  if (!panel.has_ticks) return names_inside();
  const View& view = page.view;
  const Vec2 zero = view.at(panel.origin);
  constexpr double pixels_a_tick = 80.0;
  const double longer = std::max(high.x - low.x, high.y - low.y);
  const double step = tick_step(longer / view.scale, std::max(longer / pixels_a_tick, 2.0));
  const auto ticks = [&](double from, double to) { return ticks_between(from / view.scale, to / view.scale, step); };
  double next = -1e9;  // where there is room again
  for (const double tick : ticks(low.x - zero.x, high.x - zero.x)) {
    const double x = zero.x + view.scale * tick;
    line({x, high.y}, {x, high.y + tick_length});
    const std::string words = tick_text(tick, step);
    const double half = 0.5 * text_width(words, text_size);
    if (x - half < next) continue;
    next = x + half + 6.0;
    add_text(page, {x, high.y + tick_length + 3.0 + text_size}, words, Anchor::middle);
  }
  for (const double tick : ticks(zero.y - high.y, zero.y - low.y)) {
    const double y = zero.y - view.scale * tick;
    line({low.x - tick_length, y}, {low.x, y});
    add_text(page, {low.x - tick_length - 4.0, y + 0.35 * text_size}, tick_text(tick, step), Anchor::end);
  }
  const double below = tick_length + 3.0 + 2.3 * text_size;
  if (!name_at) {
    names_inside();
  } else {
    add_text(page, {0.5 * (low.x + high.x), high.y + below}, panel.x_label, Anchor::middle);
    add_text(page, {*name_at, 0.5 * (low.y + high.y)}, panel.y_label, Anchor::middle, text_size, false, true);
  }
}
/// A round length with its ends marked, from `at` to the right.
void add_scale_bar(Page& page, Vec2 at, std::string_view unit) {
  constexpr double wish = 45.0;
  const double step = tick_step(wish / page.view.scale, 1.0);
  const double length = step * page.view.scale;
  const Vec2 end{at.x + length, at.y};
  page.ink.push_back({at, end});
  for (const Vec2 p : {at, end}) page.ink.push_back({{p.x, p.y - 3.5}, {p.x, p.y + 3.5}});
  const bool one = step == 1.0 && unit == "cells";
  add_text(page, {end.x + swatch_gap, at.y + 0.35 * text_size},
           fmt::format("{}{}{}", tick_text(step, step), unit.empty() ? "" : " ", one ? "cell" : unit));
}

void add_world_entries(std::vector<LegendEntry>& entries, const Picture& picture) {
  const Scene& scene = picture.scene;
  if (!scene.polygons.empty()) {
    entries.push_back({.label = scene.polygons.size() == 1 ? "obstacle" : "obstacles",
                       .lines = {colors::outline},
                       .width = widths::outline,
                       .fill = colors::polygon});
  }
  // A map's walls are the borders of its cells.
  if (scene.walls.size() > 0) {
    const bool borders = scene.map.has_value();
    entries.push_back(
        {.label = borders ? "border of blocked cells" : "wall", .lines = {colors::wall}, .width = widths::wall});
  } else if (scene.bounds && picture.panels.empty()) {
    entries.push_back({.label = "bounds", .lines = {colors::wall}, .width = widths::wall});
  }
}

void add_roadmap_entries(std::vector<LegendEntry>& entries, const PlannedRoadmap<Vec2>& roadmap, Parts parts,
                         const Execution& execution) {
  if (parts.has(Part::roadmap) && !roadmap.states.empty()) {
    const std::size_t edges = roadmap.graph.edge_count();
    LegendEntry entry{.label = edges > 0 ? "roadmap edge, milestone" : "milestone", .dot = colors::components[0]};
    if (edges > 0) {
      const std::vector<std::uint8_t> color = component_colors(roadmap.graph, execution);
      // The last colour is for single milestones, too.
      std::size_t used = 1;
      for (std::size_t c = 1; c + 1 < colors::components.size(); ++c) {
        used += std::find(color.begin(), color.end(), c) != color.end() ? 1 : 0;
      }
      constexpr std::size_t most_pieces = 4;
      used = std::min(used, most_pieces);
      entry.lines.assign(colors::components.begin(), colors::components.begin() + static_cast<std::ptrdiff_t>(used));
      if (used > 1) entry.label = "roadmap, a colour a component";
      entry.width = 1.5;
    }
    entries.push_back(std::move(entry));
  }
  if (parts.has(Part::search) && !roadmap.search_tree.empty()) {
    entries.push_back({.label = "search tree", .lines = {colors::search_tree}, .width = widths::search_tree});
  }
}

void add_layer_entry(std::vector<LegendEntry>& entries, const PictureLayer& layer) {
  if (layer.label.empty() || layer.lines.empty()) return;
  for (const LegendEntry& there : entries) {
    if (there.label == layer.label) return;
  }
  LegendEntry entry{.label = layer.label, .width = layer.width, .fill = layer.fill, .mark = layer.swatch};
  if (layer.swatch && !layer.fill) entry.fill = layer.color;
  if (layer.fill && layer.part == Part::world) entry.opacity = layer.opacity;
  if (layer.width > 0.0) entry.lines = {layer.color};
  entries.push_back(std::move(entry));
}

std::vector<LegendEntry> legend_of(const Picture& picture, Parts parts, const Execution& execution) {
  std::vector<LegendEntry> entries;
  const auto add_layers = [&](bool of_world) {
    for (const PictureLayer& layer : picture.layers) {
      if ((layer.part == Part::world) == of_world && parts.has(layer.part)) add_layer_entry(entries, layer);
    }
  };
  if (parts.has(Part::world)) add_world_entries(entries, picture);
  add_layers(true);
  if (picture.roadmap) add_roadmap_entries(entries, *picture.roadmap, parts, execution);
  add_layers(false);
  if (!parts.has(Part::path)) return entries;
  if (!picture.path.empty()) {
    entries.push_back({.label = picture.path_label, .lines = {colors::path}, .width = widths::path});
  }
  if (picture.start) entries.push_back({.label = "start", .fill = colors::start, .mark = MarkShape::disc});
  if (picture.goal) entries.push_back({.label = "goal", .fill = colors::goal, .mark = MarkShape::star});
  return entries;
}

constexpr double usual_side = 720.0;  // of the world's longer side
constexpr double least_side = 36.0;   // of the shorter one
constexpr double rim = 12.0;          // around the world, so that no mark is cut off
constexpr double margin = 12.0;       // around all
constexpr double title_size = 16.0;
constexpr double line_height = 1.45;
constexpr double legend_row = 21.0;
constexpr double legend_gap = 18.0;  // between world and legend

struct Margins {
  double left, top, right, bottom;
};

class PageMaker {
 public:
  PageMaker(const Picture& picture, const PictureOptions& options, bool in_pixels, const Execution& execution)
      : picture_(picture), options_(options), in_pixels_(in_pixels) {
    page_.canvas = canvas_of(picture, execution);
    if (options.parts.has(Part::legend)) page_.legend = legend_of(picture, options.parts, execution);
    if (has_axes()) entry_width_ = 120.0;  // the scale bar's
    for (const LegendEntry& entry : page_.legend) {
      entry_width_ = std::max(entry_width_, swatch_width + swatch_gap + text_width(entry.label, text_size));
    }
    title_ = options.title.value_or(picture.title);
  }

  Page make() {
    take_size();
    lay_out(best_side());
    if (!fixed()) fit_page();
    place_world();
    title();
    if (has_axes()) axes();
    legend();
    return std::move(page_);
  }

 private:
  /// Places in the legend; the scale bar has the last.
  std::size_t slots() const { return page_.legend.empty() ? 0 : page_.legend.size() + (has_axes() ? 1 : 0); }
  bool has_axes() const { return options_.parts.has(Part::axes); }
  bool fixed() const { return options_.size.has_value(); }
  double world_width() const { return page_.canvas.box.width(); }
  double world_height() const { return page_.canvas.box.height(); }
  void take_size() {
    const Box& box = page_.canvas.box;
    const double longer = std::max(box.width(), box.height());
    // A PNG of unasked size has some pixels for each cell, up to a limit.
    constexpr double pixels_a_unit = 24.0;
    constexpr double least_pixels = 2.0 * usual_side;
    constexpr double most_pixels = 4096.0;
    const double wanted = std::clamp(pixels_a_unit * longer / page_.canvas.unit, least_pixels, most_pixels);
    const bool free_size = !options_.size && in_pixels_;
    page_.dpi = options_.dpi.value_or(free_size ? 96.0 * wanted / usual_side : 96.0);
    if (!fixed()) return;
    page_.asked = options_.size;
    constexpr double mm_an_inch = 25.4;
    const double to_page = 96.0 / (options_.size->unit == LengthUnit::mm ? mm_an_inch : page_.dpi);
    page_.width = to_page * options_.size->width;
    page_.height = to_page * options_.size->height;
  }

  /// Is there more room for the world with the legend beside it than with it below?
  bool best_side() {
    if (page_.legend.empty()) return true;
    const double aspect = world_width() / world_height();
    if (!fixed()) return aspect < 1.4;
    const auto scale = [&](bool beside) {
      lay_out(beside);
      return page_.view.scale;
    };
    const double with_beside = scale(true);
    return with_beside >= scale(false);
  }
  /// Margins and the scale of the world.
  void lay_out(bool beside) {
    beside_ = beside;
    const double axis = has_axes() ? tick_length + 4.0 + text_size * line_height : 0.0;
    const bool names = has_axes() && picture_.panels.empty();
    const double name = names ? text_size * line_height : 0.0;
    const double numbers = ticks_width();
    around_ = {margin + name + (has_axes() ? numbers + tick_length + 4.0 : 0.0), margin,
               std::max(margin, 0.5 * numbers), margin + axis + name};
    if (beside && !page_.legend.empty()) around_.right += legend_gap + entry_width_;
    if (fixed()) return fit_data();
    page_.view.scale = (usual_side - 2.0 * rim) / std::max(world_width(), world_height());
    const double data_width = std::max(world_width() * page_.view.scale + 2.0 * rim, least_side);
    const double data_height = std::max(world_height() * page_.view.scale + 2.0 * rim, least_side);
    page_.width = around_.left + data_width + around_.right;
    wrap_title();
    const double top = around_.top + title_height();
    page_.data = Box{{around_.left, top}, {around_.left + data_width, top + data_height}};
  }

  /// On a page whose size was asked for: the world in what the margins leave.
  void fit_data() {
    wrap_title();
    Margins all = around_;
    all.top += title_height();
    if (!beside_) {
      const double inner = page_.width - 2.0 * margin;
      const auto rows = (slots() + legend_columns(inner) - 1) / legend_columns(inner);
      all.bottom += legend_gap + legend_row * static_cast<double>(rows);
    }
    const double data_width = std::max(page_.width - all.left - all.right, 8.0);
    const double data_height = std::max(page_.height - all.top - all.bottom, 8.0);
    const double fit_rim = std::min({rim, 0.2 * data_width, 0.2 * data_height});
    page_.view.scale =
        std::min((data_width - 2.0 * fit_rim) / world_width(), (data_height - 2.0 * fit_rim) / world_height());
    page_.data = Box{{all.left, all.top}, {all.left + data_width, all.top + data_height}};
  }

  /// The page around a world of the usual size.
  void fit_page() {
    double widest = title_.empty() ? 0.0 : std::min(text_width(title_, title_size) * 1.08, 640.0);
    for (const std::string& line : subtitle_) widest = std::max(widest, text_width(line, text_size));
    page_.width = std::max(page_.width, widest + 2.0 * margin);
    page_.height = page_.data.max.y + around_.bottom;
    if (page_.legend.empty()) return;
    const auto count = static_cast<double>(slots());
    if (beside_) {
      page_.height = std::max(page_.height, page_.data.min.y + count * legend_row + margin);
    } else {
      const auto columns = static_cast<double>(legend_columns(page_.width - 2.0 * margin));
      page_.height += legend_gap + legend_row * (std::ceil(count / columns) - 0.7);
    }
  }

  /// The world in the middle of its place; the frame as tight around it as the rim.
  void place_world() {
    const Vec2 size{world_width() * page_.view.scale, world_height() * page_.view.scale};
    Box& data = page_.data;
    if (fixed()) {  // what is left over goes to the right and below
      data.max.x = std::min(data.max.x, data.min.x + std::max(size.x + 2.0 * rim, least_side));
      data.max.y = std::min(data.max.y, data.min.y + std::max(size.y + 2.0 * rim, least_side));
    }
    const Vec2 low{0.5 * (data.min.x + data.max.x - size.x), 0.5 * (data.min.y + data.max.y + size.y)};
    page_.view.origin = {low.x - page_.view.scale * page_.canvas.box.min.x,
                         low.y + page_.view.scale * page_.canvas.box.min.y};
  }
  void title() {
    double y = margin;
    if (!title_.empty()) {
      y += title_size;
      constexpr double bold = 1.08;
      add_text(page_, {margin, y}, fitting_text(title_, title_size * bold, page_.width - 2.0 * margin), Anchor::start,
               title_size, true);
      y += (line_height - 1.0) * title_size;
    }
    for (const std::string& line : subtitle_) {
      add_text(page_, {margin, y + text_size}, line);
      y += line_height * text_size;
    }
  }

  void axes() {
    if (picture_.panels.empty()) {
      const Box& data = page_.data;
      return add_axes(page_, {.x_label = axis_name('x', data.width()), .y_label = axis_name('y', data.height())}, data,
                      margin + text_size);
    }
    for (const AxesPanel& panel : picture_.panels) {
      const Vec2 low = page_.view.at(panel.box.min);
      const Vec2 high = page_.view.at(panel.box.max);
      add_axes(page_, panel, Box{{low.x, high.y}, {high.x, low.y}}, std::nullopt);
    }
  }

  /// Where not all of a map is shown, with what the whole takes of the axis, if there is room for it.
  std::string axis_name(char axis, double room) const {
    const std::string_view unit = unit_of(picture_.scene);
    const std::string name = unit.empty() ? std::string(1, axis) : fmt::format("{} ({})", axis, unit);
    if (!page_.canvas.whole) return name;
    const auto& [low, high] = *page_.canvas.whole;
    const std::string of_all =
        fmt::format("{}, part of {} to {}: the rest is unknown", name, human_number(axis == 'x' ? low.x : low.y),
                    human_number(axis == 'x' ? high.x : high.y));
    return text_width(of_all, text_size) <= room ? of_all : name;
  }
  void legend() {
    if (page_.legend.empty()) return;
    const std::size_t columns = beside_ ? 1 : legend_columns(page_.width - 2.0 * margin);
    const Vec2 first = beside_ ? Vec2{page_.data.max.x + legend_gap, page_.data.min.y + 0.5 * legend_row}
                               : Vec2{margin, page_.data.max.y + around_.bottom - margin + legend_gap};
    const auto place = [&](std::size_t i) {
      return first + Vec2{static_cast<double>(i % columns) * (entry_width_ + legend_gap),
                          static_cast<double>(i / columns) * legend_row};
    };
    const std::size_t count = page_.legend.size();
    if (has_axes()) add_scale_bar(page_, place(count), unit_of(picture_.scene));
    for (std::size_t i = 0; i < count; ++i) {
      LegendEntry& entry = page_.legend[i];
      entry.at = place(i);
      add_text(page_, entry.at + Vec2{swatch_width + swatch_gap, 0.35 * text_size}, entry.label);
    }
  }

  void wrap_title() {
    subtitle_.clear();
    if (options_.title && options_.title->empty()) return;
    constexpr double least_width = 420.0;
    const double room = (fixed() ? page_.width : std::max(page_.width, least_width)) - 2.0 * margin;
    for (const std::string_view part : split(picture_.subtitle, "\n")) {
      for (std::string& line : wrapped_text(std::string(part), text_size, room)) subtitle_.push_back(std::move(line));
    }
  }
  double title_height() const {
    double height = title_.empty() ? 0.0 : title_size * line_height;
    height += static_cast<double>(subtitle_.size()) * text_size * line_height;
    return height > 0.0 ? height + 4.0 : 0.0;
  }
  double ticks_width() const {
    if (!has_axes()) return 0.0;
    const Box& box = page_.canvas.box;
    const double step = tick_step(std::max(box.width(), box.height()), 8.0);
    double widest = 0.0;
    for (const double tick : ticks_between(box.min.y, box.max.y, step)) {
      widest = std::max(widest, text_width(tick_text(tick, step), text_size));
    }
    return widest;
  }
  std::size_t legend_columns(double width) const {
    const double columns = std::floor((width + legend_gap) / (entry_width_ + legend_gap));
    return static_cast<std::size_t>(std::clamp(columns, 1.0, std::max(static_cast<double>(slots()), 1.0)));
  }

  const Picture& picture_;
  const PictureOptions& options_;
  bool in_pixels_;
  Page page_;
  double entry_width_ = 0.0;
  std::string title_;
  std::vector<std::string> subtitle_;
  bool beside_ = true;  // the legend
  Margins around_{};
};

}  // namespace

double Page::thickness() const {
  constexpr double usual_unit = 20.0;
  constexpr double most = 1.25;
  return std::min(view.scale * canvas.unit / usual_unit, most);
}

PlacedText foot_of(const Page& page, const std::string& words) {
  constexpr double size = 9.0;
  return {{margin, page.height - 0.3 * size}, fitting_text(words, size, page.width - 2.0 * margin), size};
}

Page page_of(const Picture& picture, const PictureOptions& options, bool in_pixels, const Execution& execution) {
  return PageMaker(picture, options, in_pixels, execution).make();
}

}  // namespace warren
