// SPDX-License-Identifier: BSD-3-Clause
// An arm along a path in joint space: what its pictures ask.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "parallel/execution.hpp"
#include "scenes/scene/dh_table.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {

/// Refers to the path, which has at least one state.
class ArmPath {
 public:
  ArmPath(const DhTable& table, std::span<const JointState> states);

  std::span<const JointState> states() const { return states_; }
  /// In joint space.
  double length() const { return shares_.back(); }
  /// The ends of the links, from the base.
  std::vector<Vec3> spine(const JointState& q) const;
  Vec3 tool(const JointState& q) const;

  /// Where it is when that share of the length is behind, 0 .. 1.
  JointState at(double moment) const;

  struct Place {
    double moment;  ///< the share of the length that is behind, 0 .. 1
    JointState q;
  };
  /// All states, and more between them so that there are about `count` evenly along the path. Throws Stopped.
  std::vector<Place> places(double count, const Execution& execution) const;

 private:
  SerialChain chain_;
  std::vector<ArmLink> links_;
  std::span<const JointState> states_;
  std::vector<double> shares_;  // of each state: the length up to it
};

}  // namespace warren
