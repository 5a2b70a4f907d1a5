// SPDX-License-Identifier: BSD-3-Clause
// The program `warren`: a table of verbs (command.cpp). Each verb parses its words, calls the library and prints;
// what goes wrong becomes one line on standard error and an exit code here.

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <new>

#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/help.hpp"

namespace warren::tools {
namespace {

int dispatch(std::span<const std::string> words) {
  if (words.empty()) {
    say_on_standard_error(program_help());
    return exit_code::usage;
  }
  const auto say = [](const std::string& text) {
    print_text(text);
    return exit_code::success;
  };
  const std::string& first = words[0];
  if (first == "--help" || first == "-h") return say(program_help());
  if (first == "--version" || first == "-V" || first == "-v") return say(version_text(build_commit()));
  // Asked by the scripts of `warren completion`, so no verb.
  if (first == "complete") return say(completion_lines(words.subspan(1)));
  const Command& command = command_named(first);
  const Arguments arguments(command, words.subspan(1));
  if (arguments.wants_help()) return say(command_help(command, terminal_width(), arguments.wants_all_help()));
  check_outputs(arguments);
  return command.run(arguments);
}

std::string usage_hint(std::span<const std::string> words) {
  const bool is_verb = !words.empty() && words[0] != "help" && find_command(words[0]) != nullptr;
  return is_verb ? fmt::format(" (see 'warren {} --help')", words[0]) : " (see 'warren --help')";
}

// The first pages of heap and stack, asked of the kernel at once: one call instead of some fifty interruptions, half a
// microsecond each on a good day, ten on a bad one. A small question touches no more than these.

constexpr std::size_t heap_bytes = 120 << 10;  // below what malloc() maps by itself, so that it gives them out again
constexpr std::size_t stack_bytes = 64 << 10;  // far below the first 128 KiB, which the kernel has set aside

void populate([[maybe_unused]] std::uintptr_t first, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t from = (first + page - 1) / page * page;
  const std::uintptr_t end = (first + bytes) / page * page;
  if (end > from) static_cast<void>(madvise(reinterpret_cast<void*>(from), end - from, MADV_POPULATE_WRITE));
#endif
}

/// Never fails: a kernel that knows no such call gives the pages one by one, as they are touched.
void take_first_pages() {
  if (void* const heap = std::malloc(heap_bytes)) {
    populate(reinterpret_cast<std::uintptr_t>(heap), heap_bytes);
    std::free(heap);
  }
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  populate(here - stack_bytes, stack_bytes);
}

}  // namespace
}  // namespace warren::tools

int main(int argc, char** argv) {
  warren::tools::take_first_pages();
  warren::tools::hold_standard_descriptors();
  warren::tools::install_last_words();
  warren::tools::install_signal_handlers();
  try {
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    return warren::tools::run_with_errors_told("warren", warren::tools::usage_hint(words),
                                               [&] { return warren::tools::dispatch(words); });
  } catch (const std::bad_alloc&) {  // also of those who told of another error
    return warren::tools::say_memory_is_out();
  }
}
