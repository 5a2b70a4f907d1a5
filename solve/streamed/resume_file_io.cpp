// SPDX-License-Identifier: BSD-3-Clause
#include "solve/streamed/resume_file_io.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "core/base/error.hpp"
#include "solve/kept/checksum.hpp"

namespace warren {
namespace {

constexpr std::array<char, 8> magic{'\x89', 'W', 'R', 'P', 'A', 'R', 'T', '\n'};
constexpr std::uint32_t version = 1;

/// As it lies in the file; the words that say what the work is follow.
struct FileHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t work_bytes;
  std::uint64_t sum;  ///< of the words
};
static_assert(sizeof(FileHeader) == 24);

/// Before the bytes of each part.
struct PartHeader {
  PartKind kind;
  std::uint32_t nothing;
  std::uint64_t number;
  std::uint64_t bytes;
  std::uint64_t sum;         ///< of the part
  std::uint64_t header_sum;  ///< of the 32 bytes before
};
static_assert(sizeof(PartHeader) == 40);

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}
std::uint64_t sum_of(const PartHeader& header) { return checksum(bytes_of(header).first(32)); }
/// How the file of this work begins.
std::string beginning_of(std::string_view work) {
  const FileHeader header{magic, version, static_cast<std::uint32_t>(work.size()),
                          checksum(std::as_bytes(std::span(work)))};
  return std::string(reinterpret_cast<const char*>(&header), sizeof header).append(work);  // NOLINT: its bytes
}
std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

ResumeFile::ResumeFile(std::string path, const Execution& execution) : path_(std::move(path)), execution_(execution) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (file_ < 0) throw WriteError(path_, reason(errno));
  struct stat status {};
  const bool is_file = ::fstat(file_, &status) == 0 && S_ISREG(status.st_mode);
  const bool is_taken = is_file && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (is_file && !is_taken) return;
  ::close(file_);
  throw WriteError(path_, is_taken ? "another run has it" : "it is no regular file");
}

ResumeFile::~ResumeFile() { ::close(file_); }

std::uint64_t ResumeFile::size() const {
  struct stat status {};
  if (::fstat(file_, &status) != 0) throw ReadError(path_, reason(errno));
  return static_cast<std::uint64_t>(status.st_size);
}

void ResumeFile::read(std::uint64_t offset, void* to, std::size_t bytes) const {
  auto* at = static_cast<std::byte*>(to);
  while (bytes > 0) {
    const ssize_t done = ::pread(file_, at, bytes, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw ReadError(path_, reason(errno));
    if (done == 0) throw ReadError(path_, "it has become shorter");
    at += done;
    offset += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
}

void ResumeFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw WriteError(path_, reason(errno));
    offset += static_cast<std::uint64_t>(done);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

void ResumeFile::begin(std::string_view work) {
  const std::string whole = beginning_of(work);
  if (size() < whole.size()) {  // half a header is what a run left that was killed at once
    check_work(work);
    write(0, std::as_bytes(std::span(whole)));
  }
  find_places(check_work(work));
}

/// Where the parts begin. Of a file that is too short for that, only that it may have begun so.
std::uint64_t ResumeFile::check_work(std::string_view work) const {
  const std::string whole = beginning_of(work);
  const std::uint64_t length = std::min<std::uint64_t>(size(), whole.size());
  std::string found(static_cast<std::size_t>(length), '\0');
  read(0, found.data(), found.size());
  if (whole.starts_with(found)) return length;
  if (!found.starts_with(std::string_view(magic.data(), std::min(magic.size(), found.size())))) {
    throw InputError(path_, "is no file of --resume, and would be lost");
  }
  throw InputError(path_, fmt::format("was begun by another run than this one, which is: {}", work));
}

void ResumeFile::find_places(std::uint64_t first) {
  const std::uint64_t last = size();
  end_ = first;
  for (std::uint64_t parts = 0; last - end_ >= sizeof(PartHeader); ++parts) {
    if (parts % 1024 == 0) execution_.check();
    PartHeader header{};
    read(end_, &header, sizeof header);
    if (header.header_sum != sum_of(header)) {
      throw InputError(path_, "is damaged: the checksum of a part's header is another", fmt::format("byte {}", end_));
    }
    const std::uint64_t begin = end_ + sizeof header;
    if (header.bytes > last - begin) break;
    places_[{header.kind, header.number}] = {begin, header.bytes, header.sum};
    end_ = begin + header.bytes;
  }
  if (::ftruncate(file_, static_cast<off_t>(end_)) != 0) throw WriteError(path_, reason(errno));
}

std::optional<Bytes> ResumeFile::find(PartKind kind, std::uint64_t number) {
  const auto found = places_.find({kind, number});
  if (found == places_.end()) return std::nullopt;
  const Place& place = found->second;
  execution_.reserve(place.bytes);
  Bytes bytes(place.bytes);
  read(place.offset, bytes.data(), bytes.size());
  if (checksum(bytes) == place.sum) return bytes;
  throw InputError(path_, "is damaged: the checksum of a part is another", fmt::format("byte {}", place.offset));
}

void ResumeFile::keep(PartKind kind, std::uint64_t number, std::span<const std::byte> bytes) {
  PartHeader header{kind, 0, number, bytes.size(), checksum(bytes), 0};
  header.header_sum = sum_of(header);
  writing_([&] {
    write(end_, bytes_of(header));
    write(end_ + sizeof header, bytes);
    end_ += sizeof header + bytes.size();
    return 0;
  });
}

}  // namespace warren
