// SPDX-License-Identifier: BSD-3-Clause
// The motions of a lattice roadmap as plain bits: two a cell, one for its motion to the right, one for that upwards. A
// row is whole 64-bit words, so that 64 cells are looked at at once; bits of motions that leave the lattice are 0. A
// blocked milestone is a cell without passages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

/// A constant array of plain elements that is either owned or a view of somebody else's memory, say of a mapped file:
/// what reads it can't tell. Moves keep the elements where they are; copies aren't made by accident. A view must not
/// outlive what it looks at.
template <class T>
class ArrayOrView {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  ArrayOrView() = default;
  explicit ArrayOrView(RawVector<T> elements) : own_(std::move(elements)), all_(own_) {}
  explicit ArrayOrView(std::span<const T> elements, FirstLook first_look = {})
      : all_(elements), first_look_(first_look) {}
  /// What was moved from may be assigned to or destroyed, nothing else.
  ArrayOrView(ArrayOrView&&) noexcept = default;
  ArrayOrView& operator=(ArrayOrView&&) noexcept = default;
  ~ArrayOrView() = default;

  std::size_t size() const { return all_.size(); }
  bool empty() const { return all_.empty(); }
  const T* data() const { return all_.data(); }
  const T& operator[](std::size_t i) const { return all_[i]; }
  std::span<const T> span() const { return all_; }
  /// Whoever reads a view of a large file calls it before it reads these elements, which must be there. Throws what the
  /// view's owner says of damage.
  void look(std::size_t first, std::size_t count) const { first_look_.ensure(first * sizeof(T), count * sizeof(T)); }

 private:
  RawVector<T> own_;
  std::span<const T> all_;
  FirstLook first_look_;
};

/// Number of a cell: row * cols + col, both from 0.
using CellId = std::uint32_t;

/// The two planes of bits, as they lie in memory: bit (col % 64) of word row * words_a_row + col / 64.
struct PassageWords {
  RawVector<std::uint64_t> right;
  RawVector<std::uint64_t> up;
};

/// One bit of each of 64 bytes, as a word: the first byte's is the lowest.
inline std::uint64_t gathered_bits(const std::uint8_t* bytes, unsigned bit) {
  std::uint64_t word = 0;
  for (unsigned i = 0; i < 64; i += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, bytes + i, 8);
    word |= ((eight >> bit & 0x0101010101010101U) * 0x0102040810204080U >> 56) << i;
  }
  return word;
}

/// Immutable; owns its words or looks at somebody's. Any number of threads may read.
class LatticePassages {
 public:
  /// Both planes have words_a_row(cols) * rows words. Throws InputError for another number of them, for sizes outside
  /// check_size(), and for a bit of a motion that leaves the lattice. Words that are looked at must stay.
  LatticePassages(LatticeSize size, ArrayOrView<std::uint64_t> right, ArrayOrView<std::uint64_t> up);
  LatticePassages(LatticeSize size, PassageWords words)
      : LatticePassages(size, ArrayOrView<std::uint64_t>(std::move(words.right)),
                        ArrayOrView<std::uint64_t>(std::move(words.up))) {}

  /// Throws InputError unless rows, cols >= 1 and the lattice, filled up to whole tiles of 64 x 64, has less than 2^32
  /// cells.
  static void check_size(LatticeSize size);
  static std::size_t words_a_row(std::uint32_t cols) { return (std::size_t{cols} + 63) / 64; }
  /// No passage at all. Asks `execution` for the memory.
  static PassageWords closed(LatticeSize size, const Execution& execution);

  LatticeSize size() const { return size_; }
  std::uint64_t cell_count() const { return std::uint64_t{size_.rows} * size_.cols; }
  std::span<const std::uint64_t> right_words() const { return right_.span(); }
  std::span<const std::uint64_t> up_words() const { return up_.span(); }

  /// Of cells col .. col + 63, col a multiple of 64: their motions in direction 0 right, 1 up, 2 left, 3 down, as bits.
  std::array<std::uint64_t, 4> open_words(std::uint32_t col, std::uint32_t row) const;
  /// A bit for each free motion of a cell: 1 right, 2 up, 4 left, 8 down.
  unsigned open_at(std::uint32_t col, std::uint32_t row) const {
    const std::size_t word = row * stride_ + col / 64;
    const unsigned bit = col % 64;
    unsigned open = bit_of(right_, word, bit) | bit_of(up_, word, bit) << 1;
    if (col > 0) open |= bit_of(right_, row * stride_ + (col - 1) / 64, (col - 1) % 64) << 2;
    if (row > 0) open |= bit_of(up_, word - stride_, bit) << 3;
    return open;
  }
  /// The cells that a free motion leads to, in the order of the directions.
  template <class Visit>
  void for_each_neighbour(CellId cell, const Visit& visit) const {
    const unsigned open = open_at(cell % size_.cols, cell / size_.cols);
    if ((open & 1U) != 0) visit(cell + 1);
    if ((open & 2U) != 0) visit(cell + size_.cols);
    if ((open & 4U) != 0) visit(cell - 1);
    if ((open & 8U) != 0) visit(cell - size_.cols);
  }

 private:
  static unsigned bit_of(const ArrayOrView<std::uint64_t>& plane, std::size_t word, unsigned bit) {
    return static_cast<unsigned>(plane[word] >> bit) & 1U;
  }

  LatticeSize size_;
  std::size_t stride_;
  ArrayOrView<std::uint64_t> right_;
  ArrayOrView<std::uint64_t> up_;
};

/// A world of walls and the lattice in it: point (col, row), both from 0, stands at (col + 1, row + 1). Refers to the
/// walls.
struct WalledLattice {
  const WallSet& walls;
  std::span<const Segment> more_walls;  ///< a few beside the set: the bounds
  std::optional<Box> box;               ///< the reference point stays in it; if none, in that of the walls
  double clearance = 0.0;               ///< 0 to 8; planned with r (1 + 1e-9), as MazeWorld does
  LatticeSize lattice;
};

/// The passages of the lattice roadmap among walls: bit for bit the edges that the tiled planner and the plain one with
/// the lattice sampler use. The tiles of planners/mazes make them: walls are filed by tile, each tile's plane of bytes
/// loses what they block, and its bytes are packed to bits. Cost: that of the tiled planner's first two stages, about 5
/// ns of CPU a cell in a maze, and 8 bytes a wall for the time of it. Throws Stopped, and InputError for a clearance or
/// a lattice out of range.
LatticePassages wall_passages(const WalledLattice& world, const Execution& execution);

}  // namespace warren
