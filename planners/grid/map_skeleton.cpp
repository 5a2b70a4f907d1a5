// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/map_skeleton.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numbers>
#include <vector>

namespace warren {
namespace {

/// The eight cells around one, in turn, from the right anticlockwise: even ones share a side with it.
constexpr std::array<std::array<int, 2>, 8> ring{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Can the middle go, where bit i of `around` says whether ring[i] is there? Its neighbours over sides must be one
/// piece over sides within the ring, and something that is missing must be among the eight: then the missing ones are
/// one piece over corners.
constexpr bool is_simple(unsigned around) {
  const auto is_there = [&](unsigned i) { return (around >> (i % 8) & 1U) != 0; };
  if (around == 255U) return false;
  unsigned pieces = 0;
  for (unsigned side = 0; side < 8; side += 2) {
    // A piece begins at a side whose neighbour over the corner before it does not lead on to the side before.
    if (is_there(side) && !(is_there(side + 7) && is_there(side + 6))) ++pieces;
  }
  return pieces == 1;
}

constexpr std::array<bool, 256> simple_table = [] {
  std::array<bool, 256> table{};
  for (unsigned around = 0; around < table.size(); ++around) table[around] = is_simple(around);
  return table;
}();

/// Cells wait by their distance, and among equals in the order in which they came.
class WaitingCells {
 public:
  bool empty() const { return by_distance_.empty(); }
  void push(std::uint32_t distance, std::uint32_t cell) { by_distance_[distance].cells.push_back(cell); }
  std::uint32_t pop() {
    const auto first = by_distance_.begin();
    const std::uint32_t cell = first->second.cells[first->second.next++];
    if (first->second.next == first->second.cells.size()) by_distance_.erase(first);
    return cell;
  }

 private:
  struct Line {
    std::vector<std::uint32_t> cells;
    std::size_t next = 0;
  };
  std::map<std::uint32_t, Line> by_distance_;
};

class Thinning {
 public:
  Thinning(const Bitmap& blocked, const DistanceField& field, std::span<const Cell> kept, SkeletonEnds ends,
           const Execution& execution)
      : field_(field),
        ends_(ends),
        execution_(execution),
        width_(blocked.width()),
        rest_(blocked.width(), blocked.height()),
        waits_(blocked.width(), blocked.height()),
        kept_(kept) {
    execution.reserve(2 * blocked.bytes());
    for (std::uint32_t y = 0; y < blocked.height(); ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) {
        if (!blocked.test(x, y)) rest_.set(x, y);
      }
    }
  }

  Bitmap run() {
    line_up();
    constexpr std::uint64_t batch = 1 << 14;
    for (std::uint64_t done = 1; !waiting_.empty(); ++done) {
      if (done % batch == 0) execution_.check();
      const std::uint32_t number = waiting_.pop();
      const Cell cell{number % width_, number / width_};
      waits_.clear(cell.x, cell.y);
      const unsigned near = around(cell);
      if (simple_table[near] && !is_kept(cell) && !stays_as_end(cell, near)) remove(cell);
    }
    return std::move(rest_);
  }

 private:
  unsigned around(Cell cell) const {
    unsigned bits = 0;
    for (unsigned i = 0; i < ring.size(); ++i) {
      bits |= rest_.holds(std::int64_t{cell.x} + ring[i][0], std::int64_t{cell.y} + ring[i][1]) ? 1U << i : 0U;
    }
    return bits;
  }
  bool is_kept(Cell cell) const {
    for (const Cell k : kept_) {
      if (k == cell) return true;
    }
    return false;
  }
  /// The cell has one neighbour over a side, and the distance is nearly as large here as around it.
  bool stays_as_end(Cell cell, unsigned near) const {
    constexpr unsigned sides = 0x55U;
    constexpr double least_slope = 0.5;
    if (ends_ == SkeletonEnds::go || std::popcount(near & sides) != 1) return false;
    return steepest(cell, 1) < least_slope && steepest(cell, 3) < least_slope;
  }
  /// How much the distance grows from there on, a cell of the way.
  double steepest(Cell cell, int reach) const {
    double slope = 0.0;
    for (const auto& [dx, dy] : ring) {
      const std::uint32_t x = cell.x + static_cast<std::uint32_t>(reach * dx);  // before 0: far beyond the width
      const std::uint32_t y = cell.y + static_cast<std::uint32_t>(reach * dy);
      if (x >= rest_.width() || y >= rest_.height()) continue;
      const double run = reach * (dx != 0 && dy != 0 ? std::numbers::sqrt2 : 1.0);
      slope = std::max(slope, (field_.distance(x, y) - field_.distance(cell.x, cell.y)) / run);
    }
    return slope;
  }
  void wait(Cell cell) {
    if (waits_.test(cell.x, cell.y)) return;
    waits_.set(cell.x, cell.y);
    waiting_.push(field_.squared(cell.x, cell.y), cell.y * width_ + cell.x);
  }
  /// The cells at a border; those inside follow when their neighbours go.
  void line_up() {
    for (std::uint32_t y = 0; y < rest_.height(); ++y) {
      execution_.check();
      for (std::uint32_t x = 0; x < width_; ++x) {
        if (rest_.test(x, y) && around({x, y}) != 255U) wait({x, y});
      }
    }
  }
  void remove(Cell cell) {
    rest_.clear(cell.x, cell.y);
    for (const auto& [dx, dy] : ring) {
      const std::int64_t x = std::int64_t{cell.x} + dx;
      const std::int64_t y = std::int64_t{cell.y} + dy;
      if (rest_.holds(x, y)) wait({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)});
    }
  }

  const DistanceField& field_;
  SkeletonEnds ends_;
  const Execution& execution_;
  std::uint32_t width_;
  Bitmap rest_;
  Bitmap waits_;
  std::span<const Cell> kept_;
  WaitingCells waiting_;
};

}  // namespace

Bitmap map_skeleton(const Bitmap& blocked, const DistanceField& field, std::span<const Cell> kept,
                    const Execution& execution, SkeletonEnds ends) {
  return Thinning(blocked, field, kept, ends, execution).run();
}

}  // namespace warren
