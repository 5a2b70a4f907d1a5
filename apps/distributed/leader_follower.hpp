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
#include <span>
#include <vector>

#include "apps/distributed/band.hpp"
#include "apps/distributed/rank_protocol.hpp"
#include "apps/distributed/shared_search.hpp"
#include "apps/distributed/transport.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "solve/streamed/solve_streamed.hpp"
#include "verify/streamed/verify_cells.hpp"

namespace warren::distributed {

class Leader;

/// The whole maze as rank 0 sees it: its own tiles are made here, others by their ranks, when they are asked for. For
/// the few tiles that no rank's share is about: those around start and goal; and for those of two components that are
/// apart. Refers to both, which must outlive it.
class RemoteCells : public CellWallSource {
 public:
  RemoteCells(const Band& band, Leader& leader, WallsFor who);
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;

  const Band& band_;
  Leader& leader_;
  const WallsFor who_;
};

/// Refers to the transport, whose rank is 0.
class Leader : public StreamedTeam, private OtherTiles, private JudgesElsewhere {
 public:
  /// The others follow already, or will, until an EndOfFollowers ends.
  /// most_keys: more of the overlay, after the bands' own peeling, this rank does not hold, whatever its memory.
  Leader(Transport& transport, const BandTask& task, const Execution& execution,
         std::uint64_t most_keys = std::numeric_limits<std::uint64_t>::max());

  std::unique_ptr<StreamedWalls> make(const Execution& execution) override;
  OtherTiles& tiles() override { return *this; }
  JudgesElsewhere& judges() override { return *this; }

  /// The rank whose memory did not hold its share of the search, and what it would have needed beside what it held.
  std::optional<SharedSearch::Lack> lack() const { return search_ ? search_->lack() : std::nullopt; }
  const std::array<std::uint64_t, request_count>& traffic() const { return requests_.traffic(); }

  /// A tile of another rank. Any thread.
  CellTile tile(std::size_t number, WallsFor who);

 private:
  class Walls;
  std::vector<TileSummary> reduce_all(const OverlayEnds& ends, const Execution& execution) override;
  std::vector<TileSummary> reduce_whole(const OverlayEnds& ends, const Execution& execution) override;
  bool searches() const override { return search_.has_value(); }
  ToldRoute search(const OverlayEnds& ends, const Execution& execution) override;
  std::vector<std::vector<std::uint8_t>> steps_of(std::span<const TileChain> chains,
                                                  const Execution& execution) override;
  Range own_tiles() const override { return band_.tiles(); }
  void begin(std::span<const Vec2> path, double reach) override;
  std::vector<NearestWalls> take() override;

  /// All bands' tiles: those of this rank, what they are in sum, and what handing them over takes.
  struct Reduced {
    std::vector<TileSummary> own;
    ReducedBand all;
    std::size_t bytes_to_come;
  };

  void learn(const KnownWalls& theirs, unsigned rank);
  void join_trees(std::vector<maze::RimPart> rims, const Execution& execution);
  Reduced reduce_bands(const OverlayEnds& ends, BandPeeling peeling, const Execution& execution);
  std::vector<TileSummary> hand_over(std::vector<TileSummary> own, const Execution& execution);
  std::size_t tile_rows() const { return band_.grid().tile_rows; }

  Requests requests_;
  const BandTask task_;
  const std::uint64_t most_keys_;
  Band band_;
  const RemoteCells planned_;
  const RemoteCells judged_;
  KnownWalls known_;  // of a file
  OneAtATime asking_;
  OverlayEnds ends_;  // where the others search, too
  std::optional<BandRounds> rounds_;
  std::optional<SharedSearch> search_;
};

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
