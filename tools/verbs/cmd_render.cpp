// SPDX-License-Identifier: BSD-3-Clause
// warren render: a picture of a world, with an answer's path on it, or of a roadmap.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "pictures/draw_answer.hpp"
#include "pictures/formats/write_picture.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/answer/world_account.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/question_words.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec render_specs[] = {
    {"--output", "FILE", "where to: .svg .png .pdf .html by ending", {}, "-o"},
    {"--answer", "FILE", "draw this answer's path"},
    roadmap_world_option,
    {"--animate", "", "with --answer: the body moves along the path (.svg and .html)"},
};

void check_animation(const Arguments& arguments, const std::string& file) {
  if (!arguments.has("--animate")) return;
  if (!arguments.has("--answer")) throw UsageError("--animate: needs --answer FILE, a path to move along");
  if (const std::string ending = ending_of(file); ending == ".png" || ending == ".pdf") {
    throw UsageError(fmt::format("--animate: a {} stands still; say .svg or .html", ending));
  }
}

int render(const Arguments& arguments) {
  const std::string file = arguments.value("--output").value_or("");
  if (!arguments.has("--output")) throw UsageError("-o FILE is missing");
  check_picture("--output", file);
  check_writable(file);
  const PictureOptions options = picture_words(arguments, true, {}, file);
  const auto answer_file = arguments.value("--answer");
  check_animation(arguments, file);
  if (is_roadmap_named(arguments.operand(0))) {
    check_rules_of_maps(arguments);
    arguments.refuse(price_option_specs(), "is for a world; a roadmap has its own inside");
    if (answer_file) throw UsageError("--answer: is drawn on a world; a roadmap is drawn alone");
    return draw_roadmap(arguments, file, options);
  }
  if (arguments.has("--world")) throw UsageError("--world: is for a roadmap without its world");
  Run run(arguments);
  RecordedAnswer answer;
  if (answer_file) answer = read_answer(*answer_file, run.execution());
  Scene scene = load_world(arguments.operand(0), arguments, run.execution(), nullptr, answer.problem.robot);
  Prices& prices = answer.problem.prices;  // the command line's, else the answer's; and the world's
  if (Prices asked = price_words(arguments); !asked.empty()) prices = std::move(asked);
  read_asked_files(answer.problem, arguments, run.execution());
  prices = prices_of(scene, answer.problem);
  check_not_written(arguments, answer.problem.robot);
  if (answer_file) check_plannable(scene, answer.problem);
  add_map_walls(scene, run.execution());
  if (answer_file) check_same_world(answer, *answer_file, scene, run.execution());
  Picture picture = drawing_of(scene, answer, run.execution(), options.heading);
  if (arguments.has("--animate")) animate(picture);
  picture.description = fmt::format("{}\n{}", picture.subtitle, arguments.command_line());
  const std::vector<std::string> notes =
      run.in_stage("draw", nullptr, [&] { return write_picture(file, picture, options, run.execution()); });
  run.end();
  say_of_picture(arguments, file, notes);
  run.conclude([&] { return fmt::format("{}: {}\n", run.palette().strong(file), description_of(scene)); });
  return exit_code::success;
}

}  // namespace

Command render_command() {
  return {"render", "FILE", "draw a world, with the path of an answer, or a roadmap",
          joined_options(
              {render_specs, picture_option_specs(), price_option_specs(), world_option_specs(), run_option_specs()}),
          render};
}

}  // namespace warren::tools
