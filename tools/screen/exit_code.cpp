// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/exit_code.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "core/run/mapped_ranges.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/question/limits.hpp"
#include "tools/screen/run_of_verb.hpp"

namespace warren::tools {
namespace {

constinit SignalFlag flag{0};
constinit std::atomic<std::int64_t> first_ms{-1'000'000};  // long ago
static_assert(SignalFlag::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// A page of an input that is no longer there: its file became shorter while it was read. Other pages are a bug's, and
/// the signal comes again with its usual effect.
void report_lost_page(int number, siginfo_t* info, void*) {
  const char* name = name_of_mapped(info->si_addr);
  if (name == nullptr) {
    std::signal(number, SIG_DFL);
    return;
  }
  for (const char* part : {"warren: ", name, ": can't be read: it became shorter meanwhile\n"}) {
    say_on_standard_error(part);
  }
  ::_exit(exit_code::unreadable);
}

void remember(int number) {
  constexpr std::int64_t patience_ms = 1000;
  timespec clock{};
  ::clock_gettime(CLOCK_MONOTONIC, &clock);
  const std::int64_t now = std::int64_t{clock.tv_sec} * 1000 + clock.tv_nsec / 1'000'000;
  std::int64_t first = first_ms.load(std::memory_order_relaxed);
  if (now - first < patience_ms) return;
  if (!first_ms.compare_exchange_strong(first, now, std::memory_order_relaxed)) return;  // another thread's, right now
  int none = 0;
  if (!flag.compare_exchange_strong(none, number, std::memory_order_relaxed)) {
    std::signal(number, SIG_DFL);  // the next thing that happens in this thread
    std::raise(number);
  }
}

void stop_at(int number) {
  struct sigaction action {};
  action.sa_handler = remember;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(number, &action, nullptr);  // no SA_RESTART: a read that waits for input must return
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

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing here sets variables
  return value == nullptr ? std::string_view{} : std::string_view{value};
}

bool forces(std::string_view value) { return !value.empty() && value != "0"; }

}  // namespace

void install_signal_handlers() {
  stop_at(SIGINT);
  stop_at(SIGTERM);
  struct sigaction hang_up {};
  const bool is_ignored = ::sigaction(SIGHUP, nullptr, &hang_up) == 0 && hang_up.sa_handler == SIG_IGN;
  if (!is_ignored) stop_at(SIGHUP);  // nohup has said so
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);  // the write that is too long fails, as on a full disk
  struct sigaction lost {};
  lost.sa_sigaction = report_lost_page;
  lost.sa_flags = SA_SIGINFO;
  ::sigemptyset(&lost.sa_mask);
  ::sigaction(SIGBUS, &lost, nullptr);
}

const SignalFlag& signal_flag() { return flag; }

void forget_signal() { flag.store(0, std::memory_order_relaxed); }

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
    return complain(
        program, exit_code::internal,
        fmt::format("internal error: {}\nwarren: this is a bug. Please report it with the whole command line, "
                    "the input file and the output of 'warren --version'.",
                    printable(error.what())));
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

bool wants_color(int descriptor, ColorMode mode) {
  if (mode != ColorMode::automatic) return mode == ColorMode::always;
  if (!environment("NO_COLOR").empty()) return false;
  if (forces(environment("CLICOLOR_FORCE")) || forces(environment("FORCE_COLOR"))) return true;
  return environment("TERM") != "dumb" && ::isatty(descriptor) == 1;
}

ProgressMode resolved(ProgressMode mode) {
  if (mode != ProgressMode::automatic) return mode;
  const bool can_erase = ::isatty(STDERR_FILENO) == 1 && environment("TERM") != "dumb";
  return can_erase ? ProgressMode::bar : ProgressMode::none;
}

std::size_t terminal_width() {
  constexpr std::size_t usual = 80;
  const int columns = std::atoi(std::string{environment("COLUMNS")}.c_str());
  if (columns > 0) return static_cast<std::size_t>(columns);
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return usual;
}

void print_text(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return;
  throw WriteError("standard output", std::generic_category().message(errno));
}

}  // namespace warren::tools
