// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/output_file_io.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "core/error.hpp"

namespace warren {
namespace {

constexpr int poll_ms = 50;
constexpr std::size_t block_bytes = std::size_t{1} << 20;  // a pause of a few milliseconds at most

/// Holds SIGPIPE back in this thread while it lives; one that came meanwhile is swallowed.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    ::sigpending(&pending);
    was_pending_ = ::sigismember(&pending, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutSigpipe() {
    const int error = errno;
    const timespec at_once{};
    while (!was_pending_ && ::sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
    }
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = error;
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t pipe_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

/// Links followed, so that the file behind a link is replaced and not the link.
std::string resolved(const std::string& path) {
  const std::unique_ptr<char, void (*)(void*)> real(::realpath(path.c_str(), nullptr), std::free);
  return real ? real.get() : path;
}

/// Names of files that are open already: replacing what they lead to would not reach whoever reads them.
bool names_open_file(const std::string& path) {
  return path.starts_with("/dev/std") || path.starts_with("/dev/fd/") || path.starts_with("/proc/");
}

}  // namespace

OutputFile::OutputFile(const std::string& path, const Execution& execution)
    : execution_(execution), name_(path == "-" ? "standard output" : path) {
  if (path == "-") {
    file_ = STDOUT_FILENO;
    return;
  }
  if (path.empty()) fail(ENOENT);
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(errno);
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && (names_open_file(path) || !S_ISREG(status.st_mode))) {
    open_straight(path);
    return;
  }
  if (exists && ::access(path.c_str(), W_OK) != 0) fail(errno);
  open_beside(exists ? resolved(path) : path);
  if (exists) ::fchmod(file_, status.st_mode & 07777U);  // as it was; no reason to fail
}

OutputFile::~OutputFile() {
  if (file_ > STDERR_FILENO) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::open_straight(const std::string& path) {
  // Not blocking, for a pipe without a reader would hold us here; ENXIO says that there is none yet.
  while ((file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK)) < 0) {
    if (errno != ENXIO && errno != EINTR) fail(errno);
    execution_.check();
    ::poll(nullptr, 0, poll_ms);
  }
  ::fcntl(file_, F_SETFL, ::fcntl(file_, F_GETFL) & ~O_NONBLOCK);
}

void OutputFile::open_beside(const std::string& path) {
  const std::size_t slash = path.rfind('/') + 1;  // npos + 1 is 0
  for (int attempt = 0; file_ < 0; ++attempt) {
    temporary_ = fmt::format("{}.{}.{}-{}.part", path.substr(0, slash), path.substr(slash), ::getpid(), attempt);
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0 && errno != EEXIST) {
      temporary_.clear();
      fail(errno);
    }
  }
  target_ = path;
}

void OutputFile::write(std::string_view bytes) {
  if (pending_.size() + bytes.size() < block_bytes) {
    pending_.append(bytes);
    return;
  }
  flush();
  write_now(bytes);
}

void OutputFile::flush() {
  write_now(pending_);
  pending_.clear();
}

void OutputFile::write_now(std::string_view bytes) {
  const bool straight = target_.empty();
  while (!bytes.empty()) {
    execution_.check();
    std::size_t size = std::min(bytes.size(), block_bytes);
    if (straight) {  // a pipe that is ready takes PIPE_BUF bytes without blocking
      pollfd ready{file_, POLLOUT, 0};
      if (::poll(&ready, 1, poll_ms) <= 0) continue;  // nobody reads yet, or a signal came
      size = std::min<std::size_t>(size, PIPE_BUF);
    }
    const WithoutSigpipe guard;
    const ssize_t done = ::write(file_, bytes.data(), size);
    if (done < 0 && errno != EINTR && errno != EAGAIN) fail(errno);
    if (done > 0) bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::close_file() {
  const int file = file_;
  file_ = -1;
  if (file != STDOUT_FILENO && ::close(file) != 0) fail(errno);
}

void OutputFile::commit() {
  flush();
  close_file();
  if (target_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void OutputFile::fail(int error) const { throw WriteError(name_, std::generic_category().message(error)); }

void write_file(const std::string& path, std::string_view bytes, const Execution& execution) {
  OutputFile file(path, execution);
  file.write(bytes);
  file.commit();
}

}  // namespace warren
