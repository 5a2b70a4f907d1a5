// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/page_pool.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <vector>

#include "core/base/raw_vector.hpp"

namespace warren {
namespace {

constexpr std::size_t large_block = std::size_t{512} << 10;
constexpr std::size_t huge_page = std::size_t{2} << 20;

std::size_t whole_pages(std::size_t bytes) { return (bytes + huge_page - 1) / huge_page * huge_page; }

/// A new range of addresses that begins at a huge page; nullptr if there is none.
char* map_range(std::size_t bytes) noexcept {
  constexpr int protection = PROT_READ | PROT_WRITE;
  constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  if (bytes + huge_page < bytes) return nullptr;
  void* const range = ::mmap(nullptr, bytes + huge_page, protection, flags, -1, 0);
  if (range == MAP_FAILED) return nullptr;
  char* const begin = static_cast<char*>(range);
  const std::size_t skipped = (huge_page - reinterpret_cast<std::uintptr_t>(begin) % huge_page) % huge_page;
  if (skipped > 0) ::munmap(begin, skipped);
  if (skipped < huge_page) ::munmap(begin + skipped + bytes, huge_page - skipped);
  ::madvise(begin + skipped, bytes, MADV_HUGEPAGE);  // a hint: nothing is lost where it is refused
  return begin + skipped;
}

/// Pages that were mapped together: what one mremap can move.
struct Piece {
  char* at;
  std::size_t bytes;
};

/// What one thread keeps. Invariants: pieces are whole huge pages, disjoint, mapped, and in nobody's use; idle is the
/// sum of their sizes.
class IdlePages : NotCopied {
 public:
  ~IdlePages() {
    for (const Piece& piece : pieces_) ::munmap(piece.at, piece.bytes);
  }

  /// Where they lie; nullptr if no piece is so large.
  /// The end of the smallest piece that will do: no call of the system, which would stop all threads for new addresses.
  char* take(std::size_t bytes) {
    const auto if_it_fits = [bytes](const Piece& piece) { return piece.bytes < bytes ? ~std::size_t{0} : piece.bytes; };
    const auto piece = std::ranges::min_element(pieces_, {}, if_it_fits);
    if (piece == pieces_.end() || piece->bytes < bytes) return nullptr;
    char* const block = piece->at + (piece->bytes - bytes);
    made_of_[block].assign(1, bytes);
    idle -= bytes;
    piece->bytes -= bytes;
    if (piece->bytes == 0) pieces_.erase(piece);
    least_idle = std::min(least_idle, idle);
    return block;
  }
  /// Backs a block with idle pages as far as they go; the rest stays as it is.
  void fill(char* block, std::size_t bytes) {
    std::vector<std::size_t> sizes;
    std::size_t filled = 0;
    while (filled < bytes && !pieces_.empty()) {
      const std::size_t part = std::min(bytes - filled, pieces_.back().bytes);
      if (!move_last_piece(block + filled, part)) continue;
      sizes.push_back(part);
      filled += part;
    }
    if (filled < bytes) sizes.push_back(bytes - filled);
    made_of_[block] = std::move(sizes);
    least_idle = std::min(least_idle, idle);
  }
  /// Throws std::bad_alloc before it has changed anything that matters.
  void keep(char* block, std::size_t bytes) {
    std::vector<std::size_t> sizes;
    if (auto known = made_of_.extract(block)) sizes = std::move(known.mapped());
    std::size_t sum = 0;
    for (const std::size_t size : sizes) sum += size;
    if (sum != bytes) sizes.assign(1, bytes);  // another thread's block, mapped at once
    pieces_.reserve(pieces_.size() + sizes.size());
    for (const std::size_t size : sizes) {
      pieces_.push_back({block, size});
      block += size;
    }
    idle += bytes;
  }

  int scopes = 0;
  std::size_t idle = 0;
  std::size_t least_idle = 0;

 private:
  /// Moves the end of the last piece. Where the system refuses, the piece is given up: pages are a hint, not a promise.
  bool move_last_piece(char* to, std::size_t bytes) {
    Piece& piece = pieces_.back();
    char* const from = piece.at + (piece.bytes - bytes);
    if (::mremap(from, bytes, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, to) == MAP_FAILED) {
      constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED;
      if (::mmap(to, bytes, PROT_READ | PROT_WRITE, flags, -1, 0) == MAP_FAILED) throw std::bad_alloc();
      ::munmap(piece.at, piece.bytes);
      idle -= piece.bytes;
      pieces_.pop_back();
      return false;
    }
    idle -= bytes;
    piece.bytes -= bytes;
    if (piece.bytes == 0) pieces_.pop_back();
    return true;
  }

  std::vector<Piece> pieces_;
  std::map<const char*, std::vector<std::size_t>> made_of_;  // the sizes of the pieces of a block, in their order
};

/// Owned by the outermost PagePool of the thread; nullptr while there is none. No object with a destructor: glibc
/// aborts where it has no memory to note that one.
thread_local IdlePages* thread_pages = nullptr;

}  // namespace

PagePool::PagePool() {
  if (thread_pages == nullptr) thread_pages = std::make_unique<IdlePages>().release();
  ++thread_pages->scopes;
}
PagePool::~PagePool() {
  if (--thread_pages->scopes > 0) return;
  const std::unique_ptr<IdlePages> last(thread_pages);
  thread_pages = nullptr;
}
std::size_t PagePool::idle_bytes() noexcept { return thread_pages != nullptr ? thread_pages->idle : 0; }
std::size_t PagePool::least_idle_bytes() noexcept { return thread_pages != nullptr ? thread_pages->least_idle : 0; }
void PagePool::watch_idle_bytes() noexcept {
  if (thread_pages != nullptr) thread_pages->least_idle = thread_pages->idle;
}

void* allocate_raw(std::size_t bytes) {
  if (bytes < large_block) return ::operator new(bytes);
  const std::size_t whole = whole_pages(bytes);
  if (whole < bytes) throw std::bad_alloc();
  if (thread_pages != nullptr) {
    if (char* const block = thread_pages->take(whole)) return block;
  }
  char* const block = map_range(whole);
  if (block == nullptr) throw std::bad_alloc();
  if (thread_pages != nullptr) thread_pages->fill(block, whole);
  return block;
}

void release_raw(void* block, std::size_t bytes) noexcept {
  if (bytes < large_block) return ::operator delete(block);
  const std::size_t whole = whole_pages(bytes);
  try {
    if (thread_pages != nullptr) return thread_pages->keep(static_cast<char*>(block), whole);
  } catch (const std::bad_alloc&) {  // no room for the note that says where the pages are: they go back
  }
  ::munmap(block, whole);
}

bool detail::populate_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t page = 4096;
  const auto begin = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (begin + page - 1) / page * page;
  const std::uintptr_t last = (begin + bytes) / page * page;
  return first >= last ||
         ::madvise(static_cast<char*>(block) + (first - begin), last - first, MADV_POPULATE_WRITE) == 0;
#else
  return false;
#endif
}

}  // namespace warren
