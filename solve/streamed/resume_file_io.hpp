// SPDX-License-Identifier: BSD-3-Clause
// The file of --resume: finished parts of a streamed run, appended one by one as they are finished, so that a run that
// ends in whatever way goes on from them. The layout is in docs/file_formats.md. A part is written once; what a killed
// run has half written at the end is cut off by the next one; anything else that does not match its checksum is
// damage. One run at a time may have the file: it holds its lock, which ends with the process.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "core/base/packed_values.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"

namespace warren {

class ResumeFile : public KeptParts {
 public:
  /// Opens the file, or makes it. Throws WriteError, InputError for files that are none of these.
  ResumeFile(std::string path, const Execution& execution);
  ~ResumeFile() override;

  /// Throws InputError where the file is of another work or damaged, ReadError, WriteError, Stopped.
  void begin(std::string_view work) override;
  /// Throws InputError where the part is damaged, ReadError.
  std::optional<Bytes> find(PartKind kind, std::uint64_t number) override;
  /// Throws WriteError.
  void keep(PartKind kind, std::uint64_t number, std::span<const std::byte> bytes) override;

  /// Parts that an earlier run has left.
  std::size_t found_count() const { return places_.size(); }

 private:
  struct Place {
    std::uint64_t offset, bytes, sum;
  };
  std::uint64_t size() const;
  void read(std::uint64_t offset, void* to, std::size_t bytes) const;
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  std::uint64_t check_work(std::string_view work) const;
  void find_places(std::uint64_t first);

  const std::string path_;
  const Execution execution_;
  int file_ = -1;
  std::uint64_t end_ = 0;  // of whole parts; touched in writing_ from begin() on
  std::map<std::pair<PartKind, std::uint64_t>, Place> places_;
  OneAtATime writing_;
};

}  // namespace warren
