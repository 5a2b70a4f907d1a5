// SPDX-License-Identifier: BSD-3-Clause
// From walls back to cells, and the flood over cells. The flood is a depth-first walk without a stack: a cell's byte
// holds the directions still to be tried and the way back. Each direction of each cell is tried once: about 10 ns a
// cell, and a byte a cell whatever the maze looks like (the frontier of a breadth-first flood has no such bound).
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_carving.hpp"

namespace warren {
namespace {

constexpr std::size_t flood_grain = std::size_t{1} << 16;
constexpr std::int64_t units_per_look = std::int64_t{1} << 16;

/// Do all walls lie on the grid? Grid lines are numbered from 0: line k is the coordinate k + 0.5. Branch-free, four
/// lanes at once: adding and taking away 2^23 (2^52) rounds k to a whole number. Differences from that, and products of
/// a wall's two extents, are summed and stay zero; a NaN stays in the sums. k itself is exact wherever it passes, for a
/// float too as long as there are less than 2^23 lines.
template <class T>
bool all_on_grid(std::span<const WallOf<T>> walls, MazeHint hint) {
  using Lanes = Eigen::Array<T, 4, 1>;
  constexpr T whole = static_cast<T>(std::uint64_t{1} << (std::numeric_limits<T>::digits - 1));
  const Lanes last(static_cast<T>(hint.cols), static_cast<T>(hint.rows), static_cast<T>(hint.cols),
                   static_cast<T>(hint.rows));
  Lanes off = Lanes::Zero();
  Lanes excess = Lanes::Zero();
  T oblique = 0;
  for (const WallOf<T>& w : walls) {
    const Lanes k = Lanes(w.x1, w.y1, w.x2, w.y2) - T{0.5};
    off += (((k + whole) - whole) - k).abs();
    excess = excess.max((k - last).max(-k));
    oblique += std::abs((w.x2 - w.x1) * (w.y2 - w.y1));
  }
  return off.sum() == 0 && oblique == 0 && excess.maxCoeff() <= 0;
}

bool all_on_grid_exactly(std::span<const FloatWall> walls, MazeHint hint) {
  constexpr std::uint32_t exact_lines = std::uint32_t{1} << (std::numeric_limits<float>::digits - 1);
  if (std::max(hint.rows, hint.cols) < exact_lines) return all_on_grid(walls, hint);
  return std::all_of(walls.begin(), walls.end(), [&](const FloatWall& w) {
    const DoubleWall wide{w.x1, w.y1, w.x2, w.y2};
    return all_on_grid(std::span<const DoubleWall>(&wide, 1), hint);
  });
}
bool all_on_grid_exactly(std::span<const DoubleWall> walls, MazeHint hint) { return all_on_grid(walls, hint); }
/// Packed walls are never oblique.
bool all_on_grid_exactly(std::span<const PackedWall> walls, MazeHint hint) {
  constexpr std::int32_t half = PackedWall::per_unit / 2;
  const auto most = [](std::uint32_t lines) {
    return static_cast<std::int32_t>(std::min<std::uint32_t>(lines, PackedWall::most / PackedWall::per_unit)) *
           PackedWall::per_unit;
  };
  const std::int32_t last_x = most(hint.cols);
  const std::int32_t last_y = most(hint.rows);
  std::int32_t off = 0;
  std::int32_t beyond = 0;  // below 0: a wall is
  for (const PackedWall& w : walls) {
    const auto [x1, y1, x2, y2] = w.ends();
    const std::int32_t lines[] = {x1 - half, y1 - half, x2 - half, y2 - half};
    off |= (lines[0] | lines[1] | lines[2] | lines[3]) & (PackedWall::per_unit - 1);
    beyond |= lines[0] | lines[1] | lines[2] | lines[3];
    beyond |= (last_x - lines[0]) | (last_y - lines[1]) | (last_x - lines[2]) | (last_y - lines[3]);
  }
  return off == 0 && beyond >= 0;
}

/// A wall in grid lines, lower ends first.
struct GridWall {
  std::int64_t x1, y1, x2, y2;
};

GridWall grid_wall(std::int64_t x1, std::int64_t y1, std::int64_t x2, std::int64_t y2) {
  return {std::min(x1, x2), std::min(y1, y2), std::max(x1, x2), std::max(y1, y2)};
}
/// Of a wall that lies on the grid.
template <class T>
GridWall grid_wall(const WallOf<T>& w) {
  const auto line = [](T x) { return static_cast<std::int64_t>(x - T{0.5}); };
  return grid_wall(line(w.x1), line(w.y1), line(w.x2), line(w.y2));
}
GridWall grid_wall(const PackedWall& w) {
  const PackedWall::Ends e = w.ends();
  const auto line = [](std::int32_t steps) { return (steps - PackedWall::per_unit / 2) / PackedWall::per_unit; };
  return grid_wall(line(e.x1), line(e.y1), line(e.x2), line(e.y2));
}

/// Sets the bits of the cells along a wall; walls on the outline are no cells' business. Returns how many.
std::int64_t raise(const GridWall& w, MazeHint hint, MazeCells& cells) {
  const bool upright = w.x1 == w.x2;
  const std::int64_t length = (w.x2 - w.x1) + (w.y2 - w.y1);
  const bool inside = upright ? w.x1 > 0 && w.x1 < hint.cols : w.y1 > 0 && w.y1 < hint.rows;
  if (!inside || length == 0) return 0;
  const auto col = static_cast<std::uint32_t>(w.x1 - (upright ? 1 : 0));
  const auto row = static_cast<std::uint32_t>(w.y1 - (upright ? 0 : 1));
  const std::uint8_t bit = upright ? MazeCells::right_wall : MazeCells::upper_wall;
  std::uint8_t* const first = cells.bytes().data() + cells.index(col, row);
  *first |= bit;  // most walls are a unit long, and their direction is a coin toss: no branch decides on it
  const std::size_t step = upright ? 1 : cells.stride();
  for (std::int64_t i = 1; i < length; ++i) first[static_cast<std::size_t>(i) * step] |= bit;
  return length;
}

/// Takes out all interior walls; the outline and the gaps keep theirs.
void open_all(MazeCells& cells, const Execution& execution) {
  for_chunks(cells.cols(), std::max<std::size_t>(1, flood_grain / cells.stride()), execution, [&](Range r) {
    for (std::size_t col = r.first; col < r.last; ++col) {
      const auto first =
          cells.bytes().begin() + static_cast<std::ptrdiff_t>(cells.index(static_cast<std::uint32_t>(col), 0));
      const std::uint8_t kept = col + 1 < cells.cols() ? 0 : MazeCells::right_wall;
      std::fill(first, first + cells.rows(), kept);
      first[cells.rows() - 1] |= MazeCells::upper_wall;
    }
  });
}

constexpr std::uint8_t to_try = 15;  ///< bit d: direction d is open and not yet tried
constexpr std::uint8_t reached = 0x40;

/// A byte a cell with its open directions; gap bytes have none.
RawVector<std::uint8_t> open_directions(const MazeCells& cells, const Execution& execution) {
  const std::span<const std::uint8_t> bytes = cells.bytes();
  execution.reserve(bytes.size());
  RawVector<std::uint8_t> open(bytes.size());
  const std::size_t stride = cells.stride();
  for_chunks(bytes.size(), flood_grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      const unsigned left = i > stride ? bytes[i - stride] & 1U : 1U;
      const unsigned below = i > 0 ? bytes[i - 1] & 2U : 2U;
      const unsigned walls = (bytes[i] & 3U) | left << 2U | below << 2U;
      open[i] = static_cast<std::uint8_t>(~walls & to_try);
    }
  });
  return open;
}

}  // namespace

std::optional<std::size_t> first_wall_off_grid(const WallSet& walls, MazeHint hint, const Execution& execution) {
  return walls.visit([&](auto span) -> std::optional<std::size_t> {
    const std::size_t first = first_in_chunks(span.size(), flood_grain, execution, [&](Range r) {
      if (all_on_grid_exactly(span.subspan(r.first, r.size()), hint)) return r.last;
      std::size_t i = r.first;
      while (all_on_grid_exactly(span.subspan(i, 1), hint)) ++i;
      return i;
    });
    return first == span.size() ? std::nullopt : std::optional(first);
  });
}

MazeCells cells_of_walls(const WallSet& walls, MazeHint hint, const Execution& execution) {
  if (const auto off = first_wall_off_grid(walls, hint, execution)) {
    const Segment s = walls.segment(*off);
    throw InputError("maze", fmt::format("wall {} is not on the unit grid of a {}x{} maze", *off, hint.rows, hint.cols),
                     fmt::format("{} {} {} {}", s.a.x, s.a.y, s.b.x, s.b.y));
  }
  MazeCells cells(hint.rows, hint.cols, execution);
  open_all(cells, execution);
  walls.visit([&](auto span) {  // serial: neighbours share bytes, and the bytes are what takes the time
    std::int64_t since_look = 0;
    for (const auto& wall : span) {
      since_look += 1 + raise(grid_wall(wall), hint, cells);
      if (since_look < units_per_look) continue;
      execution.check();
      since_look = 0;
    }
  });
  return cells;
}

bool flood_connects(const MazeCells& cells, std::pair<std::uint32_t, std::uint32_t> a,
                    std::pair<std::uint32_t, std::uint32_t> b, const Execution& execution) {
  for (const auto& [col, row] : {a, b}) {
    if (col >= cells.cols() || row >= cells.rows()) {
      throw InputError("maze", fmt::format("the cell must lie in the {}x{} maze", cells.rows(), cells.cols()),
                       fmt::format("column {}, row {}", col, row));
    }
  }
  RawVector<std::uint8_t> at = open_directions(cells, execution);
  const auto stride = static_cast<std::ptrdiff_t>(cells.stride());
  const std::ptrdiff_t offsets[4] = {stride, 1, -stride, -1};
  const std::size_t start = cells.index(a.first, a.second);
  const std::size_t goal = cells.index(b.first, b.second);
  maze::StepPoll poll(execution);
  at[start] |= reached;
  for (std::size_t i = start; i != goal;) {
    poll.step(0);
    const unsigned untried = at[i] & to_try;
    if (untried == 0) {
      if (i == start) return false;
      i += static_cast<std::size_t>(offsets[at[i] >> maze::direction_shift & 3U]);
      continue;
    }
    const auto d = static_cast<unsigned>(std::countr_zero(untried));
    at[i] &= static_cast<std::uint8_t>(~(1U << d));
    const std::size_t to = i + static_cast<std::size_t>(offsets[d]);
    if ((at[to] & reached) != 0) continue;
    const unsigned back = d ^ 2U;
    at[to] = static_cast<std::uint8_t>((at[to] & ~(1U << back)) | reached | back << maze::direction_shift);
    i = to;
  }
  return true;
}

}  // namespace warren
