// SPDX-License-Identifier: BSD-3-Clause
// Rank 0's side of a search over all ranks, each of which holds the overlay of its band: for an overlay that no rank
// could hold alone. The rounds are those of one process (core/search/bidirectional_search.hpp): in each, both sides
// settle buckets, all ranks the same one at a time, until they have settled the round's number of keys between them;
// then all compare labels. So path and counts are those of one process.
//
// Cost: for each bucket, a whole number of steps up to half the path's length, a message to every rank and back, which
// have the labels of keys beyond borders. Rank 0 holds the crossings of all borders, and the path.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "apps/distributed/band.hpp"
#include "apps/distributed/rank_protocol.hpp"
#include "core/base/packed_values.hpp"
#include "core/run/execution.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/overlay_search.hpp"

namespace warren::distributed {
// One rank's share of a search in rounds: the overlay of its band, and its part of the search from both ends
// (planners/mazes/overlay_search.hpp), a step at a time as rank 0 asks for it. It
// knows nothing of other ranks.
//
// Beside its own keys the overlay has those beyond the band's borders that an edge leads to, each with that edge alone:
// so its rows and the order of its keys are those of the whole overlay. What happens to a key beyond the border is told
// by the number of its crossing, which both bands count along the border. Memory: 53 bytes a key.

/// What rank 0 asks of a band, in this order: peel until nobody has more to tell, settle and exchange until the search
/// is over, trace until both ways have come to their ends.
enum class RoundStep : std::uint32_t { hold, peel, begin, settle, exchange, rims, trace };

/// Borders of a band, and sides of the search, as they stand in messages.
enum class Border : std::uint32_t { below, above };
inline constexpr std::size_t border_count = 2;
inline constexpr std::size_t side_count = 2;

/// What an overlay that is searched holds of a key: row, count, parent, two labels.
inline constexpr std::size_t bytes_of_key = 32 + 1 + sizeof(VertexId) + 2 * sizeof(double);

/// A label over a border, by the crossing's number along it.
struct CrossingLabel {
  std::uint64_t crossing;
  double label;
};
/// What is told over the borders of a band, by side of the search and border.
template <class T>
struct BorderLists {
  std::array<std::array<std::vector<T>, border_count>, side_count> of;

  void pack(ValuePacker& to) const {
    for (const auto& side : of) {
      for (const auto& list : side) to.add_list(list);
    }
  }
  static BorderLists unpack(ValueUnpacker& from) {
    BorderLists told;
    for (auto& side : told.of) {
      for (auto& list : side) list = from.take_list<T>();
    }
    return told;
  }
};
using ToldLabels = BorderLists<CrossingLabel>;

/// Answer to RoundStep::hold: what is missing, or what the others must know of the band.
struct HeldBand {
  std::uint64_t lacking_bytes = 0;
  std::uint64_t components = 0;                                       ///< of the band by itself
  std::array<std::vector<std::uint32_t>, border_count> cols;          ///< of the crossings, ascending
  std::array<std::vector<std::uint32_t>, border_count> component_of;  ///< the crossings' own keys, numbered from 0
  std::array<std::vector<std::uint32_t>, side_count> linked;          ///< components that start and goal join
  std::uint32_t component_numbers = 0;                                ///< of these

  void pack(ValuePacker& to) const;
  static HeldBand unpack(ValueUnpacker& from);
};

/// Answer to RoundStep::begin, settle and exchange, for each side of the search.
struct SideState {
  double least = std::numeric_limits<double>::infinity();  ///< whole steps of the least open label
  std::uint64_t settled = 0;
};
/// The best meeting that a band knows: by length, then by tile and place.
struct Meeting {
  double length = std::numeric_limits<double>::infinity();
  std::uint64_t tile = 0;
  std::uint64_t place = 0;
};

/// How a way back goes on that has come to a border, or begins in the midst of a band.
struct TraceFrom {
  std::uint32_t side;
  std::uint32_t is_crossing;  ///< at a crossing of `border`; else at tile and place
  Border border;
  std::uint32_t place;
  std::uint64_t at;  ///< the crossing, or the tile
};
/// Where it ends: at the root, or over a crossing.
struct TraceEnd {
  std::uint32_t is_root;
  Border border;
  std::uint64_t crossing;
};

class BandRounds {
 public:
  /// tiles: of the band, peeled by itself, without steps. They must not be empty.
  BandRounds(const TileGrid& grid, TileRows rows, const OverlayEnds& ends, std::vector<TileSummary> tiles,
             const Execution& execution);
  BandRounds(const BandRounds&) = delete;
  BandRounds& operator=(const BandRounds&) = delete;

  /// Is the step that comes of those that are many and short?
  static bool is_short(ValueUnpacker from) {
    const auto step = from.take<RoundStep>();
    return step == RoundStep::settle || step == RoundStep::exchange || step == RoundStep::trace;
  }
  /// One step: its RoundStep and what it needs from `from`, the answer to `to`. Throws Stopped, InputError.
  void serve(ValueUnpacker& from, ValuePacker& to);

 private:
  void hold(ValuePacker& to);
  std::size_t lacking_bytes() const;
  void add_tiles_beyond();
  void keep_links();
  void keep_beyond(Range own_tiles);
  HeldBand held() const;
  void peel(ValueUnpacker& from, ValuePacker& to);
  void begin(ValuePacker& to);
  void settle(ValueUnpacker& from, ValuePacker& to);
  void exchange(ValueUnpacker& from, ValuePacker& to);
  void rims(ValueUnpacker& from, ValuePacker& to);
  void trace(ValueUnpacker& from, ValuePacker& to) const;

  void receive(ValueUnpacker& from);
  ToldLabels told();
  void say_state(ValuePacker& to);
  std::uint64_t tile_of(VertexId v) const;
  std::uint32_t place_of(VertexId v) const;
  VertexId vertex_at(const TraceFrom& from) const;
  /// The key beyond a border, and the own key that it leads to.
  VertexId beyond(Border border, std::uint64_t crossing) const;
  VertexId within(VertexId beyond) const { return overlay_->row(beyond)[0].target; }
  std::pair<Border, std::uint64_t> crossing_of(VertexId beyond) const;
  std::uint64_t crossing_count(Border border) const;

  const TileGrid grid_;
  const TileRows rows_;
  const OverlayEnds ends_;
  const Execution execution_;
  TileGrid seen_;  // the band and the rows of tiles beside it
  TileRows seen_rows_;
  OverlayEnds kept_;             // the keys beyond the borders are start's, those that start and goal join goal's
  std::size_t start_links_ = 0;  // of kept_.goal
  std::vector<TileSummary> tiles_;
  std::optional<Overlay> overlay_;
  Range own_{};                                          // keys
  std::array<std::vector<bool>, border_count> is_gone_;  // crossings whose own key is peeled, as far as told
  std::array<std::optional<StepSide>, side_count> sides_;
};

/// Refers to both; rounds is the own band's, nullptr where it has no tiles.
class SharedSearch {
 public:
  SharedSearch(Requests& requests, BandRounds* rounds, const TileGrid& grid);

  /// Throws Stopped; InputError where neighbours disagree about a border.
  ToldRoute run(const OverlayEnds& ends, const Execution& execution);
  /// What a rank would need beside what it holds, where that was more than its limit.
  struct Lack {
    unsigned rank;
    std::uint64_t bytes;
  };
  const std::optional<Lack>& lack() const { return lack_; }

 private:
  struct Side {
    double least = 0.0;  // open label, those on their way included
    double told = 0.0;   // least, as agreed at the last exchange
    std::uint64_t settled = 0;
  };

  void hold(const OverlayEnds& ends, ToldRoute& route);
  void peel();
  void search();
  void settle_round(std::uint64_t keys);
  void settle_buckets(std::array<double, side_count> bucket);
  void exchange();
  void tell_rims();
  std::vector<RouteKey> trace(std::size_t side);

  /// Asks each band, by number: body(band, to) adds what it needs. The answers, by band.
  template <class Body>
  std::vector<Bytes> all(RoundStep step, const Body& body);
  Bytes one(std::size_t band, const Bytes& message);
  /// take(from) takes what follows the states in an answer.
  template <class Take>
  void take_states(const std::vector<Bytes>& answers, const Take& take);
  void tell(const std::vector<ToldLabels>& told);

  Requests& requests_;
  BandRounds* const rounds_;
  const TileGrid grid_;
  std::vector<unsigned> ranks_;  // that have tiles, by band
  Execution execution_;
  std::vector<ToldLabels> on_way_;  // by the band that they are for
  std::array<Side, side_count> sides_;
  Meeting best_;
  std::optional<Lack> lack_;
};

}  // namespace warren::distributed
