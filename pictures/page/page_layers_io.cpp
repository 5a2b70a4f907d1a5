// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/page/page_layers_io.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "pictures/formats/png_file.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/formats/solid_raster.hpp"
#include "pictures/page/number_array.hpp"
#include "pictures/page/page_arm_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_drawn_walls = 4'000'000;

class PageLayers {
 public:
  PageLayers(const Picture& picture, Parts parts, const Canvas& canvas, Vec2 origin, const Execution& execution,
             const Write& write)
      : picture_(picture), parts_(parts), canvas_(canvas), origin_(origin), execution_(execution), write_(write) {}

  void all();

 private:
  void polygons();
  void layer(const PictureLayer& layer);
  void walls();
  template <class T>
  void wall_ends();
  void wall_image();
  void perspective(const SolidView& view);
  template <class WritePng>
  void image_in(const Box& box, const WritePng& write_png);

  void begin_layer(const Json& about) {
    std::string text = in_script(about.dump(-1, ' ', true, Json::error_handler_t::replace));
    text.pop_back();
    write_((is_first_ ? "" : ",") + text);
    is_first_ = false;
  }
  template <class T>
  NumberArray<T> numbers(std::string_view name) const {
    return {name, execution_, write_};
  }
  Vec2 moved(Vec2 p) const { return p - origin_; }
  bool has_small_whole_walls() const;

  const Picture& picture_;
  Parts parts_;
  const Canvas& canvas_;
  Vec2 origin_;
  const Execution& execution_;
  const Write& write_;
  bool is_first_ = true;
};

void PageLayers::all() {
  write_(",\"layers\":[");
  for (const PictureLayer& one : picture_.layers) {
    if (one.part == Part::world && parts_.has(one.part) && !one.lines.empty()) layer(one);
  }
  if (parts_.has(Part::world) && !picture_.scene.polygons.empty()) polygons();
  for (const PictureLayer& one : picture_.layers) {
    if (one.part != Part::world && parts_.has(one.part) && !one.lines.empty()) layer(one);
  }
  if (parts_.has(Part::world)) walls();
  if (picture_.solids != nullptr && !moves_arm(picture_, parts_)) perspective(*picture_.solids);
  write_("]");
}

void PageLayers::polygons() {
  const std::vector<ScenePolygon>& all = picture_.scene.polygons;
  begin_layer({{"id", "polygons"},
               {"label", "obstacles"},
               {"kind", "areas"},
               {"obstacle", true},
               {"color", css_color(colors::polygon)},
               {"outline", css_color(colors::outline)},
               {"width", widths::outline}});
  auto first = numbers<std::uint32_t>("first");
  std::size_t corners = 0;
  first.add(corners);
  for (const ScenePolygon& polygon : all) first.add(corners += anticlockwise(polygon.corners).size());
  first.end();
  auto xy = numbers<float>("xy");
  for (const ScenePolygon& polygon : all) {
    for (const Vec2 p : anticlockwise(polygon.corners)) xy.add(moved(p));
  }
  xy.end();
  write_("}");
}

void PageLayers::layer(const PictureLayer& layer) {
  Json about{{"id", layer.id},
             {"label", layer.label.empty() ? layer.id : layer.label},
             {"kind", layer.fill ? "areas" : "chains"},
             {"obstacle", layer.part == Part::world && layer.fill && layer.blocks},
             {"color", css_color(layer.fill.value_or(layer.color))},
             {"width", layer.width},
             {"closed", layer.closed},
             {"opacity", layer.opacity}};
  if (layer.fill && layer.width > 0.0) about["outline"] = css_color(layer.color);
  if (!layer.opacities.empty()) about["opacities"] = layer.opacities;
  begin_layer(about);
  std::vector<std::uint32_t> first{0};
  auto xy = numbers<float>("xy");
  for (std::size_t i = 0; i < layer.lines.size(); ++i) {
    const std::vector<Vec2> chain = without_arcs(layer.lines[i], layer.turns_of(i));
    for (const Vec2 p : chain) xy.add(moved(p));
    first.push_back(first.back() + static_cast<std::uint32_t>(chain.size()));
  }
  xy.end();
  auto starts = numbers<std::uint32_t>("first");
  for (const std::uint32_t corner : first) starts.add(corner);
  starts.end();
  write_("}");
}

void PageLayers::walls() {
  const std::size_t count = picture_.scene.walls.size();
  if (count == 0 && !picture_.scene.bounds) return;
  Json about{{"id", "walls"},
             {"label", picture_.scene.map         ? "borders of blocked cells"
                       : count == 0               ? "bounds"
                       : count > most_drawn_walls ? "walls, as pixels"
                                                  : "walls"},
             {"obstacle", picture_.panels.empty()},
             {"color", css_color(colors::wall)},
             {"width", widths::wall}};
  if (count > most_drawn_walls) {
    about["count"] = count;
    begin_layer(about);
    return wall_image();
  }
  about["kind"] = "segments";
  begin_layer(about);
  if (has_small_whole_walls()) {
    wall_ends<std::uint16_t>();
  } else {
    wall_ends<float>();
  }
  write_("}");
}

bool PageLayers::has_small_whole_walls() const {
  constexpr double most = 65535.0;
  const auto fits = [](double x) { return x >= 0.0 && x <= most && x == std::floor(x); };
  const auto all_fit = [&](Vec2 p) { return fits(moved(p).x) && fits(moved(p).y); };
  if (picture_.scene.bounds && !(all_fit(picture_.scene.bounds->min) && all_fit(picture_.scene.bounds->max)))
    return false;
  return picture_.scene.walls.visit([&](auto all) {
    for (const auto& wall : all) {
      if (!all_fit(wall.segment().a) || !all_fit(wall.segment().b)) return false;
    }
    return true;
  });
}

template <class T>
void PageLayers::wall_ends() {
  auto xy = numbers<T>("xy");
  const auto add = [&](Vec2 a, Vec2 b) {
    xy.add(moved(a));
    xy.add(moved(b));
  };
  picture_.scene.walls.visit([&](auto all) {
    for (const auto& wall : all) add(wall.segment().a, wall.segment().b);
  });
  if (picture_.scene.bounds) {
    const auto [low, high] = *picture_.scene.bounds;
    add(low, {high.x, low.y});
    add({high.x, low.y}, high);
    add(high, {low.x, high.y});
    add({low.x, high.y}, low);
  }
  xy.end();
}

void PageLayers::wall_image() {
  constexpr double most_pixels = 4096.0;
  constexpr double least_width = 0.2;
  constexpr std::size_t walls_a_poll = 1 << 14;
  const Box& box = canvas_.box;
  const double scale = most_pixels / std::max(box.width(), box.height());
  Mask mask(static_cast<std::size_t>(std::ceil(scale * box.width())),
            static_cast<std::size_t>(std::ceil(scale * box.height())), execution_);
  const auto at = [&](Vec2 p) { return Vec2{scale * (p.x - box.min.x), scale * (box.max.y - p.y)}; };
  const double width = std::max(widths::wall / 20.0 * scale * canvas_.unit, least_width);
  picture_.scene.walls.visit([&](auto all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i % walls_a_poll == 0) execution_.check();
      mask.draw_line(at(all[i].segment().a), at(all[i].segment().b), width);
    }
  });
  const Vec2 top_left = moved({box.min.x, box.max.y});
  const double width_seen = static_cast<double>(mask.width()) / scale;
  const double height_seen = static_cast<double>(mask.height()) / scale;
  image_in({{top_left.x, top_left.y - height_seen}, {top_left.x + width_seen, top_left.y}},
           [&](const Write& write) { write_png_file(mask, colors::wall, execution_, write); });
}

/// Of an arm that doesn't move there; the page's script draws the others.
void PageLayers::perspective(const SolidView& view) {
  constexpr std::size_t pixels = 1024;
  begin_layer({{"id", "perspective"}, {"label", "perspective"}, {"isOpaque", true}});
  const double scale = static_cast<double>(pixels) / std::max(view.box.width(), view.box.height());
  const Image image = draw_solids(view, parts_, static_cast<std::size_t>(std::ceil(scale * view.box.width())),
                                  static_cast<std::size_t>(std::ceil(scale * view.box.height())), execution_);
  constexpr double dots_an_inch = 96.0;
  image_in({moved(view.box.min), moved(view.box.max)},
           [&](const Write& write) { write_png_file(image, dots_an_inch, execution_, write); });
}

/// The rest of a layer that has begun: an image, the page's numbers for its place.
template <class WritePng>
void PageLayers::image_in(const Box& box, const WritePng& write_png) {
  write_(fmt::format(",\"kind\":\"image\",\"box\":[{},{},{},{}],\"href\":\"data:image/png;base64,", box.min.x,
                     box.min.y, box.max.x, box.max.y));
  Base64 out(write_);
  write_png([&](std::string_view bytes) { out.write(bytes); });
  out.end();
  write_("\"}");
}

}  // namespace

std::string css_color(Rgb c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

std::string in_script(std::string_view json) {
  std::string safe;
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::vector<std::string> write_page_layers(const Picture& picture, Parts parts, const Canvas& canvas, Vec2 origin,
                                           const Execution& execution, const Write& write) {
  PageLayers(picture, parts, canvas, origin, execution, write).all();
  if (!parts.has(Part::world) || picture.scene.walls.size() <= most_drawn_walls) return {};
  return {"as pixels, being so many: walls"};
}

}  // namespace warren
