// SPDX-License-Identifier: BSD-3-Clause
// warren export: a roadmap in the words of other programs, by the ending of the file.
#include <fmt/format.h>

#include "apps/serve/graphs/route_graph.hpp"
#include "apps/serve/graphs/route_graph_io.hpp"
#include "apps/serve/http/http_message.hpp"
#include "core/base/error.hpp"
#include "pictures/formats/write_picture.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/kept/export_roadmap.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/command.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/output_words.hpp"

namespace warren::tools {
namespace {

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

/// A route graph with fewer nodes.
int export_simplified(const Arguments& arguments, const std::string& file, const std::string& frame) {
  const double within = *given_value(arguments, "--simplify", number_value, 0.0, largest_coordinate);
  if (!file.ends_with(".geojson")) throw UsageError("--simplify: a route graph is written as -o FILE.geojson");
  if (arguments.has("--unchecked")) throw UsageError("--simplify: keeps free edges alone; leave out --unchecked");
  Run run(arguments);
  const Roadmap roadmap = load_roadmap(arguments, run.execution());
  serve::RouteGraph whole;
  serve::RouteGraph few;
  try {
    whole = serve::graph_of_roadmap(roadmap, run.execution());
    Question body;
    body.robot = roadmap.robot;
    body.clearance = roadmap.clearance;
    few = serve::simplified_in(roadmap.world.whole(run.execution()), body, whole, within, run.execution());
    few.frame = frame;
    write_file(file, serve::nav2_graph_text(few, serve::ends_of(few), run.execution()), run.execution());
  } catch (const serve::HttpError& error) {
    throw InputError(arguments.operand(0), error.what());
  }
  run.end();
  run.conclude(file == "-", {}, [&] {
    return fmt::format("{}: {} of {} nodes, {} of {} edges\n", run.palette().strong(file), grouped(few.nodes.size()),
                       grouped(whole.nodes.size()), grouped(few.edges.size()), grouped(whole.edges.size()));
  });
  return exit_code::success;
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
  run.end();
  run.conclude(file == "-", {}, [&] {
    return fmt::format("{}: {} vertices, {} edges; left out: {} unchecked, {} blocked\n", run.palette().strong(*file),
                       grouped(account.vertices), grouped(account.edges), grouped(account.unchecked_left_out),
                       grouped(account.blocked_left_out));
  });
  return exit_code::success;
}

}  // namespace

Command export_command() {
  return {"export", "ROADMAP", "write a roadmap for other programs",
          joined_options({export_specs, picture_option_specs(), world_option_specs(), run_option_specs()}),
          export_roadmap_file};
}

}  // namespace warren::tools
