// SPDX-License-Identifier: BSD-3-Clause
#include "python/scene_of_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "python/arrays.hpp"
#include "python/keywords.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

[[noreturn]] void refuse_part(std::string_view part, std::string_view expected, py::handle found) {
  throw py::type_error(fmt::format("{}: expected {} (found: {})", part, expected, py::repr(found).cast<std::string>()));
}

/// As readers of files take a number.
double coordinate(double x, const char* name, std::size_t row) {
  if (!(std::abs(x) <= largest_coordinate)) {
    throw InputError(fmt::format("{}[{}]", name, row), "numbers must be finite and at most 1e60 in magnitude",
                     fmt::format("{}", x));
  }
  return std::abs(x) < smallest_coordinate ? 0.0 : x;
}

Vec2 point(const NumberRows& rows, std::size_t i, const char* name) {
  return {coordinate(rows.numbers[2 * i], name, i), coordinate(rows.numbers[2 * i + 1], name, i)};
}

/// In 8 bytes each where all fit.
WallSet narrowed(RawVector<FloatWall> walls) {
  const auto fits = [](const FloatWall& w) { return PackedWall::fits(w.x1, w.y1, w.x2, w.y2); };
  if (!std::all_of(walls.begin(), walls.end(), fits)) return WallSet(std::move(walls));
  RawVector<PackedWall> packed(walls.size());
  std::transform(walls.begin(), walls.end(), packed.begin(),
                 [](const FloatWall& w) { return PackedWall::of(w.x1, w.y1, w.x2, w.y2); });
  return WallSet(std::move(packed));
}

template <class T>
RawVector<WallOf<T>> walls_in(const py::array& array) {
  RawVector<WallOf<T>> walls(static_cast<std::size_t>(array.shape(0)));
  const auto* numbers = static_cast<const T*>(array.data());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto at = [&](std::size_t k) { return static_cast<T>(coordinate(numbers[4 * i + k], "walls", i)); };
    walls[i] = {at(0), at(1), at(2), at(3)};
  }
  return walls;
}

WallSet read_walls(py::handle value) {
  refuse_masked(value, "walls");
  if (py::isinstance<py::array_t<float, py::array::c_style>>(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    if (array.ndim() == 2 && array.shape(1) == 4) return narrowed(walls_in<float>(array));
  }
  const bool is_array = py::isinstance<py::array>(value) && !is_whole(value);
  const bool is_float64 = py::isinstance<py::array_t<double, py::array::c_style>>(value);
  if (is_array && !is_float64) {
    throw py::type_error(fmt::format("walls: expected float32 or float64 (n, 4) in C order (found: {})",
                                     kind_of(py::reinterpret_borrow<py::array>(value))));
  }
  const NumberRows rows = rows_of(value, "walls", {4});
  if (is_array) return WallSet(walls_in<double>(rows.array));
  std::vector<Segment> segments;
  for (const DoubleWall& wall : rows.rows == 0 ? RawVector<DoubleWall>() : walls_in<double>(rows.array)) {
    segments.push_back(wall.segment());
  }
  return WallSet::narrowest(segments);
}

void add_polygons(Scene& scene, py::handle value) {
  if (!py::isinstance<py::iterable>(value)) refuse_part("polygons", "a sequence of rings (n, 2)", value);
  for (const py::handle ring : value) {
    const NumberRows rows = rows_of(ring, fmt::format("polygons[{}]", scene.polygons.size()), {2});
    ScenePolygon polygon;
    for (std::size_t i = 0; i < rows.rows; ++i) polygon.corners.push_back(point(rows, i, "polygons"));
    scene.polygons.push_back(std::move(polygon));
  }
}

void add_spheres(Scene& scene, py::handle value) {
  const NumberRows rows = rows_of(value, "spheres", {4});
  for (std::size_t i = 0; i < rows.rows; ++i) {
    const auto at = [&](std::size_t k) { return coordinate(rows.numbers[4 * i + k], "spheres", i); };
    scene.spheres.push_back({at(0), at(1), at(2), at(3)});
    if (!(at(3) >= 0.0)) throw InputError(fmt::format("spheres[{}]", i), "the radius must be at least 0");
  }
}

void add_boxes(Scene& scene, py::handle value) {
  const NumberRows rows = rows_of(value, "boxes", {6});
  for (std::size_t i = 0; i < rows.rows; ++i) {
    SolidBox box{};
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = coordinate(rows.numbers[6 * i + k], "boxes", i);
      box.high[k] = coordinate(rows.numbers[6 * i + 3 + k], "boxes", i);
      if (!(box.low[k] <= box.high[k])) {
        throw InputError(fmt::format("boxes[{}]", i), "expected xmin, ymin, zmin, xmax, ymax, zmax");
      }
    }
    scene.boxes.push_back(box);
  }
}

Box read_bounds(py::handle value) {
  const py::tuple row = py::make_tuple(value);
  const NumberRows rows = rows_of(py::module_::import("numpy").attr("asarray")(row, "float64"), "bounds", {4});
  const auto at = [&](std::size_t k) { return coordinate(rows.numbers[k], "bounds", 0); };
  const Box box{{at(0), at(1)}, {at(2), at(3)}};
  if (!(box.width() > 0.0) || !(box.height() > 0.0)) {
    throw InputError("bounds", "expected xmin, ymin, xmax, ymax of a box that has an inside");
  }
  return box;
}

MazeHint read_maze(py::handle value) {
  std::pair<std::int64_t, std::int64_t> size;
  try {
    size = value.cast<std::pair<std::int64_t, std::int64_t>>();
  } catch (const py::cast_error&) {
    refuse_part("maze", "rows and columns", value);
  }
  constexpr std::int64_t most = std::numeric_limits<std::uint32_t>::max();
  const auto [rows, cols] = size;
  if (rows < 1 || cols < 1 || rows > most / cols) {
    throw InputError("maze", "rows and columns must be at least 1, and fewer than 2^32 cells",
                     fmt::format("{}, {}", rows, cols));
  }
  return {static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
}

}  // namespace

Scene scene_of_arrays(const py::dict& parts) {
  const auto part = [&](const char* name) -> py::object {
    return parts.contains(name) ? py::object(parts[name]) : py::object(py::none());
  };
  Scene scene;
  const py::object source = part("source");
  if (!py::isinstance<py::str>(source)) refuse_part("source", "a name", source);
  scene.source = word_of(source, "source");
  if (const py::object walls = part("walls"); !walls.is_none()) scene.walls = read_walls(walls);
  if (const py::object rings = part("polygons"); !rings.is_none()) add_polygons(scene, rings);
  if (const py::object balls = part("spheres"); !balls.is_none()) add_spheres(scene, balls);
  if (const py::object boxes = part("boxes"); !boxes.is_none()) add_boxes(scene, boxes);
  if (const py::object bounds = part("bounds"); !bounds.is_none()) scene.bounds = read_bounds(bounds);
  if (const py::object maze = part("maze"); !maze.is_none()) scene.maze = read_maze(maze);
  return scene;
}

Scene scene_of_cells(const py::array& cells, double cell, std::array<double, 2> origin, double yaw_rad) {
  refuse_masked(cells, "cells");
  const bool is_byte = cells.dtype().kind() == 'b' || (cells.dtype().kind() == 'u' && cells.itemsize() == 1);
  if (!is_byte || cells.ndim() != 2) {
    throw py::type_error("cells: expected bool or uint8 (rows, columns) (found: " + kind_of(cells) + ")");
  }
  check_map_size("cells", static_cast<std::uint64_t>(cells.shape(1)), static_cast<std::uint64_t>(cells.shape(0)));
  if (!(cell > smallest_coordinate && cell < largest_coordinate)) {
    throw InputError("cell", "must be a number above 0", fmt::format("{}", cell));
  }
  OccupancyMap map;
  const auto height = static_cast<std::uint32_t>(cells.shape(0));
  const auto width = static_cast<std::uint32_t>(cells.shape(1));
  map.blocked = Bitmap(width, height);
  for (std::uint32_t row = 0; row < height; ++row) {
    const auto* byte = static_cast<const std::uint8_t*>(cells.data(row, 0));
    for (std::uint32_t x = 0; x < width; ++x, byte += cells.strides(1)) {
      if (*byte != 0) map.blocked.set(x, height - 1 - row);
    }
  }
  map.occupied = map.blocked.count();
  map.free = map.blocked.size() - map.occupied;
  map.cell = cell;
  map.origin = {coordinate(origin[0], "origin", 0), coordinate(origin[1], "origin", 1)};
  map.yaw_rad = coordinate(yaw_rad, "yaw", 0);
  map.source = "cells";
  Scene scene;
  scene.source = map.source;
  scene.map = std::move(map);
  return scene;
}

void check_scene(const Scene& scene, const Execution& execution) {
  check_polygons(scene, execution);
  if (!scene.maze) return;
  if (const auto off = first_wall_off_grid(scene.walls, *scene.maze, execution)) {
    throw InputError(fmt::format("walls[{}]", *off), "is not on the unit grid of the maze");
  }
}

}  // namespace warren::python
