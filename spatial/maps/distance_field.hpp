// SPDX-License-Identifier: BSD-3-Clause
// The exact Euclidean distance transform of a bitmap: for each cell the squared distance to the nearest blocked one, in
// whole numbers. Two passes (Meijster, Roerdink, Hesselink 2000): down and up each column, then along each row the
// lower envelope of the columns' curves; linear in the cells, both passes in parallel, 4 bytes a cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/bitmap.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// centres: between the middles of two cells, in squared cells. squares: from the middle of a cell to the other cell's
/// closed square, in squared half cells: max(2 |dx| - 1, 0)^2 + max(2 |dy| - 1, 0)^2.
enum class CellDistance : std::uint8_t { centres, squares };

/// Any number of threads may read while nobody changes it.
class DistanceField {
 public:
  /// Beyond what fits; and where nothing is blocked at all.
  static constexpr std::uint32_t far = std::numeric_limits<std::uint32_t>::max();

  /// outside_blocked: the cells around the bitmap count as blocked. Throws Stopped.
  DistanceField(const Bitmap& blocked, CellDistance kind, bool outside_blocked, const Execution& execution);

  /// From now on what is farther than so many cells counts as so far: changes of the map are not felt beyond.
  /// Throws Stopped, and is of no use then.
  void cut_off(double cells, const Execution& execution);
  /// After changes of the bitmap from column low.x to high.x and row low.y to high.y, as a new field that is cut off
  /// alike; costs what the cells around them cost, and whole fields that are not cut off. Throws as cut_off().
  void renew(const Bitmap& blocked, Cell low, Cell high, const Execution& execution);

  /// Infinite where it is not cut off.
  double kept_cells() const { return kept_cells_; }

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Squared, in the kind's units; 0 for blocked cells.
  std::uint32_t squared(std::uint32_t x, std::uint32_t y) const { return squared_[std::size_t{y} * width_ + x]; }
  /// In cells: from the middle of this cell to the middle, or the square, of the nearest blocked one.
  double distance(std::uint32_t x, std::uint32_t y) const;

 private:
  std::uint32_t cut_off_squared() const;
  std::uint32_t width_;
  std::uint32_t height_;
  CellDistance kind_;
  bool outside_blocked_;
  double kept_cells_ = std::numeric_limits<double>::infinity();
  RawVector<std::uint32_t> squared_;
};

/// The cells where the middle of a disc may not be: blocked ones, and those whose middle is nearer than `radius` (in
/// cells, >= 0) to a blocked closed square or to the outside of the map. Exact. O(cells).
Bitmap blocked_for_disc(const Bitmap& blocked, double radius, const Execution& execution);
/// The same by a field that is there: of these cells, to squares, with the outside blocked, not cut off below `radius`.
Bitmap blocked_for_disc(const Bitmap& blocked, const DistanceField& field, double radius, const Execution& execution);
/// The same again, after changes of the cells from low to high for which the field has been renewed. Throws Stopped.
void renew_for_disc(Bitmap& wide, const Bitmap& blocked, const DistanceField& field, double radius, Cell low, Cell high,
                    const Execution& execution);

}  // namespace warren
