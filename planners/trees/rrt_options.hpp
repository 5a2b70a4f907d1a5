// SPDX-License-Identifier: BSD-3-Clause
// How trees are grown: the options that rrt and rrt_connect share, as plain aggregates.
#pragma once

#include <cstdint>
#include <optional>

#include "planners/graph/roadmap_options.hpp"

namespace warren {

inline constexpr std::uint32_t most_trees = 4096;  ///< at once

/// validate() refuses values outside the stated ranges with InputError.
struct RrtOptions {
  /// Not lattice. None: uniform at first; a search that takes longer has narrow passages, so from then on every other
  /// sample is a gaussian one, near the obstacles.
  std::optional<SamplerKind> sampler = {};
  /// rrt_connect, where no sampler is asked for: first the way over the places that are free at one heading
  /// (planners/trees/rrt_connect.hpp). Off for ways that differ from seed to seed.
  bool places = true;
  std::optional<double> step = {};  ///< longest motion of a tree, in the world's metric, > 0; none: by world
  /// rrt_connect: a vertex that a motion from has failed is grown towards samples within so many steps alone, for of
  /// those farther away obstacles near to it take the most (dynamic domain: Yershova, Jaillet, Simeon, LaValle, ICRA
  /// 2005); a tree of less than half the other's states goes on; and from the 200th motion on a state is followed by
  /// one more towards its sample. >= 1; none: towards any sample, in turns, a state at once.
  std::optional<double> domain = {};
  /// rrt_connect of arms: a motion towards a sample moves so many joints on average, others each time, for one of all
  /// joints of a long arm is seldom free. > 0; none: all.
  std::optional<double> moving = {};
  double goal_bias = 0.05;  ///< share of the samples that are the goal, 0 .. 1; only for rrt
  /// A tree of so many gives up (rrt_connect: start's and goal's together), and after 64 times as many samples.
  std::uint64_t nodes = 100'000;  ///< 2 .. 2^31
  std::uint32_t trees = 1;        ///< grown independently at once, 1 .. 4096; the first to arrive answers
  std::uint64_t seed = 1;         ///< any value

  void validate() const;
  /// Of a tree's index-th sample.
  SamplerKind sampler_of(std::uint64_t index) const {
    constexpr std::uint64_t first_gaussian = 512;
    const bool near = index >= first_gaussian && index % 2 != 0;
    return sampler.value_or(near ? SamplerKind::gaussian : SamplerKind::uniform);
  }
};

}  // namespace warren
