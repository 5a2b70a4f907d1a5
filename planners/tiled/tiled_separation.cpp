// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/tiled_separation.hpp"

#include <algorithm>
#include <utility>

#include "parallel/asked_growth.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/separation.hpp"

namespace warren {
namespace {

using Points = std::vector<Vec2>;

/// Marks the overlay vertices that `from` reaches, peeled ones included.
void flood(const Overlay& overlay, VertexId from, std::uint8_t mark, RawVector<std::uint8_t>& marks,
           const Execution& execution) {
  std::vector<VertexId> stack{from};
  marks[from] = mark;
  std::uint64_t seen = 0;
  while (!stack.empty()) {
    if (++seen % 65536 == 0) execution.check();
    const VertexId v = stack.back();
    stack.pop_back();
    for (const OverlayEnd& end : overlay.ends(v)) {
      if (marks[end.target] != 0) continue;
      marks[end.target] = mark;
      push_asked(stack, end.target, execution);
    }
  }
}

/// Appends the milestones that the vertex reaches inside the plane's tile, and takes them off the plane.
void flood_plane(TilePlane& plane, int first_col, int first_row, Points& points) {
  const TileGrid& grid = plane.grid();
  std::vector<std::pair<int, int>> stack{{first_col, first_row}};
  while (!stack.empty()) {
    const auto [col, row] = stack.back();
    stack.pop_back();
    if (col < 0 || row < 0 || col >= plane.width() || row >= plane.height()) continue;
    const unsigned bits = std::exchange(*plane.at(col, row), std::uint8_t{0});
    if ((bits & plane_bit::milestone) == 0) continue;
    points.push_back(TileGrid::point(grid.first_col(plane.tile()) + col, grid.first_row(plane.tile()) + row));
    if ((bits & plane_bit::right) != 0) stack.emplace_back(col + 1, row);
    if ((bits & plane_bit::up) != 0) stack.emplace_back(col, row + 1);
    if ((bits & plane_bit::left) != 0) stack.emplace_back(col - 1, row);
    if ((bits & plane_bit::down) != 0) stack.emplace_back(col, row - 1);
  }
}

Points joined(const std::vector<std::pair<Points, Points>>& parts, Points std::pair<Points, Points>::*side, Vec2 end,
              const Execution& execution) {
  std::size_t total = 1;
  for (const auto& part : parts) total += (part.*side).size();
  execution.reserve(2 * total * sizeof(Vec2));
  Points all{end};
  all.reserve(total);
  for (const auto& part : parts) all.insert(all.end(), (part.*side).begin(), (part.*side).end());
  return all;
}

}  // namespace

Separation tile_separation(const Overlay& overlay, const TileGrid& grid, const OverlayEnds& ends,
                           const TileMaker& maker, const Execution& execution) {
  constexpr std::uint8_t of_start = 1;
  constexpr std::uint8_t of_goal = 2;
  execution.reserve(overlay.vertex_count());
  RawVector<std::uint8_t> marks(overlay.vertex_count());
  std::fill(marks.begin(), marks.end(), std::uint8_t{0});
  flood(overlay, overlay.start(), of_start, marks, execution);
  flood(overlay, overlay.goal(), of_goal, marks, execution);
  const auto is_met = [&](std::size_t tile) {
    const auto mark_of = [&](VertexId v) { return marks.data() + v; };
    return std::any_of(mark_of(overlay.first_key(tile)), mark_of(overlay.first_key(tile + 1)),
                       [](std::uint8_t mark) { return mark != 0; });
  };
  execution.reserve(grid.count() * sizeof(std::pair<Points, Points>));
  std::vector<std::pair<Points, Points>> parts(grid.count());
  const auto find_points = [&](std::size_t tile) {
    TilePlane plane(grid, maker.margin);
    execution.reserve(std::size_t{grid.side()} * grid.side() * sizeof(Vec2));
    const std::vector<std::uint16_t> keys = maker.keys(tile, plane);
    maker.remake(tile, plane);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const std::uint8_t mark = marks[overlay.first_key(tile) + k];
      if (mark == 0) continue;
      const int side = static_cast<int>(grid.side());
      flood_plane(plane, keys[k] % side, keys[k] / side, mark == of_start ? parts[tile].first : parts[tile].second);
    }
  };
  for (std::uint32_t band = 0; band < maker.bands; ++band) {
    const std::vector<std::size_t> tiles = maker.begin(band);
    for_chunks(tiles.size(), 1, execution, [&](Range r) {
      if (is_met(tiles[r.first])) find_points(tiles[r.first]);
    });
  }
  using Part = std::pair<Points, Points>;
  return separation_between<2>(joined(parts, &Part::first, ends.start.at, execution),
                               joined(parts, &Part::second, ends.goal.at, execution), execution);
}

}  // namespace warren
