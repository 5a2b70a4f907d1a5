// SPDX-License-Identifier: BSD-3-Clause
// Homotopy classes of paths over cells, and the cheapest path of each of the cheapest ones. Holes are what blocked
// cells hang together by sides or corners, do not reach the map's border, and are large enough; two paths are of one
// class if one can be moved into the other over everything but the holes. From the lowest cell of each hole a cut leads
// down between two columns to the next hole or to what hangs together with the border: what is left has no holes, so
// the cuts that a path crosses, in order, inverse neighbours cancelled, are its class and nothing else is.
//
// The search is over pairs of a cell and a word, by the exact costs to the goal. As many words a cell as classes are
// wanted suffice: if so many cheaper ones reach the cell, each followed by the rest leads to a class of its own, since
// words that are followed by the same differ as before. So it costs what as many searches do, and expands little.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "planners/grid/price_field.hpp"

namespace warren {

/// Of a map's cells; immutable, any number of threads may ask.
class HoleCuts {
 public:
  /// A box of cells, both corners in it.
  struct Hole {
    Cell low;
    Cell high;
  };

  /// least: cells that the longer side of a hole's box has at least. Throws Stopped.
  HoleCuts(const Bitmap& blocked, double least, const Execution& execution);

  /// By their lowest cells, of these the leftmost, row by row from below. A letter is a number from 1 of one of these.
  std::span<const Hole> holes() const { return holes_; }
  /// The cells of all of them.
  const Bitmap& cells() const { return cells_; }
  /// What a step crosses: a letter to the right, its negative to the left, 0: nothing.
  std::int32_t letter(Cell from, unsigned step) const;
  /// The class of a path that keeps off the holes' cells, in cells.
  std::vector<std::int32_t> word(std::span<const Vec2> path) const;

 private:
  struct Cut {
    std::uint32_t column;  // it leads between this one and the next
    std::uint32_t low;     // its first row, and the one above its last
    std::uint32_t high;
    std::int32_t hole;
    std::pair<std::uint32_t, std::uint32_t> begin() const { return {column, low}; }
  };
  std::int32_t hole_at(std::uint32_t column, std::uint32_t row) const;

  std::vector<Hole> holes_;
  Bitmap cells_;
  Bitmap cut_cells_;       // to the left of a cut
  std::vector<Cut> cuts_;  // by column and row
};

/// How many classes are looked for.
struct ClassChoice {
  std::size_t count = 1;  ///< with the cheapest; at most 255
  double stretch = 1.5;   ///< that cost so many times the least at most
};

/// The cheapest path of a class.
struct ClassPath {
  std::vector<Cell> cells;           ///< start to goal
  std::uint64_t cost = 0;            ///< units of the weights
  std::vector<std::int32_t> passed;  ///< its class
};

/// The cheapest first; none: there is no way. `field` is of the goal alone, over the same weights. Throws Stopped.
std::vector<ClassPath> cheapest_classes(StepWeights& weights, PriceField& field, const HoleCuts& cuts, Cell start,
                                        Cell goal, const ClassChoice& choice, const Execution& execution);

}  // namespace warren
