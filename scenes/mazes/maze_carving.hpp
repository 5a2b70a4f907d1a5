// SPDX-License-Identifier: BSD-3-Clause
// What the maze generators share: steps between neighbours over the bytes of MazeCells, scratch bits in those bytes,
// and the poll of the deadline. Each carve_* takes cells whose walls all stand and opens rows * cols - 1 of them so
// that every cell reaches every other in exactly one way; scratch bits may stay behind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "core/base/rng.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren::maze {

void carve_backtracker(MazeCells& cells, std::uint64_t seed, const Execution& execution);
void carve_kruskal(MazeCells& cells, std::uint64_t seed, const Execution& execution);
void carve_prim(MazeCells& cells, std::uint64_t seed, const Execution& execution);
void carve_wilson(MazeCells& cells, std::uint64_t seed, const Execution& execution);
void carve_course(MazeCells& cells, std::uint64_t seed, const Execution& execution);

/// Scratch bits of a cell's byte while a maze is carved.
inline constexpr std::uint8_t in_maze = 4;
inline constexpr std::uint8_t in_frontier = 8;
inline constexpr std::uint8_t outside = 0x80;   ///< marks the gap bytes
inline constexpr unsigned direction_shift = 4;  ///< two bits hold a direction
inline constexpr std::uint8_t direction_bits = 3U << direction_shift;

/// Directions are 0 right, 1 up, 2 left, 3 down; the opposite is d ^ 2.
class Steps {
 public:
  explicit Steps(MazeCells& cells)
      : bytes_(cells.bytes().data()),
        end_(cells.bytes().size()),
        offsets_{static_cast<std::ptrdiff_t>(cells.stride()), 1, -static_cast<std::ptrdiff_t>(cells.stride()), -1} {}

  /// The neighbour's index; may be a gap byte, and right of the last or left of the first column it is no index at all.
  std::size_t neighbour(std::size_t i, unsigned d) const { return i + static_cast<std::size_t>(offsets_[d]); }
  bool is_index(std::size_t i) const { return i < end_; }
  std::uint8_t& operator[](std::size_t i) const { return bytes_[i]; }

  /// Takes out the wall between cell i and its neighbour in direction d.
  void open(std::size_t i, unsigned d) const {
    const std::size_t owner = d < 2 ? i : neighbour(i, d);
    bytes_[owner] = static_cast<std::uint8_t>(bytes_[owner] & ~(1U << (d & 1U)));
  }
  /// Which of the four neighbours exist and have exactly `value` among `bits`; bit d stands for direction d. Gap bytes
  /// are looked at like cells, so they must differ.
  unsigned neighbours_with(std::size_t i, std::uint8_t bits, std::uint8_t value) const {
    unsigned mask = (bytes_[i + 1] & bits) == value ? 2U : 0U;
    mask |= (bytes_[i - 1] & bits) == value ? 8U : 0U;
    if (is_index(neighbour(i, 0))) mask |= (bytes_[neighbour(i, 0)] & bits) == value ? 1U : 0U;
    if (i > static_cast<std::size_t>(offsets_[0])) mask |= (bytes_[neighbour(i, 2)] & bits) == value ? 4U : 0U;
    return mask;
  }

 private:
  std::uint8_t* bytes_;
  std::size_t end_;
  std::array<std::ptrdiff_t, 4> offsets_;
};

/// By mask of directions, 1 to 15: twelve of them, each as often as the others.
inline constexpr std::array<std::uint8_t, 256> direction_choices = [] {
  std::array<std::uint8_t, 256> choices{};
  for (unsigned mask = 1; mask < 16; ++mask) {
    std::array<std::uint8_t, 4> candidates{};
    unsigned count = 0;
    for (std::uint8_t d = 0; d < 4; ++d) {
      if ((mask >> d & 1U) != 0) candidates[count++] = d;
    }
    for (unsigned k = 0; k < 12; ++k) choices[mask * 16 + k] = candidates[k % count];
  }
  return choices;
}();
/// One of the directions in a mask: one random number below 12 serves 1, 2, 3 and 4 candidates alike.
inline unsigned choose_direction(unsigned mask, SequentialRng& rng) {
  return direction_choices[mask * 16 + rng.below(12)];
}

/// Looks at the deadline every 16384th step and tells how many cells are carved.
class StepPoll {
 public:
  explicit StepPoll(const Execution& execution) : execution_(execution) {}
  void step(std::uint64_t carved) {
    if ((++steps_ & 0x3fffU) == 0) look(carved);
  }

 private:
  void look(std::uint64_t carved) {
    execution_.check();
    execution_.advance(carved - told_);
    told_ = carved;
  }
  const Execution& execution_;
  std::uint64_t steps_ = 0;
  std::uint64_t told_ = 0;
};

/// The parents of 0 .. count - 1 as root_of() and unite() take them, each a region of its own. Throws Stopped.
template <class Id>
RawVector<Id> single_regions(std::size_t count, const Execution& execution) {
  RawVector<Id> parents(count);
  for_each_index(count, std::size_t{1} << 16, {execution.threads, execution.deadline},
                 [&](std::size_t i) { parents[i] = static_cast<Id>(i); });
  return parents;
}

}  // namespace warren::maze
