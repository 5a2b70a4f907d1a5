// SPDX-License-Identifier: BSD-3-Clause
// warren generate: writes a maze of any size, or any number of polygons, the same for the same seed on every machine.
#include <fmt/format.h>

#include "pictures/formats/write_picture.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "scenes/scene/polygon_generator.hpp"
#include "solve/answer/world_account.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec generate_specs[] = {
    {.name = "--output",
     .value = "FILE",
     .help = "where to: .walls .scene .npy .maze .geojson .wkt .svg .png .pdf .html by ending; - is standard output",
     .short_name = "-o"},
    {.name = "--seed",
     .value = "N",
     .help = "which of all such worlds: another seed makes another (default: 1)",
     .group = "Options"},
    {"--algorithm", "NAME", "how a maze is made (default: backtracker)", choices_of<MazeAlgorithm>},
    {"--loops", "F", "share of a maze's inner walls that is taken out, which makes loops, 0 to 1 (default: 0)"},
    {"--unit-walls", "", "write each wall of a maze as pieces of one cell, not as long as it goes"},
    {"--corners", "N", "corners of each polygon (default: 3 to 12, at random)"},
};

MazeOptions maze_options(const Arguments& arguments) {
  arguments.refuse({"--corners"}, "an option of generate polygons");
  const std::string& size = arguments.operand(1);
  if (size.find(',') != std::string::npos) {
    throw UsageError(fmt::format("expected ROWSxCOLS (found: '{}'); seed, algorithm and loops are options", size));
  }
  MazeOptions options;
  try {
    options = parse_maze_source("maze:" + size);
  } catch (const UsageError& error) {  // "maze:SIZE: what is wrong; expected maze:..."
    const std::string_view said = std::string_view(error.what()).substr(std::string_view("maze:").size());
    throw UsageError(fmt::format("{}; expected ROWSxCOLS", said.substr(0, said.rfind("; expected "))));
  }
  options.seed = seed_word(arguments);
  return maze_words(arguments, options);
}

PolygonOptions polygon_options(const Arguments& arguments) {
  constexpr std::uint32_t most = 1U << 30;
  arguments.refuse({"--algorithm", "--loops", "--unit-walls"}, "an option of generate maze");
  PolygonOptions options;
  options.count = count_value("COUNT", arguments.operand(1), 1, most);
  options.seed = seed_word(arguments);
  options.corners = given_count(arguments, "--corners", 3, most);
  as_usage([&] { options.validate(); });
  return options;
}

/// A maze whose walls nobody needs to hold, as .maze or, of mst, as .npy.
int generate_packed(const MazeOptions& options, bool merged, const std::string& file, Run& run) {
  const Execution& execution = run.execution();
  double seconds = 0.0;
  run.in_stage("generate", &seconds, [&] {
    if (options.algorithm != MazeAlgorithm::mst) {
      return write_maze_file(HeldCells(generate_maze(options, execution), CellBits::usual_side_log2), file, execution);
    }
    const SpanningMaze maze(options.rows, options.cols, options.seed, options.loops, execution);
    if (ending_of(file) == ".npy") return write_npy(WallStrips(maze, merged, execution), file, execution);
    write_maze_file(maze, file, execution);
  });
  run.conclude([&] {
    return fmt::format("{}: {} x {} maze, generated and written in {}\n", run.palette().strong(file), options.rows,
                       options.cols, human_seconds(seconds));
  });
  return exit_code::success;
}

int generate(const Arguments& arguments) {
  const auto file = arguments.value("--output");
  const std::string& what = arguments.operand(0);
  if (what != "maze" && what != "polygons") {
    throw UsageError("'" + what + "' is nothing that can be generated; did you mean maze or polygons?");
  }
  const auto maze = what == "maze" ? std::optional(maze_options(arguments)) : std::nullopt;
  const PolygonOptions polygons = maze ? PolygonOptions{} : polygon_options(arguments);
  if (!file) throw UsageError("-o FILE is missing");
  const std::string ending = ending_of(*file);
  const bool merged = !arguments.has("--unit-walls");
  if (!merged && ending == ".maze") throw UsageError("--unit-walls: a .maze file holds cells");
  check_world_file(*file);
  const PictureOptions options = picture_words(arguments, is_picture(ending), "-o FILE.svg or another picture", *file);
  Run run(arguments);
  const bool is_mst = maze && maze->algorithm == MazeAlgorithm::mst;
  if (maze && (ending == ".maze" || (ending == ".npy" && is_mst))) return generate_packed(*maze, merged, *file, run);
  double seconds = 0.0;
  Scene scene = run.in_stage("generate", &seconds, [&] {
    return maze ? maze_scene(*maze, merged, run.execution()) : polygon_scene(polygons, run.execution());
  });
  double write_seconds = 0.0;
  const std::string note = run.in_stage("write", &write_seconds, [&] {
    const auto bounds = scene.bounds;
    if (ending == ".wkt") scene.bounds.reset();  // or no polygons could be written there
    say_of_picture(arguments, *file, write_world(scene, *file, options, arguments.command_line(), run.execution()));
    scene.bounds = bounds;
    return is_picture(ending) ? std::string() : note_of_left_out(scene, *file);
  });
  run.conclude([&] {
    return fmt::format("{}: {}, generated in {}, written in {}\n", run.palette().strong(*file), description_of(scene),
                       human_seconds(seconds), human_seconds(write_seconds));
  });
  if (!run.quiet()) say_on_standard_error(note);
  return exit_code::success;
}

}  // namespace

Command generate_command() {
  return {"generate", "maze|polygons ROWSxCOLS|COUNT", "write a maze of any size, or any number of polygons",
          joined_options({generate_specs, picture_option_specs(), run_option_specs()}), generate};
}

}  // namespace warren::tools
