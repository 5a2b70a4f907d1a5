// SPDX-License-Identifier: BSD-3-Clause
#include "planners/trees/rrt_options.hpp"

#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace warren {

void RrtOptions::validate() const {
  if (sampler == SamplerKind::lattice) throw InputError("sampler", "lattice is for roadmaps of mazes, not for trees");
  if (step && !(*step > 0.0 && std::isfinite(*step))) {
    throw InputError("step", "must be a positive number", std::to_string(*step));
  }
  if (domain && !(*domain >= 1.0 && std::isfinite(*domain))) {
    throw InputError("domain", "must be a number from 1 on", std::to_string(*domain));
  }
  if (moving && !(*moving > 0.0)) throw InputError("moving", "must be a number above 0", std::to_string(*moving));
  if (!(goal_bias >= 0.0 && goal_bias <= 1.0)) {
    throw InputError("goal bias", "must be from 0 to 1", std::to_string(goal_bias));
  }
  if (nodes < 2 || nodes > most_samples) {
    throw InputError("nodes", "must be from 2 to 2^31", std::to_string(nodes));
  }
  if (trees < 1 || trees > most_trees) throw InputError("trees", "must be from 1 to 4096", std::to_string(trees));
}

}  // namespace warren
