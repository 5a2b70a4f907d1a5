// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/answer_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/printable.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/explanation_text.hpp"
#include "solve/explain_answer.hpp"
#include "solve/question/question_of_arm.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {
namespace {

std::string why_blocked(const Answer& answer, std::string_view end) {
  if (!answer.blocked) return fmt::format("the body does not fit at the {}", end);
  const std::string& by = answer.blocked->by;
  const bool is_outside = by.starts_with("outside") || by.starts_with("limits");
  return (is_outside ? "" : "in the way is ") + printable(by);
}

/// What there is to say beside "not connected": of all that the planner looked at.
std::string why_not_connected(const Answer& answer) {
  const Figure* cause = figure_named(answer.figures, "cause");
  const auto* word = cause == nullptr ? nullptr : std::get_if<std::string>(cause);
  if (word != nullptr && word->starts_with("disc_blocked")) {
    return fmt::format("the disc that holds the body does not fit at the {}; other planners take the body itself",
                       word->ends_with("start") ? "start" : "goal");
  }
  if (const Figure* tried = figure_named(answer.figures, "goals_tried")) {
    return fmt::format("of {} that bring the tool there none is free; others might be",
                       counted(std::get<std::uint64_t>(*tried), "posture", "postures"));
  }
  if (const Figure* reached = figure_named(answer.figures, "stops_reached")) {
    const std::uint64_t stops = std::get<std::uint64_t>(*reached);
    const std::string from = stops == 0 ? "to the first stop" : fmt::format("from stop {} on", stops);
    return fmt::format("{} no way was found; there may be one", from);
  }
  const auto planner = enum_named<PlannerKind>(answer.planner);
  const bool by_trees = planner && (is_tree_planner(*planner) || gets_better(*planner));
  return fmt::format("{} start and goal; {} might",
                     by_trees ? "these samples do not join" : "this roadmap does not join",
                     by_trees ? "others" : "another");
}

std::string headline(const Answer& answer, const Palette& palette) {
  if (answer.refuted) return palette.bad("refuted") + ": the path meets " + answer.refuted->violation.obstacle;
  switch (answer.outcome) {
    case Outcome::solved:
      return palette.good("solved") + " and verified";
    case Outcome::infeasible:
      return palette.bad("infeasible") + ": proved, no path exists";
    case Outcome::start_blocked:
      return palette.bad("start blocked") + ": " + why_blocked(answer, "start");
    case Outcome::goal_blocked:
      return palette.bad("goal blocked") + ": " + why_blocked(answer, "goal");
    case Outcome::not_connected:
      return palette.doubtful("not connected") + ": " + why_not_connected(answer);
    default:
      return palette.doubtful("stopped") + ": " +
             (answer.stop_reason ? stop_text(*answer.stop_reason, answer.wanted_memory_bytes) : "before the end");
  }
}

/// As far as it is, with its unit where that is no cell.
std::string length_text(const Answer& answer, double length) {
  return human_number(length).append(metres_behind(answer.world.unit));
}

void add_blocked(AnswerLines& lines, const Answer& answer, const BlockedEnd& blocked) {
  const std::string_view metres = metres_behind(answer.world.unit);
  if (blocked.depth) lines.add("depth", fmt::format("{:.3g}{} in it", *blocked.depth, metres));
  if (!blocked.free_place.empty()) {
    const std::string_view unit =
        is_arm(answer.problem.robot) && blocked.free_place.size() == answer.problem.start.size() ? " rad" : metres;
    lines.add("free place", fmt::format("({}), {}{} away", fmt::join(blocked.free_place, ", "),
                                        human_number(blocked.distance), unit));
  }
  if (!blocked.hint.empty()) lines.add("hint", printable(blocked.hint));
}

/// A heading of 90 is as good as any, but hardly meant.
void add_strange_headings(AnswerLines& lines, const Problem& problem) {
  constexpr double a_turn_and_a_bit = 6.3;
  if (problem.robot.kind != RobotKind::polygon && problem.robot.kind != RobotKind::car) return;
  for (const std::vector<double>* state : {&problem.start, &problem.goal}) {
    if (state->size() != 3 || std::abs((*state)[2]) <= a_turn_and_a_bit) continue;
    lines.add("note", fmt::format("a heading of {0} is in radians; degrees are written {0}deg", (*state)[2]));
  }
}

std::string planner_text(const Answer& answer) {
  std::string text = answer.planner;
  if (!answer.sampler.empty()) text += ", " + answer.sampler + " sampler";
  if (!answer.search.empty()) text += ", " + answer.search;
  if (!answer.sampler.empty()) text += fmt::format(", seed {}", answer.seed);
  return text;
}

std::string price_text(const Answer& answer) {
  const PriceParts& price = *answer.price;
  std::string text = "with the length";
  for (const auto& [part, paid] :
       {std::pair{"nearness", price.clearance}, std::pair{"areas", price.areas}, std::pair{"turning", price.turning},
        std::pair{"changes of gear", price.cusps}, std::pair{"driving backwards", price.reverse}}) {
    if (paid > 0.0) text += fmt::format(", {} for {}", length_text(answer, paid), part);
  }
  return text;
}

/// What was decided where the question left a choice: of goals, of their order, of ways.
void add_choice(AnswerLines& lines, const Answer& answer) {
  std::string goal;
  if (answer.goal_index) {
    goal = fmt::format("number {} of {}", *answer.goal_index + 1, answer.problem.rule.others.size() + 1);
  }
  if (const auto& reached = answer.goal_reached; reached && reached->distance > 0.0) {
    goal += fmt::format("{}{} from ({})", goal.empty() ? "" : ", ", length_text(answer, reached->distance),
                        fmt::join(reached->asked, ", "));
    if (reached->distance_bound.value_or(0.0) > 0.0) {
      goal += fmt::format(", of which nothing within {} can be reached", length_text(answer, *reached->distance_bound));
    }
  }
  if (!goal.empty()) lines.add("goal", goal);
  if (!answer.order.empty()) {
    std::vector<std::uint64_t> from_one;
    for (const std::uint64_t place : answer.order) from_one.push_back(place + 1);
    lines.add("order", fmt::format("places {}", fmt::join(from_one, ", ")));
  }
  if (answer.alternatives.empty()) return;
  std::vector<std::string> costs;
  for (const AlternativePath& other : answer.alternatives) costs.push_back(length_text(answer, other.cost));
  lines.add("other ways", fmt::format("{}", fmt::join(costs, ", ")));
}

void add_path(AnswerLines& lines, const Answer& answer) {
  add_choice(lines, answer);
  std::string length = lines.palette.strong(length_text(answer, answer.length));
  if (answer.raw_length) length += fmt::format(" (before --optimise: {})", length_text(answer, *answer.raw_length));
  const auto gap = gap_of(answer);
  if (answer.optimal && !answer.cost) {
    length += " (the shortest there is)";
  } else if (gap && !answer.iterations && figure_named(answer.options, "bound") != nullptr) {
    length += fmt::format(" (at most {} % above the shortest)", human_number(100.0 * *gap));
  }
  lines.add("length", length + fmt::format(", {}", counted(path_points(answer), "point", "points")));
  if (answer.cost) {
    const std::string of_what = answer.price        ? price_text(answer)
                                : answer.iterations ? "turning counted"
                                                    : "in steps from cell to cell";
    lines.add("cost", fmt::format("{}, {}{}", human_number(*answer.cost), of_what,
                                  answer.optimal ? " (the least there is)" : ""));
  }
  if (answer.turn_rad) {
    constexpr double degree = std::numbers::pi / 180.0;
    lines.add("turning", human_number(*answer.turn_rad / degree) + " degrees");
  }
  lines.add("clearance", fmt::format("{} at least; {} asked for", length_text(answer, answer.min_clearance),
                                     length_text(answer, answer.problem.clearance)));
}

std::string end_text(const Answer& answer) {
  if (answer.stop_reason) return stop_text(*answer.stop_reason, answer.wanted_memory_bytes);
  if (answer.ended_by == "optimum") return "there is no better one";
  if (answer.ended_by == "goal") return "there is no better one to this goal";
  if (answer.ended_by == "lattice") return "the lattice has no better one";
  if (answer.ended_by == "gap") return "as near to the best as --gap asks for";
  if (answer.ended_by == "goal_gap") return "as near to the best to this goal as --gap asks for";
  if (answer.ended_by == "lattice_gap") return "as near to the lattice's best as --gap asks for";
  if (answer.ended_by == "iterations") return "all turns are done";
  if (answer.ended_by == "nodes") return "its tree has all --nodes";
  if (answer.ended_by == "caller") return "the caller had enough";
  return answer.ended_by;
}

/// Of planners that get better: how the path came to be, and how far from the best it is at most.
void add_quality(AnswerLines& lines, const Answer& answer) {
  if (!answer.iterations) return;
  std::string what = counted(*answer.iterations, "turn", "turns");
  const std::vector<Improvement>& all = answer.improvements;
  if (answer.verified && all.size() > 1) {
    what += fmt::format(", cost {} to {} in {}", human_number(all.front().cost), human_number(all.back().cost),
                        counted(all.size() - 1, "step", "steps"));
  }
  const std::string end = end_text(answer);
  lines.add("better", what + (end.empty() ? "" : "; " + end));
  const auto gap = gap_of(answer);
  if (!gap || answer.optimal) return;
  constexpr double near = 0.02;
  const std::string share = share_text(*gap);
  std::string how_far = fmt::format("at most {} longer than the best", share);
  if (answer.cost) how_far = fmt::format("costs at most {} more than the best", share);
  if (*gap < near) how_far = fmt::format("within {} of the best there is", share);
  lines.add("bound", fmt::format("{}: {}, proved", human_number(*answer.lower_bound), how_far));
}

/// Of --sampled-edges: how many are wrong, and what the proof took.
void add_wrong_edges(AnswerLines& lines, const Answer& answer) {
  const Figure* edges = figure_named(answer.figures, "wrong_edges");
  const Figure* proof_s = figure_named(answer.figures, "proof_s");
  if (edges == nullptr || proof_s == nullptr) return;
  const auto& wrong = std::get<std::vector<WrongEdge>>(*edges);
  double deepest = 0.0;
  for (const WrongEdge& edge : wrong) deepest = std::max(deepest, edge.depth);
  std::string what =
      fmt::format("{} of {}", wrong.empty() ? "none" : grouped(wrong.size()), grouped(answer.roadmap.edges));
  if (!wrong.empty()) what += fmt::format(" pass through polygons, the deepest by {}", length_text(answer, deepest));
  lines.add("wrong edges",
            fmt::format("{}; proved in {}, beside the solving", what, human_seconds(std::get<double>(*proof_s))));
}

void add_roadmap(AnswerLines& lines, const Answer& answer) {
  if (answer.cells) {
    lines.add("cells", fmt::format("{}, {}", counted(answer.cells->cells, "cell", "cells"),
                                   counted(answer.cells->adjacencies, "adjacency", "adjacencies")));
  }
  if (answer.roadmap.milestones == 0) return;
  std::string what = fmt::format("{}, {}", counted(answer.roadmap.milestones, "milestone", "milestones"),
                                 counted(answer.roadmap.edges, "edge", "edges"));
  if (answer.roadmap.components > 0) what += ", " + counted(answer.roadmap.components, "component", "components");
  lines.add("roadmap", what);
  add_wrong_edges(lines, answer);
  const Counters& did = answer.counters;
  std::vector<std::string> work;  // no edges where all are free by their making, no search where trees have met
  if (did.edges_checked > 0) work.push_back(counted(did.edges_checked, "edge", "edges") + " checked");
  if (did.expanded > 0) work.push_back(counted(did.expanded, "place", "places") + " expanded by the search");
  if (did.rounds > 0) work.push_back(counted(did.rounds, "round", "rounds"));
  if (!work.empty()) lines.add("work", fmt::format("{}", fmt::join(work, ", ")));
  if (answer.outcome != Outcome::not_connected || answer.refuted || !answer.separation.is_known()) return;
  lines.add("start, goal", fmt::format("components of {} and {}, {} apart",
                                       counted(answer.separation.start_size, "milestone", "milestones"),
                                       counted(answer.separation.goal_size, "milestone", "milestones"),
                                       length_text(answer, answer.separation.nearest_gap)));
}

/// The chain of a planner that joins samples, link by link.
void add_chain(AnswerLines& lines, const Answer& answer) {
  const std::vector<StageLine> stages = stage_lines(answer);
  if (std::none_of(stages.begin(), stages.end(), [](const StageLine& l) { return l.key == "queries"; })) return;
  lines.add("chain", fmt::format("{:<18} {:>8} {:>8} {:>6} {:>9}  {}", "", "wall", "CPU", "times", "each", "of"));
  for (const StageLine& l : stages) {
    lines.add(
        "", fmt::format("{:<18} {:>8} {:>8} {:>6} {:>9}  {}", l.label, human_seconds(l.wall_s), human_seconds(l.cpu_s),
                        l.wall_s >= 20e-6 ? fmt::format("{:.1f}", l.cpu_s / l.wall_s) : "",
                        l.count > 0 ? precise_seconds(1e-9 * l.ns_each()) : "",
                        l.count > 0 ? fmt::format("{} {}", grouped(l.count), l.counted) : ""));
  }
}

void add_times(AnswerLines& lines, const Answer& answer) {
  std::string stages;
  for (const auto& [name, seconds] : named_stages(answer.seconds)) {
    if (seconds >= 5e-6) stages += fmt::format("{}{} {}", stages.empty() ? "" : ", ", name, human_seconds(seconds));
  }
  lines.add("stages", stages);
  add_chain(lines, answer);
  lines.add("solve", fmt::format("{} on {}, {} at the peak", lines.palette.strong(human_seconds(answer.solve_s)),
                                 counted(answer.threads, "thread", "threads"),
                                 human_bytes(static_cast<double>(answer.peak_memory_bytes))));
}

}  // namespace

std::string share_text(double share) {
  const double percent = 100.0 * share;
  const double unit = percent >= 10.0 ? 1.0 : percent >= 1.0 ? 0.1 : percent >= 0.1 ? 0.01 : 0.001;
  return fmt::format("{:g} %", unit * std::ceil(percent / unit - 1e-9));
}

std::string summary_of(const Answer& answer, const Palette& palette, std::span<const std::string> files_written) {
  AnswerLines lines{palette, fmt::format("{}  {}\n", palette.strong(answer.world.source), headline(answer, palette))};
  if (!answer.world.kind.empty()) {
    const std::string& kind = answer.world.kind;  // a map has cells
    lines.add("world", kind == "map" ? kind : kind + ", " + contents_text(answer.world));
    lines.add("planner", planner_text(answer));
  }
  add_strange_headings(lines, answer.problem);
  const std::string_view less_memory = what_takes_less_memory(answer);
  if (!less_memory.empty() && !answer.explained) lines.add("try", less_memory);
  if (answer.blocked) add_blocked(lines, answer, *answer.blocked);
  if (answer.verified) add_path(lines, answer);
  add_quality(lines, answer);
  if (answer.refuted) lines.add("length", length_text(answer, answer.refuted->length) + ", of the refuted path");
  add_roadmap(lines, answer);
  add_times(lines, answer);
  for (const std::string& file : files_written) lines.add("wrote", printable(file));
  return lines.text;
}

}  // namespace warren
