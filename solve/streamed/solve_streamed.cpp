// SPDX-License-Identifier: BSD-3-Clause
// A point or disc in a maze whose walls are not held: prm on its lattice, whose tiles are made, reduced and forgotten;
// those of the path are made again to expand it piece by piece, and once more for the judge. solve_s includes all of
// it.
#include "solve/streamed/solve_streamed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/base/error.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/tile_source.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/explain/blocked_end.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/planner_choice.hpp"

namespace warren {
namespace {

constexpr unsigned tile_side_log2 = CellBits::usual_side_log2;

/// The formula is what the maze is, for the judge, too.
class FormulaWalls : public StreamedWalls {
 public:
  FormulaWalls(MazeHint size, const MazeFormula& formula, const Execution& execution, KeptParts* kept)
      : maze_(size.rows, size.cols, formula.seed, formula.loops, execution, tile_side_log2, kept) {}
  const CellWallSource& planned() const override { return maze_; }
  const CellWallSource& judged() const override { return maze_; }

 private:
  SpanningMaze maze_;
};

class FileWalls : public StreamedWalls {
 public:
  FileWalls(const PackedMaze& packed, Range own, const Execution& execution)
      : file_(packed.file, execution),
        planned_(file_),
        judged_(file_.name(), file_.bytes(),
                [this](std::size_t first, std::size_t last) { file_.forget(first, last); }) {
    planned_.check({own.first > 0 ? own.first - 1 : 0, own.last}, execution);  // tiles have the row below them, too
    if (planned_.hash() != packed.hash) throw InputError(packed.file, "has changed since it was looked at first");
  }
  const CellWallSource& planned() const override { return planned_; }
  const CellWallSource& judged() const override { return judged_; }

 private:
  InputFile file_;
  MazeFile planned_;
  JudgedMazeFile judged_;
};

/// Two passes over an array: the planner's, and the judge's.
class ArrayWalls : public StreamedWalls {
 public:
  ArrayWalls(const PackedMaze& packed, MazeHint size, Range own, const Execution& execution)
      : file_(packed.file, execution),
        planned_(file_, size, execution, own),
        judged_(
            file_.name(), file_.bytes(), size.rows, size.cols,
            {own.first << tile_side_log2, std::min<std::size_t>(size.rows, own.last << tile_side_log2)},
            [this](std::size_t first, std::size_t last) { file_.forget(first, last); }, execution) {}
  const CellWallSource& planned() const override { return planned_.cells(); }
  const CellWallSource& judged() const override { return judged_; }
  std::optional<std::size_t> wall_count() const override { return planned_.wall_count(); }
  std::optional<std::string> hash() const override { return planned_.hash(); }

 private:
  InputFile file_;
  NpyMaze planned_;
  JudgedNpyMaze judged_;
};

/// Judges a path as it comes, and hands it on.
class JudgedPath : public PathTaker {
 public:
  JudgedPath(JudgeAmongCells judge, PathTaker& next, StageTimes& seconds, const Execution& execution)
      : judge_(std::move(judge)), next_(next), seconds_(seconds), execution_(execution) {}

  void begin(std::uint64_t points) override {
    points_ = points;
    next_.begin(points);
  }
  void add(std::span<const Vec2> piece) override {
    {
      const StageTimer timer(execution_, "verify", seconds_.verify);
      judge_.add(piece);
    }
    for (const Vec2 p : is_first_ ? piece : piece.subspan(1)) {
      hash_.add(p.x);
      hash_.add(p.y);
    }
    is_first_ = false;
    next_.add(piece);
  }
  Verification verdict() const { return judge_.verdict(); }
  HandedPath handed() const { return {points_, hash_.text()}; }

 private:
  JudgeAmongCells judge_;
  PathTaker& next_;
  StageTimes& seconds_;
  const Execution& execution_;
  PathHash hash_;
  std::uint64_t points_ = 0;
  bool is_first_ = true;
};

class StreamedSolve {
 public:
  StreamedSolve(const Scene& scene, const Question& question, const SolveOptions& options, const Execution& execution,
                const StreamedHelp& help)
      : scene_(scene),
        problem_(keeping_off(scene, question, "prm keeps off the walls")),
        options_(describe_roadmap_planner(answer_, scene, problem_, options)),
        execution_(execution),
        help_(help) {
    if (options.optimise) throw UsageError("@optimise: pulls no path taut among walls that are not held");
    if (!(problem_.reach() < most_cell_clearance * (1 - 1e-8))) {
      throw UsageError(
          "@clearance: with the body's radius it must be below half a cell where walls are made tile by tile");
    }
  }

  void run() {
    open_walls();
    plan_and_verify();
    answer_.outcome = settled_ends(
        answer_.outcome, [&] { return !met_at(problem_.start); }, [&] { return !met_at(problem_.goal); });
    explain_blocked_cell(problem_, *scene_.maze, answer_, [&](Vec2 p) { return met_at(p); });
    count_walls();
  }
  Answer& answer() { return answer_; }

 private:
  void open_walls() {
    const std::uint64_t groups = (std::uint64_t{scene_.maze->rows} * scene_.maze->cols >> 22U) + 1;
    double& seconds = scene_.packed ? answer_.seconds.index : answer_.seconds.generate;
    const StageTimer timer(execution_, scene_.packed ? "index" : "generate", seconds, groups);
    const std::string hash = unmade_hash(scene_);
    if (help_.kept != nullptr && !hash.empty()) help_.kept->begin(work(hash));
    walls_ = help_.team != nullptr ? help_.team->make(execution_) : streamed_walls(scene_, execution_, help_.kept);
    if (help_.kept != nullptr && hash.empty()) help_.kept->begin(work(walls_->hash().value()));
  }
  /// All that the tiles' reductions depend on.
  std::string work(const std::string& hash) const {
    return fmt::format("warren {}, {} x {} cells with hash {}, {} {} to {} {}, keeping {} off the walls",
                       WARREN_VERSION, scene_.maze->rows, scene_.maze->cols, hash, problem_.start.x, problem_.start.y,
                       problem_.goal.x, problem_.goal.y, problem_.reach());
  }
  /// Piece by piece: what the path is made of, its judge sees before the next is made.
  void plan_and_verify() {
    const WallSet none;
    Path<Vec2> kept;
    PathKeeper keeper(kept, execution_);
    JudgesElsewhere* const judges = help_.team != nullptr ? &help_.team->judges() : nullptr;
    JudgedPath judged({walls_->judged(), verify_options(problem_), execution_, judges},
                      help_.taker != nullptr ? *help_.taker : keeper, answer_.seconds, execution_);
    TiledProblem tiled{none, {}, {}, problem_.reach(), problem_.start, problem_.goal, &walls_->planned(), true};
    tiled.taker = &judged;
    tiled.kept = help_.kept;
    if (help_.team != nullptr) tiled.others = &help_.team->tiles();
    take_solution(answer_, tiled_prm(tiled, options_.roadmap, execution_));
    if (answer_.outcome != Outcome::solved) return;
    take_verdict(answer_, judged.verdict());
    answer_.path = std::move(kept);
    if (help_.taker != nullptr) answer_.handed = judged.handed();
  }
  std::optional<Violation> met_at(Vec2 p) const {
    return verify_among_cells(walls_->judged(), std::span(&p, 1), end_options(problem_), execution_).first_violation;
  }
  /// Below half a cell nothing but a wall between two cells blocks a step, so the steps that are free say how many
  /// walls stand; the outline counts as four, as in maze_walls.
  void count_walls() {
    answer_.world = account_of(scene_, walls_->hash().value_or(unmade_hash(scene_)));
    if (walls_->wall_count()) {
      answer_.world.walls = *walls_->wall_count();
      return;
    }
    const RoadmapSize& roadmap = answer_.roadmap;
    const std::uint64_t rows = scene_.maze->rows;
    const std::uint64_t cols = scene_.maze->cols;
    if (roadmap.milestones == rows * cols + 2) {
      answer_.world.walls = 4 + 2 * rows * cols - rows - cols - (roadmap.edges - roadmap.end_edges);
    }
  }

  const Scene& scene_;
  WallProblem problem_;
  Answer answer_;
  PlannerOptions options_;
  const Execution& execution_;
  const StreamedHelp& help_;
  std::unique_ptr<StreamedWalls> walls_;
};

constexpr PlannerChoice streamed_planners[] = {{PlannerKind::prm, prm_takes | OptionSet{Option::pipeline}}};

Verdict recheck_streamed(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                         const Execution& execution) {
  const WallProblem problem = wall_problem(scene, question);
  check_state_width(answer, 2, "a point or disc");
  const auto walls = streamed_walls(scene, execution);
  if (walls->hash() && answer.world_hash && *walls->hash() != *answer.world_hash) {
    refuse_other_world(answer, answer.file, scene, *walls->hash());
  }
  VerifyOptions options = verify_options(problem);
  options.contact = Contact::blocked;
  const Verification kept_off = verify_among_cells(walls->judged(), answer.path, options, execution);
  if (!kept_off.verified && problem.contact == Contact::allowed)
    throw InputError("contact", "is not judged where walls are made tile by tile, and without it the path is refuted");
  return {kept_off, problem.general()};
}

}  // namespace

std::unique_ptr<StreamedWalls> streamed_walls(const Scene& unmade, Range own, const Execution& execution) {
  if (unmade.packed->hash) return std::make_unique<FileWalls>(*unmade.packed, own, execution);
  return std::make_unique<ArrayWalls>(*unmade.packed, *unmade.maze, own, execution);
}

std::unique_ptr<StreamedWalls> streamed_walls(const Scene& unmade, const Execution& execution, KeptParts* kept) {
  if (unmade.packed) return streamed_walls(unmade, {0, ((unmade.maze->rows - 1) >> tile_side_log2) + 1}, execution);
  return std::make_unique<FormulaWalls>(*unmade.maze, *unmade.formula, execution, kept);
}

Answer solve_streamed_within(const Scene& scene, const Question& question, const SolveOptions& options,
                             const Execution& execution, const StreamedHelp& help) {
  question.validate();
  options.validate();
  check_solver_options(options);
  if (!choose_solver(options, scene, question).kind->unmade) throw UsageError("@pipeline: these walls are held");
  if (!question.route.keep_to.empty()) throw UsageError("@keep_to: nobody holds these walls, to judge an older path");
  Answer answer = answered(StreamedSolve(scene, question, options, execution, help));
  tell_bound(answer, scene, options, execution);
  tell_process(answer, execution);
  return answer;
}

SolveKind streamed_kind() {
  SolveKind kind{
      "a point or disc in a maze made tile by tile",
      [](const Scene& scene, const RobotSpec& robot) { return is_unmade(scene) && is_round(robot); },
      streamed_planners,
      usually<PlannerKind::prm>,
      [](const SolveRequest& request) {
        const StreamedHelp help{.taker = request.taker};
        return answered(StreamedSolve(request.scene, request.question, request.options, request.execution, help));
      },
      recheck_streamed};
  kind.unmade = true;
  return kind;
}

}  // namespace warren
