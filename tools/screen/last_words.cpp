// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/last_words.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <exception>
#include <new>

#include "tools/screen/exit_code.hpp"

namespace warren::tools {
namespace {

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
