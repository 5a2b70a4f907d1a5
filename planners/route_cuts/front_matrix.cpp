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
  execution.reserve(entries * (sizeof(std::uint32_t) + sizeof(WayBy)));
  const auto poll = [&] { execution.check(); };
  assign_polled(lengths_, entries, no_way, poll);
  assign_polled(by_, entries, WayBy{0}, poll);
}

void FrontMatrix::lessen_by_hop(std::size_t i, std::size_t j, std::uint32_t length, HopTurns turns) {
  if (length >= row(i)[j - i]) return;
  row(i)[j - i] = length;
  by(i)[j - i] = hop_bit | static_cast<WayBy>(hops_.size());
  hops_.push_back(turns);
}

void FrontMatrix::take(std::size_t i, std::size_t j, std::uint32_t length, const FrontMatrix& other, WayBy by_what) {
  if ((by_what & hop_bit) != 0) return lessen_by_hop(i, j, length, other.hop(by_what));
  row(i)[j - i] = length;
  by(i)[j - i] = by_what;
}

void FrontMatrix::eliminate(std::size_t gates, GateRank first, const Execution& execution) {
  for (std::size_t begin = 0; begin < gates; begin += block) {
    eliminate_block(begin, std::min(begin + block, gates), first, execution);
  }
}

void FrontMatrix::eliminate_block(std::size_t first, std::size_t last, GateRank rank, const Execution& execution) {
  for (std::size_t i = first + 1; i < last; ++i) pass_by(i, first, i, rank);
  if (size_ - last < many_rows) {
    execution.check();
    for (std::size_t i = last; i < size_; ++i) pass_by(i, first, last, rank);
    return;
  }
  Execution quiet = execution;
  quiet.progress = nullptr;
  for_chunks(size_ - last, row_grain, quiet, [&](Range r) {
    for (std::size_t i = last + r.first; i < last + r.last; ++i) pass_by(i, first, last, rank);
  });
}

/// The ways from `i` by gates first .. last - 1, whose rows are done; `rank` is that of gate 0.
void FrontMatrix::pass_by(std::size_t i, std::size_t first, std::size_t last, GateRank rank) {
  const LessenRowBy lessen_all = lessen_row_by();
  std::uint32_t* const own = row(i);
  for (std::size_t gate = first; gate < last; ++gate) {
    const std::uint32_t* const from_i = row(gate) + (i - gate);
    if (*from_i < no_way) lessen_all(own, by(i), from_i, *from_i, rank + static_cast<GateRank>(gate), size_ - i);
  }
}

}  // namespace warren
