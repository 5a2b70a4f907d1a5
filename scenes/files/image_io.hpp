// SPDX-License-Identifier: BSD-3-Clause
// Images as occupancy maps need them: PNG (all colour types and depths, interlaced or not), PGM (binary and ASCII, 8
// and 16 bits) and BMP (not compressed), handed over a run of pixels at a time, so that nothing but a row is ever held.
//
// Mazes as images (PNG, PGM): dark pixels (grey below 128, transparent ones over white) are walls. The single bright
// pixel of the first row is the entrance, that of the last row the exit; where there isn't exactly one, start and goal
// are left open.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// What is known before the first pixel.
struct ImageHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  unsigned channels = 1;   ///< 1 grey, 2 grey and alpha, 3 colours, 4 colours and alpha
  unsigned maximum = 255;  ///< samples run from 0 to this: 255, 65535, or what a PGM says

  bool has_alpha() const { return channels % 2 == 0; }
};

/// Pixels first_x, first_x + step_x, … of row y, counted from the top. Palettes are expanded, fewer bits than 8 are
/// stretched to 8, transparent colours have become alpha.
struct PixelRun {
  std::uint32_t y = 0;
  std::uint32_t first_x = 0;
  std::uint32_t step_x = 1;
  std::span<const std::uint16_t> samples;  ///< channels a pixel
};

struct ImageSink {
  std::function<void(const ImageHeader&)> begin;
  std::function<void(const PixelRun&)> row;
};

/// Reads a PNG, PGM or BMP, by its first bytes. Every pixel is given once. Throws InputError naming the file (for ASCII
/// PGM also the line), Stopped, and what the sink throws.
void read_image(const InputFile& file, const ImageSink& sink, const Execution& execution);

/// The same of a PNG, by libpng: every colour type, depth and interlacing, row by row.
void read_png(const InputFile& file, const ImageSink& sink, const Execution& execution);

/// Does it begin as a PNG, PGM or BMP does?
bool is_image(std::string_view bytes);

/// What a cell of which a map server knew nothing becomes.
enum class UnknownCells : std::uint8_t {
  grey,   ///< 205, as map servers write and read it
  black,  ///< a wall, so that an image without YAML holds the same free cells
};

/// A map in binary: free 254, blocked 0. Throws as OutputFile does.
void write_map_pgm(const OccupancyMap& map, const std::string& path, UnknownCells unknown, const Execution& execution);

/// A pixel is a cell of side 1, the lower left corner of the image is (0, 0). Throws InputError, Stopped.
OccupancyMap read_maze_image(const InputFile& file, const Execution& execution);

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
