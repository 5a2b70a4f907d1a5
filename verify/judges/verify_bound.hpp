// SPDX-License-Identifier: BSD-3-Clause
// Is a lower bound that an answer claims one? By formulae of the judge's own, and where these are too weak by a slow
// search of its own for a way of a point that is shorter than claimed: over all corners of the scene, the most
// promising first, none left out but what is too long by the triangle inequality; that two legs follow each other is
// for verify_path() to say. A way that is found refutes the bound if it is free as a whole; none proves it, since whole
// ways are free two legs at a time.
//
// O(n^2 log n) and a verdict on each of at most n^2 / 2 pairs of corners and more where walls end at corners; given up
// after most_judged_legs of them.
//
// A claim may come with a proof: a function over a map's cells (core/base/cell_potential). In each triangle where the
// body's middle may be, its slope is compared with the least price of length there: for that one look at each triangle
// is enough, and who made it needs no trust. Nothing from spatial/ or planners/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/cell_potential.hpp"
#include "core/base/enum_names.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// absent: nothing is claimed. unchecked: neither proved nor refuted here.
enum class BoundVerdict : std::uint8_t { absent, checked, unchecked, refuted };
constexpr auto enum_names(BoundVerdict) {
  return std::array<std::string_view, 4>{"absent", "checked", "not re-checked", "refuted"};
}

/// Above, the slow search is left out.
inline constexpr std::size_t most_judged_corners = 2'000;
/// And given up, some seconds later.
inline constexpr std::size_t most_judged_legs = 200'000;

/// Places to pass whose orders are compared.
inline constexpr std::size_t most_judged_stops = 12;

/// The shortest straight way from the start over all of the stops, 1 .. most_judged_stops, in any order, and to the end
/// where there is one: no path that does it is shorter. O(n^2 2^n).
double straight_tour(Vec2 start, std::span<const Vec2> stops, std::optional<Vec2> end);

/// A claim, and the path that was judged free, all in the judge's numbers.
struct ClaimedBound {
  double lower_bound = 0.0;             ///< that the answer claims
  std::optional<double> cost = {};      ///< that it claims; none: the length is bounded
  double length = 0.0;                  ///< of the path, as the judge has measured it
  std::size_t width = 2;                ///< numbers a state
  std::span<const double> states = {};  ///< of the path, one after the other; of points it may be left out
};

/// The question that was asked.
struct BoundQuestion {
  const RobotSpec& robot;
  std::span<const double> start;
  std::span<const double> goal;  ///< may lack a heading, or be a place of an arm's tool
  double clearance = 0.0;
};

struct JudgedBound {
  BoundVerdict verdict = BoundVerdict::unchecked;
  std::string what;  ///< is wrong, where it is refuted
};

/// A bound above the path's own cost, a cost that is not the path's in the body's metric, and a bound above the length
/// of a free way are refuted. Differences of 1e-9 of the numbers count as none. Stops leave it unchecked.
JudgedBound verify_bound(const Scene& scene, const BoundQuestion& asked, const ClaimedBound& claim,
                         const Execution& execution);

/// What is claimed, in world coordinates and units. What areas and masks add is not counted: a bound without is one.
struct PotentialClaim {
  Vec2 start;                ///< of the body's middle
  Vec2 goal;                 ///< of the body's middle
  double keeps = 0.0;        ///< the middle's distance to what is blocked is never less
  double radius = 0.0;       ///< of the disc; 0: a point
  double price = 0.0;        ///< a unit of length in touch costs so much more, >= 0
  double reach = 0.0;        ///< from so far from its rim on nothing is paid; > 0 where there is a price
  double lower_bound = 0.0;  ///< of the cost
};

/// `map`: its blocked cells as the question closes and opens them, water where the path may not go included. Checked or
/// refuted, the same for any number of threads; rounding counts against the claim. Throws Stopped.
JudgedBound verify_potential(const OccupancyMap& map, const PotentialClaim& claim, const CellPotential& proof,
                             const Execution& execution);

}  // namespace warren
