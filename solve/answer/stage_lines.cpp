// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/stage_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scenes/text/human_units.hpp"

namespace warren {
namespace {

/// In the order of the work; of stages that are not here nothing is counted, and they come before "optimise".
struct Link {
  std::string_view key;
  std::string_view label;
  std::uint64_t (*count)(const Answer&) = nullptr;  ///< null: nothing is counted
  std::string (*counted)(const Answer&) = nullptr;
};

constexpr std::array links{
    Link{"index", "index of obstacles"},
    Link{"sample", "samples drawn", [](const Answer& a) { return a.counters.samples; },
         [](const Answer& a) { return fmt::format("samples, {} kept", grouped(a.counters.kept)); }},
    Link{"neighbours", "index built", [](const Answer& a) { return a.counters.kept; },
         [](const Answer&) { return std::string("milestones"); }},
    Link{"queries", "neighbours asked", [](const Answer& a) { return a.counters.neighbour_queries; },
         [](const Answer&) { return std::string("queries"); }},
    Link{"checks", "edges checked", [](const Answer& a) { return a.counters.edges_checked; },
         [](const Answer& a) { return fmt::format("edges, {} free", grouped(a.counters.edges_free)); }},
    Link{"rows", "CSR rows", [](const Answer& a) { return a.roadmap.milestones; },
         [](const Answer& a) {
           return fmt::format("rows, {}", human_bytes(static_cast<double>(a.counters.row_bytes)));
         }},
    Link{"reduction", "reduction", [](const Answer& a) { return a.roadmap.milestones; },
         [](const Answer&) { return std::string("vertices"); }},
    Link{"components", "components", [](const Answer& a) { return a.roadmap.milestones; },
         [](const Answer& a) { return "vertices, " + counted(a.roadmap.components, "component", "components"); }},
    Link{"expansion", "queue and search", [](const Answer& a) { return a.counters.expanded; },
         [](const Answer& a) {
           return fmt::format("expanded, {} pushes, {} decreases", grouped(a.counters.pushes),
                              grouped(a.counters.decreases));
         }},
    Link{"optimise", "pulled taut"},
    Link{"verify", "verified", path_points, [](const Answer&) { return std::string("points"); }},
    Link{"bound", "lower bound"},
};
constexpr std::size_t first_of_the_end = links.size() - 3;

std::size_t place_of(std::string_view key) {
  const auto at = std::ranges::find_if(links, [&](const Link& link) { return link.key == key; });
  return static_cast<std::size_t>(at - links.begin());
}

bool is_sum(std::string_view key) {
  constexpr std::array<std::string_view, 11> sums{"read",  "generate", "index",  "sample",   "neighbours", "connect",
                                                  "graph", "reduce",   "search", "optimise", "verify"};
  return std::ranges::find(sums, key) != sums.end();
}

/// In the order of the work, without what was counted.
std::vector<StageLine> plain_lines(const std::vector<StageCost>& costs) {
  std::vector<StageLine> lines;
  for (const StageCost& cost : costs) {
    lines.push_back({.key = cost.name, .label = cost.name, .wall_s = cost.wall_s, .cpu_s = cost.cpu_s, .counted = {}});
    std::ranges::replace(lines.back().key, ' ', '_');
  }
  const auto rank = [](const StageLine& line) {
    const std::size_t place = place_of(line.key);
    return place == links.size() ? 2 * first_of_the_end - 1 : 2 * place;
  };
  std::ranges::stable_sort(lines, [&](const StageLine& a, const StageLine& b) { return rank(a) < rank(b); });
  return lines;
}

}  // namespace

std::vector<StageLine> stage_lines(const Answer& answer) {
  std::vector<StageLine> lines = plain_lines(answer.costs);
  for (StageLine& line : lines) {
    const std::size_t place = place_of(line.key);
    if (place == links.size()) continue;
    const Link& link = links[place];
    line.label = link.label;
    if (link.count != nullptr) line.count = link.count(answer);
    if (line.count > 0) line.counted = link.counted(answer);
  }
  return lines;
}

std::vector<std::pair<std::string, double>> keyed_seconds(const StageTimes& sums, const std::vector<StageCost>& costs) {
  std::vector<std::pair<std::string, double>> keyed;
  for (const auto& [name, seconds] : named_stages(sums)) keyed.emplace_back(name, seconds);
  for (const StageLine& line : plain_lines(costs)) {
    if (!is_sum(line.key)) keyed.emplace_back(line.key, line.wall_s);
    keyed.emplace_back(line.key + "_cpu", line.cpu_s);
  }
  return keyed;
}

}  // namespace warren
