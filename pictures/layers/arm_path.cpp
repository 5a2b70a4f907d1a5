// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/arm_path.hpp"

#include <algorithm>
#include <cmath>

namespace warren {
namespace {

double joint_distance(const JointState& a, const JointState& b) {
  double square = 0.0;
  for (std::size_t j = 0; j < most_joints; ++j) square += (b[j] - a[j]) * (b[j] - a[j]);
  return std::sqrt(square);
}

JointState between(const JointState& a, const JointState& b, double t) {
  JointState q;
  for (std::size_t j = 0; j < most_joints; ++j) q[j] = a[j] + t * (b[j] - a[j]);
  return q;
}

}  // namespace

ArmPath::ArmPath(const DhTable& table, std::span<const JointState> states)
    : chain_(table), links_(links_of(chain_)), states_(states), shares_{0.0} {
  for (std::size_t i = 1; i < states.size(); ++i) {
    shares_.push_back(shares_.back() + joint_distance(states[i - 1], states[i]));
  }
}

std::vector<Vec3> ArmPath::spine(const JointState& q) const {
  ChainPosture at;
  chain_.place(q, at);
  std::vector<Vec3> ends{at.points[links_.front().from]};
  for (const ArmLink& link : links_) ends.push_back(at.points[link.to]);
  return ends;
}

Vec3 ArmPath::tool(const JointState& q) const {
  ChainPosture at;
  chain_.place(q, at);
  return at.points[chain_.point_count() - 1];
}

JointState ArmPath::at(double moment) const {
  const double way = moment * length();
  std::size_t i = 1;
  while (i + 1 < states_.size() && shares_[i] < way) ++i;
  if (i >= states_.size() || !(shares_[i] > shares_[i - 1])) return states_.front();
  return between(states_[i - 1], states_[i],
                 std::clamp((way - shares_[i - 1]) / (shares_[i] - shares_[i - 1]), 0.0, 1.0));
}

std::vector<ArmPath::Place> ArmPath::places(double count, const Execution& execution) const {
  std::vector<Place> all{{0.0, states_.front()}};
  if (!(length() > 0.0)) return all;
  for (std::size_t i = 1; i < states_.size(); ++i) {
    execution.check();
    const double leg = shares_[i] - shares_[i - 1];
    const double parts = std::max(1.0, std::ceil(count * leg / length()));
    for (double part = 1.0; part <= parts; part += 1.0) {
      const double t = part / parts;
      all.push_back({(shares_[i - 1] + t * leg) / length(), between(states_[i - 1], states_[i], t)});
    }
  }
  return all;
}

}  // namespace warren
