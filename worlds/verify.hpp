// SPDX-License-Identifier: BSD-3-Clause
// Is this path free? Independent of everything that found it: nothing from spatial/ is included, distances and
// orientations are computed here with code of its own (exact by rationals of integers or long double expansions, not
// core/geometry). Legs of the path are binned in a grid of its own and the walls are streamed past them once, so that
// millions of legs among hundreds of millions of walls take seconds: O(walls + legs), memory of the order of the legs.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "core/types.hpp"
#include "parallel/execution.hpp"
#include "worlds/scene.hpp"

namespace warren {

enum class Contact : std::uint8_t { blocked, allowed };

struct VerifyOptions {
  double clearance = 0.0;              ///< every point of the path stays at least so far from every wall
  Contact contact = Contact::blocked;  ///< with clearance 0: touching counts as blocked, or only crossing
  double start_tolerance = 0.0;        ///< path.front() must be within this of the start asked for
};

struct Violation {
  std::size_t leg = 0;    ///< 0-based: from path[leg] to path[leg + 1]
  double distance = 0.0;  ///< between that leg and the obstacle
  std::string obstacle;   ///< e.g. "wall 17: 1.5 0.5 1.5 1.5"
};

struct Verification {
  bool verified = false;
  double length = 0.0;                                             ///< Euclidean
  double min_clearance = std::numeric_limits<double>::infinity();  ///< least distance of the path to any obstacle
  std::optional<Violation> first_violation;  ///< the one with the smallest leg, then the smallest wall number
};

/// Point or disc among walls (and bounds, polygons where the scene has them). The path has at least one point; all
/// points must be finite and inside the obstacles' box (or the bounds).
Verification verify_path(const Scene& scene, std::span<const Vec2> path, const VerifyOptions& options,
                         const Execution& execution);

}  // namespace warren
