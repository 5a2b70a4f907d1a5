// SPDX-License-Identifier: BSD-3-Clause
// Is this path free among walls that are not held? The tiles that the path comes near are asked for, one after the
// other, by all threads, and each leg is compared with the walls around it; nothing of a tile is kept. Cost: the tiles
// near the path, and some hundred ns a leg; 80 bytes for each run of legs near one tile, and 5 bytes a leg.
//
// Almost all legs of a path over a lattice are steps from the middle of a cell to that of a neighbour. Of such a step
// nothing but the wall between the two comes nearer than a half: all other walls lie on lines half a unit beside it, or
// begin half a unit beside it. So where walls can be looked up one look at one wall judges a step, and where some wall
// stands beside one, a half is the least distance. The first and the last leg may be others: these, and any path that
// is not free or not of this kind, are judged as among cells. Cost: some ns a step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
// Walls of a maze that can be looked up one by one as cheaply as tile by tile, say in bits: whoever asks for those near
// a path pays for the path.

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

/// As verify_path among the same walls held, of a point or disc that keeps off them: InputError where contact is
/// allowed. A wall is named by its ends alone. The result is the same for any number of threads.
Verification verify_among_cells(const CellWallSource& cells, std::span<const Vec2> path, const VerifyOptions& options,
                                const Execution& execution);

/// The least distance that was met, and the first leg that comes too near a wall, with that wall's number.
struct NearestWalls {
  double least;
  std::uint64_t leg, wall;
};

/// Looks at the walls of these tiles alone, as far as `reach` around each leg: a share of the judge's work.
NearestWalls nearest_among_cells(const CellWallSource& cells, Range tiles, std::span<const Vec2> path,
                                 const VerifyOptions& options, double reach, const Execution& execution);

/// Who looks at the other tiles where the judge looks at some.
class JudgesElsewhere : NotCopied {
 public:
  virtual ~JudgesElsewhere() = default;
  /// The tiles that are left to the judge itself.
  virtual Range own_tiles() const = 0;
  /// They begin to look at a path, which stays until take().
  virtual void begin(std::span<const Vec2> path, double reach) = 0;
  /// Waits for what they have found, one each.
  virtual std::vector<NearestWalls> take() = 0;
};

/// The same of a path that comes in pieces, of which none is kept. Refers to the cells, which must outlive it.
class JudgeAmongCells {
 public:
  /// others: look at the tiles that are not theirs, where there are such.
  JudgeAmongCells(const CellWallSource& cells, const VerifyOptions& options, const Execution& execution,
                  JudgesElsewhere* others = nullptr);
  /// The points that follow; each piece but the first begins with the last point of the one before.
  void add(std::span<const Vec2> piece);
  /// Of all pieces, at least one.
  Verification verdict() const;

 private:
  Tally compared(const LegBoxes& legs) const;

  const CellWallSource& cells_;
  const VerifyOptions options_;
  const Execution execution_;
  JudgesElsewhere* others_;
  std::uint64_t points_ = 0;
  std::array<Vec2, 2> ends_{};  // the first point, and the last so far
  LegReport report_;
  double length_ = 0.0;
};

/// As verify_among_cells, a look at a wall a step of a path over a lattice.
Verification verify_steps(const LookedUpWalls& walls, std::span<const Vec2> path, const VerifyOptions& options,
                          const Execution& execution);

}  // namespace warren
