// SPDX-License-Identifier: BSD-3-Clause
// Which problems `solve` and `verify` know, and which planners solve each: one SolveKind a kind of problem, defined in
// the file of its kind of world (solve/kinds; that of streamed mazes in solve/streamed); the table of all of them is in
// kind_of_problem.cpp.
//
// To add a planner:
// 1. its code in planners/;
// 2. solve_options.hpp: PlannerKind, its name, what is_tree_planner() and the others beside it say of it,
//    and an option that nobody had yet;
// 3. for each kind that has it a line in the `NAME_planners` of the kind's file (here and in solve/streamed) and a
//    branch in what solves it. The line has the options that the planner takes beyond planner and seed (every other one
//    is refused, by name, before the planner sees it), and the words of questions that it respects (asked_words.hpp:
//    prices, restrictions, goals; the same);
// 4. for bodies that sample, whose branch is shared: plan(), plan_roadmap(), grow_trees(), plan_better() or
//    plan_on_lattice() of SampledSolve (sampled_solve.hpp), planned_worlds.hpp and planned_*.cpp, where it is compiled;
// 5. the help (tools/words/question_words.cpp), Python's (apps/python/warren/_worlds.pyi, _errors.py), and of one that
//    gets better the page's (apps/serve/page/better.js);
// 6. tests/matrix/planners.table, of which README's table is made, and matrix_checks.cpp there;
// 7. docs/file_formats.md, algorithms.md, other_names.md;
// 8. its test in tests/planners; for a new room a line in tests/check_layers.cmake and in the tree of docs/design.md.
//
// To add a kind: its file or a place in one, its declaration below, its line in the table. Several kinds may fit a
// world (walls are plane obstacles too): the first in the table that has the planner, and takes all words and options,
// solves it; the first that has any planner is asked for the default.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/roadmap/ask_roadmap.hpp"
#include "planners/roadmap/connection.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/answer/read_answer_io.hpp"
#include "solve/question/asked_words.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
// What stands between a kept roadmap and a kind of problem: the world in memory and the roadmap over it, ready to be
// asked, and what the judge keeps of the scene. One type a World; which, only the kind knows that made it.

/// Any number of threads may ask, each with its scratch.
struct RoadmapSession : NotCopied {
  virtual ~RoadmapSession() = default;
  /// What searches have learnt of the edges; while nobody asks.
  virtual std::span<const std::uint64_t> edge_states() const = 0;
  /// Length of the motion between two states of the roadmap.
  virtual double distance(VertexId from, VertexId to) const = 0;

  std::optional<ObstacleIndex> judged;  ///< of the scene, where the judge takes one
};

template <World W>
struct SessionIn : RoadmapSession {
  std::optional<W> world;
  std::optional<WorldView<W>> view;
  std::optional<AskedRoadmap<AnyWorldOf<W>>> roadmap;
  std::span<const std::uint64_t> edge_states() const override { return roadmap->edge_states(); }
  double distance(VertexId from, VertexId to) const override {
    return world->distance(roadmap->states[from], roadmap->states[to]);
  }
};

/// A session, and the scratch of the thread that asks.
struct RoadmapAsked {
  const RoadmapSession* session = nullptr;  ///< nullptr: the roadmap is built for the question
  AskScratch* scratch = nullptr;

  const ObstacleIndex* judged() const { return session != nullptr && session->judged ? &*session->judged : nullptr; }
};

/// One planner of a kind, the options that it takes, and the words of questions beyond start, goal and body.
struct PlannerChoice {
  PlannerKind planner;
  OptionSet options;
  AskedWords words = {};  ///< all others are refused by name
};

/// A roadmap of the world as it was, and where that has changed since.
struct OldRoadmap {
  const RoadmapArrays* arrays;
  std::vector<Box> places;
};

class KeptWays;  // solve/kinds/kept_ways.hpp

/// Everything that a solve is given. Refers to what it names.
struct SolveRequest {
  const SolveOptions& options;
  const Scene& scene;
  const Question& question;
  PlannerKind planner;
  const Execution& execution;
  ByProducts* keep = nullptr;       ///< receives what the planner makes beyond the path; nullptr: nothing is kept
  RoadmapAsked asked = {};          ///< a roadmap that is there already
  const OldRoadmap* old = nullptr;  ///< what a build may take over
  bool many = true;                 ///< open(): will there be more than one question?
  std::uint64_t samples = 0;        ///< open(): of the roadmap's last round
  bool index = false;               ///< build(): make an index where it pays
  KeptWays* kept = nullptr;         ///< of solves before on this map, and for those that follow
  PathTaker* taker = nullptr;       ///< receives the path instead of the answer, where it is made in pieces
};

struct BuiltArrays {
  RoadmapArrays arrays;  ///< but for the components
  std::uint64_t samples = 0;
  ConnectionRule rule;
  BuildAccount account;
};

struct SolveKind {
  std::string_view problem;  ///< "a point or disc among walls"
  bool (*fits)(const Scene& scene, const RobotSpec& robot);
  std::span<const PlannerChoice> planners;  ///< at least one
  PlannerKind (*usual_planner)(const SolveOptions& options, const Scene& scene, const Question& question);
  /// Solves from the world in memory to the path verified. Throws UsageError, InputError for what can't be asked; a
  /// stop is an answer. Fills in all of Answer but world, threads and peak memory.
  Answer (*solve)(const SolveRequest& request);
  /// Re-checks an answer; nullptr: another kind that fits does. Throws InputError where its states are none of this
  /// kind.
  Verdict (*verify)(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                    const Execution& execution) = nullptr;
  /// Builds a roadmap without a question, for planners that keep one: start and goal of the request are any. nullptr:
  /// no planner of this kind makes one. Throws as solve(), and Stopped.
  BuiltArrays (*build)(const SolveRequest& request) = nullptr;
  /// Makes such a roadmap ready to be asked; solve() takes it as request.asked.
  std::unique_ptr<RoadmapSession> (*open)(const SolveRequest& request, const RoadmapArrays& arrays,
                                          const ConnectionRule& rule) = nullptr;
  /// Makes the by-products that solve() leaves out because they cost; nullptr: there are none such. Throws Stopped.
  void (*make_by_products)(const SolveRequest& request) = nullptr;
  bool unmade = false;        ///< takes worlds whose walls are left out, and no others
  bool chooses_goal = false;  ///< solve() heeds the words that leave a choice of goals; else solve_to_goal() does
};

// The kinds, in the files of their worlds.
SolveKind walls_kind();
SolveKind streamed_kind();
SolveKind plane_kind();
SolveKind turning_kind();
SolveKind fixed_angle_kind();
SolveKind turning_axis_kind();
SolveKind car_kind();
SolveKind arm_kind();
SolveKind occupancy_kind();
SolveKind lattice_kind();

/// The planner that shall solve a problem, and the kind it belongs to.
struct ChosenSolver {
  const SolveKind* kind;
  PlannerKind planner;
};

/// Checks what needs no world: is the planner that is asked for one of this version, and does it take the options?
/// Throws UsageError.
void check_solver_options(const SolveOptions& options);
/// Throws UsageError where no planner of this version solves the problem, or not the one that is asked for, or where
/// the planner would ignore an option.
ChosenSolver choose_solver(const SolveOptions& options, const Scene& scene, const Question& question);
/// Where a word is said: "@clearance_price" of the question, "map.scene: its line 'area'" of the world's file.
std::string place_of_word(AskedWord word, const Scene& scene, const Question& question);
/// The kind that verifies answers for this world and body; throws UsageError where this version has none.
const SolveKind& verifying_kind(const Scene& scene, const Question& question);

/// Does the planner take the option for some kind of problem?
bool planner_takes(PlannerKind planner, Option option);
/// The same for this problem alone.
bool planner_takes(PlannerKind planner, Option option, const Scene& scene, const Question& question);

/// The planners that solve some kind of problem, in their order.
std::vector<PlannerKind> planners_there_are();

}  // namespace warren
