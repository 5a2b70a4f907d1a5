// SPDX-License-Identifier: BSD-3-Clause
// Which cells of a bitmap are free, with a margin of blocked ones, so that a search needs no test for the border: a
// cell's number is its bit's position, a neighbour is a constant away, and 64 cells of a row are one load. One bit a
// cell, rows rounded up to 64 with at least one blocked cell between them.
//
// Which cells of a map make milestones (cell_milestones) of a roadmap whose corridors are about a cell wide: the
// middle of every free cell, but of two neighbours inside a straight corridor one cell wide only one, by a
// chequerboard. What is left out has two kept cells beside it, two cells apart, so motions of at most two cells join
// exactly what steps over common sides join; and a maze drawn with walls and corridors of one cell has one milestone a
// cell of the maze. Bit-parallel: O(cells / 64).
#pragma once

#include <array>
#include <cstdint>

#include "core/base/bitmap.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/run/execution.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {

/// Any number of threads may read. Cells are numbered by VertexId: number(x, y) = (y + 1) stride + x + 64.
class FreeCells {
 public:
  FreeCells() = default;
  /// Throws InputError where the padded map would have 2^32 cells or more, Stopped.
  explicit FreeCells(const Bitmap& blocked, const Execution& execution = {});

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t stride() const { return stride_; }
  /// One more than the largest number of a cell.
  std::size_t number_end() const { return number_end_; }

  VertexId number(Cell c) const { return (c.y + 1) * stride_ + c.x + margin; }
  Cell cell(VertexId v) const {
    const VertexId from_margin = v - margin;
    auto row = bounded_whole<VertexId>(from_margin * per_stride_);
    if (from_margin - row * stride_ >= stride_) from_margin < row* stride_ ? --row : ++row;  // the product was rounded
    return {from_margin - row * stride_, row - 1};
  }
  /// Not while another thread reads.
  void change(Cell c, bool is_free) {
    const VertexId v = number(c);
    const std::uint64_t bit = std::uint64_t{1} << v % 64;
    words_[v / 64] = is_free ? words_[v / 64] | bit : words_[v / 64] & ~bit;
  }
  bool is_free(VertexId v) const { return (words_[v / 64] >> v % 64 & 1U) != 0; }
  /// Bit i: is cell first + i free? `first` may be any number of a cell, less at most a row, 64 and one.
  std::uint64_t from(VertexId first) const {
    const std::uint32_t shift = first % 64;
    return words_[first / 64] >> shift | words_[first / 64 + 1] << 1 << (63 - shift);
  }
  /// Bits 0-2: the three cells below v, from the left; 3-5: v's row; 6-8: the row above.
  unsigned around(VertexId v) const {
    return as_whole<unsigned>((from(v - stride_ - 1) & 7U) | (from(v - 1) & 7U) << 3 |
                              (from(v + stride_ - 1) & 7U) << 6);
  }

 private:
  static constexpr VertexId margin = 64;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint32_t stride_ = 64;
  double per_stride_ = 1.0 / 64;
  std::size_t number_end_ = 0;
  RawVector<std::uint64_t> words_;
};

/// The bitmap with rows and columns exchanged. Throws Stopped.
Bitmap transposed(const Bitmap& bitmap, const Execution& execution);

/// The eight steps from a cell, by ascending number of the cell that they lead to.
inline constexpr std::array<std::array<int, 2>, 8> cell_steps{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
constexpr bool is_diagonal(unsigned step) { return step == 0 || step == 2 || step == 5 || step == 7; }

/// Those and a knight's, of fields that bound ways in 16 or more directions from below.
inline constexpr std::array<std::array<int, 2>, 16> knight_steps{{{1, 0},
                                                                  {0, 1},
                                                                  {-1, 0},
                                                                  {0, -1},
                                                                  {1, 1},
                                                                  {-1, 1},
                                                                  {-1, -1},
                                                                  {1, -1},
                                                                  {2, 1},
                                                                  {1, 2},
                                                                  {-1, 2},
                                                                  {-2, 1},
                                                                  {-2, -1},
                                                                  {-1, -2},
                                                                  {1, -2},
                                                                  {2, -1}}};

/// Which steps are allowed: sides only; or diagonals too, where both cells beside them are free (Moving AI's rule); or
/// diagonals wherever the cell that they lead to is free.
enum class StepRule : std::uint8_t { four, eight, eight_squeezing };

/// For each of the 512 neighbourhoods (FreeCells::around) a bit for each allowed step of cell_steps.
const std::array<std::uint8_t, 512>& allowed_steps(StepRule rule);

/// The middles of a map's corridors, to draw samples from: the cells on the ridges of the distance transform. A ridge
/// is where the distance falls to both sides: along one of the four axes through the cell the two drops add up to 0.6
/// of the way or more (2 in a corridor, 0 beside a straight wall, less than 0 around a corner; small steps of a slanted
/// wall stay below). A cell at distance d weighs 1 / d, so that a stretch of corridor as long as it is wide gets the
/// same share of the samples whatever its width. Cells are filed tile by tile, therefore evenly spread shares are
/// evenly spread over the map. O(cells) to build; 1 bit a cell and 12 bytes a ridge cell; O(log ridge cells) a sample.
/// Immutable; any number of threads may draw.
class CorridorCells {
 public:
  struct Place {
    Cell cell;
    double distance;  ///< of the cell's middle from what is blocked, in cells
  };

  /// Ridge cells at least so far from what is blocked, in cells. Throws Stopped.
  CorridorCells(const DistanceField& field, double least, const Execution& execution);

  bool empty() const { return places_.empty(); }
  std::size_t size() const { return places_.size(); }
  /// The sum of 1 / distance: how many stretches as long as half their width there are.
  double weight() const { return weight_sums_.empty() ? 0.0 : weight_sums_.back(); }
  /// The cell at this share, 0 to 1, of all weights; not empty().
  Place at(double share) const;
  /// Is it a ridge cell? Any coordinates.
  bool holds(std::int64_t x, std::int64_t y) const { return ridge_.holds(x, y); }

 private:
  std::uint32_t width_;
  Bitmap ridge_;
  RawVector<std::uint32_t> places_;  // cell (x, y) as y * width + x
  RawVector<double> weight_sums_;    // of the places up to this one
};

/// The longest motion between milestones that are to be joined, in cells, and room for rounding.
inline constexpr double cell_milestone_reach = 2.0 * (1.0 + 1e-6);

/// A bit for each cell whose middle is a milestone. Throws Stopped.
Bitmap cell_milestones(const Bitmap& blocked, const Execution& execution);

/// Are most free cells in passages one cell wide, that is, in no square of two by two free cells? There a sample drawn
/// anywhere seldom sees the next one, and the middles of the cells are the cheaper milestones. Throws Stopped.
bool is_narrow(const Bitmap& blocked, const Execution& execution = {});

}  // namespace warren
