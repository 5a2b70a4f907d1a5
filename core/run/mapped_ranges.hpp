// SPDX-License-Identifier: BSD-3-Clause
// Which memory is a mapped file, for handlers of SIGBUS: a file that becomes shorter while it is mapped leaves pages
// that nobody can read, in whatever thread. At most 16 at once are known; more are mapped like all others, but not
// known.
#pragma once

#include <cstddef>

namespace warren {

/// Known while it lives. `name` must outlive it.
class MappedRange {
 public:
  MappedRange(const void* begin, std::size_t bytes, const char* name) noexcept;
  ~MappedRange();
  MappedRange(const MappedRange&) = delete;
  MappedRange& operator=(const MappedRange&) = delete;

 private:
  std::size_t slot_;
};

/// The name of the range that holds an address, or nullptr. May be called from a signal handler.
const char* name_of_mapped(const void* address) noexcept;

}  // namespace warren
