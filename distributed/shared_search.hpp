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
#include <vector>

#include "distributed/band_rounds.hpp"
#include "distributed/requests.hpp"
#include "planners/tiled/told_route.hpp"

namespace warren::distributed {

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
  static constexpr double nothing_open = std::numeric_limits<double>::infinity();
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
  void take_states(const std::vector<Bytes>& answers);
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
