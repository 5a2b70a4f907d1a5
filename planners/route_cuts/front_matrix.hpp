// SPDX-License-Identifier: BSD-3-Clause
// Lengths between the gates and bounds of one front while it is made: the upper triangle of a symmetric matrix, row by
// row. Eliminating a gate makes each later pair the shorter of itself and the way by the gate; rows of gates are done
// in blocks, so that the rows below meet a block while it is in cache, side by side on all threads where they are many.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"

namespace warren {

class FrontMatrix {
 public:
  /// size x size, no ways at all. Asks `execution` for the memory.
  FrontMatrix(std::size_t size, const Execution& execution);

  std::size_t size() const { return size_; }
  /// Entries i .. size - 1 of row i.
  std::uint32_t* row(std::size_t i) { return lengths_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  const std::uint32_t* row(std::size_t i) const { return lengths_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  std::uint32_t at(std::size_t i, std::size_t j) const { return row(i)[j - i]; }
  void lessen(std::size_t i, std::size_t j, std::uint32_t length);
  /// The first `gates` of all.
  void eliminate(std::size_t gates, const Execution& execution);

 private:
  void eliminate_block(std::size_t first, std::size_t last, const Execution& execution);
  void pass_by(std::size_t row, std::size_t first, std::size_t last);

  std::size_t size_;
  RawVector<std::uint32_t> lengths_;
};

}  // namespace warren
