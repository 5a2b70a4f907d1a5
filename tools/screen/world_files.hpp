// SPDX-License-Identifier: BSD-3-Clause
// Worlds and kept roadmaps in and out as the verbs need them: worlds are read or generated with their time taken and
// written in any format by ending; ROADMAP, the first operand, is read, with the world of --world where its file has
// none, and drawn.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "pictures/model/picture_options.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --map-rules, --request
std::span<const OptionSpec> world_option_specs();

/// Reads or generates WORLD as world_option_specs say; adds the time to seconds->read or seconds->generate where
/// somebody asks. robot: where no --robot names it, the one in whose links' frames a scene of MoveIt may have poses.
/// Throws as read_world does, and UsageError for rules of maps where the world is no map of map_server.
Scene load_world(const std::string& source, const Arguments& arguments, const Execution& execution,
                 StageTimes* seconds = nullptr, const std::optional<RobotSpec>& robot = {});

/// `source`, which is no made one: whoever types a maze's size, or the word alone, is told how a maze is called.
const std::string& named_world(const std::string& source);

/// The same, but walls are left out that can be had tile by tile (is_unmade): where `pipeline` is streamed, or where it
/// is not said and the memory would not hold them while they are planned among.
Scene load_planned_world(const std::string& source, std::optional<PipelineKind> pipeline, const Arguments& arguments,
                         const Execution& execution, StageTimes* seconds = nullptr,
                         const std::optional<RobotSpec>& robot = {});

/// The same for a file that is open already.
Scene load_world(const InputFile& file, const Arguments& arguments, const Execution& execution,
                 StageTimes* seconds = nullptr, const std::optional<RobotSpec>& robot = {});

/// Of who reads a world alone: the arm of a scene or request of MoveIt.
inline constexpr OptionSpec moveit_robot_option{
    "--robot", "\"BODY\"", "of a scene or request of MoveIt: the arm in whose links' frames poses may be"};

/// For who takes that option: UsageError for it where it would be passed over. file: nullptr of a world that is made;
/// other_use: "--simplify, or for ".
void check_robot_has_use(const InputFile* file, const Arguments& arguments, std::string_view other_use = {});

/// The same, then the world.
Scene load_world_alone(const std::string& source, const Arguments& arguments, const Execution& execution,
                       std::string_view other_use = {});

/// Scene text, .npy, or a picture, by the file's ending; "-" is scene text. Returns as write_picture() does.
std::vector<std::string> write_world(const Scene& scene, const std::string& file, const PictureOptions& options,
                                     const std::string& command_line, const Execution& execution);

/// A line that says what the file's format has no words for, to be told once nothing can fail; empty: it has them all.
std::string note_of_left_out(const Scene& scene, const std::string& file, const OccupancyMap* becomes = nullptr);

/// Throws UsageError unless `file` has an ending that write_world knows, WriteError unless it can be written.
void check_world_file(const std::string& file);

inline constexpr OptionSpec roadmap_world_option{
    "--world", "WORLD", "the world that the roadmap was built for, where its file has none (build --no-world)"};

/// Throws UsageError for --map-rules and --request where no --world is named that they could be for.
void check_rules_of_maps(const Arguments& arguments);

/// Adds the time to *seconds where somebody asks. Throws as read_roadmap and load_world do, InputError for a world
/// where a roadmap is expected, and UsageError where an output is the table of the roadmap's arm.
Roadmap load_roadmap(const Arguments& arguments, const Execution& execution, StageTimes* seconds = nullptr);

/// Is there a roadmap in the file? Pipes are taken for worlds, since what is read of them is gone.
bool is_roadmap_named(const std::string& file);

/// The picture of ROADMAP in a file. The exit code; throws as load_roadmap and write_picture do.
int draw_roadmap(const Arguments& arguments, const std::string& file, const PictureOptions& options);

/// Reads what the words of a question name: masks, and the answer of --keep-to. Throws as their readers do.
void read_asked_files(Question& question, const Arguments& arguments, const Execution& execution);

}  // namespace warren::tools
