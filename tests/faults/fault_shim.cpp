// SPDX-License-Identifier: BSD-3-Clause
// For tests alone: loaded before a program's libraries (LD_PRELOAD), it lets the system refuse one call, or all from
// one on. WARREN_FAULT says which: "KIND:N" the N-th call of a kind, "KIND:N+" that and all later ones; kinds are those
// of `names` below; "stopping:N": SIGTERM comes right after the N-th renaming. WARREN_FAULT_COUNTS names a file that
// receives the number of calls of each kind when the program ends. The calls that are passed on go to glibc's own names
// or straight to the kernel, for dlsym itself allocates. What glibc asks for while it loads a library (oneTBB loads its
// allocator at its first use) is not refused: glibc 2.36 ends the program there by itself.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
// NOLINTBEGIN(readability-identifier-naming): glibc's names
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(readability-identifier-naming)
}

namespace {

enum Kind { allocation, mapping, writing, renaming, opening, closing, threads, kinds };
constexpr std::array<const char*, kinds> names{"allocation", "mapping", "writing", "renaming",
                                               "opening",    "closing", "threads"};

std::array<std::atomic<long>, kinds> calls{};
int failing_kind = -1;
long failing_call = 0;
bool for_good = false;
long stopping_call = 0;
bool counting = false;

using ThreadMaker = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
using FileOpener = std::FILE* (*)(const char*, const char*);
using LibraryOpener = void* (*)(const char*, int);
ThreadMaker make_thread = nullptr;
LibraryOpener open_library = nullptr;
thread_local int loading = 0;  // how many libraries this thread is about to load
FileOpener open_file = nullptr;

/// Counts a call; is it one to refuse?
bool refused(Kind kind) {
  if (!counting || loading > 0) return false;
  const long call = ++calls[kind];
  return kind == failing_kind && (for_good ? call >= failing_call : call == failing_call);
}

/// Sets errno and gives what a failing call returns.
int failed(int error) {
  errno = error;
  return -1;
}

__attribute__((constructor)) void begin() {
  make_thread = reinterpret_cast<ThreadMaker>(::dlsym(RTLD_NEXT, "pthread_create"));
  open_library = reinterpret_cast<LibraryOpener>(::dlsym(RTLD_NEXT, "dlopen"));
  open_file = reinterpret_cast<FileOpener>(::dlsym(RTLD_NEXT, "fopen"));
  if (const char* const fault = std::getenv("WARREN_FAULT")) {
    constexpr const char* stopping = "stopping:";
    if (std::strncmp(fault, stopping, std::strlen(stopping)) == 0)
      stopping_call = std::atol(fault + std::strlen(stopping));
    for (int kind = 0; kind < kinds; ++kind) {
      const std::size_t size = std::strlen(names[kind]);
      if (std::strncmp(fault, names[kind], size) != 0 || fault[size] != ':') continue;
      failing_kind = kind;
      failing_call = std::atol(fault + size + 1);
      for_good = fault[std::strlen(fault) - 1] == '+';
    }
  }
  counting = true;
}

__attribute__((destructor)) void end() {
  counting = false;
  const char* const place = std::getenv("WARREN_FAULT_COUNTS");
  if (place == nullptr) return;
  std::array<char, 512> text{};
  int size = 0;
  for (int kind = 0; kind < kinds; ++kind) {
    size += std::snprintf(text.data() + size, text.size() - static_cast<std::size_t>(size), "%s %ld\n", names[kind],
                          calls[kind].load());
  }
  const long file = ::syscall(SYS_openat, AT_FDCWD, place, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::syscall(SYS_write, file, text.data(), size);
  ::syscall(SYS_close, file);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  if (!refused(allocation)) return __libc_malloc(size);
  errno = ENOMEM;
  return nullptr;
}
void* calloc(std::size_t count, std::size_t size) {
  if (!refused(allocation)) return __libc_calloc(count, size);
  errno = ENOMEM;
  return nullptr;
}
void* realloc(void* block, std::size_t size) {
  if (!refused(allocation)) return __libc_realloc(block, size);
  errno = ENOMEM;
  return nullptr;
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  if (!refused(allocation)) return __libc_memalign(alignment, size);
  errno = ENOMEM;
  return nullptr;
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  if (refused(allocation)) return ENOMEM;
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

void* mmap(void* at, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  if (!refused(mapping)) return reinterpret_cast<void*>(::syscall(SYS_mmap, at, size, protection, flags, file, offset));
  errno = ENOMEM;
  return MAP_FAILED;
}
void* mmap64(void* at, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  return mmap(at, size, protection, flags, file, offset);
}

/// What a program says on standard error is not refused.
ssize_t write(int file, const void* bytes, std::size_t size) {
  return file != STDERR_FILENO && refused(writing) ? failed(ENOSPC) : ::syscall(SYS_write, file, bytes, size);
}
ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t offset) {
  return refused(writing) ? failed(ENOSPC) : ::syscall(SYS_pwrite64, file, bytes, size, offset);
}
ssize_t writev(int file, const iovec* parts, int count) {
  return refused(writing) ? failed(ENOSPC) : ::syscall(SYS_writev, file, parts, count);
}

void* dlopen(const char* name, int mode) noexcept {
  ++loading;
  void* const library = open_library(name, mode);
  --loading;
  return library;
}

int rename(const char* from, const char* to) noexcept {
  if (refused(renaming)) return failed(EIO);
  const auto result = static_cast<int>(::syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to));
  if (stopping_call > 0 && calls[renaming] == stopping_call) std::raise(SIGTERM);
  return result;
}
int linkat(int folder, const char* from, int other, const char* to, int flags) noexcept {
  return refused(renaming) ? failed(EIO) : static_cast<int>(::syscall(SYS_linkat, folder, from, other, to, flags));
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return refused(opening) ? failed(EMFILE) : static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open(path, flags, mode);
}
std::FILE* fopen(const char* path, const char* mode) {
  if (!refused(opening)) return open_file(path, mode);
  errno = EMFILE;
  return nullptr;
}
std::FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

/// The file is closed all the same, as the kernel does it.
int close(int file) {
  const int result = static_cast<int>(::syscall(SYS_close, file));
  return refused(closing) ? failed(EIO) : result;
}
int fsync(int file) { return refused(closing) ? failed(EIO) : static_cast<int>(::syscall(SYS_fsync, file)); }

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument) noexcept {
  return refused(threads) ? EAGAIN : make_thread(thread, attributes, run, argument);
}

}  // extern "C"
