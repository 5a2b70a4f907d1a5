// SPDX-License-Identifier: BSD-3-Clause
// What was done: exact counts, the same for any number of threads, and how long each stage took.
#pragma once

#include <cstdint>

namespace warren {

struct Counters {
  std::uint64_t samples = 0;  ///< states drawn
  std::uint64_t kept = 0;     ///< of samples, the states that became milestones: free, and as the sampler wants
  std::uint64_t neighbour_queries = 0;  ///< k-nearest or radius queries
  std::uint64_t edges_checked = 0;      ///< motions tested for collision
  std::uint64_t edges_free = 0;         ///< of edges_checked, those that nothing blocks
  std::uint64_t expanded = 0;           ///< vertices settled by the search
  std::uint64_t rounds = 0;             ///< roadmaps built, lazy repairs or batches of trees made
  std::uint64_t refused = 0;            ///< motions that were neither proved free nor blocked, of edges_checked
  Counters& operator+=(const Counters& o) {
    samples += o.samples;
    kept += o.kept;
    neighbour_queries += o.neighbour_queries;
    edges_checked += o.edges_checked;
    edges_free += o.edges_free;
    expanded += o.expanded;
    rounds += o.rounds;
    refused += o.refused;
    return *this;
  }
  friend bool operator==(const Counters&, const Counters&) = default;
};

/// Wall-clock seconds of each stage.
struct StageTimes {
  double generate = 0.0;
  double read = 0.0;
  double index = 0.0;
  double sample = 0.0;
  double neighbours = 0.0;
  double connect = 0.0;
  double graph = 0.0;
  double reduce = 0.0;
  double search = 0.0;
  double optimise = 0.0;
  double verify = 0.0;
};

}  // namespace warren
