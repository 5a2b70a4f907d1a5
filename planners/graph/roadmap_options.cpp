// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/roadmap_options.hpp"

#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace warren {

void RoadmapOptions::validate() const {
  if (samples && (*samples < 1 || *samples > most_samples)) {
    throw InputError("samples", "must be from 1 to 2^31", std::to_string(*samples));
  }
  if (neighbours && (*neighbours < 1 || *neighbours > most_neighbours)) {
    throw InputError("neighbours", "must be from 1 to 4096", std::to_string(*neighbours));
  }
  if (radius && !(*radius > 0.0 && std::isfinite(*radius))) {
    throw InputError("radius", "must be a positive number", std::to_string(*radius));
  }
  if (attach) {
    const auto positive = [](const std::optional<double>& x) { return !x || (*x > 0.0 && std::isfinite(*x)); };
    if (!positive(attach->radius) || !positive(attach->step) || attach->tries < 1) {
      throw InputError("attach", "takes a positive radius and step, and one try or more");
    }
  }
  if (neighbours && radius) throw InputError("radius", "replaces the number of neighbours: give one of the two");
  if (star != StarRule::none && (neighbours || radius)) {
    throw InputError("neighbours", "follow from the samples by the rules of PRM*: give a number or the rule");
  }
  if (sampler == SamplerKind::lattice && (lattice.rows < 1 || lattice.cols < 1)) {
    throw InputError("lattice", "needs the rows and columns of the maze");
  }
}

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
