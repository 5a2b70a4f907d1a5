// SPDX-License-Identifier: BSD-3-Clause
// What became of the work of a solve beyond what its answer tells anyhow: which stage lost what, where it is narrow,
// and what would likely help. Plain data; exact, and the same for any number of threads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/stop_reason.hpp"
#include "core/base/types.hpp"

namespace warren {

/// Of the graph of a roadmap all of whose edges were checked; start and goal count as milestones.
struct ComponentFacts {
  std::uint64_t count = 0;       ///< components
  std::uint64_t milestones = 0;  ///< in all of them
  std::uint64_t largest = 0;     ///< milestones in the largest
  std::uint64_t alone = 0;       ///< components of one milestone
  std::uint64_t of_start = 0;    ///< milestones in the one of the start
  std::uint64_t of_goal = 0;     ///< milestones in the one of the goal
  bool joined = false;           ///< are start and goal in one?
};

/// Where the body has least room along the path.
struct NarrowPlace {
  std::uint64_t leg = 0;      ///< from this state of the path to the next, from 0
  std::optional<Vec2> place;  ///< of the reference point; of bodies that turn where the leg begins, of arms none
  double clearance = 0.0;     ///< room around the body there, world units
  /// Of so many uniform samples one falls into a square as wide as that room; of paths over samples alone.
  std::optional<double> one_sample_in;
};

/// What would likely help, as words of the command that was given or of another one.
struct Hint {
  std::string verb;                ///< whose options they are; empty: of the command that gave this answer
  std::vector<std::string> words;  ///< options to add or to replace; empty: it takes more than an option
  std::string why;                 ///< what they would do
};

/// What an answer means: what became of the roadmap, where it is narrow, what would help.
struct Explanation {
  std::optional<ComponentFacts> components;  ///< of prm, where the graph is there and its edges lead both ways
  std::optional<NarrowPlace> narrowest;      ///< of a path that keeps a distance
  std::vector<Hint> hints;                   ///< where there is no path, the likeliest first; this world takes them
  std::optional<StopReason> stopped;         ///< why what is missing here is
};

}  // namespace warren
