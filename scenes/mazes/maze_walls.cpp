// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/maze_wall_starts.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

using namespace maze;  // NOLINT: the parts of this method

constexpr std::uint32_t largest_packed_side = PackedWall::most / PackedWall::per_unit - 1;

/// Calls f with a wall of the narrowest type that holds all walls of such a maze.
template <class F>
auto with_wall_type(std::uint32_t rows, std::uint32_t cols, const F& f) {
  const std::uint32_t side = std::max(rows, cols);
  if (side <= largest_packed_side) return f(PackedWall());
  return side <= largest_float_side ? f(FloatWall()) : f(DoubleWall());
}

/// Takes the walls of one chunk as WallWriter does, and looks whether those that stand are they.
template <class Wall>
class WallComparer {
 public:
  explicit WallComparer(const Wall* walls) : at_(walls) {}
  void make_room() const {}
  void add(const Wall& wall, unsigned keep) {
    if (keep == 0) return;
    same_ = same_ && *at_ == wall;
    ++at_;
  }
  bool same() const { return same_; }

 private:
  const Wall* at_;
  bool same_ = true;
};

template <class Wall>
bool has_walls_as(std::span<const Wall> walls, const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  const std::vector<std::size_t> places = places_of(cells, starts, {0, cells.cell_count()}, 4, execution);
  const std::array<Wall, 4> frame = outline<Wall>(cells.rows(), cells.cols());
  if (walls.size() != places.back() || !std::equal(frame.begin(), frame.end(), walls.begin())) return false;
  std::vector<std::uint8_t> same(places.size() - 1);
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    WallComparer<Wall> comparer(walls.data() + places[r.first / wall_grain]);
    for_runs(cells, r, [&](const Run& run) { write_units<Wall>(cells, starts, run, comparer); });
    same[r.first / wall_grain] = comparer.same() ? 1 : 0;
  });
  return std::find(same.begin(), same.end(), 0) == same.end();
}

template <class Wall>
WallSet walls_as(const MazeCells& cells, bool merged, const Execution& execution) {
  const WallStarts starts(cells, merged);
  const std::vector<std::size_t> places = places_of(cells, starts, {0, cells.cell_count()}, 4, execution);
  const std::array<Wall, 4> frame = outline<Wall>(cells.rows(), cells.cols());
  execution.reserve(places.back() * sizeof(Wall));
  RawVector<Wall> walls(places.back());
  std::copy(frame.begin(), frame.end(), walls.begin());
  write_walls(cells, starts, {0, cells.cell_count()}, places, walls.data(), execution);
  return WallSet(std::move(walls));
}

}  // namespace

std::uint64_t interior_walls(const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  std::vector<std::uint64_t> parts(chunk_count(cells.cell_count(), wall_grain));
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    for_runs(cells, r, [&](const Run& run) { parts[r.first / wall_grain] += starts.count(run); });
  });
  std::uint64_t sum = 0;
  for (const std::uint64_t part : parts) sum += part;
  return sum;
}

std::size_t maze_wall_bytes(std::uint32_t rows, std::uint32_t cols) {
  return with_wall_type(rows, cols, []<class Wall>(Wall) { return sizeof(Wall); });
}

WallSet maze_walls(const MazeCells& cells, bool merged, const Execution& execution) {
  if (execution.progress != nullptr) execution.progress->begin("walls", cells.cell_count());
  return with_wall_type(cells.rows(), cells.cols(),
                        [&]<class Wall>(Wall) { return walls_as<Wall>(cells, merged, execution); });
}

bool has_maze_walls(const WallSet& walls, const MazeCells& cells, const Execution& execution) {
  return with_wall_type(cells.rows(), cells.cols(), [&]<class Wall>(Wall) {
    return walls.visit([&]<class Held>(std::span<const Held> held) {
      if constexpr (std::is_same_v<Held, Wall>) return has_walls_as(held, cells, execution);
      return false;
    });
  });
}

}  // namespace warren
