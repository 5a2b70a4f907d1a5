// SPDX-License-Identifier: BSD-3-Clause
// Rank 0's side of the conversation: it asks, the others answer, and what keeps one of them from it is thrown here.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "distributed/messages.hpp"
#include "distributed/transport.hpp"

namespace warren::distributed {

/// Refers to the transport, whose rank is 0.
class Requests {
 public:
  Requests(Transport& transport, const Execution& execution) : transport_(transport), execution_(execution) {}

  unsigned ranks() const { return transport_.ranks(); }
  /// Whoever waits from now on waits so.
  void wait_as(const Execution& execution) { execution_ = execution; }
  void ask(Request request, std::span<const std::byte> body);
  void ask_one(unsigned rank, Request request, std::span<const std::byte> body);
  /// The answer of one. Throws Stopped, InputError.
  Bytes answer(unsigned rank);
  /// The answers of these ranks, by rank; of the others nothing. Throws Stopped, InputError.
  std::vector<Bytes> answers(std::vector<unsigned> awaited);
  /// Of all but rank 0.
  std::vector<Bytes> answers();

  /// Bytes that this rank has sent and received for each kind of request: all that went over the wire.
  const std::array<std::uint64_t, request_count>& traffic() const { return traffic_; }

 private:
  Transport& transport_;
  Execution execution_;
  Request asked_ = Request::make;  // last
  std::array<std::uint64_t, request_count> traffic_{};
};

}  // namespace warren::distributed
