// SPDX-License-Identifier: BSD-3-Clause
// One leg of a turning body against all sides of obstacles near it: the judge behind verify_se2, whose head tells the
// method.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/se2.hpp"
#include "parallel/execution.hpp"
#include "worlds/obstacles.hpp"
#include "worlds/path_surroundings.hpp"
#include "worlds/pose_runs.hpp"
#include "worlds/verify.hpp"

namespace warren {

struct LegReport {
  double least = std::numeric_limits<double>::infinity();  ///< proved
  double met = std::numeric_limits<double>::infinity();    ///< where it was looked: never less than the truth
  std::size_t looks = 0;                                   ///< how often a piece was halved
  std::optional<Violation> violation;
};

/// What may be near a leg: sides of obstacles.
using Sides = std::vector<NearSide>;

/// One body among the obstacles of a scene. Refers to all that it is given. Any number of threads may check.
class BodyVerifier {
 public:
  BodyVerifier(const Scene& scene, std::span<const Vec2> outline, double clearance, const Execution& execution);

  /// To be called before all else: with every leg that sides will be gathered for. Obstacles farther than `reach` from
  /// these legs are left out.
  void look_around(std::span<const Leg> legs, double reach);
  /// Does any reach that is larger find the same?
  bool looks_everywhere(std::span<const Se2> path) const;
  double least_reach() const { return 1.01 * clearance_ + radius_; }

  /// How far poses may lie beside the line that is checked in their place.
  double bend() const { return bend_; }

  /// All sides that may be near the leg or a part of it.
  void gather(const Leg& leg, Sides& sides) const { surroundings_.gather(boxes_of(leg), sides); }
  /// `number` is what a violation calls the leg.
  LegReport check(const Leg& leg, const Sides& sides, std::size_t number) const {
    return leg.turn == 0.0 ? check_straight(leg, sides, number) : check_turning(leg, sides, number);
  }
  /// Is the pose inside a polygon, outside the bounds, off the box or among a map's blocked cells? Boundaries are
  /// check()'s.
  LegReport check_pose(const Se2& pose, std::size_t number) const;

 private:
  struct Near {
    std::size_t side;  // of the leg's
    double distance;
  };
  std::vector<Box> boxes_of(const Leg& leg) const;
  LegReport check_straight(const Leg& leg, const Sides& sides, std::size_t number) const;
  LegReport check_turning(const Leg& leg, const Sides& sides, std::size_t number) const;
  double distance_to_sweep(const std::vector<Vec2>& corners, Vec2 way, const Segment& s) const;
  std::vector<Vec2> corners_at(const Leg& leg, double t) const;
  bool body_holds(const std::vector<Vec2>& corners, Vec2 p) const;
  double distance_to(const std::vector<Vec2>& corners, const Segment& s) const;
  /// The sides of `among` that may be the nearest to the body within `way` of the place t.
  std::vector<Near> nearest_at(const Leg& leg, double t, double way, const Sides& sides,
                               const std::vector<Near>& among) const;
  /// Checks the part of the leg that is `half` to both sides of `middle`.
  void check_piece(const Leg& leg, double middle, double half, const Sides& sides, const std::vector<Near>& among,
                   std::size_t number, LegReport& report) const;

  Obstacles obstacles_;
  PathSurroundings surroundings_;
  std::span<const Vec2> outline_;
  double clearance_;
  const Execution& execution_;
  std::optional<Box> confines_;
  const OccupancyMap* map_;  // nullptr: the scene is none
  std::vector<Box> ring_boxes_;
  double reach_ = 0.0;  // obstacles farther away are left out
  double radius_ = 0.0;
  double bend_ = 0.0;
  double rounding_ = 0.0;  // bounds the error of every distance computed here, a bend included
  double finest_ = 0.0;    // pieces on which the body goes less are not halved
  double close_ = 0.0;     // how sharp the least clearance shall be
};

}  // namespace warren
