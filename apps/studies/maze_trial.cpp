// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/maze_trial.hpp"

#include <nlohmann/json.hpp>

#include "apps/studies/machine.hpp"
#include "core/run/trace.hpp"
#include "solve/answer/explanation_text.hpp"
#include "solve/kinds/kind_of_problem.hpp"

namespace warren::studies {
Scene generate_trial(const MazeOptions& maze, const SolveOptions& options, const Execution& execution,
                     double& seconds) {
  const bool is_streamed = options.roadmap.pipeline == PipelineKind::streamed;
  if (is_streamed && maze.algorithm == MazeAlgorithm::mst) return unmade_maze_scene(maze);
  const StageTimer timer(execution, "generate", seconds);
  return maze_scene(maze, false, execution);
}

MazeTrial solve_trial(const Scene& scene, const MazeOptions& maze, const Question& question,
                      const SolveOptions& options, double budget_s, const Execution& execution) {
  const WallProblem problem = wall_problem(scene, question);
  Question asked = question;
  asked.contact.reset();  // these planners keep off the walls, whatever is allowed
  SolveOptions how = options;
  how.seed = maze.seed;
  restart_peak_memory();
  const Deadline deadline(execution.deadline, budget_s);
  Execution within = execution;
  within.deadline = &deadline;
  StageAccount account;
  within.account = &account;
  const SolveKind kind = is_unmade(scene) ? streamed_kind() : walls_kind();
  MazeTrial trial{kind.solve({how, scene, asked, how.planner.value_or(PlannerKind::prm), within}), maze.rows, maze.cols,
                  problem.clearance};
  if (trial.outcome != Outcome::stopped) trial.stop_reason.reset();
  if (trial.stop_reason && is_signal(*trial.stop_reason)) throw Stopped{*trial.stop_reason};
  trial.seed = maze.seed;
  trial.costs = account.costs();
  tell_process(trial, within);
  trial.path = {};
  trial.states = {};
  return trial;
}

std::string planner_text(const MazeTrial& trial) {
  return trial.planner + (trial.pipeline.empty() ? "" : ", " + trial.pipeline) + ", " + trial.sampler + " sampler";
}

std::string_view verdict_of(const MazeTrial& trial) {
  if (trial.outcome != Outcome::stopped) return name_of(trial.outcome);
  return trial.stop_reason == StopReason::memory ? "too little memory" : "cut by the budget";
}

nlohmann::ordered_json trial_json(const MazeTrial& trial) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& [key, seconds] : keyed_seconds(trial.seconds, trial.costs)) stages[key] = seconds;
  nlohmann::ordered_json json{{"rows", trial.rows},         {"cols", trial.cols},
                              {"threads", trial.threads},   {"planner", trial.planner},
                              {"sampler", trial.sampler},   {"seed", trial.seed},
                              {"solve_s", trial.solve_s},   {"stages_s", std::move(stages)},
                              {"verified", trial.verified}, {"status", name_of(trial.outcome)}};
  if (!trial.pipeline.empty()) json["pipeline"] = trial.pipeline;
  if (trial.stop_reason) json["stopped_by"] = trial.stop_reason == StopReason::memory ? "memory" : "budget";
  json["length"] = trial.verified ? nlohmann::ordered_json(trial.length) : nlohmann::ordered_json(nullptr);
  json["generate_s"] = trial.generate_s;
  json["peak_memory_bytes"] = trial.peak_memory_bytes;
  return json;
}

}  // namespace warren::studies
