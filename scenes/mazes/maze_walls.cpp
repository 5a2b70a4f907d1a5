// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/maze_walls.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_wall_starts.hpp"

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

namespace {

constexpr std::size_t rows_grain = std::size_t{1} << 14;
constexpr std::size_t cells_a_piece = std::size_t{1} << 20;

template <class T>
std::string_view bytes_of(std::span<const WallOf<T>> walls) {
  return {reinterpret_cast<const char*>(walls.data()), walls.size_bytes()};  // NOLINT: the walls' bytes
}

Execution quietly(const Execution& execution) { return {execution.threads, execution.deadline}; }

}  // namespace

WallStrips::WallStrips(const CellWallSource& cells, bool merged, const Execution& execution)
    : cells_(cells), merged_(merged) {
  if (merged) {
    execution.reserve(strip_count() * cells.rows() * sizeof(runs_[0]));
    runs_.resize(strip_count() * cells.rows());
  }
  if (execution.progress != nullptr) execution.progress->begin("walls", cells.tile_count());
  Strip strip = first_strip(execution);
  for (;; go_on(strip, execution)) {
    const maze::WallStarts starts(strip.cells, merged, {first_col(strip), cells.cols()});
    const std::uint64_t lead = std::uint64_t{strip.lead} * cells.rows();
    count_ = maze::places_of(strip.cells, starts, {lead, strip.cells.cell_count()}, count_, execution).back();
    if (merged) note_runs(strip, execution);
    if (strip.number + 1 == strip_count()) break;
  }
}

bool WallStrips::holds_floats() const { return maze::walls_are_floats(cells_.rows(), cells_.cols()); }

std::uint32_t WallStrips::width_of(std::size_t strip) const {
  const std::uint32_t side = 1U << cells_.side_log2();
  return std::min(side, cells_.cols() - static_cast<std::uint32_t>(strip) * side);
}

std::uint32_t WallStrips::first_col(const Strip& strip) const {
  return (static_cast<std::uint32_t>(strip.number) << cells_.side_log2()) - strip.lead;
}

WallStrips::Strip WallStrips::first_strip(const Execution& execution) const {
  Strip strip{0, 0, MazeCells(cells_.rows(), width_of(0), execution)};
  read(strip, execution);
  return strip;
}

void WallStrips::go_on(Strip& strip, const Execution& execution) const {
  const std::size_t number = strip.number + 1;
  Strip next{number, 1, MazeCells(cells_.rows(), width_of(number) + 1, execution)};
  const std::span<const std::uint8_t> last = std::span<const std::uint8_t>(strip.cells.bytes())
                                                 .subspan(strip.cells.index(strip.cells.cols() - 1, 0), cells_.rows());
  std::copy(last.begin(), last.end(), next.cells.bytes().begin() + static_cast<std::ptrdiff_t>(next.cells.index(0, 0)));
  read(next, execution);
  strip = std::move(next);
}

void WallStrips::read(Strip& strip, const Execution& execution) const {
  constexpr std::size_t grain = 8;  // a reader's scratch is large
  std::uint8_t* const bytes = strip.cells.bytes().data();
  for_chunks(cells_.tile_count() / strip_count(), grain, execution, [&](Range r) {
    const auto reader = cells_.reader();
    CellTile tile;
    for (std::size_t row_of_tiles = r.first; row_of_tiles < r.last; ++row_of_tiles) {
      reader->read(row_of_tiles * strip_count() + strip.number, tile);
      for (std::uint32_t col = 0; col < tile.width; ++col) {
        std::uint8_t* const column = bytes + strip.cells.index(strip.lead + col, tile.first_row);
        for (std::uint32_t row = 0; row < tile.height; ++row) column[row] = tile.walls[tile.index(col, row)];
      }
    }
  });
}

void WallStrips::note_runs(const Strip& strip, const Execution& execution) {
  for_chunks(cells_.rows(), rows_grain, quietly(execution), [&](Range r) {
    for (auto row = static_cast<std::uint32_t>(r.first); row < r.last; ++row) {
      std::uint32_t col = strip.lead;
      while (col < strip.cells.cols() && strip.cells.wall_above(col, row)) ++col;
      runs_[strip.number * cells_.rows() + row] = static_cast<std::uint16_t>(col - strip.lead);
    }
  });
}

/// By row, how far an upper wall goes on right of a strip.
std::vector<std::uint32_t> WallStrips::beyond(std::size_t strip) const {
  std::vector<std::uint32_t> cells(merged_ ? cells_.rows() : 0, 0);
  for (std::size_t row = 0; row < cells.size(); ++row) {
    for (std::size_t next = strip + 1; next < strip_count(); ++next) {
      const std::uint32_t run = runs_[next * cells_.rows() + row];
      cells[row] += run;
      if (run < width_of(next)) break;
    }
  }
  return cells;
}

template <class T>
void WallStrips::write_strip(const Strip& strip, const std::function<void(std::string_view)>& take,
                             const Execution& execution) const {
  const std::vector<std::uint32_t> going_on = beyond(strip.number);
  const maze::WallStarts starts(strip.cells, merged_,
                                {first_col(strip), cells_.cols(), merged_ ? going_on.data() : nullptr});
  RawVector<WallOf<T>> walls;
  const std::uint64_t last = strip.cells.cell_count();
  for (std::uint64_t first = std::uint64_t{strip.lead} * cells_.rows(); first < last; first += cells_a_piece) {
    const Range some{first, std::min(first + cells_a_piece, last)};
    const std::vector<std::size_t> places = maze::places_of(strip.cells, starts, some, 0, execution);
    if (places.back() > walls.capacity()) execution.reserve(places.back() * sizeof(WallOf<T>));
    walls.resize(places.back());
    maze::write_walls(strip.cells, starts, some, places, walls.data(), quietly(execution));
    take(bytes_of<T>(walls));
  }
}

void WallStrips::write(const std::function<void(std::string_view)>& take, const Execution& execution) const {
  execution.reserve(merged_ ? cells_.rows() * sizeof(std::uint32_t) : 0);
  if (execution.progress != nullptr) execution.progress->begin("write", cells_.tile_count());
  const auto with = [&]<class T>(T) {
    const auto outline = maze::outline<WallOf<T>>(cells_.rows(), cells_.cols());
    take(bytes_of<T>(outline));
    for (Strip strip = first_strip(execution);; go_on(strip, execution)) {
      write_strip<T>(strip, take, execution);
      if (strip.number + 1 == strip_count()) break;
    }
  };
  holds_floats() ? with(float{}) : with(double{});
}

}  // namespace warren
