// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/write_answer_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <variant>

#include "scenes/scene/arm_model.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/answer/explanation_text.hpp"

namespace warren {
namespace {

constexpr std::uint64_t hash_factor = 0x100000001b3U;

constexpr std::array<std::uint64_t, 7> powers_of_hash_factor() {
  std::array<std::uint64_t, 7> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * hash_factor;
  return powers;
}

/// Nothing is said with null.
void add_text(JsonObject& json, std::string_view key, const std::string& text) {
  json.add_or_null(key, !text.empty(), text);
}

void add_state(JsonObject& json, std::string_view key, const std::vector<double>& state) {
  json.add_json(key, state.empty() ? "null" : json_list(std::span(state)));
}

std::string world_json(const WorldAccount& world) {
  JsonObject json;
  json.add("source", world.source, "kind", world.kind, "walls", world.walls);
  if (world.polygons > 0) json.add("polygons", world.polygons);
  if (world.spheres > 0) json.add("spheres", world.spheres);
  if (world.boxes > 0) json.add("boxes", world.boxes);
  if (world.solids > 0) json.add("solids", world.solids);
  json.add("hash", world.hash);
  if (!world.unit.empty()) json.add("unit", world.unit);
  return json.closed();
}

std::string json_of(const std::vector<std::uint64_t>& numbers) { return json_list(std::span(numbers)); }
std::string json_of(const std::vector<WrongEdge>& edges) {
  return json_list_of(edges, ",", [](const WrongEdge& wrong) {
    JsonObject json;
    json.add_json("edge", json_list(std::span<const std::uint32_t>(std::array{wrong.from, wrong.to})));
    json.add("depth", wrong.depth);
    return json.closed();
  });
}

std::string counters_json(const Counters& counters) {
  JsonObject json;
  json.add("samples", counters.samples, "kept", counters.kept, "neighbour_queries", counters.neighbour_queries);
  json.add("edges_checked", counters.edges_checked, "edges_free", counters.edges_free, "expanded", counters.expanded);
  json.add("rounds", counters.rounds, "refused", counters.refused);
  if (counters.pushes > 0) json.add("pushes", counters.pushes, "decreases", counters.decreases);
  if (counters.row_bytes > 0) json.add("row_bytes", counters.row_bytes);
  return json.closed();
}

std::string separation_json(const Separation& separation) {
  if (!separation.is_known()) return "null";
  return json_object("start_size", separation.start_size, "goal_size", separation.goal_size, "nearest_gap",
                     separation.nearest_gap);
}

std::string blocked_json(const BlockedEnd& blocked) {
  JsonObject json;
  json.add("end", blocked.is_start ? "start" : "goal", "by", blocked.by);
  add_state(json, "free_place", blocked.free_place);
  json.add_or_null("distance", !blocked.free_place.empty(), blocked.distance);
  add_text(json, "hint", blocked.hint);
  json.add("room", blocked.room, "needed", blocked.needed, "depth", blocked.depth);
  return json.closed();
}

/// Is what the planner made small more than the length? Of a differential drive turning counts, but the answer, whose
/// path has poses where it turns on the spot, has no such cost.
bool tells_costs(const Answer& answer) {
  constexpr double rounding = 1e-9;
  return answer.cost || std::ranges::any_of(answer.improvements, [](const Improvement& better) {
           return std::abs(better.cost - better.length) > rounding * better.cost;
         });
}

std::string improvements_json(const Answer& answer) {
  const bool with_cost = tells_costs(answer);
  return json_list_of(answer.improvements, ", ", [&](const Improvement& improvement) {
    JsonObject json;
    json.add("iterations", improvement.iterations, "seconds", improvement.seconds, "length", improvement.length);
    if (with_cost) json.add("cost", improvement.cost);
    json.add("by", improvement.by);
    return json.closed();
  });
}

std::string price_json(const PriceParts& price) {
  return json_object("clearance", price.clearance, "areas", price.areas, "turning", price.turning, "cusps", price.cusps,
                     "reverse", price.reverse);
}

std::string list_json(const std::vector<std::vector<double>>& states) {
  return json_list_of(states, ", ", [](const std::vector<double>& state) { return json_list(std::span(state)); });
}

std::string reached_json(const GoalReached& reached) {
  JsonObject json;
  add_state(json, "asked", reached.asked);
  json.add("distance", reached.distance, "distance_bound", reached.distance_bound);
  return json.closed();
}

std::string holes_json(const std::vector<MapHole>& holes) {
  return json_list_of(holes, ", ", [](const MapHole& hole) {
    JsonObject json;
    json.add("id", hole.id);
    const Box& b = hole.box;
    json.add_json("box", json_list(std::span<const double>(std::array{b.min.x, b.min.y, b.max.x, b.max.y})));
    return json.closed();
  });
}

void add_choices(JsonObject& json, const Answer& answer) {
  if (answer.goal_index) json.add("goal_index", *answer.goal_index);
  if (answer.goal_reached) json.add_json("goal_reached", reached_json(*answer.goal_reached));
  if (answer.hole_size) json.add_json("class", json_list(std::span(answer.passed), ", "));
  if (answer.hole_size) json.add("hole_size", *answer.hole_size);
  if (!answer.holes.empty()) json.add_json("holes", holes_json(answer.holes));
  if (!answer.order.empty()) json.add_json("order", json_list(std::span(answer.order)));
}

void add_quality(JsonObject& json, const Answer& answer) {
  if (answer.optimal) json.add("optimal", true);
  if (answer.cost) json.add("cost", *answer.cost);
  if (answer.price) json.add_json("price", price_json(*answer.price));
  if (answer.price) json.add("cost_error", answer.price->error);
  if (answer.lower_bound) json.add("lower_bound", *answer.lower_bound);
  if (const auto gap = gap_of(answer)) json.add("gap", *gap);
  if (!answer.bound_of.empty()) json.add("bound_of", answer.bound_of);
  add_choices(json, answer);
  if (const auto& keeping = answer.keeping) {
    json.add("kept", keeping->kept, "kept_cost", keeping->kept_cost, "new_cost", keeping->new_cost);
  }
  if (answer.turn_rad) json.add("turn_rad", *answer.turn_rad);
  if (!answer.iterations) return;
  json.add("iterations", *answer.iterations);
  json.add_json("improvements", improvements_json(answer));
}

void add_outcome(JsonObject& json, const Answer& answer) {
  json.add("schema", "warren.answer/1", "warren_version", WARREN_VERSION);
  json.add("status", answer.refuted ? "refuted" : name_of(answer.outcome));
  const std::string_view ended = answer.stop_reason ? name_of(*answer.stop_reason) : std::string_view(answer.ended_by);
  if (!ended.empty()) json.add("stopped_by", ended);
  json.add("verified", answer.verified);
  json.add_or_null("length", answer.verified, answer.length);
  json.add_or_null("min_clearance", answer.verified, answer.min_clearance);
  json.add("raw_length", answer.raw_length);
  if (answer.blocked) json.add_json("blocked", blocked_json(*answer.blocked));
  add_quality(json, answer);
}

/// A world that was never read leaves the problem open.
void add_open_problem(JsonObject& json, const Answer& answer) {
  for (const char* key : {"start", "goal", "clearance", "contact", "sampler"}) json.add_json(key, "null");
  JsonObject world;
  world.add("source", answer.world.source);
  json.add_json("world", world.closed());
}

std::vector<double> numbers_of_pose(const Eigen::Isometry3d& pose) {
  const Vec3 at = pose.translation();
  const Eigen::Quaterniond turn(pose.linear());
  return {at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w()};
}

void add_arm(JsonObject& json, const ArmModel& model, const std::vector<std::string>& told) {
  const auto name_json = [](const ArmVariable& variable) { return json_string(variable.name); };
  json.add_json("joints", json_list_of(model.variables, ", ", name_json));
  json.add_json("assumed", json_list(std::span<const std::string>(model.assumed), ", "));
  std::vector<std::string> all = model.told;
  all.insert(all.end(), told.begin(), told.end());
  json.add_json("told", json_list(std::span<const std::string>(all), ", "));
}

/// What the question says beyond start, goal and body, so that a judge knows it.
void add_asked(JsonObject& json, const Problem& problem) {
  const GoalRule& rule = problem.rule;
  if (!rule.others.empty()) json.add_json("goals", list_json(rule.goals(problem.goal)));
  if (rule.tolerance)
    json.add_json("goal_tolerance", std::isinf(*rule.tolerance) ? "\"inf\"" : json_number(*rule.tolerance));
  if (rule.region) json.add("goal_region", *rule.region);
  if (rule.heading_rad) json.add("goal_heading_rad", *rule.heading_rad);
  if (!rule.visit.empty()) json.add_json("visit", list_json(rule.visit));
  if (!problem.via.empty()) json.add_json("via", list_json(problem.via));
  if (rule.back) json.add("return", true);
  if (problem.prices.empty()) return;
  json.add_json("prices", json_list(std::span<const std::string>(price_lines(problem.prices)), ", "));
}

void add_problem(JsonObject& json, const Answer& answer) {
  if (answer.world.kind.empty()) return add_open_problem(json, answer);
  add_state(json, "start", answer.problem.start);
  add_state(json, "goal", answer.problem.goal);
  if (answer.problem.goal_pose) add_state(json, "goal_pose", numbers_of_pose(*answer.problem.goal_pose));
  json.add("robot", robot_text(answer.problem.robot));
  add_asked(json, answer.problem);
  if (answer.problem.robot.files && answer.problem.robot.files->read) {
    add_arm(json, *answer.problem.robot.files->read, answer.problem.told);
  }
  json.add("clearance", answer.problem.clearance, "contact", name_of(answer.problem.contact));
  add_text(json, "sampler", answer.sampler);
  json.add_json("world", world_json(answer.world));
}

void add_work(JsonObject& json, const Answer& answer) {
  add_text(json, "planner", answer.planner);
  if (!answer.pipeline.empty()) json.add("pipeline", answer.pipeline);
  add_text(json, "search", answer.search);
  json.add("seed", answer.seed, "threads", std::uint64_t{answer.threads});
  JsonObject options;
  for (const NamedFigure& option : answer.options) options.add_json(option.name, figure_json(option.value));
  json.add_json("options", options.closed());
  JsonObject roadmap;
  const RoadmapSize& size = answer.roadmap;
  roadmap.add("milestones", size.milestones, "edges", size.edges, "components", size.components);
  if (answer.cells) roadmap.add("cells", answer.cells->cells, "adjacencies", answer.cells->adjacencies);
  json.add_json("roadmap", roadmap.closed());
  for (const auto* figures : {&answer.figures, &answer.path_figures}) {
    for (const NamedFigure& figure : *figures) json.add_json(figure.name, figure_json(figure.value));
  }
  if (answer.outcome == Outcome::not_connected && !answer.refuted) {
    json.add_json("components", separation_json(answer.separation));
  }
  json.add_json("counters", counters_json(answer.counters));
  if (answer.explained) json.add_json("explained", explanation_json(answer));
  JsonObject stages;
  for (const auto& [key, seconds] : keyed_seconds(answer.seconds, answer.costs)) stages.add(key, seconds);
  json.add_json("stages_s", stages.closed());
  json.add("solve_s", answer.solve_s, "peak_memory_bytes", std::uint64_t{answer.peak_memory_bytes});
}

std::string json_head(const Answer& answer, const Execution& execution) {
  JsonObject json(",\n ", ": ");
  add_outcome(json, answer);
  add_problem(json, answer);
  add_work(json, answer);
  if (!answer.tells_path && answer.verified) {
    json.add("path_points", path_points(answer));
    json.add("path_hash", answer.handed ? answer.handed->hash : path_hash(answer, execution));
  }
  return json.open() + ",\n ";
}

/// The list of the states, or of the points where a state is no more.
void write_states(const Path<Vec2>& path, const StateList& states, const Execution& execution,
                  const std::function<void(std::string_view)>& write) {
  constexpr std::size_t piece = 1 << 14;
  const std::size_t count = states.empty() ? path.size() : states.size();
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const double> state = states.empty() ? std::span<const double>(&path[i].x, 2) : states[i];
    text.append(i == 0 ? "[" : ", [");
    for (std::size_t k = 0; k < state.size(); ++k) append_json_number(text += k == 0 ? "" : ", ", state[k]);
    text.append("]");
    if (i % piece == piece - 1) {
      execution.check();
      write(text);
      text.clear();
    }
  }
  write(text + "]");
}

void append_alternative(std::string& text, const AlternativePath& other) {
  JsonObject json;
  json.add("cost", other.cost, "length", other.length);
  json.add_json("price", price_json(other.price));
  json.add_json("class", json_list(std::span(other.passed), ", "));
  json.add("min_clearance", other.min_clearance);
  text += json.open() + ", \"path\": ";
}

}  // namespace

/// A byte of zeros changes nothing but for the factor, and coordinates of cells begin with five, most of them: then no
/// branch depends on the number. Each byte waits for the one before it, so every multiplication that is left out
/// counts.
void PathHash::add(double number) {
  constexpr std::size_t most_zeros = 5;
  constexpr auto powers = powers_of_hash_factor();
  const auto bits = std::bit_cast<std::uint64_t>(number);
  std::size_t byte = std::min<std::size_t>(most_zeros, static_cast<unsigned>(std::countr_zero(bits)) / 8);
  last_ = last_ * powers[byte + 1] ^ (bits >> 8 * byte & 0xffU);
  while (++byte < 8) last_ = last_ * hash_factor ^ (bits >> 8 * byte & 0xffU);
}

std::string PathHash::text() const { return fmt::format("{:016x}", last_ * hash_factor); }

std::string path_hash(const Answer& answer, const Execution& execution) {
  PathHash hash;
  for (std::size_t i = 0; i < answer.state_count(); ++i) {
    execution.poll(i);
    for (const double number : answer.numbers(i)) hash.add(number);
  }
  return hash.text();
}

std::string violation_json(const Violation& violation) {
  return fmt::format(R"({{"leg": {}, "distance": {}, "obstacle": {}}})", violation.leg, json_number(violation.distance),
                     json_string(violation.obstacle));
}

std::vector<std::pair<const char*, double>> named_stages(const StageTimes& s) {
  std::vector<std::pair<const char*, double>> named;
  if (s.read > 0.0) named.emplace_back("read", s.read);
  if (s.generate > 0.0) named.emplace_back("generate", s.generate);
  named.insert(named.end(), {{"index", s.index},
                             {"sample", s.sample},
                             {"neighbours", s.neighbours},
                             {"connect", s.connect},
                             {"graph", s.graph}});
  if (s.reduce > 0.0) named.emplace_back("reduce", s.reduce);
  named.emplace_back("search", s.search);
  if (s.optimise > 0.0) named.emplace_back("optimise", s.optimise);
  named.emplace_back("verify", s.verify);
  return named;
}

std::string figure_json(const Figure& figure) {
  return std::visit([](const auto& value) { return json_of(value); }, figure);
}

void write_answer_json(const Answer& answer, const Execution& execution,
                       const std::function<void(std::string_view)>& write) {
  write(json_head(answer, execution));
  if (const auto& refuted = answer.refuted) {
    const std::string cost = refuted->cost ? fmt::format(", \"cost\": {}", json_number(*refuted->cost)) : "";
    write(fmt::format(R"("refuted": {{"length": {}{}, "first_violation": {}, "path": )", json_number(refuted->length),
                      cost, violation_json(refuted->violation)));
    write_states(refuted->path, refuted->states, execution, write);
    write("},\n ");
  }
  if (!answer.alternatives.empty()) {
    std::string text = "\"alternatives\": [";
    for (const AlternativePath& other : answer.alternatives) {
      append_alternative(text, other);
      write(text);
      write_states(answer.tells_path ? other.path : Path<Vec2>{}, {}, execution, write);
      text = "},\n  ";
    }
    write("}],\n ");
  }
  write("\"path\": ");
  answer.tells_path ? write_states(answer.path, answer.states, execution, write) : write("[]");
  write("}\n");
}

}  // namespace warren
