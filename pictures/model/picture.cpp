// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "planners/graph/assemble_graph.hpp"

namespace warren {

void PictureOptions::validate() const {
  struct Range {
    double low, high;
    bool holds(double value) const { return value >= low && value <= high; }
  };
  constexpr Range dpis{10.0, 2400.0};
  if (dpi && !dpis.holds(*dpi)) {
    throw UsageError(fmt::format("@dpi: from {} to {} (found: {})", dpis.low, dpis.high, *dpi));
  }
  if (!size) return;
  const Range sides = size->unit == LengthUnit::mm ? Range{10.0, 5000.0} : Range{40.0, 20'000.0};
  for (const double side : {size->width, size->height}) {
    if (sides.holds(side)) continue;
    throw UsageError(
        fmt::format("@size: a side is from {} to {} {} (found: {})", sides.low, sides.high, name_of(size->unit), side));
  }
}

Canvas canvas_of(const Picture& picture, const Execution& execution) {
  Canvas canvas;
  const auto known = picture.scene.map ? known_part(*picture.scene.map, execution) : std::nullopt;
  const Box all = obstacle_box(picture.scene, execution);
  if (known) canvas.whole = all;
  canvas.box = known.value_or(all);
  if (picture.scene.bounds) canvas.box.include(*picture.scene.bounds);
  const auto include = [&](std::span<const Vec2> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      execution.poll(i + 1);
      canvas.box.include(points[i]);
    }
  };
  for (const PictureLayer& layer : picture.layers) {
    if (known && layer.part == Part::world) continue;  // all of the map's cells
    include(layer.lines.corners);
  }
  for (const AxesPanel& panel : picture.panels) canvas.box.include(panel.box);
  if (picture.path_turns.empty()) include(picture.path);
  if (!picture.path_turns.empty()) include(without_arcs(picture.path, picture.path_turns));
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
        chain.push_back(center + Rotation(turn * part / parts)(from));
      }
    }
    chain.push_back(points[i]);
  }
  return chain;
}

std::vector<std::uint8_t> component_ranks(std::span<const VertexId> labels, std::uint8_t own,
                                          const Execution& execution) {
  const auto for_each = [&](const auto& visit) {
    for (VertexId v = 0; v < labels.size(); ++v) {
      execution.poll(v);
      visit(v);
    }
  };
  execution.reserve(labels.size() * (sizeof(std::uint32_t) + sizeof(std::uint8_t)));
  std::vector<std::uint32_t> size(labels.size(), 0);
  for_each([&](VertexId v) { ++size[labels[v]]; });
  const auto is_before = [&](VertexId a, VertexId b) { return size[a] != size[b] ? size[a] > size[b] : a < b; };
  std::vector<VertexId> largest;
  for_each([&](VertexId v) {
    if (size[v] < 2 || (largest.size() == own && is_before(largest.back(), v))) return;
    largest.insert(std::ranges::upper_bound(largest, v, is_before), v);
    if (largest.size() > own) largest.pop_back();
  });
  std::vector<std::uint8_t> ranks(labels.size(), own);
  for (std::size_t rank = 0; rank < largest.size(); ++rank) ranks[largest[rank]] = static_cast<std::uint8_t>(rank);
  for_each([&](VertexId v) { ranks[v] = ranks[labels[v]]; });  // a label comes before the others of its component
  return ranks;
}

std::vector<std::uint8_t> component_colors(const Graph& graph, const Execution& execution) {
  return component_ranks(components(graph, execution).label, colors::components.size() - 1, execution);
}

std::vector<Vec2> mark_outline(MarkShape shape, double radius) {
  if (shape == MarkShape::front) return {{radius, 0.0}, {-0.7 * radius, radius}, {-0.7 * radius, -radius}};
  const bool is_star = shape == MarkShape::star;
  const std::size_t corners = is_star ? 10 : 32;
  constexpr double star_reach = 1.35;
  constexpr double star_waist = 0.58;
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) / static_cast<double>(corners) + 0.25);
    const double r = radius * (!is_star ? 1.0 : i % 2 == 0 ? star_reach : star_waist);
    outline.push_back({r * portable::cos(angle), r * portable::sin(angle)});
  }
  return outline;
}

std::vector<Vec2> circle_outline(Vec2 middle, double radius, int corners) {
  std::vector<Vec2> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    outline.push_back(middle + Vec2{radius * portable::cos(angle), radius * portable::sin(angle)});
  }
  return outline;
}

std::optional<Box> known_part(const OccupancyMap& map, const Execution& execution) {
  if (map.unknown.empty()) return std::nullopt;
  Box known;  // columns and rows of cells, from the first to the last that is known
  const std::uint32_t tail = map.unknown.width() % Bitmap::word_bits;
  for (std::uint32_t y = 0; y < map.unknown.height(); ++y) {
    execution.check();
    const auto words = map.unknown.row(y);
    for (std::size_t w = 0; w < words.size(); ++w) {
      const bool is_cut = tail != 0 && w + 1 == words.size();
      const std::uint64_t bits = ~words[w] & (is_cut ? (std::uint64_t{1} << tail) - 1 : ~std::uint64_t{0});
      if (bits == 0) continue;
      const auto first = static_cast<double>(w * Bitmap::word_bits);
      known.include(Vec2{first + std::countr_zero(bits), 1.0 * y});
      known.include(Vec2{first + std::bit_width(bits) - 1.0, 1.0 * y});
    }
  }
  if (known.empty()) return std::nullopt;
  constexpr double share = 1.0 / 40.0;
  const double margin = std::max(2.0, share * (std::max(known.width(), known.height()) + 1.0));
  const Vec2 low{std::max(known.min.x - margin, 0.0), std::max(known.min.y - margin, 0.0)};
  const Vec2 high{std::min(known.max.x + 1.0 + margin, static_cast<double>(map.width())),
                  std::min(known.max.y + 1.0 + margin, static_cast<double>(map.height()))};
  constexpr double most = 0.9;
  if (high.x - low.x > most * map.width() && high.y - low.y > most * map.height()) return std::nullopt;
  return world_box(map, {low, high});
}

std::vector<Vec2> part_in_box(std::span<const Vec2> outline, const Box& box) {
  std::vector<Vec2> part(outline.begin(), outline.end());
  const auto cut = [&part](const auto& depth) {  // >= 0 inside
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec2 a = part[i];
      const Vec2 b = part[(i + 1) % part.size()];
      if (depth(a) >= 0.0) kept.push_back(a);
      if ((depth(a) < 0.0) != (depth(b) < 0.0)) kept.push_back(a + depth(a) / (depth(a) - depth(b)) * (b - a));
    }
    part = std::move(kept);
  };
  cut([&](Vec2 p) { return p.x - box.min.x; });
  cut([&](Vec2 p) { return box.max.x - p.x; });
  cut([&](Vec2 p) { return p.y - box.min.y; });
  cut([&](Vec2 p) { return box.max.y - p.y; });
  return part;
}

}  // namespace warren
