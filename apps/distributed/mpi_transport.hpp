// SPDX-License-Identifier: BSD-3-Clause
// Ranks by MPI: the one place that knows it. Bytes go in pieces of at most 64 MiB behind their number, for MPI counts
// in int; waits test and sleep, for MPI's own spin, which takes the core from the rank that is waited for.
#pragma once

#include <list>
#include <span>
#include <vector>

#include "apps/distributed/rank_protocol.hpp"

namespace warren::distributed {

/// One a process. Calls may come from several threads, one at a time.
class MpiTransport : public Transport {
 public:
  /// Starts MPI. Throws std::runtime_error where this MPI takes no calls from several threads in turn.
  MpiTransport(int* argc, char*** argv);
  /// Ends MPI in order: every rank must come here. Whoever can't calls end_all().
  ~MpiTransport() override;
  /// Ends all ranks at once; does not return.
  [[noreturn]] void end_all(int code);

  unsigned rank() const override { return static_cast<unsigned>(rank_); }
  unsigned ranks() const override { return static_cast<unsigned>(ranks_); }
  unsigned ranks_here() const { return static_cast<unsigned>(ranks_here_); }  ///< on this machine
  void send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) override;
  Bytes receive(unsigned from, const Execution& execution) override;
  bool has_message(unsigned from) override;

 private:
  void send_piece(unsigned to, std::span<const std::byte> bytes, const Execution& execution);
  void receive_piece(unsigned from, std::span<std::byte> bytes, const Execution& execution);

  int rank_ = 0;  // as MPI counts
  int ranks_ = 1;
  int ranks_here_ = 1;
  std::list<Bytes> left_;              // pieces whose sending a stop has cut short: MPI still has them
  std::vector<std::uint64_t> unread_;  // by rank: bytes of a message whose receiving a stop has cut short
};

}  // namespace warren::distributed
