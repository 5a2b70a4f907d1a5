// SPDX-License-Identifier: BSD-3-Clause
#include "core/raw_vector.hpp"

#include <sys/mman.h>

#include <cstdlib>

namespace warren {
namespace {
constexpr std::size_t huge_page = std::size_t{2} << 20;
constexpr std::size_t large_block = std::size_t{4} << 20;
}  // namespace

void* allocate_raw(std::size_t bytes) {
  if (bytes < large_block) return ::operator new(bytes);
  const std::size_t rounded = (bytes + huge_page - 1) / huge_page * huge_page;
  void* block = rounded < bytes ? nullptr : std::aligned_alloc(huge_page, rounded);
  if (block == nullptr) throw std::bad_alloc();
  ::madvise(block, rounded, MADV_HUGEPAGE);  // a hint: nothing is lost where it is refused
  return block;
}

void release_raw(void* block, std::size_t bytes) noexcept {
  if (bytes < large_block) {
    ::operator delete(block);
  } else {
    std::free(block);
  }
}

}  // namespace warren
