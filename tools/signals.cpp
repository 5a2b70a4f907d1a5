// SPDX-License-Identifier: BSD-3-Clause
#include "tools/signals.hpp"

#include <csignal>

namespace warren {
namespace {

constinit SignalFlag flag{0};
static_assert(SignalFlag::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void remember(int number) { flag.store(number, std::memory_order_relaxed); }

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // no SA_RESTART: a read that waits for input must return
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_DFL);
}

const SignalFlag& signal_flag() { return flag; }

}  // namespace warren
