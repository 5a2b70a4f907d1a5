// SPDX-License-Identifier: BSD-3-Clause
// The program `warren-mpi`: mpirun -n RANKS warren-mpi solve maze:ROWSxCOLS,algorithm=mst. Every rank reads the same
// words, and its part of the same file; rank 0 alone prints, and its exit code is the run's. A rank that can't go on
// ends all.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <new>

#include "apps/distributed/mpi_transport.hpp"
#include "apps/distributed/shared_solve.hpp"
#include "core/base/error.hpp"
#include "scenes/text/input_file_io.hpp"
#include "solve/kept/checksum.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/help.hpp"

namespace warren::distributed {
namespace {

/// Two builds that differ in anything differ in this.
std::string this_program() {
  const InputFile file("/proc/self/exe", {});
  return fmt::format("warren-mpi {} {:016x}", tools::build_commit(), checksum(std::as_bytes(std::span(file.bytes()))));
}

bool has(const std::vector<std::string>& words, std::string_view option) {
  return std::ranges::any_of(words, [&](const std::string& word) { return word.substr(0, word.find('=')) == option; });
}

/// Cores and memory of a machine are shared by the ranks on it, unless the words say how many each takes.
void add_limits(std::vector<std::string>& words, unsigned ranks_here) {
  if (!has(words, "--threads")) {
    words.insert(words.end(), {"--threads", std::to_string(std::max(1U, thread_count(0) / ranks_here))});
  }
  if (!has(words, "--memory")) {
    words.insert(words.end(), {"--memory", std::to_string((available_bytes() / ranks_here) >> 20U) + "MiB"});
  }
}

std::string usage_of(std::span<const tools::Command> commands) {
  std::string text = "Usage: mpirun -n RANKS warren-mpi COMMAND [operands] [options]\n\n";
  for (const tools::Command& command : commands) text += fmt::format("  {:6} {}\n", command.name, command.summary);
  return text + "\n'warren-mpi COMMAND --help' tells a command's options.\n";
}

int dispatch(std::vector<std::string> words, MpiTransport& transport) {
  const tools::Command commands[] = {shared_solve_command(transport), shared_scale_command(transport)};
  const auto told = [&](std::string_view text) {
    if (transport.rank() == 0) tools::print_text(text);
    return tools::exit_code::success;
  };
  if (words.empty() || words[0] == "--help" || words[0] == "-h") return told(usage_of(commands));
  if (words[0] == "--version") return told(tools::version_text(tools::build_commit()));
  const auto command = std::ranges::find(commands, words[0], &tools::Command::name);
  if (command == std::end(commands)) throw UsageError("unknown command " + words[0]);
  words.erase(words.begin());
  add_limits(words, transport.ranks_here());
  const tools::Arguments arguments(*command, words);
  if (arguments.wants_help()) {
    return told(tools::command_help(*command, tools::terminal_width(), arguments.wants_all_help()));
  }
  if (transport.rank() == 0) tools::check_outputs(arguments);
  return command->run(arguments);
}

/// Before anything begins, whose first stage has no name.
bool agree_on(const std::vector<std::string>& words, MpiTransport& transport) {
  std::string facts = this_program();
  for (const std::string& word : words) facts += " " + word;
  const Deadline forever(std::numeric_limits<double>::infinity(), available_bytes(), &tools::signal_flag());
  return telling_where_stopped(transport, Progress(), [&] { return agree(transport, facts, {.deadline = &forever}); });
}

int run_rank_0(const std::vector<std::string>& words, MpiTransport& transport) {
  const int code = tools::run_with_errors_told("warren-mpi", " (see 'warren-mpi --help')", [&] {
    agree_on(words, transport);
    return dispatch(words, transport);
  });
  if (!all_have_left(transport)) transport.end_all(code);
  return code;
}

/// Whatever rank 0 says as well, only rank 0 says, and gives its code.
int run_follower(const std::vector<std::string>& words, MpiTransport& transport) {
  try {
    try {
      if (agree_on(words, transport)) dispatch(words, transport);
    } catch (const UsageError&) {  // rank 0 says it
    }
    leave(transport);
    return tools::exit_code::success;
  } catch (const Stopped&) {
    transport.end_all(tools::exit_code::internal);
  } catch (const std::exception& error) {
    tools::complain("warren-mpi", tools::exit_code::internal,
                    fmt::format("rank {}: {}", transport.rank(), error.what()));
    transport.end_all(tools::exit_code::internal);
  }
}

}  // namespace
}  // namespace warren::distributed

int main(int argc, char** argv) {
  warren::tools::hold_standard_descriptors();
  warren::tools::install_last_words();
  warren::distributed::MpiTransport transport(&argc, &argv);
  warren::tools::install_signal_handlers();
  try {
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    return transport.rank() == 0 ? warren::distributed::run_rank_0(words, transport)
                                 : warren::distributed::run_follower(words, transport);
  } catch (const std::bad_alloc&) {  // also of those who told of another error
    transport.end_all(warren::tools::say_memory_is_out());
  }
}
