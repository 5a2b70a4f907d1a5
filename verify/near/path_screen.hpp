// SPDX-License-Identifier: BSD-3-Clause
// Which walls are surely not near this path? A first screen: it drops almost every wall of a maze for a few
// nanoseconds, and calls the others doubtful.
//
// A lattice cuts the plane into open cells, the open edges between them, and corners. All lines are multiples of a
// power of two, so where a number lies is known without rounding. Two bits a cell say whether the path meets
//   up:     the cell, the edge above it, or the cell above that;
//   right:  the cell, the edge right of it, or the cell right of that.
// A wall is grown by the reach, rounded outwards to 1/256 of a cell; the path is as far as asked for if it meets
// nothing within that open box. A wall as long as a cell side grown by half a side covers just two cells and their
// edge: one bit decides. A path along the lattice's lines leaves cells empty on both its sides, so in a lattice maze
// the walls half a cell off on both sides, which tie with the least distance, are dropped all the same. (A path that
// touches a corner meets an edge or a cell there too, so corners need no bit.)
//
// Memory: 2 bits a cell, at most some 64 cells a leg. A leg costs its length in cells; a wall some vector instructions
// and one lookup, or one for every 28 cells of the columns that it covers. Cells lie column by column, as the walls of
// the maze generator do. Conservative: a wall that comes nearer is never dropped. Rounding: a coordinate is multiplied
// by a power of two, which is exact, rounded down (or up) to a whole number by the magic number 1.5 * 2^52, which is
// exact below 2^51 and monotone above, and whole numbers below 2^53 are subtracted. Where the path itself lies beyond
// 2^50 of these units, every wall is doubtful.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
// From coordinates to the cells of a PathScreen, along one axis, in units of 1/256 of a cell.

inline constexpr int cell_quantum_bits = 8;  ///< a cell has 2^8 units

/// A coordinate times `per_unit` is in units. A wall that reaches from a to b, in units, covers the cells of a -
/// before_first .. b - before_last, each cut to 0 .. end.
struct CellAxis {
  double per_unit, before_first, before_last, end;
};

/// The same from the steps of a packed wall, in whole numbers.
struct CellStepAxis {
  int shift;  ///< left: from steps to units
  std::int32_t before_first, before_last, end;
};

/// The next whole numbers below and above |u| < 2^51: adding 1.5 * 2^52 leaves no room for fractions.
[[gnu::always_inline]] inline double whole_below(double u) {
  constexpr double magic = 6755399441055744.0;
  const double near = (u + magic) - magic;
  return near + (near > u ? -1.0 : 0.0);  // "- 0.0" would be a jump, not a lane
}
[[gnu::always_inline]] inline double whole_above(double u) {
  constexpr double magic = 6755399441055744.0;
  const double near = (u + magic) - magic;
  return near + (near < u ? 1.0 : 0.0);
}

/// Holds nothing of the path. After set_reach any number of threads may ask.
class PathScreen {
 public:
  /// What is to come; it decides on the cells, and on the instructions.
  struct Plan {
    std::size_t walls = 0;
    double typical_wall = 0.0;  ///< the extent of most, 0 if not known
    double reach = 0.0;         ///< the largest that will be set, 0 if not known
    bool plain = false;         ///< without what this processor can do beyond the baseline
  };
  PathScreen(const LegBoxes& legs, const Plan& plan, const Execution& execution);

  /// From now on walls at `least` and at r (1 + 1e-12) are far enough. At most some cells, or the screen is slow.
  void set_reach(double least, double r);

  /// What sift() leaves.
  struct Rest {
    std::vector<std::size_t> doubtful;  ///< the walls that may be near
    Box box;                            ///< of all walls
  };
  /// Walls are numbered from `first_number`; what they say is added to `rest`.
  template <class Wall>  // PackedWall, FloatWall or DoubleWall
  void sift(std::span<const Wall> walls, std::size_t first_number, Rest& rest) const;

 private:
  static constexpr std::int32_t margin = 2;           ///< empty cells around the path: what is outside falls on these
  static constexpr std::int32_t most_side = 1 << 21;  ///< cells

  /// Where a coordinate lies: in the open cell, or on the line where that begins.
  struct Place {
    std::int32_t cell;
    bool on_line;
  };
  /// Cells first .. last.
  struct Window {
    std::int32_t column_first, column_last, row_first, row_last;
  };
  /// Columns first .. last - 1.
  struct Stripe {
    std::int32_t first, last;
  };

  void choose_cell(const LegBoxes& legs, const Plan& plan);
  Place place(double x, double first_cell) const;
  void mark_leg(const Segment& leg, const Stripe& stripe);
  void mark_box(const Box& box, const Stripe& stripe);
  void set(std::int32_t column, std::int32_t row, unsigned which, const Stripe& stripe);
  bool is_clear(const Window& window, std::size_t& budget) const;
  CellAxis axis(double first_cell, std::int32_t count) const;
  std::optional<CellStepAxis> step_axis(double first_cell, std::int32_t count) const;
  template <class Wall, class Scale>
  void sift_along(std::span<const Wall> walls, std::size_t first_number, const Scale& x, const Scale& y,
                  Rest& rest) const;

  bool plain_;
  double cell_ = 1.0;
  double per_cell_ = 1.0;
  bool usable_ = true;
  double first_column_ = 0.0;  ///< the lattice's number of our column 0
  double first_row_ = 0.0;
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  double reach_ = 1.0;            ///< units, whole
  std::size_t stride_ = 0;        ///< bytes of a column
  RawVector<std::uint8_t> bits_;  ///< bit 2 * row of a column: up; the one after it: right
};

}  // namespace warren
