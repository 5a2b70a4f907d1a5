// SPDX-License-Identifier: BSD-3-Clause
// The files that prices name, read: masks of map servers, and polygons that are kept out of.
#pragma once

#include <string>

#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"

namespace warren {

/// Reads the masks that nobody has read yet. What `keep-out` names may be a GeoJSON or scene, too: its polygons become
/// keep_out or, with a factor, areas, and it is no mask more. Throws ReadError, InputError naming file and line,
/// Stopped.
void read_masks(Prices& prices, const Execution& execution);

/// `name` as a file that stands in `file` means it: absolute, ~/…, or beside that.
std::string path_beside(const std::string& file, const std::string& name);
/// What `path` is called in a file that is written to `file`; read back by path_beside.
std::string name_beside(const std::string& file, const std::string& path);

}  // namespace warren
