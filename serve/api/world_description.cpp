// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/world_description.hpp"

#include <fmt/format.h>

#include <array>

#include "parallel/deadline.hpp"
#include "scenes/scene/unit_of.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"
#include "serve/api/service_limits.hpp"
#include "serve/api/world_layers.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/steps/kind_of_problem.hpp"

namespace warren::serve {
namespace {

std::string box_json(const Box& box) {
  return json_list(std::span<const double>(std::array{box.min.x, box.min.y, box.max.x, box.max.y}));
}

std::string tiles_json(const TileGrid& grid, const std::string& hash) {
  JsonObject json;
  json.add("url", "/v/" + hash + "/tiles/{z}/{x}/{y}.png");
  json.add("pixels", std::uint32_t{TileGrid::pixels});
  json.add("levels", std::uint32_t{grid.levels});
  json.add_json("corner", json_list(std::span<const double>(std::array{grid.corner.x, grid.corner.y})));
  json.add("span", grid.span);
  return json.closed();
}

/// Those that a question may name.
std::string planners_json(const ServedWorld& world) {
  std::string text = "[";
  if (world.query() == nullptr) {
    for (const PlannerKind planner : planners_there_are()) {
      try {
        choose_solver({.planner = planner}, world.outline(), {.robot = world.robot(), .clearance = world.clearance()});
        text += (text.size() > 1 ? "," : "") + json_string(name_of(planner));
      } catch (const UsageError&) {  // not in this world
      }
    }
  }
  return text + "]";
}

/// A lattice in a file has its walls made later.
std::string words_of_world(const Scene& outline) {
  if (outline.maze && outline.walls.size() == 0) {
    return fmt::format("{} x {} maze", grouped(outline.maze->rows), grouped(outline.maze->cols));
  }
  return description_of(outline);
}

void add_line(std::string& text, std::string_view name, std::string_view kind, std::string_view help, double value) {
  fmt::format_to(std::back_inserter(text), "# HELP warren_{} {}\n# TYPE warren_{} {}\nwarren_{} {}\n", name, help, name,
                 kind, name, value);
}

}  // namespace

std::string description_json(const ServedWorld& world, const WorldLayers& layers, const ServiceLimits& limits) {
  const Scene& outline = world.outline();
  JsonObject json;
  json.add("schema", "warren.service/1");
  json.add("source", outline.source);
  json.add("opened_as", world.is_roadmap() ? "roadmap" : "world");
  json.add("description", words_of_world(outline));
  json.add("hash", world.hash());
  json.add("unit", unit_of(outline));
  json.add_json("box", box_json(world.box()));
  json.add("robot", robot_text(world.robot()));
  json.add("state_size", std::uint64_t{state_size(world.robot())});
  json.add("clearance", world.clearance());
  json.add_json("start", json_list(std::span<const double>(outline.start)));
  json.add_json("goal", json_list(std::span<const double>(outline.goal)));
  json.add("asks_roadmap", world.query() != nullptr);
  json.add_json("planners", planners_json(world));
  json.add("budget_ms", 1e3 * limits.budget_s);
  json.add("changed", world.is_changed());
  json.add("writable", limits.writable && !outline.map && world.why_fixed().empty());
  json.add("wants_token", limits.wants_token);
  json.add_json("tiles", tiles_json(world.tiles().grid(), world.hash()));
  json.add_json("layers", layers.json());
  return json.closed() + "\n";
}

std::string metrics_text(const HttpFigures& f, const KeptBytes& kept) {
  std::string text;
  const auto number = [](auto count) { return static_cast<double>(count); };
  add_line(text, "connections", "gauge", "Open connections.", number(f.connections));
  add_line(text, "connections_total", "counter", "Connections accepted.", number(f.accepted));
  add_line(text, "connections_gave_way_total", "counter", "Connections closed for others.", number(f.gave_way));
  add_line(text, "requests_timed_out_total", "counter", "Requests that did not come in time.", number(f.timed_out));
  add_line(text, "requests_abandoned_total", "counter", "Clients who left before their answer.", number(f.abandoned));
  add_line(text, "requests_working", "gauge", "Requests worked on or waiting for it.", number(f.working));
  add_line(text, "requests_worked_total", "counter", "Requests that were worked on.", number(f.worked));
  add_line(text, "wait_seconds_total", "counter", "Time that they waited for a thread.", f.waited_s);
  add_line(text, "work_seconds_total", "counter", "Time that was worked on them.", f.worked_s);
  text += "# HELP warren_responses_total Answers by the first digit of their status.\n";
  text += "# TYPE warren_responses_total counter\n";
  for (std::size_t digit = 1; digit < f.said.size(); ++digit) {
    fmt::format_to(std::back_inserter(text), "warren_responses_total{{status=\"{}xx\"}} {}\n", digit, f.said[digit]);
  }
  add_line(text, "kept_tile_bytes", "gauge", "Tiles that are kept.", number(kept.tile_bytes));
  add_line(text, "kept_path_bytes", "gauge", "Paths that are kept.", number(kept.path_bytes));
  add_line(text, "resident_bytes", "gauge", "Memory that the process holds.", number(resident_bytes()));
  return text;
}

}  // namespace warren::serve
