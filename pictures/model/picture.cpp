// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/trigonometry.hpp"
#include "parallel/components.hpp"
#include "pictures/model/known_part.hpp"

namespace warren {

Canvas canvas_of(const Picture& picture, const Execution& execution) {
  Canvas canvas;
  const auto known = picture.scene.map ? known_part(*picture.scene.map, execution) : std::nullopt;
  const Box all = obstacle_box(picture.scene, execution);
  if (known) canvas.whole = all;
  canvas.box = known.value_or(all);
  if (picture.scene.bounds) canvas.box.include(*picture.scene.bounds);
  for (const PictureLayer& layer : picture.layers) {
    if (known && layer.part == Part::world) continue;  // all of the map's cells
    for (const Vec2 p : layer.lines.corners) canvas.box.include(p);
  }
  for (const AxesPanel& panel : picture.panels) canvas.box.include(panel.box);
  for (const Vec2 p : without_arcs(picture.path, picture.path_turns)) canvas.box.include(p);
  if (picture.start) canvas.box.include(*picture.start);
  if (picture.goal) canvas.box.include(*picture.goal);
  if (canvas.box.empty()) canvas.box = {{0, 0}, {1, 1}};
  double extent = std::max(canvas.box.width(), canvas.box.height());
  if (!(extent > 0.0)) {
    canvas.box = canvas.box.grown(0.5);
    extent = 1.0;
  }
  canvas.unit = picture.scene.maze ? 1.0 : extent / 40.0;
  return canvas;
}

double arc_radius(Vec2 from, Vec2 to, double turn) {
  return 0.5 * distance(from, to) / std::abs(portable::sin(0.5 * turn));
}

std::vector<Vec2> without_arcs(std::span<const Vec2> points, std::span<const double> turns) {
  constexpr double step_rad = std::numbers::pi / 45.0;
  std::vector<Vec2> chain;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double turn = i == 0 || turns.empty() ? 0.0 : turns[i];
    const double parts = std::ceil(std::abs(turn) / step_rad);
    if (parts > 1.0) {
      // Left of the chord by the arc's height over it, where the arc turns left.
      const Vec2 chord = points[i] - points[i - 1];
      const double half_cotangent = 0.5 / portable::tan(0.5 * turn);
      const Vec2 center = points[i - 1] + 0.5 * chord + half_cotangent * Vec2{-chord.y, chord.x};
      const Vec2 from = points[i - 1] - center;
      for (double part = 1.0; part < parts; part += 1.0) {
        const double c = portable::cos(turn * part / parts);
        const double s = portable::sin(turn * part / parts);
        chain.push_back(center + Vec2{c * from.x - s * from.y, s * from.x + c * from.y});
      }
    }
    chain.push_back(points[i]);
  }
  return chain;
}

std::vector<std::uint8_t> component_colors(const Graph& graph, const Execution& execution) {
  const Components parts = components(graph, execution);
  std::vector<std::uint32_t> size(graph.vertex_count(), 0);
  for (const VertexId label : parts.label) ++size[label];
  execution.check();
  std::vector<VertexId> largest;
  for (VertexId v = 0; v < graph.vertex_count(); ++v) {
    if (size[v] > 1) largest.push_back(v);
  }
  execution.check();
  constexpr std::size_t own = colors::components.size() - 1;
  const std::size_t ranked = std::min(own, largest.size());
  std::partial_sort(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(ranked), largest.end(),
                    [&](VertexId a, VertexId b) { return size[a] != size[b] ? size[a] > size[b] : a < b; });
  std::vector<std::uint8_t> color_of_label(graph.vertex_count(), static_cast<std::uint8_t>(own));
  for (std::size_t rank = 0; rank < ranked; ++rank) color_of_label[largest[rank]] = static_cast<std::uint8_t>(rank);
  std::vector<std::uint8_t> color(graph.vertex_count());
  std::transform(parts.label.begin(), parts.label.end(), color.begin(),
                 [&](VertexId label) { return color_of_label[label]; });
  return color;
}

}  // namespace warren
