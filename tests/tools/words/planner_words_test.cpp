// SPDX-License-Identifier: BSD-3-Clause
// Words of a command line against the library's fields: every option has its flag, every enum its words.
#include "tools/words/question_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace warren::tools {
namespace {

Arguments words_of_solve(const std::vector<std::string>& words) {
  const Command command{"solve", "", "", joined_options({solve_option_specs(), question_option_specs()}), {}};
  return {command, words};
}

const OptionSpec* spec_named(const std::vector<OptionSpec>& specs, std::string_view name) {
  const auto found = std::find_if(specs.begin(), specs.end(), [&](const OptionSpec& s) { return s.name == name; });
  return found == specs.end() ? nullptr : &*found;
}

std::string flag_of(Option option) {
  std::string flag = "--" + std::string{name_of(option)};
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

/// Expects that help offers the first `count` names of an enum.
template <NamedEnum E>
void expect_choices(std::string_view option, E, std::size_t count = enum_names(E{}).size()) {
  const auto names = enum_names(E{});
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all.append(i == 0 ? "" : " ").append(names[i]);
  const std::vector<OptionSpec> specs = joined_options({solve_option_specs(), question_option_specs()});
  const OptionSpec* spec = spec_named(specs, option);
  ASSERT_NE(spec, nullptr) << option;
  EXPECT_EQ(spec->choices, all) << option;
}

TEST(PlannerWords, EveryOptionOfThePlannersHasItsFlag) {
  const std::vector<OptionSpec> specs = solve_option_specs();
  for (std::size_t i = 0; i < option_count; ++i) {
    EXPECT_NE(spec_named(specs, flag_of(static_cast<Option>(i))), nullptr) << flag_of(static_cast<Option>(i));
  }
  EXPECT_EQ(specs.size(), option_count + 2) << "and --planner and --seed, which all planners take";
}

TEST(PlannerWords, ChoicesAreTheNamesOfTheirEnums) {
  expect_choices("--planner", PlannerKind{});
  expect_choices("--sampler", SamplerKind{});
  expect_choices("--search", SearchMethod{}, 4);  // jump points are for grids
  expect_choices("--queue", QueueKind{});
  expect_choices("--lazy", LazyCheck{});
  expect_choices("--pipeline", PipelineKind{});
  expect_choices("--diagonal", Diagonal{});
  expect_choices("--layers", LayerKind{});
  expect_choices("--doors", DoorKind{});
  expect_choices("--objective", AxisObjective{});
  expect_choices("--steering", SteeringKind{});
  expect_choices("--contact", Contact{});
}

TEST(PlannerWords, WhatIsSaidIsGivenAndNothingElse) {
  EXPECT_EQ(given(solve_words(words_of_solve({}))), OptionSet{});
  EXPECT_EQ(given(solve_words(words_of_solve({"--samples", "auto", "--radius", "auto"}))), OptionSet{});
  const SolveOptions options = solve_words(words_of_solve(
      {"--neighbours", "star", "--lazy", "expansion", "--via", "1,2", "--via=3,4,5", "--attach", "2,0.5", "--full"}));
  EXPECT_EQ(given(options), (OptionSet{Option::neighbours, Option::lazy, Option::via, Option::attach, Option::full}));
  EXPECT_EQ(options.roadmap.star, StarRule::neighbours);
  EXPECT_EQ(options.roadmap.lazy, LazyCheck::expansion);
  EXPECT_EQ(options.trees.via, (std::vector<std::vector<double>>{{1, 2}, {3, 4, 5}}));
  EXPECT_EQ(options.roadmap.attach->radius, 2.0);
  EXPECT_EQ(options.roadmap.attach->step, 0.5);
  EXPECT_TRUE(solve_words(words_of_solve({"--lazy"})).visibility.lazy);
}

TEST(PlannerWords, AGapIsAShareAsANumberOrInPerCent) {
  for (const char* word : {"0.001", "1e-3", "0.1%"}) {
    EXPECT_DOUBLE_EQ(solve_words(words_of_solve({"--gap", word})).anytime.gap.value_or(-1.0), 0.001) << word;
  }
  EXPECT_EQ(solve_words(words_of_solve({"--gap", "0"})).anytime.gap, 0.0);
  EXPECT_THROW(solve_words(words_of_solve({"--gap", "-1%"})), UsageError);
}

TEST(PlannerWords, ErrorsOfTheLibraryNameTheFlag) {
  const UsageError error("@goal_bias: prm would ignore it; rrt takes it");
  EXPECT_EQ(error.spelled("--", '-'), "--goal-bias: prm would ignore it; rrt takes it");
}

}  // namespace
}  // namespace warren::tools
