// SPDX-License-Identifier: BSD-3-Clause
// The stages of an answer one by one, as lines: what each took, of how many items. Where planners draw samples, these
// are the links of the chain: samples, index, neighbours, checks, rows, components, reduction, queue, verified.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solve/answer/answer.hpp"

namespace warren {

/// One stage.
struct StageLine {
  std::string key;    ///< in JSON and CSV, with _cpu the key of its CPU time
  std::string label;  ///< for people
  double wall_s = 0.0;
  double cpu_s = 0.0;
  std::uint64_t count = 0;  ///< of items; 0: not known
  std::string counted;      ///< what they are, and what came of them
  /// CPU nanoseconds an item; 0: not known
  double ns_each() const { return count > 0 ? 1e9 * cpu_s / static_cast<double>(count) : 0.0; }
};

/// In the order of the work. None of an answer that nobody kept account of: one of a kept roadmap, say.
std::vector<StageLine> stage_lines(const Answer& answer);

/// The keys of stages_s: the promised sums, then what each stage has for itself, with _cpu its CPU time.
std::vector<std::pair<std::string, double>> keyed_seconds(const StageTimes& sums, const std::vector<StageCost>& costs);

}  // namespace warren
