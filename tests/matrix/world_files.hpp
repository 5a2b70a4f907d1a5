// SPDX-License-Identifier: BSD-3-Clause
// The matrix's worlds as the files that the program reads.
#pragma once

#include <string>
#include <vector>

#include "tests/matrix/matrix_worlds.hpp"

namespace warren::test {

/// "polygon X Y …", as a scene says an outline.
std::string polygon_text(const Ring& ring);
/// Everything that a world holds, as a scene; its regions are polygons without holes.
std::string scene_of(const MatrixWorld& world);
/// Its regions and bounds as GeoJSON, which can say holes.
std::string geojson_of(const MatrixWorld& world);
/// Its spheres and boxes as a scene of MoveIt.
std::string moveit_of(const MatrixWorld& world);

/// Rows from the top: `.` is free, all else is blocked; `?` unknown.
using MapRows = std::vector<std::string>;

/// Where a map lies: its lower left corner, and how far it is turned about it.
struct MapPlace {
  double cell = 1.0;
  PlanePoint origin;
  double yaw = 0.0;

  /// The place of map coordinates, in cells.
  PlanePoint at(double column, double row) const;
};

PlaneObstacles cells_of(const MapRows& rows, const MapPlace& place);
std::string moving_ai_of(const MapRows& rows);
/// The image and the text of a map server's map.
std::string pgm_of(const MapRows& rows);
std::string yaml_of(const std::string& image, const MapPlace& place);

}  // namespace warren::test
