// SPDX-License-Identifier: BSD-3-Clause
// What is done to every point of a row of a tile's plane, many points an instruction. Integers only, so every
// instruction set gives the same bytes; which one is used is asked of the processor once.
#pragma once

#include <array>
#include <cstdint>

namespace warren {

/// A row of a plane, the rows above and below it, and a row of scratch with a free byte before and after it.
struct PlaneRow {
  std::uint8_t* row;
  std::uint8_t* above;
  std::uint8_t* below;
  std::uint8_t* found;
  int width;
};

/// The same work for one instruction set.
struct PlaneRowWork {
  const char* name;
  /// Takes the row's dead ends off (points with one edge that are not kept become 0), and their edges from the
  /// neighbours in it, above and below. Of two dead ends that are all of their component the left one keeps standing
  /// without edges.
  void (*peel)(const PlaneRow&);
  /// found[i] becomes nonzero where point i is a dead end, else 0.
  void (*find_dead_ends)(const PlaneRow&);
  /// found[i] becomes nonzero where point i stands but for those with two edges that are not kept, else 0.
  void (*find_keys)(const PlaneRow&);
};

/// What this processor can run, the fastest last; the first needs nothing special.
struct PlaneRowVariants {
  std::array<PlaneRowWork, 3> list;
  std::size_t count;
};
PlaneRowVariants plane_row_variants();

/// The fastest.
const PlaneRowWork& plane_row_work();

}  // namespace warren
