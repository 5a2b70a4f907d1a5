// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/input_file_io.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"

namespace warren {
namespace {

constexpr int poll_ms = 50;
constexpr std::size_t least_mapped = std::size_t{16} << 20;

/// A descriptor that is closed at the end, unless it is standard input.
class Descriptor : NotCopied {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ > STDIN_FILENO) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void fail(const std::string& name, int error) {
  throw ReadError(name, std::generic_category().message(error));
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
  constexpr int flags = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK;  // a pipe that nobody writes to yet must not hang
  const Descriptor file(path == "-" ? STDIN_FILENO : ::open(path.c_str(), flags));
  if (file.number() < 0) fail(name_, errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail(name_, errno);
  if (S_ISDIR(status.st_mode)) fail(name_, EISDIR);
  const bool from_start = S_ISREG(status.st_mode) && ::lseek(file.number(), 0, SEEK_CUR) == 0;
  const auto size = static_cast<std::size_t>(std::max<off_t>(0, status.st_size));
  if (from_start && size >= least_mapped) {
    map(file.number(), size);
  } else {
    read_all(file.number(), from_start ? std::optional(size) : std::nullopt, execution);
  }
}

InputFile::~InputFile() {
  range_.reset();
  if (map_ != nullptr) ::munmap(map_, bytes_.size());
}

void InputFile::map(int file, std::size_t size) {
  void* block = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (block == MAP_FAILED) fail(name_, errno);
  map_ = block;
  shown_name_ = printable(name_);
  range_.emplace(map_, size, shown_name_.c_str());
  ::madvise(map_, size, MADV_SEQUENTIAL);  // a hint
  bytes_ = {static_cast<const char*>(map_), size};
}

void InputFile::read_all(int file, std::optional<std::size_t> size, const Execution& execution) {
  const std::size_t least = std::max(std::size_t{1} << 16, size.value_or(0) + 1);  // one more, to see the end
  std::size_t used = 0;
  for (;;) {
    if (used == read_.size()) {
      const std::size_t larger = std::max(least, 2 * read_.size());
      execution.reserve(larger);
      read_.resize(larger);
    }
    wait_for_input(file, execution);
    char* to = read_.data() + used;
    const std::size_t room = read_.size() - used;
    const ssize_t got = size ? ::pread(file, to, room, static_cast<off_t>(used)) : ::read(file, to, room);
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
