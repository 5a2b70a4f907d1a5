// SPDX-License-Identifier: BSD-3-Clause
// An arm of revolute joints among spheres and boxes: capsules on its links, joint limits, and, if asked for, no link
// against another. Between two states every joint turns evenly; the whole motion is certified free
// (worlds/poses/certified_motion.hpp), link by link.
//
// A capsule is the set of balls around its spine; when the arm moves, take each ball to move without turning. So a
// point of the body travels as far as a point p of a spine, and that is at most the sum over the joints of
// |turn| x (distance of p from the joint's axis), integrated along the motion. The distance is known exactly at the
// middle of a piece, and it changes no faster than the joints behind that axis can move p against it: so for a piece
// that reaches the share s of the motion to both sides of its middle, p travels at most A s + B s^2 / 2, with
// A = sum_j |turn_j| distance_j(p) there and B = sum_j |turn_j| sum_(l>j) |turn_l| reach_l(p), nor more than C s with
// C = sum_j |turn_j| reach_j(p). All are convex in p, so the two ends of a spine bound it. Each link has its own bound:
// near the base little moves. Of two links only the joints between them count.
// Of a sphere only what comes nearer counts. If n is the direction from its centre to the nearest point of a spine,
// every end e of the spine keeps n (e - centre) >= d, its distance; at the share s from the middle that is still d - s
// |n v| - D s^2 / 2, with the velocity v of e there and D = sum_j sum_l |turn_j| |turn_l| reach_max(j,l)(e), which no
// acceleration exceeds. While that is more than the radii, a plane stays between sphere and capsule. Most pieces pass
// by this bound: turns that cancel out, and ways past a sphere, cost nothing. Joints that move no point (4 to 6 of a
// Puma without a tool) are idle: samples keep them at rest, so that planning has as many dimensions as the problem.
// Cost of a piece: forward kinematics, and a search of the obstacles for each link that was not proved free on a larger
// piece.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/arms/serial_chain.hpp"
#include "worlds/arms/solid_index.hpp"
#include "worlds/poses/certified_motion.hpp"

namespace warren {

struct ArmOptions {
  double radius = 0.05;                                 ///< of the links' capsules; finite, >= 0
  double clearance = 0.0;                               ///< room around them; finite, >= 0; 0: touching is blocked
  bool self_collision = false;                          ///< keep links apart that are no neighbours
  JointState weights = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};  ///< of the metric, a radian of each joint; > 0
  std::optional<double> resolution = {};  ///< motions that come so near may be refused; > 0; none: reach / 100,000
};

/// A capsule between two points of the chain that are fixed in one frame.
struct ArmLink {
  std::size_t from;  ///< points of the chain
  std::size_t to;
  std::size_t joints;  ///< so many joints, from the base, move it
};

/// The capsules of a chain: between its consecutive points, where these are apart.
std::vector<ArmLink> links_of(const SerialChain& chain);

/// Immutable after construction; one Query a thread.
class ArmWorld {
 public:
  static constexpr std::size_t dimension = most_joints;
  using State = JointState;
  struct Query {
    std::uint64_t refused = 0;  ///< motions that were neither proved free nor blocked
  };

  /// Takes the scene's spheres and boxes. Throws InputError for options out of range and an arm without any link,
  /// Stopped.
  ArmWorld(const Scene& scene, const SerialChain& chain, const ArmOptions& options, const Execution& execution = {});

  Query make_query() const { return {}; }
  State at_unit(const std::array<double, dimension>& u) const;
  /// Within the limits, and clear of everything?
  bool is_free(const State& a, Query& query) const;
  bool is_free_motion(const State& a, const State& b, Query& query) const;
  double distance(const State& a, const State& b) const;
  State interpolate(const State& a, const State& b, double t) const;
  std::array<double, dimension> embed(const State& a) const;

  /// Lower bound of the distance of the capsules to obstacles (and to each other) less the clearance; <= 0: not free.
  /// More than `enough` counts as any number above it.
  double clearance(const State& a, double enough) const;
  /// Upper bound of the way of any point of the body.
  double travel(const State& a, const State& b) const;
  MotionVerdict judge_motion(const State& a, const State& b) const;

  double suggested_samples(const Execution&) const { return 200.0; }
  std::uint64_t first_samples() const { return 25; }  ///< of a roadmap that is tried first
  /// Volume, in the metric, of the box of limits of the joints that are not idle, and how many these are.
  double sampled_volume() const;
  std::size_t sampled_dimension() const;
  const SerialChain& chain() const { return chain_; }
  const std::vector<ArmLink>& links() const { return links_; }
  double radius() const { return radius_; }
  double resolution() const { return resolution_; }

 private:
  /// Two links that are no neighbours.
  struct LinkPair {
    std::size_t near;
    std::size_t far;
  };
  /// A motion's turns, and what they say of each point: C, B and D of the head comment.
  struct Turns {
    JointState signed_turn;
    JointState turn;
    std::array<double, most_points> most;
    std::array<double, most_points> bend;
    std::array<double, most_points> acceleration;
  };
  void find_pairs();
  Turns turns_between(const State& a, const State& b) const;
  double travel_of(const ChainPosture& at, const Turns& turns, std::size_t point, std::size_t first, std::size_t last,
                   double share) const;
  double travel_of_link(const ChainPosture& at, const Turns& turns, const ArmLink& link, std::size_t first,
                        double share) const;
  Vec3 velocity_of(const ChainPosture& at, const Turns& turns, std::size_t point, std::size_t joints) const;
  /// What a link's ends do on a piece of a motion, taken once for all obstacles.
  struct LinkMove {
    double travel;                 ///< of any of its points
    std::array<Vec3, 2> velocity;  ///< of its ends, the piece to either side in a unit of time
    std::array<double, 2> bend;    ///< how far from there an end may be after that
  };
  LinkMove move_of(const ChainPosture& at, const Turns& turns, const ArmLink& link, double share) const;
  double part_off(const ChainPosture& at, const ArmLink& link, const LinkMove& move, const Approach& near) const;
  double clear_part(const ChainPosture& at, const Turns& turns, const ArmLink& link, double share) const;
  double clear_part(const ChainPosture& at, const Turns& turns, const LinkPair& pair, double share) const;
  double clear_part(const ChainPosture& at, const Turns& turns, double share, std::uint32_t& parts) const;
  std::uint32_t all_parts() const { return (std::uint32_t{1} << (links_.size() + pairs_.size())) - 1; }
  double resolution_share(const Turns& turns) const;

  SerialChain chain_;
  SolidIndex solids_;
  std::vector<ArmLink> links_;
  std::vector<LinkPair> pairs_;
  JointState weights_;
  double radius_;
  double touch_;  // from spine to obstacle: radius, clearance and rounding
  double touch_links_;
  double resolution_;
};

static_assert(SteerableWorld<ArmWorld>);

/// The same way with the idle joints turning evenly along it: they move nothing, so it is as free, and no longer.
Path<JointState> with_even_idle_joints(const ArmWorld& world, Path<JointState> path);

}  // namespace warren
