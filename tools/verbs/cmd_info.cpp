// SPDX-License-Identifier: BSD-3-Clause
// warren info: what is in this file.
#include <fmt/format.h>

#include <iterator>

#include "core/base/printable.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/question/question.hpp"
#include "solve/question/write_answer_io.hpp"
#include "studies/measure/human_units.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/command.hpp"

namespace warren {
namespace {

constexpr OptionSpec info_specs[] = {
    {"--json", "FILE", "write it as JSON; - is standard output"},
};

/// Name, text for people, JSON.
struct Fact {
  std::string name;
  std::string text;
  std::string json;
};

std::string state_text(const std::vector<double>& state) { return fmt::format("{}", fmt::join(state, ", ")); }

std::string state_json(const std::vector<double>& state) {
  std::string text = "[";
  for (const double value : state) text += (text.size() > 1 ? ", " : "") + json_number(value);
  return text + "]";
}

Fact box_fact(const char* name, const Box& box) {
  const std::vector<double> corners{box.min.x, box.min.y, box.max.x, box.max.y};
  return {name, fmt::format("{} to {}, {} to {}", box.min.x, box.max.x, box.min.y, box.max.y), state_json(corners)};
}

Fact count_fact(const char* name, std::size_t count) { return {name, grouped(count), std::to_string(count)}; }

std::string_view format_name(MapFormat format) {
  constexpr std::string_view names[] = {"Moving AI map", "map server", "image"};
  return names[static_cast<std::size_t>(format)];
}

Fact number_fact(const char* name, double number) { return {name, fmt::format("{}", number), json_number(number)}; }

std::vector<Fact> map_facts(const Scene& scene, const WorldAccount& world, const Execution& execution) {
  const OccupancyMap& map = *scene.map;
  const std::string format{format_name(map.format)};
  std::vector<Fact> facts{{"source", world.source, json_string(world.source)},
                          {"kind", world.kind, json_string(world.kind)},
                          {"format", format, json_string(format)},
                          count_fact("width", map.width()),
                          count_fact("height", map.height()),
                          count_fact("free", map.free),
                          count_fact("occupied", map.occupied)};
  if (map.format == MapFormat::ros) {
    facts.push_back(count_fact("unknown", map.unknown_count));
    facts.push_back(count_fact("between", map.between));
    facts.push_back({"origin", fmt::format("{}, {}, yaw {}", map.origin.x, map.origin.y, map.yaw_rad),
                     state_json({map.origin.x, map.origin.y, map.yaw_rad})});
  }
  if (!map.water.empty()) facts.push_back(count_fact("water", map.water.count()));
  facts.push_back(number_fact("resolution", map.cell));
  facts.push_back(box_fact("box", obstacle_box(scene, execution)));
  facts.push_back({"hash", world.hash, json_string(world.hash)});
  return facts;
}

std::vector<Fact> obstacle_facts(const Scene& scene, const WorldAccount& world, const Execution& execution) {
  if (scene.map) return map_facts(scene, world, execution);
  std::vector<Fact> facts{{"source", world.source, json_string(world.source)},
                          {"kind", world.kind, json_string(world.kind)},
                          count_fact("walls", scene.walls.size())};
  if (scene.walls.size() > 0) {
    const bool floats = scene.walls.holds_floats();
    facts.push_back({"held as", floats ? "float" : "double", floats ? "\"float\"" : "\"double\""});
  }
  if (!scene.polygons.empty()) {
    facts.push_back(count_fact("polygons", scene.polygons.size()));
    std::size_t corners = 0;
    for (const ScenePolygon& polygon : scene.polygons) corners += polygon.corners.size();
    facts.push_back(count_fact("corners", corners));
  }
  if (!scene.spheres.empty()) facts.push_back(count_fact("spheres", scene.spheres.size()));
  if (!scene.boxes.empty()) facts.push_back(count_fact("boxes", scene.boxes.size()));
  if (const Box box = obstacle_box(scene, execution); !box.empty()) facts.push_back(box_fact("box", box));
  if (scene.bounds) facts.push_back(box_fact("bounds", *scene.bounds));
  facts.push_back({"hash", world.hash, json_string(world.hash)});
  return facts;
}

void add_problem_facts(const Scene& scene, std::vector<Fact>& facts) {
  if (scene.maze) {
    facts.push_back({"maze", fmt::format("{} rows, {} columns", scene.maze->rows, scene.maze->cols),
                     fmt::format("[{}, {}]", scene.maze->rows, scene.maze->cols)});
  }
  if (scene.clearance)
    facts.push_back({"clearance", fmt::format("{}", *scene.clearance), json_number(*scene.clearance)});
  if (scene.robot) facts.push_back({"robot", robot_text(*scene.robot), json_string(robot_text(*scene.robot))});
  if (!scene.start.empty()) facts.push_back({"start", state_text(scene.start), state_json(scene.start)});
  if (!scene.goal.empty()) facts.push_back({"goal", state_text(scene.goal), state_json(scene.goal)});
  if (scene.grid) {
    facts.push_back({"grid", fmt::format("cell {}, {} angles", scene.grid->cell, scene.grid->angles),
                     fmt::format("[{}, {}]", json_number(scene.grid->cell), scene.grid->angles)});
  }
}

std::string json_of(const std::vector<Fact>& facts) {
  std::string text = R"({"schema": "warren.info/1")";
  for (const Fact& fact : facts) text += ",\n " + json_string(fact.name) + ": " + fact.json;
  return text + "}\n";
}

int info(const Arguments& arguments) {
  const auto json = output_file(arguments, "--json");
  Run run(arguments);
  StageTimes seconds;
  const Scene scene = load_world(arguments.operand(0), arguments, run.execution(), seconds);
  std::vector<Fact> facts = obstacle_facts(scene, account_of(scene, run.execution()), run.execution());
  add_problem_facts(scene, facts);
  run.end();
  if (json) write_file(*json, json_of(facts), run.execution());
  if (run.quiet() || json == "-") return exit_code::success;
  for (const Fact& fact : facts)
    print_text(fmt::format("{}{}\n", run.palette().faint(fmt::format("{:<11}", fact.name)), printable(fact.text)));
  return exit_code::success;
}

}  // namespace

Command info_command() {
  Command command{"info", "WORLD", "say what is in a world", {}, info};
  add_options(command.options, info_specs);
  add_options(command.options, world_option_specs());
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
