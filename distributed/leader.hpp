// SPDX-License-Identifier: BSD-3-Clause
// Rank 0 of a streamed run over several: it spreads what is done tile by tile, joins what comes back, and does itself
// what one process does best. Reductions are of integers and lexicographic minima, so that the answer is that of one
// process.
//
//   generate  each rank makes its band's trees; the bands' rims are joined here           16 bytes a cell of a rim
//   there connect   each rank reduces its tiles and peels its band; what is left comes here     about 0.05 bytes a cell
//   search    here, by the code of one process
//   expand    chains of the path by their tiles' ranks                                    a byte a step
//   verify    every rank looks at the walls of its own tiles                              16 bytes a point near them
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "distributed/band.hpp"
#include "distributed/messages.hpp"
#include "distributed/remote_cells.hpp"
#include "distributed/transport.hpp"
#include "parallel/one_at_a_time.hpp"
#include "planners/tiled/other_tiles.hpp"
#include "solve/mazes/streamed_team.hpp"
#include "verify/cells/verify_cells.hpp"

namespace warren {

/// Refers to the transport, whose rank is 0.
class Leader : public StreamedTeam, private OtherTiles, private JudgesElsewhere {
 public:
  /// The others follow already, or will, until an EndOfFollowers ends.
  Leader(Transport& transport, const BandTask& task, const Execution& execution);

  const CellWallSource& make(const Execution& execution) override;
  OtherTiles& tiles() override { return *this; }
  JudgesElsewhere& judges() override { return *this; }

  /// What rank 0 would need beside what it holds, where that was more than its limit: the search runs there.
  std::optional<std::size_t> lacking_bytes() const { return lacking_bytes_; }

  /// Bytes that this rank has sent and received for each kind of request: all that went over the wire.
  const std::array<std::uint64_t, request_count>& traffic() const { return traffic_; }

  /// A tile of another rank. Any thread.
  CellTile tile(std::size_t number);

 private:
  std::vector<TileSummary> reduce_all(const OverlayEnds& ends, const Execution& execution) override;
  std::vector<std::vector<std::uint8_t>> steps_of(std::span<const TileChain> chains,
                                                  const Execution& execution) override;
  Range own_tiles() const override { return band_.tiles(); }
  void begin(std::span<const Vec2> path, double reach) override;
  std::vector<NearestWalls> take() override;

  void reserve_overlay(std::size_t bytes, std::uint64_t keys, const Execution& execution);
  void ask(Request request, std::span<const std::byte> body);
  void ask_one(unsigned rank, Request request, std::span<const std::byte> body);
  /// The answers of all, by rank; that of rank 0 is empty.
  std::vector<Bytes> answers();
  Bytes opened(unsigned rank, const Bytes& message);
  std::size_t tile_rows() const { return band_.grid().tile_rows; }

  Transport& transport_;
  const BandTask task_;
  Band band_;
  RemoteCells cells_;
  Execution execution_;
  OneAtATime asking_;
  Request asked_ = Request::make;  // last
  std::array<std::uint64_t, request_count> traffic_{};
  std::optional<std::size_t> lacking_bytes_;
};

}  // namespace warren
