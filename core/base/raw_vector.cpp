// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/raw_vector.hpp"

#include "core/base/page_pool.hpp"

namespace warren {
namespace {
constexpr std::size_t large_block = std::size_t{512} << 10;
}  // namespace

void* allocate_raw(std::size_t bytes) {
  return bytes < large_block ? ::operator new(bytes) : detail::take_pages(bytes);
}

void release_raw(void* block, std::size_t bytes) noexcept {
  if (bytes < large_block) {
    ::operator delete(block);
  } else {
    detail::return_pages(block, bytes);
  }
}

}  // namespace warren
