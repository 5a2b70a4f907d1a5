// SPDX-License-Identifier: BSD-3-Clause
// Mazes in files that no memory holds as walls.
//
// .maze files: the walls of a maze in a quarter of a byte a cell. The layout is in docs/file_formats.md: a header of 64
// bytes, the cells (scenes/mazes/cell_bits.hpp), and a checksum for each 256 rows of them. Written and read 256 rows at
// a time, by all threads.
//
// NumPy arrays of a maze's walls: read once, in windows, in whatever order they come and however they are cut, into two
// bits a cell. The first four rows must be the outline, as `generate` writes it: they say how many cells there are.
// Cost: the disk's (docs/performance.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/raw_vector.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/mazes/cell_bits.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

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
  MazeFile(const InputFile& file, MazeHint size);
  bool has_outline(std::uint32_t first_row, std::uint32_t last_row) const;
  std::string_view band(std::size_t number) const;

  const InputFile& file_;
};

/// The maze with its walls, as the generator makes them: one cell long, in the course's order. Throws InputError for
/// damaged files and for 2^32 cells and more, Stopped.
Scene read_maze_file(const InputFile& file, const Execution& execution);

/// Writes a maze with tiles of 256 x 256 cells. Throws WriteError, Stopped.
void write_maze_file(const CellWallSource& cells, const std::string& path, const Execution& execution);
/// The same of a scene's walls. Throws InputError for whatever is no maze closed but for its two doors.
void write_maze_file(const Scene& scene, const std::string& path, const Execution& execution);

/// Holds the cells, not the file.
class NpyMaze {
 public:
  /// maze: as unmade_maze() says; held: rows of tiles whose cells are kept, and the row of cells below them, of all
  /// that are looked at; none: all. Throws InputError for a wall off the grid, outside the outline or in one of its
  /// doors; Stopped.
  NpyMaze(const InputFile& file, MazeHint maze, const Execution& execution, std::optional<Range> held = {});
  const CellBits& cells() const { return cells_; }
  std::size_t wall_count() const { return array_.walls; }
  /// scene_hash() of the scene with the walls.
  const std::string& hash() const { return hash_; }

 private:
  template <class T>
  void read(const InputFile& file, const Execution& execution);
  template <class T>
  void add(const InputFile& file, std::size_t row, const WallOf<T>& wall, const Execution& execution);
  void stand(std::uint32_t col, std::uint32_t row, unsigned wall) {
    if (row < rows_.first || row >= rows_.last) return;
    bits_[(row - rows_.first) * bytes_a_row(maze_.cols) + col / 4] |=
        static_cast<std::uint8_t>(wall << (2 * (col % 4)));
  }

  NpyWalls array_;
  MazeHint maze_;
  Range rows_;  // of cells that are held
  RawVector<std::uint8_t> bits_;
  CellBits cells_;
  std::string hash_;
  std::uint64_t units_ = 0;  // of walls, so far
};

/// Which mazes can be had tile by tile, so that their walls may be left out (is_unmade): those of a name whose
/// algorithm makes each tile by itself, and those of files that are read by parts. maze:ROWSxCOLS,...: the maze without
/// its walls; nothing for algorithms that make it as a whole. Throws UsageError.
std::optional<Scene> unmade_maze(const std::string& source);

/// A file of a maze, without its walls; nothing where its format or its walls are others. Looks at its header, of an
/// array at its first four rows too, which must be the outline. Throws InputError.
std::optional<Scene> unmade_maze(const InputFile& file);

}  // namespace warren
