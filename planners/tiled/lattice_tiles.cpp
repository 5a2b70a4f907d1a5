// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/lattice_tiles.hpp"

#include <memory>

#include "core/base/let_go.hpp"
#include "planners/tiles/packed_tile_summary.hpp"

namespace warren {
namespace {

/// The parts of a run are the same for any number of threads: of so many tiles each.
bool take_kept(KeptParts& kept, std::size_t first, std::uint32_t side, std::span<TileSummary> summaries) {
  const auto bytes = kept.find(PartKind::tiles, first);
  if (!bytes) return false;
  ValueUnpacker from(*bytes, "a kept part of the tiles");
  for (TileSummary& tile : summaries) tile = unpack_summary(from, side);
  if (!from.is_done()) from.refuse();
  return true;
}

void keep(KeptParts& kept, std::size_t first, std::span<const TileSummary> summaries) {
  ValuePacker packer;
  for (const TileSummary& tile : summaries) pack_summary(tile, packer);
  kept.keep(PartKind::tiles, first, packer.bytes());
}

}  // namespace

/// The scratch of one thread.
class LatticeTiles::Maker {
 public:
  explicit Maker(const LatticeTiles& tiles)
      : tiles_(tiles),
        reader_(tiles.source_.reader()),
        marker_(tiles.clearance_),
        plane_(tiles.grid_, marker_.margin()),
        reduction_(plane_),
        bytes_(std::size_t{tiles.grid_.side()} * tiles.grid_.side() / 4) {}

  TileSummary make(std::size_t tile, const Execution& execution) {
    execution.reserve(bytes_);
    tiles_.make_plane(tile, *reader_, marker_, plane_);
    tiles_.keep_linked(plane_);
    TileSummary summary = reduction_.reduce(plane_);
    bytes_ = summary.bytes();
    return summary;
  }

 private:
  const LatticeTiles& tiles_;
  std::unique_ptr<TileReader> reader_;
  WallMarker marker_;
  TilePlane plane_;
  TileReduction reduction_;
  std::size_t bytes_;  // of the last tile: the next one will take about as many
};

void LatticeTiles::make_plane(std::size_t tile, TileReader& reader, WallMarker& marker, TilePlane& plane) const {
  plane.reset(tile, box_);
  marker.mark(reader.read(tile), plane);
}

void LatticeTiles::keep_linked(TilePlane& plane) const {
  for (const EndLinks* end : {&ends_.start, &ends_.goal}) {
    for (const EndLink& link : end->links) {
      if (grid_.tile_at(link.col, link.row) != plane.tile()) continue;
      *plane.at(static_cast<int>(link.col - grid_.first_col(plane.tile())),
                static_cast<int>(link.row - grid_.first_row(plane.tile()))) |= plane_bit::kept;
    }
  }
}

void LatticeTiles::reduce(Range tiles, bool with_steps, std::span<TileSummary> summaries, KeptParts* kept,
                          const Execution& execution) const {
  for_chunks(tiles.size(), grain_, execution, [&](Range r) {
    const std::span<TileSummary> part = summaries.subspan(r.first, r.size());
    if (kept != nullptr && take_kept(*kept, tiles.first + r.first, grid_.side(), part)) return;
    Maker maker(*this);
    for (std::size_t i = 0; i < part.size(); ++i) {
      part[i] = maker.make(tiles.first + r.first + i, execution);
      if (!with_steps) let_go(part[i].steps);
    }
    if (kept != nullptr) keep(*kept, tiles.first + r.first, part);
  });
}

void LatticeTiles::reduce(std::span<const std::size_t> tiles, std::span<TileSummary> summaries,
                          const Execution& execution) const {
  for_chunks(tiles.size(), grain_, execution, [&](Range r) {
    Maker maker(*this);
    for (std::size_t i = r.first; i < r.last; ++i) summaries[i] = maker.make(tiles[i], execution);
  });
}

}  // namespace warren
