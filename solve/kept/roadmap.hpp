// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as a value: the world and the body that it is for, how it was made, its states, its edges and what is known
// of each. Built without a question, asked as often as one likes (roadmap_query.hpp), written to a file and read back
// (roadmap_file_io.hpp). Plain data.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/run/execution.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/lengths/route_index.hpp"
#include "planners/roadmap/connection.hpp"
#include "solve/kept/lattice_roadmap.hpp"
#include "solve/kept/roadmap_file.hpp"
#include "solve/question/limits.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// A roadmap that outlives its question. Moved, not copied; any number of threads may read.
struct Roadmap {
  KeptWorld world;                                 ///< that it is of
  std::string world_hash;                          ///< scene_hash
  RobotSpec robot;                                 ///< whose motions its edges are
  double clearance = 0.0;                          ///< around the body, on all edges
  Prices prices = {};                              ///< of ways: nearness and areas, the file's among them
  SolveOptions options;                            ///< planner, sampler, seed and what else was asked for; no search
  std::uint64_t samples = 0;                       ///< drawn in the last round
  ConnectionRule rule;                             ///< by which milestones were joined, and start and goal will be
  IndexChoice index = IndexChoice::where_it_pays;  ///< as it was asked for
  RoadmapArrays arrays;                            ///< empty where there is a lattice
  std::unique_ptr<RoadmapFile> file = {};          ///< what the lattice looks at, where it was read
  std::unique_ptr<RouteIndex> lattice = {};        ///< instead of arrays

  /// The question that is still open: from where to where.
  Question question() const { return {.robot = robot, .clearance = clearance, .prices = prices}; }
};

/// How many edges are in which state; an edge that stands twice counts once.
struct EdgeCounts {
  std::uint64_t unchecked = 0;  ///< edges that nobody has asked about
  std::uint64_t free = 0;       ///< edges that nothing blocks
  std::uint64_t blocked = 0;    ///< edges that something blocks
};
/// Throws Stopped.
EdgeCounts count_edges(const Roadmap& roadmap, const Execution& execution);
/// States of the roadmap.
inline std::uint64_t count_states(const Roadmap& roadmap) {
  return roadmap.lattice != nullptr ? roadmap.lattice->passages().cell_count() : roadmap.arrays.parts().vertex_count();
}

/// Is the number of samples found by growing? A lattice has as many as its maze has cells.
bool grows(const SolveOptions& options, const Scene& scene, const RobotSpec& robot);

struct OldRoadmap;

/// Builds the roadmap of prm, lazy_prm, visibility, cells or voronoi for any world and body that these solve, but for
/// bodies at a fixed angle; start and goal of question and scene mean nothing. Where ways have a price, the roadmap
/// keeps it, and all questions weigh its edges by that. With lazy_prm no edge is checked, unless
/// the samples are left open: then, with either planner, rounds grow until what is joined stays joined
/// (planners/roadmap/build_roadmap.hpp). Takes the scene. Throws UsageError for what can't be built and for options
/// that mean nothing to it, InputError, Stopped at a limit.
Roadmap build(Scene scene, const Question& question = {}, const SolveOptions& options = {}, const Limits& limits = {},
              IndexChoice index = IndexChoice::where_it_pays);

/// Throws what build() throws before it works, for options that name a planner; an arm's files are read.
void check_buildable(const Scene& scene, const Question& question, const SolveOptions& options,
                     const Execution& execution = {});

/// The same under an execution. `old`: update's.
Roadmap build_within(Scene scene, const Question& question, const SolveOptions& options, const Execution& execution,
                     IndexChoice index = IndexChoice::where_it_pays, BuildAccount* account = nullptr,
                     const OldRoadmap* old = nullptr);

/// What update() did.
struct UpdateAccount {
  bool built_anew = false;           ///< the change is such that nothing could be taken over
  std::uint64_t edges = 0;           ///< of the new roadmap
  std::uint64_t edges_checked = 0;   ///< those that the world was asked about
  std::uint64_t states_added = 0;    ///< that the old roadmap had not
  std::uint64_t states_dropped = 0;  ///< that the new one has not
};

/// Takes the prices out of a world that the roadmap is asked in: its own count. Throws UsageError where the world has
/// others; its nearness counts for nothing where the roadmap has a price of that.
void let_prices_go(Scene& world, const Roadmap& roadmap);

/// The roadmap that build() makes of a changed world by the same options, bit for bit; motions that keep clear of what
/// has changed are not asked about again. What searches have learnt of a lazy roadmap is forgotten. Its prices are
/// those that it was built with (let_prices_go); of an arm of files counts what the changed world says. Takes the
/// scene. Throws as build().
Roadmap update(const Roadmap& roadmap, Scene now, const Execution& execution, UpdateAccount* account = nullptr);

// A maze's lattice says where its walls are in two bits a cell: whoever keeps the roadmap of a large one in memory may
// let the walls themselves go, eight bytes each. The judge then reads the bits by code of its own, which holds them
// against the world's hash first, as those of a file.

/// Of a roadmap that was just built. Nothing happens where it has no lattice, or where the walls are not, to the bit
/// and in the order, those that stand wherever the lattice has no passage. References to the scene mean nothing then.
/// Half a second for 10^8 cells. Throws Stopped.
void let_walls_go(Roadmap& roadmap, const Execution& execution);

}  // namespace warren
