// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/kind_of_problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"

namespace warren {
namespace {

const std::vector<SolveKind>& solve_kinds() {
  static const std::vector<SolveKind> kinds{occupancy_kind(),   walls_kind(),        plane_kind(), turning_kind(),
                                            fixed_angle_kind(), turning_axis_kind(), car_kind(),   arm_kind(),
                                            lattice_kind(),     streamed_kind()};
  return kinds;
}

const PlannerChoice* choice_in(const SolveKind& kind, PlannerKind planner) {
  const auto found = std::ranges::find(kind.planners, planner, &PlannerChoice::planner);
  return found == kind.planners.end() ? nullptr : &*found;
}

// Stops on the way are for every planner of a world that is held: solve_to_goal() plans from one to the next.

bool takes(const SolveKind& kind, const PlannerChoice* choice, Option option) {
  return choice != nullptr && (choice->options.has(option) || (option == Option::via && !kind.unmade));
}
bool takes(const SolveKind& kind, const PlannerChoice* choice, AskedWord word) {
  return choice != nullptr && (choice->words.has(word) || (word == AskedWord::visit && !kind.unmade));
}

template <class Word>
bool is_taken(const SolveKind& kind, Word word) {
  return std::ranges::any_of(kind.planners, [&](const PlannerChoice& choice) { return takes(kind, &choice, word); });
}

/// Does the planner of this kind take all of it? solve() keeps routes, whoever plans.
bool takes_all(const SolveKind& kind, const PlannerChoice* choice, AskedWords words, const SolveOptions& options) {
  const std::vector<AskedWord> asked = words.members();
  const std::vector<Option> wanted = given(options).members();
  const auto takes_word = [&](AskedWord word) { return takes(kind, choice, word) || word == AskedWord::keep_to; };
  const auto takes_option = [&](Option option) { return takes(kind, choice, option); };
  return choice != nullptr && std::ranges::all_of(asked, takes_word) && std::ranges::all_of(wanted, takes_option);
}

/// "a", "a and b", "a, b and c": of words or planners.
template <class Word>
std::string listed(const std::vector<Word>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ");
    if constexpr (NamedEnum<Word>) {
      text += name_of(words[i]);
    } else {
      text += words[i];
    }
  }
  return text;
}

template <class Holds>
std::vector<PlannerKind> planners_where(const Holds& holds) {
  std::vector<PlannerKind> planners;
  for (const PlannerKind planner : all_planners) {
    const bool any = std::any_of(solve_kinds().begin(), solve_kinds().end(), [&](const SolveKind& kind) {
      const PlannerChoice* choice = choice_in(kind, planner);
      return choice != nullptr && holds(kind, choice);
    });
    if (any) planners.push_back(planner);
  }
  return planners;
}

template <class Word>
std::vector<PlannerKind> takers_of(Word word) {
  return planners_where([&](const SolveKind& kind, const PlannerChoice* choice) { return takes(kind, choice, word); });
}

std::string takers_text(const std::vector<PlannerKind>& takers) {
  return fmt::format("{} {} it", listed(takers), takers.size() == 1 ? "takes" : "take");
}

/// Those of the kinds that fit a problem and take all that is asked; where there are none, those that take the word
/// alone; where these have none, all, and for which problems.
template <class Word>
std::string takers_text(Word word, const std::vector<const SolveKind*>& fitting, AskedWords words,
                        const SolveOptions& options) {
  const auto fits = [&](const SolveKind& kind) { return std::ranges::count(fitting, &kind) > 0; };
  const auto whole = planners_where([&](const SolveKind& kind, const PlannerChoice* choice) {
    return fits(kind) && takes_all(kind, choice, words, options);
  });
  if (!whole.empty()) return takers_text(whole);
  const auto here = planners_where(
      [&](const SolveKind& kind, const PlannerChoice* choice) { return fits(kind) && takes(kind, choice, word); });
  if (!here.empty()) return takers_text(here) + ", but not with all else that is asked";
  const std::vector<PlannerKind> all = takers_of(word);
  if (all.empty()) return "no planner of this version takes it";
  std::vector<std::string_view> problems;
  for (const SolveKind& kind : solve_kinds()) {
    if (is_taken(kind, word)) problems.push_back(kind.problem);
  }
  return fmt::format("{} for {}", takers_text(all), listed(problems));
}

/// Refuses the first of the options that the chosen planner would ignore, then of the words: before it one that nobody
/// takes here.
void refuse_ignored(AskedWords words, const SolveOptions& options, const ChosenSolver& chosen, const Scene& scene,
                    const Question& question, const std::vector<const SolveKind*>& fitting) {
  const PlannerChoice* choice = choice_in(*chosen.kind, chosen.planner);
  for (const Option option : given(options).members()) {
    if (takes(*chosen.kind, choice, option)) continue;
    throw UsageError(fmt::format("@{}: {} would ignore it for {}; {}", name_of(option), name_of(chosen.planner),
                                 fitting.front()->problem, takers_text(option, fitting, words, options)));
  }
  std::vector<AskedWord> ignored = words.members();
  std::erase_if(ignored, [&](AskedWord word) { return takes_all(*chosen.kind, choice, {word}, {}); });
  std::stable_partition(ignored.begin(), ignored.end(), [&](AskedWord word) {
    return std::ranges::none_of(fitting, [&](const SolveKind* kind) { return is_taken(*kind, word); });
  });
  for (const AskedWord word : ignored) {
    const bool is_factor = word == AskedWord::keep_out_factor || word == AskedWord::unknown_factor;
    const std::string_view what = is_factor ? "its factor" : word == AskedWord::goal_heading ? "its angle" : "it";
    throw UsageError(fmt::format("{}: {} would ignore {} for {}; {}", place_of_word(word, scene, question),
                                 name_of(chosen.planner), what, fitting.front()->problem,
                                 takers_text(word, fitting, words, options)));
  }
}

/// Every body has planners and a judge in every world that check_plannable takes.
std::vector<const SolveKind*> fitting_kinds(const Scene& scene, const RobotSpec& robot) {
  std::vector<const SolveKind*> fitting;
  for (const SolveKind& kind : solve_kinds()) {
    if (kind.unmade == is_unmade(scene) && kind.fits(scene, robot)) fitting.push_back(&kind);
  }
  return fitting;
}

/// The usual planner where it respects all the words and takes all the options, else the first that does; none: nobody.
std::optional<PlannerKind> planner_for_words(AskedWords asked, const SolveOptions& options, PlannerKind usual,
                                             const std::vector<const SolveKind*>& fitting) {
  std::optional<PlannerKind> first;
  for (const SolveKind* kind : fitting) {
    for (const PlannerChoice& choice : kind->planners) {
      if (!takes_all(*kind, &choice, asked, options)) continue;
      if (choice.planner == usual) return usual;
      if (!first) first = choice.planner;
    }
  }
  return first;
}

/// Only maps have corridors and cells that are known.
void check_corridors(const SolveOptions& options, const Scene& scene) {
  const auto asked = options.sampler;
  if (scene.map || (asked != SamplerKind::corridor && asked != SamplerKind::cell_centres)) return;
  throw UsageError(fmt::format("@sampler: {} is for occupancy maps, and {} is none; the others take any world",
                               name_of(*asked), scene.source));
}

[[noreturn]] void refuse_planner(PlannerKind planner, const std::vector<const SolveKind*>& fitting) {
  std::vector<PlannerKind> others;
  for (const SolveKind* kind : fitting) {
    for (const PlannerChoice& choice : kind->planners) {
      if (std::ranges::find(others, choice.planner) == others.end()) others.push_back(choice.planner);
    }
  }
  throw UsageError(fmt::format("@planner: {} does not solve {}; {} {}", name_of(planner), fitting.front()->problem,
                               listed(others), others.size() == 1 ? "does" : "do"));
}

}  // namespace

void check_solver_options(const SolveOptions& options) {
  const std::optional<PlannerKind> asked = options.planner;
  if (asked) {
    const auto has_it = [&](const SolveKind& kind) { return choice_in(kind, *asked) != nullptr; };
    if (std::ranges::none_of(solve_kinds(), has_it)) {
      throw UsageError(fmt::format("@planner: {} is none that this version has; it has {}", name_of(*asked),
                                   listed(planners_there_are())));
    }
    for (const Option option : given(options).members()) {
      if (planner_takes(*asked, option)) continue;
      throw UsageError(
          fmt::format("@{}: {} would ignore it; {}", name_of(option), name_of(*asked), takers_text(takers_of(option))));
    }
  }
  if (!asked || is_roadmap_planner(*asked)) check_planner_options(options);
}

ChosenSolver choose_solver(const SolveOptions& options, const Scene& scene, const Question& question) {
  check_plannable(scene, question);
  const std::vector<const SolveKind*> fitting = fitting_kinds(scene, robot_of(scene, question));
  check_asked(scene, question);
  const AskedWords words = words_in(scene, question);
  std::optional<PlannerKind> asked = options.planner;
  // Who names how good the path shall be, or how long it is worked on, asks for a planner that gets better.
  const bool wants_better = options.anytime.gap || options.anytime.iterations || !options.anytime.parts.empty();
  const PlannerKind usual = asked          ? *asked
                            : wants_better ? PlannerKind::anytime
                                           : fitting.front()->usual_planner(options, scene, question);
  if (!asked && !words.empty()) asked = planner_for_words(words, options, usual, fitting);
  ChosenSolver chosen{fitting.front(), asked.value_or(usual)};
  const auto has_it = [&](const SolveKind* kind) { return choice_in(*kind, chosen.planner) != nullptr; };
  const auto takes_it = [&](const SolveKind* kind) {
    return takes_all(*kind, choice_in(*kind, chosen.planner), words, options);
  };
  auto found = std::ranges::find_if(fitting, takes_it);
  if (found == fitting.end()) found = std::ranges::find_if(fitting, has_it);
  if (found == fitting.end()) refuse_planner(chosen.planner, fitting);
  chosen.kind = *found;
  refuse_ignored(words, options, chosen, scene, question, fitting);
  check_corridors(options, scene);
  return chosen;
}

std::string place_of_word(AskedWord word, const Scene& scene, const Question& question) {
  if (word == AskedWord::goal_heading && question.rule.region) return "@goal_region";
  if (words_in(question).has(word)) return fmt::format("@{}", name_of(word));
  std::string line{name_of(word)};
  if (word == AskedWord::areas || word == AskedWord::speed_zones || word == AskedWord::keep_out_factor) line = "mask";
  std::ranges::replace(line, '_', '-');
  return fmt::format("{}: its line '{}'", scene.source, line);
}

const SolveKind& verifying_kind(const Scene& scene, const Question& question) {
  check_plannable(scene, question);
  const std::vector<const SolveKind*> fitting = fitting_kinds(scene, robot_of(scene, question));
  return **std::ranges::find_if(fitting, [](const SolveKind* kind) { return kind->verify != nullptr; });
}

bool planner_takes(PlannerKind planner, Option option) {
  return std::ranges::any_of(solve_kinds(),
                             [&](const SolveKind& kind) { return takes(kind, choice_in(kind, planner), option); });
}

bool planner_takes(PlannerKind planner, Option option, const Scene& scene, const Question& question) {
  return std::ranges::any_of(fitting_kinds(scene, robot_of(scene, question)),
                             [&](const SolveKind* kind) { return takes(*kind, choice_in(*kind, planner), option); });
}

std::vector<PlannerKind> planners_there_are() {
  return planners_where([](const SolveKind&, const PlannerChoice*) { return true; });
}

}  // namespace warren
