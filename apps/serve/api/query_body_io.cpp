// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/query_body_io.hpp"

#include <fmt/format.h>

#include <string>

#include "apps/serve/graphs/json_body_io.hpp"
#include "apps/serve/http/http_message.hpp"
#include "solve/question/question.hpp"

namespace warren::serve {
namespace {

[[noreturn]] void refuse(std::string_view where, std::string_view expected) {
  throw HttpError(400, "bad_request", where, fmt::format("{}: expected {}", where, expected));
}

std::vector<double> state_of(const OrderedJson& json, std::string_view key) {
  constexpr std::size_t most = 6;
  std::vector<double> state;
  if (!json.is_array() || json.size() > most) refuse(key, "a list of at most 6 numbers");
  for (const OrderedJson& number : json) {
    if (!number.is_number()) refuse(key, "a list of numbers");
    state.push_back(number.get<double>());
  }
  return state;
}

bool flag_of(const OrderedJson& json, std::string_view key) {
  if (!json.is_boolean()) refuse(key, "true or false");
  return json.get<bool>();
}

double budget_of(const OrderedJson& json) {
  constexpr double a_ms = 1e-3;
  if (!json.is_number() || !(json.get<double>() > 0.0)) refuse("budget_ms", "a number above 0");
  return a_ms * json.get<double>();
}

RobotSpec robot_of(const OrderedJson& json) {
  if (!json.is_string()) refuse("robot", "what --robot takes");
  return robot_value("robot", json.get<std::string>());
}

double clearance_of(const OrderedJson& json) {
  if (!json.is_number()) refuse("clearance", "a number");
  return json.get<double>();
}

PlannerKind planner_of(const OrderedJson& json) {
  const auto planner = json.is_string() ? enum_named<PlannerKind>(json.get<std::string>()) : std::nullopt;
  if (!planner) refuse("planner", "the name of a planner");
  return *planner;
}

void take(const std::string& key, const OrderedJson& value, QueryBody& body) {
  if (key == "start") {
    body.question.start = state_of(value, "start");
  } else if (key == "goal") {
    body.question.goal = state_of(value, "goal");
  } else if (key == "robot") {
    body.question.robot = robot_of(value);
  } else if (key == "clearance") {
    body.question.clearance = clearance_of(value);
  } else if (key == "optimise") {
    body.question.optimise = flag_of(value, "optimise");
  } else if (key == "explain") {
    body.question.explains = flag_of(value, "explain");
  } else if (key == "path") {
    body.tells_path = flag_of(value, "path");
  } else if (key == "planner") {
    body.question.planner = planner_of(value);
  } else if (key == "budget_ms") {
    body.question.budget_s = budget_of(value);
  } else {
    refuse("body", "the keys start, goal, robot, clearance, optimise, planner, budget_ms, explain, path");
  }
}

}  // namespace

QueryBody read_query_body(std::string_view text) {
  QueryBody body;
  const OrderedJson json = json_object_of(text, deepest_json, {});
  for (const auto& [key, value] : json.items()) take(key, value, body);
  return body;
}

}  // namespace warren::serve
