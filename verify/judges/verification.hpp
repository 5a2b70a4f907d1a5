// SPDX-License-Identifier: BSD-3-Clause
// What a judge says of a path, whatever the body: the same for points, discs, turning polygons, cars and arms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace warren {

/// What a path is refuted for.
enum class ViolationKind : std::uint8_t {
  obstacle,  ///< it touches something, comes too near to it, or has another start or goal
  motion,    ///< the body can't move so on that leg, or not get there
  claim      ///< its answer says what the path does not have; of no leg
};

/// Where a path is not free, or not as it was asked for.
struct Violation {
  std::size_t leg = 0;    ///< 0-based: from path[leg] to path[leg + 1]
  double distance = 0.0;  ///< between that leg and the obstacle; 0 inside a polygon or outside the box
  std::string
      obstacle;  ///< e.g. "wall 17: 1.5 0.5 1.5 1.5", "polygon 2: ...", "cell 3, 4", "bounds: ...", "start: ..."
  ViolationKind kind = ViolationKind::obstacle;  ///< what the path is refuted for
};

/// What a judge says of a path.
struct Verification {
  bool verified = false;  ///< is it free all along, with all its clearance?
  double length = 0.0;    ///< Euclidean; of a car's curve; of arms in joint space: radians
  /// Least distance of the body to any obstacle, infinite where there is none; below 0 where a disc overlaps one. Each
  /// judge says how sharp it is.
  double min_clearance = std::numeric_limits<double>::infinity();
  std::optional<Violation> first_violation;  ///< on the smallest leg
  double turn_rad = 0.0;                     ///< sum of the turns; 0 for bodies without a heading
  std::size_t cusps = 0;                     ///< cars: changes between forwards and backwards
  double reversed = 0.0;                     ///< cars: length of what is driven backwards
};

}  // namespace warren
