// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/touching_pairs.hpp"

#include <algorithm>
#include <vector>

#include "core/base/rng.hpp"
#include "worlds/arms/arm_kinematics.hpp"

namespace warren {

void leave_out_touching(ArmModel& model, const Execution& execution) {
  constexpr std::uint64_t states = 1000;
  const ArmKinematics arm(model);
  std::erase_if(model.pairs, [&](const LinkPair& pair) {
    return arm.joints_between(model.links[pair[0]].frame, model.links[pair[1]].frame) == 0;
  });
  std::vector<std::vector<ConvexBody>> bodies(model.links.size());
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    for (const Solid& solid : model.links[link].solids) bodies[link].emplace_back(solid);
  }
  ArmPosture posture;
  const auto touch = [&](const LinkPair& pair) {
    execution.check();
    const MovingFrame& at_a = ArmKinematics::frame(posture, model.links[pair[0]].frame);
    const MovingFrame& at_b = ArmKinematics::frame(posture, model.links[pair[1]].frame);
    for (const ConvexBody& a : bodies[pair[0]]) {
      for (const ConvexBody& b : bodies[pair[1]]) {
        if (keep_apart(a, at_a, b, at_b, 0.0, 0.0) != Apart::proved) return true;
      }
    }
    return false;
  };
  std::vector<LinkPair> suspects = model.pairs;
  for (std::uint64_t state = 0; state < states && !suspects.empty(); ++state) {
    JointState q{};
    for (std::size_t i = 0; i < arm.size(); ++i) {
      const ArmVariable& variable = model.variables[i];
      q[i] = variable.low + uniform(1, state, i) * (variable.high - variable.low);
    }
    arm.place(q, posture);
    std::erase_if(suspects, [&](const LinkPair& pair) { return !touch(pair); });
  }
  for (const LinkPair& pair : suspects) {
    std::erase(model.pairs, pair);
    model.assumed.push_back(model.links[pair[0]].name + " and " + model.links[pair[1]].name +
                            " touch in every posture that was tried: not checked against each other");
  }
}

}  // namespace warren
