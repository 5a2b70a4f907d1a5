// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/front_matrix.hpp"

#include <algorithm>

#include "parallel/chunks.hpp"
#include "planners/route_cuts/min_plus.hpp"

namespace warren {
namespace {

constexpr std::size_t block = 32;  // gates: their rows of up to some thousand entries stay in the second-level cache
constexpr std::size_t row_grain = 32;   // rows a chunk
constexpr std::size_t many_rows = 256;  // are worth waking other threads for

}  // namespace

FrontMatrix::FrontMatrix(std::size_t size, const Execution& execution) : size_(size) {
  const std::size_t entries = size * (size + 1) / 2;
  execution.reserve(entries * sizeof(std::uint32_t));
  assign_polled(lengths_, entries, no_way, [&] { execution.check(); });
}

void FrontMatrix::lessen(std::size_t i, std::size_t j, std::uint32_t length) {
  std::uint32_t& entry = i <= j ? row(i)[j - i] : row(j)[i - j];
  entry = std::min(entry, length);
}

void FrontMatrix::eliminate(std::size_t gates, const Execution& execution) {
  for (std::size_t first = 0; first < gates; first += block) {
    eliminate_block(first, std::min(first + block, gates), execution);
  }
}

void FrontMatrix::eliminate_block(std::size_t first, std::size_t last, const Execution& execution) {
  for (std::size_t i = first + 1; i < last; ++i) pass_by(i, first, i);
  if (size_ - last < many_rows) {
    execution.check();
    for (std::size_t i = last; i < size_; ++i) pass_by(i, first, last);
    return;
  }
  Execution quiet = execution;
  quiet.progress = nullptr;
  for_chunks(size_ - last, row_grain, quiet, [&](Range r) {
    for (std::size_t i = last + r.first; i < last + r.last; ++i) pass_by(i, first, last);
  });
}

/// The ways from `i` by gates first .. last - 1, whose rows are done.
void FrontMatrix::pass_by(std::size_t i, std::size_t first, std::size_t last) {
  const LessenRow lessen_all = lessen_row();
  std::uint32_t* const own = row(i);
  for (std::size_t gate = first; gate < last; ++gate) {
    const std::uint32_t* const from_i = row(gate) + (i - gate);
    if (*from_i < no_way) lessen_all(own, from_i, *from_i, size_ - i);
  }
}

}  // namespace warren
