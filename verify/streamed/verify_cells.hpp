// SPDX-License-Identifier: BSD-3-Clause
// Is this path free among walls that are not held? The tiles that the path comes near are asked for, one after the
// other, by all threads, and each leg is compared with the walls around it; nothing of a tile is kept. Cost: the tiles
// near the path, and some hundred ns a leg; 80 bytes for each run of legs near one tile, and 5 bytes a leg.
//
// Almost all legs of a path over a lattice are steps from the middle of a cell to that of a neighbour. Of such a step
// nothing but the wall between the two comes nearer than a half: all other walls lie on lines half a unit beside it, or
// begin half a unit beside it. So where walls can be looked up one look at one wall judges a step, and where some wall
// stands beside one, a half is the least distance. The first and the last leg may be others: these, and any path that
// is not free or not of this kind, are judged as among cells. Cost: some ns a step.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

class LookedUpWalls;  // verify/streamed/looked_up_walls.hpp

/// As verify_path among the same walls held, of a point or disc that keeps off them: InputError where contact is
/// allowed. A wall is named by its ends alone. The result is the same for any number of threads.
Verification verify_among_cells(const CellWallSource& cells, std::span<const Vec2> path, const VerifyOptions& options,
                                const Execution& execution);

/// The least distance that was met, and the first leg that comes too near a wall, with that wall's number.
struct NearestWalls {
  double least;
  std::uint64_t leg, wall;
};

/// Looks at the walls of these tiles alone, as far as `reach` around each leg: a share of the judge's work.
NearestWalls nearest_among_cells(const CellWallSource& cells, Range tiles, std::span<const Vec2> path,
                                 const VerifyOptions& options, double reach, const Execution& execution);

/// Who looks at the other tiles where the judge looks at some.
class JudgesElsewhere : NotCopied {
 public:
  virtual ~JudgesElsewhere() = default;
  /// The tiles that are left to the judge itself.
  virtual Range own_tiles() const = 0;
  /// They begin to look at a path, which stays until take().
  virtual void begin(std::span<const Vec2> path, double reach) = 0;
  /// Waits for what they have found, one each.
  virtual std::vector<NearestWalls> take() = 0;
};

/// The same of a path that comes in pieces, of which none is kept. Refers to the cells, which must outlive it.
class JudgeAmongCells {
 public:
  /// others: look at the tiles that are not theirs, where there are such.
  JudgeAmongCells(const CellWallSource& cells, const VerifyOptions& options, const Execution& execution,
                  JudgesElsewhere* others = nullptr);
  /// The points that follow; each piece but the first begins with the last point of the one before.
  void add(std::span<const Vec2> piece);
  /// Of all pieces, at least one.
  Verification verdict() const;

 private:
  Tally compared(const LegBoxes& legs) const;

  const CellWallSource& cells_;
  const VerifyOptions options_;
  const Execution execution_;
  JudgesElsewhere* others_;
  std::uint64_t points_ = 0;
  std::array<Vec2, 2> ends_{};  // the first point, and the last so far
  LegReport report_;
  double length_ = 0.0;
};

/// As verify_among_cells, a look at a wall a step of a path over a lattice.
Verification verify_steps(const LookedUpWalls& walls, std::span<const Vec2> path, const VerifyOptions& options,
                          const Execution& execution);

}  // namespace warren
