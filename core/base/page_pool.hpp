// SPDX-License-Identifier: BSD-3-Clause
// Keeps the pages of large blocks for the next large blocks. A page that goes back to the system comes back empty, and
// on a virtual machine whose host has taken it away in between the first touch of it costs as much as two thousand
// reads (2.6 s a GiB against 0.06 s, measured on such a machine). Pages are moved in the address space (mremap), not
// copied, and in any portions, so that nothing is lost to fragmentation: a stage takes what the stage before it left,
// whatever the sizes of their arrays, and the memory held never exceeds the most that was ever in use.
#pragma once

#include <cstddef>

#include "core/base/types.hpp"

namespace warren {

/// While one of these lives, the large blocks (512 KiB and more) that its thread releases keep their pages, and the
/// large blocks that its thread allocates are made of them as far as they go; the last one to end gives the pages back.
/// Other threads are not concerned. Made and ended on the same thread, in nested order.
class PagePool : NotCopied {
 public:
  PagePool();
  ~PagePool();

  /// Bytes that this thread holds and nobody uses.
  static std::size_t idle_bytes() noexcept;
  /// The least of idle_bytes() since watch_idle_bytes(): what has been held and never used since then.
  static std::size_t least_idle_bytes() noexcept;
  static void watch_idle_bytes() noexcept;
};

namespace detail {
/// Makes the system find the whole pages within a block now, without a trap for each; contents stay. False where it
/// can't do that.
bool populate_pages(void* block, std::size_t bytes) noexcept;
}  // namespace detail

}  // namespace warren
