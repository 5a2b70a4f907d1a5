// SPDX-License-Identifier: BSD-3-Clause
// What all maze algorithms share: names, the cells, loops, and the scene around the walls. Loops are chosen by
// selection sampling (Knuth, TAOCP 2, 3.4.2, algorithm S): one pass over the walls, exactly the number asked for, each
// subset as likely as any other.
#include "scenes/mazes/maze_generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_carving.hpp"
#include "scenes/mazes/spanning_maze.hpp"

namespace warren {
namespace {

constexpr std::size_t generator_grain = std::size_t{1} << 18;

struct Algorithm {
  MazeAlgorithm id;
  std::string_view name;
  void (*carve)(MazeCells&, std::uint64_t, const Execution&);
};
constexpr std::array<Algorithm, 6> algorithms{{{MazeAlgorithm::backtracker, "backtracker", maze::carve_backtracker},
                                               {MazeAlgorithm::kruskal, "kruskal", maze::carve_kruskal},
                                               {MazeAlgorithm::prim, "prim", maze::carve_prim},
                                               {MazeAlgorithm::wilson, "wilson", maze::carve_wilson},
                                               {MazeAlgorithm::course, "course", maze::carve_course},
                                               {MazeAlgorithm::mst, "mst", maze::carve_mst}}};

const Algorithm& algorithm_of(MazeAlgorithm id) { return algorithms.at(static_cast<std::size_t>(id)); }

void check_size(std::uint32_t rows, std::uint32_t cols) {
  const std::uint64_t count = std::uint64_t{rows} * cols;
  if (count >= 1 && count <= std::numeric_limits<std::uint32_t>::max()) return;
  throw InputError("maze", "rows and columns must be at least 1 and rows x columns below 2^32",
                   fmt::format("{}x{}", rows, cols));
}

void fill_bytes(std::span<std::uint8_t> bytes, std::uint8_t value, const Execution& execution) {
  for_chunks(bytes.size(), generator_grain, execution,
             [&](Range r) { std::fill(bytes.begin() + r.first, bytes.begin() + r.last, value); });
}

void clear_scratch(MazeCells& cells, const Execution& execution) {
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_chunks(bytes.size(), generator_grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) bytes[i] &= MazeCells::all_walls;
  });
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

}  // namespace

namespace maze {
void mark_gaps(MazeCells& cells, std::uint8_t bits, const Execution& execution) {
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_chunks(cells.cols() + std::size_t{1}, generator_grain, {execution.threads, execution.deadline}, [&](Range r) {
    for (std::size_t gap = r.first; gap < r.last; ++gap) bytes[gap * cells.stride()] |= bits;
  });
}
}  // namespace maze

std::string_view name_of(MazeAlgorithm algorithm) { return algorithm_of(algorithm).name; }

MazeAlgorithm maze_algorithm_named(std::string_view name) {
  std::string known;
  for (const Algorithm& algorithm : algorithms) {
    if (algorithm.name == name) return algorithm.id;
    known.append(known.empty() ? "" : ", ").append(algorithm.name);
  }
  throw InputError("maze", "the algorithm must be one of " + known, name);
}

MazeCells::MazeCells(std::uint32_t rows, std::uint32_t cols, const Execution& execution) : rows_(rows), cols_(cols) {
  check_size(rows, cols);
  const std::size_t bytes = cols * stride() + 1;
  execution.reserve(bytes);
  bits_.resize(bytes);
  fill_bytes(bits_, all_walls, execution);
}

MazeCells generate_maze(const MazeOptions& options, const Execution& execution) {
  if (!(options.loops >= 0.0 && options.loops <= 1.0)) {
    throw InputError("maze", "loops must be a fraction from 0 to 1", fmt::format("{}", options.loops));
  }
  check_size(options.rows, options.cols);
  MazeCells cells(options.rows, options.cols, {execution.threads, execution.deadline});
  if (execution.progress != nullptr) execution.progress->begin("generate", cells.cell_count());
  algorithm_of(options.algorithm).carve(cells, options.seed, execution);
  clear_scratch(cells, {execution.threads, execution.deadline});
  if (options.loops > 0.0 && options.algorithm == MazeAlgorithm::mst) {
    maze::open_drawn_loops(cells, options.loops, options.seed, {execution.threads, execution.deadline});
  } else if (options.loops > 0.0) {
    const std::uint64_t standing = interior_walls(cells, {execution.threads, execution.deadline});
    const auto count = static_cast<std::uint64_t>(std::round(options.loops * static_cast<double>(standing)));
    open_loops(cells, std::min(count, standing), standing, options.seed, execution);
  }
  return cells;
}

namespace {

/// All but the walls.
void describe(const MazeOptions& options, Scene& scene) {
  scene.maze = MazeHint{options.rows, options.cols};
  scene.start = {0.5, 1.0};
  scene.goal = {options.cols + 0.5, static_cast<double>(options.rows)};
  scene.source = fmt::format("maze:{}x{},seed={},algorithm={},loops={}", options.rows, options.cols, options.seed,
                             name_of(options.algorithm), options.loops);
  if (options.algorithm == MazeAlgorithm::mst) scene.formula = MazeFormula{options.seed, options.loops};
}

}  // namespace

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

}  // namespace warren
