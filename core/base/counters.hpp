// SPDX-License-Identifier: BSD-3-Clause
// What was done: exact counts, the same for any number of threads, and how long each stage took.
#pragma once

#include <cstdint>
#include <string>

namespace warren {

/// What a planner has done: exact, the same for any number of threads.
struct Counters {
  std::uint64_t samples = 0;  ///< states drawn
  std::uint64_t kept = 0;     ///< of samples, the states that became milestones: free, and as the sampler wants
  std::uint64_t neighbour_queries = 0;  ///< k-nearest or radius queries
  std::uint64_t edges_checked = 0;      ///< motions tested for collision
  std::uint64_t edges_free = 0;         ///< of edges_checked, those that nothing blocks
  std::uint64_t expanded = 0;           ///< vertices settled by the search
  std::uint64_t rounds = 0;             ///< roadmaps built, lazy repairs or batches of trees made
  std::uint64_t refused = 0;            ///< motions that were neither proved free nor blocked, of edges_checked
  std::uint64_t pushes = 0;     ///< vertices that came into the search's queue; of planners that join samples alone
  std::uint64_t decreases = 0;  ///< times that one in the queue got a shorter way; the same
  std::uint64_t row_bytes = 0;  ///< of the CSR rows that were assembled; the same
  /// Adds all of them.
  Counters& operator+=(const Counters& o) {
    samples += o.samples;
    kept += o.kept;
    neighbour_queries += o.neighbour_queries;
    edges_checked += o.edges_checked;
    edges_free += o.edges_free;
    expanded += o.expanded;
    rounds += o.rounds;
    refused += o.refused;
    pushes += o.pushes;
    decreases += o.decreases;
    row_bytes += o.row_bytes;
    return *this;
  }
  friend bool operator==(const Counters&, const Counters&) = default;
};

/// Wall-clock seconds of each stage.
struct StageTimes {
  double generate = 0.0;    ///< making a maze
  double read = 0.0;        ///< reading a file
  double index = 0.0;       ///< indexes over obstacles and free cells
  double sample = 0.0;      ///< drawing states
  double neighbours = 0.0;  ///< finding each state's neighbours
  double connect = 0.0;     ///< checking motions
  double graph = 0.0;       ///< joining edges to a graph, or cells to a decomposition
  double reduce = 0.0;      ///< taking what no path needs out of a lattice's graph
  double search = 0.0;      ///< searching; of trees, growing them
  double optimise = 0.0;    ///< pulling the path taut
  double verify = 0.0;      ///< judging the path
};

/// What a stage cost in all its rounds. Where one stage has several links of a chain, each has its own.
struct StageCost {
  std::string name;     ///< of the link
  double wall_s = 0.0;  ///< by the clock
  double cpu_s = 0.0;   ///< of all threads of the process
};

}  // namespace warren
