// SPDX-License-Identifier: BSD-3-Clause
// Is this path free? Independent of everything that found it: nothing from spatial/ and no predicate of
// core/plane/geometry is used; distances and orientations are computed by verify/exact/exact_segments, exact where they
// decide. The obstacles are streamed past the path (verify/judges/leg_reports), so that millions of legs
// among hundreds of millions of walls take seconds: O(walls + legs) on paths as planners find them, memory of the order
// of the legs. Where long legs cross most of the scene it is O(walls * legs) at worst.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/enum_names.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

class ObstacleIndex;  // verify/near/obstacle_index.hpp

enum class Contact : std::uint8_t { blocked, allowed };
constexpr auto enum_names(Contact) { return std::array<std::string_view, 2>{"blocked", "allowed"}; }

struct VerifyOptions {
  double radius = 0.0;                 ///< of the disc; 0: a point; >= 0, finite
  double clearance = 0.0;              ///< room around the body all along the path; >= 0, finite
  Contact contact = Contact::blocked;  ///< with reach 0: touching counts as blocked, or only crossing
  std::optional<Vec2> start = {};      ///< where the path must begin; nullopt: anywhere
  std::optional<Vec2> goal = {};       ///< where it must end

  /// What the reference point keeps from every obstacle.
  double reach() const { return clearance + radius; }
};

/// Point or disc among the scene's walls, polygons and bounds; on a map by its cells (verify_on_map()), where
/// contact can't be allowed. Throws InputError for scenes that hold anything else, or nothing
/// (verify/judges/leg_reports). The path has at least one point, all finite, fewer than 500 million (InputError
/// otherwise); a single point is a leg of length zero. The points must lie in the box of walls and polygons, or in the
/// bounds. The result is the same for any number of threads, with an index of this scene and without: with it a verdict
/// takes what the path does, not the scene. Of a map there is none: its cells are looked up anyway.
Verification verify_path(const Scene& scene, std::span<const Vec2> path, const VerifyOptions& options,
                         const Execution& execution, const ObstacleIndex* index = nullptr);

/// A point or disc; with a reach of 0 it touches no blocked square; contact can't be allowed. A leg costs the cells
/// within its clearance, and those within the least distance met so far. Water is free to a path that begins on water
/// and blocked to all others. At least one point, all finite (InputError otherwise). The same for any number of
/// threads; throws Stopped.
Verification verify_on_map(const OccupancyMap& map, std::span<const Vec2> path, const VerifyOptions& options,
                           const Execution& execution);

}  // namespace warren
