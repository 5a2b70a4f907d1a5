// SPDX-License-Identifier: BSD-3-Clause
// One leg of a body that moves in the plane against all sides of obstacles near it: the judge behind verify_se2, whose
// head tells the method for bodies that turn while they go straight, and behind verify_car, whose head tells that of
// arcs. Both rest on this: a body that is apart from an obstacle where a leg begins, neither inside of the other, and
// whose outline does not meet the obstacle's on the leg, stays apart.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/near/sides_near_legs.hpp"
#include "verify/near/straight_runs.hpp"

namespace warren {

/// What may be near a leg: sides of obstacles.
using Sides = std::vector<NearSide>;

/// One body among the obstacles of a scene. Refers to all that it is given. Any number of threads may check.
class BodyVerifier {
 public:
  /// outline: of a disc its middle alone, and then `clearance` includes its radius. poses_off: how far poses may stand
  /// off the box of the obstacles, where nothing else confines them.
  BodyVerifier(const Scene& scene, std::span<const Vec2> outline, double clearance, double poses_off,
               const Execution& execution, const ObstacleIndex* index);

  /// What all legs come to. settle(i) says of the i-th what needs no obstacle near it; where that is a violation, the
  /// leg is looked at no more: it may go anywhere. Of the others report_of(i, sides) says the rest, with scratch for
  /// the sides, once or several times: at first with the obstacles up to `reach` away, then with ever more until the
  /// least distance is known.
  template <class Settle, class ReportOf>
  LegReport check_all(std::span<const Leg> legs, std::span<const Se2> path, double reach, const Settle& settle,
                      const ReportOf& report_of) {
    constexpr double widening = 8.0;
    constexpr std::size_t legs_a_chunk = 16;
    execution_.reserve(legs.size());
    std::vector<std::uint8_t> settled(legs.size());
    const LegReport at_once = report_legs(legs.size(), legs_a_chunk, execution_.quiet(), [&](Range r) {
      LegReport part;
      for (std::size_t i = r.first; i < r.last; ++i) {
        const LegReport leg = settle(i);
        settled[i] = leg.violation ? 1 : 0;
        part.add(leg);
      }
      return part;
    });
    for (;; reach *= widening) {
      look_around(legs, settled, reach);
      LegReport whole = at_once;
      whole.add(report_legs(legs.size(), legs_a_chunk, execution_, [&](Range r) {
        Sides scratch;
        LegReport part;
        for (std::size_t i = r.first; i < r.last; ++i) {
          if (settled[i] == 0) part.add(report_of(i, scratch));
        }
        return part;
      }));
      if (whole.least <= reach || looks_everywhere(path)) return whole;
    }
  }
  double least_reach() const { return 1.01 * clearance_ + radius_; }

  /// How far poses may lie beside the line that is checked in their place.
  double bend() const { return bend_; }

  /// All sides that may be near the leg or a part of it.
  void gather(const Leg& leg, Sides& sides) const { surroundings_.gather(boxes_of(leg), sides, execution_); }
  /// `number` is what a violation calls the leg.
  LegReport check(const Leg& leg, const Sides& sides, std::size_t number) const {
    if (leg.turn == 0.0) return check_straight(leg, sides, number);
    return leg.is_arc ? check_arc(leg, sides, number) : check_turning(leg, sides, number);
  }
  /// Is the pose inside a polygon, outside the bounds, off the box or among a map's blocked cells? Boundaries are
  /// check()'s.
  LegReport check_pose(const Se2& pose, std::size_t number) const;

 private:
  struct Near {
    std::size_t side;  // of the leg's
    double distance;
  };
  /// Obstacles farther than `reach` from these legs, but for the settled ones, are left out from now on.
  void look_around(std::span<const Leg> legs, std::span<const std::uint8_t> settled, double reach);
  /// Does any reach that is larger find the same?
  bool looks_everywhere(std::span<const Se2> path) const;
  std::vector<Box> boxes_of(const Leg& leg) const;
  LegReport check_straight(const Leg& leg, const Sides& sides, std::size_t number) const;
  LegReport check_turning(const Leg& leg, const Sides& sides, std::size_t number) const;
  LegReport check_arc(const Leg& leg, const Sides& sides, std::size_t number) const;
  /// Notes a distance, which is known but for `rounding`, if it is the least.
  void note(double distance, double rounding, const NearSide& side, std::size_t number, LegReport& report) const;
  bool leaves_box(const Arc& way) const;
  std::vector<Vec2> corners_at(const Leg& leg, double t) const;
  /// The sides of `among` that may be the nearest to the body within `way` of the place t.
  std::vector<Near> nearest_at(const Leg& leg, double t, double way, const Sides& sides,
                               const std::vector<Near>& among) const;
  /// Checks the part of the leg that is `half` to both sides of `middle`.
  void check_piece(const Leg& leg, double middle, double half, const Sides& sides, const std::vector<Near>& among,
                   std::size_t number, LegReport& report) const;

  const ObstacleIndex* index_;  // nullptr: all obstacles are passed over
  std::optional<Obstacles> own_obstacles_;
  const Obstacles& obstacles_;
  PathSurroundings surroundings_;
  std::span<const Vec2> outline_;
  double clearance_;
  double poses_off_;
  const Execution& execution_;
  std::optional<Box> confines_;
  const OccupancyMap* map_;  // nullptr: the scene is none
  double reach_ = 0.0;       // obstacles farther away are left out
  double radius_ = 0.0;
  double bend_ = 0.0;
  double rounding_ = 0.0;  // bounds the error of every distance computed here, a bend included
  double finest_ = 0.0;    // pieces on which the body goes less are not halved
  double close_ = 0.0;     // how sharp the least clearance shall be
};

}  // namespace warren
