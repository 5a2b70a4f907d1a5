// SPDX-License-Identifier: BSD-3-Clause
// Roadmaps in as the verbs need them: ROADMAP, the first operand, and by --world the world of a file that has none. And
// as a picture.
#pragma once

#include "core/base/counters.hpp"
#include "parallel/execution.hpp"
#include "pictures/model/picture_options.hpp"
#include "solve/roadmaps/roadmap.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

inline constexpr OptionSpec roadmap_world_option{"--world", "WORLD",
                                                 "the world that the roadmap was built for, where its file has none"};

/// Throws UsageError for --map-rules where no --world is named that they could be for.
void check_rules_of_maps(const Arguments& arguments);

/// Adds the time to seconds. Throws as read_roadmap and load_world do, InputError for a world where a roadmap is
/// expected, and UsageError where an output is the table of the roadmap's arm.
Roadmap load_roadmap(const Arguments& arguments, const Execution& execution, StageTimes& seconds);

/// Is there a roadmap in the file? Pipes are taken for worlds, since what is read of them is gone.
bool is_roadmap_named(const std::string& file);

/// The picture of ROADMAP in a file. The exit code; throws as load_roadmap and write_picture do.
int draw_roadmap(const Arguments& arguments, const std::string& file, const PictureOptions& options);

}  // namespace warren::tools
