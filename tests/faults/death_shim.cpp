// SPDX-License-Identifier: BSD-3-Clause
// For tests alone: loaded before MPI (LD_PRELOAD), it kills a rank in the midst of a phase that is too short to be met
// from outside. WARREN_DEATH says which and where: "RANK:REQUEST", the number of a request of distributed/messages.hpp.
// A rank above 0 dies half a second after it has come, so that all others are at it; rank 0 as the next message
// comes in after it has asked.
#include <mpi.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Death {
  bool is_here = false;
  std::uint32_t request = 0;
};

Death death() {
  Death death;
  unsigned asked = 0;
  const char* const words = std::getenv("WARREN_DEATH");
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  if (words == nullptr || rank == nullptr || std::sscanf(words, "%u:%u", &asked, &death.request) != 2) return death;
  death.is_here = asked == static_cast<unsigned>(std::atoi(rank));
  return death;
}

const Death planned = death();
bool has_asked = false;
struct {
  MPI_Request* request = nullptr;
  const void* bytes = nullptr;
  int count = 0;
} awaited;

/// Messages begin with their request; before each goes its size, in 8 bytes.
bool is_it(const void* bytes, int count) {
  std::uint32_t request = 0;
  if (!planned.is_here || count < static_cast<int>(sizeof request) || count == 8) return false;
  std::memcpy(&request, bytes, sizeof request);
  return request == planned.request;
}

}  // namespace

extern "C" int MPI_Isend(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm all,
                         MPI_Request* request) {
  int rank = 0;
  MPI_Comm_rank(all, &rank);
  has_asked = has_asked || (rank == 0 && is_it(bytes, count));
  return PMPI_Isend(bytes, count, type, to, tag, all, request);
}

extern "C" int MPI_Irecv(void* bytes, int count, MPI_Datatype type, int from, int tag, MPI_Comm all,
                         MPI_Request* request) {
  awaited = {request, bytes, count};
  return PMPI_Irecv(bytes, count, type, from, tag, all, request);
}

extern "C" int MPI_Test(MPI_Request* request, int* flag, MPI_Status* status) {
  const int code = PMPI_Test(request, flag, status);
  if (*flag == 0 || request != awaited.request) return code;
  const auto come = awaited;
  awaited = {};
  if (!has_asked && !is_it(come.bytes, come.count)) return code;
  if (!has_asked) ::usleep(500'000);
  std::raise(SIGKILL);
  return code;
}
