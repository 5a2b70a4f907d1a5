// SPDX-License-Identifier: BSD-3-Clause
// The weights of the unit grid's edges, of which the algorithm mst makes mazes: a pure function of seed and edge, so
// that any part of a maze can be made by itself. The edge from cell (col, row), from 0, to its right (0) or upper (1)
// neighbour has the number row * 2^32 + 2 * col + direction, whatever the size of the maze. Weights of a seed are all
// different: each step from number to weight is a bijection of 64-bit numbers.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/rng.hpp"

namespace warren::maze {

constexpr std::uint64_t edge_number(std::uint64_t col, std::uint64_t row, unsigned direction) {
  return row << 32 | col << 1 | direction;
}
constexpr std::uint32_t edge_col(std::uint64_t number) { return static_cast<std::uint32_t>(number) >> 1; }
constexpr std::uint32_t edge_row(std::uint64_t number) { return static_cast<std::uint32_t>(number >> 32); }
constexpr unsigned edge_direction(std::uint64_t number) { return static_cast<unsigned>(number & 1); }

class EdgeWeights {
 public:
  explicit constexpr EdgeWeights(std::uint64_t seed) : begin_(mix64(seed + golden)) {}
  constexpr std::uint64_t operator()(std::uint64_t number) const { return mix64(begin_ + golden * (number + 1)); }

 private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
  std::uint64_t begin_;
};

/// Which of the walls that the tree leaves are taken out: each by itself, with probability `loops`, 0 to 1.
class LoopDraw {
 public:
  explicit LoopDraw(double loops) : least_kept_(static_cast<std::uint64_t>(std::ceil(loops * 0x1.0p53))) {}
  bool any() const { return least_kept_ > 0; }
  bool operator()(std::uint64_t weight) const { return mix64(~weight) >> 11 < least_kept_; }

 private:
  std::uint64_t least_kept_;
};

}  // namespace warren::maze
