// SPDX-License-Identifier: BSD-3-Clause
// May a path that touches obstacles be moved off them by an arbitrarily small amount? That is what "contact allowed"
// means: running along a wall, touching its end and sliding along a polygon are free; changing the side of a wall,
// passing a corner where walls meet, or an inside, is not.
//
// The path is walked from contact point to contact point. Around each the obstacles' directions cut the plane into
// sectors, in exact order; the path may come in by one and must leave in the same one. A stretch that runs along a wall
// lies on its left or its right side: both possibilities are carried on until a contact point rules them out.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "verify/near/obstacle_sides.hpp"

namespace warren {

/// Leg and obstacle share a point.
struct LegContact {
  std::size_t leg;
  std::size_t obstacle;
  friend auto operator<=>(const LegContact&, const LegContact&) = default;
};

/// The first leg that can't be walked, with the lowest obstacle of the point where it fails. contacts: sorted, all
/// contacts of the legs before `leg_end`; none of these legs crosses an obstacle inside both. frame: the reference
/// point stays in it, and does not get between it and walls that lie on its sides (a maze's outline).
/// O(contacts log contacts).
std::optional<LegContact> first_forbidden_contact(std::span<const Vec2> path, std::size_t leg_end, const Box& frame,
                                                  const Obstacles& obstacles, std::span<const LegContact> contacts,
                                                  const Execution& execution);

}  // namespace warren
