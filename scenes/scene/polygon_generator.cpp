// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene/polygon_generator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/base/trigonometry.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr std::size_t polygon_grain = 1024;
constexpr std::uint32_t most_random_corners = 12;
constexpr double turn = 2.0 * std::numbers::pi;

/// One number after the other from the stream of a polygon.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t polygon) : seed_(seed), polygon_(polygon) {}
  double from(double low, double high) { return low + (high - low) * uniform(seed_, polygon_, axis_++); }

 private:
  std::uint64_t seed_;
  std::uint64_t polygon_;
  std::uint64_t axis_ = 0;
};

/// Corners around a middle, within radius 1.
using Shape = std::vector<Vec2>;

Vec2 at_angle(double angle, double radius) {
  const auto [sine, cosine] = portable::sin_and_cos(angle);
  return {radius * cosine, radius * sine};
}

/// One corner in each of n equal parts of a turn: apart enough for rounding, never half a turn apart but in triangles.
/// All as far from the middle, or each at a distance of its own.
Shape star(std::size_t n, bool is_convex, Dice& dice) {
  Shape shape(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = turn * (static_cast<double>(i) + dice.from(0.0, 0.85)) / static_cast<double>(n);
    shape[i] = at_angle(angle, is_convex ? 1.0 : dice.from(0.35, 1.0));
  }
  return shape;
}

/// Along the outer rim and back along the inner one.
Shape crescent(std::size_t n, Dice& dice) {
  const std::size_t outer = n / 2;
  const double extent = turn * dice.from(0.5, 0.8);
  const double begin = dice.from(0.0, turn);
  const double inner_radius = dice.from(0.4, 0.55);
  Shape shape(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool on_rim = i < outer;
    const std::size_t of_rim = on_rim ? outer : n - outer;
    const std::size_t step = on_rim ? i : n - 1 - i;
    const double angle = begin + extent * static_cast<double>(step) / static_cast<double>(of_rim - 1);
    shape[i] = at_angle(angle, on_rim ? 1.0 : inner_radius);
  }
  return shape;
}

/// A third of each kind; a star of three corners could lie on one line, and crescents need corners enough to be bent.
Shape shape_of(std::size_t n, Dice& dice) {
  constexpr std::size_t fewest_for_crescent = 11;
  const double kind = dice.from(0.0, 3.0);
  if (kind < 2.0 || n < fewest_for_crescent) return star(n, kind < 1.0 || n == 3, dice);
  return crescent(n, dice);
}

double rounded(double x) { return std::round(x * 1024.0) / 1024.0; }

/// Squares in rows, as many as there are polygons; wide enough that corners stay apart when rounded.
struct Squares {
  explicit Squares(const PolygonOptions& options)
      : columns(static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(options.count))))),
        rows((options.count + columns - 1) / columns),
        side(std::ceil(std::max(8.0, 0.5 * options.corners.value_or(0)))) {}
  Vec2 low(std::uint64_t i) const {
    return {side * static_cast<double>(i % columns), side * static_cast<double>(i / columns)};
  }

  std::uint64_t columns;
  std::uint64_t rows;
  double side;
};

ScenePolygon polygon_in(const Squares& squares, const PolygonOptions& options, std::uint64_t i) {
  Dice dice(options.seed, i);
  const std::size_t n = options.corners
                            ? *options.corners
                            : static_cast<std::size_t>(3 + std::floor(dice.from(0.0, most_random_corners - 3 + 1)));
  const double radius = squares.side * dice.from(0.25, 0.45);
  const double room = 0.48 * squares.side - radius;  // two squares' polygons are at least a 25th of a side apart
  const Vec2 half{0.5 * squares.side, 0.5 * squares.side};
  const Vec2 middle = squares.low(i) + half + Vec2{dice.from(-room, room), dice.from(-room, room)};
  ScenePolygon polygon;
  polygon.corners = shape_of(n, dice);
  for (Vec2& corner : polygon.corners) {
    corner = {rounded(middle.x + radius * corner.x), rounded(middle.y + radius * corner.y)};
  }
  if (dice.from(0.0, 1.0) < 0.5) std::reverse(polygon.corners.begin(), polygon.corners.end());
  return polygon;
}

}  // namespace

void PolygonOptions::validate() const {
  constexpr std::uint64_t most_corners = std::uint64_t{1} << 31;
  const std::uint64_t each = corners.value_or(most_random_corners);
  if (count < 1) throw InputError("count", "must be at least 1", std::to_string(count));
  if (each < 3) throw InputError("corners", "must be at least 3", std::to_string(each));
  if (count >= most_corners || count * each >= most_corners) {
    throw InputError("count", "all polygons together must have fewer than 2^31 corners", std::to_string(count));
  }
}

Scene polygon_scene(const PolygonOptions& options, const Execution& execution) {
  options.validate();
  const Squares squares(options);
  Scene scene;
  execution.reserve(options.count *
                    (sizeof(ScenePolygon) + 32 + sizeof(Vec2) * options.corners.value_or(most_random_corners)));
  scene.polygons.resize(options.count);
  for_each_index(scene.polygons.size(), polygon_grain, execution,
                 [&](std::size_t i) { scene.polygons[i] = polygon_in(squares, options, i); });
  const double margin = 0.25 * squares.side;
  const Vec2 high{squares.side * static_cast<double>(squares.columns),
                  squares.side * static_cast<double>(squares.rows)};
  scene.bounds = Box{{-margin, -margin}, high + Vec2{margin, margin}};
  scene.start = {-0.5 * margin, -0.5 * margin};
  scene.goal = {high.x + 0.5 * margin, high.y + 0.5 * margin};
  scene.robot = RobotSpec{};
  return scene;
}

}  // namespace warren
