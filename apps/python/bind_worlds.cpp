// SPDX-License-Identifier: BSD-3-Clause
// Worlds: read, made of what Python holds (arrays of walls, rings and solids, grids of cells), looked at, changed,
// written.

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/python/bind.hpp"
#include "core/base/error.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/scene/polygon_generator.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/question/planner_choice.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/example_files.hpp"
#include "tools/words/question_words.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

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
    for (std::size_t i = 0; i < rows.rows; ++i) {
      const auto at = [&](std::size_t k) { return coordinate(rows.numbers[2 * i + k], "polygons", i); };
      polygon.corners.push_back({at(0), at(1)});
    }
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

/// Lines of a scene: "cylinder 0 0 0 0 0 1 0.2".
void add_solids(Scene& scene, py::handle value) {
  const bool is_list = py::isinstance<py::iterable>(value) && !py::isinstance<py::str>(value);
  if (!is_list) refuse_part("solids", "a sequence of lines", value);
  for (const py::handle line : value) {
    const std::string where = fmt::format("solids[{}]", scene.solids.size());
    const std::string text = word_of(py::reinterpret_borrow<py::object>(line), where);
    scene_text::Fields fields(text, {where, 0});
    const std::string_view name = fields.word();
    const SolidWord* const word = solid_word_named(name);
    if (word == nullptr) throw InputError(where, "expected sphere, box, obox, cylinder, capsule or hull", name);
    scene.solids.push_back(read_solid(*word, fields, {}));
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

/// Throws InputError for polygons that are not simple and walls that no maze has, Stopped.
void check_scene(const Scene& scene) {
  CallLimits().run([&](const Execution& execution) {
    check_polygons(scene, execution);
    if (!scene.maze) return;
    if (const auto off = first_wall_off_grid(scene.walls, *scene.maze, execution)) {
      throw InputError(fmt::format("walls[{}]", *off), "is not on the unit grid of the maze");
    }
  });
}

tools::Command reading() {
  return command_of("read_world", {tools::world_option_specs(), std::span(&tools::moveit_robot_option, 1)});
}
tools::Command question_of_world() { return command_of("scene", {tools::question_option_specs()}, {"--contact"}); }

/// What scene files say beside obstacles: start, goal, robot, clearance.
void take_question(Scene& scene, const py::dict& keywords) {
  Question question = tools::question_words(arguments_of(made_once<question_of_world>(), keywords));
  question.validate();
  if (!question.start.empty()) scene.start = std::move(question.start);
  if (!question.goal.empty()) scene.goal = std::move(question.goal);
  if (question.robot) scene.robot = std::move(question.robot);
  if (question.clearance) scene.clearance = question.clearance;
}

/// A world from what Python holds: parts: walls (n, 4), float32 or float64; polygons, a list of rings (n, 2); spheres
/// (n, 4); boxes (n, 6); solids, lines; bounds (4,); maze (rows, cols); source. Throws TypeError, InputError.
Scene made_of_arrays(const py::dict& parts, const py::dict& keywords) {
  const auto part = [&](const char* name) -> py::object { return parts.attr("get")(name); };
  Scene scene;
  const py::object source = part("source");
  if (!py::isinstance<py::str>(source)) refuse_part("source", "a name", source);
  scene.source = word_of(source, "source");
  if (const py::object walls = part("walls"); !walls.is_none()) scene.walls = read_walls(walls);
  if (const py::object rings = part("polygons"); !rings.is_none()) add_polygons(scene, rings);
  if (const py::object balls = part("spheres"); !balls.is_none()) add_spheres(scene, balls);
  if (const py::object boxes = part("boxes"); !boxes.is_none()) add_boxes(scene, boxes);
  if (const py::object solids = part("solids"); !solids.is_none()) add_solids(scene, solids);
  if (const py::object bounds = part("bounds"); !bounds.is_none()) scene.bounds = read_bounds(bounds);
  if (const py::object maze = part("maze"); !maze.is_none()) scene.maze = read_maze(maze);
  take_question(scene, keywords);
  check_scene(scene);
  return scene;
}

/// A map of cells: bool or uint8 (rows, columns) in any layout, what is not 0 is blocked, row 0 is the top.
/// origin: lower left corner. Throws TypeError, InputError.
Scene made_of_cells(const py::array& cells, double cell, std::array<double, 2> origin, double yaw_rad,
                    const py::dict& keywords) {
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
  take_question(scene, keywords);
  return scene;
}

/// is_asked: in a question, whose robot the keyword is.
Scene read_named(const std::string& source, py::dict keywords, bool is_asked = false) {
  CallLimits limits = take_limits(keywords);
  const tools::Arguments words = arguments_of(made_once<reading>(), keywords);
  return limits.run([&](const Execution& execution) {
    return is_asked ? tools::load_world(source, words, execution) : tools::load_world_alone(source, words, execution);
  });
}

Scene read_text(const std::string& name, const std::string& text, const py::dict& keywords) {
  Scene scene = CallLimits().run(
      [&](const Execution& execution) { return read_scene(InputFile::of_bytes(name, text), execution); });
  scene.source = name;
  take_question(scene, keywords);
  return scene;
}

/// Its files are read from the folder, which is empty; the world is called as its own file is.
Scene read_example(const std::string& name, const std::string& folder) {
  const tools::Example example = tools::example_named(name);
  Scene scene = read_named(tools::write_example_files(example, folder), {});
  scene.source = example.files.front();
  return scene;
}

/// As numbers: of packed walls a copy, of others where they lie.
py::array walls_of(const py::object& self) {
  return self.cast<const Scene&>().walls.visit([&]<class Wall>(std::span<const Wall> walls) -> py::array {
    const Shape shape = shape_of(walls.size(), 4);
    if constexpr (std::is_same_v<Wall, PackedWall>) {
      py::array_t<float> rows(shape);
      auto* const out = reinterpret_cast<FloatWall*>(rows.mutable_data());  // NOLINT: four floats a wall
      std::transform(walls.begin(), walls.end(), out, [](const PackedWall& wall) { return unpacked(wall); });
      return read_only(std::move(rows));
    } else {
      return view_of(&walls.data()->x1, shape, self);
    }
  });
}

py::list polygons_of(const py::object& self) {
  py::list rings;
  for (const ScenePolygon& polygon : self.cast<const Scene&>().polygons) {
    rings.append(view_of(&polygon.corners.data()->x, shape_of(polygon.corners.size(), 2), self));
  }
  return rings;
}

py::object cells_of(const Scene& scene) {
  if (!scene.map) return py::none();
  const Bitmap& blocked = scene.map->blocked;
  py::array_t<bool> cells(Shape{blocked.height(), blocked.width()});
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    bool* row = cells.mutable_data(blocked.height() - 1 - y, 0);
    for (std::uint32_t x = 0; x < blocked.width(); ++x) row[x] = blocked.test(x, y);
  }
  return read_only(std::move(cells));
}

/// x0, y0, x1, y1, or None.
py::object box_of(const Box& box) {
  if (box.empty()) return py::none();
  return py::make_tuple(box.min.x, box.min.y, box.max.x, box.max.y);
}

template <auto kind, py::ssize_t columns>
py::array solids_of(const py::object& self) {
  const auto& solids = self.cast<const Scene&>().*kind;
  if (solids.empty()) return read_only(py::array_t<double>(Shape{0, columns}));
  const Shape shape = shape_of(solids.size(), columns);
  return view_of(reinterpret_cast<const double*>(solids.data()), shape, self);  // NOLINT: doubles alone
}

/// The scene with walls taken out, by their rows, and others put at the end.
Scene with_other_walls(const Scene& scene, const std::vector<std::int64_t>& gone, const py::object& added) {
  if (scene.map) {
    throw InputError("walls",
                     "the world is a map, whose obstacles are cells: make another one of changed cells by grid()");
  }
  Scene next = scene;
  next.formula.reset();
  next.packed.reset();
  constexpr std::string_view changed = " (changed)";
  if (!next.source.ends_with(changed)) next.source += changed;
  std::vector<bool> is_gone(scene.walls.size());
  for (const std::int64_t row : gone) {
    if (row < 0 || static_cast<std::size_t>(row) >= is_gone.size()) {
      throw InputError("rows", "there is no such wall", std::to_string(row));
    }
    is_gone[static_cast<std::size_t>(row)] = true;
  }
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < is_gone.size(); ++i) {
    if (!is_gone[i]) walls.push_back(scene.walls.segment(i));
  }
  if (!added.is_none()) {
    const WallSet more = read_walls(added);
    for (std::size_t i = 0; i < more.size(); ++i) walls.push_back(more.segment(i));
  }
  next.walls = WallSet::narrowest(walls);
  check_scene(next);
  return next;
}

/// A map by its endings and .png, what is no map in cells of that side; all else as walls and polygons. What is left
/// out.
std::vector<std::string_view> write_by_ending(const Scene& scene, const std::string& path,
                                              const std::optional<double>& cell) {
  const bool is_map = is_map_ending(path) || path.ends_with(".png");
  if (cell && (!is_map || scene.map)) {
    throw UsageError(is_map ? "@cell: the world is a map, and its cells stay as they are"
                            : "@cell: only maps have cells: .map, .yaml, .pgm and .png");
  }
  if (is_map && !scene.map && !cell)
    throw UsageError("@cell: is missing; it says how large a cell of the map shall be");
  if (cell) check_cell(*cell, scene);
  return CallLimits().run([&](const Execution& execution) {
    std::optional<Scene> copy;
    std::optional<OccupancyMap> made;
    if (is_map) {
      if (!scene.map) made = map_of_scene(scene, *cell, execution);
      write_map(made ? *made : *scene.map, path, execution);
    } else {
      write_scene(with_map_walls(scene, copy, execution), path, execution);
    }
    return parts_left_out(scene, path, made ? &*made : nullptr);
  });
}

void bind_what_is_seen(py::class_<Scene>& scene) {
  scene.def_property_readonly("source", [](const Scene& s) { return s.source; })
      .def_property_readonly("description", &description_of)
      .def_property_readonly("walls", &walls_of)
      .def_property_readonly("polygons", &polygons_of)
      .def_property_readonly("cells", &cells_of)
      .def_property_readonly("spheres", &solids_of<&Scene::spheres, 4>)
      .def_property_readonly("boxes", &solids_of<&Scene::boxes, 6>)
      .def_property_readonly("solids",
                             [](const Scene& s) {
                               py::list lines;
                               for (const Solid& solid : s.solids) lines.append(solid_text(solid));
                               return lines;
                             })
      .def_property_readonly("bounds", [](const Scene& s) { return box_of(s.bounds.value_or(Box{})); })
      .def_property_readonly("box", [](const Scene& s) { return box_of(obstacle_box(s)); })
      .def_property_readonly(
          "robot", [](const Scene& s) { return s.robot ? py::object(py::str(robot_text(*s.robot))) : py::none(); })
      .def_property_readonly("clearance", [](const Scene& s) { return s.clearance; })
      .def_property_readonly("start", [](const Scene& s) { return s.start; })
      .def_property_readonly("goal", [](const Scene& s) { return s.goal; })
      .def_property_readonly(
          "maze",
          [](const Scene& s) { return s.maze ? std::optional(std::pair(s.maze->rows, s.maze->cols)) : std::nullopt; })
      .def_property_readonly("raster", [](const Scene& s) -> py::object {
        if (!s.map) return py::none();
        return py::make_tuple(s.map->cell, s.map->origin.x, s.map->origin.y, s.map->yaw_rad);
      });
}

}  // namespace

void bind_worlds(py::module_& module) {
  py::class_<Scene> scene(module, "Scene");
  bind_what_is_seen(scene);
  scene
      .def("facts",
           [](const Scene& s) {
             return CallLimits().run([&](const Execution& on) { return facts_json(facts_of(s, on)); });
           })
      .def("hash",
           [](const Scene& s) { return CallLimits().run([&](const Execution& on) { return account_of(s, on).hash; }); })
      .def("with_other_walls", &with_other_walls)
      .def("write", &write_by_ending)
      .def(py::pickle([](const Scene& s) { return bytes_of(s); },
                      [](const py::bytes& b) { return from_bytes<Scene>(b); }));
  module.def("read_world", &read_named);
  module.def("read_text", &read_text);
  module.def("example", &read_example);
  module.def("scene", &made_of_arrays);
  module.def("cells", &made_of_cells);
  module.def("body", [](const std::string& text) { return robot_value("robot", text), text; });
  module.def("reading_keywords", [] { return keyword_table(made_once<reading>()); });
}

}  // namespace warren::python
