// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/output_file_io.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/base/error.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

constexpr int pipe_poll_ms = 50;
constexpr std::size_t block_bytes = std::size_t{1} << 20;  // a pause of a few milliseconds at most

/// Holds SIGPIPE back in this thread while it lives; one that came meanwhile is swallowed.
class WithoutSigpipe : NotCopied {
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

 private:
  sigset_t pipe_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

/// The descriptor that a path names as one of this process; -1 for other paths.
int descriptor_named(std::string_view path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    if (const auto number = scene_text::number_in_full<int>(path.substr(folder.size()))) return *number;
  }
  return -1;
}

std::size_t begin_of_name(std::string_view path) { return path.rfind('/') + 1; }  // npos + 1 is 0

/// "folder/.NAME" of "folder/NAME", to which ".part" is added. Never longer than long names are, so that it is legal
/// wherever they are; cut between two characters of UTF-8.
std::string stem_of_parts(const std::string& target) {
  constexpr std::size_t short_name = 128;
  constexpr std::size_t room = 16;  // for what is added
  const std::size_t begin = begin_of_name(target);
  std::size_t size = target.size() - begin;
  if (size > short_name) size -= room;
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(target[i]) & 0xC0U) == 0x80U; };
  while (begin + size < target.size() && size > 1 && continues(begin + size)) --size;
  return target.substr(0, begin) + "." + target.substr(begin, size);
}

/// Is the open file the one of that name? Not any more once it was renamed or removed.
bool is_named(int file, const std::string& name) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

/// Removes a file that nobody writes any more. Where the file system has no locks nobody can know, and it stays.
void remove_rest(const std::string& part) {
  const int file = ::open(part.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0 && is_named(file, part)) ::unlink(part.c_str());
  ::close(file);
}

}  // namespace

bool is_standard_output(std::string_view path) { return path == "-" || descriptor_named(path) == STDOUT_FILENO; }

bool is_written_straight(const std::string& path) {
  struct stat status {};
  if (path == "-") return true;
  // So are files called that are open already: replacing what they lead to would not reach whoever reads them.
  const bool is_open = path.starts_with("/dev/std") || path.starts_with("/dev/fd/") || path.starts_with("/proc/");
  return ::stat(path.c_str(), &status) == 0 && (is_open || !S_ISREG(status.st_mode));
}

std::string behind_links(std::string path) {
  constexpr int most_links = 40;  // as the system has it
  std::string target(PATH_MAX, '\0');
  for (int link = 0; link < most_links; ++link) {
    const ssize_t size = ::readlink(path.c_str(), target.data(), target.size());
    if (size <= 0) break;
    const std::string_view to = std::string_view(target).substr(0, static_cast<std::size_t>(size));
    path.replace(to.starts_with('/') ? 0 : begin_of_name(path), std::string::npos, to);
  }
  return path;
}

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
  if (is_written_straight(path)) {
    open_straight(path);
    return;
  }
  if (exists && ::access(path.c_str(), W_OK) != 0) fail(errno);
  open_beside(behind_links(path));
  if (exists) ::fchmod(file_, status.st_mode & 07777U);  // as it was; no reason to fail
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() noexcept {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (file_ > STDERR_FILENO) ::close(file_);
  temporary_.clear();
  file_ = -1;
}

void OutputFile::open_straight(const std::string& path) {
  if (const int open = descriptor_named(path); open >= 0) {  // opened again it would begin at its beginning again
    file_ = ::fcntl(open, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (file_ < 0) fail(errno);
    return;
  }
  // Not blocking, for a pipe without a reader would hold us here; ENXIO says that there is none yet.
  while ((file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK)) < 0) {
    if (errno != ENXIO && errno != EINTR) fail(errno);
    execution_.check();
    ::poll(nullptr, 0, pipe_poll_ms);
  }
  ::fcntl(file_, F_SETFL, ::fcntl(file_, F_GETFL) & ~O_NONBLOCK);
}

/// Removes what killed runs left and takes the first of .NAME.part, .NAME.2.part, … that no other run writes.
void OutputFile::open_beside(std::string target) {
  constexpr int looked_at = 8;  // as many runs may write the same file at once and none of their rests is missed
  const std::string stem = stem_of_parts(target);
  const auto part = [&](int number) { return number == 1 ? stem + ".part" : fmt::format("{}.{}.part", stem, number); };
  target_ = std::move(target);
  for (int number = 1; number <= looked_at; ++number) remove_rest(part(number));
  for (int number = 1; !create(part(number)); ++number) {
    if (errno != EEXIST) fail(errno);
  }
}

/// Makes and locks a file of that name; false, with errno, where it can't. EEXIST: another run has it.
bool OutputFile::create(std::string part) {
  temporary_ = std::move(part);  // nothing that throws may follow the open
  file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) {
    temporary_.clear();
    return false;
  }
  const bool another_has_it = ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (!another_has_it && is_named(file_, temporary_)) return true;
  temporary_.clear();  // between the two another run has taken it for a rest
  discard();
  errno = EEXIST;
  return false;
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
      if (::poll(&ready, 1, pipe_poll_ms) <= 0) continue;  // nobody reads yet, or a signal came
      size = std::min<std::size_t>(size, PIPE_BUF);
    }
    const WithoutSigpipe guard;
    const ssize_t done = ::write(file_, bytes.data(), size);
    if (done < 0 && errno != EINTR && errno != EAGAIN) fail(errno);
    if (done > 0) bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::complete() {
  flush();
  if (target_.empty()) return;
  // Some file systems tell only who closes a file that it could not be written. The file stays open, for its lock.
  const int twin = ::fcntl(file_, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (twin < 0 || ::close(twin) != 0) fail(errno);
}

void OutputFile::commit() {
  complete();
  if (!target_.empty()) {
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    temporary_.clear();
    discard();  // all is written and in its place: closing can't fail any more
    return;
  }
  const int file = file_;
  file_ = -1;
  if (file != STDOUT_FILENO && ::close(file) != 0) fail(errno);
}

void OutputFile::fail(int error) const { throw WriteError(name_, std::generic_category().message(error)); }

FirstOfTwoFiles::FirstOfTwoFiles(const std::string& path) {
  if (path != "-" && ::access(path.c_str(), F_OK) != 0) path_ = behind_links(path);
}

FirstOfTwoFiles::~FirstOfTwoFiles() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

void write_file(const std::string& path, std::string_view bytes, const Execution& execution) {
  OutputFile file(path, execution);
  file.write(bytes);
  file.commit();
}

}  // namespace warren
