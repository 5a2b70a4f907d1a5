// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/roadmap/sampler.hpp"
#include "planners/shorten/taut_path.hpp"
#include "solve/explain/blocked_end.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "verify/streamed/verify_cells.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

Question question_of(const Roadmap& roadmap, const std::vector<double>& start, const std::vector<double>& goal) {
  Question question = roadmap.question();
  question.start = start;
  question.goal = goal;
  return question;
}

/// Above, the judge's index would take longer to make than some hundred passes over the walls.
constexpr std::size_t most_indexed_walls = std::size_t{1} << 23;

/// An index is not searched.
void refuse_search(const RoadmapSearchFields& how) {
  if (how.search || how.queue || how.roadmap.attach || how.heuristic) {
    throw UsageError(fmt::format("@{}: this roadmap is asked by its index; build it with @index none to search it",
                                 how.search      ? "search"
                                 : how.queue     ? "queue"
                                 : how.heuristic ? "heuristic"
                                                 : "attach"));
  }
}

/// Who says that an edge is free which is not: the roadmap, for its world has been looked at by nobody else.
[[noreturn]] void refuse_roadmap(const Roadmap& roadmap, const RefutedPathError& error) {
  throw InputError(fmt::format("the roadmap of {}", roadmap.world.outline().source),
                   fmt::format("leads through an obstacle; build it anew: {}", error.what()));
}

Question question_to_one(const Roadmap& roadmap, const std::vector<double>& start, const std::vector<double>& goal) {
  if (goal.empty() && !roadmap.world.outline().other_goals.empty()) {
    throw UsageError("@goal: the world has several, and a kept roadmap is asked for one; say which");
  }
  Question question = question_of(roadmap, start, goal);
  question.validate();
  return question;
}

std::vector<double> anywhere(const Roadmap& roadmap) { return std::vector<double>(state_size(roadmap.robot), 0.0); }

/// The cell whose milestone stands at p and has an edge.
std::optional<CellId> lattice_cell(const RouteIndex& index, Vec2 p) {
  const LatticeSize size = index.passages().size();
  const bool inside = p.x >= 1.0 && p.y >= 1.0 && p.x <= size.cols && p.y <= size.rows;
  if (!inside || std::floor(p.x) != p.x || std::floor(p.y) != p.y) return std::nullopt;
  const auto col = static_cast<std::uint32_t>(p.x) - 1;
  const auto row = static_cast<std::uint32_t>(p.y) - 1;
  return index.passages().open_at(col, row) != 0 ? std::optional(row * size.cols + col) : std::nullopt;
}

class LatticeQuestion {
 public:
  /// `query`: of the index, or none yet. All are referred to. Throws Stopped.
  LatticeQuestion(const WallsNearEnds& near, const WallProblem& problem, const RouteIndex& index,
                  std::optional<RouteQuery>& query, const Execution& execution)
      : near_(near),
        problem_(problem),
        index_(index),
        query_(query ? *query : query.emplace(index)),
        execution_(execution) {
    if (!link(0, problem.start)) {
      outcome = Outcome::start_blocked;
    } else if (!link(1, problem.goal)) {
      outcome = Outcome::goal_blocked;
    } else {
      join();
    }
  }

  Outcome outcome = Outcome::not_connected;
  double length = 0.0;  ///< only for solved
  /// Start, cells, goal.
  Path<Vec2> path() const {
    if (direct_) return {problem_.start, problem_.goal};
    const RawVector<CellId> cells = query_.path(from_, to_, execution_);
    execution_.reserve((cells.size() + 2) * sizeof(Vec2));
    const LatticeSize size = index_.passages().size();
    const std::size_t before = lattice_point(size, cells.front()) != problem_.start ? 1 : 0;
    const bool ends_there = lattice_point(size, cells.back()) == problem_.goal && before + cells.size() > 1;
    const std::size_t behind = ends_there ? 0 : 1;
    Path<Vec2> path(before + cells.size() + behind);
    for_each_index(cells.size(), std::size_t{1} << 14, execution_,
                   [&](std::size_t i) { path[before + i] = lattice_point(size, cells[i]); });
    path.front() = problem_.start;
    path.back() = problem_.goal;
    return path;
  }

 private:
  using Link = std::pair<double, CellId>;  // how long the motion to the cell's milestone is

  /// False where the body does not fit there.
  bool link(std::size_t end, Vec2 p) {
    if (const auto cell = lattice_cell(index_, p)) {  // every other link leads over a longer way
      links_[end].emplace_back(0.0, *cell);
      return true;
    }
    bool is_free = false;
    near_.look(p, execution_, [&](const MazeWorld& world) { is_free = link_among(world, end, p); });
    return is_free;
  }
  bool link_among(const MazeWorld& world, std::size_t end, Vec2 p) {
    auto query = world.make_query();
    if (!world.is_free(p, query)) return false;
    const LatticeSize size = index_.passages().size();
    std::vector<Link> near;
    const auto middle_x = static_cast<std::int64_t>(std::clamp(std::round(p.x), 1.0, static_cast<double>(size.cols)));
    const auto middle_y = static_cast<std::int64_t>(std::clamp(std::round(p.y), 1.0, static_cast<double>(size.rows)));
    for (std::int64_t y = std::max<std::int64_t>(1, middle_y - widest_look);
         y <= std::min<std::int64_t>(size.rows, middle_y + widest_look); ++y) {
      for (std::int64_t x = std::max<std::int64_t>(1, middle_x - widest_look);
           x <= std::min<std::int64_t>(size.cols, middle_x + widest_look); ++x) {
        const Vec2 at{static_cast<double>(x), static_cast<double>(y)};
        if (!world.is_free(at, query)) continue;
        near.emplace_back(distance(p, at), static_cast<CellId>((y - 1) * size.cols + (x - 1)));
      }
    }
    std::sort(near.begin(), near.end());
    constexpr std::size_t farthest = 256;
    near.resize(std::min(near.size(), farthest));
    for (const auto& [away, cell] : near) {
      if (away > 1.0 && !links_[end].empty()) break;
      if (world.is_free_motion(p, lattice_point(size, cell), query)) links_[end].emplace_back(away, cell);
    }
    return true;
  }
  void join() {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [before, from] : links_[0]) {
      for (const auto& [behind, to] : links_[1]) {
        const auto steps = query_.length(from, to);
        if (!steps || before + *steps + behind >= best) continue;
        best = before + *steps + behind;
        from_ = from;
        to_ = to;
      }
    }
    const double straight = distance(problem_.start, problem_.goal);
    if (straight <= 1.0 && straight < best) {
      near_.look(problem_.start, execution_, [&](const MazeWorld& world) {
        auto query = world.make_query();
        direct_ = world.is_free_motion(problem_.start, problem_.goal, query);
      });
      if (direct_) best = straight;
    }
    if (!std::isfinite(best)) return;
    outcome = Outcome::solved;
    length = best;
  }

  const WallsNearEnds& near_;
  const WallProblem& problem_;
  const RouteIndex& index_;
  RouteQuery& query_;
  const Execution& execution_;
  std::vector<Link> links_[2];
  bool direct_ = false;
  CellId from_ = 0;
  CellId to_ = 0;
};

}  // namespace

/// Of states and edges.
struct RoadmapQuery::Opened {
  Opened(const Roadmap& roadmap, const Execution& execution, Questions questions)
      : any(question_of(roadmap, anywhere(roadmap), anywhere(roadmap))),
        solver(choose_solver(roadmap.options, roadmap.world.whole(execution), any)),
        copy(planned_copy(roadmap.world.whole(execution), any, solver.planner, execution)),
        planned(copy ? *copy : roadmap.world.whole(execution)) {
    SolveRequest request{roadmap.options, planned, any, solver.planner, execution};
    request.many = questions != Questions::one;
    request.samples = roadmap.samples;
    session = solver.kind->open(request, roadmap.arrays, roadmap.rule);
  }
  Question any;
  ChosenSolver solver;
  std::optional<Scene> copy;
  const Scene& planned;
  std::unique_ptr<RoadmapSession> session;
};

/// Of a lattice: what looks at its walls, for ends that are no milestones and for the judge of paths.
struct RoadmapQuery::Walls {
  Walls(const Roadmap& of, Questions what)
      : roadmap(of), questions(what), near_ends(of.world, of.clearance + of.robot.radius) {}
  /// nullptr where the walls can't be looked up.
  const KeptCells* looked_up(const Execution& execution) const {
    if (const KeptCells* kept = roadmap.world.looked_up(execution); kept != nullptr) return kept;
    if (questions == Questions::one) return nullptr;
    const auto make = [&] {
      return std::make_unique<std::unique_ptr<KeptCells>>(cells_of_scene(roadmap.world.whole(execution), execution));
    };
    return cells.get(execution, make).get();
  }
  /// By walls that are looked up, by an index, or by a pass over all obstacles.
  PointJudge judge_of(const WallProblem& problem, const Execution& execution) const {
    if (const KeptCells* kept = looked_up(execution)) {
      return {roadmap.world.outline(), problem, execution, nullptr, kept->walls.get()};
    }
    const Scene& scene = roadmap.world.whole(execution);
    const auto make = [&] { return std::make_unique<ObstacleIndex>(scene, execution); };
    const bool is_indexed = questions != Questions::one && scene.walls.size() <= most_indexed_walls;
    return {scene, problem, execution, is_indexed ? &judged.get(execution, make) : nullptr};
  }
  Answer ask(const Question& question, const RoadmapSearchFields& how, const Execution& execution,
             QuestionScratch& scratch) const {
    refuse_search(how);
    const WallProblem problem = wall_problem(roadmap.world.outline(), question);
    Answer answer;
    describe_roadmap_planner(answer, roadmap.world.outline(), problem, roadmap.options);
    answer.search.clear();
    answer.pipeline.clear();
    answer.figures.push_back({"index", std::string("route")});
    try {
      answer_within_limits(answer, [&] {
        {
          const StageTimer timer(execution, "search", answer.seconds.search);
          const LatticeQuestion asked(near_ends, problem, *roadmap.lattice, scratch.route, execution);
          answer.outcome = asked.outcome;
          answer.roadmap.milestones = count_states(roadmap) + 2;
          if (answer.outcome == Outcome::solved) answer.path = asked.path();
        }
        settle_and_verify(answer, problem, how.optimise, execution, scratch);
      });
    } catch (const RefutedPathError& error) {
      refuse_roadmap(roadmap, error);
    }
    const Scene* scene = &roadmap.world.outline();
    try {
      if (how.bound) scene = &roadmap.world.whole(execution);
    } catch (const Stopped&) {  // the simple bound is left
    }
    tell_bound(answer, *scene, {.bound = how.bound}, execution);
    tell_process(answer, execution);
    return answer;
  }
  void settle_and_verify(Answer& answer, const WallProblem& problem, bool optimise, const Execution& execution,
                         const QuestionScratch& scratch) const {
    const PointJudge judge = judge_of(problem, execution);
    answer.world = account_of(judge.scene, roadmap.world_hash);
    if (judge.cells != nullptr) answer.world.walls = looked_up(execution)->wall_count;
    if (optimise && answer.outcome == Outcome::solved) {
      const Scene& whole = roadmap.world.whole(execution);
      const StageTimer timer(execution, "optimise", answer.seconds.optimise, answer.path.size());
      const MazeWorld world(whole, problem.reach(), execution);
      answer.raw_length = path_length(answer.path, MazeWorld::distance);
      answer.path = taut_path(world.walls(), answer.path, world.planning_clearance(), execution);
    }
    answer.outcome = judge.settled(answer.outcome);
    if (answer.outcome != Outcome::solved) return;
    double seconds = 0.0;  // of the judge alone; the answer does not change while somebody else looks at it
    Verification verdict;
    const auto judge_path = [&] {
      const StageTimer timer(execution, "verify", seconds, answer.path.size());
      verdict = judge.judged(answer.path, verify_options(problem));
    };
    const auto beside = [&](Range r) {
      if (r.first == 1) return judge_path();
      scratch.beside_judge(answer);
    };
    scratch.beside_judge ? for_chunks(2, 1, execution.quiet(), beside) : judge_path();
    answer.seconds.verify += seconds;
    take_verdict(answer, verdict);
  }

  const Roadmap& roadmap;
  Questions questions;
  WallsNearEnds near_ends;
  MadeOnce<std::unique_ptr<KeptCells>> cells;  // of walls that are held
  MadeOnce<ObstacleIndex> judged;
};

RoadmapQuery::RoadmapQuery(const Roadmap& roadmap, const Limits& limits)
    : RoadmapQuery(roadmap, LimitedExecution(limits).execution()) {}

RoadmapQuery::RoadmapQuery(const Roadmap& roadmap, const Execution& execution, Questions questions)
    : roadmap_(roadmap),
      opened_(roadmap.lattice != nullptr ? nullptr : std::make_unique<Opened>(roadmap, execution, questions)),
      walls_(roadmap.lattice != nullptr ? std::make_unique<Walls>(roadmap, questions) : nullptr) {}

RoadmapQuery::~RoadmapQuery() = default;

Answer RoadmapQuery::ask(const std::vector<double>& start, const std::vector<double>& goal,
                         const RoadmapSearchFields& how, const Limits& limits, ByProducts* keep) const {
  const LimitedExecution limited(limits);
  QuestionScratch scratch;
  return ask_explained(start, goal, how, limited.execution(), scratch, keep);
}

Answer RoadmapQuery::ask_explained(const std::vector<double>& start, const std::vector<double>& goal,
                                   const RoadmapSearchFields& how, const Execution& execution, QuestionScratch& scratch,
                                   ByProducts* keep) const {
  Answer answer = ask_within(start, goal, how, execution, scratch, keep);
  price_heuristic(answer, how.heuristic, [&](HeuristicKind exact) {
    RoadmapSearchFields again = how;
    again.heuristic = exact;
    again.optimise = false;
    return ask_within(start, goal, again, execution, scratch);
  });
  explain_blocked_end(roadmap_, answer, execution);
  tell_process(answer, execution);
  return answer;
}

Answer RoadmapQuery::ask_within(const std::vector<double>& start, const std::vector<double>& goal,
                                const RoadmapSearchFields& how, const Execution& execution, QuestionScratch& scratch,
                                ByProducts* keep) const {
  const Question question = question_to_one(roadmap_, start, goal);
  if (walls_ != nullptr) return walls_->ask(question, how, execution, scratch);
  SolveOptions options = roadmap_.options;
  for (const Option option : question_options.members()) copy_option(option, options, how);
  if (how.roadmap.attach) options.roadmap.attach = how.roadmap.attach;
  options.validate();
  check_solver_options(options);
  const Scene& scene = roadmap_.world.whole(execution);
  const ChosenSolver solver = choose_solver(options, scene, question);
  Answer answer;
  scratch.search.by_hierarchy = !how.search && !how.queue && !how.heuristic;
  try {
    const auto reason = stopped_by([&] {
      answer = solver.kind->solve({options, opened_->planned, question, solver.planner, execution, keep,
                                   RoadmapAsked{opened_->session.get(), &scratch.search}});
      answer.problem.prices = roadmap_.prices;
      judge_prices(answer, scene, question, false, execution);
      tell_bound(answer, opened_->planned, options, execution);
    });
    if (reason) make_stopped(answer, *reason);
  } catch (const RefutedPathError& error) {
    refuse_roadmap(roadmap_, error);
  }
  if (scratch.search.by_hierarchy && !roadmap_.arrays.hierarchy.empty()) {
    answer.search.clear();
    answer.figures.push_back({"index", std::string("contraction")});
  }
  answer.world = account_of(scene, roadmap_.world_hash);
  tell_process(answer, execution);
  return answer;
}

void RoadmapQuery::prepare_paths(const Execution& execution) const {
  if (walls_ != nullptr) walls_->judge_of({}, execution);
}

double RoadmapQuery::clearance_at(Vec2 place, const Execution& execution) const {
  const VerifyOptions options{.radius = roadmap_.robot.radius, .clearance = roadmap_.clearance};
  return walls_->judge_of({}, execution).judged({&place, 1}, options).min_clearance;
}

void RoadmapQuery::expect(const std::vector<double>& place, const Execution& execution) const {
  if (roadmap_.lattice == nullptr || place.size() != 2) return;
  if (!lattice_cell(*roadmap_.lattice, {place[0], place[1]})) walls_->near_ends.expect(execution);
}

LengthAnswer RoadmapQuery::length_within(const std::vector<double>& start, const std::vector<double>& goal,
                                         const RoadmapSearchFields& how, const Execution& execution,
                                         QuestionScratch& scratch) const {
  if (roadmap_.lattice == nullptr || how.optimise) {
    scratch.search.tells_separation = false;
    const Answer answer = ask_within(start, goal, how, execution, scratch);
    if (answer.outcome == Outcome::stopped) throw Stopped(answer.stop_reason.value_or(StopReason::time));
    return {answer.outcome, answer.length};
  }
  refuse_search(how);
  const WallProblem problem = wall_problem(roadmap_.world.outline(), question_to_one(roadmap_, start, goal));
  const LatticeQuestion asked(walls_->near_ends, problem, *roadmap_.lattice, scratch.route, execution);
  return {asked.outcome, asked.length};
}

std::span<const std::uint64_t> RoadmapQuery::edge_states() const { return opened_->session->edge_states(); }

double RoadmapQuery::distance(VertexId from, VertexId to) const { return opened_->session->distance(from, to); }

void learn(Roadmap& roadmap, const RoadmapQuery& query, const Execution& execution) {
  if (roadmap.options.planner != PlannerKind::lazy_prm) return;  // all its edges are known
  const std::span<const std::uint64_t> known = query.edge_states();
  roadmap.arrays.edge_states.assign(known.begin(), known.end());
  roadmap.arrays.component = free_components(roadmap.arrays.parts(), execution);
}

void explain_blocked_end(const Roadmap& roadmap, Answer& answer, const Execution& execution) {
  if (!is_blocked(answer.outcome)) return;
  try {
    const Scene& outline = roadmap.world.outline();
    const KeptCells* cells = roadmap.world.looked_up(execution);
    if (cells == nullptr) return explain_blocked_end(roadmap.world.whole(execution), answer, execution);
    const WallProblem problem = wall_problem(outline, answer.problem.question());
    const auto met_at = [&](Vec2 p) {
      return verify_steps(*cells->walls, std::span(&p, 1), end_options(problem), execution).first_violation;
    };
    explain_blocked_cell(problem, *outline.maze, answer, met_at);
  } catch (const Stopped&) {  // it stays as it is
  }
}

}  // namespace warren
