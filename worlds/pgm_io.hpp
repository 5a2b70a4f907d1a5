// SPDX-License-Identifier: BSD-3-Clause
// PGM in and out: P5 (binary) and P2 (ASCII) in, maxval up to 65535, comments anywhere in the header; P5 out.
#pragma once

#include <string>

#include "worlds/image_io.hpp"
#include "worlds/occupancy_map.hpp"

namespace warren {

/// As read_image, for a PGM. What follows the pixels is ignored.
void read_pgm(const InputFile& file, const ImageSink& sink, const Execution& execution);

/// A map as map servers write it: free 254, unknown 205, all else 0; binary. Throws as OutputFile does.
void write_map_pgm(const OccupancyMap& map, const std::string& path, const Execution& execution);

}  // namespace warren
