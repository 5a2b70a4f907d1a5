// SPDX-License-Identifier: BSD-3-Clause
// What all maze algorithms share: names, the cells, loops, and the scene around the walls. Loops are chosen by
// selection sampling (Knuth, TAOCP 2, 3.4.2, algorithm S): one pass over the walls, exactly the number asked for, each
// subset as likely as any other.

#include "scenes/mazes/maze_generator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_carving.hpp"
#include "scenes/mazes/spanning_maze.hpp"

namespace warren {
namespace {

constexpr std::size_t generator_grain = std::size_t{1} << 18;

/// In the order of MazeAlgorithm; mst, the last, is made tile by tile.
constexpr std::array<void (*)(MazeCells&, std::uint64_t, const Execution&), enum_names(MazeAlgorithm{}).size() - 1>
    carvers{maze::carve_backtracker, maze::carve_kruskal, maze::carve_prim, maze::carve_wilson, maze::carve_course};

void check_size(std::uint32_t rows, std::uint32_t cols) {
  const std::uint64_t count = std::uint64_t{rows} * cols;
  if (count >= 1 && count <= std::numeric_limits<std::uint32_t>::max()) return;
  throw InputError("maze", "rows and columns must be at least 1 and rows x columns below 2^32",
                   fmt::format("{}x{}", rows, cols));
}

void clear_scratch(MazeCells& cells, const Execution& execution) {
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_each_index(bytes.size(), generator_grain, execution, [&](std::size_t i) { bytes[i] &= MazeCells::all_walls; });
}

/// Takes out exactly `count` of the `standing` interior walls.
void open_loops(MazeCells& cells, std::uint64_t count, std::uint64_t standing, std::uint64_t seed,
                const Execution& execution) {
  constexpr std::uint64_t loop_stream = 0x6c6f6f7073;  // so that loops don't repeat the numbers that carved the maze
  SequentialRng rng(mix64(seed) ^ loop_stream);
  maze::StepPoll poll(execution);
  const auto falls = [&] { return rng.below(standing--) < count && count-- > 0; };
  for (std::uint32_t col = 0; col < cells.cols() && count > 0; ++col) {
    for (std::uint32_t row = 0; row < cells.rows() && count > 0; ++row) {
      poll.step(0);
      if (col + 1 < cells.cols() && cells.wall_right(col, row) && falls()) cells.open_right(col, row);
      if (row + 1 < cells.rows() && cells.wall_above(col, row) && falls()) cells.open_above(col, row);
    }
  }
}

/// All that are the source's; `filled` is told of each cell.
void fill_cells(const CellWallSource& source, MazeCells& cells, const Execution& execution,
                Progress* filled = nullptr) {
  constexpr std::size_t grain = 8;  // a reader's scratch is large
  for_chunks(source.tile_count(), grain, execution, [&](Range r) {
    const auto reader = source.reader();
    CellTile tile;
    for (std::size_t number = r.first; number < r.last; ++number) {
      reader->read(number, tile);
      copy_tile(tile, cells, tile.first_col);
      if (filled != nullptr) filled->advance(std::uint64_t{tile.width} * tile.height);
    }
  });
  cells.bytes()[cells.index(source.cols() - 1, source.rows() - 1)] |=
      MazeCells::right_wall;  // the exit is no cell's business
}

/// All but the walls.
void describe(const MazeOptions& options, Scene& scene) {
  set_maze(scene, {options.rows, options.cols});
  scene.source = fmt::format("maze:{}x{},seed={},algorithm={},loops={}", options.rows, options.cols, options.seed,
                             name_of(options.algorithm), options.loops);
  if (options.algorithm == MazeAlgorithm::mst) scene.formula = MazeFormula{options.seed, options.loops};
}

constexpr std::size_t outline_grain = std::size_t{1} << 16;

/// The size of a maze with these walls' box.
std::optional<MazeHint> size_of_box(const Box& box) {
  const double cols = box.max.x - 0.5;
  const double rows = box.max.y - 0.5;
  constexpr double most = std::numeric_limits<std::uint32_t>::max();
  if (box.empty() || box.min != Vec2{0.5, 0.5} || !(cols >= 1.0 && rows >= 1.0 && cols * rows <= most)) return {};
  if (cols != std::floor(cols) || rows != std::floor(rows)) return {};
  return MazeHint{static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
}

/// A wall on one side of the outline: 0 bottom, 1 top, 2 left, 3 right.
struct Piece {
  int side;
  double low;
  double high;
  friend bool operator<(const Piece& a, const Piece& b) { return std::tie(a.side, a.low) < std::tie(b.side, b.low); }
};

std::optional<Piece> piece_of(const Segment& wall, const Box& outline) {
  const Box box = box_of(wall);
  if (box.min == box.max) return {};
  if (box.max.y == outline.min.y) return Piece{0, box.min.x, box.max.x};
  if (box.min.y == outline.max.y) return Piece{1, box.min.x, box.max.x};
  if (box.max.x == outline.min.x) return Piece{2, box.min.y, box.max.y};
  if (box.min.x == outline.max.x) return Piece{3, box.min.y, box.max.y};
  return {};
}

/// In order of sides and places.
std::vector<Piece> pieces_of(const WallSet& walls, const Box& outline, const Execution& execution) {
  const auto in_chunk = [&](Range r) {
    std::vector<Piece> found;
    for (std::size_t i = r.first; i < r.last; ++i) {
      if (const auto piece = piece_of(walls.segment(i), outline)) found.push_back(*piece);
    }
    return found;
  };
  std::vector<Piece> pieces;
  for (const auto& part : parts_of_chunks(walls.size(), outline_grain, execution, in_chunk))
    pieces.insert(pieces.end(), part.begin(), part.end());
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

bool has_outline(const WallSet& walls, const Box& outline, const Execution& execution) {
  const double low[4] = {outline.min.x, outline.min.x, outline.min.y + 1.0, outline.min.y};
  const double high[4] = {outline.max.x, outline.max.x, outline.max.y, outline.max.y - 1.0};
  double covered[4] = {low[0], low[1], low[2], low[3]};
  for (const Piece& piece : pieces_of(walls, outline, execution)) {
    if (piece.low < low[piece.side] || piece.high > high[piece.side]) return false;  // it closes a door
    if (piece.low > covered[piece.side]) return false;                               // a gap
    covered[piece.side] = std::max(covered[piece.side], piece.high);
  }
  return std::equal(std::begin(covered), std::end(covered), std::begin(high));
}

}  // namespace

MazeAlgorithm maze_algorithm_named(std::string_view name) {
  if (const auto algorithm = enum_named<MazeAlgorithm>(name)) return *algorithm;
  throw InputError("maze", fmt::format("the algorithm must be one of {}", fmt::join(enum_names(MazeAlgorithm{}), ", ")),
                   name);
}

MazeCells::MazeCells(std::uint32_t rows, std::uint32_t cols, const Execution& execution) : rows_(rows), cols_(cols) {
  check_size(rows, cols);
  const std::size_t bytes = cols * stride() + 1;
  execution.reserve(bytes);
  bits_.resize(bytes);
  for_chunks(bytes, generator_grain, execution,
             [&](Range r) { std::fill(bits_.begin() + r.first, bits_.begin() + r.last, all_walls); });
}

void set_maze(Scene& scene, MazeHint maze) {
  scene.maze = maze;
  scene.start = {0.5, 1.0};
  scene.goal = {maze.cols + 0.5, static_cast<double>(maze.rows)};
}

MazeCells generate_maze(const MazeOptions& options, const Execution& execution) {
  if (!(options.loops >= 0.0 && options.loops <= 1.0)) {
    throw InputError("maze", "loops must be a fraction from 0 to 1", fmt::format("{}", options.loops));
  }
  MazeCells cells(options.rows, options.cols, {execution.threads, execution.deadline});
  if (execution.progress != nullptr) execution.progress->begin("generate", cells.cell_count());
  if (options.algorithm == MazeAlgorithm::mst) {
    const Execution quiet{execution.threads, execution.deadline};
    fill_cells(SpanningMaze(options.rows, options.cols, options.seed, options.loops, quiet), cells, quiet,
               execution.progress);
    return cells;
  }
  carvers.at(static_cast<std::size_t>(options.algorithm))(cells, options.seed, execution);
  clear_scratch(cells, {execution.threads, execution.deadline});
  if (options.loops > 0.0) {
    const std::uint64_t standing = interior_walls(cells, {execution.threads, execution.deadline});
    const auto count = static_cast<std::uint64_t>(std::round(options.loops * static_cast<double>(standing)));
    open_loops(cells, std::min(count, standing), standing, options.seed, execution);
  }
  return cells;
}

Scene unmade_maze_scene(const MazeOptions& options) {
  check_spanning_maze(options.rows, options.cols, options.loops);
  Scene scene;
  describe(options, scene);
  return scene;
}

Scene maze_scene(const MazeOptions& options, bool merged, const Execution& execution) {
  check_size(options.rows, options.cols);
  const std::uint64_t interior = (std::uint64_t{options.rows} - 1) * (options.cols - 1);
  if (!merged) {
    const std::size_t wall_bytes = maze_wall_bytes(options.rows, options.cols);
    execution.reserve(std::uint64_t{options.rows} * options.cols + interior * wall_bytes);
  }
  const MazeCells cells = generate_maze(options, execution);
  Scene scene;
  scene.walls = maze_walls(cells, merged, execution);
  describe(options, scene);
  return scene;
}

std::optional<MazeHint> maze_of_walls(const WallSet& walls, const Execution& execution) {
  const Box box = box_of_walls(walls, execution);
  const std::optional<MazeHint> hint = size_of_box(box);
  if (!hint || !has_outline(walls, box, execution) || first_wall_off_grid(walls, *hint, execution)) return {};
  return hint;
}

MazeCells cells_from(const CellWallSource& source, const Execution& execution) {
  MazeCells cells(source.rows(), source.cols(), execution);
  fill_cells(source, cells, execution);
  return cells;
}

}  // namespace warren
