// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/formats/ring_lists_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_growth.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/growing_walls.hpp"
#include "scenes/text/scene_text.hpp"
#include "scenes/text/text_lines.hpp"
#include "spatial/obstacles/polygon_index.hpp"

namespace warren {
namespace {

using scene_text::Fields;

/// The first bytes without a byte order mark.
std::string_view head_of(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  return bytes.substr(0, bytes_that_tell);
}

bool is_environment(std::string_view bytes) {
  bytes = head_of(bytes);
  const std::size_t at = bytes.find_first_not_of(" \t\r\n");
  return at != std::string_view::npos && bytes.substr(at).starts_with("//");
}

bool is_polymap(std::string_view bytes) {
  bytes = head_of(bytes);
  return bytes.starts_with("poly\n") || bytes.starts_with("poly\r") || bytes.starts_with("poly ");
}

using Rings = std::vector<ScenePolygon>;

/// Lines of two numbers; others end a ring.
Rings rings_of_lines(const InputFile& file, const Execution& execution) {
  Rings rings;
  bool open = false;
  TextLines lines(file, execution);
  while (lines.next()) {
    Fields fields = lines.fields();
    const bool goes_on = std::exchange(open, fields.number_follows());
    if (!open) continue;
    if (!goes_on) push_asked(rings, {{}, lines.number()}, execution);
    const double x = fields.number();
    push_asked(rings.back().corners, {x, fields.number()}, execution);
    if (!fields.done()) fields.place().fail("expected two numbers a line", lines.line());
  }
  return rings;
}

/// Numbers one after the other, wherever the lines end.
class NumberStream {
 public:
  NumberStream(const InputFile& file, const Execution& execution) : lines_(file, execution) {}
  std::size_t line() const { return lines_.number(); }
  std::string_view word() { return fields().word(); }
  double number() { return fields().number(); }
  std::size_t count(std::string_view what, double least) {
    const double value = number();
    if (!(value >= least && value < 4294967296.0) || value != std::floor(value)) {
      fail(fmt::format("expected {}, a whole number of at least {}", what, least), fmt::format("{}", value));
    }
    return static_cast<std::size_t>(value);
  }
  [[noreturn]] void fail(std::string_view what, std::string_view found) const { lines_.place().fail(what, found); }
  bool done() { return !next_line(); }

 private:
  Fields& fields() {
    if (!next_line()) fail("expected more numbers", "the end of the file");
    return *fields_;
  }
  bool next_line() {
    while (!fields_ || fields_->done()) {
      if (!lines_.next()) return false;
      fields_.emplace(lines_.fields());
    }
    return true;
  }

  TextLines lines_;
  std::optional<Fields> fields_;
};

Rings rings_of_polymap(const InputFile& file, const Execution& execution) {
  NumberStream numbers(file, execution);
  numbers.word();
  if (numbers.count("the version 1", 1) != 1) numbers.fail("expected the version 1 of a polymap", "another");
  const std::size_t count = numbers.count("the number of rings", 1);
  constexpr std::size_t corners_a_look = 1 << 14;
  Rings rings;
  while (rings.size() < count) {
    const std::size_t corners = numbers.count("the number of a ring's corners", 3);
    push_asked(rings, {{}, numbers.line()}, execution);
    for (std::size_t i = 0; i < corners; ++i) {
      if (i % corners_a_look == 0) execution.check();
      const double x = numbers.number();
      push_asked(rings.back().corners, {x, numbers.number()}, execution);
    }
  }
  if (!numbers.done()) numbers.fail(fmt::format("expected the end after {} rings", count), "more");
  return rings;
}

void add_walls(const ScenePolygon& ring, WallCollector& walls) {
  for (std::size_t i = 0; i < ring.corners.size(); ++i) {
    const Vec2 a = ring.corners[i];
    const Vec2 b = ring.corners[i + 1 < ring.corners.size() ? i + 1 : 0];
    if (!(a == b)) walls.add(a.x, a.y, b.x, b.y);
  }
}

/// In how many rings does a corner lie that is on no other ring's outline? All corners of a ring must agree.
std::size_t depth_of(const PolygonIndex& rings, std::size_t ring, const Scene& scene) {
  std::optional<std::size_t> depth;
  for (const Vec2 p : rings.polygons()[ring]) {
    std::size_t around = 0;
    bool on_outline = false;
    rings.for_each_polygon_near({p, p}, [&](std::uint32_t other) {
      const PolygonSide side = other == ring ? PolygonSide::outside : rings.side_of(other, p);
      around += side == PolygonSide::inside ? 1 : 0;
      on_outline = on_outline || side == PolygonSide::on_outline;
      return true;
    });
    if (on_outline) continue;
    if (depth && *depth != around) throw InputError(place_of_polygon(scene, ring), "this ring crosses another one");
    depth = around;
  }
  return depth.value_or(0);
}

/// Outermost rings are walls, those just inside obstacles; what lies deeper is inside an obstacle.
void sort_by_depth(Scene& scene, const Execution& execution) {
  const PolygonIndex rings(plane_obstacles(scene, execution).polygons, execution);
  WallCollector walls(execution);
  Rings obstacles;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    if (i % 256 == 0) execution.check();
    const std::size_t depth = depth_of(rings, i, scene);
    if (depth == 0) add_walls(scene.polygons[i], walls);
    if (depth == 1) obstacles.push_back(scene.polygons[i]);
  }
  scene.polygons = std::move(obstacles);
  scene.walls = walls.take();
}

}  // namespace

bool is_ring_list(std::string_view bytes) { return is_environment(bytes) || is_polymap(bytes); }

Scene read_ring_list(const InputFile& file, const Execution& execution) {
  Scene scene;
  scene.source = file.name();
  const bool polymap = is_polymap(file.bytes());
  scene.polygons = polymap ? rings_of_polymap(file, execution) : rings_of_lines(file, execution);
  if (scene.polygons.empty()) throw InputError(file.name(), "there is no ring in it; expected lines `X Y`");
  if (polymap) {
    sort_by_depth(scene, execution);
  } else if (is_environment(file.bytes())) {
    check_polygons(scene, execution);
    WallCollector walls(execution);
    add_walls(scene.polygons.front(), walls);
    scene.polygons.erase(scene.polygons.begin());
    scene.walls = walls.take();
  }
  return scene;
}

}  // namespace warren
