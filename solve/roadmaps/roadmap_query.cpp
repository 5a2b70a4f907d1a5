// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/roadmap_query.hpp"

#include <new>
#include <utility>

#include "roadmaps/graph/free_components.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "solve/steps/planned_scene.hpp"
#include "solve/steps/solve_steps.hpp"

namespace warren {
namespace {

Question question_of(const Roadmap& roadmap, const std::vector<double>& start, const std::vector<double>& goal) {
  Question question = roadmap.question();
  question.start = start;
  question.goal = goal;
  return question;
}

std::vector<double> anywhere(const Roadmap& roadmap) { return std::vector<double>(state_size(roadmap.robot), 0.0); }

}  // namespace

struct RoadmapQuery::Opened {
  Opened(const Roadmap& roadmap, const Execution& execution)
      : any(question_of(roadmap, anywhere(roadmap), anywhere(roadmap))),
        solver(choose_solver(roadmap.options, roadmap.scene, any)),
        planned(roadmap.scene, any, solver.planner, execution),
        world(account_of(roadmap.scene, execution)),
        session(solver.kind->open({roadmap.options, planned.get(), any, solver.planner, execution}, roadmap.arrays,
                                  roadmap.rule)) {}
  Question any;
  ChosenSolver solver;
  PlannedScene planned;
  WorldAccount world;
  std::unique_ptr<RoadmapSession> session;
};

RoadmapQuery::RoadmapQuery(const Roadmap& roadmap, const Limits& limits)
    : RoadmapQuery(roadmap, LimitedExecution(limits).execution()) {}

RoadmapQuery::RoadmapQuery(const Roadmap& roadmap, const Execution& execution)
    : roadmap_(roadmap), opened_(std::make_unique<Opened>(roadmap, execution)) {}

RoadmapQuery::~RoadmapQuery() = default;

Answer RoadmapQuery::ask(const std::vector<double>& start, const std::vector<double>& goal,
                         const RoadmapSearchFields& how, const Limits& limits, ByProducts* keep) const {
  const LimitedExecution limited(limits);
  AskScratch scratch;
  return ask_within(start, goal, how, limited.execution(), scratch, keep);
}

Answer RoadmapQuery::ask_within(const std::vector<double>& start, const std::vector<double>& goal,
                                const RoadmapSearchFields& how, const Execution& execution, AskScratch& scratch,
                                ByProducts* keep) const {
  const Question question = question_of(roadmap_, start, goal);
  question.validate();
  SolveOptions options = roadmap_.options;
  options.search = how.search;
  options.queue = how.queue;
  options.optimise = how.optimise;
  if (how.attach) options.roadmap.attach = how.attach;
  options.validate();
  check_solver_options(options);
  const ChosenSolver solver = choose_solver(options, roadmap_.scene, question);
  Answer answer;
  try {
    answer = solver.kind->solve({options,
                                 opened_->planned.get(),
                                 question,
                                 solver.planner,
                                 execution,
                                 keep,
                                 {opened_->session.get(), &scratch}});
  } catch (const Stopped& stopped) {
    answer.stop_reason = stopped.reason;
  } catch (const std::bad_alloc&) {
    answer.stop_reason = StopReason::memory;
  }
  answer.world = opened_->world;
  answer.threads = thread_count(execution.threads);
  answer.peak_memory_bytes = peak_resident_bytes();
  return answer;
}

std::span<const std::uint64_t> RoadmapQuery::edge_states() const { return opened_->session->edge_states(); }

double RoadmapQuery::distance(VertexId from, VertexId to) const { return opened_->session->distance(from, to); }

void learn(Roadmap& roadmap, const RoadmapQuery& query, const Execution& execution) {
  const std::span<const std::uint64_t> known = query.edge_states();
  roadmap.arrays.edge_states.assign(known.begin(), known.end());
  roadmap.arrays.component = free_components(roadmap.arrays.parts(), execution);
}

}  // namespace warren
