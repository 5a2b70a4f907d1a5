// SPDX-License-Identifier: BSD-3-Clause
// Lists of rings, as three kinds of files have them. Rings may be open or closed, of either orientation.
//  - VisiLibity's .environment: lines `X Y`, each ring introduced by a line that begins with `//`. The first ring is
//    the outer boundary: what lies outside of it is blocked. The others are holes in the free space: obstacles.
//  - A polymap: `poly`, `1`, the number of rings, then for each the number of its corners and the corners. Free is what
//    lies inside an odd number of rings, blocked all else, in the box of all rings too.
// An outer ring alone is made of walls where it runs along its box, and of obstacles that fill the box where it does
// not; of several the outside is one obstacle with holes (scenes/scene/plane_obstacles.hpp), a little larger than their
// box, as obstacles are with free islands inside.
//  - .poly: lines `X Y`; any other line (blank, `//`, `#`, END) ends a ring. Each ring is an obstacle.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/scene_text.hpp"
#include "spatial/obstacles/polygon_index.hpp"

namespace warren {
namespace {

using scene_text::Fields;

std::string_view head_of(std::string_view bytes) { return without_byte_order_mark(bytes).substr(0, bytes_that_tell); }

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
Rings rings_of_polymap(const InputFile& file, const Execution& execution) {
  TextLines lines(file, execution);
  std::optional<Fields> fields;
  const auto fail = [&](std::string_view what, std::string_view found) { lines.place().fail(what, found); };
  const auto done = [&] {
    while (!fields || fields->done()) {
      if (!lines.next()) return true;
      fields.emplace(lines.fields());
    }
    return false;
  };
  const auto next = [&]() -> Fields& {
    if (done()) fail("expected more numbers", "the end of the file");
    return *fields;
  };
  const auto count = [&](std::string_view what, double least) {
    const double value = next().number();
    if (!(value >= least && value < 4294967296.0) || value != std::floor(value)) {
      fail(fmt::format("expected {}, a whole number of at least {}", what, least), fmt::format("{}", value));
    }
    return static_cast<std::size_t>(value);
  };
  next().word();
  if (count("the version 1", 1) != 1) fail("expected the version 1 of a polymap", "another");
  const std::size_t ring_count = count("the number of rings", 1);
  Rings rings;
  while (rings.size() < ring_count) {
    const std::size_t corners = count("the number of a ring's corners", 3);
    push_asked(rings, {{}, lines.number()}, execution);
    for (std::size_t i = 0; i < corners; ++i) {
      execution.poll(i);
      const double x = next().number();
      push_asked(rings.back().corners, {x, next().number()}, execution);
    }
  }
  if (!done()) fail(fmt::format("expected the end after {} rings", ring_count), "more");
  return rings;
}

/// The side of the box that p lies on, anticlockwise from the lower one, without that side's end.
std::optional<int> side_of(const Box& box, Vec2 p) {
  if (p.y == box.min.y && p.x < box.max.x) return 0;
  if (p.x == box.max.x && p.y < box.max.y) return 1;
  if (p.y == box.max.y && p.x > box.min.x) return 2;
  if (p.x == box.min.x) return 3;
  return std::nullopt;
}

/// What is free lies inside the ring alone: its sides along its box are walls, and what the others leave of the box are
/// obstacles, each between two corners of the ring that lie on the box. O(corners).
void confine(Scene& scene, const ScenePolygon& ring, const Execution& execution) {
  const std::vector<Vec2> corners = anticlockwise(ring.corners);
  const std::size_t n = corners.size();
  const Box box = box_around(corners);
  const Vec2 box_corners[] = {{box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}, box.min};
  WallCollector walls(execution);
  std::size_t first = 0;
  while (!side_of(box, corners[first])) ++first;
  for (std::size_t from = first, to = first; from < first + n; from = to) {
    execution.poll(from);
    while (!side_of(box, corners[++to % n])) execution.poll(to);
    const Vec2 a = corners[from % n];
    const Vec2 b = corners[to % n];
    ScenePolygon rest{{a}, ring.line};
    for (int side = *side_of(box, a); side != *side_of(box, b); side = (side + 1) % 4) {
      if (!(box_corners[side] == b)) rest.corners.push_back(box_corners[side]);
    }
    const bool is_along = to == from + 1 && rest.corners.size() == 1;
    for (std::size_t i = to; i > from; --i) push_asked(rest.corners, corners[i % n], execution);
    if (is_along) {
      walls.add(a.x, a.y, b.x, b.y);
    } else {
      push_asked(scene.polygons, std::move(rest), execution);
    }
  }
  scene.walls = walls.take();
}

/// Calls f with each ring that a corner lies in; false: the corner is on the outline of one. Throws Stopped.
template <class F>
bool for_each_around(const PolygonIndex& rings, std::size_t ring, Vec2 corner, const Execution& execution, const F& f) {
  bool on_outline = false;
  std::size_t looked = 0;
  rings.for_each_polygon_near({corner, corner}, [&](std::uint32_t other) {
    execution.poll(looked++);
    const PolygonSide side = other == ring ? PolygonSide::outside : rings.side_of(other, corner);
    if (side == PolygonSide::inside) f(other);
    on_outline = on_outline || side == PolygonSide::on_outline;
    return true;
  });
  return !on_outline;
}

/// In how many rings does a corner lie that is on no other ring's outline? All corners of a ring must agree.
std::size_t depth_of(const PolygonIndex& rings, std::size_t ring, const Scene& scene, const Execution& execution) {
  std::optional<std::size_t> depth;
  for (const Vec2 p : rings.polygons()[ring]) {
    std::size_t around = 0;
    if (!for_each_around(rings, ring, p, execution, [&](std::uint32_t) { ++around; })) continue;
    if (depth && *depth != around) throw InputError(place_of_polygon(scene, ring), "this ring crosses another one");
    depth = around;
  }
  return depth.value_or(0);
}

/// The ring that a ring lies in, one less deep.
std::size_t parent_of(const PolygonIndex& rings, std::size_t ring, std::span<const std::size_t> depth,
                      const Execution& execution) {
  std::size_t parent = ring;
  for (const Vec2 p : rings.polygons()[ring]) {
    const auto take = [&](std::uint32_t other) { parent = depth[other] + 1 == depth[ring] ? other : parent; };
    if (for_each_around(rings, ring, p, execution, take)) break;
  }
  return parent;
}

/// The outermost rings confine: one alone, or else what is around them is an obstacle with these as its holes.
void confine_to(Scene& scene, std::span<const ScenePolygon> outermost, const Execution& execution) {
  if (outermost.size() == 1) return confine(scene, outermost.front(), execution);
  Box box;
  std::vector<std::vector<Vec2>> holes;
  for (const ScenePolygon& ring : outermost) {
    execution.reserve(ring.corners.size() * sizeof(Vec2));
    for (const Vec2 p : ring.corners) box.include(p);
    push_asked(holes, ring.corners, execution);
  }
  box = box.grown(std::max(box.width(), box.height()) / 64.0);
  const auto around = box.corners();
  add_without_holes(scene, outermost.front().line, {around.begin(), around.end()}, holes, execution);
}

/// Free is inside an odd number of rings.
void sort_by_depth(Scene& scene, const Execution& execution) {
  const PolygonIndex index(plane_obstacles(scene, execution).polygons, execution);
  std::vector<std::size_t> depth;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    push_asked(depth, depth_of(index, i, scene, execution), execution);
  }
  execution.reserve(depth.size() * sizeof(std::vector<std::vector<Vec2>>));
  std::vector<std::vector<std::vector<Vec2>>> holes(depth.size());  // of what is blocked in each ring
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (i % 256 == 0) execution.check();
    if (depth[i] % 2 == 0 && depth[i] > 0)
      push_asked(holes[parent_of(index, i, depth, execution)], std::move(scene.polygons[i].corners), execution);
  }
  Rings rings = std::exchange(scene.polygons, {});
  Rings outermost;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (depth[i] == 0) push_asked(outermost, std::move(rings[i]), execution);
    if (depth[i] % 2 == 1) add_without_holes(scene, rings[i].line, std::move(rings[i].corners), holes[i], execution);
  }
  confine_to(scene, outermost, execution);
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
    const ScenePolygon outer = std::move(scene.polygons.front());
    scene.polygons.erase(scene.polygons.begin());
    confine(scene, outer, execution);
  }
  return scene;
}

}  // namespace warren
