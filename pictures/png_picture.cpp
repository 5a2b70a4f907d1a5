// SPDX-License-Identifier: BSD-3-Clause
// The picture in pixels: the layers and colours of the SVG, drawn by our own rasteriser. A unit has 24 pixels; the
// longer side has 1000 to 4096. Where a unit is less than a few pixels the roadmap is left out, walls add up to shades,
// and path and marks keep a least width in pixels.
#include <algorithm>
#include <cmath>

#include "pictures/picture.hpp"
#include "pictures/raster.hpp"

namespace warren {
namespace {

constexpr double most_pixels = 4096.0;
constexpr double least_pixels = 1000.0;
constexpr double pixels_a_unit = 24.0;

/// Pixels a world unit.
double scale_of(const Canvas& canvas) {
  const double side = std::max(canvas.box.width(), canvas.box.height());
  return std::clamp(pixels_a_unit / canvas.unit, least_pixels / side, most_pixels / side);
}

class PngPainter {
 public:
  PngPainter(const Picture& picture, const Execution& execution)
      : picture_(picture),
        execution_(execution),
        canvas_(canvas_of(picture, execution)),
        scale_(scale_of(canvas_)),
        image_(pixels(canvas_.box.width()), pixels(canvas_.box.height()), colors::paper, execution) {}

  const Image& paint() {
    constexpr double readable_roadmap = 6.0;  // pixels a unit
    polygons();
    for (const PictureLayer& layer : picture_.layers) lines(layer);
    if (picture_.roadmap != nullptr && unit() >= readable_roadmap) roadmap();
    walls();
    path();
    mark(picture_.start, colors::start);
    mark(picture_.goal, colors::goal);
    return image_;
  }

 private:
  void polygons();
  void lines(const PictureLayer& layer);
  void fill(const PictureLayer& layer);
  void roadmap();
  void walls();
  void path();
  void mark(std::optional<Vec2> at, Rgb color);

  std::size_t pixels(double length) const {
    return static_cast<std::size_t>(std::clamp(std::ceil(length * scale_), 1.0, most_pixels));
  }
  double unit() const { return scale_ * canvas_.unit; }
  Vec2 at(Vec2 p) const { return {scale_ * (p.x - canvas_.box.min.x), scale_ * (canvas_.box.max.y - p.y)}; }
  void line(Vec2 a, Vec2 b, double width, Rgb color) {
    constexpr std::uint64_t batch = 64;  // each may run across the whole picture
    if (++drawn_ % batch == 0) execution_.check();
    image_.draw_line(at(a), at(b), width, color);
  }

  const Picture& picture_;
  const Execution& execution_;
  Canvas canvas_;
  double scale_;  // pixels a world unit
  Image image_;
  std::uint64_t drawn_ = 0;
};

void PngPainter::polygons() {
  std::vector<Vec2> outline;
  for (const ScenePolygon& polygon : picture_.scene.polygons) {
    outline.clear();
    for (const Vec2 p : polygon.corners) outline.push_back(at(p));
    image_.fill(outline, colors::polygon, execution_);
    const double width = widths::outline * unit();
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      line(polygon.corners[i], polygon.corners[i + 1 < polygon.corners.size() ? i + 1 : 0], width, colors::outline);
    }
  }
}

void PngPainter::fill(const PictureLayer& layer) {
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < layer.lines.size(); ++i) {
    outline.clear();
    for (const Vec2 p : layer.lines[i]) outline.push_back(at(p));
    image_.fill(outline, layer.color, execution_);
  }
}

void PngPainter::lines(const PictureLayer& layer) {
  if (layer.filled) return fill(layer);
  for (std::size_t i = 0; i < layer.lines.size(); ++i) {
    const std::vector<Vec2> chain = without_arcs(layer.lines[i], layer.turns_of(i));
    for (std::size_t k = 1; k < chain.size(); ++k) line(chain[k - 1], chain[k], layer.width * unit(), layer.color);
    if (layer.closed && chain.size() > 2) line(chain.back(), chain.front(), layer.width * unit(), layer.color);
  }
}

void PngPainter::walls() {
  // Thin walls are drawn stronger than their width, or a large maze would fade; tiny cells stay a light texture.
  const double width = std::max(widths::wall * unit(), std::clamp(0.3 * unit(), 0.2, 1.0));
  picture_.scene.walls.visit([&](auto all) {
    for (const auto& wall : all) {
      const Segment s = wall.segment();
      line(s.a, s.b, width, colors::wall);
    }
  });
  if (!picture_.scene.bounds) return;
  const auto [low, high] = *picture_.scene.bounds;
  const Vec2 corners[] = {low, {high.x, low.y}, high, {low.x, high.y}, low};
  for (int i = 0; i < 4; ++i) line(corners[i], corners[i + 1], width, colors::wall);
}

void PngPainter::roadmap() {
  const PlannedRoadmap<Vec2>& roadmap = *picture_.roadmap;
  const std::vector<std::uint8_t> color = component_colors(roadmap.graph, execution_);
  if (color.size() != roadmap.states.size()) return;  // stopped before the graph was made
  for (VertexId v = 0; v < color.size(); ++v) {
    for (const VertexId w : roadmap.graph.neighbours(v)) {
      if (v < w) line(roadmap.states[v], roadmap.states[w], widths::edge * unit(), colors::components[color[v]]);
    }
  }
  for (const Edge& edge : roadmap.search_tree) {
    if (edge.to == no_vertex) continue;
    line(roadmap.states[edge.from], roadmap.states[edge.to], widths::search_tree * unit(), colors::search_tree);
  }
  for (VertexId v = 0; v < color.size(); ++v) {
    line(roadmap.states[v], roadmap.states[v], widths::milestone * unit(), colors::components[color[v]]);
  }
}

void PngPainter::path() {
  if (picture_.path.empty()) return;
  const double width = std::max(widths::path * unit(), unit() < 2.0 ? 3.0 : 2.0);
  const double halo = std::max(widths::halo * unit(), width + 1.5);
  const std::vector<Vec2> path = without_arcs(picture_.path, picture_.path_turns);
  const auto polyline = [&](double w, Rgb color) {
    line(path[0], path[0], w, color);
    for (std::size_t i = 1; i < path.size(); ++i) line(path[i - 1], path[i], w, color);
  };
  polyline(halo, colors::paper);
  polyline(width, colors::path);
}

void PngPainter::mark(std::optional<Vec2> at, Rgb color) {
  if (!at) return;
  constexpr double least_part = 1.0 / 120.0;  // of the picture's longer side
  const double side = static_cast<double>(std::max(image_.width(), image_.height()));
  const double width = std::max(2.0 * widths::mark * unit(), least_part * side);
  line(*at, *at, width * 1.3, colors::paper);
  line(*at, *at, width, color);
}

}  // namespace

void write_png(const Picture& picture, const Execution& execution, const Write& write) {
  PngPainter painter(picture, execution);
  write_png_image(painter.paint(), execution, write);
}

}  // namespace warren
