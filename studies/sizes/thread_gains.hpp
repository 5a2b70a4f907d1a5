// SPDX-License-Identifier: BSD-3-Clause
// What more threads gain, run against run: each run is held against the one of fewest threads of the same repeat, and
// beside it stands what arithmetic in registers gained in the same moment (studies/measure/arithmetic_probe.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studies/sizes/scaling_study.hpp"

namespace warren::studies {

/// Medians over the pairs of one size, planner, sampler, pipeline and number of threads. Gains are times, scaled so
/// that the fewest threads gain their own number.
struct ThreadGain {
  MazeTrial first;          ///< of the pairs' runs with more threads
  std::size_t pairs = 0;    ///< >= 1
  double gain = 0.0;        ///< of solve_s
  double arithmetic = 0.0;  ///< the machine's own
  /// Pairs in which arithmetic gained as many times as there are threads, or cores, if these are fewer; within 5 %.
  std::size_t quiet_pairs = 0;
  std::optional<double> quiet_gain = {};                          ///< their median
  std::vector<std::pair<std::string, double>> quiet_stages = {};  ///< the same of each stage of at least 0.2 ms
};

/// In the order in which they first ran; solved runs only. cores: those of the machine.
std::vector<ThreadGain> thread_gains(const ScalingResult& result, unsigned cores);

/// "1000 x 1000, prm, tiled, lattice sampler, 2 threads: 1.85 times in the median of 15 pairs, arithmetic alone 1.97;
/// ..."
std::string text_of(const ThreadGain& gain);

}  // namespace warren::studies
