// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/signals.hpp"

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>

#include "core/run/mapped_ranges.hpp"
#include "tools/screen/exit_code.hpp"

namespace warren::tools {
namespace {

constinit SignalFlag flag{0};
constinit std::atomic<std::int64_t> first_ms{-1'000'000};  // long ago
static_assert(SignalFlag::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

void say(const char* text) {
  const ssize_t ignored = ::write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(ignored);
}

/// A page of an input that is no longer there: its file became shorter while it was read. Other pages are a bug's, and
/// the signal comes again with its usual effect.
void report_lost_page(int number, siginfo_t* info, void*) {
  const char* name = name_of_mapped(info->si_addr);
  if (name == nullptr) {
    std::signal(number, SIG_DFL);
    return;
  }
  say("warren: ");
  say(name);
  say(": can't be read: it became shorter meanwhile\n");
  ::_exit(exit_code::unreadable);
}

std::int64_t now_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

void remember(int number) {
  constexpr std::int64_t patience_ms = 1000;
  const std::int64_t now = now_ms();
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

bool is_ignored(int number) {
  struct sigaction action {};
  return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void install_signal_handlers() {
  stop_at(SIGINT);
  stop_at(SIGTERM);
  if (!is_ignored(SIGHUP)) stop_at(SIGHUP);  // nohup has said so
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

}  // namespace warren::tools
