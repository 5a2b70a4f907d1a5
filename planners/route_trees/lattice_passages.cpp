// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_trees/lattice_passages.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.hpp"

namespace warren {

LatticePassages::LatticePassages(LatticeSize size, PassageWords words)
    : size_(size), stride_(words_a_row(size.cols)), right_(std::move(words.right)), up_(std::move(words.up)) {
  check();
}

LatticePassages::LatticePassages(LatticeSize size, std::span<const std::uint64_t> right,
                                 std::span<const std::uint64_t> up)
    : size_(size), stride_(words_a_row(size.cols)), right_(right), up_(up) {
  check();
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

void LatticePassages::check() const {
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

}  // namespace warren
