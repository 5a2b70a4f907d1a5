// SPDX-License-Identifier: BSD-3-Clause
// Worlds: read, made, looked at, changed, written.
#include <pybind11/stl.h>

#include <cstdint>
#include <string_view>

#include "core/base/error.hpp"
#include "python/arrays.hpp"
#include "python/binary_archive.hpp"
#include "python/bind.hpp"
#include "python/keywords.hpp"
#include "python/scene_of_arrays.hpp"
#include "scenes/formats/geojson_io.hpp"
#include "scenes/formats/read_world_io.hpp"
#include "scenes/scene/polygon_generator.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/answer/world_facts.hpp"
#include "solve/question/grid_choice.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/question_words.hpp"
#include "worlds/rasters/map_borders.hpp"

namespace warren::python {
namespace py = pybind11;
namespace {

tools::Command reading() { return command_of("read_world", {tools::world_option_specs()}); }
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

Scene read_named(const std::string& source, py::dict keywords) {
  CallLimits limits = take_limits(keywords);
  const tools::Arguments words = arguments_of(made_once<reading>(), keywords);
  return limits.run([&](const Execution& execution) {
    StageTimes seconds;
    return tools::load_world(source, words, execution, seconds);
  });
}

Scene read_text(const std::string& name, const std::string& text, const py::dict& keywords) {
  Scene scene = CallLimits().run(
      [&](const Execution& execution) { return read_scene(InputFile::of_bytes(name, text), execution); });
  scene.source = name;
  take_question(scene, keywords);
  return scene;
}

Scene made_of_arrays(const py::dict& parts, const py::dict& keywords) {
  Scene scene = scene_of_arrays(parts);
  take_question(scene, keywords);
  CallLimits().run([&](const Execution& execution) { check_scene(scene, execution); });
  return scene;
}

Scene made_of_cells(const py::array& cells, double cell, std::array<double, 2> origin, double yaw_rad,
                    const py::dict& keywords) {
  Scene scene = scene_of_cells(cells, cell, origin, yaw_rad);
  take_question(scene, keywords);
  return scene;
}

/// As numbers: of packed walls a copy, of others where they lie.
py::array walls_of(const py::object& self) {
  return self.cast<const Scene&>().walls.visit([&]<class Wall>(std::span<const Wall> walls) -> py::array {
    const auto n = static_cast<py::ssize_t>(walls.size());
    if constexpr (std::is_same_v<Wall, PackedWall>) {
      py::array_t<float> rows(Shape{n, 4});
      auto* const out = reinterpret_cast<FloatWall*>(rows.mutable_data());  // NOLINT: four floats a wall
      std::transform(walls.begin(), walls.end(), out, [](const PackedWall& wall) { return unpacked(wall); });
      return read_only(std::move(rows));
    } else {
      return view_of(&walls.data()->x1, {n, 4}, self);
    }
  });
}

py::list polygons_of(const py::object& self) {
  py::list rings;
  for (const ScenePolygon& polygon : self.cast<const Scene&>().polygons) {
    rings.append(view_of(&polygon.corners.data()->x, {static_cast<py::ssize_t>(polygon.corners.size()), 2}, self));
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

template <class T>
py::array solids_of(const std::vector<T>& solids, py::ssize_t columns, const py::object& self) {
  const auto n = static_cast<py::ssize_t>(solids.size());
  if (n == 0) return read_only(py::array_t<double>(Shape{0, columns}));
  return view_of(reinterpret_cast<const double*>(solids.data()), {n, columns}, self);  // NOLINT: doubles alone
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
    py::dict parts;
    parts["walls"] = added;
    parts["source"] = "";
    const Scene more = scene_of_arrays(parts);
    for (std::size_t i = 0; i < more.walls.size(); ++i) walls.push_back(more.walls.segment(i));
  }
  next.walls = WallSet::narrowest(walls);
  CallLimits().run([&](const Execution& execution) { check_scene(next, execution); });
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
      write_scene(bordered(scene, copy, execution), path, execution);
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
      .def_property_readonly("spheres",
                             [](const py::object& s) { return solids_of(s.cast<const Scene&>().spheres, 4, s); })
      .def_property_readonly("boxes", [](const py::object& s) { return solids_of(s.cast<const Scene&>().boxes, 6, s); })
      .def_property_readonly("bounds", [](const Scene& s) { return box_of(s.bounds.value_or(Box{})); })
      .def_property_readonly("box", [](const Scene& s) { return box_of(obstacle_box(s)); })
      .def_property_readonly(
          "robot", [](const Scene& s) { return s.robot ? py::object(py::str(robot_text(*s.robot))) : py::none(); })
      .def_property_readonly("clearance", [](const Scene& s) { return s.clearance; })
      .def_property_readonly("start", [](const Scene& s) { return s.start; })
      .def_property_readonly("goal", [](const Scene& s) { return s.goal; })
      .def_property_readonly("maze",
                             [](const Scene& s) -> py::object {
                               if (!s.maze) return py::none();
                               return py::make_tuple(s.maze->rows, s.maze->cols);
                             })
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
  module.def("scene", &made_of_arrays);
  module.def("cells", &made_of_cells);
  module.def("body", [](const std::string& text) { return robot_value("robot", text), text; });
  module.def("reading_keywords", [] { return keyword_table(made_once<reading>()); });
}

}  // namespace warren::python
