// SPDX-License-Identifier: BSD-3-Clause
// warren render: a picture of a world, with an answer's path on it.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "pictures/curve_drawing.hpp"
#include "pictures/draw_arm.hpp"
#include "pictures/draw_cells.hpp"
#include "pictures/draw_sweep.hpp"
#include "pictures/picture.hpp"
#include "solve/question/plannable.hpp"
#include "solve/question/question.hpp"
#include "solve/question/read_answer_io.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/command.hpp"
#include "worlds/rasters/map_borders.hpp"

namespace warren {
namespace {

constexpr OptionSpec render_specs[] = {
    {"--output", "FILE", "where to: .svg .png .html by ending", {}, "-o"},
    {"--answer", "FILE", "draw this answer's path"},
    {"--animate", "", "with --answer: the body moves along the path (.svg and .html)"},
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

/// The body of an answer, for --animate. A point is shown as a small disc.
MovingBody moving_body(const RobotSpec& robot, const RecordedAnswer& answer, std::span<const double> turns) {
  constexpr double point_share = 1.0 / 120.0;
  MovingBody body{.outline = robot.outline, .radius = robot.radius, .heads = robot.kind == RobotKind::car};
  if (answer.state_width() == 3) {
    body.poses = poses_of(answer.states);
  } else if (answer.state_width() == 2) {
    for (const Vec2 p : answer.path) body.poses.push_back({p.x, p.y, 0.0});
  } else {
    throw UsageError("--animate: draws bodies of the plane, not an arm");
  }
  const std::vector<double> straight(body.poses.size(), 0.0);
  body.lengths = leg_lengths(body.poses, turns.empty() ? straight : turns);
  if (body.outline.empty() && body.radius == 0.0) {
    Box box;
    for (const Vec2 p : answer.path) box.include(p);
    body.radius = point_share * std::max(box.width(), box.height());
  }
  return body;
}

void check_animation(const Arguments& arguments, const std::string& file) {
  if (!arguments.has("--animate")) return;
  if (!arguments.has("--answer")) throw UsageError("--animate: needs --answer FILE, a path to move along");
  if (ending_of(file) == ".png") throw UsageError("--animate: a .png stands still; say .svg or .html");
}

int render(const Arguments& arguments) {
  const std::string file = picture_file(arguments);
  const auto answer_file = arguments.value("--answer");
  check_animation(arguments, file);
  if (answer_file == "-" && arguments.operand(0) == "-") {
    throw UsageError("WORLD and --answer can't both come from standard input");
  }
  Run run(arguments);
  StageTimes seconds;
  RecordedAnswer answer;
  if (answer_file) answer = read_answer(*answer_file, run.execution());
  Scene scene = load_world(arguments.operand(0), arguments, run.execution(), seconds);
  if (answer_file) check_plannable(scene, answer.problem);
  add_map_walls(scene, run.execution());
  if (answer_file) check_same_world(answer, *answer_file, scene, run.execution());
  std::vector<PictureLayer> layers;
  if (scene.map) layers.push_back(map_layer(*scene.map, run.execution()));
  const RobotSpec robot = robot_of(scene, answer.problem);
  check_not_written(arguments, robot.table);
  if (robot.kind == RobotKind::polygon && answer.state_width() == 3) {
    layers.push_back(sweep_of(poses_of(answer.states), robot.outline));
  }
  if (robot.kind == RobotKind::car && answer.state_width() == 3) {
    layers.push_back(car_sweep(poses_of(answer.states), robot));
  }
  const std::vector<double> turns = path_turns(robot, answer.states);
  std::optional<MovingBody> body;
  if (arguments.has("--animate")) body = moving_body(robot, answer, turns);
  std::optional<Scene> stage;  // views of an arm's world
  if (is_arm(robot)) {
    Drawing views = recorded_arm_drawing(scene, answer, run.execution());
    stage = std::move(views.stage);
    layers = std::move(views.layers);
  }
  const Picture picture{.scene = stage ? *stage : scene,
                        .layers = layers,
                        .path = stage ? std::span<const Vec2>() : std::span<const Vec2>(answer.path),
                        .path_turns = turns,
                        .start = stage ? std::nullopt : point_of(answer.problem.start, scene.start),
                        .goal = stage ? std::nullopt : point_of(answer.problem.goal, scene.goal),
                        .title = scene.source,
                        .description = description_of(scene) + ": " + arguments.command_line(),
                        .moving = body ? &*body : nullptr};
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
  add_options(command.options, render_specs);
  add_options(command.options, world_option_specs());
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
