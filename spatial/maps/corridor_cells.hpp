// SPDX-License-Identifier: BSD-3-Clause
// The middles of a map's corridors, to draw samples from: the cells on the ridges of the distance transform. A ridge is
// where the distance falls to both sides: along one of the four axes through the cell the two drops add up to 0.6 of
// the way or more (2 in a corridor, 0 beside a straight wall, less than 0 around a corner; small steps of a slanted
// wall stay below). A cell at distance d weighs 1 / d, so that a stretch of corridor as long as it is wide gets the
// same share of the samples whatever its width. Cells are filed tile by tile, therefore evenly spread shares are evenly
// spread over the map. O(cells) to build; 1 bit a cell and 12 bytes a ridge cell; O(log ridge cells) a sample.
#pragma once

#include <cstdint>

#include "core/base/bitmap.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {

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
  std::size_t bytes() const { return ridge_.bytes() + places_.size() * 12; }
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

}  // namespace warren
