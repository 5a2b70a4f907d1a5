// SPDX-License-Identifier: BSD-3-Clause
// Worlds of disjoint simple polygons, any number of them: each lies in a square of its own, convex (corners on a
// circle), a star (corners at random distances) or a crescent (a band bent around a middle). Coordinates are multiples
// of 1/1024, so files are short and the last digits of a sine can't matter. Start and goal stand in the free margin
// around the squares, in opposite corners of the bounds. O(corners), in parallel; the same for the same options on
// every machine.
#pragma once

#include <cstdint>
#include <optional>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// validate() refuses values outside the stated ranges with InputError.
struct PolygonOptions {
  std::uint64_t count = 100;               ///< polygons; >= 1, with all corners below 2^31
  std::optional<std::uint32_t> corners{};  ///< of each polygon, >= 3; none: 3 to 12, at random
  std::uint64_t seed = 1;                  ///< any value

  /// Throws InputError for values outside their ranges.
  void validate() const;
};

/// Throws InputError, Stopped.
Scene polygon_scene(const PolygonOptions& options, const Execution& execution);

}  // namespace warren
