// SPDX-License-Identifier: BSD-3-Clause
// The cells of a maze whose walls are a NumPy array that no memory holds: read once, in windows, in whatever order they
// come and however they are cut, into two bits a cell (scenes/mazes/cell_bits.hpp). The first four rows must be the
// outline, as `generate` writes it: they say how many cells there are. Cost: the disk's (docs/performance.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/mazes/cell_bits.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// The maze whose walls the array holds, without them (is_unmade); nothing where its first four rows are no outline of
/// a maze. Throws InputError.
std::optional<Scene> unmade_npy(const InputFile& file);

/// Holds the cells, not the file.
class NpyMaze {
 public:
  /// maze: as unmade_npy() says; held: rows of tiles whose cells are kept, and the row of cells below them, of all that
  /// are looked at; none: all. Throws InputError for a wall off the grid, outside the outline or in one of its doors;
  /// Stopped.
  NpyMaze(const InputFile& file, MazeHint maze, const Execution& execution, std::optional<TileRows> held = {});
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
/// array at the outline too. Throws InputError.
std::optional<Scene> unmade_maze(const InputFile& file);

}  // namespace warren
