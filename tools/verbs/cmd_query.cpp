// SPDX-License-Identifier: BSD-3-Clause
// warren query: asks a roadmap from a file, once, for each line of a batch, or for a table of lengths. The file is
// never written.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "solve/explain_answer.hpp"
#include "solve/kept/ask_batch_io.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/verbs/answer_command.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec query_specs[] = {
    {"--batch", "FILE", "a file with a question on each line, CSV or JSON lines; - is standard input"},
    {"--lengths-only", "", "with --batch: leave the paths out of the answers"},
    {"--matrix", "STARTS GOALS",
     "two files of places, CSV or JSON lines: give the length from each start to each goal"},
    {"--csv", "", "with --batch or --matrix: answers as CSV instead of JSON lines"},
    roadmap_world_option,
    {"--keep", "FILE", "write the roadmap to FILE; a lazy one then remembers the edges that this question has checked"},
};

class QueryCommand : public AnswerCommand {
 public:
  explicit QueryCommand(const Arguments& arguments)
      : AnswerCommand(arguments, "--keep"), question_(question_words(arguments)), how_(solve_words(arguments)) {
    if (!question_.rule.empty()) throw UsageError("--goal: a kept roadmap is asked for one goal; solve takes several");
  }

 private:
  Answer find(const Run& run, StageTimes& before, ByProducts* keep) override {
    made_roadmap_ = load_roadmap(arguments_, run.execution(), &before);
    check_outputs_of(made_roadmap_.robot);
    const RoadmapQuery query(made_roadmap_, run.execution(), Questions::one);
    QuestionScratch scratch;
    Answer answer = query.ask_explained(question_.start, question_.goal, how_, run.execution(), scratch, keep);
    if (keeps_roadmap()) learn(made_roadmap_, query, run.execution());
    return answer;
  }
  Scene scene_drawn(const Execution& execution, ByProducts&) override { return made_roadmap_.world.whole(execution); }
  void explain(const Execution& execution, Answer& answer, ByProducts& keep) override {
    const AskedWith asked{.options = made_roadmap_.options, .samples = made_roadmap_.samples, .is_kept = true};
    explain_answer(made_roadmap_.world.whole(execution), asked, answer, keep, execution);
  }

  Question question_;
  RoadmapSearchFields how_;
};

/// What was done, in words, and how much was wrong.
using Asked = std::pair<std::string, std::uint64_t>;

Asked ask_lines(const RoadmapQuery& query, const Arguments& arguments, const BatchOptions& how, const Execution& on) {
  const InputFile file(*arguments.value("--batch"), on);
  const BatchAccount account = ask_batch(query, file, how, on, print_text);
  return {fmt::format("{}, {} solved, {} wrong", counted(account.questions, "question", "questions"),
                      grouped(account.solved), grouped(account.wrong)),
          account.wrong};
}

Asked ask_table(const RoadmapQuery& query, const Arguments& arguments, const BatchOptions& how, const Execution& on) {
  const std::vector<std::string> names = arguments.values("--matrix");
  const InputFile starts(names[0], on);
  const InputFile goals(names[1], on);
  const MatrixAccount account = ask_matrix(query, starts, goals, how, on, print_text);
  return {fmt::format("{}, {}, {} solved, {} wrong", counted(account.starts, "start", "starts"),
                      counted(account.goals, "goal", "goals"), grouped(account.solved), grouped(account.wrong)),
          account.wrong};
}

int ask_many(const Arguments& arguments) {
  const bool is_table = arguments.has("--matrix");
  const BatchOptions options{solve_words(arguments), arguments.has("--lengths-only"), arguments.has("--csv")};
  const auto keep_file = output_file(arguments, "--keep");
  const std::string why = fmt::format("is for one question; {} has many", is_table ? "--matrix" : "--batch");
  arguments.refuse({"--start", "--goal", "--json", "--picture", "--explain", "--no-path"}, why);
  arguments.refuse(picture_option_specs(), why);
  arguments.refuse(path_option_specs(), why);
  Run run(arguments);
  Roadmap roadmap = load_roadmap(arguments, run.execution());
  const auto query = std::make_unique<RoadmapQuery>(roadmap, run.execution(), Questions::many);
  const auto [said, wrong] = (is_table ? ask_table : ask_lines)(*query, arguments, options, run.execution());
  if (keep_file) {
    learn(roadmap, *query, run.execution());
    write_roadmap(roadmap, *keep_file, run.execution());
  }
  run.end();
  run.note(said);
  return wrong == 0 ? exit_code::success : exit_code::bad_data;
}

int query_roadmap(const Arguments& arguments) {
  check_rules_of_maps(arguments);
  const bool batch = arguments.has("--batch");
  const bool matrix = arguments.has("--matrix");
  if (batch && matrix) throw UsageError("--matrix: makes a table of its own; leave out --batch");
  if (!batch && arguments.has("--lengths-only")) {
    throw UsageError(matrix ? "--lengths-only: is for --batch; --matrix tells lengths alone"
                            : "--lengths-only: needs --batch FILE, many questions");
  }
  if (arguments.has("--bound") && (matrix || arguments.has("--lengths-only"))) {
    throw UsageError("--bound: is of paths; lengths alone have none");
  }
  if (batch || matrix) return ask_many(arguments);
  if (arguments.has("--csv")) throw UsageError("--csv: needs --batch FILE or --matrix STARTS GOALS, many questions");
  return QueryCommand(arguments).run();
}

}  // namespace

Command query_command() {
  Command command{"query", "ROADMAP", "ask a roadmap for a path, or for many", joined_options({query_specs}),
                  query_roadmap};
  constexpr std::string_view fixed = "the roadmap was built with its own; another one takes `warren build`";
  const Command build = build_command();  // knows what it refuses itself, and why
  for (const OptionSpec& spec : solve_option_specs()) {
    const auto option = option_of_words(spec.name);
    if (option && asked_options.has(*option)) {
      command.options.push_back(spec);
    } else {
      const auto refused = std::ranges::find(build.foreign, spec.name, [](const auto& each) { return each.first; });
      command.foreign.emplace_back(spec.name, refused != build.foreign.end() ? refused->second : fixed);
    }
  }
  for (const std::string_view name : {"--robot", "--clearance", "--contact"}) command.foreign.emplace_back(name, fixed);
  command.options = joined_options(
      {command.options, options_but(question_option_specs(), {"--robot", "--clearance", "--contact", "--goal-pose"}),
       world_option_specs(), answer_output_specs(), path_option_specs(), run_option_specs()});
  return command;
}

}  // namespace warren::tools
