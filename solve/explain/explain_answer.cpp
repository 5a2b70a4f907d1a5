// SPDX-License-Identifier: BSD-3-Clause
#include "solve/explain/explain_answer.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "core/plane/geometry.hpp"
#include "parallel/components.hpp"
#include "solve/steps/blocked_end.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "solve/steps/obstacles_near.hpp"
#include "solve/steps/question_of_pose.hpp"

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

/// A verified path, part by part, among the obstacles that are near the part which is looked at.
class PathParts {
 public:
  /// Obstacles that come as near as `room` are looked at.
  PathParts(const Scene& scene, Question question, const RecordedAnswer& answer, double room,
            const Execution& execution)
      : question_(std::move(question)),
        answer_(answer),
        execution_(execution),
        kind_(verifying_kind(scene, question_)),
        reach_(2.0 * room + extent_of(*question_.robot)) {
    look_at(scene, 0, size() - 1);
  }

  /// From now on obstacles that are far from the states first .. last are left out.
  void look_at(std::size_t first, std::size_t last) { look_at(near_, first, last); }

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
    return kind_.verify(near_, question, part, execution_).min_clearance;
  }

 private:
  void look_at(const Scene& scene, std::size_t first, std::size_t last) {
    if (state(0).size() > 3) {
      near_ = scene;
      return;
    }
    std::vector<Vec2> way;
    double longest = 0.0;  // a car's curve bends away from its chord by no more
    for (std::size_t i = first; i <= last; ++i) {
      const std::vector<double> at = state(i);
      way.push_back({at[0], at[1]});
      if (i > first) longest = std::max(longest, distance(way.end()[-2], way.back()));
    }
    const double bend = question_.robot->kind == RobotKind::car ? longest : 0.0;
    near_ = obstacles_near(scene, way, reach_ + bend, execution_);
  }

  Question question_;
  const RecordedAnswer& answer_;
  const Execution& execution_;
  const SolveKind& kind_;
  double reach_;
  Scene near_;
};

/// The leg with the least room: the half that has it, again and again.
std::size_t narrowest_leg(PathParts& parts, double least) {
  std::size_t first = 0;
  std::size_t last = parts.size() - 1;
  while (last - first > 1) {
    const std::size_t middle = first + (last - first) / 2;
    const double before = parts.clearance(first, middle);
    const bool is_before = before <= least || before <= parts.clearance(middle, last);
    (is_before ? last : first) = middle;
    parts.look_at(first, last);
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

}  // namespace

std::optional<NarrowPlace> narrowest_place(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                                           double min_clearance, const Execution& execution) {
  const std::size_t states = std::max(answer.path.size(), answer.states.size());
  if (states < 2 || !(min_clearance > 0.0) || !std::isfinite(min_clearance)) return std::nullopt;
  PathParts parts(scene, question, answer, min_clearance, execution);
  NarrowPlace narrow{
      .leg = narrowest_leg(parts, min_clearance), .place = {}, .clearance = min_clearance, .one_sample_in = {}};
  if (parts.state(0).size() <= 3) narrow.place = narrowest_on(parts, narrow.leg);
  return narrow;
}

void explain_answer(const Scene& scene, const AskedWith& asked, Answer& answer, const ByProducts& made,
                    const Execution& execution) {
  Explanation& explained = answer.explained.emplace();
  explained.hints = hints_for(scene, asked, answer);
  const auto planner = enum_named<PlannerKind>(answer.planner);
  if (planner == PlannerKind::prm && answer.outcome != Outcome::stopped) {
    if (const Graph* graph = graph_of(made, answer)) explained.components = facts_of(*graph, execution);
  }
  if (!answer.verified) return;
  RecordedAnswer path;
  path.file = "answer";
  path.path = answer.path;
  path.states = answer.states;
  explained.narrowest = narrowest_place(scene, answer.problem.question(), path, answer.min_clearance, execution);
  if (explained.narrowest) explained.narrowest->one_sample_in = one_sample_in(scene, answer, execution);
}

void explain_stop(Answer& answer) {
  answer.explained.emplace().hints = hints_for(Scene(), {.options = SolveOptions()}, answer);
}

void explain_in_time(Answer& answer, const std::function<void()>& explain) {
  const auto stop = [&](StopReason reason) {
    if (!answer.explained) answer.explained.emplace();
    answer.explained->stopped = reason;
  };
  try {
    explain();
  } catch (const Stopped& stopped) {
    stop(stopped.reason);
  } catch (const std::bad_alloc&) {
    stop(StopReason::memory);
  }
}

}  // namespace warren
