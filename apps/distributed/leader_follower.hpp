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
#include <vector>

#include "apps/distributed/band.hpp"
#include "apps/distributed/rank_protocol.hpp"

namespace warren::distributed {

// Rank 0's side of a search over all ranks (shared_search.cpp), each of which holds the overlay of its band: for an
// overlay that no rank could hold alone. The rounds are those of one process (core/search/bidirectional_search.hpp): in
// each, both sides settle buckets, all ranks the same one at a time, until they have settled the round's number of keys
// between them; then all compare labels. So path and counts are those of one process.
//
// Cost: for each bucket, a whole number of steps up to half the path's length, a message to every rank and back, which
// have the labels of keys beyond borders. Rank 0 holds the crossings of all borders, and the path.

// One rank's share of a search in rounds: the overlay of its band, and its part of the search from both ends
// (planners/mazes/overlay.hpp), a step at a time as rank 0 asks for it. It knows nothing of other ranks.
//
// Beside its own keys the overlay has those beyond the band's borders that an edge leads to, each with that edge alone:
// so its rows and the order of its keys are those of the whole overlay. What happens to a key beyond the border is told
// by the number of its crossing, which both bands count along the border. Memory: 53 bytes a key.

/// What rank 0 asks of a band, in this order: peel until nobody has more to tell, settle and exchange until the search
/// is over, trace until both ways have come to their ends.
enum class RoundStep : std::uint32_t { hold, peel, begin, settle, exchange, rims, trace };

/// What an overlay that is searched holds of a key: row, count, parent, two labels.
inline constexpr std::size_t bytes_of_key = 32 + 1 + sizeof(VertexId) + 2 * sizeof(double);

class BandRounds {
 public:
  virtual ~BandRounds() = default;

  /// Is the step that comes of those that are many and short?
  static bool is_short(ValueUnpacker from) {
    const auto step = from.take<RoundStep>();
    return step == RoundStep::settle || step == RoundStep::exchange || step == RoundStep::trace;
  }
  /// One step: its RoundStep and what it needs from `from`, the answer to `to`. That to RoundStep::hold begins with the
  /// bytes that are lacking, a std::uint64_t. Throws Stopped, InputError.
  virtual void serve(ValueUnpacker& from, ValuePacker& to) = 0;
};

/// tiles: of the band, peeled by itself, without steps. They must not be empty.
std::unique_ptr<BandRounds> band_rounds(const TileGrid& grid, Range rows, const OverlayEnds& ends,
                                        std::vector<TileSummary> tiles, const Execution& execution);

/// What a rank would need beside what it holds, where that was more than its limit.
struct SearchLack {
  unsigned rank;
  std::uint64_t bytes;
};

/// rounds: the own band's, nullptr where it has no tiles. lack: told where a rank's memory is what stops the search.
/// Throws Stopped; InputError where neighbours disagree about a border.
ToldRoute search_over_ranks(Requests& requests, BandRounds* rounds, const TileGrid& grid, const OverlayEnds& ends,
                            const Execution& execution, std::optional<SearchLack>& lack);

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
