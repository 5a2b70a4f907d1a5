// SPDX-License-Identifier: BSD-3-Clause
// Is a lower bound that an answer claims one? By formulae of the judge's own, and where these are too weak by a slow
// search of its own for a way of a point that is shorter than claimed: over all corners of the scene, each leg judged
// by verify_path(), those that promise most first, none left out but what is too long by the triangle inequality. So a
// way that is found refutes the bound if it is judged free as a whole, and none proves it: legs are looked at one by
// one, which lets through more than whole ways.
//
// O(n^2 log n) and at most n^2 / 2 verdicts on single legs, for n corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/base/enum_names.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// absent: nothing is claimed. unchecked: neither proved nor refuted here.
enum class BoundVerdict : std::uint8_t { absent, checked, unchecked, refuted };
constexpr auto enum_names(BoundVerdict) {
  return std::array<std::string_view, 4>{"absent", "checked", "not re-checked", "refuted"};
}

/// Above, the slow search is left out.
inline constexpr std::size_t most_judged_corners = 2'000;

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
