// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/shared_solve.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <limits>
#include <system_error>
#include <tuple>

#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "tools/verbs/answer_command.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::distributed {
namespace {

/// What is asked, as every rank reads it from the same words, and from a file that has to be the same.
struct SharedQuestion {
  explicit SharedQuestion(const tools::Arguments& arguments)
      : source(arguments.operand(0)),
        question(tools::question_words(arguments)),
        options(tools::solve_words(arguments)) {
    if (options.roadmap.pipeline.value_or(PipelineKind::streamed) != PipelineKind::streamed) {
      throw UsageError("@pipeline: ranks share the work of the pipeline streamed alone");
    }
    options.roadmap.pipeline = PipelineKind::streamed;
    question.validate();
    options.validate();
    check_solver_options(options);
  }
  /// Every rank calls it, and they tell what they see. False where that is not the same; at rank 0 then throws who sees
  /// what, or what keeps all of them from it.
  bool open(Transport& transport, const Execution& execution, double& seconds) {
    std::exception_ptr wrong;
    std::string seen;
    const StageTimer timer(execution, "read", seconds);
    try {
      std::tie(world, seen) = shared_world(source, execution);
      choose_solver(options, world, question);
      problem = keeping_off(world, question, "prm keeps off the walls");
    } catch (const Stopped&) {
      throw;
    } catch (const Error& error) {
      wrong = std::current_exception();
      seen = error.what();
    }
    const bool is_same = agree(transport, seen, execution, "does not see what rank 0 sees of the world");
    if (wrong && transport.rank() == 0) std::rethrow_exception(wrong);
    return is_same && !wrong;
  }
  BandTask task() const { return {world, problem}; }

  std::string source;
  Question question;
  SolveOptions options;
  Scene world;
  WallProblem problem;
};

class SharedSolve : public tools::AnswerCommand {
 public:
  SharedSolve(const tools::Arguments& arguments, Transport& transport)
      : tools::AnswerCommand(arguments, "--save-roadmap"), transport_(transport), asked_(arguments) {
    if (arguments.has("--explain")) {
      throw UsageError("--explain: looks at walls that are held, and these are made tile by tile");
    }
  }

 private:
  Answer find(const tools::Run& run, StageTimes& before, ByProducts*) override {
    const Execution& execution = run.execution();
    return telling_where_stopped(transport_, *execution.progress, [&] {
      asked_.open(transport_, execution, before.read);
      check_outputs_of(robot_of(asked_.world, asked_.question));
      const EndOfFollowers end(transport_);
      const std::unique_ptr<Leader> leader = leader_of(transport_, asked_.task(), execution);
      Answer answer = solve_streamed_within(asked_.world, asked_.question, asked_.options, execution,
                                            {.taker = path_taker(), .team = leader.get()});
      answer.figures.push_back({"ranks", std::uint64_t{transport_.ranks()}});
      if (answer.stop_reason) say_where_stopped(transport_, *execution.progress, *answer.stop_reason);
      if (const auto lack = leader->lack()) {
        tools::say_on_standard_error(fmt::format("warren-mpi: rank {} would need {} more for its share of the search\n",
                                                 lack->rank, human_bytes(static_cast<double>(lack->bytes))));
      }
      return answer;
    });
  }
  Scene scene_drawn(const Execution& execution, ByProducts&) override {
    return read_world(arguments_.operand(0), execution);
  }

  Transport& transport_;
  SharedQuestion asked_;
};

/// Says nothing of words that rank 0 refuses, too.
int follow_words(const tools::Arguments& arguments, Transport& transport) {
  SharedQuestion asked(arguments);
  return follow_as(arguments, transport, [&](const FollowerLimits& limits) {
    const Deadline looking(std::numeric_limits<double>::infinity(), available_bytes(), limits.signal);
    double seconds = 0.0;
    if (asked.open(transport, {.deadline = &looking, .progress = limits.progress}, seconds)) {
      follow(transport, asked.task(), limits);
    }
  });
}

[[noreturn]] void refuse() {
  throw UsageError(
      "WORLD: ranks share mazes named maze:ROWSxCOLS,algorithm=mst, whose tiles any of them can make, and files .maze "
      "and .npy of mazes, of which each reads its part");
}

/// What a file says of the walls beside their number of rows and columns.
std::string facts_of(const InputFile& file, const Scene& scene) {
  if (is_maze_file(file.bytes())) {
    return fmt::format("{} bytes with checksums {:016x}", file.bytes().size(), *scene.packed->hash);
  }
  return fmt::format("{} walls of {} x {} cells in {} bytes", npy_walls(file).walls, scene.maze->rows, scene.maze->cols,
                     file.bytes().size());
}

}  // namespace

tools::Command shared_solve_command(Transport& transport) {
  return {"solve", "WORLD", "find a path, verify it, print a summary, by all ranks together",
          tools::joined_options({tools::solve_option_specs(), tools::question_option_specs(),
                                 tools::answer_output_specs(), tools::path_option_specs(), tools::run_option_specs()}),
          [&](const tools::Arguments& arguments) {
            if (transport.rank() > 0) return follow_words(arguments, transport);
            return SharedSolve(arguments, transport).run();
          }};
}

int follow_as(const tools::Arguments& arguments, Transport& transport,
              const std::function<void(const FollowerLimits&)>& work) {
  const auto memory = tools::given_value(arguments, "--memory", tools::memory_value);
  const auto threads = tools::given_value(arguments, "--threads", tools::threads_value);
  Progress progress;
  const FollowerLimits limits{.threads = threads.value_or(0),
                              .memory_bytes = memory ? *memory : available_bytes(),
                              .signal = &tools::signal_flag(),
                              .progress = &progress};
  telling_where_stopped(transport, progress, [&] { work(limits); });
  return tools::exit_code::success;
}

std::pair<Scene, std::string> shared_world(const std::string& source, const Execution& execution) {
  if (is_maze_source(source)) {
    std::optional<Scene> scene = unmade_maze(source);
    if (!scene) refuse();
    return {std::move(*scene), ""};
  }
  std::error_code missing;
  if (source == "-" || std::filesystem::is_other(source, missing)) refuse();  // a pipe has one reader
  const InputFile file(source, execution);
  std::optional<Scene> scene = unmade_maze(file);
  if (!scene && is_npy(file.bytes())) {
    throw InputError(file.name(),
                     "its first four rows are no outline of a maze as 'warren generate' writes it; only the walls of "
                     "such mazes can be shared");
  }
  if (!scene) refuse();
  std::string facts = facts_of(file, *scene);
  return {std::move(*scene), std::move(facts)};
}

}  // namespace warren::distributed
