// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/jump_point_search.hpp"

#include <bit>

#include "core/base/bitmap.hpp"

namespace warren {
namespace {

Bitmap blocked_transposed(const FreeCells& cells, const Execution& execution) {
  Bitmap blocked(cells.height(), cells.width());
  for (std::uint32_t y = 0; y < cells.height(); ++y) {
    if (y % 16 == 0) execution.check();
    for (std::uint32_t x = 0; x < cells.width(); ++x) {
      if (!cells.is_free(cells.number({x, y}))) blocked.set(y, x);
    }
  }
  return blocked;
}

/// The first turn or the goal on the row to the right of v, before a blocked cell.
VertexId scan_up(const FreeCells& cells, VertexId v, VertexId goal) {
  const VertexId stride = cells.stride();
  for (VertexId at = v + 1;; at += 64) {
    const std::uint64_t free = cells.from(at);
    const std::uint64_t turns = (cells.from(at + stride) & ~cells.from(at + stride - 1)) |
                                (cells.from(at - stride) & ~cells.from(at - stride - 1));
    const std::uint64_t stops = ~free | turns;
    const auto first = static_cast<VertexId>(std::countr_zero(stops));
    if (goal - at < 64 && goal - at <= first) return goal;  // unsigned: a goal behind is far ahead
    if (first == 64) continue;
    return (free >> first & 1U) != 0 ? at + first : no_vertex;
  }
}

/// The same to the left.
VertexId scan_down(const FreeCells& cells, VertexId v, VertexId goal) {
  const VertexId stride = cells.stride();
  for (VertexId at = v - 1;; at -= 64) {
    const VertexId low = at - 63;  // bit 63 is `at`
    const std::uint64_t free = cells.from(low);
    const std::uint64_t turns = (cells.from(low + stride) & ~cells.from(low + stride + 1)) |
                                (cells.from(low - stride) & ~cells.from(low - stride + 1));
    const std::uint64_t stops = ~free | turns;
    const auto first = static_cast<VertexId>(std::countl_zero(stops));
    if (at - goal < 64 && at - goal <= first) return goal;
    if (first == 64) continue;
    return (free << first >> 63 & 1U) != 0 ? at - first : no_vertex;
  }
}

int sign(std::int64_t x) { return (x > 0) - (x < 0); }

/// The number of a step in cell_steps.
constexpr unsigned step_of(int dx, int dy) {
  const int nine = 3 * (dy + 1) + dx + 1;
  return static_cast<unsigned>(nine > 4 ? nine - 1 : nine);
}

}  // namespace

JumpPoints::JumpPoints(const FreeCells& cells, const Execution& execution)
    : rows_(cells), columns_(blocked_transposed(cells, execution)) {}

unsigned JumpPoints::directions(VertexId v, VertexId parent) const {
  const unsigned around = rows_.around(v);
  const unsigned allowed = allowed_steps(StepRule::eight)[around];
  if (parent == no_vertex) return allowed;
  const Cell c = rows_.cell(v);
  const Cell p = rows_.cell(parent);
  const int dx = sign(std::int64_t{c.x} - p.x);
  const int dy = sign(std::int64_t{c.y} - p.y);
  unsigned kept = 1U << step_of(dx, dy);
  if (dx != 0 && dy != 0) return allowed & (kept | 1U << step_of(dx, 0) | 1U << step_of(0, dy));
  for (const int side : {-1, 1}) {
    const int behind_x = dx != 0 ? -dx : side;
    const int behind_y = dy != 0 ? -dy : side;
    const bool behind_is_free = (around >> (3 * (behind_y + 1) + behind_x + 1) & 1U) != 0;
    if (behind_is_free) continue;
    kept |= 1U << (dx != 0 ? step_of(0, side) : step_of(side, 0));
    kept |= 1U << (dx != 0 ? step_of(dx, side) : step_of(side, dy));
  }
  return allowed & kept;
}

VertexId JumpPoints::jump(VertexId v, int dx, int dy, VertexId goal) const {
  return dx != 0 && dy != 0 ? jump_diagonal(v, dx, dy, goal) : jump_straight(v, dx, dy, goal);
}

VertexId JumpPoints::jump_straight(VertexId v, int dx, int dy, VertexId goal) const {
  if (dy == 0) return dx > 0 ? scan_up(rows_, v, goal) : scan_down(rows_, v, goal);
  const auto column_number = [&](VertexId number) {
    const Cell c = rows_.cell(number);
    return columns_.number({c.y, c.x});
  };
  const VertexId from = column_number(v);
  const VertexId to = column_number(goal);
  const VertexId found = dy > 0 ? scan_up(columns_, from, to) : scan_down(columns_, from, to);
  if (found == no_vertex) return no_vertex;
  const Cell c = columns_.cell(found);
  return rows_.number({c.y, c.x});
}

VertexId JumpPoints::jump_diagonal(VertexId v, int dx, int dy, VertexId goal) const {
  const auto offset = static_cast<VertexId>(dy * static_cast<std::int64_t>(rows_.stride()) + dx);
  const unsigned step = 1U << step_of(dx, dy);
  for (VertexId at = v; (allowed_steps(StepRule::eight)[rows_.around(at)] & step) != 0;) {
    at += offset;
    if (at == goal) return at;
    if (jump_straight(at, dx, 0, goal) != no_vertex || jump_straight(at, 0, dy, goal) != no_vertex) return at;
  }
  return no_vertex;
}

RawVector<VertexId> JumpPoints::with_steps(std::span<const VertexId> jump_points) const {
  RawVector<VertexId> path;
  for (const VertexId to : jump_points) {
    if (!path.empty()) {
      const Cell a = rows_.cell(path.back());
      const Cell b = rows_.cell(to);
      const auto offset = static_cast<VertexId>(
          sign(std::int64_t{b.y} - a.y) * static_cast<std::int64_t>(rows_.stride()) + sign(std::int64_t{b.x} - a.x));
      while (path.back() + offset != to) path.push_back(path.back() + offset);
    }
    path.push_back(to);
  }
  return path;
}

}  // namespace warren
