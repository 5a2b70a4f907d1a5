// SPDX-License-Identifier: BSD-3-Clause
// The algorithms but mst, and what all share: names, the cells, loops, and the scene around the walls. Mazes that grow
// cell by cell: recursive backtracker, randomised Prim, and Wilson's loop-erased walks. Mazes that join regions of
// cells: randomised Kruskal, and the biased one of the course. Each carve_* takes cells whose walls all stand and
// opens rows * cols - 1 of them so that every cell reaches every other in exactly one way; scratch bits in the cells'
// bytes may stay behind. Loops are chosen by selection sampling (Knuth, TAOCP 2, 3.4.2, algorithm S): one pass over
// the walls, exactly the number asked for, each subset as likely as any other.
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
#include "core/search/union_find.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "parallel/sort.hpp"
#include "scenes/mazes/spanning_maze.hpp"

namespace warren::maze {
namespace {

/// Scratch bits of a cell's byte while a maze is carved.
constexpr std::uint8_t in_maze = 4;
constexpr std::uint8_t in_frontier = 8;
constexpr std::uint8_t outside = 0x80;   ///< marks the gap bytes
constexpr unsigned direction_shift = 4;  ///< two bits hold a direction
constexpr std::uint8_t direction_bits = 3U << direction_shift;

/// Directions are 0 right, 1 up, 2 left, 3 down; the opposite is d ^ 2.
class Steps {
 public:
  explicit Steps(MazeCells& cells)
      : bytes_(cells.bytes().data()),
        end_(cells.bytes().size()),
        offsets_{static_cast<std::ptrdiff_t>(cells.stride()), 1, -static_cast<std::ptrdiff_t>(cells.stride()), -1} {}

  /// The neighbour's index; may be a gap byte, and right of the last or left of the first column it is no index at all.
  std::size_t neighbour(std::size_t i, unsigned d) const { return i + static_cast<std::size_t>(offsets_[d]); }
  bool is_index(std::size_t i) const { return i < end_; }
  std::uint8_t& operator[](std::size_t i) const { return bytes_[i]; }

  /// Takes out the wall between cell i and its neighbour in direction d.
  void open(std::size_t i, unsigned d) const {
    const std::size_t owner = d < 2 ? i : neighbour(i, d);
    bytes_[owner] = static_cast<std::uint8_t>(bytes_[owner] & ~(1U << (d & 1U)));
  }
  /// Which of the four neighbours exist and have exactly `value` among `bits`; bit d stands for direction d. Gap bytes
  /// are looked at like cells, so they must differ.
  unsigned neighbours_with(std::size_t i, std::uint8_t bits, std::uint8_t value) const {
    unsigned mask = (bytes_[i + 1] & bits) == value ? 2U : 0U;
    mask |= (bytes_[i - 1] & bits) == value ? 8U : 0U;
    if (is_index(neighbour(i, 0))) mask |= (bytes_[neighbour(i, 0)] & bits) == value ? 1U : 0U;
    if (i > static_cast<std::size_t>(offsets_[0])) mask |= (bytes_[neighbour(i, 2)] & bits) == value ? 4U : 0U;
    return mask;
  }

 private:
  std::uint8_t* bytes_;
  std::size_t end_;
  std::array<std::ptrdiff_t, 4> offsets_;
};

/// By mask of directions, 1 to 15: twelve of them, each as often as the others.
constexpr std::array<std::uint8_t, 256> direction_choices = [] {
  std::array<std::uint8_t, 256> choices{};
  for (unsigned mask = 1; mask < 16; ++mask) {
    std::array<std::uint8_t, 4> candidates{};
    unsigned count = 0;
    for (std::uint8_t d = 0; d < 4; ++d) {
      if ((mask >> d & 1U) != 0) candidates[count++] = d;
    }
    for (unsigned k = 0; k < 12; ++k) choices[mask * 16 + k] = candidates[k % count];
  }
  return choices;
}();
/// One of the directions in a mask: one random number below 12 serves 1, 2, 3 and 4 candidates alike.
unsigned choose_direction(unsigned mask, SequentialRng& rng) { return direction_choices[mask * 16 + rng.below(12)]; }

/// Looks at the deadline every 16384th step and tells how many cells are carved.
class StepPoll {
 public:
  explicit StepPoll(const Execution& execution) : execution_(execution) {}
  void step(std::uint64_t carved) {
    if ((++steps_ & 0x3fffU) != 0) return;
    execution_.check();
    execution_.advance(carved - told_);
    told_ = carved;
  }

 private:
  const Execution& execution_;
  std::uint64_t steps_ = 0;
  std::uint64_t told_ = 0;
};

/// The parents of 0 .. count - 1 as root_of() and unite() take them, each a region of its own. Throws Stopped.
template <class Id>
RawVector<Id> single_regions(std::size_t count, const Execution& execution) {
  RawVector<Id> parents(count);
  for_each_index(count, std::size_t{1} << 16, {execution.threads, execution.deadline},
                 [&](std::size_t i) { parents[i] = static_cast<Id>(i); });
  return parents;
}

/// Gives the gap bytes further bits, so that no walk enters them.
void mark_gaps(MazeCells& cells, std::uint8_t bits, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 18;
  const auto bytes = cells.bytes();
  for_each_index(cells.cols() + std::size_t{1}, grain, {execution.threads, execution.deadline},
                 [&](std::size_t gap) { bytes[gap * cells.stride()] |= bits; });
}

/// Recursive backtracker: a depth-first walk that goes to a random neighbour not yet visited and, where there is none,
/// one step back. Long winding corridors, few dead ends. Needs no stack: the way back is a direction of two bits in
/// each cell's own byte, so the whole generator lives in 1 byte a cell. Each cell is entered once and left back once:
/// O(cells), 30 to 60 ns each; the walk is local, so caches serve it at any size.
void carve_backtracker(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  mark_gaps(cells, in_maze, execution);
  const Steps at(cells);
  SequentialRng rng(seed);
  StepPoll poll(execution);
  std::size_t i = cells.index(0, 0);
  at[i] |= in_maze;
  for (std::uint64_t left = cells.cell_count() - 1; left > 0;) {
    poll.step(cells.cell_count() - left);
    const unsigned unvisited = at.neighbours_with(i, in_maze, 0);
    if (unvisited == 0) {
      i = at.neighbour(i, at[i] >> direction_shift & 3U);
      continue;
    }
    const unsigned d = choose_direction(unvisited, rng);
    at.open(i, d);
    i = at.neighbour(i, d);
    at[i] = static_cast<std::uint8_t>(at[i] | in_maze | (d ^ 2U) << direction_shift);
    --left;
  }
}

/// Randomised Prim, the variant over cells: the maze grows from its middle by a random cell of the frontier, joined to
/// a random neighbour that is in the maze already. Short dead ends, direct ways. O(cells); the frontier is a list of
/// cells, a few times the longer side.
void carve_prim(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  mark_gaps(cells, in_frontier, execution);  // never fresh, and never in the maze
  const Steps at(cells);
  SequentialRng rng(seed);
  StepPoll poll(execution);
  std::vector<std::size_t> frontier;
  const auto add_to_maze = [&](std::size_t i) {
    at[i] |= in_maze;
    const unsigned fresh = at.neighbours_with(i, in_maze | in_frontier, 0);
    for (unsigned d = 0; d < 4; ++d) {
      if ((fresh >> d & 1U) == 0) continue;
      const std::size_t to = at.neighbour(i, d);
      at[to] |= in_frontier;
      push_asked(frontier, to, execution);
    }
  };
  add_to_maze(cells.index(cells.cols() / 2, cells.rows() / 2));
  for (std::uint64_t carved = 1; !frontier.empty(); ++carved) {
    poll.step(carved);
    std::size_t& drawn = frontier[rng.below(frontier.size())];
    const std::size_t i = drawn;
    drawn = frontier.back();
    frontier.pop_back();
    at.open(i, choose_direction(at.neighbours_with(i, in_maze, in_maze), rng));
    add_to_maze(i);
  }
}

/// Wilson's algorithm (STOC 1996): loop-erased random walks, each from the next cell outside the tree until it meets
/// the tree. Every perfect maze is equally likely: a uniform spanning tree. A walk leaves in each cell the direction in
/// which it was last left, two bits of the cell's byte, so loops erase themselves and 1 byte a cell is all. The root is
/// the middle cell: the tree's law doesn't depend on it, the expected number of steps (4 times the sum of the effective
/// resistances to it, about 10 a cell at 1000 x 1000, growing with the logarithm of the side) is least there.
void carve_wilson(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  mark_gaps(cells, in_maze | outside, execution);
  const Steps at(cells);
  SequentialRng rng(seed);
  std::uint64_t bits = 0;  // two a direction
  unsigned left = 0;       // directions in them
  const auto draw_direction = [&] {
    if (left == 0) {
      bits = rng.next();
      left = 32;
    }
    --left;
    return static_cast<unsigned>(std::exchange(bits, bits >> 2) & 3U);
  };
  StepPoll poll(execution);
  std::uint64_t carved = 0;
  at[cells.index(cells.cols() / 2, cells.rows() / 2)] |= in_maze;
  for (std::size_t begin = 1; begin < cells.bytes().size(); ++begin) {
    poll.step(carved);
    for (std::size_t i = begin; (at[i] & in_maze) == 0;) {  // no step for gap bytes: they count as tree
      poll.step(carved);
      const unsigned d = draw_direction();
      const std::size_t to = at.neighbour(i, d);
      if (!at.is_index(to) || (at[to] & outside) != 0) continue;  // draw again: uniform among those that exist
      at[i] = static_cast<std::uint8_t>((at[i] & ~direction_bits) | d << direction_shift);
      i = to;
    }
    for (std::size_t i = begin; (at[i] & in_maze) == 0; ++carved) {
      const unsigned d = at[i] >> direction_shift & 3U;
      at[i] |= in_maze;
      at.open(i, d);
      i = at.neighbour(i, d);
    }
  }
}

/// Walls are numbered by twice the index of the cell that owns them, plus 1 for its upper one.
template <class Id>
void carve(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  execution.reserve((2 * cells.cell_count() + cells.bytes().size()) * sizeof(Id));
  RawVector<Id> walls(2 * cells.cell_count() - cells.rows() - cells.cols());  // the interior ones
  std::size_t left = 0;
  for (std::uint32_t col = 0; col < cells.cols(); ++col) {
    for (std::uint32_t row = 0; row < cells.rows(); ++row) {
      const std::size_t i = cells.index(col, row);
      if ((i & 0xffffU) == 0) execution.check();
      if (col + 1 < cells.cols()) walls[left++] = static_cast<Id>(2 * i);
      if (row + 1 < cells.rows()) walls[left++] = static_cast<Id>(2 * i + 1);
    }
  }
  RawVector<Id> regions = single_regions<Id>(cells.bytes().size(), execution);
  const Steps at(cells);
  SequentialRng rng(seed);
  StepPoll poll(execution);
  for (std::uint64_t carved = 1; carved < cells.cell_count();) {
    poll.step(carved);
    const std::size_t drawn = rng.below(left);
    const Id wall = walls[drawn];
    walls[drawn] = walls[--left];
    const auto i = static_cast<Id>(wall / 2);
    const unsigned d = wall % 2;
    if (!unite(regions, i, static_cast<Id>(at.neighbour(i, d)))) continue;
    at.open(i, d);
    ++carved;
  }
}

/// Cells, numbered column by column from 0, and their place counted from 1 as the course does.
struct Place {
  std::uint64_t col, row;
};

/// Randomised Kruskal: the interior walls in random order, each taken out if it parts two regions. Many short dead
/// ends. The order is a Fisher-Yates shuffle done as it is consumed, so it ends with the last join. O(cells) in
/// practice, about 12 bytes a cell besides the cells (two wall numbers and one parent), 24 from 2^31 bytes of cells on.
void carve_kruskal(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  if (cells.bytes().size() <= std::numeric_limits<std::uint32_t>::max() / 2) {
    carve<std::uint32_t>(cells, seed, execution);
  } else {
    carve<std::uint64_t>(cells, seed, execution);
  }
}

/// The maze generator of the robotics course whose assignment started this project: a biased randomised Kruskal. Of 15
/// cells drawn at random the one is taken that is not yet joined to the first cell, then that nearest to it (col +
/// row), then the first drawn; one of its walls is drawn with a preference that changes from block to block, and goes
/// if it parts two regions. So growth starts near the entrance, and patches of long horizontal and vertical corridors
/// appear. Expected O(cells log cells), 1 to 2 microseconds a cell; 5 bytes a cell.
void carve_course(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  execution.reserve(cells.cell_count() * sizeof(std::uint32_t));
  const Steps at(cells);
  RawVector<std::uint32_t> regions = single_regions<std::uint32_t>(cells.cell_count(), execution);
  SequentialRng rng(seed);
  StepPoll poll(execution);
  const std::uint32_t rows = cells.rows();
  // Square blocks of side min(rows, cols) / parts, a rational number: parts is the least odd number >= 3 that makes it
  // 12 at most. Even blocks prefer to open upwards and downwards, odd ones sideways.
  const std::uint64_t side = std::min(rows, cells.cols());
  std::uint64_t parts = 3;
  while (side > 12 * parts) parts += 2;
  const auto block_of = [&](std::uint64_t k) { return (k * parts + side - 1) / side; };
  const std::uint64_t blocks_across = block_of(cells.cols());
  const auto place = [&](std::uint32_t cell) { return Place{cell / rows + 1U, cell % rows + 1U}; };
  const auto draw_cell = [&] {
    constexpr int draws = 15;
    const std::uint32_t home = root_of(regions, std::uint32_t{0});
    std::uint32_t best = 0;
    std::uint64_t best_key = ~std::uint64_t{0};
    for (int k = 0; k < draws; ++k) {
      const auto cell = static_cast<std::uint32_t>(rng.below(cells.cell_count()));
      const Place p = place(cell);
      const std::uint64_t joined = root_of(regions, cell) == home ? 1 : 0;
      const std::uint64_t key = joined << 40 | (p.col + p.row);
      if (key < best_key) {
        best_key = key;
        best = cell;
      }
    }
    return best;
  };
  const auto draw_direction = [&](Place p) {
    constexpr std::array<unsigned, 4> plain{2, 0, 3, 1};  // the course's 1 .. 4: -x, +x, -y, +y
    const std::uint64_t drawn = rng.below(8);
    if (drawn < 4) return plain[drawn];
    const std::uint64_t block = block_of(p.row) * blocks_across + block_of(p.col);
    const unsigned backward = block % 2 == 0 ? 3 : 2;
    return drawn < 6 ? backward : backward ^ 2U;
  };
  for (std::uint64_t carved = 1; carved < cells.cell_count();) {
    poll.step(carved);
    const std::uint32_t cell = draw_cell();
    const Place p = place(cell);
    const unsigned d = draw_direction(p);
    const bool has_neighbour = d == 0 ? p.col < cells.cols() : d == 1 ? p.row < rows : d == 2 ? p.col > 1 : p.row > 1;
    if (!has_neighbour) continue;
    const std::uint32_t neighbour = d == 0 ? cell + rows : d == 1 ? cell + 1 : d == 2 ? cell - rows : cell - 1;
    if (!unite(regions, cell, neighbour)) continue;
    at.open(cells.index(static_cast<std::uint32_t>(p.col - 1), static_cast<std::uint32_t>(p.row - 1)), d);
    ++carved;
  }
}

}  // namespace
}  // namespace warren::maze

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

/// All that are the source's.
void fill_cells(const CellWallSource& source, MazeCells& cells, const Execution& execution,
                Progress* filled = nullptr) {
  copy_tiles(source, 0, 1, 0, cells, execution, filled);
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

bool has_outline(const WallSet& walls, const Box& outline, const Execution& execution) {
  const auto in_chunk = [&](Range r) {
    RawVector<Piece> found;
    for (std::size_t i = r.first; i < r.last; ++i) {
      if (const auto piece = piece_of(walls.segment(i), outline)) push_asked(found, *piece, execution);
    }
    return found;
  };
  RawVector<Piece> pieces =
      joined_parts(parts_of_chunks(walls.size(), outline_grain, execution, in_chunk), execution.quiet());
  polled_sort(pieces.begin(), pieces.end(), execution);
  const double low[4] = {outline.min.x, outline.min.x, outline.min.y + 1.0, outline.min.y};
  const double high[4] = {outline.max.x, outline.max.x, outline.max.y, outline.max.y - 1.0};
  double covered[4] = {low[0], low[1], low[2], low[3]};
  for (const Piece& piece : pieces) {
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
  const Execution quiet{execution.threads, execution.deadline};
  MazeCells cells(options.rows, options.cols, quiet);
  if (execution.progress != nullptr) execution.progress->begin("generate", cells.cell_count());
  if (options.algorithm == MazeAlgorithm::mst) {
    fill_cells(SpanningMaze(options.rows, options.cols, options.seed, options.loops, quiet), cells, quiet,
               execution.progress);
    return cells;
  }
  carvers.at(static_cast<std::size_t>(options.algorithm))(cells, options.seed, execution);
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_each_index(bytes.size(), generator_grain, quiet, [&](std::size_t i) { bytes[i] &= MazeCells::all_walls; });
  if (options.loops > 0.0) {
    const std::uint64_t standing = (std::uint64_t{options.rows} - 1) * (options.cols - 1);  // in a perfect maze
    const auto count = static_cast<std::uint64_t>(std::round(options.loops * static_cast<double>(standing)));
    open_loops(cells, count, standing, options.seed, execution);
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
  if (!merged) {
    const std::uint64_t interior = (std::uint64_t{options.rows} - 1) * (options.cols - 1);
    execution.reserve(std::uint64_t{options.rows} * options.cols +
                      interior * maze_wall_bytes(options.rows, options.cols));
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

void copy_tiles(const CellWallSource& source, std::size_t first, std::size_t step, std::uint32_t first_col,
                MazeCells& cells, const Execution& execution, Progress* copied) {
  constexpr std::size_t grain = 8;  // a reader's scratch is large
  for_chunks((source.tile_count() - 1 - first) / step + 1, grain, execution, [&](Range r) {
    const auto reader = source.reader();
    CellTile tile;
    for (std::size_t i = r.first; i < r.last; ++i) {
      reader->read(first + i * step, tile);
      for (std::uint32_t col = 0; col < tile.width; ++col) {
        std::uint8_t* const column =
            cells.bytes().data() + cells.index(tile.first_col - first_col + col, tile.first_row);
        for (std::uint32_t row = 0; row < tile.height; ++row) column[row] = tile.walls[tile.index(col, row)];
      }
      if (copied != nullptr) copied->advance(std::uint64_t{tile.width} * tile.height);
    }
  });
}

MazeCells cells_from(const CellWallSource& source, const Execution& execution) {
  MazeCells cells(source.rows(), source.cols(), execution);
  fill_cells(source, cells, execution);
  return cells;
}

}  // namespace warren
