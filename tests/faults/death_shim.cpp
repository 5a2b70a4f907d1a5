// SPDX-License-Identifier: BSD-3-Clause
// For tests alone: loaded before MPI (LD_PRELOAD), it makes a rank fail in the midst of a phase that is too short to be
// met from outside.
//   WARREN_DEATH=RANK:REQUEST  kills it, by the number of a request of apps/distributed/rank_protocol.hpp: a rank above
//   0 when
//                              all others above 0 are at it, too; rank 0 as the next message comes in after it has
//                              asked
//   WARREN_SILENCE=RANK:COUNT  after so many messages it says nothing more until there is a file named go
//   WARREN_EVENTS=FOLDER       where ranks tell each other, and the test, how far they are: an empty file each
#include <mpi.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

struct Fate {
  bool is_given = false;
  bool is_here = false;
  std::uint32_t number = 0;
};

unsigned number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? static_cast<unsigned>(std::atoi(text)) : 0;
}

Fate fate(const char* variable) {
  Fate fate;
  unsigned rank = 0;
  const char* const words = std::getenv(variable);
  if (words == nullptr || std::sscanf(words, "%u:%u", &rank, &fate.number) != 2) return fate;
  fate.is_given = true;
  fate.is_here = rank == number_in("OMPI_COMM_WORLD_RANK");
  return fate;
}

const Fate death = fate("WARREN_DEATH");
const Fate silence = fate("WARREN_SILENCE");
const unsigned own_rank = number_in("OMPI_COMM_WORLD_RANK");
const unsigned rank_count = number_in("OMPI_COMM_WORLD_SIZE");
bool has_asked = false;
std::uint32_t said = 0;
std::atomic<bool> has_come = false;  // the request; what the rank calls next it calls while it is at it
struct {
  MPI_Request* request = nullptr;
  const void* bytes = nullptr;
  int count = 0;
} awaited;

std::string event(const std::string& name) {
  const char* const folder = std::getenv("WARREN_EVENTS");
  return std::string(folder != nullptr ? folder : ".") + "/" + name;
}

void tell() {
  if (std::FILE* const file = std::fopen(event(std::to_string(own_rank)).c_str(), "w")) std::fclose(file);
}

void wait_for(const std::string& name) {
  while (::access(event(name).c_str(), F_OK) != 0) ::usleep(1000);
}

void tell_if_at_it() {
  if (has_come.exchange(false)) tell();
}

void wait_for_others() {
  for (unsigned rank = 1; rank < rank_count; ++rank) {
    if (rank != own_rank) wait_for(std::to_string(rank));
  }
}

/// Before each message goes its size, in 8 bytes.
bool is_message(int count) { return count != 8; }

/// Messages begin with their request.
bool is_it(const void* bytes, int count) {
  std::uint32_t request = 0;
  if (!death.is_given || count < static_cast<int>(sizeof request) || !is_message(count)) return false;
  std::memcpy(&request, bytes, sizeof request);
  return request == death.number;
}

}  // namespace

extern "C" int MPI_Isend(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm all,
                         MPI_Request* request) {
  tell_if_at_it();
  has_asked = has_asked || (own_rank == 0 && death.is_here && is_it(bytes, count));
  if (silence.is_here && said == silence.number) {
    tell();
    wait_for("go");
  }
  if (is_message(count)) ++said;
  return PMPI_Isend(bytes, count, type, to, tag, all, request);
}

extern "C" int MPI_Iprobe(int from, int tag, MPI_Comm all, int* flag, MPI_Status* status) {
  tell_if_at_it();
  return PMPI_Iprobe(from, tag, all, flag, status);
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
  if (!has_asked && (own_rank == 0 || !is_it(come.bytes, come.count))) return code;
  if (!death.is_here) {
    has_come = true;
    return code;
  }
  if (own_rank > 0) wait_for_others();
  std::raise(SIGKILL);
  return code;
}
