// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/overlay.hpp"

#include <bit>
#include <cassert>

#include "core/base/error.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren {
namespace {

/// The tile beyond a side (0 right, 1 above, 2 left, 3 below).
std::size_t neighbour(const TileGrid& grid, std::size_t tile, unsigned side) {
  const std::size_t across = side == 0 || side == 2 ? 1 : grid.tile_cols;
  return side < 2 ? tile + across : tile - across;
}

using Crossings = std::array<std::vector<std::uint16_t>, 4>;

/// The band as a lattice of its own.
class PeeledBand {
 public:
  PeeledBand(const TileGrid& grid, std::size_t first_row, std::size_t last_row, std::span<TileSummary> tiles)
      : band_(grid), first_row_(static_cast<std::uint32_t>(first_row << grid.side_log2)), tiles_(tiles) {
    band_.tile_rows = static_cast<std::uint32_t>(last_row - first_row);
    band_.rows = std::min(grid.rows, static_cast<std::uint32_t>(last_row << grid.side_log2)) - first_row_;
  }

  void run(const OverlayEnds& ends, const Execution& execution) {
    const OverlayEnds kept = kept_cells(ends);
    take_away_rims();
    check_borders(band_, tiles_, execution);
    Overlay overlay(band_, tiles_, kept, execution);
    tiles_.front().closed_components += overlay.peel(execution);
    std::vector<Crossings> crossings(tiles_.size());
    constexpr std::size_t grain = 64;
    for_each_index(tiles_.size(), grain, execution, [&](std::size_t t) { crossings[t] = crossings_left(overlay, t); });
    for_each_index(tiles_.size(), grain, execution, [&](std::size_t t) { prune(overlay, t, std::move(crossings[t])); });
  }

 private:
  bool is_lowest(std::size_t tile) const { return tile < band_.tile_cols; }
  bool is_highest(std::size_t tile) const { return tile + band_.tile_cols >= tiles_.size(); }

  /// Whatever leaves the band, and what start and goal join in it, as if they were linked.
  OverlayEnds kept_cells(const OverlayEnds& ends) const {
    OverlayEnds kept;
    const auto add = [&](std::size_t tile, std::span<const std::uint16_t> keys) {
      for (const std::uint16_t key : keys) {
        const std::uint32_t place = tiles_[tile].keys[key];
        kept.start.links.push_back(
            {band_.first_col(tile) + place % band_.side(), band_.first_row(tile) + place / band_.side(), 0.0});
      }
    };
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      if (is_lowest(t)) add(t, tiles_[t].crossings[3]);
      if (is_highest(t)) add(t, tiles_[t].crossings[1]);
    }
    for (const EndLinks* end : {&ends.start, &ends.goal}) {
      for (const EndLink& link : end->links) {
        if (link.row < first_row_ || link.row - first_row_ >= band_.rows) continue;
        kept.goal.links.push_back({link.col, link.row - first_row_, link.length});
      }
    }
    return kept;
  }

  void take_away_rims() {
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      if (is_lowest(t)) std::swap(lowest_.emplace_back(), tiles_[t].crossings[3]);
      if (is_highest(t)) std::swap(highest_.emplace_back(), tiles_[t].crossings[1]);
    }
  }

  /// Both ends of a crossing are left, or it goes.
  Crossings crossings_left(const Overlay& overlay, std::size_t tile) const {
    Crossings left;
    for (unsigned side = 0; side < 4; ++side) {
      const auto& own = tiles_[tile].crossings[side];
      const std::size_t beyond = neighbour(band_, tile, side);
      for (std::size_t i = 0; i < own.size(); ++i) {
        const std::uint16_t theirs = tiles_[beyond].crossings[side ^ 2U][i];
        if (overlay.is_peeled(overlay.first_key(tile) + own[i])) continue;
        if (overlay.is_peeled(overlay.first_key(beyond) + theirs)) continue;
        left[side].push_back(own[i]);
      }
    }
    return left;
  }

  void prune(const Overlay& overlay, std::size_t t, Crossings crossings) {
    TileSummary& tile = tiles_[t];
    if (is_lowest(t)) crossings[3] = lowest_[t];
    if (is_highest(t)) crossings[1] = highest_[t + band_.tile_cols - tiles_.size()];
    const auto is_left = [&](std::size_t key) {
      return !overlay.is_peeled(overlay.first_key(t) + static_cast<VertexId>(key));
    };
    std::vector<std::uint16_t> number(tile.keys.size());
    std::vector<std::uint16_t> keys;
    for (std::size_t k = 0; k < tile.keys.size(); ++k) {
      number[k] = static_cast<std::uint16_t>(keys.size());
      if (is_left(k)) keys.push_back(tile.keys[k]);
    }
    std::vector<Chain> chains;
    for (const Chain& chain : tile.chains) {
      if (is_left(chain.from) && is_left(chain.to)) {
        chains.push_back({number[chain.from], number[chain.to], chain.first_step, chain.length});
      }
    }
    for (auto& side : crossings) {
      for (std::uint16_t& key : side) key = number[key];
    }
    tile.keys = std::move(keys);
    tile.chains = std::move(chains);
    tile.crossings = std::move(crossings);
  }

  TileGrid band_;
  const std::uint32_t first_row_;
  std::span<TileSummary> tiles_;
  std::vector<std::vector<std::uint16_t>> lowest_, highest_;  // crossings out of the band, by column of tiles
};

constexpr double one_step = 1.0;     // the longest edge
constexpr double first_look = 20.0;  // where nothing is within a step: a corner's 256 nearest stand within this,
constexpr double last_look = 80.0;   // unless milestones are blocked; with fewer than 256 within this, that is all
constexpr std::size_t most_looked_at = 256;

/// The walls that may touch an edge of at most `reach` from `at`.
std::vector<Segment> walls_around(const LatticeWorld& world, Vec2 at, double reach) {
  const Box around = Box{at, at}.grown(reach + world.clearance * (1 + 1e-9) + 1e-6);
  std::vector<Segment> near;
  const auto take = [&](const Segment& wall) {
    if (around.meets(box_of(wall))) near.push_back(wall);
  };
  if (reach == one_step && world.grid.area().contains(at)) {
    const std::size_t tile = world.grid.tile_near(at);
    world.tiles.reader()->read(tile).for_each_around(world.grid, tile, around, take);
    return near;
  }
  world.tiles.for_each_near(around, take);
  return near;
}

bool is_free(std::span<const Segment> walls, const Segment& edge, double clearance) {
  return std::none_of(walls.begin(), walls.end(),
                      [&](const Segment& wall) { return blocks_edge(wall, edge, clearance); });
}

/// The milestones within `reach` of `at`, nearest first.
std::vector<EndLink> milestones_around(const LatticeWorld& world, std::span<const Segment> walls, Vec2 at,
                                       double reach) {
  std::vector<EndLink> found;
  const auto first = [&](double x) { return static_cast<std::int64_t>(std::max(0.0, std::ceil(x - reach) - 1)); };
  const auto last = [&](double x, std::uint32_t count) {
    return static_cast<std::int64_t>(std::min(count - 1.0, std::floor(x + reach) - 1));
  };
  for (std::int64_t row = first(at.y); row <= last(at.y, world.grid.rows); ++row) {
    for (std::int64_t col = first(at.x); col <= last(at.x, world.grid.cols); ++col) {
      const Vec2 point = TileGrid::point(col, row);
      const double length = distance(at, point);
      if (length > reach || !world.box.contains(point)) continue;
      if (!is_free(walls, {point, point}, world.clearance)) continue;
      found.push_back({static_cast<std::uint32_t>(col), static_cast<std::uint32_t>(row), length});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const EndLink& a, const EndLink& b) { return a.length < b.length; });
  return found;
}

/// Puts the edges to the candidates to the walls; keeps the free ones, or only the first.
void try_links(const LatticeWorld& world, std::span<const Segment> walls, std::span<const EndLink> candidates,
               bool first_only, EndLinks& result) {
  ++result.queries;
  for (const EndLink& link : candidates) {
    ++result.checked;
    if (!is_free(walls, {result.at, TileGrid::point(link.col, link.row)}, world.clearance)) continue;
    result.links.push_back(link);
    if (first_only) return;
  }
}

}  // namespace

Overlay::Overlay(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends,
                 const Execution& execution) {
  first_key_.assign(tiles.size() + 1, 0);
  std::uint64_t keys = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    keys += tiles[t].keys.size();
    if (keys > no_vertex - 4U) throw InputError("roadmap", "has more than 2^32 overlay vertices");
    first_key_[t + 1] = static_cast<VertexId>(keys);
  }
  execution.reserve(vertex_count() * (sizeof(rows_[0]) + 1));
  rows_.resize(start());
  left_.resize(vertex_count());
  std::vector<std::uint32_t> longest(tile_count(), 1);
  const std::size_t grain = std::size_t{1} << (16 - 2 * std::min(grid.side_log2, 8U));  // 65 536 lattice points
  for_each_index(tile_count(), grain, execution,
                 [&](std::size_t tile) { longest[tile] = fill_tile(grid, tiles, tile); });
  longest_ = *std::max_element(longest.begin(), longest.end());
  fill_ends(grid, tiles, ends);
}

std::span<const OverlayEnd> Overlay::ends(VertexId v) const {
  if (!is_key(v)) return links_[v - start()];
  const std::array<OverlayEnd, 4>& row = rows_[v];
  std::size_t count = row.size();
  while (count > 0 && row[count - 1].target == v) --count;
  return {row.data(), count};
}

std::uint32_t Overlay::steps_between(VertexId v, VertexId w) const {
  std::uint32_t least = no_vertex;
  for (const OverlayEnd& end : ends(v)) {
    if (end.target == w) least = std::min(least, end.steps);
  }
  assert(least != no_vertex);
  return least;
}

/// Writes the rows of one tile's keys. Returns the steps of the longest edge.
std::uint32_t Overlay::fill_tile(const TileGrid& grid, std::span<const TileSummary> tiles, std::size_t tile) {
  const TileSummary& own = tiles[tile];
  const VertexId first = first_key_[tile];
  for (VertexId v = first; v < first_key_[tile + 1]; ++v) {
    rows_[v].fill({v, 0});
    left_[v] = 0;
  }
  std::uint32_t longest = 1;
  for (const Chain& chain : own.chains) {
    longest = std::max(longest, chain.length);
    add_end(first + chain.from, first + chain.to, chain.length);
    add_end(first + chain.to, first + chain.from, chain.length);
  }
  for (unsigned side = 0; side < 4; ++side) {
    if (own.crossings[side].empty()) continue;
    const std::size_t other = neighbour(grid, tile, side);
    const auto& theirs = tiles[other].crossings[side ^ 2];
    assert(theirs.size() == own.crossings[side].size());
    for (std::size_t i = 0; i < theirs.size(); ++i) {
      add_end(first + own.crossings[side][i], first_key_[other] + theirs[i], 1);
    }
  }
  return longest;
}

/// A link counts as two edges of its key: what start and goal join is never peeled.
void Overlay::fill_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends) {
  for (const EndLinks* end : {&ends.start, &ends.goal}) {
    std::vector<OverlayEnd>& row = links_[end == &ends.start ? 0 : 1];
    for (const EndLink& link : end->links) {
      const std::size_t tile = grid.tile_at(link.col, link.row);
      const std::uint32_t local = (link.row - grid.first_row(tile)) * grid.side() + (link.col - grid.first_col(tile));
      const auto& keys = tiles[tile].keys;
      const auto found = std::lower_bound(keys.begin(), keys.end(), local);
      assert(found != keys.end() && *found == local);  // linked vertices are kept by the reduction
      const VertexId key = first_key_[tile] + static_cast<VertexId>(found - keys.begin());
      row.push_back({key, 0});
      left_[key] = static_cast<std::uint8_t>(left_[key] + 2);
    }
    if (ends.direct) row.push_back({end == &ends.start ? goal() : start(), 0});
  }
  left_[start()] = left_[goal()] = 2;
}

std::uint64_t Overlay::peel(const Execution& execution) {
  struct Part {
    std::uint64_t closed = 0;
    std::vector<VertexId> stops;
  };
  const std::size_t grain = std::max<std::size_t>(8, (tile_count() + 31) / 32);  // at most 32 ranges
  const auto parts = parts_of_chunks(tile_count(), grain, execution, [&](Range r) {
    const VertexId first = first_key_[r.first];
    const VertexId last = first_key_[r.last];
    Part part;
    for (VertexId v = first; v < last; ++v) {
      if (left_[v] > 1) continue;
      const VertexId stop = peel_from(v, first, last, part.closed);
      if (stop != no_vertex) part.stops.push_back(stop);
    }
    return part;
  });
  std::uint64_t closed = 0;
  for (const Part& part : parts) {
    execution.check();
    closed += part.closed;
    for (const VertexId v : part.stops) peel_from(v, 0, start(), closed);
  }
  return closed;
}

void Overlay::peel_after(VertexId gone) {
  left_[gone] = peeled;
  std::uint64_t closed = 0;
  for (const OverlayEnd& end : ends(gone)) {
    if (is_peeled(end.target)) continue;
    --left_[end.target];
    peel_from(end.target, 0, start(), closed);
  }
}

/// Follows the dead end that begins at v, if one does, as long as it stays among first .. last - 1. Edges that leave
/// the range count as not peeled, and they are not: whatever has one is peeled by no other range either. Returns the
/// dead end's vertex whose last edge leaves the range, or no_vertex; counts `closed` if the whole component was a tree
/// and is gone now.
VertexId Overlay::peel_from(VertexId v, VertexId first, VertexId last, std::uint64_t& closed) {
  while (left_[v] <= 1) {
    if (left_[v] == 0) {
      left_[v] = peeled;
      ++closed;
      return no_vertex;
    }
    const auto row = ends(v);
    const auto out = std::find_if(row.begin(), row.end(), [&](const OverlayEnd& end) {
      return end.target < first || end.target >= last || !is_peeled(end.target);
    });
    assert(out != row.end());
    const VertexId next = out->target;
    if (next < first || next >= last) return v;
    left_[v] = peeled;
    --left_[next];
    v = next;
  }
  return no_vertex;
}

Components components(const Overlay& overlay, Range vertices, const Execution& execution) {
  const auto first = static_cast<VertexId>(vertices.first);
  RawVector<VertexId> label = joined_labels(vertices.size(), execution, [&](VertexId place, const auto& join) {
    const VertexId v = first + place;
    if (overlay.is_peeled(v)) return;
    for (const OverlayEnd& end : overlay.ends(v)) {  // each edge once
      if (end.target < v && end.target >= first && !overlay.is_peeled(end.target)) join(end.target - first);
    }
  });
  constexpr std::size_t grain = std::size_t{1} << 14;
  const std::size_t count = sum_of_chunks(label.size(), grain, execution.quiet(), [&](Range r) {
    std::size_t roots = 0;
    for (auto place = static_cast<VertexId>(r.first); place < r.last; ++place) {
      roots += label[place] == place && !overlay.is_peeled(first + place) ? 1 : 0;
    }
    return roots;
  });
  return {std::move(label), count};
}

void peel_band(const TileGrid& grid, std::size_t first_row, std::size_t last_row, const OverlayEnds& ends,
               std::span<TileSummary> tiles, const Execution& execution) {
  PeeledBand(grid, first_row, last_row, tiles).run(ends, execution);
}

EndLinks end_links(const LatticeWorld& world, Vec2 at) {
  EndLinks result{at, false, {}, 0, 0};
  if (!world.box.contains(at)) return result;
  const std::vector<Segment> near = walls_around(world, at, one_step);
  result.free = is_free(near, {at, at}, world.clearance);
  if (!result.free) return result;
  try_links(world, near, milestones_around(world, near, at, one_step), false, result);
  if (!result.links.empty()) return result;
  for (double reach = first_look; reach <= last_look; reach *= 2) {
    const std::vector<Segment> wide = walls_around(world, at, reach);
    std::vector<EndLink> candidates = milestones_around(world, wide, at, reach);
    if (candidates.size() < most_looked_at && reach < last_look) continue;
    candidates.resize(std::min(candidates.size(), most_looked_at));
    try_links(world, wide, candidates, true, result);
    break;
  }
  return result;
}

bool is_direct_candidate(Vec2 a, Vec2 b) { return distance(a, b) <= one_step; }

bool is_direct_edge_free(const LatticeWorld& world, Vec2 a, Vec2 b) {
  return is_free(walls_around(world, a, one_step), {a, b}, world.clearance);
}

namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();
/// Entries between asking for a row, asking for the labels that it leads to, and settling.
constexpr std::size_t rows_ahead = 12;
constexpr std::size_t labels_ahead = 6;

/// Vertices from which on each side has a thread; two threads do not repay their start on small ones.
constexpr std::size_t fewest_for_two_threads = 50'000;

void begin(StepSide& side, const Overlay& overlay, VertexId end, const EndLinks& links) {
  for (std::size_t i = 0; i < links.links.size(); ++i) {
    side.begin(overlay.ends(end)[i].target, links.links[i].length);
  }
}

std::uint16_t number_of(const TileSummary& tile, std::uint32_t place) {
  const auto found = std::lower_bound(tile.keys.begin(), tile.keys.end(), place);
  return static_cast<std::uint16_t>(found - tile.keys.begin());
}

void sort_once(std::vector<std::uint16_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

/// The side of a tile that a neighbour lies at.
unsigned side_to(const TileGrid& grid, std::uint64_t tile, std::uint64_t other) {
  if (other == tile + 1) return 0;
  if (other == tile + grid.tile_cols) return 1;
  if (tile == other + 1) return 2;
  if (tile == other + grid.tile_cols) return 3;
  throw InputError("path", "leaps between tiles");
}

/// Between keys that the tiles have.
void add_leg(const RouteKey& from, const RouteKey& to, const TileGrid& grid, std::vector<TileSummary>& tiles) {
  TileSummary& tile = tiles[from.tile];
  const std::uint16_t a = number_of(tile, from.place);
  const std::uint16_t b = number_of(tiles[to.tile], to.place);
  if (from.tile == to.tile) {
    tile.chains.push_back({std::min(a, b), std::max(a, b), 0, from.steps});
    return;
  }
  const unsigned side = side_to(grid, from.tile, to.tile);
  tile.crossings[side].push_back(a);
  tiles[to.tile].crossings[side ^ 2U].push_back(b);
}

}  // namespace

StepBorder agree(const StepBorder& forward, const StepBorder& backward) {
  StepBorder agreed{agree(static_cast<const SearchBorder&>(forward), static_cast<const SearchBorder&>(backward))};
  agreed.least_key = forward.least_key + backward.least_key;
  return agreed;
}

StepSide::StepSide(const Overlay& overlay, std::uint32_t longest, const Execution& execution, Range own)
    : overlay_(overlay),
      execution_(execution),
      own_(own),
      mask_(std::bit_ceil(std::max<std::uint64_t>(64, longest + std::uint64_t{2})) - 1) {
  const std::size_t n = overlay.vertex_count();
  execution.reserve(n * sizeof(double) + mask_ * sizeof(std::uint32_t));
  label_.resize(n);
  first_.assign(mask_ + 1, none);
  is_used_.assign((mask_ + 1) / 64, 0);
}

void StepSide::clear(VertexId first, VertexId last) {
  for (VertexId v = first; v < last; ++v) label_[v] = overlay_.is_peeled(v) ? 0.0 : unreached;
}

void StepSide::begin(VertexId key, double length) {
  roots_.push_back({key, length});
  if (length < label_[key]) push(key, length);
}

void StepSide::push(VertexId v, double label) {
  label_[v] = label;
  if (!is_own(v)) return push_asked(told_, {v, label}, execution_);
  push_asked(labelled_, v, execution_);
  const auto step = static_cast<std::uint64_t>(label);
  const std::uint64_t slot = step & mask_;
  std::uint32_t entry = free_;
  if (entry != none) {
    free_ = entries_[entry].next;
    entries_[entry] = {v, first_[slot]};
  } else {
    entry = static_cast<std::uint32_t>(entries_.size());
    push_asked(entries_, {v, first_[slot]}, execution_);
  }
  first_[slot] = entry;
  is_used_[slot / 64] |= std::uint64_t{1} << slot % 64;
  ++open_;
}

/// Moves on to the first bucket with entries; there is one.
void StepSide::find_bucket() {
  for (;;) {
    const std::uint64_t slot = at_ & mask_;
    const std::uint64_t word = is_used_[slot / 64] >> slot % 64;
    if (word != 0) {
      at_ += static_cast<std::uint64_t>(std::countr_zero(word));
      return;
    }
    at_ += 64 - slot % 64;
  }
}

void StepSide::empty_bucket() {
  bucket_.clear();
  const std::uint64_t slot = at_ & mask_;
  for (std::uint32_t entry = first_[slot]; entry != none;) {
    const Entry taken = entries_[entry];
    push_asked(bucket_, taken.vertex, execution_);
    entries_[entry].next = free_;
    free_ = entry;
    entry = taken.next;
  }
  first_[slot] = none;
  is_used_[slot / 64] &= ~(std::uint64_t{1} << slot % 64);
  open_ -= bucket_.size();
  const std::size_t n = bucket_.size();
  for (std::size_t i = 0; i < std::min(n, rows_ahead); ++i) __builtin_prefetch(&overlay_.row(bucket_[i]));
  for (std::size_t i = 0; i < n; ++i) {
    if (i + rows_ahead < n) __builtin_prefetch(&overlay_.row(bucket_[i + rows_ahead]));
    if (i + labels_ahead < n) {
      for (const OverlayEnd& end : overlay_.row(bucket_[i + labels_ahead])) __builtin_prefetch(&label_[end.target]);
    }
    settle(bucket_[i]);
  }
}

void StepSide::settle(VertexId v) {
  const double g = label_[v];
  if (std::signbit(g)) return;  // a second entry, of a longer way
  label_[v] = -g;
  ++settled_;
  for (const OverlayEnd& end : overlay_.row(v)) {
    const double through = g + end.steps;
    if (through < label_[end.target]) push(end.target, through);
  }
}

/// A bucket that has nothing but second entries is none: whether there is one depends on the order of pushes.
double StepSide::least() {
  while (open_ > 0) {
    find_bucket();
    for (std::uint32_t entry = first_[at_ & mask_]; entry != none; entry = entries_[entry].next) {
      if (!std::signbit(label_[entries_[entry].vertex])) return static_cast<double>(at_);
    }
    empty_bucket();
  }
  return unreached;
}

void StepSide::advance(const StepSide&, const StepBorder& agreed, double other_least_key, std::uint64_t limit) {
  const std::uint64_t last = settled_ + limit;
  while ((least_ = least()) < unreached) {
    if (settled_ >= last || least_ + other_least_key >= agreed.best) return;
    empty_bucket();
  }
}

void StepSide::settle_at(std::uint64_t step) {
  at_ = step;
  if (first_[at_ & mask_] != none) empty_bucket();
}

void StepSide::receive(const Told& told) {
  if (!(told.label < label_[told.key])) return;
  push(told.key, told.label);
  at_ = std::min(at_, static_cast<std::uint64_t>(told.label));
}

void StepSide::exchange(const StepSide& other, bool stop) {
  for (const VertexId v : labelled_) {
    if (other.label_[v] != unreached) border_.offer(label(v) + other.label(v), v);
  }
  labelled_.clear();
  border_.least_key = least_;
  border_.stop = stop;
}

RawVector<VertexId> StepSide::path_to(VertexId v) const {
  RawVector<VertexId> path = path_from(v);
  std::reverse(path.begin(), path.end());
  return path;
}

RawVector<VertexId> StepSide::path_from(VertexId v) const {
  RawVector<VertexId> path;
  push_asked(path, v, execution_);
  const auto is_root = [&](VertexId key) {
    return std::any_of(roots_.begin(), roots_.end(),
                       [&](const Told& root) { return root.key == key && root.label == label(key); });
  };
  while (is_own(path.back()) && !is_root(path.back())) push_asked(path, before(path.back()), execution_);
  return path;
}

/// The vertex from which v got its label: labels are sums in the order of the path, so the sum is met exactly.
VertexId StepSide::before(VertexId v) const {
  const auto row = overlay_.ends(v);
  const auto from = std::find_if(row.begin(), row.end(), [&](const OverlayEnd& end) {
    return !overlay_.is_peeled(end.target) && label(end.target) + end.steps == label(v);
  });
  assert(from != row.end());
  return from->target;
}

SearchResult search_steps(const Overlay& overlay, const OverlayEnds& ends, const Execution& execution) {
  const std::size_t n = overlay.vertex_count();
  std::uint32_t longest = overlay.longest();
  for (const EndLinks* end : {&ends.start, &ends.goal}) {
    for (const EndLink& link : end->links) {
      longest = std::max(longest, static_cast<std::uint32_t>(std::ceil(link.length)));
    }
  }
  StepSide forward(overlay, longest, execution, {0, n});
  StepSide backward(overlay, longest, execution, {0, n});
  for_chunks(n, std::size_t{1} << 15, execution, [&](Range r) {
    forward.clear(static_cast<VertexId>(r.first), static_cast<VertexId>(r.last));
    backward.clear(static_cast<VertexId>(r.first), static_cast<VertexId>(r.last));
  });
  begin(forward, overlay, overlay.start(), ends.start);
  begin(backward, overlay, overlay.goal(), ends.goal);
  Execution own = execution;
  if (n < fewest_for_two_threads) own.threads = 1;
  SearchResult result = bidirectional(forward, backward, own);
  if (result.status == SearchStatus::stopped) execution.check();
  const double direct = ends.direct ? distance(ends.start.at, ends.goal.at) : unreached;
  const bool is_direct = ends.direct && (result.status != SearchStatus::found || direct <= result.length);
  if (result.status != SearchStatus::found && !is_direct) return result;
  execution.reserve((result.path.size() + 2) * sizeof(VertexId));
  RawVector<VertexId> path{overlay.start()};
  path.reserve(result.path.size() + 2);
  if (!is_direct) path.insert(path.end(), result.path.begin(), result.path.end());
  path.push_back(overlay.goal());
  return {SearchStatus::found, std::move(path), is_direct ? direct : result.length, result.expanded};
}

std::vector<TileSummary> tiles_of(const ToldRoute& route, const TileGrid& grid, const OverlayEnds& ends,
                                  const Execution& execution) {
  constexpr std::size_t between_looks = 65536;
  execution.reserve(grid.count() * sizeof(TileSummary) + route.keys.size() * 2 * sizeof(Chain));
  std::vector<TileSummary> tiles(grid.count());
  const std::uint32_t side = grid.side();
  const auto add_key = [&](std::size_t tile, std::uint32_t place) {
    if (tile >= tiles.size() || place >= side * side) throw InputError("path", "leaves the tiles");
    tiles[tile].keys.push_back(static_cast<std::uint16_t>(place));
  };
  for (const EndLinks* end : {&ends.start, &ends.goal}) {
    for (const EndLink& link : end->links) {
      add_key(grid.tile_at(link.col, link.row), link.row % side * side + link.col % side);
    }
  }
  for (std::size_t i = 0; i < route.keys.size(); ++i) {
    if (i % between_looks == 0) execution.check();
    add_key(route.keys[i].tile, route.keys[i].place);
  }
  for (TileSummary& tile : tiles) sort_once(tile.keys);
  for (std::size_t i = 0; i + 1 < route.keys.size(); ++i) {
    if (i % between_looks == 0) execution.check();
    add_leg(route.keys[i], route.keys[i + 1], grid, tiles);
  }
  for (TileSummary& tile : tiles) {
    for (auto& crossing : tile.crossings) sort_once(crossing);
    std::ranges::stable_sort(tile.chains, {}, &Chain::from);
  }
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
