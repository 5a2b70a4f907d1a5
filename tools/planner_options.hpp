// SPDX-License-Identifier: BSD-3-Clause
// Which planner solves a world of walls, and with what: the options of `solve` resolved against the world. A planner
// refuses options that it would ignore.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planners/roadmap_options.hpp"
#include "tools/arguments.hpp"
#include "tools/command.hpp"
#include "worlds/scene.hpp"

namespace warren {

enum class PlannerKind : std::uint8_t { prm, lazy_prm };

std::string_view name_of(PlannerKind planner);
std::string_view name_of(SamplerKind sampler);
std::string_view name_of(SearchKind search);

/// --planner --sampler --samples --neighbours --radius --search --queue --lazy --optimise --seed
std::span<const OptionSpec> planner_option_specs();

struct PlannerOptions {
  PlannerKind planner = PlannerKind::prm;
  RoadmapOptions roadmap;
  bool optimise = false;  ///< pull the path taut after the search
  /// What the command line said beyond planner, sampler, search and seed: name and value as JSON.
  std::vector<std::pair<std::string, std::string>> given;
};

/// Checks values and contradictions that need no world; throws UsageError. Called before the world is read.
void check_planner_options(const Arguments& arguments);
/// Fills in the defaults that depend on the world; throws UsageError.
PlannerOptions planner_options(const Arguments& arguments, const Scene& scene);

}  // namespace warren
