// SPDX-License-Identifier: BSD-3-Clause
// The cheapest path of each of the cheapest homotopy classes on a map, pulled taut in its class, for points and discs.
#pragma once

#include <functional>

#include "core/base/bitmap.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/goals_on_map.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// What a solve over cells holds when it has found a path.
struct RoutesAsked {
  const OccupancyMap& map;                      ///< as the question closes and opens it
  const WallProblem& problem;                   ///< its goal is the one that is reached
  const Bitmap& closed;                         ///< cells that the body may not touch
  const Bitmap& wide;                           ///< cells where its middle may not be
  StepWeights& weights;                         ///< of steps between the others
  const DistanceField* distances;               ///< of the closed cells; nullptr: not made
  LegPrices prices;                             ///< empty: ways cost their length
  std::function<PriceParts(Vec2, Vec2)> parts;  ///< of a leg, where there are prices
};

/// Takes the cheapest of the paths as the answer's own, and the others as its alternatives, all of them verified, of
/// different classes by the judge's own cuts. answer: has the path that is found without alternatives, which is never
/// cheaper than what is taken. Throws UsageError where the question has stops or a region, Stopped.
void take_alternatives(Answer& answer, const RouteRule& route, const RoutesAsked& asked, const Execution& execution);

}  // namespace warren
