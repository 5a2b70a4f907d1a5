// SPDX-License-Identifier: BSD-3-Clause
#include "solve/streamed/streamed_walls.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/npy_maze_io.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "scenes/text/input_file_io.hpp"
#include "verify/streamed/looked_up_walls.hpp"

namespace warren {
namespace {

constexpr unsigned tile_side_log2 = CellBits::usual_side_log2;

Range cell_rows(MazeHint size, TileRows own) {
  return {own.first << tile_side_log2, std::min<std::size_t>(size.rows, own.last << tile_side_log2)};
}

/// The formula is what the maze is, for the judge, too.
class FormulaWalls : public StreamedWalls {
 public:
  FormulaWalls(MazeHint size, const MazeFormula& formula, const Execution& execution, KeptParts* kept)
      : maze_(size.rows, size.cols, formula.seed, formula.loops, execution, tile_side_log2, kept) {}
  const CellWallSource& planned() const override { return maze_; }
  const CellWallSource& judged() const override { return maze_; }

 private:
  SpanningMaze maze_;
};

class FileWalls : public StreamedWalls {
 public:
  FileWalls(const PackedMaze& packed, TileRows own, const Execution& execution)
      : file_(packed.file, execution),
        planned_(file_),
        judged_(file_.name(), file_.bytes(),
                [this](std::size_t first, std::size_t last) { file_.forget(first, last); }) {
    planned_.check({own.first > 0 ? own.first - 1 : 0, own.last}, execution);  // tiles have the row below them, too
    if (planned_.hash() != packed.hash) throw InputError(packed.file, "has changed since it was looked at first");
  }
  const CellWallSource& planned() const override { return planned_; }
  const CellWallSource& judged() const override { return judged_; }

 private:
  InputFile file_;
  MazeFile planned_;
  JudgedMazeFile judged_;
};

/// Two passes over an array: the planner's, and the judge's.
class ArrayWalls : public StreamedWalls {
 public:
  ArrayWalls(const PackedMaze& packed, MazeHint size, TileRows own, const Execution& execution)
      : file_(packed.file, execution),
        planned_(file_, size, execution, own),
        judged_(
            file_.name(), file_.bytes(), size.rows, size.cols, cell_rows(size, own),
            [this](std::size_t first, std::size_t last) { file_.forget(first, last); }, execution) {}
  const CellWallSource& planned() const override { return planned_.cells(); }
  const CellWallSource& judged() const override { return judged_; }
  std::optional<std::size_t> wall_count() const override { return planned_.wall_count(); }
  std::optional<std::string> hash() const override { return planned_.hash(); }

 private:
  InputFile file_;
  NpyMaze planned_;
  JudgedNpyMaze judged_;
};

}  // namespace

std::unique_ptr<StreamedWalls> streamed_walls(const Scene& unmade, TileRows own, const Execution& execution) {
  if (unmade.packed->hash) return std::make_unique<FileWalls>(*unmade.packed, own, execution);
  return std::make_unique<ArrayWalls>(*unmade.packed, *unmade.maze, own, execution);
}

std::unique_ptr<StreamedWalls> streamed_walls(const Scene& unmade, const Execution& execution, KeptParts* kept) {
  if (unmade.packed) return streamed_walls(unmade, {0, ((unmade.maze->rows - 1) >> tile_side_log2) + 1}, execution);
  return std::make_unique<FormulaWalls>(*unmade.maze, *unmade.formula, execution, kept);
}

}  // namespace warren
