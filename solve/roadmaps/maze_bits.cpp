// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/maze_bits.hpp"

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
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
  for (std::uint64_t i = first; i < last; ++i) {
    visit(i - first,
          cells.index(static_cast<std::uint32_t>(i / cells.rows()), static_cast<std::uint32_t>(i % cells.rows())));
  }
}

RawVector<std::uint64_t> packed(const MazeCells& cells, const Execution& execution) {
  execution.reserve(words_for(cells.cell_count()) * sizeof(std::uint64_t));
  RawVector<std::uint64_t> words(words_for(cells.cell_count()));
  for_chunks(words.size(), grain, execution, [&](Range r) {
    for (std::size_t w = r.first; w < r.last; ++w) {
      words[w] = 0;
      for_each_cell(cells, w, [&](std::uint64_t i, std::size_t byte) {
        words[w] |= std::uint64_t{cells.bytes()[byte]} % 4 << (2 * i);
      });
    }
  });
  return words;
}

bool same_walls(const WallSet& a, const WallSet& b, const Execution& execution) {
  if (a.holds_floats() != b.holds_floats() || a.size() != b.size()) return false;
  std::vector<std::uint8_t> same(chunk_count(a.size(), grain), 1);
  for_chunks(a.size(), grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) same[r.first / grain] &= a.segment(i) == b.segment(i) ? 1 : 0;
  });
  return std::find(same.begin(), same.end(), 0) == same.end();
}

}  // namespace

std::optional<RawVector<std::uint64_t>> maze_bits(const Scene& scene, const Execution& execution) {
  if (!scene.maze || first_wall_off_grid(scene.walls, *scene.maze, execution)) return std::nullopt;
  const MazeCells cells = cells_of_walls(scene.walls, *scene.maze, execution);
  if (!same_walls(maze_walls(cells, false, execution), scene.walls, execution)) return std::nullopt;
  return packed(cells, execution);
}

WallSet walls_of_maze_bits(const std::string& where, MazeHint maze, std::span<const std::uint64_t> bits,
                           const Execution& execution) {
  const std::uint64_t count = std::uint64_t{maze.rows} * maze.cols;
  if (maze.rows == 0 || maze.cols == 0 || bits.size() != words_for(count)) {
    throw InputError(where, "expected two bits for each cell of the maze");
  }
  MazeCells cells(maze.rows, maze.cols, execution);
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_chunks(bits.size(), grain, execution, [&](Range r) {
    for (std::size_t w = r.first; w < r.last; ++w) {
      for_each_cell(cells, w, [&](std::uint64_t i, std::size_t byte) {
        bytes[byte] = static_cast<std::uint8_t>(bits[w] >> (2 * i) & 3U);
      });
    }
  });
  return maze_walls(cells, false, execution);
}

}  // namespace warren
