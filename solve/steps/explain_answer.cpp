// SPDX-License-Identifier: BSD-3-Clause
#include "solve/steps/explain_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/plane/geometry.hpp"
#include "parallel/components.hpp"
#include "solve/steps/blocked_end.hpp"
#include "solve/steps/kind_of_problem.hpp"

namespace warren {
namespace {

ComponentFacts facts_of(const Graph& graph, const Execution& execution) {
  const Components parts = components(graph, execution);
  const auto vertices = static_cast<VertexId>(graph.vertex_count());
  execution.reserve(vertices * sizeof(std::uint32_t));
  std::vector<std::uint32_t> size(vertices, 0);
  for (VertexId v = 0; v < vertices; ++v) ++size[parts.label[v]];
  ComponentFacts facts{.count = parts.count, .milestones = vertices};
  for (const std::uint32_t n : size) {
    facts.largest = std::max<std::uint64_t>(facts.largest, n);
    facts.alone += n == 1 ? 1 : 0;
  }
  facts.of_start = size[parts.label[vertices - 2]];
  facts.of_goal = size[parts.label[vertices - 1]];
  facts.joined = parts.connected(vertices - 2, vertices - 1);
  return facts;
}

/// The graph of the roadmap, whatever its states are; nullptr: none was kept, or its edges lead one way.
const Graph* graph_of(const ByProducts& made, const Answer& answer) {
  if (answer.problem.robot.kind == RobotKind::car) return nullptr;
  const Graph* graphs[] = {&made.roadmap.graph,
                           made.pose_roadmaps.size() == 1 ? &made.pose_roadmaps.front().graph : nullptr,
                           &made.joint_roadmap.graph};
  for (const Graph* graph : graphs) {
    if (graph != nullptr && graph->vertex_count() >= 2) return graph;
  }
  return nullptr;
}

/// A verified path, part by part.
class PathParts {
 public:
  PathParts(const Scene& scene, Question question, const RecordedAnswer& answer, const Execution& execution)
      : scene_(scene),
        question_(std::move(question)),
        answer_(answer),
        execution_(execution),
        kind_(verifying_kind(scene, question_)) {}

  std::size_t size() const { return answer_.states.empty() ? answer_.path.size() : answer_.states.size(); }
  bool in_plane() const { return answer_.states.empty(); }
  std::vector<double> state(std::size_t i) const {
    if (in_plane()) return {answer_.path[i].x, answer_.path[i].y};
    return {answer_.states[i].begin(), answer_.states[i].end()};
  }
  /// Least room between the states first and last.
  double clearance(std::size_t first, std::size_t last) const {
    std::vector<std::vector<double>> states;
    for (std::size_t i = first; i <= last; ++i) states.push_back(state(i));
    return clearance(states);
  }
  double clearance(const std::vector<std::vector<double>>& states) const {
    execution_.check();
    RecordedAnswer part;
    part.file = "answer";
    for (const std::vector<double>& each : states) {
      if (in_plane()) {
        part.path.push_back({each[0], each[1]});
      } else {
        part.states.width = each.size();
        part.states.add(each);
      }
    }
    Question question = question_;
    question.start = states.front();
    question.goal = states.back();
    return kind_.verify(scene_, question, part, execution_).min_clearance;
  }

 private:
  const Scene& scene_;
  Question question_;
  const RecordedAnswer& answer_;
  const Execution& execution_;
  const SolveKind& kind_;
};

/// The leg with the least room: the half that has it, again and again.
std::size_t narrowest_leg(const PathParts& parts) {
  std::size_t first = 0;
  std::size_t last = parts.size() - 1;
  while (last - first > 1) {
    const std::size_t middle = first + (last - first) / 2;
    (parts.clearance(first, middle) <= parts.clearance(middle, last) ? last : first) = middle;
  }
  return first;
}

/// The same along a straight leg, to a thousandth of it.
Vec2 narrowest_on(const PathParts& parts, std::size_t leg) {
  constexpr int halvings = 10;
  const std::vector<double> a = parts.state(leg);
  const std::vector<double> b = parts.state(leg + 1);
  Vec2 from{a[0], a[1]};
  Vec2 to{b[0], b[1]};
  if (!parts.in_plane()) return from;
  const auto room = [&](Vec2 p, Vec2 q) { return parts.clearance({{p.x, p.y}, {q.x, q.y}}); };
  for (int i = 0; i < halvings; ++i) {
    const Vec2 middle = 0.5 * (from + to);
    (room(from, middle) <= room(middle, to) ? to : from) = middle;
  }
  return 0.5 * (from + to);
}

/// The square lies in the box of all.
std::optional<double> one_sample_in(const Scene& scene, const Answer& answer, const Execution& execution) {
  const Problem& problem = answer.problem;
  const bool is_round = problem.robot.kind == RobotKind::point || problem.robot.kind == RobotKind::disc;
  const double free = 2.0 * (answer.min_clearance - problem.clearance);
  if (!is_round || answer.sampler.empty() || answer.raw_length || !(free > 0.0)) return std::nullopt;
  const Box box = room_of(scene, execution);
  return std::max(1.0, box.width() * box.height() / (free * free));
}

bool is_given(const Answer& answer, std::string_view option) { return figure_named(answer.options, option) != nullptr; }

void add_roadmap_hints(const Answer& answer, std::vector<std::string>& hints) {
  const bool fixed = is_given(answer, "samples");
  const bool seeks = answer.sampler == "bridge" || answer.sampler == "gaussian" || answer.sampler == "mixture";
  const bool sampled = answer.sampler != "lattice" && answer.sampler != "cell-centres";
  if (fixed) {
    hints.push_back(fmt::format("--samples {}, or none: the roadmap then grows until start and goal connect",
                                4 * std::max<std::uint64_t>(answer.counters.samples, 1)));
  } else if (!sampled) {
    hints.push_back("--sampler uniform: milestones between the middles of cells, too");
  }
  if (sampled && !seeks) hints.push_back("--sampler bridge or gaussian: milestones in narrow passages");
  if (const Figure* radius = figure_named(answer.options, "radius")) {
    if (const double* r = std::get_if<double>(radius)) {
      const bool too_far = answer.separation.nearest_gap > *r;
      hints.push_back(fmt::format("--radius {:.3g}{}", 2.0 * std::max(*r, too_far ? answer.separation.nearest_gap : *r),
                                  too_far ? ": the gap is wider than the one asked for" : ""));
    }
  }
  if (const Figure* neighbours = figure_named(answer.options, "neighbours")) {
    if (const auto* k = std::get_if<std::uint64_t>(neighbours)) {
      hints.push_back(fmt::format("--neighbours {}: each milestone is joined to more", 2 * *k));
    }
  }
}

void add_tree_hints(const Answer& answer, std::vector<std::string>& hints) {
  hints.push_back(fmt::format("--nodes {}: the trees gave up at their number",
                              4 * std::max<std::uint64_t>(answer.roadmap.milestones, 25'000)));
  if (!is_given(answer, "step")) hints.push_back("--step: shorter motions squeeze through narrower passages");
  if (!is_given(answer, "trees")) hints.push_back("--trees 4: the first of them to arrive answers");
}

std::vector<std::string> hints_for(const Answer& answer) {
  std::vector<std::string> hints;
  if (answer.outcome == Outcome::stopped) {
    hints.push_back("a longer --budget, or more --memory; 'time went to' says which stage took it");
  }
  if (answer.blocked && !answer.blocked->hint.empty()) hints.push_back(answer.blocked->hint);
  if (answer.blocked && !answer.blocked->free_place.empty()) {
    const auto& place = answer.blocked->free_place;
    std::string text = answer.blocked->is_start ? "--start " : "--goal ";
    for (std::size_t i = 0; i < place.size(); ++i) text += fmt::format("{}{}", i == 0 ? "" : ",", place[i]);
    hints.push_back(text + ": the nearest place where the body fits");
  }
  if (answer.outcome != Outcome::not_connected || answer.refuted) return hints;
  const auto planner = enum_named<PlannerKind>(answer.planner);
  if (planner && is_roadmap_planner(*planner)) add_roadmap_hints(answer, hints);
  if (planner == PlannerKind::rrt || planner == PlannerKind::rrt_connect) add_tree_hints(answer, hints);
  if (planner == PlannerKind::grid) {
    hints.push_back("a smaller --cell, or more --angles: what is narrower than a cell is not seen");
  }
  if (planner == PlannerKind::voronoi || planner == PlannerKind::cells) {
    hints.push_back("another --planner: prm or lazy-prm");
  }
  if (answer.problem.clearance > 0.0) {
    hints.push_back(fmt::format("--clearance below {:.6g}, if less room will do", answer.problem.clearance));
  }
  return hints;
}

}  // namespace

std::optional<NarrowPlace> narrowest_place(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                                           double min_clearance, const Execution& execution) {
  const PathParts parts(scene, question, answer, execution);
  if (parts.size() < 2 || !(min_clearance > 0.0) || !std::isfinite(min_clearance)) return std::nullopt;
  NarrowPlace narrow{.leg = narrowest_leg(parts), .place = {}, .clearance = min_clearance, .one_sample_in = {}};
  if (parts.state(0).size() <= 3) narrow.place = narrowest_on(parts, narrow.leg);
  return narrow;
}

void explain_answer(const Scene& scene, Answer& answer, const ByProducts& made, const Execution& execution) {
  Explanation explained;
  const auto planner = enum_named<PlannerKind>(answer.planner);
  if (planner == PlannerKind::prm && answer.outcome != Outcome::stopped) {
    if (const Graph* graph = graph_of(made, answer)) explained.components = facts_of(*graph, execution);
  }
  if (answer.verified) {
    RecordedAnswer path;
    path.file = "answer";
    path.path = answer.path;
    path.states = answer.states;
    explained.narrowest = narrowest_place(scene, answer.problem.question(), path, answer.min_clearance, execution);
    if (explained.narrowest) {
      explained.narrowest->one_sample_in = one_sample_in(scene, answer, execution);
    }
  }
  explained.hints = hints_for(answer);
  answer.explained = std::move(explained);
}

}  // namespace warren
