// SPDX-License-Identifier: BSD-3-Clause
// .maze files: the walls of a maze in a quarter of a byte a cell, for mazes that no memory holds as walls. The layout
// is in docs/file_formats.md: a header of 64 bytes, the cells (scenes/mazes/cell_bits.hpp), and a checksum for each 256
// rows of them. Written and read 256 rows at a time, by all threads.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/cell_bits.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Do they begin as every .maze file does?
bool is_maze_file(std::string_view bytes);

/// A .maze file as it lies on disk, tile by tile. Refers to the file.
class MazeFile : public CellBits {
 public:
  static constexpr std::uint32_t most_side = (1U << 27U) - 1;  ///< of rows and columns, as SpanningMaze has it

  /// Looks at the header and the file's size alone. Throws InputError.
  explicit MazeFile(const InputFile& file);
  /// Holds all cells against their checksums, and the outline against what a maze has. Throws InputError, Stopped.
  void check(const Execution& execution) const { check({0, tile_count() / tile_cols()}, execution); }
  /// The same of these rows of tiles, and looks at no others.
  void check(Range tile_rows, const Execution& execution) const;
  /// Unit walls, and the outline's four, as the generator has them; of a checked file. Throws Stopped.
  std::uint64_t wall_count(const Execution& execution) const;
  /// Tells two mazes apart, of any size: made of rows, columns and checksums.
  std::uint64_t hash() const;

 private:
  struct Header;
  static Header header_of(const InputFile& file);
  MazeFile(const InputFile& file, const Header& header);
  bool has_outline(std::uint32_t first_row, std::uint32_t last_row) const;
  std::string_view band(std::size_t number) const;
  std::uint32_t sum_of_band(std::size_t number) const;

  const InputFile& file_;
};

/// The maze with its walls, as the generator makes them: one cell long, in the course's order. Throws InputError for
/// damaged files and for 2^32 cells and more, Stopped.
Scene read_maze_file(const InputFile& file, const Execution& execution);
/// The same without the walls (is_unmade). Looks at the header alone.
Scene unmade_maze_file(const InputFile& file);

/// Writes a maze with tiles of 256 x 256 cells. Throws WriteError, Stopped.
void write_maze_file(const CellWallSource& cells, const std::string& path, const Execution& execution);
/// The same of a scene's walls. Throws InputError for whatever is no maze closed but for its two doors.
void write_maze_file(const Scene& scene, const std::string& path, const Execution& execution);

}  // namespace warren
