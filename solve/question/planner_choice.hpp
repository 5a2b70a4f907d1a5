// SPDX-License-Identifier: BSD-3-Clause
// The names of all planners, and how those that build roadmaps of samples are told what to do: the options of prm and
// lazy-prm resolved against the world. A planner refuses options that it would ignore.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planners/roadmap/roadmap_options.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren {

/// All that the formats name; which of them this version has, and for what, kind_of_problem.hpp tells.
enum class PlannerKind : std::uint8_t { prm, lazy_prm, visibility, cells, voronoi, rrt, rrt_connect, grid };
inline constexpr PlannerKind all_planners[] = {PlannerKind::prm,         PlannerKind::lazy_prm, PlannerKind::visibility,
                                               PlannerKind::cells,       PlannerKind::voronoi,  PlannerKind::rrt,
                                               PlannerKind::rrt_connect, PlannerKind::grid};
constexpr bool is_roadmap_planner(PlannerKind planner) {
  return planner == PlannerKind::prm || planner == PlannerKind::lazy_prm;
}

/// How prm works: stage by stage over the whole world, or tile by tile with all stages of a tile in cache.
enum class PipelineKind : std::uint8_t { plain, tiled };

std::string_view name_of(PlannerKind planner);
std::string_view name_of(PipelineKind pipeline);
std::string_view name_of(SamplerKind sampler);
std::string_view name_of(SearchKind search);

/// The planner that --planner names; throws UsageError for a word that is none.
std::optional<PlannerKind> planner_asked(const Arguments& arguments);

/// The sampler that --sampler names; throws UsageError for a word that is none.
std::optional<SamplerKind> sampler_asked(const Arguments& arguments);

/// --seed; 1 where nothing is said. Throws UsageError.
std::uint64_t seed_of(const Arguments& arguments);

/// --planner --sampler --samples --neighbours --radius --search --queue --lazy --pipeline --optimise --seed
std::span<const OptionSpec> planner_option_specs();

/// How any graph is searched.
struct SearchChoice {
  SearchKind search = SearchKind::astar;
  QueueKind queue = QueueKind::heap;
  std::uint64_t seed = 1;
};
/// --search --queue --seed; throws UsageError for words that are none, and a queue that the search has no use for.
SearchChoice search_choice(const Arguments& arguments);

struct PlannerOptions {
  PlannerKind planner = PlannerKind::prm;
  RoadmapOptions roadmap;
  PipelineKind pipeline = PipelineKind::plain;  ///< only for prm
  bool fused = false;                           ///< tiled by tiled_prm, which knows the lattice; else by prm_in_tiles
  bool optimise = false;                        ///< pull the path taut after the search
  /// What the command line said beyond planner, sampler, search and seed: name and value as JSON.
  std::vector<std::pair<std::string, std::string>> given;
};

/// Checks values and contradictions that need no world; throws UsageError, also for planners that build no roadmap of
/// samples. Called before the world is read.
void check_planner_options(const Arguments& arguments);
/// prm where the sampler is the lattice, else lazy-prm.
PlannerKind usual_roadmap_planner(const Arguments& arguments, const Scene& scene);
/// Fills in the defaults that depend on the world; throws UsageError.
PlannerOptions planner_options(const Arguments& arguments, const Scene& scene, const WallProblem& problem);

}  // namespace warren
