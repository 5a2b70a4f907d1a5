// SPDX-License-Identifier: BSD-3-Clause
// A string pulled taut around wall ends, each widened to a disc of one radius: the locally shortest path of the
// string's homotopy class, which is the only one. It is a list of stops, joined by tangents: the two ends, discs with
// the side on which they are passed, and in between points of the raw path that are still to be pulled away.
//
// One sweep with two stacks. A stop that is a point, or a disc around which the string would bend backwards, is let go:
// the string falls from the bend a-b-c onto the convex chain around the wall ends inside the bend (gift wrapping over
// the ends that the wall index finds there), and the stop before is looked at again. Where the string would turn about
// a disc further than it lies on it, it falls in two parts: until it comes off that disc, and on from the stop before.
// Each release shortens the string.
// A wall that reaches into the bend has an end in it, since it crosses neither leg; so its ends are all that counts.
// How often a disc is wound around is kept: a string that circles a pillar goes on circling it.
//
// Cost: one release a raw point and a few more where stops are let go again, each the walls in the bend's triangle
// (large triangles are searched part by part). Exact but for rounding; the caller checks the result.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// How far walls stand apart, roughly: the square root of the area a wall; > 0.
double wall_spacing(const WallIndex& walls);

class TautString {
 public:
  /// A place where the string may bend.
  struct Stop {
    Vec2 center;
    double turn = 0.0;  ///< +1: a disc on the left, passed anticlockwise; -1: on the right; 0: a point
    double arc = 0.0;   ///< radians of the disc that the string lies on
  };
  /// A straight stretch between two stops.
  struct Tangent {
    Vec2 from, to;
    Vec2 direction;  ///< of length 1, or 0 where the stops are one point
  };

  /// Refers to the walls. radius > 0: of the discs. least <= radius: the distance that the points' legs are sure to
  /// keep from the walls. Stops are counted from `origin`, near the points, so that large coordinates cost no digits.
  TautString(const WallIndex& walls, double radius, double least, Vec2 origin);

  /// The stops of the string that was laid along `points` (at least two, consecutive ones different): the first and the
  /// last are points; where the work is given up (only if rounding made it go in circles), more are.
  std::vector<Stop> pull(std::span<const Vec2> points, const Execution& execution);

  Tangent tangent(const Stop& a, const Stop& b) const;

 private:
  struct Bend {
    Tangent in, out;
    double turn;  ///< radians from the one to the other, in (-pi, pi]
  };

  /// What is being let go: the string a-b-c, and the stop that it may fall on next.
  struct Fall {
    Stop a, c;
    Bend bend;
    Tangent direct;  ///< from a to c
    double side;     ///< of the bend: +1 to the left
  };

  Bend bend(const Stop& a, const Stop& b, const Stop& c) const;
  bool is_taut(Stop& b, const Bend& bend) const;
  double fallen_when_free(const Stop& a, const Bend& bend, Vec2 at) const;
  void release(const Bend& bend);
  void fall(const Bend& bend, Vec2 at);
  Vec2 corner(const Stop& b, const Bend& bend) const;
  void gather(const Vec2 (&triangle)[3], const Fall& fall, int depth);
  bool is_inside(Vec2 end, const Fall& fall) const;
  bool leaves_within(const Stop& from, Vec2 end, Vec2 first, Vec2 last, double side) const;
  bool arrives_within(Vec2 end, const Stop& to, Vec2 first, Vec2 last, double side) const;
  bool obstructs(Vec2 end, const Stop& from, const Tangent& tangent, double side) const;
  bool obstructs_last(Vec2 end, const Stop& from, const Stop& c, const Tangent& tangent, double side) const;
  void wrap(const Fall& fall);

  const WallIndex& walls_;
  double radius_;
  double least_;
  Vec2 origin_;
  double search_size_;       // triangles wider than this are halved: a few walls
  std::vector<Stop> left_;   // settled, up to the stop before the one looked at
  std::vector<Stop> right_;  // still to come, the next one last
  std::vector<Vec2> ends_;   // wall ends inside the bend
  std::vector<Stop> chain_;
};

}  // namespace warren
