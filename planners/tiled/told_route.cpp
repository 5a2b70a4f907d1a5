// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/told_route.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace warren {
namespace {

std::uint16_t number_of(const TileSummary& tile, std::uint32_t place) {
  const auto found = std::lower_bound(tile.keys.begin(), tile.keys.end(), place);
  return static_cast<std::uint16_t>(found - tile.keys.begin());
}

void sort_once(std::vector<std::uint16_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

class RouteTiles {
 public:
  RouteTiles(const TileGrid& grid, std::vector<TileSummary>& tiles) : grid_(grid), tiles_(tiles) {}

  void add_key(std::size_t tile, std::uint32_t place) {
    if (tile >= tiles_.size() || place >= grid_.side() * grid_.side()) throw InputError("path", "leaves the tiles");
    tiles_[tile].keys.push_back(static_cast<std::uint16_t>(place));
  }
  void add_link(const EndLink& link) {
    const std::uint32_t in_tile = grid_.side() - 1;
    add_key(grid_.tile_at(link.col, link.row), (link.row & in_tile) * grid_.side() + (link.col & in_tile));
  }
  /// After all keys, which are sorted then.
  void add_leg(const RouteKey& from, const RouteKey& to) {
    TileSummary& tile = tiles_[from.tile];
    const std::uint16_t a = number_of(tile, from.place);
    const std::uint16_t b = number_of(tiles_[to.tile], to.place);
    if (from.tile == to.tile) {
      tile.chains.push_back({std::min(a, b), std::max(a, b), 0, from.steps});
      return;
    }
    const unsigned side = side_to(from.tile, to.tile);
    tile.crossings[side].push_back(a);
    tiles_[to.tile].crossings[side ^ 2U].push_back(b);
  }
  void sort_keys() {
    for (TileSummary& tile : tiles_) sort_once(tile.keys);
  }
  void sort_edges() {
    for (TileSummary& tile : tiles_) {
      for (auto& crossing : tile.crossings) sort_once(crossing);
      std::stable_sort(tile.chains.begin(), tile.chains.end(),
                       [](const Chain& a, const Chain& b) { return a.from < b.from; });
    }
  }

 private:
  unsigned side_to(std::uint64_t tile, std::uint64_t other) const {
    if (other == tile + 1) return 0;
    if (other == tile + grid_.tile_cols) return 1;
    if (tile == other + 1) return 2;
    if (tile == other + grid_.tile_cols) return 3;
    throw InputError("path", "leaps between tiles");
  }

  const TileGrid& grid_;
  std::vector<TileSummary>& tiles_;
};

}  // namespace

std::vector<TileSummary> tiles_of(const ToldRoute& route, const TileGrid& grid, const OverlayEnds& ends,
                                  const Execution& execution) {
  constexpr std::size_t between_looks = 65536;
  execution.reserve(grid.count() * sizeof(TileSummary) + route.keys.size() * 2 * sizeof(Chain));
  std::vector<TileSummary> tiles(grid.count());
  RouteTiles made(grid, tiles);
  for (const EndLinks* end : {&ends.start, &ends.goal}) {
    for (const EndLink& link : end->links) made.add_link(link);
  }
  for (std::size_t i = 0; i < route.keys.size(); ++i) {
    if (i % between_looks == 0) execution.check();
    made.add_key(route.keys[i].tile, route.keys[i].place);
  }
  made.sort_keys();
  for (std::size_t i = 0; i + 1 < route.keys.size(); ++i) {
    if (i % between_looks == 0) execution.check();
    made.add_leg(route.keys[i], route.keys[i + 1]);
  }
  made.sort_edges();
  return tiles;
}

RawVector<VertexId> vertices_of(const ToldRoute& route, const Overlay& overlay, std::span<const TileSummary> tiles,
                                const Execution& execution) {
  execution.reserve((route.keys.size() + 2) * sizeof(VertexId));
  RawVector<VertexId> path;
  path.reserve(route.keys.size() + 2);
  path.push_back(overlay.start());
  for (const RouteKey& key : route.keys) {
    path.push_back(overlay.first_key(key.tile) + number_of(tiles[key.tile], key.place));
  }
  path.push_back(overlay.goal());
  return path;
}

}  // namespace warren
