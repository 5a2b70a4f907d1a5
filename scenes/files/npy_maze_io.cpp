// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/npy_maze_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

constexpr std::uint64_t units_per_poll = std::uint64_t{1} << 16;

template <class T>
std::span<const WallOf<T>> walls_in(const InputFile& file, const NpyWalls& array) {
  const void* const data = file.bytes().data() + array.data;  // numbers lie on a multiple of 64 bytes
  return {static_cast<const WallOf<T>*>(data), array.walls};
}

bool is_aligned(const InputFile& file, const NpyWalls& array) {
  void* at = const_cast<char*>(file.bytes().data() + array.data);  // NOLINT: std::align takes no const
  std::size_t room = sizeof(double);
  return std::align(alignof(double), 1, at, room) != nullptr && room == sizeof(double);
}

/// Rows and columns of an outline in the order of the generator: below, above, left, right.
template <class T>
std::optional<MazeHint> size_of(std::span<const WallOf<T>> walls) {
  if (walls.size() < 4) return std::nullopt;
  const double cols = walls[0].x2 - 0.5;
  const double rows = walls[1].y1 - 0.5;
  const auto is_side = [](double x) { return x >= 1 && x <= MazeFile::most_side && x == std::floor(x); };
  if (!is_side(cols) || !is_side(rows)) return std::nullopt;
  const auto right = static_cast<T>(cols + 0.5);
  const auto top = static_cast<T>(rows + 0.5);
  constexpr T low = 0.5;
  const WallOf<T> outline[] = {
      {low, low, right, low}, {low, top, right, top}, {low, low + 1, low, top}, {right, low, right, top - 1}};
  if (!std::equal(std::begin(outline), std::end(outline), walls.begin())) return std::nullopt;
  return MazeHint{static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
}

/// With the row below the first.
Range cell_rows(MazeHint maze, std::optional<TileRows> held) {
  if (!held) return {0, maze.rows};
  const std::size_t first = held->first << CellBits::usual_side_log2;
  return {first > 0 ? first - 1 : 0, std::min<std::size_t>(maze.rows, held->last << CellBits::usual_side_log2)};
}

RawVector<std::uint8_t> empty_maze(Range rows, std::uint32_t cols, const Execution& execution) {
  const std::size_t bytes = rows.size() * bytes_a_row(cols);
  execution.reserve(bytes);
  RawVector<std::uint8_t> bits;
  assign_polled(bits, bytes, std::uint8_t{0}, [&] { execution.check(); });
  return bits;
}

template <class T>
std::uint64_t hash_of_rows(std::span<const WallOf<T>> walls) {
  return WallsHash::of_chunk(walls);
}

}  // namespace

std::optional<Scene> unmade_npy(const InputFile& file) {
  const NpyWalls array = npy_walls(file);
  if (!is_aligned(file, array)) return std::nullopt;
  const auto maze = array.is_float ? size_of(walls_in<float>(file, array)) : size_of(walls_in<double>(file, array));
  if (!maze) return std::nullopt;
  Scene scene;
  scene.maze = maze;
  scene.start = {0.5, 1.0};
  scene.goal = {maze->cols + 0.5, static_cast<double>(maze->rows)};
  scene.source = file.name();
  scene.packed = PackedMaze{file.name(), std::nullopt};
  return scene;
}

NpyMaze::NpyMaze(const InputFile& file, MazeHint maze, const Execution& execution, std::optional<TileRows> held)
    : array_(npy_walls(file)),
      maze_(maze),
      rows_(cell_rows(maze, held)),
      bits_(empty_maze(rows_, maze.cols, execution)),
      cells_(maze.rows, maze.cols, bits_.data(), {}, CellBits::usual_side_log2,
             static_cast<std::uint32_t>(rows_.first)) {
  for (std::uint32_t row = 0; row + 1 < maze.rows; ++row) stand(maze.cols - 1, row, CellTile::right_wall);
  for (std::uint32_t col = 0; col < maze.cols; ++col) stand(col, maze.rows - 1, CellTile::upper_wall);
  if (execution.progress != nullptr) execution.progress->begin("read", array_.walls);
  array_.is_float ? read<float>(file, execution) : read<double>(file, execution);
}

/// A window's chunks are hashed by all threads, which brings them into memory; then one thread sets its bits, of which
/// several may share a byte.
template <class T>
void NpyMaze::read(const InputFile& file, const Execution& execution) {
  constexpr std::size_t window = 8 * WallsHash::grain;  // walls: of the file no more is held at once
  const std::span<const WallOf<T>> walls = walls_in<T>(file, array_);
  WallsHash hash(walls.size());
  std::vector<std::uint64_t> parts;
  for (std::size_t first = 0; first < walls.size(); first += window) {
    const std::span<const WallOf<T>> some = walls.subspan(first, std::min(window, walls.size() - first));
    parts.assign(chunk_count(some.size(), WallsHash::grain), 0);
    for_chunks(some.size(), WallsHash::grain, execution,
               [&](Range r) { parts[r.first / WallsHash::grain] = hash_of_rows<T>(some.subspan(r.first, r.size())); });
    for (const std::uint64_t part : parts) hash.add(part);
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (i % WallsHash::grain == 0) execution.check();
      if (first + i >= 4) add<T>(file, first + i, some[i], execution);
    }
    file.forget(array_.data + first * sizeof(WallOf<T>), array_.data + (first + some.size()) * sizeof(WallOf<T>));
  }
  hash_ = hash.text();
}

/// Any number of walls may be as long as the maze is wide, so that units are counted, not walls.
template <class T>
void NpyMaze::add(const InputFile& file, std::size_t row, const WallOf<T>& wall, const Execution& execution) {
  const auto poll = [&] {
    if (++units_ % units_per_poll == 0) execution.check();
  };
  const double low_x = std::min(wall.x1, wall.x2) - 0.5;  // grid lines, from 0
  const double high_x = std::max(wall.x1, wall.x2) - 0.5;
  const double low_y = std::min(wall.y1, wall.y2) - 0.5;
  const double high_y = std::max(wall.y1, wall.y2) - 0.5;
  const auto refuse = [&](const char* what) {
    throw InputError(fmt::format("{}: row {}", file.name(), row), what,
                     fmt::format("{} {} {} {}", wall.x1, wall.y1, wall.x2, wall.y2));
  };
  const auto is_line = [](double x, double last) { return x >= 0 && x <= last && x == std::floor(x); };
  const bool on_grid = is_line(low_x, maze_.cols) && is_line(high_x, maze_.cols) && is_line(low_y, maze_.rows) &&
                       is_line(high_y, maze_.rows);
  if (!on_grid || (low_x == high_x) == (low_y == high_y)) {
    refuse("is no wall on the unit grid of the maze; only such walls are read tile by tile, others must fit in memory");
  }
  const auto col = static_cast<std::uint32_t>(low_x);
  const auto last_col = static_cast<std::uint32_t>(high_x);
  const auto first_row = static_cast<std::uint32_t>(low_y);
  const auto last_row = static_cast<std::uint32_t>(high_y);
  if (col == last_col) {
    if ((col == 0 && first_row == 0) || (col == maze_.cols && last_row == maze_.rows)) {
      refuse("closes a door of the maze; such walls are not read tile by tile, they must fit in memory");
    }
    for (std::uint32_t r = first_row; col > 0 && r < last_row; ++r) {
      poll();
      stand(col - 1, r, CellTile::right_wall);
    }
  } else {
    for (std::uint32_t c = col; first_row > 0 && c < last_col; ++c) {
      poll();
      stand(c, first_row - 1, CellTile::upper_wall);
    }
  }
}

std::optional<Scene> unmade_maze(const std::string& source) {
  const MazeOptions maze = parse_maze_source(source);
  if (maze.algorithm != MazeAlgorithm::mst) return std::nullopt;
  Scene scene = unmade_maze_scene(maze);
  scene.source = source;
  return scene;
}

std::optional<Scene> unmade_maze(const InputFile& file) {
  if (is_maze_file(file.bytes())) return unmade_maze_file(file);
  return is_npy(file.bytes()) ? unmade_npy(file) : std::nullopt;
}

}  // namespace warren
