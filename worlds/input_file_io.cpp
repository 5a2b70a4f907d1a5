// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/input_file_io.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/error.hpp"

namespace warren {
namespace {

constexpr int poll_ms = 50;

/// A descriptor that is closed at the end, unless it is standard input.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ > STDIN_FILENO) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void fail(const std::string& name, int error) {
  throw ReadError(name, std::generic_category().message(error));
}

/// O_NONBLOCK: opening a pipe that nobody writes to yet must not hang.
int open_input(const std::string& path) {
  return path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
}

/// Returns when there is something to read. A signal ends the poll early: then the deadline is asked first, since a
/// read would wait on.
void wait_for_input(int file, const Execution& execution) {
  pollfd waiting{file, POLLIN, 0};
  int ready = 0;
  do {
    execution.check();
    ready = ::poll(&waiting, 1, poll_ms);
  } while (ready == 0 || (ready < 0 && errno == EINTR));
}

}  // namespace

InputFile::InputFile(const std::string& path, const Execution& execution)
    : name_(path == "-" ? "standard input" : path) {
  execution.check();
  const Descriptor file(open_input(path));
  if (file.number() < 0) fail(name_, errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail(name_, errno);
  if (S_ISDIR(status.st_mode)) fail(name_, EISDIR);
  const bool from_start = S_ISREG(status.st_mode) && ::lseek(file.number(), 0, SEEK_CUR) == 0;
  if (from_start && status.st_size > 0) {
    map(file.number(), static_cast<std::size_t>(status.st_size));
  } else {
    read_all(file.number(), execution);
  }
}

InputFile::~InputFile() {
  if (map_ != nullptr) ::munmap(map_, bytes_.size());
}

void InputFile::map(int file, std::size_t size) {
  void* block = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (block == MAP_FAILED) fail(name_, errno);
  map_ = block;
  ::madvise(map_, size, MADV_SEQUENTIAL);  // a hint
  bytes_ = {static_cast<const char*>(map_), size};
}

void InputFile::read_all(int file, const Execution& execution) {
  constexpr std::size_t least = std::size_t{1} << 16;
  std::size_t used = 0;
  for (;;) {
    if (used == read_.size()) {
      execution.reserve(read_.size() + least);
      read_.resize(std::max(least, 2 * read_.size()));
    }
    wait_for_input(file, execution);
    const ssize_t got = ::read(file, read_.data() + used, read_.size() - used);
    if (got == 0) break;
    if (got < 0 && errno != EINTR && errno != EAGAIN) fail(name_, errno);
    if (got > 0) used += static_cast<std::size_t>(got);
  }
  bytes_ = {read_.data(), used};
}

void InputFile::forget(std::size_t first, std::size_t last) const noexcept {
  if (map_ == nullptr) return;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t begin = first / page * page;
  const std::size_t end = std::min((last + page - 1) / page * page, bytes_.size());
  if (begin < end) ::madvise(static_cast<char*>(map_) + begin, end - begin, MADV_DONTNEED);
}

}  // namespace warren
