// SPDX-License-Identifier: BSD-3-Clause
// Is this path free among walls that are not held? The tiles that the path comes near are asked for, one after the
// other, by all threads, and each leg is compared with the walls around it; nothing of a tile is kept. Cost: the tiles
// near the path, and some hundred ns a leg; 80 bytes for each run of legs near one tile, and 5 bytes a leg.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "parallel/execution.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

/// As verify_path among the same walls held, of a point or disc that keeps off them: InputError where contact is
/// allowed. A wall is named by its ends alone. The result is the same for any number of threads.
Verification verify_among_cells(const CellWallSource& cells, std::span<const Vec2> path, const VerifyOptions& options,
                                const Execution& execution);

/// The same of a path that comes in pieces, of which none is kept. Refers to the cells, which must outlive it.
class JudgeAmongCells {
 public:
  JudgeAmongCells(const CellWallSource& cells, const VerifyOptions& options, const Execution& execution);
  /// The points that follow; each piece but the first begins with the last point of the one before.
  void add(std::span<const Vec2> piece);
  /// Of all pieces, at least one.
  Verification verdict() const;

 private:
  const CellWallSource& cells_;
  const VerifyOptions options_;
  const Execution execution_;
  std::uint64_t points_ = 0;
  std::array<Vec2, 2> ends_{};  // the first point, and the last so far
  LegReport report_;
  double length_ = 0.0;
};

}  // namespace warren
