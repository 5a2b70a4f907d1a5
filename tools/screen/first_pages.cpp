// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/first_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace warren::tools {
namespace {

constexpr std::size_t heap_bytes = 120 << 10;  // below what malloc() maps by itself, so that it gives them out again
constexpr std::size_t stack_bytes = 64 << 10;  // far below the first 128 KiB, which the kernel has set aside

#ifdef MADV_POPULATE_WRITE
void populate(std::uintptr_t first, std::size_t bytes) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t from = (first + page - 1) / page * page;
  const std::uintptr_t end = (first + bytes) / page * page;
  if (end > from) static_cast<void>(madvise(reinterpret_cast<void*>(from), end - from, MADV_POPULATE_WRITE));
}
#else
void populate(std::uintptr_t, std::size_t) {}
#endif

}  // namespace

void take_first_pages() {
  if (void* const heap = std::malloc(heap_bytes)) {
    populate(reinterpret_cast<std::uintptr_t>(heap), heap_bytes);
    std::free(heap);
  }
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  populate(here - stack_bytes, stack_bytes);
}

}  // namespace warren::tools
