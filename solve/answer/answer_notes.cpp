// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/answer_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "scenes/text/human_units.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {
namespace {

std::string_view option_word(const Answer& answer, std::string_view name) {
  const Figure* figure = figure_named(answer.options, name);
  const auto* word = figure == nullptr ? nullptr : std::get_if<std::string>(figure);
  return word == nullptr ? std::string_view{} : std::string_view{*word};
}

template <class T>
const T* path_figure(const Answer& answer, std::string_view name) {
  const Figure* figure = figure_named(answer.path_figures, name);
  return figure == nullptr ? nullptr : std::get_if<T>(figure);
}

/// The lattice and the middles of cells drop nothing that is worth a word.
std::string samples_note(const Answer& answer) {
  const Counters& c = answer.counters;
  if (c.kept == 0 || c.kept == c.samples) return {};
  return fmt::format("{} drawn, {} dropped: --explain says why", grouped(c.samples), grouped(c.samples - c.kept));
}

/// How much room there is where the body does not fit, but for limits and what is outside of all.
std::string room_note(const Answer& answer) {
  if (!answer.blocked || !(answer.blocked->needed > 0.0)) return {};
  for (const char* other : {"outside", "limits"}) {
    if (answer.blocked->by.starts_with(other)) return {};
  }
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
  const auto* searched = path_figure<double>(answer, "searched_length");
  const auto* shortest = path_figure<double>(answer, "shortest_length");
  const auto* expanded = path_figure<std::uint64_t>(answer, "shortest_expanded");
  if (searched == nullptr || shortest == nullptr || expanded == nullptr) return {};
  const double percent = 100.0 * (*searched / *shortest - 1.0);
  const std::string longer =
      *searched > *shortest * (1.0 + 1e-12) ? fmt::format("{:.2g} % longer than", percent) : "as long as";
  return fmt::format("{}: {}, {} the roadmap's shortest, {}; {} expanded, by euclidean {}",
                     option_word(answer, "heuristic"), human_number(*searched), longer, human_number(*shortest),
                     grouped(answer.counters.expanded), grouped(*expanded));
}

}  // namespace

std::string notes_text(const Answer& answer, const Palette& palette) {
  std::string text;
  const auto add = [&](std::string_view name, const std::string& what) {
    if (!what.empty()) text += fmt::format("  {}{}\n", palette.faint(fmt::format("{:<14}", name)), what);
  };
  add("room", room_note(answer));
  add("heuristic", heuristic_note(answer));
  if (!answer.explained) add("samples", samples_note(answer));
  add("note", lazy_note(answer));
  add("note", doors_note(answer));
  return text;
}

}  // namespace warren
