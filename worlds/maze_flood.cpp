// SPDX-License-Identifier: BSD-3-Clause
// From walls back to cells, and the flood over cells. The flood is a depth-first walk without a stack: a cell's byte
// holds the directions still to be tried and the way back. Each direction of each cell is tried once: about 10 ns a
// cell, and a byte a cell whatever the maze looks like (the frontier of a breadth-first flood has no such bound).
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "core/error.hpp"
#include "parallel/chunks.hpp"
#include "worlds/maze_carving.hpp"

namespace warren {
namespace {

constexpr std::size_t grain = std::size_t{1} << 16;

/// Grid lines are numbered from 0: line k is the coordinate k + 0.5. Not one: -1.
std::int64_t grid_line(double x, std::uint32_t last) {
  const double k = x - 0.5;  // exact wherever it may be one of a maze's lines
  if (!(k >= 0.0 && k <= last)) return -1;
  const auto line = static_cast<std::int64_t>(k);
  return static_cast<double>(line) == k ? line : -1;
}

/// A wall in grid lines, lower ends first.
struct GridWall {
  std::int64_t x1, y1, x2, y2;
  bool valid() const { return std::min({x1, y1, x2, y2}) >= 0 && (x1 == x2 || y1 == y2); }
};

GridWall grid_wall(const Segment& s, MazeHint hint) {
  GridWall w{grid_line(s.a.x, hint.cols), grid_line(s.a.y, hint.rows), grid_line(s.b.x, hint.cols),
             grid_line(s.b.y, hint.rows)};
  if (w.x2 < w.x1) std::swap(w.x1, w.x2);
  if (w.y2 < w.y1) std::swap(w.y1, w.y2);
  return w;
}

/// Sets the bits of the cells along a wall; walls on the outline are no cells' business.
void raise(const GridWall& w, MazeHint hint, MazeCells& cells) {
  const std::span<std::uint8_t> bytes = cells.bytes();
  if (w.x1 == w.x2 && w.x1 > 0 && w.x1 < hint.cols) {
    const std::size_t column = cells.index(static_cast<std::uint32_t>(w.x1 - 1), 0);
    for (std::int64_t y = w.y1; y < w.y2; ++y) bytes[column + static_cast<std::size_t>(y)] |= MazeCells::right_wall;
  }
  if (w.y1 == w.y2 && w.y1 > 0 && w.y1 < hint.rows) {
    for (std::int64_t x = w.x1; x < w.x2; ++x) {
      bytes[cells.index(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(w.y1 - 1))] |= MazeCells::upper_wall;
    }
  }
}

/// Takes out all interior walls; the outline and the gaps keep theirs.
void open_all(MazeCells& cells, const Execution& execution) {
  for_chunks(cells.cols(), std::max<std::size_t>(1, grain / cells.stride()), execution, [&](Range r) {
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
  for_chunks(bytes.size(), grain, execution, [&](Range r) {
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
    std::vector<std::size_t> firsts(chunk_count(span.size(), grain), span.size());
    for_chunks(span.size(), grain, execution, [&](Range r) {
      const auto off = [&](const auto& wall) { return !grid_wall(wall.segment(), hint).valid(); };
      const auto part = span.subspan(r.first, r.size());
      const auto found = std::find_if(part.begin(), part.end(), off);
      if (found != part.end()) firsts[r.first / grain] = r.first + static_cast<std::size_t>(found - part.begin());
    });
    const auto first = std::find_if(firsts.begin(), firsts.end(), [&](std::size_t i) { return i < span.size(); });
    if (first == firsts.end()) return std::nullopt;
    return *first;
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
    for (std::size_t first = 0; first < span.size(); first += grain) {
      execution.check();
      for (const auto& wall : span.subspan(first, std::min(grain, span.size() - first))) {
        raise(grid_wall(wall.segment(), hint), hint, cells);
      }
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
