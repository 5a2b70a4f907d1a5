// SPDX-License-Identifier: BSD-3-Clause
#include "planners/cells/door_points.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/chunks.hpp"

namespace warren {

DoorPoints::DoorPoints(const CellDecomposition& cells, const Execution& execution) : cells_(cells) {
  execution.reserve(cells.doors.size() * sizeof(Vec2));
  middles_.resize(cells.doors.size());
  for_chunks(cells.doors.size(), 16384, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) middles_[i] = middle_of(static_cast<std::uint32_t>(i));
  });
}

Vec2 DoorPoints::middle_of(std::uint32_t door) const {
  const Door& d = cells_.doors[door];
  const Vec2 corner = cells_.corners[d.corner];
  const std::uint32_t far = cells_.far_segment(door);
  const bool on_right = far == CellDecomposition::floor_segment && corner.x == cells_.box.max.x;
  const bool on_left = far == CellDecomposition::ceiling_segment && corner.x == cells_.box.min.x;
  if (d.above ? on_left : on_right) return corner;  // between corner and box: what lies there on the box may be a wall
  const Vec2 middle{corner.x, 0.5 * corner.y + 0.5 * cells_.height(far, corner.x)};
  const bool fits = d.above ? middle.y > corner.y && cells_.side(far, middle) < 0
                            : middle.y < corner.y && cells_.side(far, middle) > 0;
  return fits ? middle : corner;
}

bool DoorPoints::strictly_inside(const VerticalCell& cell, Vec2 p) const {
  const double left = cell.left == no_number ? cells_.box.min.x : cells_.corners[cell.left].x;
  const double right = cell.right == no_number ? cells_.box.max.x : cells_.corners[cell.right].x;
  return left < p.x && p.x < right && cells_.side(cell.lower, p) > 0 && cells_.side(cell.upper, p) < 0;
}

std::optional<Vec2> DoorPoints::bend(std::uint32_t from, std::uint32_t to) const {
  const Door& d = cells_.doors[from];
  if (d.corner != cells_.doors[to].corner) return std::nullopt;
  const std::uint32_t cell = cells_.shared_cell(from, to);
  const Vec2 corner = cells_.corners[d.corner];
  double aside = 0.25 * std::abs(middles_[to].y - middles_[from].y);
  if (d.right != cell) aside = -aside;  // the doors are on the cell's right side
  for (int halved = 0; halved < 16; ++halved, aside *= 0.5) {
    const Vec2 p{corner.x + aside, corner.y};
    if (strictly_inside(cells_.cells[cell], p)) return p;
  }
  return std::nullopt;
}

double DoorPoints::leg_length(std::uint32_t from, std::uint32_t to) const {
  const Vec2 a = middles_[from];
  const Vec2 b = middles_[to];
  const std::optional<Vec2> by = bend(from, to);
  return by ? distance(a, *by) + distance(*by, b) : distance(a, b);
}

}  // namespace warren
