// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/mpi_transport.hpp"

#include <mpi.h>

#include <algorithm>
#include <exception>
#include <stdexcept>

namespace warren::distributed {
namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 26;
constexpr int tag = 1;

void wait_for(MPI_Request& request, const Execution& execution) {
  Patience patience;
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    patience.wait(execution);
  }
}

}  // namespace

MpiTransport::MpiTransport(int* argc, char*** argv) {
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) throw std::runtime_error("this MPI takes calls from one thread alone");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &ranks_here_);
  MPI_Comm_free(&machine);
  unread_.resize(static_cast<std::size_t>(ranks_));
}

MpiTransport::~MpiTransport() { MPI_Finalize(); }

void MpiTransport::end_all(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::terminate();
}

void MpiTransport::send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) {
  const std::uint64_t size = bytes.size();
  send_piece(to, std::as_bytes(std::span(&size, 1)), execution);
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece_bytes, bytes.size()))) {
    send_piece(to, bytes.first(std::min(piece_bytes, bytes.size())), execution);
  }
}

/// A copy goes, so that a stop leaves nothing that MPI would miss.
void MpiTransport::send_piece(unsigned to, std::span<const std::byte> bytes, const Execution& execution) {
  left_.emplace_back(bytes.begin(), bytes.end());
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend(left_.back().data(), static_cast<int>(bytes.size()), MPI_BYTE, static_cast<int>(to), tag, MPI_COMM_WORLD,
            &request);
  wait_for(request, execution);
  left_.pop_back();
  bytes_sent_ += bytes.size();
}

/// A stop in the midst of a message leaves its rest to the next call, which skips it.
Bytes MpiTransport::receive(unsigned from, const Execution& execution) {
  while (unread_[from] > 0) {
    Bytes piece(std::min<std::uint64_t>(piece_bytes, unread_[from]));
    receive_piece(from, piece, execution);
    unread_[from] -= piece.size();
  }
  std::uint64_t size = 0;
  receive_piece(from, std::as_writable_bytes(std::span(&size, 1)), execution);
  unread_[from] = size;
  execution.reserve(size);
  Bytes bytes(size);
  for (std::span<std::byte> left(bytes); !left.empty(); left = left.subspan(std::min(piece_bytes, left.size()))) {
    const std::span<std::byte> piece = left.first(std::min(piece_bytes, left.size()));
    receive_piece(from, piece, execution);
    unread_[from] -= piece.size();
  }
  return bytes;
}

/// Stops before the piece has begun to come, or not at all.
void MpiTransport::receive_piece(unsigned from, std::span<std::byte> bytes, const Execution& execution) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Irecv(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, static_cast<int>(from), tag, MPI_COMM_WORLD,
            &request);
  try {
    wait_for(request, execution);
  } catch (const Stopped&) {
    MPI_Status status;
    int is_cancelled = 0;
    MPI_Cancel(&request);
    MPI_Wait(&request, &status);
    MPI_Test_cancelled(&status, &is_cancelled);
    if (is_cancelled != 0) throw;
  }
}

bool MpiTransport::has_message(unsigned from) {
  int found = 0;
  MPI_Iprobe(static_cast<int>(from), tag, MPI_COMM_WORLD, &found, MPI_STATUS_IGNORE);
  return found != 0;
}

}  // namespace warren::distributed
