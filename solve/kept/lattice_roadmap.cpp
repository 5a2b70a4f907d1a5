// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/lattice_roadmap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/cell_bits.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/question/planner_choice.hpp"

namespace warren {
namespace {

Segment right_of(double col, double row) { return {{col + 1.5, row + 0.5}, {col + 1.5, row + 1.5}}; }
Segment above(double col, double row) { return {{col + 0.5, row + 1.5}, {col + 1.5, row + 1.5}}; }

constexpr std::uint32_t most_passes = 32;

constexpr std::size_t cells_in_word = 32;
constexpr std::size_t grain = std::size_t{1} << 14;  // words

/// Calls visit(cell of the word, its byte in `bytes`) for the cells of a word.
template <class Visit>
void for_each_cell(const MazeCells& cells, std::size_t word, const Visit& visit) {
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

LatticePassages passages_of(const Scene& scene, double reach, const Execution& execution) {
  if (auto passages = passages_of_maze(scene, reach, execution)) return std::move(*passages);
  const std::vector<Segment> bounds = bounds_walls(scene);
  return wall_passages({scene.walls, bounds, scene.bounds, reach, {scene.maze->rows, scene.maze->cols}}, execution);
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
  const std::size_t count = chunk_count(cells.cell_count(), cells_in_word);
  execution.reserve(count * sizeof(std::uint64_t));
  RawVector<std::uint64_t> words(count);
  for_each_index(words.size(), grain, execution, [&](std::size_t w) {
    words[w] = 0;
    for_each_cell(cells, w, [&](std::uint64_t i, std::size_t byte) {
      words[w] |= std::uint64_t{cells.bytes()[byte]} % 4 << (2 * i);
    });
  });
  return words;
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
  if (maze.rows == 0 || maze.cols == 0 || bits.size() != chunk_count(count, cells_in_word)) {
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

std::unique_ptr<KeptCells> cells_of_words(const std::string& where, MazeHint maze, std::span<const std::uint64_t> right,
                                          std::span<const std::uint64_t> up, const std::string& hash,
                                          const Execution& execution) {
  auto walls = std::make_unique<JudgedPassages>(where, maze.rows, maze.cols, right, up);
  const HashedCells found = hash_of_cells(*walls, execution);
  if (found.hash == hash) return std::make_unique<KeptCells>(std::move(walls), found.walls);
  throw InputError(where, fmt::format("the world inside is not its own, {}", hash), found.hash);
}

std::unique_ptr<KeptCells> cells_of_scene(const Scene& scene, const Execution& execution) {
  if (!is_nothing_but_maze(scene)) return nullptr;
  try {
    auto walls = std::make_unique<JudgedGridLines>(scene.walls, scene.maze->rows, scene.maze->cols, execution);
    return std::make_unique<KeptCells>(std::move(walls), scene.walls.size());
  } catch (const InputError&) {  // a wall off the grid, say
    return nullptr;
  }
}

KeptCells::KeptCells(std::unique_ptr<const LookedUpWalls> cells, std::size_t count)
    : walls(std::move(cells)), wall_count(count) {
  const std::ptrdiff_t cols = walls->cols();
  const std::ptrdiff_t rows = walls->rows();
  for (const std::ptrdiff_t col : {std::ptrdiff_t{-1}, cols - 1}) {
    std::ptrdiff_t row = 0;
    while (row + 1 < rows && (walls->walls_at(col, row) & CellTile::right_wall) == 0) ++row;
    rim_.push_back(right_of(col, row));
  }
  for (const std::ptrdiff_t row : {std::ptrdiff_t{-1}, rows - 1}) {
    std::ptrdiff_t col = 0;
    while (col + 1 < cols && (walls->walls_at(col, row) & CellTile::upper_wall) == 0) ++col;
    rim_.push_back(above(col, row));
  }
}

Scene KeptCells::walls_in(const Box& box) const {
  const auto cell = [](double x, std::uint32_t count) {
    return static_cast<std::ptrdiff_t>(std::clamp(std::floor(x - 0.5), 0.0, count - 1.0));
  };
  std::vector<Segment> found = rim_;
  for (std::ptrdiff_t row = cell(box.min.y, walls->rows()) - 1; row <= cell(box.max.y, walls->rows()); ++row) {
    for (std::ptrdiff_t col = cell(box.min.x, walls->cols()) - 1; col <= cell(box.max.x, walls->cols()); ++col) {
      const unsigned stand = walls->walls_at(col, row);
      if (row >= 0 && (stand & CellTile::right_wall) != 0) found.push_back(right_of(col, row));
      if (col >= 0 && (stand & CellTile::upper_wall) != 0) found.push_back(above(col, row));
    }
  }
  Scene scene;
  scene.walls = WallSet::narrowest(found);
  return scene;
}

const std::optional<MazeWorld>* WallsNearEnds::index(const Execution& execution) const {
  return indexed_.get_after(most_passes, execution, [&] {
    auto indexed = std::make_unique<std::optional<MazeWorld>>();
    memory_holds([&] { indexed->emplace(world_.whole(execution), reach_, execution); });
    return indexed;
  });
}

/// The walls that motions of a few cells around a place can meet, and those that reach farthest: the box of all walls,
/// which the reference point stays in, is theirs too.
Scene WallsNearEnds::around(const Scene& scene, Vec2 p, const Execution& execution) const {
  const Box near = room_of_motions(p);
  std::vector<Segment> walls;
  Box all;
  std::array<Segment, 4> farthest{};
  scene.walls.visit([&](auto held) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      execution.poll(i);
      const Segment s = held[i].segment();
      const Box box = box_of(s);
      if (near.meets(box)) walls.push_back(s);
      if (box.min.x < all.min.x) farthest[0] = s;
      if (box.min.y < all.min.y) farthest[1] = s;
      if (box.max.x > all.max.x) farthest[2] = s;
      if (box.max.y > all.max.y) farthest[3] = s;
      all.include(box);
    }
  });
  if (!all.empty()) walls.insert(walls.end(), farthest.begin(), farthest.end());
  Scene local;
  local.bounds = scene.bounds;
  local.walls = WallSet::narrowest(walls);
  return local;
}

std::unique_ptr<RouteIndex> lattice_index(const Scene& scene, const Question& body, const SolveOptions& options,
                                          const Execution& execution) {
  const RobotSpec robot = robot_of(scene, body);
  const bool is_maze = scene.maze && scene.polygons.empty() && !scene.map && !has_solids(scene) && is_round(robot);
  if (!is_maze || options.planner != PlannerKind::prm) return nullptr;
  const double reach = clearance_of(scene, body) + robot.radius;
  const RoadmapOptions roadmap = planner_options(options, scene, WallProblem{}).roadmap;
  const std::uint64_t cells = std::uint64_t{scene.maze->rows} * scene.maze->cols;
  if (cells < fewest_indexed_cells || !tiled_prm_applies(roadmap, reach)) return nullptr;
  try {
    return std::make_unique<RouteIndex>(passages_of(scene, reach, execution), RouteIndexOptions{}, execution);
  } catch (const InputError&) {  // it doesn't pay
    return nullptr;
  }
}

}  // namespace warren
