// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/world_account.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

WorldAccount account_of(const Scene& scene, std::string hash) {
  WorldAccount world{
      .source = scene.source, .kind = "map", .hash = std::move(hash), .unit = std::string(unit_of(scene))};
  if (scene.map) return world;
  const bool plane = scene.walls.size() > 0 || !has_solids(scene);
  world.kind = scene.maze ? "maze" : !scene.polygons.empty() ? "polygons" : plane ? "walls" : "solids";
  const bool is_tree = is_unmade(scene) && scene.formula && scene.formula->loops == 0.0;
  world.walls =
      is_tree ? 4 + (scene.maze->rows - std::size_t{1}) * (scene.maze->cols - std::size_t{1}) : scene.walls.size();
  world.polygons = scene.polygons.size();
  world.spheres = scene.spheres.size();
  world.boxes = scene.boxes.size();
  world.solids = scene.solids.size();
  return world;
}

std::string contents_text(const WorldAccount& world) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* one, const char* many) {
    text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  if (world.polygons > 0) add(world.polygons, "polygon", "polygons");
  const bool nothing_else = world.polygons + world.spheres + world.boxes + world.solids == 0;
  if (nothing_else || world.walls > 0) add(world.walls, "wall", "walls");
  if (world.spheres > 0) add(world.spheres, "sphere", "spheres");
  if (world.boxes > 0) add(world.boxes, "box", "boxes");
  if (world.solids > 0) add(world.solids, "solid", "solids");
  return text;
}

std::string description_of(const Scene& scene) {
  if (scene.map) {
    return fmt::format("map of {} x {} cells, {} free", scene.map->width(), scene.map->height(),
                       grouped(scene.map->free));
  }
  WorldAccount held = account_of(scene, std::string());
  held.walls = scene.walls.size();
  const std::string maze = scene.maze ? fmt::format("{} x {} maze, ", scene.maze->rows, scene.maze->cols) : "";
  return maze + contents_text(held);
}

namespace {

std::string numbers_json(const std::vector<double>& numbers) { return json_list(std::span(numbers), ", "); }

/// Without what the last digits of a double may be by rounding.
std::string rounded_text(double number) {
  constexpr double most_plain = 1e12;
  return std::abs(number) < most_plain ? fmt::format("{:.12g}", number) : fmt::format("{}", number);
}

Fact text_fact(const char* name, const std::string& text) { return {name, text, json_string(text)}; }
Fact number_fact(const char* name, double number) { return {name, rounded_text(number), json_number(number)}; }
Fact count_fact(const char* name, std::size_t count) { return {name, grouped(count), std::to_string(count)}; }
Fact state_fact(const char* name, const std::vector<double>& state) {
  std::string text;
  for (const double number : state) text += (text.empty() ? "" : ", ") + rounded_text(number);
  return {name, std::move(text), numbers_json(state)};
}
Fact box_fact(const char* name, const Box& box) {
  return {name,
          fmt::format("{} to {}, {} to {}", rounded_text(box.min.x), rounded_text(box.max.x), rounded_text(box.min.y),
                      rounded_text(box.max.y)),
          numbers_json({box.min.x, box.min.y, box.max.x, box.max.y})};
}

void add_map_facts(const OccupancyMap& map, std::vector<Fact>& facts) {
  constexpr const char* formats[] = {"Moving AI map", "map server", "image"};
  facts.push_back(text_fact("format", formats[static_cast<std::size_t>(map.format)]));
  facts.push_back(count_fact("width", map.width()));
  facts.push_back(count_fact("height", map.height()));
  facts.push_back(count_fact("free", map.free));
  facts.push_back(count_fact("occupied", map.occupied));
  if (map.format == MapFormat::ros) {
    facts.push_back(count_fact("unknown", map.unknown_count));
    facts.push_back(count_fact("between", map.between));
    facts.push_back({"origin",
                     fmt::format("{}, {}, yaw {}", rounded_text(map.origin.x), rounded_text(map.origin.y),
                                 rounded_text(map.yaw_rad)),
                     numbers_json({map.origin.x, map.origin.y, map.yaw_rad})});
  }
  if (!map.water.empty()) facts.push_back(count_fact("water", map.water.count()));
  facts.push_back(number_fact("resolution", map.cell));
}

void add_obstacle_facts(const Scene& scene, std::vector<Fact>& facts) {
  facts.push_back(count_fact("walls", scene.walls.size()));
  const char* held = scene.walls.holds_packed() ? "packed" : scene.walls.holds_floats() ? "float" : "double";
  if (scene.walls.size() > 0) facts.push_back(text_fact("held as", held));
  if (!scene.polygons.empty()) {
    facts.push_back(count_fact("polygons", scene.polygons.size()));
    std::size_t corners = 0;
    for (const ScenePolygon& polygon : scene.polygons) corners += polygon.corners.size();
    facts.push_back(count_fact("corners", corners));
  }
  if (!scene.spheres.empty()) facts.push_back(count_fact("spheres", scene.spheres.size()));
  if (!scene.boxes.empty()) facts.push_back(count_fact("boxes", scene.boxes.size()));
  if (!scene.solids.empty()) facts.push_back(count_fact("solids", scene.solids.size()));
}

/// How many there are of each; the whole lines in JSON.
Fact prices_fact(const Prices& prices) {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : ", ") + words; };
  if (const auto& clearance = prices.clearance) add(fmt::format("nearness {}", rounded_text(clearance->price)));
  if (!prices.areas.empty()) add(counted(prices.areas.size(), "area", "areas"));
  if (!prices.masks.empty()) add(counted(prices.masks.size(), "mask", "masks"));
  if (!prices.keep_out.empty()) add(counted(prices.keep_out.size(), "forbidden area", "forbidden areas"));
  if (prices.opens_unknown()) add(fmt::format("unknown {}", rounded_text(*prices.unknown)));
  return {"prices", std::move(text), json_list(std::span<const std::string>(price_lines(prices)), ", ")};
}

void add_problem_facts(const Scene& scene, std::vector<Fact>& facts) {
  if (scene.maze) {
    facts.push_back({"maze", fmt::format("{} rows, {} columns", scene.maze->rows, scene.maze->cols),
                     fmt::format("[{}, {}]", scene.maze->rows, scene.maze->cols)});
  }
  if (scene.clearance) facts.push_back(number_fact("clearance", *scene.clearance));
  if (scene.robot) facts.push_back(text_fact("robot", robot_text(*scene.robot)));
  if (!scene.start.empty()) facts.push_back(state_fact("start", scene.start));
  if (!scene.goal.empty()) facts.push_back(state_fact("goal", scene.goal));
  if (!scene.other_goals.empty()) facts.push_back(count_fact("other goals", scene.other_goals.size()));
  if (!scene.prices.empty()) facts.push_back(prices_fact(scene.prices));
  if (scene.grid) {
    facts.push_back({"grid", fmt::format("cell {}, {} angles", rounded_text(scene.grid->cell), scene.grid->angles),
                     fmt::format("[{}, {}]", json_number(scene.grid->cell), scene.grid->angles)});
  }
}

Fact joint_fact(const ArmVariable& variable, std::size_t number) {
  const char* unit = variable.slides ? "m" : "rad";
  std::string text = variable.name + ": ";
  text += variable.continuous ? "turns without end"
                              : fmt::format("{} {} to {} {}", variable.slides ? "slides" : "turns",
                                            human_number(variable.low), human_number(variable.high), unit);
  if (variable.speed > 0.0) text += fmt::format(", at most {} {}/s", human_number(variable.speed), unit);
  JsonObject json;
  json.add("name", variable.name);
  json.add("type", variable.slides ? "prismatic" : variable.continuous ? "continuous" : "revolute");
  json.add("low", variable.low, "high", variable.high);
  if (variable.speed > 0.0) json.add("speed", variable.speed);
  return {fmt::format("joint {}", number), std::move(text), json.closed()};
}

}  // namespace

std::vector<Fact> facts_of(const Scene& scene, const Execution& execution) {
  const WorldAccount world = account_of(scene, execution);
  std::vector<Fact> facts{text_fact("source", world.source), text_fact("kind", world.kind)};
  scene.map ? add_map_facts(*scene.map, facts) : add_obstacle_facts(scene, facts);
  if (const Box box = obstacle_box(scene, execution); scene.map || !box.empty()) facts.push_back(box_fact("box", box));
  if (scene.bounds && !scene.map) facts.push_back(box_fact("bounds", *scene.bounds));
  facts.push_back(text_fact("hash", world.hash));
  add_problem_facts(scene, facts);
  return facts;
}

std::string facts_json(const std::vector<Fact>& facts) {
  std::string text = R"({"schema": "warren.info/1")";
  for (const Fact& fact : facts) text += ",\n " + json_string(fact.name) + ": " + fact.json;
  return text + "}\n";
}

std::vector<Fact> facts_of(const ArmModel& model) {
  std::vector<Fact> facts{{"robot", model.name, json_string(model.name)}, {"kind", "arm", json_string("arm")}};
  for (std::size_t i = 0; i < model.variables.size(); ++i) facts.push_back(joint_fact(model.variables[i], i + 1));
  facts.push_back(count_fact("moving joints", model.joints.size()));
  facts.push_back(count_fact("links", model.links.size()));
  std::array<std::size_t, 5> solids{};
  for (const ArmLink& link : model.links) {
    for (const Solid& solid : link.solids) ++solids[static_cast<std::size_t>(solid.kind)];
  }
  constexpr std::array<const char*, 5> kinds{"spheres", "boxes", "cylinders", "capsules", "hulls"};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (solids[kind] > 0) facts.push_back(count_fact(kinds[kind], solids[kind]));
  }
  facts.push_back(count_fact("pairs", model.pairs.size()));
  const auto add_lines = [&](const char* name, const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      facts.push_back({fmt::format("{} {}", name, i + 1), lines[i], json_string(lines[i])});
    }
  };
  add_lines("assumed", model.assumed);
  add_lines("told", model.told);
  return facts;
}

}  // namespace warren
