// SPDX-License-Identifier: BSD-3-Clause
// An arm among spheres, boxes and other convex solids: joint limits, and links that keep off the solids and off each
// other. Between two states every variable goes evenly; a joint without end goes the shorter way around. Every motion
// is certified free as a whole (worlds/arms/arm_certificate.hpp).
//
// Variables that move no link are idle: samples keep them at rest, so that planning has as many dimensions as the
// problem.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "scenes/scene/arm_model.hpp"
#include "worlds/arms/arm_certificate.hpp"
#include "worlds/arms/arm_kinematics.hpp"
#include "worlds/poses/certified_motion.hpp"

namespace warren {

struct ArmOptions {
  double clearance = 0.0;                 ///< room around the links; finite, >= 0; 0: touching is blocked
  std::optional<double> resolution = {};  ///< motions that come so near may be refused; > 0; none: reach / 100,000
};

/// The scene's solids of every kind.
std::vector<Solid> solids_of(const Scene& scene, const Execution& execution);

/// Immutable after construction; one Query a thread.
class ArmWorld {
 public:
  static constexpr std::size_t dimension = most_joints;
  using State = JointState;
  using Embedding = std::array<double, most_joints + 2>;
  struct Query {
    std::uint64_t refused = 0;  ///< motions that were neither proved free nor blocked
  };

  /// Takes the scene's solids. Throws InputError for options out of range and an arm without any link, Stopped.
  ArmWorld(const Scene& scene, const ArmModel& model, const ArmOptions& options, const Execution& execution = {});

  Query make_query() const { return {}; }
  State at_unit(const std::array<double, dimension>& u) const;
  /// Within the limits, and clear of everything?
  bool is_free(const State& a, Query& query) const;
  bool is_free_motion(const State& a, const State& b, Query& query) const {
    return proved_free(judge_motion(a, b), query.refused);
  }
  /// Is b within the limits, and the motion free? That includes b.
  bool is_free_step(const State& a, const State& b, Query& query) const {
    return kinematics_.variable_outside_limits(b) == most_joints && is_free_motion(a, b, query);
  }
  /// The root of the sum of the variables' squared ways: radians, and metres of joints that slide.
  double distance(const State& a, const State& b) const;
  State interpolate(const State& a, const State& b, double t) const;
  /// A joint without end takes two numbers, sine and cosine, as long as there is room for them.
  Embedding embed(const State& a) const;

  MotionVerdict judge_motion(const State& a, const State& b) const;

  double suggested_samples(const Execution&) const { return 200.0; }
  std::uint64_t first_samples() const { return 25; }  ///< of a roadmap that is tried first
  /// Volume, in the metric, of the box of limits of the variables that move something, and how many these are.
  double sampled_volume() const;
  std::size_t sampled_dimension() const;
  /// Joints that there are.
  std::size_t unit_dimension() const { return ways_.size(); }
  const ArmModel& model() const { return kinematics_.model(); }
  const ArmKinematics& kinematics() const { return kinematics_; }
  double resolution() const { return resolution_; }

 private:
  bool is_sampled(std::size_t j) const { return kinematics_.moves(j) && ways_[j].low < ways_[j].high; }

  ArmKinematics kinematics_;
  std::vector<ArmVariable> ways_;  // the model's variables
  double resolution_;
  ArmCertificate certificate_;
};

static_assert(SteerableWorld<ArmWorld>);

/// The same way with the idle joints turning evenly along it: they move nothing, so it is as free, and no longer.
Path<JointState> with_even_idle_joints(const ArmWorld& world, Path<JointState> path);

}  // namespace warren
