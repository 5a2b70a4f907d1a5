// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/lattice_passages.hpp"

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tile_source.hpp"

namespace warren {

LatticePassages::LatticePassages(LatticeSize size, ArrayOrView<std::uint64_t> right, ArrayOrView<std::uint64_t> up)
    : size_(size), stride_(words_a_row(size.cols)), right_(std::move(right)), up_(std::move(up)) {
  check_size(size_);
  const std::size_t words = stride_ * size_.rows;
  if (right_.size() != words || up_.size() != words) {
    throw InputError("passages", "need " + std::to_string(words) + " words a plane, rows in whole words",
                     std::to_string(right_.size()) + " and " + std::to_string(up_.size()));
  }
  const std::uint64_t last = size_.cols % 64 == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << size_.cols % 64) - 1;
  for (std::uint32_t row = 0; row < size_.rows; ++row) {
    const std::size_t end = (row + std::size_t{1}) * stride_ - 1;
    if ((right_[end] & ~(last >> 1)) == 0 && (up_[end] & ~last) == 0) continue;
    throw InputError("passages", "a motion to the right leaves the lattice in row", std::to_string(row));
  }
  for (std::size_t word = words - stride_; word < words; ++word) {
    if (up_[word] != 0) throw InputError("passages", "a motion upwards leaves the lattice in its last row");
  }
}

void LatticePassages::check_size(LatticeSize size) {
  const std::uint64_t tiles = words_a_row(size.cols) * words_a_row(size.rows);
  if (size.rows >= 1 && size.cols >= 1 && tiles < (std::uint64_t{1} << 20)) return;
  throw InputError("lattice", "needs rows and columns, and less than 2^20 tiles of 64 x 64 cells",
                   std::to_string(size.rows) + " x " + std::to_string(size.cols));
}

PassageWords LatticePassages::closed(LatticeSize size, const Execution& execution) {
  check_size(size);
  const std::size_t words = words_a_row(size.cols) * size.rows;
  execution.reserve(2 * words * sizeof(std::uint64_t));
  PassageWords planes;
  const auto poll = [&] { execution.check(); };
  assign_polled(planes.right, words, std::uint64_t{0}, poll);
  assign_polled(planes.up, words, std::uint64_t{0}, poll);
  return planes;
}

std::array<std::uint64_t, 4> LatticePassages::open_words(std::uint32_t col, std::uint32_t row) const {
  const std::size_t word = row * stride_ + col / 64;
  const std::uint64_t before = col > 0 ? right_[word - 1] >> 63 : 0;
  return {right_[word], up_[word], right_[word] << 1 | before, row > 0 ? up_[word - stride_] : 0};
}

namespace {

/// Tiles are whole words wide, so each word belongs to one of them.
void pack(const TilePlane& plane, const TileGrid& grid, PassageWords& words) {
  static_assert(plane_bit::right == 1 && plane_bit::up == 2);
  const std::size_t stride = LatticePassages::words_a_row(grid.cols);
  const std::uint32_t first_col = grid.first_col(plane.tile());
  for (int row = 0; row < plane.height(); ++row) {
    std::size_t word = (grid.first_row(plane.tile()) + static_cast<std::size_t>(row)) * stride + first_col / 64;
    for (int col = 0; col < plane.width(); col += 64, ++word) {
      std::array<std::uint8_t, 64> line{};
      std::memcpy(line.data(), plane.at(col, row), static_cast<std::size_t>(std::min(64, plane.width() - col)));
      words.right[word] = gathered_bits(line.data(), 0);
      words.up[word] = gathered_bits(line.data(), 1);
    }
  }
}

}  // namespace

LatticePassages wall_passages(const WalledLattice& world, const Execution& execution) {
  if (!(world.clearance >= 0.0 && world.clearance <= WallMarker::largest_clearance)) {
    throw InputError("clearance", "must be a number from 0 to 8, in steps of the lattice");
  }
  PassageWords words = LatticePassages::closed(world.lattice, execution);
  const TileGrid grid = TileGrid::of(world.lattice);
  const double clearance = world.clearance * (1 + 1e-9);
  const double halo = 1.0 + clearance * (1 + 1e-9) + 0.01;  // an edge's length, its clearance, and rounding
  const WallPartition partition(world.walls, world.more_walls, grid, halo, execution);
  const Box box = world.box.value_or(partition.box());
  for_chunks(grid.count(), 1, execution, [&](Range r) {
    WallMarker marker(clearance);
    TilePlane plane(grid, marker.margin());
    plane.reset(r.first, box);
    marker.mark(partition.of(r.first), plane);
    pack(plane, grid, words);
  });
  return {world.lattice, std::move(words)};
}

}  // namespace warren
