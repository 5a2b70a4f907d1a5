// SPDX-License-Identifier: BSD-3-Clause
#include "tools/solve_walls.hpp"

#include <fmt/format.h>

#include <chrono>
#include <new>
#include <optional>
#include <stdexcept>

#include "planners/lazy_prm.hpp"
#include "planners/prm.hpp"
#include "planners/taut_path.hpp"
#include "planners/tiled_prm.hpp"
#include "tools/maze_proof.hpp"
#include "worlds/maze_world.hpp"
#include "worlds/verify.hpp"

namespace warren {
namespace {

/// One solve: the steps share the question and fill in the answer.
class WallSolve {
 public:
  WallSolve(const Scene& scene, const WallProblem& problem, const PlannerOptions& options, const Execution& execution)
      : scene_(scene), problem_(problem), options_(options), execution_(execution) {
    answer_.problem = problem;
    answer_.planner = name_of(options.planner);
    if (options.planner == PlannerKind::prm) answer_.pipeline = name_of(options.pipeline);
    answer_.sampler = name_of(options.roadmap.sampler);
    answer_.search = name_of(options.roadmap.search);
    answer_.seed = options.roadmap.seed;
    answer_.options = options.given;
  }

  void run(Roadmap<Vec2>* keep) {
    plan(keep);
    settle_blocked_ends();
    if (answer_.outcome == Outcome::not_connected) proved_infeasible();
    if (options_.optimise && answer_.outcome == Outcome::solved) optimise();
    verify();
  }
  void stop(StopReason reason) {
    answer_.outcome = Outcome::stopped;
    answer_.stop_reason = reason;
    answer_.path.clear();
  }
  Answer& answer() { return answer_; }

 private:
  const MazeWorld& indexed_world();
  void plan(Roadmap<Vec2>* keep);
  Solution<Vec2> plan_tiles();
  void take(Solution<Vec2> solution);
  void settle_blocked_ends();
  bool grows() const;
  bool ends_are_free(const MazeWorld& world) const;
  bool proved_infeasible();
  void optimise();
  void verify();
  bool stands_free(Vec2 p) const;

  const Scene& scene_;
  const WallProblem& problem_;
  const PlannerOptions& options_;
  const Execution& execution_;
  std::optional<MazeWorld> world_;  // tiles need none; made where it is first asked for
  Answer answer_;
};

const MazeWorld& WallSolve::indexed_world() {
  if (!world_) {
    const StageTimer timer(execution_, "index", answer_.seconds.index, scene_.walls.size());
    world_.emplace(scene_, problem_.reach(), execution_);
  }
  return *world_;
}

void add(StageTimes& to, const StageTimes& more) {
  to.index += more.index;
  to.sample += more.sample;
  to.neighbours += more.neighbours;
  to.connect += more.connect;
  to.graph += more.graph;
  to.reduce += more.reduce;
  to.search += more.search;
}

void WallSolve::plan(Roadmap<Vec2>* keep) {
  if (options_.planner == PlannerKind::prm && options_.pipeline == PipelineKind::tiled) {
    take(plan_tiles());
    return;
  }
  const MazeWorld& world = indexed_world();
  if (grows() && ends_are_free(world) && proved_infeasible()) return;
  const auto planner = options_.planner == PlannerKind::prm ? prm<MazeWorld> : lazy_prm<MazeWorld>;
  take(planner(world, problem_.start, problem_.goal, options_.roadmap, execution_, keep));
}

Solution<Vec2> WallSolve::plan_tiles() {
  Box box;
  std::vector<Segment> bounds;
  {
    const StageTimer timer(execution_, "index", answer_.seconds.index, scene_.walls.size());
    box = scene_.bounds ? *scene_.bounds : obstacle_box(scene_, execution_);
    bounds = bounds_walls(scene_);
  }
  const TiledProblem problem{scene_.walls, bounds, box, problem_.reach(), problem_.start, problem_.goal};
  return tiled_prm(problem, options_.roadmap, execution_);
}

void WallSolve::take(Solution<Vec2> solution) {
  answer_.outcome = solution.outcome;
  answer_.path = std::move(solution.path);
  answer_.roadmap = solution.roadmap;
  answer_.separation = solution.separation;
  answer_.counters = solution.counters;
  if (solution.outcome == Outcome::stopped) answer_.stop_reason = solution.stop_reason;
  add(answer_.seconds, solution.seconds);
}

/// Planning keeps 1e-9 more room than it must, so a body that fits exactly is no blocked one: nobody proved that.
void WallSolve::settle_blocked_ends() {
  const bool start = answer_.outcome == Outcome::start_blocked && stands_free(problem_.start);
  const bool goal = answer_.outcome == Outcome::goal_blocked && stands_free(problem_.goal);
  if (start || goal) answer_.outcome = Outcome::not_connected;
}

bool WallSolve::stands_free(Vec2 p) const {
  const VerifyOptions options{.clearance = problem_.reach(), .contact = problem_.contact};
  return verify_path(scene_, std::span(&p, 1), options, execution_).verified;
}

/// Does the roadmap grow until start and goal connect? Then one asks first whether they ever can.
bool WallSolve::grows() const { return options_.roadmap.sampler != SamplerKind::lattice && !options_.roadmap.samples; }

bool WallSolve::ends_are_free(const MazeWorld& world) const {
  auto query = world.make_query();
  return world.is_free(problem_.start, query) && world.is_free(problem_.goal, query);
}

bool WallSolve::proved_infeasible() {
  if (!scene_.maze) return false;
  const StageTimer timer(execution_, "proof", answer_.seconds.search);
  if (!proves_infeasible(scene_, problem_.start, problem_.goal, execution_)) return false;
  answer_.outcome = Outcome::infeasible;
  return true;
}

void WallSolve::optimise() {
  const MazeWorld& world = indexed_world();
  const StageTimer timer(execution_, "optimise", answer_.seconds.optimise, answer_.path.size());
  answer_.raw_length = path_length(answer_.path, MazeWorld::distance);
  answer_.path = taut_path(world.walls(), answer_.path, world.planning_clearance(), execution_);
}

void WallSolve::verify() {
  if (answer_.outcome != Outcome::solved) return;
  const StageTimer timer(execution_, "verify", answer_.seconds.verify, answer_.path.size() + scene_.walls.size());
  const VerifyOptions options{
      .clearance = problem_.reach(), .contact = problem_.contact, .start = problem_.start, .goal = problem_.goal};
  const Verification verification = verify_path(scene_, answer_.path, options, execution_);
  if (!verification.verified) {
    const Violation violation = verification.first_violation.value_or(Violation{});
    throw std::logic_error(fmt::format("the path of {} fails its verification at leg {}: {} is {} away",
                                       answer_.planner, violation.leg, violation.obstacle, violation.distance));
  }
  answer_.verified = true;
  answer_.length = verification.length;
  answer_.min_clearance = verification.min_clearance - problem_.robot.radius;
}

}  // namespace

Answer solve_walls(const Scene& scene, const WallProblem& problem, const PlannerOptions& options,
                   const Execution& execution, Roadmap<Vec2>* keep) {
  const auto begin = std::chrono::steady_clock::now();
  WallSolve solve(scene, problem, options, execution);
  try {
    solve.run(keep);
  } catch (const Stopped& stopped) {
    solve.stop(stopped.reason);
  } catch (const std::bad_alloc&) {
    solve.stop(StopReason::memory);
  }
  solve.answer().solve_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return std::move(solve.answer());
}

void draw_roadmap(const Scene& scene, const WallProblem& problem, const PlannerOptions& options,
                  const Execution& execution, Roadmap<Vec2>& roadmap) {
  constexpr std::uint64_t most_cells = 40'000;  // beyond, a picture's edges would merge
  const LatticeSize size = options.roadmap.lattice;
  if (std::uint64_t{size.rows} * size.cols > most_cells) return;
  const MazeWorld world(scene, problem.reach(), execution);
  prm(world, problem.start, problem.goal, options.roadmap, execution, &roadmap);
}

}  // namespace warren
