// SPDX-License-Identifier: BSD-3-Clause
// What the certificate of arms (worlds/arms/arm_certificate.hpp) knows of an arm and of what stands around it, in
// floats and in doubles. Frames are turned so that every joint's axis is its frame's z. Slot 0 is the base, which does
// not move; slot i + 1 is joint i's. A link has balls: those that it consists of, or some that cover its solids.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "worlds/arms/convex_motion.hpp"

namespace warren::detail {

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
  ArmSetup(const ArmModel& model, std::span<const Solid> obstacles, double clearance, double resolution,
           const Execution& execution);

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

}  // namespace warren::detail
