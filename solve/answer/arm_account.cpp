// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/arm_account.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"

namespace warren {
namespace {

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
  json.add("low", variable.low);
  json.add("high", variable.high);
  if (variable.speed > 0.0) json.add("speed", variable.speed);
  return {fmt::format("joint {}", number), std::move(text), json.closed()};
}

Fact counted_fact(const char* name, std::size_t count) { return {name, grouped(count), std::to_string(count)}; }

}  // namespace

std::vector<Fact> facts_of(const ArmModel& model) {
  std::vector<Fact> facts{{"robot", model.name, json_string(model.name)}, {"kind", "arm", json_string("arm")}};
  for (std::size_t i = 0; i < model.variables.size(); ++i) facts.push_back(joint_fact(model.variables[i], i + 1));
  facts.push_back(counted_fact("moving joints", model.joints.size()));
  facts.push_back(counted_fact("links", model.links.size()));
  std::array<std::size_t, 5> solids{};
  for (const ArmLink& link : model.links) {
    for (const Solid& solid : link.solids) ++solids[static_cast<std::size_t>(solid.kind)];
  }
  constexpr std::array<const char*, 5> kinds{"spheres", "boxes", "cylinders", "capsules", "hulls"};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (solids[kind] > 0) facts.push_back(counted_fact(kinds[kind], solids[kind]));
  }
  facts.push_back(counted_fact("pairs", model.pairs.size()));
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
