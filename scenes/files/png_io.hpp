// SPDX-License-Identifier: BSD-3-Clause
// PNG in, by libpng: every colour type, depth and interlacing, row by row.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {

/// As read_image, for a PNG.
void read_png(const InputFile& file, const ImageSink& sink, const Execution& execution);

// PNG out, by libpng, row by row: pictures, and maps as images that read_world takes back.

/// What an encoder asks for.
struct PngRows {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// At most 256 colours, then a byte a pixel; empty: 1 bit a pixel, the first one the highest bit, 1 white.
  std::vector<std::array<std::uint8_t, 3>> palette = {};
  std::vector<std::uint8_t> alphas = {};  ///< of the palette's first colours, 255 opaque; empty: all are
  double dpi = 0.0;                       ///< 0: nothing is said of it
  int compression = 4;                    ///< 1 quick .. 9 small
  /// The bytes of row y, from the top; valid until the next call. Must not throw.
  std::function<const std::uint8_t*(std::size_t)> row;
};

/// Hands the file's bytes on, piece by piece. Throws Stopped between rows, and what `write` throws.
void write_png(const PngRows& rows, const Execution& execution, const std::function<void(std::string_view)>& write);

/// A map, a pixel a cell: free white, all else black. Throws as OutputFile does.
void write_map_png(const OccupancyMap& map, const std::string& path, const Execution& execution);

}  // namespace warren
