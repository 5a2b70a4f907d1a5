// SPDX-License-Identifier: BSD-3-Clause
// warren query: asks a roadmap from a file, once or for each line of a batch. The file is never written.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/roadmaps/ask_batch_io.hpp"
#include "solve/roadmaps/roadmap_file_io.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/roadmap_files.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/answer_command.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren {
namespace {

constexpr OptionSpec query_specs[] = {
    {"--batch", "FILE", "ask each line of this file, CSV or JSON lines; - is standard input"},
    {"--lengths-only", "", "with --batch: answers without their paths"},
    {"--csv", "", "with --batch: answers as CSV instead of JSON lines"},
    roadmap_world_option,
    {"--keep", "FILE", "write the roadmap with what this question has learnt of its edges"},
};

RoadmapSearchFields how_to_search(const Arguments& arguments) {
  const SolveOptions words = solve_words(arguments);
  return {words.search, words.queue, words.roadmap.attach, words.optimise, words.car.cusp_cost, words.car.reverse_cost};
}

class QueryCommand : public AnswerCommand {
 public:
  explicit QueryCommand(const Arguments& arguments)
      : AnswerCommand(arguments),
        question_(question_words(arguments)),
        how_(how_to_search(arguments)),
        keep_file_(output_file(arguments, "--keep")) {}

 private:
  Answer find(const Run& run, StageTimes& before, ByProducts* keep) override {
    roadmap_ = load_roadmap(arguments_, run.execution(), before);
    const RoadmapQuery query(roadmap_, run.execution(), Questions::one);
    QuestionScratch scratch;
    Answer answer = query.ask_within(question_.start, question_.goal, how_, run.execution(), scratch, keep);
    if (keep_file_) learn(roadmap_, query, run.execution());
    return answer;
  }
  Scene scene_drawn(const Execution&, ByProducts&) override { return roadmap_.scene; }
  void write_more(const Execution& execution) override {
    if (keep_file_) write_roadmap(roadmap_, *keep_file_, execution);
  }

  Question question_;
  RoadmapSearchFields how_;
  std::optional<std::string> keep_file_;
  Roadmap roadmap_;
};

int ask_lines(const Arguments& arguments, const std::string& file) {
  for (const std::string_view option : {"--start", "--goal", "--json", "--svg"}) {
    if (arguments.has(option)) throw UsageError(fmt::format("{}: is for one question; --batch has many", option));
  }
  const BatchOptions options{how_to_search(arguments), arguments.has("--lengths-only"), arguments.has("--csv")};
  const auto keep_file = output_file(arguments, "--keep");
  Run run(arguments);
  StageTimes seconds;
  Roadmap roadmap = load_roadmap(arguments, run.execution(), seconds);
  const auto query = std::make_unique<RoadmapQuery>(roadmap, run.execution(),
                                                    options.lengths_only ? Questions::lengths : Questions::many);
  const InputFile questions(file, run.execution());
  const BatchAccount account = ask_batch(*query, questions, options, run.execution(), print_text);
  if (keep_file) {
    learn(roadmap, *query, run.execution());
    write_roadmap(roadmap, *keep_file, run.execution());
  }
  run.end();
  run.note(fmt::format("{} questions, {} solved, {} wrong", grouped(account.questions), grouped(account.solved),
                       grouped(account.wrong)));
  return account.wrong == 0 ? exit_code::success : exit_code::bad_data;
}

int query_roadmap(const Arguments& arguments) {
  check_rules_of_maps(arguments);
  if (const auto file = arguments.value("--batch")) return ask_lines(arguments, std::string(*file));
  for (const std::string_view option : {"--lengths-only", "--csv"}) {
    if (arguments.has(option)) throw UsageError(fmt::format("{}: needs --batch FILE, many questions", option));
  }
  return QueryCommand(arguments).run();
}

}  // namespace

Command query_command() {
  Command command{"query", "ROADMAP", "ask a roadmap for a path, or for many", {}, query_roadmap};
  add_options(command.options, query_specs);
  for (const OptionSpec& spec : solve_option_specs()) {
    constexpr std::string_view asked[] = {"--search",    "--queue",        "--optimise",
                                          "--cusp-cost", "--reverse-cost", "--attach"};
    if (std::find(std::begin(asked), std::end(asked), spec.name) != std::end(asked)) command.options.push_back(spec);
  }
  add_options(command.options, question_option_specs(), {"--robot", "--clearance", "--contact"});
  add_options(command.options, world_option_specs());
  add_options(command.options, answer_output_specs());
  add_options(command.options, run_option_specs());
  return command;
}

}  // namespace warren
