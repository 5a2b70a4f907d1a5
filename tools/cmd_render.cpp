// SPDX-License-Identifier: BSD-3-Clause
// warren render: a picture of a world, with an answer's path on it.
#include <fmt/format.h>

#include "core/error.hpp"
#include "tools/cell_drawing.hpp"
#include "tools/command.hpp"
#include "tools/exit_code.hpp"
#include "tools/output_files.hpp"
#include "tools/picture.hpp"
#include "tools/problem.hpp"
#include "tools/recorded_answer.hpp"
#include "tools/run_options.hpp"
#include "tools/sweep_drawing.hpp"
#include "tools/terminal.hpp"
#include "tools/world_files.hpp"
#include "worlds/map_walls.hpp"

namespace warren {
namespace {

constexpr OptionSpec specs[] = {
    {"--output", "FILE", "where to: .svg .png .html by ending", {}, "-o"},
    {"--answer", "FILE", "draw this answer's path"},
};

std::optional<Vec2> point_of(const std::vector<double>& answer, const std::vector<double>& scene) {
  const std::vector<double>& state = answer.empty() ? scene : answer;
  if (state.size() < 2) return std::nullopt;
  return Vec2{state[0], state[1]};
}

std::string picture_file(const Arguments& arguments) {
  const auto file = arguments.value("--output");
  if (!file) throw UsageError("-o FILE is missing");
  const std::string ending = ending_of(*file);
  if (*file != "-" && ending != ".svg" && ending != ".png" && ending != ".html") {
    throw UsageError("--output: a picture ends in .svg, .png or .html (found: '" + *file + "')");
  }
  check_writable(*file);
  return *file;
}

int render(const Arguments& arguments) {
  const std::string file = picture_file(arguments);
  const auto answer_file = arguments.value("--answer");
  if (answer_file == "-" && arguments.operand(0) == "-") {
    throw UsageError("WORLD and --answer can't both come from standard input");
  }
  Run run(arguments);
  StageTimes seconds;
  RecordedAnswer answer;
  if (answer_file) answer = read_answer(*answer_file, run.execution());
  Scene scene = load_world(arguments.operand(0), run.execution(), seconds);
  add_map_walls(scene);
  if (answer_file) check_same_world(answer, *answer_file, scene, run.execution());
  std::vector<PictureLayer> layers;
  if (scene.map) layers.push_back(map_layer(*scene.map));
  const RobotSpec robot = robot_of(scene, answer.problem);
  if (robot.kind == RobotKind::polygon && answer.state_width() == 3) {
    layers.push_back(sweep_of(poses_of(answer.states), robot.outline));
  }
  const Picture picture{.scene = scene,
                        .layers = layers,
                        .path = answer.path,
                        .start = point_of(answer.problem.start, scene.start),
                        .goal = point_of(answer.problem.goal, scene.goal),
                        .title = scene.source,
                        .description = description_of(scene) + ": " + arguments.command_line()};
  double draw_seconds = 0.0;
  {
    const StageTimer timer(run.execution(), "draw", draw_seconds);
    write_picture(file, picture, run.execution());
  }
  run.end();
  if (!run.quiet() && file != "-")
    print_text(fmt::format("{}: {}\n", run.palette().strong(file), description_of(scene)));
  return exit_code::success;
}

}  // namespace

Command render_command() {
  Command command{"render", "WORLD", "draw a world, and an answer's path on it", {}, render};
  add_options(command.options, specs);
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
