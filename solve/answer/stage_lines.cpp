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
  std::uint64_t (*count)(const Answer&);
  std::string (*counted)(const Answer&);
};

std::uint64_t nothing(const Answer&) { return 0; }
std::string no_words(const Answer&) { return {}; }

constexpr std::array links{
    Link{"index", "index of obstacles", nothing, no_words},
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
         [](const Answer& a) { return fmt::format("vertices, {} components", grouped(a.roadmap.components)); }},
    Link{"expansion", "queue and search", [](const Answer& a) { return a.counters.expanded; },
         [](const Answer& a) {
           return fmt::format("expanded, {} pushes, {} decreases", grouped(a.counters.pushes),
                              grouped(a.counters.decreases));
         }},
    Link{"optimise", "pulled taut", nothing, no_words},
    Link{"verify", "verified", path_points, [](const Answer&) { return std::string("points"); }},
};
constexpr std::size_t first_of_the_end = links.size() - 2;

std::size_t place_of(std::string_view key) {
  const auto at = std::find_if(links.begin(), links.end(), [&](const Link& link) { return link.key == key; });
  return static_cast<std::size_t>(at - links.begin());
}

}  // namespace

std::vector<StageLine> stage_lines(const Answer& answer) {
  std::vector<StageLine> lines;
  for (const StageCost& cost : answer.costs) {
    StageLine line{.key = cost.name, .label = cost.name, .wall_s = cost.wall_s, .cpu_s = cost.cpu_s, .counted = {}};
    std::replace(line.key.begin(), line.key.end(), ' ', '_');
    if (const std::size_t place = place_of(line.key); place < links.size()) {
      line.label = links[place].label;
      line.count = links[place].count(answer);
      if (line.count > 0) line.counted = links[place].counted(answer);
    }
    lines.push_back(std::move(line));
  }
  const auto rank = [](const StageLine& line) {
    const std::size_t place = place_of(line.key);
    return place == links.size() ? 2 * first_of_the_end - 1 : 2 * place;
  };
  std::stable_sort(lines.begin(), lines.end(),
                   [&](const StageLine& a, const StageLine& b) { return rank(a) < rank(b); });
  return lines;
}

bool is_promised_stage(std::string_view key) {
  constexpr std::array<std::string_view, 11> promised{"read",       "generate", "index", "sample",
                                                      "neighbours", "connect",  "graph", "reduce",
                                                      "search",     "optimise", "verify"};
  return std::find(promised.begin(), promised.end(), key) != promised.end();
}

}  // namespace warren
