// SPDX-License-Identifier: BSD-3-Clause
// Is an arm free all along a motion? Proved, for less than what samples cost: the motion is cut into eight pieces,
// whose middles are looked at side by side, in floats; most free motions need no more. What is open is cut again, at
// most four pieces into eight; where floats leave doubt, all is done again in doubles. After the study that tried it:
// free motions of a radian cost 1 to 2 us, others a third of that, kinematics 0.15 us.
//
// Why it is a proof, rounding included:
// (1) Let c be the centre of a ball that is fixed in a link, and all joints go evenly: c'' is the sum over pairs of
// joints of rate_k rate_j a_k x (a_j x (c - p_j)), k before j or j itself; no term is larger than the rates times how
// far c ever gets from the axis of j (ArmTables::reach); for a joint j that slides, times 1, and 0 where k does not
// turn. So |c''| <= A on the whole motion, one A a link.
// (2) On a piece of half the length h, c stays within A h^2 / 2 of its tangent in the middle.
// (3) An obstacle is what lies within some distance r' (a radius, the clearance) of a convex core. Let x be the core's
// point nearest to c in the middle of the piece, g = c - x, n = g / |g|. The core lies in n (y - x) <= 0. So c keeps
// |g| - |n v| h - A h^2 / 2 from it, with its velocity v there. A ball of radius r is free if that is more than r + r'.
// (4) Two balls: their difference in the frame of the last body that carries both. Only joints behind that one turn it;
// n v is the same in every frame, as n lies along the difference.
// (5) A link's hull is a ball around its balls; it moves with them. Obstacles and pairs that it is proved free of need
// no more. Obstacles whose upright box the hull's box, over all pieces, does not meet, are farther along an axis.
// (6) Links of other solids than balls are covered by balls. What these leave open, and obstacles that are hulls of
// points beyond their boxes, is asked of the convex bodies themselves (worlds/arms/convex_motion.hpp), lane by lane.
// (7) Middles and halves are sums of few powers of 2, hence exact: the pieces cover all of the motion.
// (8) Sines are wrong by largest_sine_error at most; the angle, by 2 to 3 roundings. From the base on, turn by turn,
// the frame's matrix gets wrong by these and 16 roundings, its origin by the parent's error times the offset; so
// ArmBuilder::take_slack adds them up. A frame or gap that is wrong is that of a point so far off; with twice that
// and 64 roundings of all sizes as `slack` the bounds hold for the true one, and wrong velocities cost way_slack.
// (9) Comparisons with NaN say no: not proved; what culls obstacles is no such comparison, but where the slack is below
// 1e30 all that it compares is a number. (10) A hit is a middle of a piece where balls inside of the solids meet
// by more than the slack, or convex bodies in doubles. It ends the search, whatever is looked at first; so verdicts
// don't depend on what was asked before, on threads, or on the instruction set, since all lanes round alike.
//
// tests/worlds/arms/arm_certificate_test.cpp attacks it; with a tenth of A the attack succeeds. Tried in the study:
// |v| h instead of |n v| h (2 to 10 times the cost), one A for all links (2 times), one obstacle after the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/instruction_set.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "worlds/arms/convex_motion.hpp"
#include "worlds/poses/certified_motion.hpp"

namespace warren {
namespace detail {
// What the certificate knows of an arm and of what stands around it, in floats and in doubles. Frames are turned so
// that every joint's axis is its frame's z. Slot 0 is the base, which does not move; slot i + 1 is joint i's. A link
// has balls: those that it consists of, or some that cover its solids.

/// What an obstacle's core is: all that is within `inflate` of it is blocked.
enum class ArmObstacleShape : std::uint8_t { point, segment, upright_box, box, cylinder };

template <class T>
struct ArmTables {
  struct Frame {
    std::array<T, 9> turn;  // columns, in the parent's frame
    std::array<T, 3> at;
  };
  struct Ball {
    T x, y, z;
    T outer;  // what the ball stands for lies within this of the centre,
    T inner;  // and holds all points within this; not above 0: none
  };
  struct Obstacle {
    T x, y, z;
    std::array<T, 9> axes;  // columns; of segments and cylinders the last one is the axis
    std::array<T, 3> half;  // of a box; of a cylinder x is the radius, z half the length; of a segment z
    T inflate;              // with the clearance in it
  };
  std::vector<Frame> frames;  // by slot
  std::vector<Ball> hulls;    // by link
  std::vector<Ball> balls;
  std::vector<Obstacle> obstacles;
  /// least x, y, z and greatest of the obstacles, inflated: six rows, each of obstacles padded to full lanes; nothing
  /// meets what pads
  std::array<std::vector<T>, 6> bounds;
  std::vector<T> reach;       // slot by slot: of each link, padded: how far from the slot's axis its centres get
  std::vector<T> pair_reach;  // the same of pairs: that of the one whose slot is moved; 0: both or none
  T clearance;
  T slack;      // for rounding: of any distance
  T way_slack;  // the same, a unit of speed and of time
};

/// How a slot's joint follows the state.
struct ArmDrive {
  std::size_t parent = 0;  // slot
  bool slides = false;
  std::size_t variable = 0;
  double multiplier = 0.0;
  double offset = 0.0;
  double low = 0.0;  // values, of a joint that slides
  double high = 0.0;
  double most_way = 0.0;    // of the value
  double most_value = 0.0;  // its size, of a joint that turns
  double most_reach = 0.0;  // largest of all links
};

struct ArmSetup {
  /// What the arm is among: obstacles in the base's frame, each keeping `clearance` >= 0 from every link, as the
  /// model's pairs of links do from each other; below `resolution` (> 0, metres that a point of the arm may go in a
  /// piece) a motion that is neither proved free nor blocked is refused. Copies what it needs. Throws Stopped.
  ArmSetup(const ArmModel& model, std::span<const Solid> obstacles, double clearance, double resolution,
           const Execution& execution = {});

  struct Link {
    std::uint32_t slot;
    std::uint32_t first_ball;
    std::uint32_t end_ball;
  };
  struct Pair {
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t common;  // slot
  };
  std::vector<ArmDrive> drives;  // by slot; the first one is no joint's
  std::vector<Link> links;       // those that move first
  std::size_t moving = 0;        // so many
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> solid_of_ball;
  std::vector<std::uint8_t> is_whole_ball;  // is the ball all of its solid?
  std::vector<ConvexBody> solids;
  std::vector<ArmObstacleShape> shapes;         // by obstacle
  std::vector<std::uint8_t> is_whole_obstacle;  // is the shape all of it?
  std::vector<ConvexBody> bodies;               // by obstacle
  std::size_t obstacle_lanes = 0;               // obstacles, padded to eights
  std::size_t link_lanes = 0;
  std::size_t pair_lanes = 0;
  double clearance;
  double resolution;
  bool always_touches = false;  // what never moves is not proved free
  bool always_meets = false;    // and does touch
  bool floats_hold = true;      // is all so small that products of squares are numbers, too?
  ArmTables<float> floats;
  ArmTables<double> doubles;
};

/// What ArmCertificate::motion() says, by the instruction set; of tests, with a bound of the acceleration that is so
/// much of the true one.
MotionVerdict judge_arm_motion(const ArmSetup& setup, std::span<const double> q, std::span<const double> way,
                               InstructionSet set, double bend_factor = 1.0);

}  // namespace detail

/// Immutable after construction; any number of threads may ask.
class ArmCertificate : private detail::ArmSetup {
 public:
  using detail::ArmSetup::ArmSetup;
  /// Every variable goes evenly from q to q + way, both ends included. A joint that slides out of its limits, and a way
  /// longer than its range (a continuous one's: more than a turn), are refused, as are angles beyond 1000 that are out
  /// of limits; other limits are the caller's business. Bounded: what takes some 20,000 looks is refused.
  /// 0.3 to 2 us for some ten links among some ten obstacles; equal on every machine and for any number of threads.
  MotionVerdict motion(std::span<const double> q, std::span<const double> way) const;
  /// A motion of no length: touching is not free.
  bool is_free(std::span<const double> q) const;
};

}  // namespace warren
