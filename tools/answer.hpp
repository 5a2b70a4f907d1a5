// SPDX-License-Identifier: BSD-3-Clause
// The account of one solve: the answer, what it means, and what it took. Plain data; answer_json.hpp writes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/solution.hpp"
#include "parallel/deadline.hpp"
#include "tools/problem.hpp"

namespace warren {

/// Which world was solved.
struct WorldAccount {
  std::string source;  ///< as the command line gave it
  std::string kind;    ///< "maze" where the scene has the hint, else "walls"
  std::uint64_t walls = 0;
  std::string hash;
};

struct Answer {
  Outcome outcome = Outcome::stopped;
  std::optional<StopReason> stop_reason;  ///< only for stopped
  bool verified = false;
  double length = 0.0;         ///< only where verified
  double min_clearance = 0.0;  ///< room around the body along the path; only where verified
  std::optional<double> raw_length;
  WallProblem problem;
  WorldAccount world;
  std::string planner;
  std::string pipeline;  ///< plain or tiled; only for prm
  std::string sampler;
  std::string search;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::vector<std::pair<std::string, std::string>> options;  ///< name, value as JSON
  RoadmapSize roadmap;
  Separation separation;  ///< only for not_connected
  Counters counters;
  StageTimes seconds;
  double solve_s = 0.0;
  std::size_t peak_memory_bytes = 0;
  std::vector<Vec2> path;
};

/// Stages with the names that JSON and summary give them, in the order of the work.
std::vector<std::pair<const char*, double>> named_stages(const StageTimes& seconds);

}  // namespace warren
