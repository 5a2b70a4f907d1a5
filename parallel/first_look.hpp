// SPDX-License-Identifier: BSD-3-Clause
// What must be done before the bytes of a block of somebody's memory are first looked at, say to hold them against
// their checksum: done once a block, by whichever thread comes first. A look at what was done costs a load and a test.
#pragma once

#include <bit>
#include <cstddef>

#include "parallel/lasting_marks.hpp"

namespace warren {

/// Refers to its owner. Any number of threads may call ensure().
struct FirstLook {
  const LastingMarks* done = nullptr;  ///< a bit a block; nullptr: nothing is to be done
  std::size_t first_block = 0;         ///< the bit of byte 0
  std::size_t block_bytes = 1;         ///< a power of two
  const void* owner = nullptr;
  void (*look)(const void* owner, std::size_t block) = nullptr;  ///< sets the bit, or throws

  void ensure(std::size_t first_byte, std::size_t bytes) const {
    if (done == nullptr || bytes == 0) return;
    const auto shift = static_cast<unsigned>(std::countr_zero(block_bytes));
    const std::size_t last = first_block + ((first_byte + bytes - 1) >> shift);
    for (std::size_t block = first_block + (first_byte >> shift); block <= last; ++block) {
      if (!done->test(block)) [[unlikely]]
        look(owner, block);
    }
  }
};

}  // namespace warren
