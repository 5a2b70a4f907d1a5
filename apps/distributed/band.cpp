// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/band.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/base/error.hpp"
#include "planners/mazes/tile_source.hpp"

namespace warren::distributed {
namespace {

constexpr std::size_t grain = 8;  // tiles: a reader's scratch is large

/// The steps of the first chain of that length between the two places; there must be one.
std::span<const std::uint8_t> steps_in(const TileSummary& tile, const TileChain& asked) {
  const auto key = [&](std::uint16_t place) {
    const auto found = std::lower_bound(tile.keys.begin(), tile.keys.end(), place);
    if (found == tile.keys.end() || *found != place) throw InputError("path", "passes a point that is no key");
    return static_cast<std::uint16_t>(found - tile.keys.begin());
  };
  const std::uint16_t from = key(asked.from);
  const std::uint16_t to = key(asked.to);
  for (const Chain& chain : tile.chains) {
    if (chain.from != from || chain.to != to || chain.length != asked.length) continue;
    return std::span(tile.steps).subspan(chain.first_step, chain.length);
  }
  throw InputError("path", "takes a chain that is none");
}

}  // namespace

Range band_rows(std::size_t tile_rows, unsigned rank, unsigned ranks) {
  return {tile_rows * rank / ranks, tile_rows * (rank + std::size_t{1}) / ranks};
}

unsigned rank_of_row(std::size_t row, std::size_t tile_rows, unsigned ranks) {
  auto rank = static_cast<unsigned>(row * ranks / tile_rows);
  while (band_rows(tile_rows, rank, ranks).last <= row) ++rank;
  return rank;
}

Band::Band(const BandTask& task, Range own) : task_(task), grid_(task.grid()), own_(own) {}

std::optional<maze::RimPart> Band::make(const Execution& execution) {
  if (is_empty()) return std::nullopt;
  if (task_.unmade.packed) {
    read_ = streamed_walls(task_.unmade, own_, execution);
    return std::nullopt;
  }
  maze::RimPart rim;
  const auto [seed, loops] = *task_.unmade.formula;
  maze_.emplace(grid_.rows, grid_.cols, seed, loops, own_, rim, execution, grid_.side_log2);
  return rim;
}

const CellWallSource& Band::walls(WallsFor who) const {
  if (!read_) return *maze_;
  return who == WallsFor::judge ? read_->judged() : read_->planned();
}

std::vector<TileSummary> Band::reduce(const OverlayEnds& ends, BandPeeling peeling, const Execution& execution) {
  ends_ = ends;
  if (is_empty()) return {};
  const auto source = cell_tiles(walls(WallsFor::planner), grid_);
  execution.reserve(tiles().size() * sizeof(TileSummary));
  std::vector<TileSummary> summaries = reduce_tiles({grid_, *source, source->box(), task_.problem.reach() * (1 + 1e-9)},
                                                    ends_, grain, tiles(), false, nullptr, execution);
  if (peeling == BandPeeling::band) peel_band(grid_, own_.first, own_.last, ends_, summaries, execution);
  return summaries;
}

std::vector<std::vector<std::uint8_t>> Band::steps_of(std::span<const TileChain> chains,
                                                      const Execution& execution) const {
  std::vector<std::vector<std::uint8_t>> steps(chains.size());
  std::vector<std::size_t> own;
  for (const TileChain& chain : chains) {
    if (chain.tile >= tiles().first && chain.tile < tiles().last) own.push_back(chain.tile);
  }
  if (own.empty()) return steps;
  std::sort(own.begin(), own.end());
  own.erase(std::unique(own.begin(), own.end()), own.end());
  const auto source = cell_tiles(walls(WallsFor::planner), grid_);
  const std::vector<TileSummary> made =
      reduce_tiles({grid_, *source, source->box(), task_.problem.reach() * (1 + 1e-9)}, ends_, grain, own, execution);
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const auto at = std::lower_bound(own.begin(), own.end(), chains[i].tile);
    if (at == own.end() || *at != chains[i].tile) continue;
    const auto found = steps_in(made[static_cast<std::size_t>(at - own.begin())], chains[i]);
    steps[i].assign(found.begin(), found.end());
  }
  return steps;
}

NearestWalls Band::judge(std::span<const NearLegs> legs, double reach, const Execution& execution) const {
  NearestWalls nearest{std::numeric_limits<double>::infinity(), std::numeric_limits<std::uint64_t>::max(), 0};
  for (const NearLegs& run : legs) {
    const NearestWalls found =
        nearest_among_cells(walls(WallsFor::judge), tiles(), run.points, task_.judged(), reach, execution);
    nearest.least = std::min(nearest.least, found.least);
    if (found.leg == std::numeric_limits<std::uint64_t>::max()) continue;
    std::tie(nearest.leg, nearest.wall) =
        std::min(std::pair(nearest.leg, nearest.wall), std::pair(found.leg + run.first, found.wall));
  }
  return nearest;
}

}  // namespace warren::distributed
