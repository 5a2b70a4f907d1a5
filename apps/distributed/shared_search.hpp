// SPDX-License-Identifier: BSD-3-Clause
// Rank 0's side of a search over all ranks, each of which holds the overlay of its band: for an overlay that no rank
// could hold alone. The rounds are those of one process (core/search/bidirectional_search.hpp): in each, both sides
// settle buckets, all ranks the same one at a time, until they have settled the round's number of keys between them;
// then all compare labels. So path and counts are those of one process.
//
// Cost: for each bucket, a whole number of steps up to half the path's length, a message to every rank and back, which
// have the labels of keys beyond borders. Rank 0 holds the crossings of all borders, and the path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "apps/distributed/band.hpp"
#include "apps/distributed/rank_protocol.hpp"
#include "core/base/packed_values.hpp"
#include "core/run/execution.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/overlay_search.hpp"

namespace warren::distributed {
// One rank's share of a search in rounds: the overlay of its band, and its part of the search from both ends
// (planners/mazes/overlay_search.hpp), a step at a time as rank 0 asks for it. It knows nothing of other ranks.
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

}  // namespace warren::distributed
