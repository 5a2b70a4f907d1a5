// SPDX-License-Identifier: BSD-3-Clause
// Which problems `solve` and `verify` know, and which planners solve each: one SolveKind a kind of problem, defined in
// a file of its own, tools/solve_NAME.cpp; the table of all of them is in kind_of_problem.cpp.
//
// To add a planner to a kind: a line in the `NAME_planners` of its file, naming the options that it takes beyond
// --planner and --seed (every other planner option is refused, by name, before the planner sees it), and a branch in
// its solve_NAME(). An option that nobody had yet: a line in the `options` of that file. A kind without planners is one
// that this version does not solve: filling in its file is all it takes. To add a kind: its file, its declaration
// below, its line in the table. Several kinds may fit a world (walls are plane obstacles too): the first in the table
// that has the planner solves it, and the first that has any planner is asked for the default.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/picture.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/answer.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"
#include "solve/question/read_answer_io.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

/// One planner of a kind, and the options that it takes: long names, blank-separated.
struct PlannerChoice {
  PlannerKind planner;
  std::string_view options;
};

/// Everything that a solve is given. Refers to what it names.
struct SolveRequest {
  const Arguments& arguments;
  const Scene& scene;
  const ProblemOptions& problem;
  PlannerKind planner;
  const Execution& execution;
  Drawing* drawing = nullptr;  ///< receives what a picture shall show beyond world and path; nullptr: no picture
};

/// What `verify` says, and about which question.
struct Verdict {
  Verification verification;  ///< min_clearance: around the body
  Problem problem;
};

struct SolveKind {
  std::string_view problem;  ///< "a point or disc among walls"
  bool (*fits)(const Scene& scene, const RobotSpec& robot);
  std::span<const PlannerChoice> planners;  ///< empty: this version has none
  std::span<const OptionSpec> options;      ///< beyond planner_option_specs()
  /// The planner that is taken where none is asked for.
  PlannerKind (*usual_planner)(const Arguments& arguments, const Scene& scene, const ProblemOptions& problem);
  /// Solves from the world in memory to the path verified. Throws UsageError, InputError for what can't be asked; a
  /// stop is an answer. Fills in all of Answer but world, threads and peak memory.
  Answer (*solve)(const SolveRequest& request);
  /// Makes the drawing where solve() left it out because it costs; nullptr: solve() makes it. Throws Stopped.
  void (*draw)(const SolveRequest& request);
  /// Re-checks an answer; nullptr: another kind that fits does. Throws InputError where its states are none of this
  /// kind.
  Verdict (*verify)(const Scene& scene, const ProblemOptions& problem, const RecordedAnswer& answer,
                    const Execution& execution);
};

// The kinds, one a file solve_NAME.cpp.
SolveKind walls_kind();
SolveKind plane_kind();
SolveKind turning_kind();
SolveKind turning_axis_kind();
SolveKind car_kind();
SolveKind arm_kind();
SolveKind occupancy_kind();
SolveKind lattice_kind();

const std::vector<SolveKind>& solve_kinds();

/// The planner that shall solve a problem, and the kind it belongs to.
struct ChosenSolver {
  const SolveKind* kind;
  PlannerKind planner;
};

/// Checks what needs no world: is the planner that is asked for one of this version, and does it take the options?
/// Throws UsageError.
void check_solver_options(const Arguments& arguments);
/// Throws UsageError where no planner of this version solves the problem, or not the one that is asked for, or where
/// the planner would ignore an option.
ChosenSolver choose_solver(const Arguments& arguments, const Scene& scene, const ProblemOptions& problem);
/// The kind that verifies answers for this world and body; throws UsageError where this version has none.
const SolveKind& verifying_kind(const Scene& scene, const ProblemOptions& problem);

/// Does the planner take the option, a long name, for some kind of problem? All take --planner and --seed.
bool planner_takes(PlannerKind planner, std::string_view option);

/// All options of all planners, each once: --planner lists the planners of this version.
std::vector<OptionSpec> solver_option_specs();

}  // namespace warren
