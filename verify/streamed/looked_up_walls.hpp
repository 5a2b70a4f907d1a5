// SPDX-License-Identifier: BSD-3-Clause
// Walls of a maze that can be looked up one by one as cheaply as tile by tile, say in bits: whoever asks for those near
// a path pays for the path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/raw_vector.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"

namespace warren {

class LookedUpWalls : public CellWallSource {
 public:
  static constexpr unsigned usual_side_log2 = 6;  ///< of tiles: what a leg beside the lattice looks at
  using CellWallSource::CellWallSource;
  /// Bits of CellTile: which walls of a cell stand. Columns from -1 to cols() - 1, rows likewise; of column -1 the
  /// right walls alone mean something, of row -1 the upper ones.
  virtual unsigned walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const = 0;
  std::unique_ptr<CellWallReader> reader() const final;

 protected:
  /// walls[i] becomes walls_at(col + i, row), of a row of cells of a tile and of the cell left of it.
  virtual void read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const;
  /// Called when a reader ends that has looked at these rows.
  virtual void forget_rows(Range /*rows*/) const {}

 private:
  class Reader;
};

// The walls of a maze as the judge keeps them when it has seen each of them once: a line of the grid has a bit for each
// unit of it, lines x = 0.5, 1.5, ... by column, and y = 0.5, ... by row. Two bits a cell.

class JudgedGridLines : public LookedUpWalls {
 public:
  /// Of walls that are held and may be let go. Throws InputError for those that no such maze has, or that do not reach
  /// to all its sides, for then a path is kept in a smaller box; Stopped.
  JudgedGridLines(const WallSet& walls, std::uint32_t rows, std::uint32_t cols, const Execution& execution);
  unsigned walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const override;

 protected:
  /// No wall yet. held: rows of cells whose walls are kept; no others are asked for, but for the walls above the row
  /// below the first.
  JudgedGridLines(std::uint32_t rows, std::uint32_t cols, unsigned side_log2, Range held, const Execution& execution);
  /// Unit by unit, from one end to the other. Throws InputError naming `where`, Stopped.
  void take(const std::string& where, double x1, double y1, double x2, double y2, const Execution& execution);

 private:
  const Range held_;
  std::uint64_t units_ = 0;  // taken so far
  RawVector<std::uint64_t> upright_;
  RawVector<std::uint64_t> level_;
};

// The walls of a .maze file as its judge reads them, by docs/file_formats.md and nothing else: what the planner's
// reader takes wrong, this one has not from it.

/// Refers to the file's bytes. Cost: some ns a cell.
class JudgedMazeFile : public LookedUpWalls {
 public:
  /// Called for bytes first .. last - 1 that a reader has looked at.
  using Forget = std::function<void(std::size_t first, std::size_t last)>;

  /// name: of the file. Throws InputError for what is no .maze file of version 1, or has another size.
  JudgedMazeFile(const std::string& name, std::string_view bytes, Forget forget = {});
  unsigned walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const override;

 private:
  /// Without a virtual call a cell.
  void read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const override;
  void forget_rows(Range rows) const override;

  std::string_view bytes_;
  Forget forget_;
};

// The walls of a maze as the judge reads them from a .npy array, once, window by window: what the planner's reader
// takes wrong, this one has not from it. Two bits a cell stay.

class JudgedNpyMaze : public JudgedGridLines {
 public:
  /// held: rows of cells whose walls are kept. Throws InputError for what is no array (n, 4) of <f4 or <f8, and for
  /// walls that are none of such a maze; Stopped.
  JudgedNpyMaze(const std::string& name, std::string_view bytes, std::uint32_t rows, std::uint32_t cols, Range held,
                const JudgedMazeFile::Forget& forget, const Execution& execution);
};

// The walls of a maze in a roadmap's file, where they stand wherever its lattice has no passage, as the judge reads
// them: by docs/file_formats.md and nothing else, so that what the planner's reader takes wrong, this one has not from
// it.

class JudgedPassages : public LookedUpWalls {
 public:
  /// right, up: the words of the sections passages.right and passages.up, referred to. Throws InputError naming `where`
  /// for another number of them.
  JudgedPassages(const std::string& where, std::uint32_t rows, std::uint32_t cols, std::span<const std::uint64_t> right,
                 std::span<const std::uint64_t> up);
  unsigned walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const override;

 private:
  /// By whole words.
  void read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const override;

  std::span<const std::uint64_t> right_;
  std::span<const std::uint64_t> up_;
  std::size_t words_a_row_;
};

}  // namespace warren
