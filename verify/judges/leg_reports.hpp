// SPDX-License-Identifier: BSD-3-Clause
// What all judges check before they look at a path. Above all: a judge sees every part of the scene that can be in its
// body's way, or it refuses the scene; what nobody looked at is never called free.
//
// Then the loop that all judges share: the legs of a path one by one, by all threads, and what they come to. The result
// is that of the legs in their order, whatever the threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {

/// Throws InputError for paths and options that no judge of points and discs takes, as verify_path() says.
void check_judged_path(std::span<const Vec2> path, const VerifyOptions& options, const Execution& execution);

/// For bodies in the plane: walls, polygons and bounds, or a map, beside which there are no walls but along its blocked
/// cells. Throws InputError for all else: solids, a map with polygons or bounds, a scene that holds nothing
/// at all (nothing would confine the body). O(1), but for a map with walls: O(their length in cells).
void check_plane_scene(const Scene& scene, const Execution& execution);

/// For arms: spheres, boxes and other solids, or free space. Throws InputError for walls, polygons, bounds and maps.
void check_space_scene(const Scene& scene);

/// Throws InputError, naming it, unless the number is in 0 .. largest_coordinate.
void check_not_negative(std::string_view name, double value);

/// What is known of a leg, or of several.
struct LegReport {
  double least = std::numeric_limits<double>::infinity();  ///< proved
  double met = std::numeric_limits<double>::infinity();    ///< where it was looked: never less than the truth
  std::size_t looks = 0;                                   ///< how often a piece was halved
  std::optional<Violation> violation = {};

  /// Of two violations on one leg the one that was added first is kept.
  void add(const LegReport& more);
};

/// All legs: report_of(range) says what those of a range come to, and may be called by any thread.
template <class ReportOf>
LegReport report_legs(std::size_t count, std::size_t legs_a_chunk, const Execution& execution,
                      const ReportOf& report_of) {
  LegReport whole;
  for (const LegReport& part : parts_of_chunks(count, legs_a_chunk, execution, report_of)) whole.add(part);
  return whole;
}

/// Legs of a path of so many states; a single state is a leg of length zero.
constexpr std::size_t legs_of(std::size_t states) { return states > 1 ? states - 1 : 1; }

/// The violation of a path that begins or ends elsewhere, `distance` away. `which`: "start" or "goal"; `wanted`: the
/// state that was asked for.
Violation elsewhere(std::string_view which, std::span<const double> wanted, double distance, std::size_t leg);

/// What the ends of a path say where it begins or ends elsewhere than it was asked to; nothing where it doesn't.
struct WrongEnds {
  std::optional<Violation> start, goal;
};

/// Of a path of points, of so many legs, of which the first and the last point are looked at.
WrongEnds wrong_ends(std::span<const Vec2> path, const VerifyOptions& options, std::size_t legs);

/// Start before all legs, the goal after them. Leaves it to the caller to measure the path.
Verification verdict_on(const LegReport& legs, const WrongEnds& ends);

// What obstacles say about a path, one pair of leg and obstacle after the other: the least distance, the first
// violation, the contacts. Pairs that are too far apart to matter are left out by their boxes; the others go to
// verify/exact/exact_segments. Parts of the obstacles may be compared by different threads, each with a Comparison of
// its own, and their tallies joined in any order.

/// Leg and obstacle share a point.
struct LegContact {
  std::size_t leg;
  std::size_t obstacle;
  friend auto operator<=>(const LegContact&, const LegContact&) = default;
};

/// Later than every violation.
inline constexpr LegContact no_violation{std::numeric_limits<std::size_t>::max(), 0};

/// Past all numbers of obstacles: the box that confines the path, on one leg reported after them.
inline constexpr std::size_t box_number = std::numeric_limits<std::size_t>::max() - 2;

/// What a part of the obstacles says about the path.
struct Tally {
  double least = std::numeric_limits<double>::infinity();  ///< least distance met
  LegContact violation = no_violation;                     ///< the first
  std::vector<LegContact> contacts;                        ///< only where contact is allowed
  Box box;                                                 ///< of the obstacles

  void join(const Tally& other);
};

/// The first leg that leaves the box is a violation; an empty box confines nothing.
void check_box(const Box& box, const LegBoxes& legs, Tally& tally);

/// A leg, or an obstacle, that is compared with many.
struct BoxedSegment {
  BoxedSegment(const Segment& s, std::size_t of) : segment(s), box(box_of(s)), number(of) {}
  Segment segment;
  Box box;
  std::size_t number;
};

/// Refers to the options, which must outlive it.
class Comparison {
 public:
  /// Distances at or above `at_most` are of no interest.
  Comparison(const VerifyOptions& options, double at_most) : options_(options), at_most_(at_most) { narrow(); }

  /// Is all that lies in the box too far from the leg or obstacle, or from all in a box, to matter?
  bool skips(const BoxedSegment& one, const Box& others) const {
    return skips(one.box, others) || beside(one.segment, others);
  }
  bool skips(const Box& some, const Box& others) const {
    const double gap = exact::gap_sq(some, others);
    return gap >= near_sq_ && gap > 0.0;
  }
  void with_leg(const BoxedSegment& leg, const BoxedSegment& side) {
    if (!skips(leg, side.box)) compare(leg.segment, leg.number, side.segment, side.number);
  }
  Tally take() { return std::move(tally_); }

 private:
  bool beside(const Segment& one, const Box& others) const;
  void compare(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number);
  bool is_doubtful(double d, const Segment& s, const Segment& obstacle) const;
  void touch(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number);
  void forbid(std::size_t leg, std::size_t number) {
    tally_.violation = std::min(tally_.violation, LegContact{leg, number});
  }
  void narrow();

  const VerifyOptions& options_;
  double at_most_;
  double near_sq_ = 0.0;  ///< legs at this distance (squared) and above are left out
  Tally tally_;
};

/// What compare(range, comparison) finds in all chunks, each by any thread.
template <class Compare>
Tally tally_chunks(std::size_t count, std::size_t grain, const VerifyOptions& options, double at_most,
                   const Execution& execution, const Compare& compare) {
  const auto tally_of = [&](Range r) {
    Comparison comparison(options, at_most);
    compare(r, comparison);
    return comparison.take();
  };
  Tally all;
  for (const Tally& part : parts_of_chunks(count, grain, execution, tally_of)) all.join(part);
  return all;
}

/// The tally of all walls and of the sides of polygons and bounds; its box is that of walls and polygons. The same for
/// any number of threads.
Tally compare_obstacles(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs,
                        const VerifyOptions& options, const Execution& execution);

/// The tally of all walls and sides; its box is that of walls and polygons. The same for any number of threads.
Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution);

/// The first leg that can't be walked, with the lowest obstacle of the point where it fails. contacts: sorted, all
/// contacts of the legs before `leg_end`; none of these legs crosses an obstacle inside both. frame: the reference
/// point stays in it, and does not get between it and walls that lie on its sides (a maze's outline).
/// O(contacts log contacts).
std::optional<LegContact> first_forbidden_contact(std::span<const Vec2> path, std::size_t leg_end, const Box& frame,
                                                  const Obstacles& obstacles, std::span<const LegContact> contacts,
                                                  const Execution& execution);

}  // namespace warren
