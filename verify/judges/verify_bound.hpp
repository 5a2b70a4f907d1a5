// SPDX-License-Identifier: BSD-3-Clause
// Is a lower bound that an answer claims one? By formulae of the judge's own, and where these are too weak by a slow
// search of its own for a way of a point that is shorter than claimed: over all corners of the scene, the most
// promising first, none left out but what is too long by the triangle inequality; that two legs follow each other is
// for verify_path() to say. A way that is found refutes the bound if it is free as a whole; none proves it, since whole
// ways are free two legs at a time.
//
// O(n^2 log n) and a verdict on each of at most n^2 / 2 pairs of corners and more where walls end at corners; given up
// after most_judged_legs of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/enum_names.hpp"
#include "core/run/execution.hpp"
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

}  // namespace warren
