// SPDX-License-Identifier: BSD-3-Clause
// One rank's share of a streamed run: rows of tiles of a maze, which it makes or reads, reduces and peels, expands and
// judges. It knows nothing of other ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/cell_bits.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "solve/streamed/solve_streamed.hpp"
#include "verify/streamed/verify_cells.hpp"

namespace warren::distributed {

/// What all ranks know before the first message: they are given the same words.
struct BandTask {
  Scene unmade;  ///< the maze without its walls; a file that has them as this rank sees it
  WallProblem problem;

  TileGrid grid() const { return TileGrid::of({unmade.maze->rows, unmade.maze->cols}, CellBits::usual_side_log2); }
  /// Of the judge.
  VerifyOptions judged() const { return {.radius = problem.robot.radius, .clearance = problem.clearance}; }
};

/// Rows of tiles first .. last - 1 of rank r: R r / p to R (r + 1) / p.
Range band_rows(std::size_t tile_rows, unsigned rank, unsigned ranks);
/// The rank that has a tile row.
unsigned rank_of_row(std::size_t row, std::size_t tile_rows, unsigned ranks);

/// Legs in a row that come near a band.
struct NearLegs {
  std::uint64_t first;  ///< leg of the path
  std::vector<Vec2> points;
};

/// How much of its tiles a rank hands on: dead ends that end within its band say nothing of the way between the ends.
enum class BandPeeling : std::uint32_t { none, band };

/// Who asks for walls: of files both have readers of their own.
enum class WallsFor : std::uint32_t { planner, judge };

class Band {
 public:
  /// own may be empty.
  Band(const BandTask& task, Range own);

  /// Reads what a file has of the own tiles, which can be read then, or makes their trees; what these say to the rest
  /// of the maze. Nothing where there are no tiles. Throws InputError, ReadError, Stopped.
  std::optional<maze::RimPart> make(const Execution& execution);
  /// What the rest of the maze makes of trees, of the row below as well. From now on tiles can be read.
  void turn(std::span<const std::uint64_t> edges) { maze_->turn(edges); }
  /// What was read of a file; nullptr where nothing was.
  const StreamedWalls* read() const { return read_.get(); }

  Range rows() const { return own_; }
  bool is_empty() const { return own_.first == own_.last; }
  Range tiles() const { return {own_.first * grid_.tile_cols, own_.last * grid_.tile_cols}; }
  const TileGrid& grid() const { return grid_; }
  const CellWallSource& walls(WallsFor who) const;

  /// Summaries of the own tiles without steps.
  std::vector<TileSummary> reduce(const OverlayEnds& ends, BandPeeling peeling, const Execution& execution);
  /// Directions of chains of own tiles; of others nothing.
  std::vector<std::vector<std::uint8_t>> steps_of(std::span<const TileChain> chains, const Execution& execution) const;
  NearestWalls judge(std::span<const NearLegs> legs, double reach, const Execution& execution) const;

 private:
  const BandTask task_;
  const TileGrid grid_;
  const Range own_;
  std::optional<SpanningMaze> maze_;     // made
  std::unique_ptr<StreamedWalls> read_;  // or read
  OverlayEnds ends_;                     // as reduce() was told
};

}  // namespace warren::distributed
