// SPDX-License-Identifier: BSD-3-Clause
// PGM in and out: P5 (binary) and P2 (ASCII) in, maxval up to 65535, comments anywhere in the header; P5 out.
#pragma once

#include <string>

#include "scenes/images/image_io.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {

/// As read_image, for a PGM. What follows the pixels is ignored.
void read_pgm(const InputFile& file, const ImageSink& sink, const Execution& execution);

/// What a cell of which a map server knew nothing becomes.
enum class UnknownCells : std::uint8_t {
  grey,   ///< 205, as map servers write and read it
  black,  ///< a wall, so that an image without YAML holds the same free cells
};

/// A map in binary: free 254, blocked 0. Throws as OutputFile does.
void write_map_pgm(const OccupancyMap& map, const std::string& path, UnknownCells unknown, const Execution& execution);

}  // namespace warren
