// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/maze_bits.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/lengths/cell_marks.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

constexpr std::size_t cells_in_word = 32;
constexpr std::size_t grain = std::size_t{1} << 14;  // words

std::size_t words_for(std::uint64_t cells) { return (cells + cells_in_word - 1) / cells_in_word; }

/// Calls visit(cell of the word, its byte in `bytes`) for the cells of a word.
template <class Cells, class Visit>
void for_each_cell(const Cells& cells, std::size_t word, const Visit& visit) {
  const std::uint64_t first = word * cells_in_word;
  const std::uint64_t last = std::min(first + cells_in_word, cells.cell_count());
  auto col = static_cast<std::uint32_t>(first / cells.rows());
  auto row = static_cast<std::uint32_t>(first % cells.rows());
  for (std::uint64_t i = first; i < last; ++i) {
    visit(i - first, cells.index(col, row));
    if (++row < cells.rows()) continue;
    row = 0;
    ++col;
  }
}

RawVector<std::uint64_t> packed(const MazeCells& cells, const Execution& execution) {
  execution.reserve(words_for(cells.cell_count()) * sizeof(std::uint64_t));
  RawVector<std::uint64_t> words(words_for(cells.cell_count()));
  for_each_index(words.size(), grain, execution, [&](std::size_t w) {
    words[w] = 0;
    for_each_cell(cells, w, [&](std::uint64_t i, std::size_t byte) {
      words[w] |= std::uint64_t{cells.bytes()[byte]} % 4 << (2 * i);
    });
  });
  return words;
}

/// Calls visit(first column, first row, columns, rows) for the tiles of a lattice, on all threads.
template <class Visit>
void for_each_tile(LatticeSize size, const Execution& execution, const Visit& visit) {
  const LatticePlaces places(size);
  for_each_index(places.tile_count(), 16, execution, [&](std::size_t tile) {
    const auto first_col = static_cast<std::uint32_t>(tile % places.tile_cols()) * LatticePlaces::side;
    const auto first_row = static_cast<std::uint32_t>(tile / places.tile_cols()) * LatticePlaces::side;
    visit(first_col, first_row, std::min(LatticePlaces::side, size.cols - first_col),
          std::min(LatticePlaces::side, size.rows - first_row));
  });
}

/// The maze whose walls stand wherever there is no passage: tile by tile, so that the rows of bits and the columns of
/// bytes of a tile stay in the first-level cache.
MazeCells cells_of(const LatticePassages& lattice, const Execution& execution) {
  MazeCells cells(lattice.size().rows, lattice.size().cols, execution);
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_each_tile(lattice.size(), execution, [&](auto first_col, auto first_row, auto cols, auto rows) {
    for (std::uint32_t row = 0; row < rows; ++row) {
      const auto open = lattice.open_words(first_col, first_row + row);
      std::size_t at = cells.index(first_col, first_row + row);
      for (std::uint32_t col = 0; col < cols; ++col, at += cells.stride()) {
        const std::uint64_t passages = (open[0] >> col & 1U) | (open[1] >> col & 1U) << 1;
        bytes[at] = static_cast<std::uint8_t>(passages ^ MazeCells::all_walls);
      }
    }
  });
  return cells;
}

/// Do the first walls, as the course's order has them, reach to all sides of the maze?
bool begins_with_outline(const Scene& scene) {
  Box box;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, scene.walls.size()); ++i) {
    box.include(box_of(scene.walls.segment(i)));
  }
  return !box.empty() && box.min.x <= 0.5 && box.min.y <= 0.5 && box.max.x >= scene.maze->cols + 0.5 &&
         box.max.y >= scene.maze->rows + 0.5;
}

/// Tile by tile, as cells_of().
LatticePassages passages_between(const MazeCells& cells, const Execution& execution) {
  const LatticeSize size{cells.rows(), cells.cols()};
  PassageWords words = LatticePassages::closed(size, execution);
  const std::size_t stride = LatticePassages::words_a_row(size.cols);
  for_each_tile(size, execution, [&](auto first_col, auto first_row, auto cols, auto rows) {
    std::array<std::uint64_t, LatticePlaces::side> right{};
    std::array<std::uint64_t, LatticePlaces::side> up{};
    for (std::uint32_t col = 0; col < cols; ++col) {
      const std::uint8_t* const bytes = cells.bytes().data() + cells.index(first_col + col, first_row);
      for (std::uint32_t row = 0; row < rows; ++row) {
        const std::uint64_t open = ~std::uint64_t{bytes[row]};
        right[row] |= (open & 1U) << col;
        up[row] |= (open >> 1 & 1U) << col;
      }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
      const std::size_t word = (first_row + row) * stride + first_col / LatticePlaces::side;
      words.right[word] = right[row];
      words.up[word] = up[row];
    }
  });
  return {size, std::move(words)};
}

}  // namespace

std::optional<LatticePassages> passages_of_maze(const Scene& scene, double reach, const Execution& execution) {
  constexpr double widest = 0.49;  // of a half: whatever is rounded
  if (!scene.maze || scene.bounds || !scene.polygons.empty() || scene.map || !(reach <= widest)) return std::nullopt;
  if (!begins_with_outline(scene)) return std::nullopt;
  try {
    return passages_between(cells_of_walls(scene.walls, *scene.maze, execution), execution);
  } catch (const InputError&) {  // a wall off the grid
    return std::nullopt;
  }
}

std::optional<RawVector<std::uint64_t>> maze_bits(const Scene& scene, const Execution& execution) {
  if (!scene.maze || first_wall_off_grid(scene.walls, *scene.maze, execution)) return std::nullopt;
  const MazeCells cells = cells_of_walls(scene.walls, *scene.maze, execution);
  if (!has_maze_walls(scene.walls, cells, execution)) return std::nullopt;
  return packed(cells, execution);
}

bool has_walls_of(const LatticePassages& lattice, const Scene& scene, const Execution& execution) {
  return has_maze_walls(scene.walls, cells_of(lattice, execution), execution);
}

WallSet walls_of_lattice(const LatticePassages& lattice, const Execution& execution) {
  return maze_walls(cells_of(lattice, execution), false, execution);
}

WallSet walls_of_maze_bits(const std::string& where, MazeHint maze, std::span<const std::uint64_t> bits,
                           const Execution& execution) {
  const std::uint64_t count = std::uint64_t{maze.rows} * maze.cols;
  if (maze.rows == 0 || maze.cols == 0 || bits.size() != words_for(count)) {
    throw InputError(where, "expected two bits for each cell of the maze");
  }
  MazeCells cells(maze.rows, maze.cols, execution);
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_each_index(bits.size(), grain, execution, [&](std::size_t w) {
    for_each_cell(cells, w, [&](std::uint64_t i, std::size_t byte) {
      bytes[byte] = static_cast<std::uint8_t>(bits[w] >> (2 * i) & 3U);
    });
  });
  return maze_walls(cells, false, execution);
}

}  // namespace warren
