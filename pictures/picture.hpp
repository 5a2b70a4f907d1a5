// SPDX-License-Identifier: BSD-3-Clause
// What a picture shows, and the colours and widths that SVG and PNG share.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"
#include "pictures/svg_animation.hpp"
#include "planners/roadmap/planned_roadmap.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

struct Rgb {
  std::uint8_t red, green, blue;
};

/// Lines that a planner adds to a picture: cells, a visibility graph, a medial axis, bodies along a path.
struct PictureLayer {
  std::string id;  ///< the SVG group's
  Rgb color;
  double width;         ///< multiples of Canvas::unit
  PolygonSet lines;     ///< each a chain of points
  bool closed = false;  ///< the chains are outlines
  bool filled = false;  ///< the chains are outlines whose insides are drawn, without lines; they do not overlap
  /// The turn of the arc that leads to each corner of `lines`, anticlockwise, at most a half turn; 0: a straight.
  /// Empty: all are straight.
  std::vector<double> turns = {};

  std::span<const double> turns_of(std::size_t line) const {
    if (turns.empty()) return {};
    return std::span(turns).subspan(lines.first[line], lines.first[line + 1] - lines.first[line]);
  }
};

/// The points with arcs cut into chords that turn by some degrees; turns as in PictureLayer.
std::vector<Vec2> without_arcs(std::span<const Vec2> points, std::span<const double> turns);

/// Radius of the arc that turns by `turn` over a chord.
double arc_radius(Vec2 from, Vec2 to, double turn);

/// Refers to what it shows; all of it must outlive the picture.
struct Picture {
  const Scene& scene;
  const PlannedRoadmap<Vec2>* roadmap = nullptr;  ///< nullptr: none
  std::span<const PictureLayer> layers = {};
  std::span<const Vec2> path = {};
  std::span<const double> path_turns = {};  ///< as PictureLayer::turns
  std::optional<Vec2> start = {};
  std::optional<Vec2> goal = {};
  std::string title = {};
  std::string description = {};
  const MovingBody* moving = nullptr;  ///< SVG only: moves along the path; nullptr: nothing does
};

/// Colours by role; a roadmap component takes the colour of its rank.
namespace colors {
inline constexpr Rgb paper{255, 255, 255};
inline constexpr Rgb wall{30, 41, 59};
inline constexpr Rgb polygon{203, 213, 225};
inline constexpr Rgb outline{100, 116, 139};  ///< of polygons
inline constexpr Rgb search_tree{250, 190, 96};
inline constexpr Rgb path{225, 29, 72};
inline constexpr Rgb start{22, 163, 74};
inline constexpr Rgb goal{124, 58, 237};
inline constexpr Rgb layer{147, 187, 241};         ///< a planner's lines
inline constexpr Rgb second_layer{150, 211, 168};  ///< and others
inline constexpr Rgb wrong{249, 115, 22};          ///< what should not be there
/// The last is for all components that have no colour of their own.
inline constexpr std::array<Rgb, 9> components{{{147, 187, 241},
                                                {244, 178, 148},
                                                {150, 211, 168},
                                                {205, 176, 235},
                                                {240, 208, 126},
                                                {142, 208, 214},
                                                {240, 170, 200},
                                                {190, 200, 140},
                                                {200, 206, 214}}};
}  // namespace colors

/// Widths in multiples of Canvas::unit.
namespace widths {
inline constexpr double wall = 0.11;
inline constexpr double outline = 0.05;
inline constexpr double milestone = 0.16;
inline constexpr double edge = 0.05;
inline constexpr double search_tree = 0.07;
inline constexpr double path = 0.2;
inline constexpr double halo = 0.32;
inline constexpr double mark = 0.38;  ///< radius
}  // namespace widths

/// The part of the world that is shown, and what counts as one unit there: a maze's cell (less in small ones), else a
/// fortieth of the extent.
struct Canvas {
  Box box;  ///< margin included
  double unit = 1.0;
};
Canvas canvas_of(const Picture& picture, const Execution& execution);

/// For each vertex the index of its colour in colors::components: the largest components have colours of their own.
/// Throws Stopped.
std::vector<std::uint8_t> component_colors(const Graph& graph, const Execution& execution);

using Write = std::function<void(std::string_view)>;

/// One SVG 1.1 document: layers polygons, walls, edges, milestones, search_tree, path, start and goal as groups of
/// these ids, y up.
void write_svg(const Picture& picture, const Execution& execution, const Write& write);
/// A page of its own with the SVG inline; drag moves, the wheel zooms.
void write_html(const Picture& picture, const Execution& execution, const Write& write);
/// The same picture in pixels, at most 4096 a side: what is smaller than a pixel becomes a shade, the path stays
/// strong.
void write_png(const Picture& picture, const Execution& execution, const Write& write);

/// ".svg" of "a.SVG", in lower case; "" where there is none.
std::string ending_of(const std::string& file);

/// By the file's ending: .png, .html, and SVG for all others. Throws WriteError, Stopped.
void write_picture(const std::string& file, const Picture& picture, const Execution& execution);

}  // namespace warren
