// SPDX-License-Identifier: BSD-3-Clause
// Well-known text, in and out: POLYGON and MULTIPOLYGON are obstacles, LINESTRING and MULTILINESTRING walls, POINTs
// mark nothing, GEOMETRYCOLLECTION holds any of them, EMPTY is nothing. Any number of geometries, apart by blanks,
// lines or
// `;`; upper or lower case; `SRID=n;` and Z, M, ZM are understood and dropped. A polygon with holes becomes several
// that touch (scenes/scene/plane_obstacles). Rings of either orientation, closed.
#pragma once

#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Does it begin with the name of a geometry and a parenthesis (or EMPTY), or with SRID=?
bool is_wkt(std::string_view bytes);

/// Throws InputError naming file and line, Stopped.
Scene read_wkt(const InputFile& file, const Execution& execution);

/// One geometry a line; rings closed and anticlockwise. Throws InputError for what WKT can't hold (bounds, spheres),
/// WriteError, Stopped.
void write_wkt(const Scene& scene, const std::string& path, const Execution& execution);

}  // namespace warren
