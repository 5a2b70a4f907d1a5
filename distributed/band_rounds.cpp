// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/band_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/error.hpp"
#include "core/base/let_go.hpp"
#include "planners/tiled/overlay_components.hpp"
#include "planners/tiled/tile_borders.hpp"

namespace warren::distributed {
namespace {

constexpr Border borders[] = {Border::below, Border::above};

constexpr std::size_t number(Border border) { return static_cast<std::size_t>(border); }

/// The side of a tile at that border, and that of the tile beyond it.
constexpr unsigned tile_side(Border border) { return border == Border::above ? 1 : 3; }

constexpr double nothing_open = std::numeric_limits<double>::infinity();

/// Row, count, parent, two labels.
constexpr std::size_t bytes_of_key = 32 + 1 + sizeof(VertexId) + 2 * sizeof(double);

}  // namespace

void ToldLabels::pack(ValuePacker& to) const {
  for (const auto& side : of) {
    for (const auto& labels : side) to.add_list(labels);
  }
}

ToldLabels ToldLabels::unpack(ValueUnpacker& from) {
  ToldLabels told;
  for (auto& side : told.of) {
    for (auto& labels : side) labels = from.take_list<CrossingLabel>();
  }
  return told;
}

void HeldBand::pack(ValuePacker& to) const {
  to.add(lacking_bytes);
  to.add(components);
  to.add(component_numbers);
  for (const auto* lists : {&cols, &component_of, &linked}) {
    for (const auto& list : *lists) to.add_list(list);
  }
}

HeldBand HeldBand::unpack(ValueUnpacker& from) {
  HeldBand band;
  band.lacking_bytes = from.take<std::uint64_t>();
  band.components = from.take<std::uint64_t>();
  band.component_numbers = from.take<std::uint32_t>();
  for (auto* lists : {&band.cols, &band.component_of, &band.linked}) {
    for (auto& list : *lists) list = from.take_list<std::uint32_t>();
  }
  return band;
}

BandRounds::BandRounds(const TileGrid& grid, TileRows rows, const OverlayEnds& ends, std::vector<TileSummary> tiles,
                       const Execution& execution)
    : grid_(grid),
      rows_(rows),
      ends_(ends),
      execution_(execution),
      seen_(grid),
      seen_rows_{rows.first > 0 ? rows.first - 1 : 0, std::min<std::size_t>(rows.last + 1, grid.tile_rows)},
      tiles_(std::move(tiles)) {
  const auto first_row = static_cast<std::uint32_t>(seen_rows_.first << grid.side_log2);
  seen_.tile_rows = static_cast<std::uint32_t>(seen_rows_.last - seen_rows_.first);
  seen_.rows = std::min(grid.rows, static_cast<std::uint32_t>(seen_rows_.last << grid.side_log2)) - first_row;
}

void BandRounds::serve(ValueUnpacker& from, ValuePacker& to) {
  switch (from.take<RoundStep>()) {
    case RoundStep::hold:
      return hold(to);
    case RoundStep::peel:
      return peel(from, to);
    case RoundStep::begin:
      return begin(to);
    case RoundStep::settle:
      return settle(from, to);
    case RoundStep::exchange:
      return exchange(from, to);
    case RoundStep::rims:
      return rims(from, to);
    case RoundStep::trace:
      return trace(from, to);
  }
}

/// Tiles beyond the borders, with the keys of the crossings alone.
void BandRounds::add_tiles_beyond() {
  const std::uint32_t side = grid_.side();
  const auto beyond = [&](const TileSummary& tile, Border border) {
    TileSummary made;
    auto& crossings = made.crossings[tile_side(border) ^ 2U];
    for (const std::uint16_t key : tile.crossings[tile_side(border)]) {
      const std::uint32_t col = tile.keys[key] & (side - 1);
      crossings.push_back(static_cast<std::uint16_t>(made.keys.size()));
      made.keys.push_back(static_cast<std::uint16_t>(border == Border::below ? (side - 1) * side + col : col));
    }
    return made;
  };
  std::vector<TileSummary> all;
  all.reserve(seen_.count());
  if (seen_rows_.first < rows_.first) {
    for (std::size_t t = 0; t < grid_.tile_cols; ++t) all.push_back(beyond(tiles_[t], Border::below));
  }
  const std::size_t last = tiles_.size();
  std::move(tiles_.begin(), tiles_.end(), std::back_inserter(all));
  if (seen_rows_.last > rows_.last) {
    for (std::size_t t = last; t < last + grid_.tile_cols; ++t) {
      all.push_back(beyond(all[all.size() - grid_.tile_cols], Border::above));
    }
  }
  tiles_ = std::move(all);
}

/// Of all that the search will hold here, the keys beyond the borders among it; 0 where there is room.
std::size_t BandRounds::lacking_bytes() const {
  std::size_t needed = seen_.count() * sizeof(TileSummary);
  for (const TileSummary& tile : tiles_) {
    needed += (tile.keys.size() + tile.crossings[1].size() + tile.crossings[3].size()) * bytes_of_key;
  }
  try {
    execution_.reserve(needed);
    return 0;
  } catch (const Stopped& stopped) {
    if (stopped.reason != StopReason::memory) throw;
    return needed;
  }
}

void BandRounds::keep_links() {
  const auto first_row = static_cast<std::uint32_t>(seen_rows_.first << grid_.side_log2);
  const auto is_own = [&](std::uint32_t row) {
    return row >> grid_.side_log2 >= rows_.first && row >> grid_.side_log2 < rows_.last;
  };
  for (const EndLinks* end : {&ends_.start, &ends_.goal}) {
    for (const EndLink& link : end->links) {
      if (is_own(link.row)) kept_.goal.links.push_back({link.col, link.row - first_row, link.length});
    }
    if (end == &ends_.start) start_links_ = kept_.goal.links.size();
  }
}

void BandRounds::keep_beyond(Range own_tiles) {
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (t >= own_tiles.first && t < own_tiles.last) continue;
    for (const std::uint16_t key : tiles_[t].keys) {
      kept_.start.links.push_back(
          {seen_.first_col(t) + key % grid_.side(), seen_.first_row(t) + key / grid_.side(), 0.0});
    }
  }
}

void BandRounds::hold(ValuePacker& to) {
  if (const std::size_t lacking = lacking_bytes()) {
    HeldBand none;
    none.lacking_bytes = lacking;
    return none.pack(to);
  }
  add_tiles_beyond();
  check_borders(seen_, tiles_, execution_);
  const Range own_tiles{(rows_.first - seen_rows_.first) * grid_.tile_cols,
                        (rows_.last - seen_rows_.first) * grid_.tile_cols};
  keep_links();
  keep_beyond(own_tiles);
  overlay_.emplace(seen_, tiles_, kept_, execution_);
  own_ = {overlay_->first_key(own_tiles.first), overlay_->first_key(own_tiles.last)};
  for (const Border border : borders) is_gone_[number(border)].assign(crossing_count(border), false);
  for (TileSummary& tile : tiles_) {
    let_go(tile.chains);
    tile.crossings = {};
  }
  held().pack(to);
}

HeldBand BandRounds::held() const {
  HeldBand band;
  const OverlayComponents components(*overlay_, own_, execution_);
  band.components = components.count();
  for (const Border border : borders) {
    for (std::uint64_t i = 0; i < crossing_count(border); ++i) {
      const VertexId v = beyond(border, i);
      const std::size_t tile = overlay_->tile_of(v);
      band.cols[number(border)].push_back(seen_.first_col(tile) + place_of(v) % grid_.side());
      band.component_of[number(border)].push_back(components.root(within(v)));
    }
  }
  const auto links = overlay_->ends(overlay_->goal());
  for (std::size_t i = 0; i < links.size(); ++i) {
    band.linked[i < start_links_ ? 0 : 1].push_back(components.root(links[i].target));
  }
  std::vector<std::uint32_t> roots;
  for (const auto* lists : {&band.component_of, &band.linked}) {
    for (const auto& list : *lists) roots.insert(roots.end(), list.begin(), list.end());
  }
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  for (auto* lists : {&band.component_of, &band.linked}) {
    for (auto& list : *lists) {
      for (std::uint32_t& root : list) {
        root = static_cast<std::uint32_t>(std::lower_bound(roots.begin(), roots.end(), root) - roots.begin());
      }
    }
  }
  band.component_numbers = static_cast<std::uint32_t>(roots.size());
  return band;
}

/// What the others have peeled goes first; then what is gone here since it was last told.
void BandRounds::peel(ValueUnpacker& from, ValuePacker& to) {
  for (const Border border : borders) {
    for (const std::uint64_t crossing : from.take_list<std::uint64_t>()) overlay_->peel_after(beyond(border, crossing));
  }
  overlay_->peel(execution_);
  for (const Border border : borders) {
    std::vector<std::uint64_t> gone;
    for (std::uint64_t i = 0; i < crossing_count(border); ++i) {
      if (is_gone_[number(border)][i] || !overlay_->is_peeled(within(beyond(border, i)))) continue;
      is_gone_[number(border)][i] = true;
      gone.push_back(i);
    }
    to.add_list(gone);
  }
}

void BandRounds::begin(ValuePacker& to) {
  double longest_link = 0.0;
  for (const EndLink& link : kept_.goal.links) longest_link = std::max(longest_link, link.length);
  const auto longest = std::max(overlay_->longest(), static_cast<std::uint32_t>(std::ceil(longest_link)));
  for (auto& side : sides_) {
    side.emplace(*overlay_, longest, execution_, own_);
    for_chunks(overlay_->vertex_count(), std::size_t{1} << 15, execution_,
               [&](Range r) { side->clear(static_cast<VertexId>(r.first), static_cast<VertexId>(r.last)); });
  }
  const auto links = overlay_->ends(overlay_->goal());
  for (std::size_t i = 0; i < links.size(); ++i) {
    sides_[i < start_links_ ? 0 : 1]->begin(links[i].target, kept_.goal.links[i].length);
  }
  say_state(to);
}

void BandRounds::receive(ValueUnpacker& from) {
  const ToldLabels told = ToldLabels::unpack(from);
  for (std::size_t side = 0; side < side_count; ++side) {
    for (const Border border : borders) {
      for (const CrossingLabel& label : told.of[side][number(border)]) {
        sides_[side]->receive({within(beyond(border, label.crossing)), label.label});
      }
    }
  }
}

ToldLabels BandRounds::told() {
  ToldLabels told;
  for (std::size_t side = 0; side < side_count; ++side) {
    for (const StepSide::Told& label : sides_[side]->take_told()) {
      const auto [border, crossing] = crossing_of(label.key);
      told.of[side][number(border)].push_back({crossing, label.label});
    }
  }
  return told;
}

void BandRounds::say_state(ValuePacker& to) {
  for (auto& side : sides_) to.add(SideState{side->least(), side->settled()});
}

void BandRounds::settle(ValueUnpacker& from, ValuePacker& to) {
  receive(from);
  for (auto& side : sides_) {
    const auto bucket = from.take<double>();
    if (bucket < nothing_open) side->settle_at(static_cast<std::uint64_t>(bucket));
  }
  say_state(to);
  told().pack(to);
}

void BandRounds::exchange(ValueUnpacker& from, ValuePacker& to) {
  receive(from);
  sides_[0]->exchange(*sides_[1], false);
  sides_[1]->exchange(*sides_[0], false);
  say_state(to);
  const StepBorder agreed = agree(sides_[0]->border(), sides_[1]->border());
  if (agreed.meeting == no_vertex) return to.add(Meeting{});
  to.add(Meeting{agreed.best, tile_of(agreed.meeting), place_of(agreed.meeting)});
}

/// First the own labels at the borders are told, then those beyond come, so that a way back goes on there as within.
void BandRounds::rims(ValueUnpacker& from, ValuePacker& to) {
  const bool come = from.take<std::uint32_t>() != 0;
  for (auto& side : sides_) {
    for (const Border border : borders) {
      std::vector<double> labels = come ? from.take_list<double>() : std::vector<double>(crossing_count(border));
      if (labels.size() != crossing_count(border)) from.refuse();
      for (std::uint64_t i = 0; i < labels.size(); ++i) {
        const VertexId there = beyond(border, i);
        if (come) {
          side->set_label(there, labels[i]);
        } else {
          labels[i] = side->label(within(there));
        }
      }
      if (!come) to.add_list(labels);
    }
  }
}

void BandRounds::trace(ValueUnpacker& from, ValuePacker& to) const {
  const auto asked = from.take<TraceFrom>();
  RawVector<VertexId> path = sides_[asked.side % side_count]->path_from(vertex_at(asked));
  const bool is_root = path.back() >= own_.first && path.back() < own_.last;
  TraceEnd end{is_root ? 1U : 0U, Border::below, 0};
  if (!is_root) std::tie(end.border, end.crossing) = crossing_of(path.back());
  execution_.reserve(2 * path.size() * sizeof(RouteKey));
  std::vector<RouteKey> keys;
  keys.reserve(path.size());
  for (std::size_t i = 0; i < path.size() - (is_root ? 0 : 1); ++i) {
    const std::uint32_t steps = i + 1 < path.size() ? overlay_->steps_between(path[i], path[i + 1]) : 0;
    keys.push_back({tile_of(path[i]), place_of(path[i]), steps});
  }
  to.add(end);
  to.add_list(keys);
}

std::uint64_t BandRounds::tile_of(VertexId v) const {
  return overlay_->tile_of(v) + seen_rows_.first * grid_.tile_cols;
}

std::uint32_t BandRounds::place_of(VertexId v) const {
  const std::size_t tile = overlay_->tile_of(v);
  return tiles_[tile].keys[v - overlay_->first_key(tile)];
}

VertexId BandRounds::vertex_at(const TraceFrom& from) const {
  if (from.is_crossing != 0) return within(beyond(from.border, from.at));
  const std::uint64_t tile = from.at - seen_rows_.first * grid_.tile_cols;
  if (tile >= tiles_.size()) throw InputError("tile", "is of another rank");
  const auto& keys = tiles_[tile].keys;
  const auto found = std::lower_bound(keys.begin(), keys.end(), from.place);
  if (found == keys.end() || *found != from.place) throw InputError("path", "begins at a point that is no key");
  return overlay_->first_key(tile) + static_cast<VertexId>(found - keys.begin());
}

std::uint64_t BandRounds::crossing_count(Border border) const {
  return border == Border::below ? own_.first : overlay_->start() - own_.last;
}

VertexId BandRounds::beyond(Border border, std::uint64_t crossing) const {
  if (crossing >= crossing_count(border)) throw InputError("crossing", "is none of this border");
  return static_cast<VertexId>(crossing + (border == Border::below ? 0 : own_.last));
}

std::pair<Border, std::uint64_t> BandRounds::crossing_of(VertexId beyond) const {
  if (beyond < own_.first) return {Border::below, beyond};
  return {Border::above, beyond - own_.last};
}

}  // namespace warren::distributed
