// SPDX-License-Identifier: BSD-3-Clause
// Rank 0 of a streamed run over several, and the ranks that follow it. Rank 0 spreads what is done tile by tile, joins
// what comes back, and does itself what one process does best. Reductions are of integers and lexicographic minima, so
// that the answer is that of one process.
//
//   generate  each rank makes its band's trees; the bands' rims are joined here           16 bytes a cell of a rim
//   index     or each reads what a file has of its band there
//   connect   each rank reduces its tiles and peels its band; what is left comes here     about 0.05 bytes a cell
//   search    here, by the code of one process; where this rank can't hold what would come, by all ranks in rounds
//   expand    chains of the path by their tiles' ranks                                    a byte a step
//   verify    every rank looks at the walls of its own tiles                              16 bytes a point near them
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "apps/distributed/band.hpp"
#include "apps/distributed/rank_protocol.hpp"
#include "apps/distributed/shared_search.hpp"
#include "core/run/execution.hpp"
#include "solve/streamed/solve_streamed.hpp"

namespace warren::distributed {

/// Rank 0.
class Leader : public StreamedTeam {
 public:
  /// The rank whose memory did not hold its share of the search, and what it would have needed beside what it held.
  virtual std::optional<SearchLack> lack() const = 0;
  /// Bytes that this rank has sent and received for each kind of request.
  virtual const std::array<std::uint64_t, request_count>& traffic() const = 0;
};

/// Refers to the transport, whose rank is 0. The others follow already, or will, until an EndOfFollowers ends.
/// most_keys: more of the overlay, after the bands' own peeling, this rank does not hold, whatever its memory.
std::unique_ptr<Leader> leader_of(Transport& transport, const BandTask& task, const Execution& execution,
                                  std::uint64_t most_keys = std::numeric_limits<std::uint64_t>::max());

/// How every rank but 0 runs, which does what rank 0 asks for. It has no time limit of its own: rank 0's ends it.
struct FollowerLimits {
  unsigned threads = 0;
  std::size_t memory_bytes = 0;
  const SignalFlag* signal = nullptr;  ///< nullptr: none comes
  Progress* progress = nullptr;        ///< says what it does
};

/// Returns when rank 0 has said the end. Throws Stopped at a signal.
void follow(Transport& transport, const BandTask& task, const FollowerLimits& limits);

}  // namespace warren::distributed
