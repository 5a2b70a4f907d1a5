// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/spanning_tile.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/search/union_find.hpp"

namespace warren::maze {
namespace {

constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint16_t off_the_rim = std::numeric_limits<std::uint16_t>::max();

/// found[i] becomes the bit of the one of four numbers that is the greatest, or least; 0 where several are.
template <bool greatest>
void mark_single(const std::array<const std::uint32_t*, 4>& of, std::uint8_t* __restrict found, std::size_t count) {
  const std::uint32_t* __restrict const a = of[0];
  const std::uint32_t* __restrict const b = of[1];
  const std::uint32_t* __restrict const c = of[2];
  const std::uint32_t* __restrict const d = of[3];
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t ab = greatest ? std::max(a[i], b[i]) : std::min(a[i], b[i]);
    const std::uint32_t cd = greatest ? std::max(c[i], d[i]) : std::min(c[i], d[i]);
    const std::uint32_t m = greatest ? std::max(ab, cd) : std::min(ab, cd);
    const unsigned bits = (a[i] == m ? 1U : 0U) | (b[i] == m ? 2U : 0U) | (c[i] == m ? 4U : 0U) | (d[i] == m ? 8U : 0U);
    found[i] = static_cast<std::uint8_t>((bits & (bits - 1)) == 0 ? bits : 0U);
  }
}

}  // namespace

SpanningTile::SpanningTile(std::uint64_t seed) : weights_(seed) {}

void SpanningTile::make(const GridPiece& piece) {
  assert(piece.width >= 1 && piece.width <= largest_side && piece.height >= 1 && piece.height <= largest_side);
  decide_early(piece);
  contract();
  collect();
  sort();
  number_rim();
  join();
}

/// What the least and the greatest edges decide.
void SpanningTile::decide_early(const GridPiece& piece) {
  piece_ = piece;
  cells_ = std::size_t{piece.width} * piece.height;
  weigh();
  find_least();
  find_greatest();
  mark();
}

std::uint64_t SpanningTile::number_of(std::uint32_t place) const {
  const std::uint32_t cell = place / 2;
  return edge_number(piece_.first_col + cell % piece_.width, piece_.first_row + cell / piece_.width, place % 2);
}

void SpanningTile::weigh() {
  const std::size_t width = piece_.width;
  right_.assign(cells_ + 2 * width, no_edge);
  up_.assign(cells_ + 2 * width, no_edge);
  for (std::uint32_t row = 0; row < piece_.height; ++row) {
    std::uint32_t* const right = right_.data() + (row + 1) * width;
    std::uint32_t* const up = up_.data() + (row + 1) * width;
    const std::uint64_t first = edge_number(piece_.first_col, std::uint64_t{piece_.first_row} + row, 0);
    for (std::uint32_t col = 0; col < width; ++col) {
      right[col] = static_cast<std::uint32_t>(weights_(first + 2 * col) >> 32);
      up[col] = static_cast<std::uint32_t>(weights_(first + 2 * col + 1) >> 32);
    }
    right[width - 1] = no_edge;
  }
  std::fill_n(up_.begin() + static_cast<std::ptrdiff_t>(cells_), width, no_edge);
}

void SpanningTile::find_least() {
  const std::size_t width = piece_.width;
  least_.assign(cells_ + 2 * width, 0);
  mark_single<false>({right_.data() + width, up_.data() + width, right_.data() + width - 1, up_.data()},
                     least_.data() + width, cells_);
  cut_at_rim();
}

/// Cells of the rim choose nothing and are not chosen.
void SpanningTile::cut_at_rim() {
  const std::size_t width = piece_.width;
  std::uint8_t* const least = least_.data() + width;
  const auto clear = [&](std::size_t cell, unsigned bits) {
    least[cell] = static_cast<std::uint8_t>(least[cell] & ~bits);
  };
  for (std::size_t row = 0; row < piece_.height; ++row) {
    if ((piece_.more & 4U) != 0) {
      clear(row * width, 15);
      if (width > 1) clear(row * width + 1, 4);
    }
    if ((piece_.more & 1U) != 0) {
      clear(row * width + width - 1, 15);
      if (width > 1) clear(row * width + width - 2, 1);
    }
  }
  for (std::size_t col = 0; col < width; ++col) {
    if ((piece_.more & 8U) != 0) {
      clear(col, 15);
      if (piece_.height > 1) clear(width + col, 8);
    }
    if ((piece_.more & 2U) != 0) {
      clear(cells_ - width + col, 15);
      if (piece_.height > 1) clear(cells_ - 2 * width + col, 2);
    }
  }
}

/// Corners on the tile's sides have an edge that is none, which is the greatest and marks nothing.
void SpanningTile::find_greatest() {
  const std::size_t width = piece_.width;
  greatest_.assign(cells_ + width + 1, 0);
  mark_single<true>({right_.data() + width, up_.data() + width, right_.data() + 2 * width, up_.data() + width + 1},
                    greatest_.data() + width, cells_);
}

/// Opens the least edges, and finds those that neither rule decides.
void SpanningTile::mark() {
  const std::size_t width = piece_.width;
  open_.resize(cells_);
  contested_.resize(cells_);
  const std::uint8_t* const least = least_.data() + width;
  const std::uint8_t* const greatest = greatest_.data() + width;
  std::uint8_t* __restrict const open = open_.data();
  std::uint8_t* __restrict const contested = contested_.data();
  const auto below = static_cast<std::ptrdiff_t>(width);
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(cells_); ++i) {
    const unsigned in = (least[i] & 3U) | (least[i + 1] >> 2U & 1U) | (least[i + below] >> 2U & 2U);
    const unsigned out = (greatest[i] & 3U) | (greatest[i - below] >> 2U & 1U) | (greatest[i - 1] >> 2U & 2U);
    open[i] = static_cast<std::uint8_t>(in);
    contested[i] = static_cast<std::uint8_t>(~(in | out) & 3U);
  }
  for (std::size_t row = 0; row < piece_.height; ++row) contested[row * width + width - 1] &= up;
  for (std::size_t col = 0; col < width; ++col) contested[cells_ - width + col] &= right;
}

/// Every cell points at where its least edge leads; of two that point at each other the first is the root.
void SpanningTile::contract() {
  const std::int32_t above = static_cast<std::int32_t>(piece_.width);
  const std::array<std::int32_t, 9> step{0, 1, above, 0, -1, 0, 0, 0, -above};
  parent_.resize(cells_);
  std::uint16_t* const parent = parent_.data();
  const std::uint8_t* const least = least_.data() + piece_.width;
  for (std::size_t i = 0; i < cells_; ++i) {
    parent[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(i) + step[least[i]]);
  }
  for (std::size_t i = 0; i < cells_; ++i) {
    const std::size_t next = parent[i];
    const bool is_root = (next > i) & (parent[next] == i);
    parent[i] = static_cast<std::uint16_t>(is_root ? i : next);
  }
  for (bool changed = true; changed;) {
    unsigned differences = 0;
    for (std::size_t i = 0; i < cells_; ++i) {
      const std::uint16_t next = parent[i];
      const std::uint16_t after = parent[next];
      differences |= static_cast<unsigned>(next) ^ after;
      parent[i] = after;
    }
    changed = differences != 0;
  }
}

void SpanningTile::collect() {
  const std::size_t width = piece_.width;
  candidates_.resize(2 * cells_ + 1);
  Candidate* out = candidates_.data();
  const std::uint32_t* const right_weight = right_.data() + width;
  const std::uint32_t* const up_weight = up_.data() + width;
  for (std::size_t i = 0; i < cells_; ++i) {
    const std::size_t beside = std::min(i + 1, cells_ - 1);
    const std::size_t above = std::min(i + width, cells_ - 1);
    *out = {right_weight[i], static_cast<std::uint32_t>(2 * i)};
    out += (contested_[i] & right) & (parent_[i] != parent_[beside] ? 1U : 0U);
    *out = {up_weight[i], static_cast<std::uint32_t>(2 * i + 1)};
    out += (contested_[i] >> 1U) & (parent_[i] != parent_[above] ? 1U : 0U);
  }
  candidate_count_ = static_cast<std::size_t>(out - candidates_.data());
}

/// A bit for each contested edge, in the order of the cells.
void SpanningTile::choices(std::vector<std::uint64_t>& bits) const {
  bits.assign(2 * cells_ / 64 + 1, 0);
  std::size_t n = 0;
  for (std::size_t i = 0; i < cells_; ++i) {
    const unsigned contested = contested_[i];
    const unsigned open = open_[i];
    bits[n / 64] |= std::uint64_t{contested & open & 1U} << n % 64;
    n += contested & 1U;
    bits[n / 64] |= std::uint64_t{(contested & open) >> 1U} << n % 64;
    n += contested >> 1U;
  }
  bits.resize(n / 64 + 1);
  bits.shrink_to_fit();
}

void SpanningTile::remake(const GridPiece& piece, std::span<const std::uint64_t> choices) {
  decide_early(piece);
  std::size_t n = 0;
  for (std::size_t i = 0; i < cells_; ++i) {
    const unsigned contested = contested_[i];
    const unsigned first = static_cast<unsigned>(choices[n / 64] >> n % 64) & contested & 1U;
    n += contested & 1U;
    const unsigned second = static_cast<unsigned>(choices[n / 64] >> n % 64) & contested >> 1U;
    n += contested >> 1U;
    open_[i] = static_cast<std::uint8_t>(open_[i] | first | second << 1U);
  }
}

void SpanningTile::sort() {
  sorted_.resize(candidates_.size());
  pass(0, 0x7ff);
  pass(11, 0x7ff);
  pass(22, 0x3ff);
  sort_ties();
}

void SpanningTile::pass(unsigned shift, std::uint32_t mask) {
  Count count{};
  for (std::size_t k = 0; k < candidate_count_; ++k) ++count[candidates_[k].weight >> shift & mask];
  std::uint32_t first = 0;
  for (std::uint32_t& n : count) {
    const std::uint32_t size = n;
    n = first;
    first += size;
  }
  for (std::size_t k = 0; k < candidate_count_; ++k)
    sorted_[count[candidates_[k].weight >> shift & mask]++] = candidates_[k];
  candidates_.swap(sorted_);
}

void SpanningTile::sort_ties() {
  const auto by_weight = [&](const Candidate& x, const Candidate& y) {
    return weights_(number_of(x.place)) < weights_(number_of(y.place));
  };
  for (std::size_t k = 0; k + 1 < candidate_count_; ++k) {
    if (candidates_[k].weight != candidates_[k + 1].weight) continue;
    std::size_t end = k + 1;
    while (end < candidate_count_ && candidates_[end].weight == candidates_[k].weight) ++end;
    std::sort(candidates_.begin() + static_cast<std::ptrdiff_t>(k),
              candidates_.begin() + static_cast<std::ptrdiff_t>(end), by_weight);
    k = end - 1;
  }
}

void SpanningTile::number_rim() {
  on_rim_.assign(cells_, off_the_rim);
  piece_.each_on_sides([&](std::uint32_t col, std::uint32_t row) {
    if (!piece_.on_rim(col, row)) return;
    on_rim_[std::size_t{row} * piece_.width + col] = static_cast<std::uint16_t>(piece_.side_number(col, row));
  });
}

void SpanningTile::join() {
  rim_edges_.clear();
  const std::array<std::uint32_t, 2> offset{1, piece_.width};
  for (std::size_t k = 0; k < candidate_count_; ++k) {
    const std::uint32_t place = candidates_[k].place;
    const auto cell = static_cast<std::uint16_t>(place / 2);
    const std::uint16_t a = root_of(parent_, cell);
    const std::uint16_t b = root_of(parent_, static_cast<std::uint16_t>(cell + offset[place % 2]));
    if (a == b) continue;
    open_[cell] = static_cast<std::uint8_t>(open_[cell] | (1U << (place % 2)));
    const std::uint16_t kept = std::min(a, b);
    const std::uint16_t gone = std::max(a, b);
    parent_[gone] = kept;
    if (on_rim_[gone] == off_the_rim) continue;
    if (on_rim_[kept] == off_the_rim) {
      on_rim_[kept] = on_rim_[gone];
    } else {
      rim_edges_.push_back({on_rim_[kept], on_rim_[gone], number_of(place)});
    }
  }
}

}  // namespace warren::maze
