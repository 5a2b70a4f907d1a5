// SPDX-License-Identifier: BSD-3-Clause
// Contenders dealt out: from planners, options that all of them shall have, and lists of which each value makes a
// contender of its own, to one question and one SolveOptions a contender: every way to take one value of each list.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {

/// One value of a list: an option that is given, and the word that says which.
struct DealtValue {
  std::string word;
  SolveOptions
      value;  ///< its seed and planner mean nothing; without samples, of a list of samples, as many as it takes
};

/// The values that one option takes in turn.
struct DealtOption {
  Option option;
  std::vector<DealtValue> values;
};

/// An option that was dealt out, as files and plots name it ("goal_bias"), and its word.
using DealtWord = std::pair<std::string, std::string>;

/// A planner with its options and its question.
struct PlannerContender {
  SolveOptions options;
  Question question;
  std::vector<DealtWord> dealt;  ///< what sets it apart from the planner's other contenders
};

struct PlannerDeal {
  std::vector<PlannerKind> planners = {};
  Question question = {};               ///< asked of all
  SolveOptions common = {};             ///< each planner gets of it what it takes; without planner
  std::vector<DealtOption> lists = {};  ///< dealt in this order; an empty one leaves to each planner what is usual
  std::vector<double> clearances = {};  ///< dealt to all, in place of the question's
};

/// All contenders, planner by planner. Each gets of the options and of the lists' values those that it takes; what none
/// of the planners takes is refused with UsageError, and so are more than 10,000 contenders. A queue goes only to
/// searches that have one.
std::vector<PlannerContender> deal_planners(const PlannerDeal& deal);

/// Gives one option the value that it has in `from`.
void copy_option(Option option, SolveOptions& to, const SolveOptions& from);

}  // namespace warren::studies
