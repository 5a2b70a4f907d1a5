// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/write_answer_io.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace warren {
namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json state_or_null(const std::vector<double>& state) { return state.empty() ? Json(nullptr) : Json(state); }

Json world_json(const WorldAccount& world) {
  Json json{{"source", world.source}, {"kind", world.kind}, {"walls", world.walls}};
  if (world.polygons > 0) json["polygons"] = world.polygons;
  if (world.spheres > 0) json["spheres"] = world.spheres;
  if (world.boxes > 0) json["boxes"] = world.boxes;
  json["hash"] = world.hash;
  return json;
}

Json options_json(const Answer& answer) {
  Json options = Json::object();
  for (const auto& [name, value] : answer.options) options[name] = Json::parse(value);
  return options;
}

Json counters_json(const Counters& counters) {
  return {{"samples", counters.samples},
          {"neighbour_queries", counters.neighbour_queries},
          {"edges_checked", counters.edges_checked},
          {"expanded", counters.expanded},
          {"rounds", counters.rounds},
          {"refused", counters.refused}};
}

Json stages_json(const StageTimes& seconds) {
  Json stages = Json::object();
  for (const auto& [name, value] : named_stages(seconds)) stages[name] = value;
  return stages;
}

void add_outcome(Json& json, const Answer& answer) {
  json["schema"] = "warren.answer/1";
  json["warren_version"] = WARREN_VERSION;
  json["status"] = answer.refuted ? "refuted" : name_of(answer.outcome);
  if (answer.stop_reason) json["stopped_by"] = stop_name(*answer.stop_reason);
  json["verified"] = answer.verified;
  json["length"] = answer.verified ? finite(answer.length) : Json(nullptr);
  json["min_clearance"] = answer.verified ? finite(answer.min_clearance) : Json(nullptr);
  json["raw_length"] = answer.raw_length ? finite(*answer.raw_length) : Json(nullptr);
  if (answer.optimal) json["optimal"] = true;
  if (answer.cost) json["cost"] = finite(*answer.cost);
  if (answer.turn_rad) json["turn_rad"] = finite(*answer.turn_rad);
}

/// A world that was never read leaves the problem open.
void add_open_problem(Json& json, const Answer& answer) {
  for (const char* key : {"start", "goal", "clearance", "contact", "sampler"}) json[key] = nullptr;
  json["world"]["source"] = answer.world.source;
}

void add_problem(Json& json, const Answer& answer) {
  if (answer.world.kind.empty()) return add_open_problem(json, answer);
  json["start"] = state_or_null(answer.problem.start);
  json["goal"] = state_or_null(answer.problem.goal);
  json["robot"] = robot_text(answer.problem.robot);
  json["clearance"] = answer.problem.clearance;
  json["contact"] = name_of(answer.problem.contact);
  json["sampler"] = text_or_null(answer.sampler);
  json["world"] = world_json(answer.world);
}

void add_work(Json& json, const Answer& answer) {
  json["planner"] = text_or_null(answer.planner);
  if (!answer.pipeline.empty()) json["pipeline"] = answer.pipeline;
  json["search"] = text_or_null(answer.search);
  json["seed"] = answer.seed;
  json["threads"] = answer.threads;
  json["options"] = options_json(answer);
  json["roadmap"] = {{"milestones", answer.roadmap.milestones},
                     {"edges", answer.roadmap.edges},
                     {"components", answer.roadmap.components}};
  if (answer.cells) {
    json["roadmap"]["cells"] = answer.cells->cells;
    json["roadmap"]["adjacencies"] = answer.cells->adjacencies;
  }
  for (const auto* figures : {&answer.figures, &answer.path_figures}) {
    for (const auto& [name, value] : *figures) json[name] = Json::parse(value);
  }
  if (answer.outcome == Outcome::not_connected && !answer.refuted) {
    json["components"] = {{"start_size", answer.separation.start_size},
                          {"goal_size", answer.separation.goal_size},
                          {"nearest_gap", finite(answer.separation.nearest_gap)}};
  }
  json["counters"] = counters_json(answer.counters);
  json["stages_s"] = stages_json(answer.seconds);
  json["solve_s"] = answer.solve_s;
  json["peak_memory_bytes"] = answer.peak_memory_bytes;
}

/// state(i, text) appends the numbers of the i-th of `count` states. Writes the list alone.
template <class State>
void write_path(std::size_t count, const State& state, const Execution& execution,
                const std::function<void(std::string_view)>& write) {
  constexpr std::size_t piece = 1 << 14;
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) {
    text.append(i == 0 ? "[" : ", [");
    state(i, text);
    text.append("]");
    if (i % piece == piece - 1) {
      execution.check();
      write(text);
      text.clear();
    }
  }
  write(text + "]");
}

/// All but the path.
std::string json_head(const Answer& answer) {
  Json json;
  add_outcome(json, answer);
  add_problem(json, answer);
  add_work(json, answer);
  std::string head = "{";
  for (const auto& [key, value] : json.items()) {
    head += json_string(key) + ": " + value.dump(-1, ' ', false, Json::error_handler_t::replace) + ",\n ";
  }
  return head;
}

/// The states, or the points where a state is no more.
void write_states(const Path<Vec2>& path, const StateList& states, const Execution& execution,
                  const std::function<void(std::string_view)>& write) {
  const auto append_point = [&](std::size_t i, std::string& text) {
    text.append(json_number(path[i].x)).append(", ").append(json_number(path[i].y));
  };
  const auto append_state = [&](std::size_t i, std::string& text) {
    for (std::size_t k = 0; k < states.width; ++k) {
      text.append(k == 0 ? "" : ", ").append(json_number(states[i][k]));
    }
  };
  if (states.empty()) {
    write_path(path.size(), append_point, execution, write);
  } else {
    write_path(states.size(), append_state, execution, write);
  }
}

/// The same of a refuted one.
std::string refuted_head(const RefutedPath& refuted) {
  std::string text = fmt::format("\"length\": {}", json_number(refuted.length));
  if (refuted.cost) text += fmt::format(", \"cost\": {}", json_number(*refuted.cost));
  return text + fmt::format(R"(, "first_violation": {})", violation_json(refuted.violation));
}

}  // namespace

std::string_view stop_name(StopReason reason) {
  switch (reason) {
    case StopReason::time:
      return "budget";
    case StopReason::memory:
      return "memory";
    case StopReason::interrupt:
      return "SIGINT";
    case StopReason::terminate:
      return "SIGTERM";
    case StopReason::hang_up:
      return "SIGHUP";
  }
  return "";
}

std::string violation_json(const Violation& violation) {
  return fmt::format(R"({{"leg": {}, "distance": {}, "obstacle": {}}})", violation.leg, json_number(violation.distance),
                     json_string(violation.obstacle));
}

std::vector<std::pair<const char*, double>> named_stages(const StageTimes& s) {
  constexpr double always = -1.0;  // shown even if nothing was done there
  struct Stage {
    const char* name;
    double seconds;
    double only_above;
  };
  std::vector<std::pair<const char*, double>> named;
  for (const Stage& stage :
       {Stage{"read", s.read, 0.0}, Stage{"generate", s.generate, 0.0}, Stage{"index", s.index, always},
        Stage{"sample", s.sample, always}, Stage{"neighbours", s.neighbours, always},
        Stage{"connect", s.connect, always}, Stage{"graph", s.graph, always}, Stage{"reduce", s.reduce, 0.0},
        Stage{"search", s.search, always}, Stage{"optimise", s.optimise, 0.0}, Stage{"verify", s.verify, always}}) {
    if (stage.seconds > stage.only_above) named.emplace_back(stage.name, stage.seconds);
  }
  return named;
}

std::string json_string(std::string_view text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

void write_answer_json(const Answer& answer, const Execution& execution,
                       const std::function<void(std::string_view)>& write) {
  write(json_head(answer));
  if (answer.refuted) {
    write(fmt::format("\"refuted\": {{{}, \"path\": ", refuted_head(*answer.refuted)));
    write_states(answer.refuted->path, answer.refuted->states, execution, write);
    write("},\n ");
  }
  write("\"path\": ");
  write_states(answer.path, answer.states, execution, write);
  write("}\n");
}

}  // namespace warren
