// SPDX-License-Identifier: BSD-3-Clause
// Lines are as wide as the page says (Page::thickness), so they stay in proportion to a maze's cells; walls, paths and
// marks keep a least width. Many lines are drawn thinner and fainter: their ink covers a part of the page, not all.

#include "pictures/formats/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "parallel/asked_memory.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

// Many lines or areas of one kind as a group on a surface. Where their ink would cover much of the page they become
// thinner and fainter; where a file of them would be too large they are drawn as pixels.

class LineGroup {
 public:
  LineGroup(Surface& surface, const Page& page, const Execution& execution, const Pen& pen)
      : surface_(surface), page_(page), execution_(execution), pen_(pen) {}

  /// Before the group begins: what its lines are to cover; a point twice is a dot.
  void measure(std::span<const Vec2> chain) {
    execution_.poll(++drawn_);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      ink_ += pen_.width * (page_.view.scale * distance(chain[i - 1], chain[i]) + pen_.width);
    }
  }

  /// points: how many will follow, at least. Where much was measured, what follows is thinner and fainter.
  void begin(std::string_view id, std::string_view label, std::size_t points) {
    thin_out();
    surface_.begin_group(id, label, pen_);
    drawn_ = 0;
    if (!surface_.takes_as_mask(points)) return;
    constexpr double most_pixels = 3072.0;
    density_ = most_pixels / std::max(page_.data.width(), page_.data.height());
    mask_.emplace(static_cast<std::size_t>(std::ceil(density_ * page_.data.width())),
                  static_cast<std::size_t>(std::ceil(density_ * page_.data.height())), execution_);
  }
  void take_color(Rgb color) {
    if (mask_) return;  // has one
    pen_.stroke = color;
    surface_.take_pen(pen_);
  }
  /// Throws Stopped.
  void segment(Vec2 a, Vec2 b) {
    count();
    if (!mask_) return surface_.segment(a, b);
    mask_->draw_line(in_mask(a), in_mask(b), density_ * pen_.width, pen_.opacity);
  }
  /// As Surface's, with this share of the opacity.
  void chain(std::span<const Vec2> points, std::span<const double> turns, bool closed, double opacity = 1.0) {
    count();
    if (!mask_) {
      Pen pen = pen_;
      pen.opacity *= opacity;
      surface_.take_pen(pen);
      return surface_.chain(points, turns, closed);
    }
    std::vector<Vec2> all = without_arcs(points, turns);
    for (Vec2& p : all) p = in_mask(p);
    if (pen_.fill) {
      PolygonSet outline;
      outline.add(all);
      return mask_->fill(outline, pen_.opacity * opacity, execution_);
    }
    if (closed) all.push_back(all.front());
    for (std::size_t i = 1; i < all.size(); ++i) {
      count();
      mask_->draw_line(all[i - 1], all[i], density_ * pen_.width, pen_.opacity * opacity);
    }
  }

  void end() {
    if (mask_) surface_.mask(*mask_, pen_.fill ? *pen_.fill : *pen_.stroke);
    surface_.end_group();
  }

  /// Are they visibly thinner than they were to be? Are they pixels?
  bool is_thin() const { return thin_; }
  bool is_mask() const { return mask_.has_value(); }

 private:
  /// Lets the pen cover no more than a share of the page with what was measured.
  void thin_out() {
    constexpr double most_cover = 0.3;
    constexpr double least_width = 0.4;
    constexpr double least_opacity = 0.25;
    constexpr double visibly = 0.9;
    const double allowed = most_cover * page_.data.width() * page_.data.height();
    if (!(ink_ > allowed)) return;
    const double share = std::sqrt(allowed / ink_);
    thin_ = share < visibly;
    pen_.width = std::min(pen_.width, std::max(pen_.width * share, least_width));
    pen_.opacity *= std::max(share, least_opacity);
  }
  Vec2 in_mask(Vec2 p) const { return density_ * (page_.view.at(p) - page_.data.min); }
  void count() {
    constexpr std::size_t lines_per_poll = 64;  // each may run across the whole picture
    if (++drawn_ % lines_per_poll == 0) execution_.check();
  }

  Surface& surface_;
  const Page& page_;
  const Execution& execution_;
  Pen pen_;
  double ink_ = 0.0;  // square pixels of the page
  std::size_t drawn_ = 0;
  bool thin_ = false;
  std::optional<Mask> mask_;
  double density_ = 1.0;  // pixels of the mask a pixel of the page
};

class Painter {
 public:
  Painter(const Picture& picture, Parts parts, const Page& page, Surface& surface, const Execution& execution)
      : picture_(picture), parts_(parts), page_(page), surface_(surface), execution_(execution) {}

  std::vector<std::string> paint() {
    surface_.enter_world();
    layers([](const PictureLayer& some) { return some.part == Part::world; });
    if (parts_.has(Part::world)) polygons();
    const auto is_lines = [](Part part) { return part == Part::roadmap || part == Part::search; };
    layers([&](const PictureLayer& some) { return is_lines(some.part) && !some.over_roadmap; });
    if (picture_.roadmap) roadmap();
    layers([&](const PictureLayer& some) { return is_lines(some.part) && some.over_roadmap; });
    if (parts_.has(Part::world)) walls();
    layers([](const PictureLayer& some) { return some.part == Part::body; });
    layers([](const PictureLayer& some) { return some.part == Part::path; });
    if (parts_.has(Part::path)) {
      path();
      mark("start", picture_.start, MarkShape::disc, colors::start);
      mark("goal", picture_.goal, MarkShape::star, colors::goal);
    }
    if (picture_.moves) surface_.moving(picture_, parts_, width(widths::search_tree));
    surface_.leave_world();
    if (picture_.solids) solids(*picture_.solids);
    frame();
    return notes();
  }

 private:
  LineGroup group_with(const Pen& pen) const { return {surface_, page_, execution_, pen}; }
  /// Ends the group, and keeps what is to be said of it.
  void end(LineGroup& group, const std::string& name) {
    group.end();
    if (group.is_thin()) thin_.push_back(name);
    if (group.is_mask()) pixels_.push_back(name);
  }
  /// Those that are chosen and shown.
  template <class Choose>
  void layers(const Choose& choose) {
    for (const PictureLayer& some : picture_.layers) {
      if (parts_.has(some.part) && choose(some)) layer(some);
    }
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> all;
    if (!thin_.empty()) all.push_back(fmt::format("thinner and paler, being so many: {}", fmt::join(thin_, ", ")));
    if (!pixels_.empty()) all.push_back(fmt::format("as pixels, being so many: {}", fmt::join(pixels_, ", ")));
    return all;
  }
  double width(double usual, double least = 0.0) const { return std::max(usual * page_.thickness(), least); }
  void polygons() {
    const std::vector<ScenePolygon>& polygons = picture_.scene.polygons;
    if (polygons.empty()) return;
    LineGroup group =
        group_with({.stroke = colors::outline, .width = width(widths::outline, 0.4), .fill = colors::polygon});
    std::size_t corners = 0;
    for (const ScenePolygon& polygon : polygons) corners += polygon.corners.size();
    group.begin("polygons", "obstacles", corners);
    for (const ScenePolygon& polygon : polygons) group.chain(anticlockwise(polygon.corners), {}, true);
    end(group, "obstacles");
  }
  void layer(const PictureLayer& layer) {
    const bool has_lines = layer.width > 0.0;
    LineGroup group = group_with({.stroke = has_lines ? std::optional(layer.color) : std::nullopt,
                                  .width = width(layer.width, 0.35),
                                  .fill = layer.fill,
                                  .opacity = layer.opacity,
                                  .crisp = layer.fill && layer.part == Part::world});
    if ((layer.part == Part::roadmap || layer.part == Part::search) && !layer.fill) {
      for (std::size_t i = 0; i < layer.lines.size(); ++i) group.measure(layer.lines[i]);
    }
    group.begin(layer.id, layer.label, layer.lines.corners.size());
    const bool is_cut = page_.canvas.whole && layer.part == Part::world;  // cells of a map that is not shown wholly
    const Box shown = page_.view.box_of(page_.data);
    for (std::size_t i = 0; i < layer.lines.size(); ++i) {
      if (is_cut) {
        const std::vector<Vec2> part = part_in_box(layer.lines[i], shown);
        if (part.size() > 2) group.chain(part, {}, true);
        continue;
      }
      group.chain(layer.lines[i], layer.turns_of(i), layer.closed || layer.fill,
                  layer.opacities.empty() ? 1.0 : layer.opacities[i]);
    }
    end(group, layer.label.empty() ? layer.id : layer.label);
  }

  /// Walls that continue each other along an axis become one line.
  void walls() {
    const double unit = page_.view.scale * page_.canvas.unit * page_.density();  // pixels
    // Thin walls are drawn stronger than their width, or a large maze would fade; tiny cells stay a light texture.
    constexpr double faint = 0.3;
    const double least = std::clamp(faint * unit, 0.02, 1.0) / page_.density();
    LineGroup group = group_with({.stroke = colors::wall, .width = width(widths::wall, least)});
    group.begin("walls", "walls", picture_.scene.walls.size());
    std::optional<Segment> run;
    std::size_t seen = 0;
    picture_.scene.walls.visit([&](auto all) {
      for (const auto& wall : all) {
        execution_.poll(++seen);
        const Segment s = wall.segment();
        const bool goes_on = run && s.a == run->b &&
                             ((s.a.y == s.b.y && run->a.y == s.a.y && (s.b.x > s.a.x) == (run->b.x > run->a.x)) ||
                              (s.a.x == s.b.x && run->a.x == s.a.x && (s.b.y > s.a.y) == (run->b.y > run->a.y)));
        if (goes_on) {
          run->b = s.b;
          continue;
        }
        if (run) group.segment(run->a, run->b);
        run = s;
      }
    });
    if (run) group.segment(run->a, run->b);
    for (const Segment& side : bounds_walls(picture_.scene)) group.segment(side.a, side.b);
    end(group, picture_.scene.map ? "borders of blocked cells" : "walls");
  }

  void roadmap() {
    const std::vector<std::uint8_t> color = component_colors(picture_.roadmap->graph, execution_);
    if (color.size() != picture_.roadmap->states.size()) return;  // stopped before the graph was made
    if (parts_.has(Part::roadmap)) edges(color);
    if (parts_.has(Part::search)) search_tree();
    if (parts_.has(Part::roadmap)) milestones(color);
  }
  void edges(const std::vector<std::uint8_t>& color) {
    const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
    LineGroup group = group_with({.stroke = colors::components[0], .width = width(widths::edge, 0.3)});
    roadmap.graph.for_each_edge([&](VertexId v, VertexId w) {
      group.measure(std::array{roadmap.states[v], roadmap.states[w]});
    });
    group.begin("edges", "roadmap edges", roadmap.graph.edge_count());
    for (std::size_t c = 0; c < colors::components.size(); ++c) {
      if (std::find(color.begin(), color.end(), c) == color.end()) continue;
      group.take_color(colors::components[c]);
      roadmap.graph.for_each_edge([&](VertexId v, VertexId w) {
        execution_.poll(v);
        if (color[v] == c) group.segment(roadmap.states[v], roadmap.states[w]);
      });
    }
    end(group, "roadmap edges");
  }

  void search_tree() {
    const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
    LineGroup group = group_with({.stroke = colors::search_tree, .width = width(widths::search_tree, 0.4)});
    const auto visit = [&](const auto& take) {
      for (const Edge& edge : roadmap.search_tree) {
        if (edge.to != no_vertex) take(roadmap.states[edge.from], roadmap.states[edge.to]);
      }
    };
    visit([&](Vec2 a, Vec2 b) { group.measure(std::array{a, b}); });
    group.begin("search_tree", "search tree", roadmap.search_tree.size());
    visit([&](Vec2 a, Vec2 b) { group.segment(a, b); });
    end(group, "search tree");
  }

  /// A line of length zero with round ends is a dot.
  void milestones(const std::vector<std::uint8_t>& color) {
    const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
    LineGroup group = group_with({.stroke = colors::components[0], .width = width(widths::milestone, 0.8)});
    for (const Vec2 p : roadmap.states) group.measure(std::array{p, p});
    group.begin("milestones", "milestones", color.size());
    for (std::size_t c = 0; c < colors::components.size(); ++c) {
      group.take_color(colors::components[c]);
      for (std::size_t v = 0; v < color.size(); ++v) {
        execution_.poll(v);
        if (color[v] == c) group.segment(roadmap.states[v], roadmap.states[v]);
      }
    }
    end(group, "milestones");
  }

  /// Points that the page does not tell apart are left out of very long paths.
  void path() {
    if (picture_.path.empty()) return;
    constexpr double least_width = 1.1;
    constexpr std::size_t long_path = 50'000;
    std::vector<Vec2> seen;
    if (picture_.path.size() > long_path && picture_.path_turns.empty()) {
      const double apart = 0.5 / page_.view.scale;
      for (std::size_t i = 0; i < picture_.path.size(); ++i) {
        execution_.poll(i);
        const Vec2 p = picture_.path[i];
        if (seen.empty() || distance(seen.back(), p) > apart) push_asked(seen, p, execution_);
      }
      seen.push_back(picture_.path.back());
    }
    const std::span<const Vec2> shown = seen.empty() ? picture_.path : std::span<const Vec2>(seen);
    const Pen line{.stroke = colors::path, .width = width(widths::path, least_width)};
    if (surface_.takes_as_mask(shown.size())) {
      LineGroup group = group_with(line);
      group.begin("path", picture_.path_label, shown.size());
      group.chain(shown, picture_.path_turns, false);
      return end(group, picture_.path_label);
    }
    surface_.begin_group("path", picture_.path_label, line);
    if (seen.empty()) {  // a light rim, where there is room for one
      surface_.take_pen({.stroke = colors::paper, .width = 1.65 * line.width});
      surface_.chain(shown, picture_.path_turns, false);
    }
    surface_.take_pen(line);
    surface_.chain(shown, picture_.path_turns, false);
    surface_.end_group();
  }

  void solids(const SolidView& view) {
    const Vec2 low = page_.view.at({view.box.min.x, view.box.max.y});
    const Vec2 high = page_.view.at({view.box.max.x, view.box.min.y});
    constexpr double most_pixels = 2000.0;
    const double density = std::min(surface_.image_density(), most_pixels / std::max(high.x - low.x, high.y - low.y));
    const auto pixels = [&](double length) {
      return std::max<std::size_t>(static_cast<std::size_t>(std::lround(density * length)), 1);
    };
    if (view.is_thinned) thin_.push_back("lines of the perspective");
    surface_.begin_group("perspective", "", {});
    surface_.image(draw_solids(view, parts_, pixels(high.x - low.x), pixels(high.y - low.y), execution_), {low, high});
    surface_.end_group();
  }
  /// As large on any page; with a light rim.
  void mark(const char* id, std::optional<Vec2> at, MarkShape shape, Rgb color) {
    if (!at) return;
    surface_.begin_group(id, id, {.stroke = colors::paper, .width = 1.6, .fill = color});
    std::vector<Vec2> outline = mark_outline(shape, widths::mark / page_.view.scale);
    for (Vec2& p : outline) p = *at + p;
    surface_.chain(outline, {}, true);
    surface_.end_group();
  }
  void segments(std::string_view id, const std::vector<Segment>& all, const Pen& pen) {
    if (all.empty()) return;
    surface_.begin_group(id, "", pen);
    for (const Segment& s : all) surface_.segment(s.a, s.b);
    surface_.end_group();
  }
  void frame() {
    segments("axes", page_.frame, {.stroke = colors::frame, .width = 1.0});
    segments("scale", page_.ink, {.stroke = colors::text, .width = 1.4});
    if (!page_.legend.empty()) {
      surface_.begin_group("legend", "", {});
      for (const LegendEntry& entry : page_.legend) swatch(entry);
      surface_.end_group();
    }
    surface_.begin_group("words", "", {.fill = colors::text});
    for (const PlacedText& text : page_.texts) surface_.text(text);
    if (parts_.has(Part::legend) && !notes().empty())
      surface_.text(foot_of(page_, fmt::format("{}", fmt::join(notes(), "; "))));
    surface_.end_group();
  }

  void swatch(const LegendEntry& entry) {
    const Vec2 at = entry.at;
    const Vec2 middle{at.x + 0.5 * swatch_width, at.y};
    if (entry.mark) {
      surface_.take_pen({.fill = entry.fill});
      std::vector<Vec2> outline = mark_outline(*entry.mark, 6.0);
      for (Vec2& p : outline) p = {middle.x + p.x, middle.y - p.y};
      return surface_.chain(outline, {}, true);
    }
    if (entry.fill) {
      constexpr double half = 6.0;
      Pen pen{.width = std::clamp(entry.width, 0.8, 2.0), .fill = entry.fill, .opacity = entry.opacity};
      if (!entry.lines.empty()) pen.stroke = entry.lines.front();
      surface_.take_pen(pen);
      const Box box{{at.x + 2.0, at.y - half}, {at.x + swatch_width - 2.0, at.y + half}};
      return surface_.chain(box.corners(), {}, true);
    }
    const double part = swatch_width / static_cast<double>(std::max<std::size_t>(entry.lines.size(), 1));
    for (std::size_t i = 0; i < entry.lines.size(); ++i) {
      surface_.take_pen({.stroke = entry.lines[i], .width = std::clamp(entry.width, 1.4, 3.4)});
      const double x = at.x + part * static_cast<double>(i);
      surface_.segment({x, at.y}, {x + part, at.y});
    }
    if (entry.dot) {
      surface_.take_pen({.stroke = *entry.dot, .width = 5.0});
      surface_.segment(middle, middle);
    }
  }

  const Picture& picture_;
  Parts parts_;
  const Page& page_;
  Surface& surface_;
  const Execution& execution_;
  std::vector<std::string> thin_;    // what was drawn thinner than usual
  std::vector<std::string> pixels_;  // what was drawn as pixels
};

}  // namespace

std::vector<std::string> paint(const Picture& picture, Parts parts, const Page& page, Surface& surface,
                               const Execution& execution) {
  return Painter(picture, parts, page, surface, execution).paint();
}

std::string ending_of(const std::string& file) {
  const std::size_t dot = file.rfind('.');
  if (dot == std::string::npos || file.find('/', dot) != std::string::npos) return {};
  std::string ending = file.substr(dot);
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

bool is_picture(std::string_view ending) {
  return !ending.empty() && fmt::format(" {} ", picture_endings).find(fmt::format(" {} ", ending)) != std::string::npos;
}

std::vector<std::string> write_picture(const std::string& file, const Picture& picture, const PictureOptions& options,
                                       const Execution& execution) {
  options.validate();
  const std::string ending = ending_of(file);
  decltype(write_svg)* writer = write_svg;
  if (ending == ".png") writer = write_png;
  if (ending == ".pdf") writer = write_pdf;
  if (ending == ".html") writer = write_html;
  OutputFile output(file, execution);
  std::vector<std::string> notes =
      writer(picture, options, execution, [&](std::string_view bytes) { output.write(bytes); });
  output.commit();
  return notes;
}

}  // namespace warren
