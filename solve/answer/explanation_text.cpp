// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/explanation_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "core/base/printable.hpp"
#include "scenes/text/json_text.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {
namespace {

/// "15.0 %"; of nothing nothing.
std::string share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "0 %";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

/// Of edges_checked: what is neither free nor refused.
std::uint64_t blocked_edges(const Counters& c) { return c.edges_checked - c.edges_free - c.refused; }

PlannerKind planner_of(const Answer& answer) {
  return enum_named<PlannerKind>(answer.planner).value_or(PlannerKind::prm);
}

void add_samples(AnswerLines& lines, const Answer& answer) {
  const Counters& c = answer.counters;
  if (c.samples == 0) return;
  const std::string rounds = c.rounds > 1 ? fmt::format(" in {} rounds", grouped(c.rounds)) : "";
  const PlannerKind planner = planner_of(answer);
  if (is_tree_planner(planner)) {
    return lines.add("samples", fmt::format("{} drawn to grow towards{}", grouped(c.samples), rounds));
  }
  std::string text = fmt::format("{} drawn{}: {} kept", grouped(c.samples), rounds, grouped(c.kept));
  if (!gets_better(planner)) {  // which drop what can make nothing better, too
    // Samplers that look for free states take others, too, and drop them.
    const bool seeks = answer.sampler == "gaussian" || answer.sampler == "bridge" || answer.sampler == "mixture";
    const std::uint64_t dropped = c.samples - c.kept;
    text +=
        fmt::format(", {} ({}) {}", grouped(dropped), share(dropped, c.samples),
                    seeks ? "dropped: in obstacles, or not where the sampler looks" : "in obstacles or out of bounds");
  }
  lines.add("samples", text);
}

void add_edges(AnswerLines& lines, const Answer& answer) {
  const Counters& c = answer.counters;
  if (c.edges_checked == 0) return;
  std::string text =
      fmt::format("{} asked about: {} free, {} ({}) blocked", grouped(c.edges_checked), grouped(c.edges_free),
                  grouped(blocked_edges(c)), share(blocked_edges(c), c.edges_checked));
  if (c.refused > 0) text += fmt::format(", {} too close to tell", grouped(c.refused));
  lines.add("motions", text);
}

void add_components(AnswerLines& lines, const Answer& answer) {
  if (!answer.explained->components) return;
  const ComponentFacts& facts = *answer.explained->components;
  lines.add("components",
            fmt::format("{}; the largest has {} of the milestones, {}", counted(facts.count, "component", "components"),
                        share(facts.largest, facts.milestones),
                        counted(facts.alone, "is a single milestone", "are single milestones")));
  if (facts.joined) {
    lines.add("start, goal",
              fmt::format("in one component, of {}", counted(facts.of_start, "milestone", "milestones")));
  }
}

void add_gap(AnswerLines& lines, const Answer& answer) {
  const Separation& s = answer.separation;
  if (answer.outcome != Outcome::not_connected || answer.refuted || std::isnan(s.nearest_gap)) return;
  const bool in_plane = answer.problem.start.size() <= 3 && !std::isnan(s.near_start[0]);
  lines.add("gap", fmt::format("{} between what start and goal reach{}", human_number(s.nearest_gap),
                               in_plane ? fmt::format(", from {},{} to {},{}", human_number(s.near_start[0]),
                                                      human_number(s.near_start[1]), human_number(s.near_goal[0]),
                                                      human_number(s.near_goal[1]))
                                        : ""));
}

void add_search(AnswerLines& lines, const Answer& answer) {
  const std::uint64_t expanded = answer.counters.expanded;
  if (expanded == 0) return;
  const std::uint64_t milestones = answer.roadmap.milestones;
  std::string text = fmt::format("{} expanded {}", answer.search.empty() ? "search" : answer.search, grouped(expanded));
  const bool one_graph = answer.counters.rounds <= 1 && milestones >= expanded;
  if (one_graph) text += fmt::format(" of {} vertices ({})", grouped(milestones), share(expanded, milestones));
  lines.add("search", text);
}

void add_narrowest(AnswerLines& lines, const Answer& answer) {
  if (!answer.explained->narrowest) return;
  const NarrowPlace& narrow = *answer.explained->narrowest;
  std::string text = fmt::format("{}; {} asked for", text_of(narrow), human_number(answer.problem.clearance));
  if (narrow.one_sample_in) {
    text += fmt::format("; one uniform sample in {} falls there", human_count(*narrow.one_sample_in));
  }
  lines.add("narrowest", text);
}

void add_times(AnswerLines& lines, const Answer& answer) {
  auto stages = named_stages(answer.seconds);
  std::ranges::stable_sort(stages, [](const auto& a, const auto& b) { return a.second > b.second; });
  double whole = 0.0;
  for (const auto& [name, seconds] : stages) whole += seconds;
  std::string text;
  double told = 0.0;
  for (const auto& [name, seconds] : stages) {
    if (told >= 0.9 * whole) break;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name, 100.0 * seconds / whole);
    told += seconds;
  }
  if (!text.empty()) lines.add("time went to", text);
}

std::string components_json(const ComponentFacts& facts) {
  return json_object("count", facts.count, "milestones", facts.milestones, "largest", facts.largest, "alone",
                     facts.alone, "of_start", facts.of_start, "of_goal", facts.of_goal, "joined", facts.joined);
}

/// "--samples 800: why", or "warren build with --samples 800: why".
std::string hint_text(const Hint& hint) {
  if (hint.words.empty()) return hint.why;
  const std::string of = hint.verb.empty() ? "" : fmt::format("warren {} with ", hint.verb);
  return fmt::format("{}{}: {}", of, fmt::join(hint.words, " "), hint.why);
}

std::string hint_json(const Hint& hint) {
  JsonObject json;
  json.add_or_null("command", !hint.verb.empty(), hint.verb);
  json.add_json("options", json_list(std::span<const std::string>(hint.words)));
  json.add("why", hint.why);
  return json.closed();
}

std::string_view option_word(const Answer& answer, std::string_view name) {
  const auto* word = std::get_if<std::string>(figure_named(answer.options, name));
  return word == nullptr ? std::string_view{} : std::string_view{*word};
}

/// The lattice and the middles of cells drop nothing that is worth a word.
std::string samples_note(const Answer& answer) {
  const Counters& c = answer.counters;
  if (c.kept == 0 || c.kept == c.samples) return {};
  return fmt::format("{} drawn, {} dropped: --explain says why", grouped(c.samples), grouped(c.samples - c.kept));
}

std::string room_note(const Answer& answer) {
  if (!answer.blocked || !(answer.blocked->needed > 0.0)) return {};
  if (answer.blocked->by.starts_with("outside") || answer.blocked->by.starts_with("limits")) return {};
  const std::string room = human_number(std::max(0.0, answer.blocked->room));
  const std::string needed = human_number(answer.blocked->needed);
  return fmt::format("{} there, {} needed", room, room == needed ? "a hair more" : needed);
}

std::string lazy_note(const Answer& answer) {
  if (answer.planner != name_of(PlannerKind::lazy_prm) || answer.roadmap.milestones == 0) return {};
  return "lazy-prm asks only about edges that its search meets, and counts these; --planner prm asks about all";
}

std::string doors_note(const Answer& answer) {
  const bool best = answer.search == name_of(SearchMethod::astar) || answer.search == name_of(SearchMethod::dijkstra);
  if (answer.planner != name_of(PlannerKind::cells) || !answer.verified || !best) return {};
  if (option_word(answer, "doors") != "midpoint") return {};
  return "through the middles of doors; --doors funnel finds the shortest way";
}

std::string heuristic_note(const Answer& answer) {
  const auto* searched = std::get_if<double>(figure_named(answer.path_figures, "searched_length"));
  const auto* shortest = std::get_if<double>(figure_named(answer.path_figures, "shortest_length"));
  const auto* expanded = std::get_if<std::uint64_t>(figure_named(answer.path_figures, "shortest_expanded"));
  if (searched == nullptr || shortest == nullptr || expanded == nullptr) return {};
  const double percent = 100.0 * (*searched / *shortest - 1.0);
  const std::string longer =
      *searched > *shortest * (1.0 + 1e-12) ? fmt::format("{:.2g} % longer than", percent) : "as long as";
  return fmt::format("{}: {}, {} the roadmap's shortest, {}; {} places expanded, by euclidean {}",
                     option_word(answer, "heuristic"), human_number(*searched), longer, human_number(*shortest),
                     grouped(answer.counters.expanded), grouped(*expanded));
}

/// In the order of the work; of stages that are not here, for which the one without a key stands, nothing is counted.
struct Link {
  std::string_view key;
  std::string_view label;
  std::string_view items = {};
  std::uint64_t (*count)(const Answer&) = nullptr;       ///< of items; null: nothing is counted
  std::string (*came_of_them)(const Answer&) = nullptr;  ///< behind the items; null: nothing is told
};

constexpr std::array links{
    Link{"index", "index of obstacles"},
    Link{"sample", "samples drawn", "samples", [](const Answer& a) { return a.counters.samples; },
         [](const Answer& a) { return fmt::format(", {} kept", grouped(a.counters.kept)); }},
    Link{"neighbours", "index built", "milestones", [](const Answer& a) { return a.counters.kept; }},
    Link{"queries", "neighbours asked", "queries", [](const Answer& a) { return a.counters.neighbour_queries; }},
    Link{"checks", "edges checked", "edges", [](const Answer& a) { return a.counters.edges_checked; },
         [](const Answer& a) { return fmt::format(", {} free", grouped(a.counters.edges_free)); }},
    Link{"rows", "CSR rows", "rows", [](const Answer& a) { return a.roadmap.milestones; },
         [](const Answer& a) { return ", " + human_bytes(static_cast<double>(a.counters.row_bytes)); }},
    Link{"reduction", "reduction", "vertices", [](const Answer& a) { return a.roadmap.milestones; }},
    Link{"components", "components", "vertices", [](const Answer& a) { return a.roadmap.milestones; },
         [](const Answer& a) { return ", " + counted(a.roadmap.components, "component", "components"); }},
    Link{"expansion", "queue and search", "expanded", [](const Answer& a) { return a.counters.expanded; },
         [](const Answer& a) {
           return fmt::format(", {} pushes, {} decreases", grouped(a.counters.pushes), grouped(a.counters.decreases));
         }},
    Link{},
    Link{"optimise", "pulled taut"},
    Link{"verify", "verified", "points", path_points},
    Link{"bound", "lower bound"},
};

const Link* link_of(std::string_view key) {
  const auto* const found = std::ranges::find(links, key, &Link::key);
  return found != links.end() ? found : link_of("");
}

bool is_sum(std::string_view key) {
  constexpr StageTimes all{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  return std::ranges::any_of(named_stages(all), [&](const auto& stage) { return stage.first == key; });
}

std::vector<StageLine> plain_lines(const std::vector<StageCost>& costs) {
  std::vector<StageLine> lines;
  for (const StageCost& cost : costs) {
    lines.push_back({.key = cost.name, .label = cost.name, .wall_s = cost.wall_s, .cpu_s = cost.cpu_s, .counted = {}});
    std::ranges::replace(lines.back().key, ' ', '_');
  }
  std::ranges::stable_sort(lines, {}, [](const StageLine& line) { return link_of(line.key); });
  return lines;
}

}  // namespace

void AnswerLines::add(std::string_view name, std::string_view what) {
  text += fmt::format("  {}{}\n", palette.faint(fmt::format("{:<14}", name)), what);
}

std::vector<StageLine> stage_lines(const Answer& answer) {
  std::vector<StageLine> lines = plain_lines(answer.costs);
  for (StageLine& line : lines) {
    const Link& link = *link_of(line.key);
    if (link.key.empty()) continue;
    line.label = link.label;
    if (link.count != nullptr) line.count = link.count(answer);
    if (line.count == 0) continue;
    line.counted = link.items;
    if (link.came_of_them != nullptr) line.counted += link.came_of_them(answer);
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

std::string text_of(const NarrowPlace& narrow) {
  const std::string text = fmt::format("{} of room on leg {}", human_number(narrow.clearance), grouped(narrow.leg + 1));
  if (!narrow.place) return text;
  return text + fmt::format(", near {},{}", human_number(narrow.place->x), human_number(narrow.place->y));
}

std::string narrowest_json(const std::optional<NarrowPlace>& narrow) {
  if (!narrow) return "null";
  JsonObject json;
  json.add("leg", narrow->leg);
  json.add_json("place", narrow->place
                             ? json_list(std::span<const double>(std::array{narrow->place->x, narrow->place->y}))
                             : "null");
  json.add("clearance", narrow->clearance, "one_sample_in", narrow->one_sample_in);
  return json.closed();
}

std::string explanation_text(const Answer& answer, const Palette& palette) {
  if (!answer.explained) return {};
  AnswerLines lines{palette};
  add_samples(lines, answer);
  add_edges(lines, answer);
  add_components(lines, answer);
  add_gap(lines, answer);
  add_search(lines, answer);
  add_narrowest(lines, answer);
  add_times(lines, answer);
  for (const Hint& hint : answer.explained->hints) lines.add("try", printable(hint_text(hint)));
  if (answer.explained->stopped) {
    lines.add("explained", fmt::format("in part, {}; the answer stands", text_of(*answer.explained->stopped)));
  }
  return lines.text;
}

std::string explanation_json(const Answer& answer) {
  const Explanation& explained = *answer.explained;
  const Counters& c = answer.counters;
  const std::uint64_t dropped = is_tree_planner(planner_of(answer)) ? 0 : c.samples - c.kept;
  JsonObject json;
  json.add_json("samples", json_object("drawn", c.samples, "kept", c.kept, "dropped", dropped));
  json.add_json("motions", json_object("checked", c.edges_checked, "free", c.edges_free, "blocked", blocked_edges(c),
                                       "undecided", c.refused));
  json.add_json("components", explained.components ? components_json(*explained.components) : "null");
  json.add_json("narrowest", narrowest_json(explained.narrowest));
  json.add_json("hints", json_list_of(explained.hints, ",", hint_json));
  json.add_json("stopped_by", explained.stopped ? json_string(name_of(*explained.stopped)) : "null");
  return json.closed();
}

std::string notes_text(const Answer& answer, const Palette& palette) {
  AnswerLines lines{palette};
  const auto add = [&](std::string_view name, const std::string& note) {
    if (!note.empty()) lines.add(name, note);
  };
  add("room", room_note(answer));
  add("heuristic", heuristic_note(answer));
  if (!answer.explained) add("samples", samples_note(answer));
  add("note", lazy_note(answer));
  add("note", doors_note(answer));
  for (const std::string& line : answer.problem.told) add("note", line);
  return lines.text;
}

}  // namespace warren
