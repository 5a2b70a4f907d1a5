// SPDX-License-Identifier: BSD-3-Clause
// A path as a service keeps it, to be looked at again and again. One that goes from cell to cell of a lattice is held
// as two bits a step instead of sixteen bytes a point, to the bit: the paths of a maze of 10^8 cells have millions of
// them, and to touch so much fresh memory takes longer than to find them. Points come in blocks, each with the box
// around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/path.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"

namespace warren::serve {

/// Immutable; any number of threads may look.
class KeptCurve {
 public:
  static constexpr std::size_t block_points = 4096;

  KeptCurve() = default;
  /// Throws Stopped.
  KeptCurve(Path<Vec2> path, const Execution& execution);

  std::size_t size() const { return size_; }
  std::size_t bytes() const;
  /// Of block_points points each, and the next block's first.
  std::size_t block_count() const { return blocks_.size(); }
  /// Around all points of a block.
  const Box& box(std::size_t block) const { return blocks_[block].box; }
  /// How long the curve is up to a block's first point.
  double length_before(std::size_t block) const;
  /// The points of a block; `room` may hold them.
  std::span<const Vec2> points(std::size_t block, std::vector<Vec2>& room) const;
  /// All of them. Throws Stopped.
  Path<Vec2> whole(const Execution& execution) const;

 private:
  struct Block {
    Vec2 first;  // where the first of its steps begins: that of block 0 at the path's second point
    Box box;
    double length_before = 0.0;  // of points; steps say theirs by themselves
  };
  void measure_blocks(const Execution& execution);
  std::size_t points_in(std::size_t block) const;
  void unpack(std::size_t block, Vec2* to) const;

  std::size_t size_ = 0;
  Path<Vec2> points_;                 // empty where there are steps
  std::vector<std::uint64_t> steps_;  // two bits a leg: 0 right, 1 up, 2 left, 3 down; of first and last leg nothing
  Vec2 ends_[2] = {};
  std::vector<Block> blocks_;
};

}  // namespace warren::serve
