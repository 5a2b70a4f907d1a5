// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/overlay_search.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

#include "core/base/error.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren {
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

double longest_link(const OverlayEnds& ends) {
  double longest = 0.0;
  for (const EndLinks* end : {&ends.start, &ends.goal}) {
    for (const EndLink& link : end->links) longest = std::max(longest, link.length);
  }
  return longest;
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
  execution.reserve(n * sizeof(double) + n / block_size + mask_ * sizeof(std::uint32_t));
  label_.resize(n);
  is_near_.assign(n / block_size + 1, 0);
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
  is_near_[v / block_size] = 1;
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
    if (other.is_near_[v / block_size] == 0 || other.label_[v] == unreached) continue;
    border_.offer(label(v) + other.label(v), v);
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
                       [&](const Root& root) { return root.key == key && root.length == label(key); });
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
  const auto longest = std::max(overlay.longest(), static_cast<std::uint32_t>(std::ceil(longest_link(ends))));
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

namespace {

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
    std::stable_sort(tile.chains.begin(), tile.chains.end(),
                     [](const Chain& a, const Chain& b) { return a.from < b.from; });
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
