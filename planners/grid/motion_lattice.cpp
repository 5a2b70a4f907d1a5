// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/motion_lattice.hpp"

#include <cmath>

#include "spatial/maps/free_cells.hpp"

namespace warren {

CellField::CellField(std::uint32_t width, std::uint32_t height, double ratio, std::function<bool(Cell)> passable,
                     const Execution& execution)
    : width_(width), height_(height), passable_(std::move(passable)), execution_(execution) {
  for (std::size_t s = 0; s < knight_steps.size(); ++s) {
    const double x = knight_steps[s][0];
    const double y = knight_steps[s][1];
    costs_[s] = std::max(1U, static_cast<std::uint32_t>(std::sqrt(x * x + y * y) / ratio / unit));
  }
  while (2U << shift_ <= costs_[0]) ++shift_;
  const std::size_t cells = std::size_t{width} * height;
  execution.reserve(cells * sizeof(std::uint32_t));
  assign_polled(values_, cells, unknown, [&] { execution.check(); });
}

void CellField::seed(Cell cell, double cells) {
  const double value = std::min(std::floor(cells / unit), static_cast<double>(largest));
  reach(cell.x, cell.y, static_cast<std::uint32_t>(value));
}

std::uint32_t CellField::at(Cell cell) {
  const std::uint32_t& value = values_[std::size_t{cell.y} * width_ + cell.x];
  while (settled_ < buckets_.size() && (value > largest || value >> shift_ >= settled_)) {
    if (value == blocked) return never;
    settle_bucket();
  }
  return value > largest ? never : value;
}

void CellField::reach(std::uint32_t x, std::uint32_t y, std::uint32_t value) {
  const std::size_t number = std::size_t{y} * width_ + x;
  std::uint32_t& there = values_[number];
  if (there == unknown && !passable_({x, y})) there = blocked;
  if (there == blocked || value >= there || value > largest) return;
  there = value;
  const std::size_t bucket = value >> shift_;
  if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
  buckets_[bucket].push_back(static_cast<std::uint32_t>(number));
}

void CellField::settle_bucket() {
  execution_.check();
  const std::vector<std::uint32_t> cells = std::move(buckets_[settled_]);
  buckets_[settled_] = {};
  const std::size_t bucket = settled_++;
  for (const std::uint32_t number : cells) {
    const std::uint32_t value = values_[number];
    if (value >> shift_ != bucket) continue;  // it was reached for less
    const std::int64_t x = number % width_;
    const std::int64_t y = number / width_;
    for (std::size_t s = 0; s < knight_steps.size(); ++s) {
      const std::int64_t to_x = x + knight_steps[s][0];
      const std::int64_t to_y = y + knight_steps[s][1];
      if (to_x < 0 || to_y < 0 || to_x >= width_ || to_y >= height_) continue;
      reach(static_cast<std::uint32_t>(to_x), static_cast<std::uint32_t>(to_y), value + costs_[s]);
    }
  }
}

}  // namespace warren
