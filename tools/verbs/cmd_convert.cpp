// SPDX-License-Identifier: BSD-3-Clause
// warren convert: any world into any format that can hold it; maps become border walls, walls become cells. warren
// export: a roadmap in the words of other programs, by the ending of the file. Both: route graphs with fewer nodes.
#include <fmt/format.h>

#include "apps/serve/graphs/route_graph.hpp"
#include "apps/serve/http/http_message.hpp"
#include "pictures/formats/write_picture.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "solve/question/planner_choice.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec convert_specs[] = {
    {.name = "--output",
     .value = "FILE",
     .help = "where to: .walls .scene .npy .maze .geojson .wkt .map .yaml .pgm .svg .png .pdf .html by ending; - is "
             "standard output. A map's .png has a pixel a cell; of other worlds it is a picture unless --cell is given",
     .short_name = "-o"},
    {"--cell", "C", "make a map of walls or polygons, with cells of this side"},
    {"--simplify", "D",
     "WORLD is a route graph of Nav2: leave out the nodes of chains that stay within D metres of a straight edge. "
     "Nodes and edges that somebody has written metadata, operations or headings on stay, and so do costs and "
     "directions"},
    {"--world", "WORLD", "with --simplify: make only edges along which the body goes free in this world"},
    {"--robot", "\"BODY\"",
     "with --world: the body (default: the world's, else point). Of a scene or request of MoveIt: the arm in whose "
     "links' frames poses may be"},
    {"--clearance", "R", "with --world: room to keep around the body (default: the world's, else 0)"},
};

/// D of --simplify, for graphs that are written to the file.
double simplified_within(const Arguments& arguments, const std::string& file) {
  const double within = *given_value(arguments, "--simplify", number_value, 0.0, largest_coordinate);
  if (!file.ends_with(".geojson")) throw UsageError("--simplify: a route graph is written as -o FILE.geojson");
  return within;
}

/// source: where the graph is from; made() gives it whole, and the one with fewer nodes that is written.
template <class Made>
int write_simplified(Run& run, const std::string& source, const std::string& file, const Made& made) {
  try {
    const auto [whole, few] = made();
    write_file(file, serve::nav2_graph_text(few, serve::ends_of(few), run.execution()), run.execution());
    run.conclude([&, &whole = whole, &few = few] {
      return fmt::format("{}: {} of {} nodes, {} of {} edges\n", run.palette().strong(file), grouped(few.nodes.size()),
                         grouped(whole.nodes.size()), grouped(few.edges.size()), grouped(whole.edges.size()));
    });
  } catch (const serve::HttpError& error) {
    throw InputError(source, error.what());
  }
  return exit_code::success;
}

int simplify_graph(const Arguments& arguments, const std::string& file) {
  const double within = simplified_within(arguments, file);
  const auto world = arguments.value("--world");
  arguments.refuse({"--cell"}, "is for a world; a route graph has none");
  picture_words(arguments, false, "a picture");
  if (!world) arguments.refuse({"--robot", "--clearance", "--map-rules", "--request"}, "is for --world");
  Run run(arguments);
  const Scene scene = world ? load_world(*world, arguments, run.execution()) : Scene{};
  const InputFile input(arguments.operand(0), run.execution());
  return write_simplified(run, input.name(), file, [&] {
    serve::RouteGraph whole = serve::read_nav2_graph(input.bytes(), run.execution());
    serve::RouteGraph few = world
                                ? serve::simplified_in(scene, question_words(arguments), whole, within, run.execution())
                                : serve::simplified(whole, within, {}, run.execution());
    return std::pair(std::move(whole), std::move(few));
  });
}

std::string write_any(Scene& scene, const std::string& file, const Arguments& arguments, const PictureOptions& options,
                      const Execution& execution) {
  // A picture of walls in pixels can't be read back, so a map's is an image of its cells.
  if (is_map_ending(file) || (file.ends_with(".png") && (scene.map || arguments.has("--cell")))) {
    arguments.refuse(picture_option_specs(), "is for a picture; an image of a map has a pixel a cell");
    const auto cell = given_value(arguments, "--cell", positive_value);
    if (cell) check_cell(*cell, scene, execution);
    if (scene.map && cell) throw UsageError("--cell: the world is a map, and its cells stay as they are");
    if (!scene.map && !cell) throw UsageError("--cell: is missing; it says how large a cell of the map shall be");
    const OccupancyMap map = scene.map ? *scene.map : map_of_scene(scene, *cell, execution);
    write_map(map, file, execution);
    constexpr std::string_view no_cell =
        "warren: note: no cell of the map is free, each touches a wall; a smaller --cell leaves some\n";
    return (map.free == 0 ? std::string(no_cell) : std::string()) + note_of_left_out(scene, file, &map);
  }
  add_map_walls(scene, execution);
  say_of_picture(arguments, file, write_world(scene, file, options, arguments.command_line(), execution));
  return is_picture(ending_of(file)) ? std::string() : note_of_left_out(scene, file);
}

int convert(const Arguments& arguments) {
  const auto file = arguments.value("--output");
  if (!file) throw UsageError("-o FILE is missing");
  is_map_ending(*file) ? check_writable(*file) : check_world_file(*file);
  if (file->ends_with(".yaml")) check_writable(map_image_of(*file));
  if (arguments.has("--simplify")) return simplify_graph(arguments, *file);
  arguments.refuse({"--world", "--clearance"}, "is for --simplify");
  if (!is_map_ending(*file) && !file->ends_with(".png") && arguments.has("--cell")) {
    throw UsageError("--cell: only maps have cells: .map, .yaml, .pgm and .png");
  }
  const PictureOptions options =
      picture_words(arguments, is_picture(ending_of(*file)), "-o FILE.svg or another picture", *file);
  Run run(arguments);
  check_not_written(arguments, question_words(arguments).robot);
  Scene scene = load_world_alone(arguments.operand(0), arguments, run.execution(), "--simplify, or for ");
  const std::string note =
      run.in_stage("write", nullptr, [&] { return write_any(scene, *file, arguments, options, run.execution()); });
  run.conclude([&] { return fmt::format("{}: {}\n", run.palette().strong(*file), description_of(scene)); });
  if (!run.quiet()) say_on_standard_error(note);
  return exit_code::success;
}

constexpr OptionSpec export_specs[] = {
    {.name = "--output",
     .value = "FILE",
     .help = "where to: .geojson .graphml .gr .csv .npz .dot, or as a picture .svg .png .pdf .html, by ending",
     .short_name = "-o"},
    {"--unchecked", "", "write edges, too, that nothing has checked yet (of lazy-prm)"},
    {"--frame", "NAME", "name of the coordinate frame in .geojson (default: map)"},
    {"--simplify", "D",
     "leave out of .geojson the nodes of chains that stay within D metres of a straight edge along which the body goes "
     "free"},
    roadmap_world_option,
};

int export_simplified(const Arguments& arguments, const std::string& file, const std::string& frame) {
  const double within = simplified_within(arguments, file);
  if (arguments.has("--unchecked")) throw UsageError("--simplify: keeps free edges alone; leave out --unchecked");
  Run run(arguments);
  const Roadmap roadmap = load_roadmap(arguments, run.execution());
  return write_simplified(run, arguments.operand(0), file, [&] {
    serve::RouteGraph whole = serve::graph_of_roadmap(roadmap, run.execution());
    const Question body{.robot = serve::body_on_edges(roadmap), .clearance = roadmap.clearance};
    serve::RouteGraph few =
        serve::simplified_in(roadmap.world.whole(run.execution()), body, whole, within, run.execution());
    few.frame = frame;
    return std::pair(std::move(whole), std::move(few));
  });
}

int export_roadmap_file(const Arguments& arguments) {
  check_rules_of_maps(arguments);
  const auto file = output_file(arguments, "--output");
  if (!file) throw UsageError("-o FILE is missing");
  if (is_picture(ending_of(*file))) {
    arguments.refuse({"--unchecked", "--frame", "--simplify"}, "means nothing to a picture");
    check_picture("--output", *file);
    return draw_roadmap(arguments, *file, picture_words(arguments, true, {}, *file));
  }
  picture_words(arguments, false, "a picture");
  if (!file->ends_with(".geojson")) arguments.refuse({"--frame"}, "is for .geojson");
  for (const std::string& name : files_of_export(*file)) check_writable(name);
  const std::string frame = arguments.value("--frame").value_or("map");
  if (arguments.has("--simplify")) return export_simplified(arguments, *file, frame);
  const ExportOptions options{.with_unchecked = arguments.has("--unchecked"), .frame = frame};
  Run run(arguments);
  const Roadmap roadmap = load_roadmap(arguments, run.execution());
  const ExportAccount account = export_of_roadmap(roadmap, *file, options, run.execution());
  run.conclude([&] {
    return fmt::format("{}: {} vertices, {} edges; left out: {} unchecked, {} blocked\n", run.palette().strong(*file),
                       grouped(account.vertices), grouped(account.edges), grouped(account.unchecked_left_out),
                       grouped(account.blocked_left_out));
  });
  return exit_code::success;
}

}  // namespace

Command convert_command() {
  return {"convert", "WORLD", "write a world in another format",
          joined_options({convert_specs, picture_option_specs(), world_option_specs(), run_option_specs()}), convert};
}

Command export_command() {
  return {"export", "ROADMAP", "write a roadmap for other programs",
          joined_options({export_specs, picture_option_specs(), world_option_specs(), run_option_specs()}),
          export_roadmap_file};
}

}  // namespace warren::tools
