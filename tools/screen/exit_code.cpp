// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/exit_code.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "core/run/execution.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/question/limits.hpp"
#include "tools/screen/run_of_verb.hpp"

namespace warren::tools {
namespace {

int report_bug(std::string_view program, std::string_view what) {
  return complain(
      program, exit_code::internal,
      fmt::format("internal error: {}\nwarren: this is a bug. Please report it with the whole command line, "
                  "the input file and the output of 'warren --version'.",
                  printable(what)));
}

/// Where the reader of our standard output has gone, say nothing and end as other programs do.
void die_if_unheard() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  if (::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0) std::raise(SIGPIPE);
}

/// For std::terminate: what was thrown where nothing may be thrown?
[[noreturn]] void end_at_once() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    ::_exit(say_memory_is_out());
  } catch (...) {
    say_on_standard_error("warren: internal error: an exception where there may be none\n");
  }
  std::abort();
}

}  // namespace

int complain(std::string_view program, int code, std::string_view text) {
  say_on_standard_error(fmt::format("{}: {}\n", program, text));
  return code;
}

int run_with_errors_told(std::string_view program, std::string_view hint, const std::function<int()>& run) {
  try {
    const int code = run();
    if (std::fflush(stdout) != 0) throw WriteError("standard output", std::generic_category().message(errno));
    if (std::ferror(stdout) != 0) throw WriteError("standard output", "it did not take all");
    return code;
  } catch (const UsageError& error) {
    return complain(program, exit_code::usage, fmt::format("{}{}", error.spelled("--", '-'), hint));
  } catch (const InputError& error) {
    return complain(program, exit_code::bad_data, error.what());
  } catch (const ReadError& error) {
    return complain(program, exit_code::unreadable, error.what());
  } catch (const WriteError& error) {
    die_if_unheard();
    return complain(program, exit_code::unwritable, error.what());
  } catch (const Stopped& stopped) {
    return complain(program, exit_code_of(stopped.reason),
                    "stopped: " + stop_text(stopped.reason, stopped.wanted_bytes));
  } catch (const std::bad_alloc&) {
    return say_memory_is_out();
  } catch (const std::exception& error) {
    return report_bug(program, error.what());
  }
}

void hold_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) >= 0) continue;
    // The lowest free number is this one; opened the wrong way round, so that its use fails.
    const int wrong_way = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (::open("/dev/null", wrong_way) < 0) return;
  }
}

void say_on_standard_error(std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t done = ::write(STDERR_FILENO, text.data(), text.size());
    if (done < 0 && errno != EINTR) return;
    if (done > 0) text.remove_prefix(static_cast<std::size_t>(done));
  }
}

int say_memory_is_out() noexcept {
  say_on_standard_error("warren: stopped: it needs more memory than it may hold\n");
  return exit_code::budget;
}

void install_last_words() { std::set_terminate(end_at_once); }

}  // namespace warren::tools
