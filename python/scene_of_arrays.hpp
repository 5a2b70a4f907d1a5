// SPDX-License-Identifier: BSD-3-Clause
// Worlds from what Python holds: arrays of walls, rings and solids, grids of cells, and GeoJSON's objects as text.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::python {

/// parts: walls (n, 4), float32 or float64; polygons, a list of rings (n, 2); spheres (n, 4); boxes (n, 6); bounds
/// (4,); maze (rows, cols); source. All but the checks of polygons, which need no lock: check_scene. Throws TypeError,
/// InputError.
Scene scene_of_arrays(const pybind11::dict& parts);

/// A map of cells: bool or uint8 (rows, columns) in any layout, what is not 0 is blocked, row 0 is the top.
/// origin: lower left corner. Throws TypeError, InputError.
Scene scene_of_cells(const pybind11::array& cells, double cell, std::array<double, 2> origin, double yaw_rad);

/// Throws InputError for polygons that are not simple and walls that no maze has, Stopped.
void check_scene(const Scene& scene, const Execution& execution);

}  // namespace warren::python
