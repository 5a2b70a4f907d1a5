// SPDX-License-Identifier: BSD-3-Clause
// A point or disc among walls that are held: joins their worlds with the roadmap planners.

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/whole.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "planners/shorten/taut_path.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/sampled_roadmap.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

// The proof behind "infeasible": where all walls lie on the unit grid, a body of any size that keeps off the walls can
// pass from cell to cell only through open sides (a grid point without walls is the corner of four open sides), so
// cells that a flood does not join are not joined by any path. Claims nothing where bounds reach beyond the maze's box,
// since a path could leave by the entrance and come in again by the exit. O(walls + cells).

/// Zero-based {col, row} of a cell whose closed square holds p, a point of the maze's box. On a side between two cells
/// either will do: p is free, so the side is open.
std::pair<std::uint32_t, std::uint32_t> cell_of(Vec2 p, MazeHint maze) {
  const auto at = [](double x, std::uint32_t count) {
    return bounded_whole<std::uint32_t>(std::floor(x - 0.5), 0.0, count - 1.0);
  };
  return {at(p.x, maze.cols), at(p.y, maze.rows)};
}

/// Is it proved that no path joins start and goal? Both are free points of the scene, which has the maze hint.
bool proves_infeasible(const Scene& scene, Vec2 start, Vec2 goal, const Execution& execution) {
  const MazeHint maze = *scene.maze;
  const Box box{{0.5, 0.5}, {maze.cols + 0.5, maze.rows + 0.5}};
  if (!box.contains(start) || !box.contains(goal)) return false;
  if (scene.bounds && !(box.contains(scene.bounds->min) && box.contains(scene.bounds->max))) return false;
  const MazeCells cells = cells_of_walls(scene.walls, maze, execution);
  return !flood_connects(cells, cell_of(start, maze), cell_of(goal, maze), execution);
}

WallProblem problem_of(const SolveRequest& request) {
  return keeping_off(request.scene, request.question, "prm and lazy-prm keep off the walls");
}

class WallSolve {
 public:
  explicit WallSolve(const SolveRequest& request)
      : request_(request),
        scene_(request.scene),
        problem_(problem_of(request)),
        options_(describe_roadmap_planner(answer_, scene_, problem_, request.options)),
        execution_(request.execution) {
    if (is_kept() && options_.planner == PlannerKind::prm) answer_.pipeline = name_of(PipelineKind::plain);
  }

  void run() {
    plan(request_.keep != nullptr ? &request_.keep->roadmap : nullptr);
    const PointJudge judge = judge_of(request_, problem_);
    answer_.outcome = judge.settled(answer_.outcome);
    if (answer_.outcome == Outcome::not_connected) proved_infeasible();
    tell_cause();
    if (request_.options.optimise && answer_.outcome == Outcome::solved) optimise();
    judge.verify_solved(answer_);
  }
  Answer& answer() { return answer_; }

 private:
  bool is_kept() const { return request_.asked.session != nullptr; }
  const SessionIn<MazeWorld>& session() const {
    return static_cast<const SessionIn<MazeWorld>&>(*request_.asked.session);
  }
  const MazeWorld& indexed_world() {
    if (is_kept()) return *session().world;
    if (!world_) {
      const StageTimer timer(execution_, "index", answer_.seconds.index, scene_.walls.size());
      world_.emplace(scene_, problem_.reach(), execution_);
    }
    return *world_;
  }
  void plan(PlannedRoadmap<Vec2>* keep) {
    if (is_kept()) {
      return take_solution(answer_, planned<Vec2>().ask(*session().roadmap, problem_.start, problem_.goal,
                                                        options_.roadmap, execution_, *request_.asked.scratch, keep));
    }
    if (options_.pipeline != PipelineKind::plain) return take_solution(answer_, plan_tiles());
    const MazeWorld& world = indexed_world();
    if (grows() && ends_are_free(world) && proved_infeasible()) return;
    const bool lazy = options_.planner == PlannerKind::lazy_prm;
    take_solution(answer_, planned<Vec2>().on_roadmap(WorldView(world), problem_.start, problem_.goal, options_.roadmap,
                                                      lazy, execution_, keep));
  }
  Solution<Vec2> plan_tiles() {
    const std::vector<Segment> bounds = bounds_walls(scene_);
    const TiledProblem problem{
        scene_.walls,   bounds,        scene_.bounds, problem_.reach(),
        problem_.start, problem_.goal, nullptr,       options_.pipeline == PipelineKind::streamed};
    return tiled_prm(problem, options_.roadmap, execution_);
  }
  /// Does the roadmap grow until start and goal connect? Then one asks first whether they ever can.
  bool grows() const { return options_.roadmap.sampler != SamplerKind::lattice && !options_.roadmap.samples; }
  bool ends_are_free(const MazeWorld& world) const {
    auto query = world.make_query();
    return world.is_free(problem_.start, query) && world.is_free(problem_.goal, query);
  }
  bool proved_infeasible() {
    if (!scene_.maze) return false;
    const StageTimer timer(execution_, "proof", answer_.seconds.search);
    if (!proves_infeasible(scene_, problem_.start, problem_.goal, execution_)) return false;
    answer_.outcome = Outcome::infeasible;
    return true;
  }
  /// As SampledSolve says it of other bodies.
  void tell_cause() {
    std::string_view cause;
    if (answer_.outcome == Outcome::start_blocked) cause = "start_in_collision";
    if (answer_.outcome == Outcome::goal_blocked) cause = "goal_in_collision";
    if (answer_.outcome == Outcome::not_connected) cause = cause_of_separation(answer_, true);
    if (!cause.empty()) answer_.figures.push_back({"cause", std::string(cause)});
  }
  void optimise() {
    const MazeWorld& world = indexed_world();
    const StageTimer timer(execution_, "optimise", answer_.seconds.optimise, answer_.path.size());
    answer_.raw_length = path_length(answer_.path, MazeWorld::distance);
    answer_.path = taut_path(world.walls(), answer_.path, world.planning_clearance(), execution_);
  }

  const SolveRequest& request_;
  const Scene& scene_;
  WallProblem problem_;
  Answer answer_;
  PlannerOptions options_;
  const Execution& execution_;
  std::optional<MazeWorld> world_;  // tiles need none; made where it is first asked for
};

/// As a body of sampled_roadmap.hpp.
class PointAmongWalls : public UsualBody<WallProblem> {
 public:
  using World = MazeWorld;

  explicit PointAmongWalls(const SolveRequest& request) : UsualBody(request, problem_of(request)) {}
  void index(std::optional<World>& world, SamplerKind) const { world.emplace(scene_, problem_.reach(), execution_); }
};

constexpr AskedWords walls_words{AskedWord::goal};
constexpr PlannerChoice walls_planners[] = {{PlannerKind::prm, plane_takes, walls_words},
                                            {PlannerKind::lazy_prm, plane_takes, walls_words}};

/// The roadmap of the tiled pipeline, for a picture: tiles keep none, so the plain stages build it again, for mazes
/// whose edges can be told apart in a picture.
void make_roadmap(const SolveRequest& request) {
  constexpr std::uint64_t most_drawn = 40'000;  // cells
  const WallProblem problem = problem_of(request);
  const PlannerOptions options = planner_options(request.options, request.scene, problem);
  if (options.planner != PlannerKind::prm || options.pipeline == PipelineKind::plain) return;
  const LatticeSize size = options.roadmap.lattice;
  if (std::uint64_t{size.rows} * size.cols > most_drawn) return;
  const MazeWorld world(request.scene, problem.reach(), request.execution);
  planned<Vec2>().on_roadmap(WorldView(world), problem.start, problem.goal, options.roadmap, false, request.execution,
                             &request.keep->roadmap);
}

}  // namespace

SolveKind walls_kind() {
  return {"a point or disc among walls",
          [](const Scene& scene, const RobotSpec& robot) { return is_round(robot) && scene.polygons.empty(); },
          walls_planners,
          [](const SolveOptions& options, const Scene& scene, const Question&) {
            return usual_roadmap_planner(options, scene);
          },
          [](const SolveRequest& request) { return answered(WallSolve(request)); },
          nullptr,  // plane_kind() judges
          build_sampled<PointAmongWalls>,
          open_sampled<PointAmongWalls>,
          make_roadmap};
}

}  // namespace warren
