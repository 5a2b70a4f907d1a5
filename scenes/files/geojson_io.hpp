// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON (RFC 7946), in and out: a FeatureCollection, Feature or geometry. Polygons and MultiPolygons are obstacles,
// LineStrings walls; a polygon with holes becomes several that touch (scenes/scene/plane_obstacles). A feature
// whose properties have a "role" says what else a world holds: "start" and "goal" (Points), "bounds" (a Polygon, taken
// as its box). Rings of either orientation, closed as the RFC demands; a third coordinate is dropped; features without
// geometry, properties and foreign members are passed over. Also a bare array of rings, open or closed, as earcut's
// test data have them: each ring is an obstacle. Read in one pass without a tree.
#pragma once

#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Does it begin as JSON does that is no answer of ours: with an array, or an object that has a "type"?
bool is_geojson(std::string_view bytes);

/// Throws InputError naming file and line, Stopped.
Scene read_geojson(const InputFile& file, const Execution& execution);

/// Rings closed and anticlockwise. Throws InputError for what GeoJSON can't hold (spheres, states with angles),
/// WriteError, Stopped.
void write_geojson(const Scene& scene, const std::string& path, const Execution& execution);

}  // namespace warren
