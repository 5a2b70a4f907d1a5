// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/leader_follower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/search/bidirectional_search.hpp"
#include "core/search/union_find.hpp"
#include "planners/mazes/tile_plane.hpp"

namespace warren::distributed {
namespace {

/// Borders of a band, and sides of the search, as they stand in messages.
enum Border : std::uint32_t { below, above };
constexpr std::size_t border_count = 2;
constexpr std::size_t side_count = 2;
constexpr Border borders[border_count] = {below, above};
/// The side of a tile at that border, and that of the tile beyond it.
constexpr unsigned tile_side(Border border) { return border == above ? 1 : 3; }

/// A label over a border, by the crossing's number along it.
struct CrossingLabel {
  std::uint64_t crossing;
  double label;
};
/// Lists by border, or by side of the search.
template <class T>
using ListPair = std::array<std::vector<T>, 2>;
template <class T>
void add_pair(const ListPair<T>& lists, ValuePacker& to) {
  for (const auto& list : lists) to.add_list(list);
}
template <class T>
ListPair<T> take_pair(ValueUnpacker& from) {
  return {from.take_list<T>(), from.take_list<T>()};
}
/// What is told over the borders of a band, by side of the search and border.
template <class T>
struct BorderLists {
  std::array<ListPair<T>, side_count> of;

  void pack(ValuePacker& to) const {
    for (const auto& side : of) add_pair(side, to);
  }
  static BorderLists unpack(ValueUnpacker& from) { return {{take_pair<T>(from), take_pair<T>(from)}}; }
};
using ToldLabels = BorderLists<CrossingLabel>;

/// Answer to RoundStep::hold: what is missing, or what the others must know of the band.
struct HeldBand {
  std::uint64_t lacking_bytes = 0;
  std::uint64_t components = 0;               ///< of the band by itself
  std::uint32_t component_numbers = 0;        ///< of those in component_of and linked
  ListPair<std::uint32_t> cols = {};          ///< of the crossings, ascending
  ListPair<std::uint32_t> component_of = {};  ///< the crossings' own keys, numbered from 0
  ListPair<std::uint32_t> linked = {};        ///< components that start and goal join

  void pack(ValuePacker& to) const {
    to.add(lacking_bytes);
    to.add(components);
    to.add(component_numbers);
    for (const auto* lists : {&cols, &component_of, &linked}) add_pair(*lists, to);
  }
  static HeldBand unpack(ValueUnpacker& from) {
    return {from.take<std::uint64_t>(),     from.take<std::uint64_t>(),     from.take<std::uint32_t>(),
            take_pair<std::uint32_t>(from), take_pair<std::uint32_t>(from), take_pair<std::uint32_t>(from)};
  }
};

constexpr double nothing_open = std::numeric_limits<double>::infinity();

/// Answer to RoundStep::begin, settle and exchange, for each side of the search.
struct SideState {
  double least = nothing_open;  ///< whole steps of the least open label
  std::uint64_t settled = 0;
};
/// The best meeting that a band knows: by length, then by tile and place.
struct Meeting {
  double length = nothing_open;
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

class RoundsOfBand : public BandRounds {
 public:
  RoundsOfBand(const TileGrid& grid, Range rows, const OverlayEnds& ends, std::vector<TileSummary> tiles,
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

  void serve(ValueUnpacker& from, ValuePacker& to) override {
    const auto step = from.take<RoundStep>();
    if (step == RoundStep::hold) return hold(to);
    if (step == RoundStep::peel) return peel(from, to);
    if (step == RoundStep::begin) return begin(to);
    if (step == RoundStep::settle) return settle(from, to);
    if (step == RoundStep::exchange) return exchange(from, to);
    if (step == RoundStep::rims) return rims(from, to);
    if (step == RoundStep::trace) return trace(from, to);
  }

 private:
  void hold(ValuePacker& to) {
    if (const std::size_t lacking = lacking_bytes()) return HeldBand{.lacking_bytes = lacking}.pack(to);
    add_tiles_beyond();
    check_borders(seen_, tiles_, execution_);
    const Range own_tiles{(rows_.first - seen_rows_.first) * grid_.tile_cols,
                          (rows_.last - seen_rows_.first) * grid_.tile_cols};
    keep_links();
    keep_beyond(own_tiles);
    overlay_.emplace(seen_, tiles_, kept_, execution_);
    own_ = {overlay_->first_key(own_tiles.first), overlay_->first_key(own_tiles.last)};
    for (const Border border : borders) is_gone_[border].assign(crossing_count(border), false);
    for (TileSummary& tile : tiles_) {
      let_go(tile.chains);
      tile.crossings = {};
    }
    held().pack(to);
  }
  /// Of all that the search will hold here, the keys beyond the borders among it; 0 where there is room.
  std::size_t lacking_bytes() const {
    std::size_t needed = seen_.count() * sizeof(TileSummary);
    for (const TileSummary& tile : tiles_) {
      needed += (tile.keys.size() + tile.crossings[1].size() + tile.crossings[3].size()) * bytes_of_key;
    }
    return memory_holds([&] { execution_.reserve(needed); }) ? 0 : needed;
  }
  /// Tiles beyond the borders, with the keys of the crossings alone.
  void add_tiles_beyond() {
    const std::uint32_t side = grid_.side();
    const auto beyond = [&](const TileSummary& tile, Border border) {
      TileSummary made;
      auto& crossings = made.crossings[tile_side(border) ^ 2U];
      for (const std::uint16_t key : tile.crossings[tile_side(border)]) {
        const std::uint32_t col = tile.keys[key] & (side - 1);
        crossings.push_back(static_cast<std::uint16_t>(made.keys.size()));
        made.keys.push_back(static_cast<std::uint16_t>(border == below ? (side - 1) * side + col : col));
      }
      return made;
    };
    std::vector<TileSummary> all;
    all.reserve(seen_.count());
    if (seen_rows_.first < rows_.first) {
      for (std::size_t t = 0; t < grid_.tile_cols; ++t) all.push_back(beyond(tiles_[t], below));
    }
    const std::size_t last = tiles_.size();
    std::move(tiles_.begin(), tiles_.end(), std::back_inserter(all));
    if (seen_rows_.last > rows_.last) {
      for (std::size_t t = last; t < last + grid_.tile_cols; ++t) {
        all.push_back(beyond(all[all.size() - grid_.tile_cols], above));
      }
    }
    tiles_ = std::move(all);
  }
  void keep_links() {
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
  void keep_beyond(Range own_tiles) {
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      if (t >= own_tiles.first && t < own_tiles.last) continue;
      for (const std::uint16_t key : tiles_[t].keys) {
        kept_.start.links.push_back(
            {seen_.first_col(t) + key % grid_.side(), seen_.first_row(t) + key / grid_.side(), 0.0});
      }
    }
  }
  HeldBand held() const {
    HeldBand band;
    const Components parts = components(*overlay_, own_, execution_);
    band.components = parts.count;
    std::map<VertexId, std::uint32_t> numbers;  // of components, by label
    const auto number_of = [&](VertexId v) {
      const auto next = static_cast<std::uint32_t>(numbers.size());
      return numbers.try_emplace(parts.label[v - own_.first], next).first->second;
    };
    for (const Border border : borders) {
      for (std::uint64_t i = 0; i < crossing_count(border); ++i) {
        const VertexId v = beyond(border, i);
        const std::size_t tile = overlay_->tile_of(v);
        band.cols[border].push_back(seen_.first_col(tile) + place_of(v) % grid_.side());
        band.component_of[border].push_back(number_of(within(v)));
      }
    }
    const auto links = overlay_->ends(overlay_->goal());
    for (std::size_t i = 0; i < links.size(); ++i) {
      band.linked[i < start_links_ ? 0 : 1].push_back(number_of(links[i].target));
    }
    band.component_numbers = static_cast<std::uint32_t>(numbers.size());
    return band;
  }
  /// What the others have peeled goes first; then what is gone here since it was last told.
  void peel(ValueUnpacker& from, ValuePacker& to) {
    for (const Border border : borders) {
      for (const std::uint64_t crossing : from.take_list<std::uint64_t>())
        overlay_->peel_after(beyond(border, crossing));
    }
    overlay_->peel(execution_);
    for (const Border border : borders) {
      std::vector<std::uint64_t> gone;
      for (std::uint64_t i = 0; i < crossing_count(border); ++i) {
        if (is_gone_[border][i] || !overlay_->is_peeled(within(beyond(border, i)))) continue;
        is_gone_[border][i] = true;
        gone.push_back(i);
      }
      to.add_list(gone);
    }
  }
  void begin(ValuePacker& to) {
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
  void settle(ValueUnpacker& from, ValuePacker& to) {
    receive(from);
    for (auto& side : sides_) {
      const auto bucket = from.take<double>();
      if (bucket < nothing_open) side->settle_at(static_cast<std::uint64_t>(bucket));
    }
    say_state(to);
    told().pack(to);
  }
  void exchange(ValueUnpacker& from, ValuePacker& to) {
    receive(from);
    sides_[0]->exchange(*sides_[1], false);
    sides_[1]->exchange(*sides_[0], false);
    say_state(to);
    const StepBorder agreed = agree(sides_[0]->border(), sides_[1]->border());
    if (agreed.meeting == no_vertex) return to.add(Meeting{});
    to.add(Meeting{agreed.best, tile_of(agreed.meeting), place_of(agreed.meeting)});
  }
  /// First the own labels at the borders are told, then those beyond come, so that a way back goes on there as within.
  void rims(ValueUnpacker& from, ValuePacker& to) {
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
  void trace(ValueUnpacker& from, ValuePacker& to) const {
    const auto asked = from.take<TraceFrom>();
    RawVector<VertexId> path = sides_[asked.side % side_count]->path_from(vertex_at(asked));
    const bool is_root = path.back() >= own_.first && path.back() < own_.last;
    TraceEnd end{is_root ? 1U : 0U, below, 0};
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

  void receive(ValueUnpacker& from) {
    const ToldLabels told = ToldLabels::unpack(from);
    for (std::size_t side = 0; side < side_count; ++side) {
      for (const Border border : borders) {
        for (const CrossingLabel& label : told.of[side][border]) {
          sides_[side]->receive({within(beyond(border, label.crossing)), label.label});
        }
      }
    }
  }
  ToldLabels told() {
    ToldLabels told;
    for (std::size_t side = 0; side < side_count; ++side) {
      for (const StepSide::Told& label : sides_[side]->take_told()) {
        const auto [border, crossing] = crossing_of(label.key);
        told.of[side][border].push_back({crossing, label.label});
      }
    }
    return told;
  }
  void say_state(ValuePacker& to) {
    for (auto& side : sides_) to.add(SideState{side->least(), side->settled()});
  }
  std::uint64_t tile_of(VertexId v) const { return overlay_->tile_of(v) + seen_rows_.first * grid_.tile_cols; }
  std::uint32_t place_of(VertexId v) const {
    const std::size_t tile = overlay_->tile_of(v);
    return tiles_[tile].keys[v - overlay_->first_key(tile)];
  }
  VertexId vertex_at(const TraceFrom& from) const {
    if (from.is_crossing != 0) return within(beyond(from.border, from.at));
    const std::uint64_t tile = from.at - seen_rows_.first * grid_.tile_cols;
    if (tile >= tiles_.size()) throw InputError("tile", "is of another rank");
    const auto& keys = tiles_[tile].keys;
    const auto found = std::lower_bound(keys.begin(), keys.end(), from.place);
    if (found == keys.end() || *found != from.place) throw InputError("path", "begins at a point that is no key");
    return overlay_->first_key(tile) + static_cast<VertexId>(found - keys.begin());
  }
  /// The key beyond a border, and the own key that it leads to.
  VertexId beyond(Border border, std::uint64_t crossing) const {
    if (crossing >= crossing_count(border)) throw InputError("crossing", "is none of this border");
    return static_cast<VertexId>(crossing + (border == below ? 0 : own_.last));
  }
  VertexId within(VertexId beyond) const { return overlay_->row(beyond)[0].target; }
  std::pair<Border, std::uint64_t> crossing_of(VertexId beyond) const {
    if (beyond < own_.first) return {below, beyond};
    return {above, beyond - own_.last};
  }
  std::uint64_t crossing_count(Border border) const {
    return border == below ? own_.first : overlay_->start() - own_.last;
  }

  const TileGrid grid_;
  const Range rows_;
  const OverlayEnds ends_;
  const Execution execution_;
  TileGrid seen_;  // the band and the rows of tiles beside it
  Range seen_rows_;
  OverlayEnds kept_;             // the keys beyond the borders are start's, those that start and goal join goal's
  std::size_t start_links_ = 0;  // of kept_.goal
  std::vector<TileSummary> tiles_;
  std::optional<Overlay> overlay_;
  Range own_{};                                          // keys
  std::array<std::vector<bool>, border_count> is_gone_;  // crossings whose own key is peeled, as far as told
  std::array<std::optional<StepSide>, side_count> sides_;
};

/// What all bands' components are together, start and goal among them.
void join_bands(const std::vector<HeldBand>& bands, bool direct, const Execution& execution, ToldRoute& route) {
  std::vector<std::size_t> first(1, 2);  // by band, behind start and goal
  route.components = 2;
  for (const HeldBand& band : bands) {
    first.push_back(first.back() + band.component_numbers);
    route.components += band.components;
  }
  execution.reserve(first.back() * sizeof(std::size_t));
  std::vector<std::size_t> parent(first.back());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto join = [&](std::size_t v, std::size_t w) {
    if (unite(parent, v, w)) --route.components;
  };
  if (direct) join(0, 1);
  for (std::size_t b = 0; b < bands.size(); ++b) {
    execution.check();
    for (std::size_t side = 0; side < side_count; ++side) {
      for (const std::uint32_t component : bands[b].linked[side]) join(side, first[b] + component);
    }
    if (b + 1 == bands.size()) continue;
    const auto& ours = bands[b].component_of[above];
    const auto& theirs = bands[b + 1].component_of[below];
    for (std::size_t i = 0; i < ours.size(); ++i) join(first[b] + ours[i], first[b + 1] + theirs[i]);
  }
  route.joined = root_of(parent, std::size_t{0}) == root_of(parent, std::size_t{1});
}

class SharedSearch {
 public:
  SharedSearch(Requests& requests, BandRounds* rounds, const TileGrid& grid, const Execution& execution,
               std::optional<SearchLack>& lack)
      : requests_(requests), rounds_(rounds), grid_(grid), execution_(execution), lack_(lack) {
    for (unsigned rank = 0; rank < requests.ranks(); ++rank) {
      const Range rows = band_rows(grid.tile_rows, rank, requests.ranks());
      if (rows.first < rows.last) ranks_.push_back(rank);
    }
    on_way_.resize(ranks_.size());
  }

  ToldRoute run(const OverlayEnds& ends) {
    ToldRoute route;
    hold(ends, route);
    if (!route.joined) return route;
    peel();
    search();
    route.expanded = sides_[0].settled + sides_[1].settled;
    const double direct = ends.direct ? distance(ends.start.at, ends.goal.at) : nothing_open;
    if (ends.direct && direct <= best_.length) return route;
    tell_rims();
    route.keys = trace(0);
    std::reverse(route.keys.begin(), route.keys.end());
    for (std::size_t i = 0; i + 1 < route.keys.size(); ++i) route.keys[i].steps = route.keys[i + 1].steps;
    const std::vector<RouteKey> rest = trace(1);
    execution_.reserve((route.keys.size() + rest.size()) * sizeof(RouteKey));
    route.keys.back() = rest.front();
    route.keys.insert(route.keys.end(), rest.begin() + 1, rest.end());
    return route;
  }

 private:
  struct Side {
    double least = 0.0;  // open label, those on their way included
    double told = 0.0;   // least, as agreed at the last exchange
    std::uint64_t settled = 0;
  };

  void hold(const OverlayEnds& ends, ToldRoute& route) {
    std::vector<HeldBand> bands;
    const auto take = [&](std::size_t b, ValueUnpacker from) {
      bands.push_back(HeldBand::unpack(from));
      if (bands[b].lacking_bytes > 0) {
        lack_ = SearchLack{ranks_[b], bands[b].lacking_bytes};
        throw Stopped(StopReason::memory);
      }
      if (b == 0 || bands[b - 1].cols[above] == bands[b].cols[below]) return;
      throw InputError("tiles", "neighbours do not agree about the border between them",
                       fmt::format("ranks {} and {}", ranks_[b - 1], ranks_[b]));
    };
    all(
        RoundStep::hold, [](std::size_t, ValuePacker&) {}, take);
    join_bands(bands, ends.direct, execution_, route);
  }
  /// Until nobody's dead ends go on beyond a border.
  void peel() {
    std::vector<ListPair<std::uint64_t>> gone(ranks_.size());
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      std::vector<ListPair<std::uint64_t>> more(ranks_.size());
      const auto take = [&](std::size_t b, ValueUnpacker from) {
        auto downwards = from.take_list<std::uint64_t>();
        auto upwards = from.take_list<std::uint64_t>();
        goes_on = goes_on || !downwards.empty() || !upwards.empty();
        if (b > 0) more[b - 1][above] = std::move(downwards);
        if (b + 1 < more.size()) more[b + 1][below] = std::move(upwards);
      };
      all(
          RoundStep::peel, [&](std::size_t band, ValuePacker& to) { add_pair(gone[band], to); }, take);
      gone = std::move(more);
    }
  }
  void search() {
    all_states(
        RoundStep::begin, [](std::size_t, ValuePacker&) {}, [](ValueUnpacker&) {});
    for (std::uint64_t round = 0; sides_[0].told + sides_[1].told < best_.length; ++round) {
      execution_.check();
      settle_round(round_size(round));
      exchange();
    }
  }
  /// As StepSide::advance() of both sides. A label on its way may come too late to be the least; then so is its bucket.
  void settle_round(std::uint64_t keys) {
    const std::array<std::uint64_t, side_count> last{sides_[0].settled + keys, sides_[1].settled + keys};
    std::array<bool, side_count> is_done{};
    for (;;) {
      std::array<double, side_count> bucket{nothing_open, nothing_open};
      for (std::size_t side = 0; side < side_count; ++side) {
        const Side& own = sides_[side];
        is_done[side] = is_done[side] || own.settled >= last[side] || own.least == nothing_open ||
                        own.least + sides_[1 - side].told >= best_.length;
        if (!is_done[side]) bucket[side] = own.least;
      }
      if (is_done[0] && is_done[1]) return;
      const auto say = [&](std::size_t band, ValuePacker& to) {
        on_way_[band].pack(to);
        for (const double steps : bucket) to.add(steps);
      };
      std::vector<ToldLabels> told;
      all_states(RoundStep::settle, say, [&](ValueUnpacker& from) { told.push_back(ToldLabels::unpack(from)); });
      tell(told);
    }
  }
  void exchange() {
    const auto take = [&](ValueUnpacker& from) {
      const auto met = from.take<Meeting>();
      if (std::tie(met.length, met.tile, met.place) < std::tie(best_.length, best_.tile, best_.place)) best_ = met;
    };
    all_states(
        RoundStep::exchange, [&](std::size_t band, ValuePacker& to) { on_way_[band].pack(to); }, take);
    on_way_.assign(ranks_.size(), {});
    for (Side& side : sides_) side.told = side.least;
  }
  void tell_rims() {
    std::vector<BorderLists<double>> rims;
    const auto take = [&](std::size_t, ValueUnpacker from) { rims.push_back(BorderLists<double>::unpack(from)); };
    all(
        RoundStep::rims, [](std::size_t, ValuePacker& to) { to.add(std::uint32_t{0}); }, take);
    const std::vector<double> none;
    const auto tell = [&](std::size_t b, ValuePacker& to) {
      to.add(std::uint32_t{1});
      for (std::size_t side = 0; side < side_count; ++side) {
        to.add_list(b > 0 ? rims[b - 1].of[side][above] : none);
        to.add_list(b + 1 < rims.size() ? rims[b + 1].of[side][below] : none);
      }
    };
    all(RoundStep::rims, tell, [](std::size_t, const ValueUnpacker&) {});
  }
  /// The way back from the meeting to the side's end; steps lead to the next key of it.
  std::vector<RouteKey> trace(std::size_t side) {
    TraceFrom from{static_cast<std::uint32_t>(side), 0, below, static_cast<std::uint32_t>(best_.place), best_.tile};
    std::size_t band = 0;
    while (band_rows(grid_.tile_rows, ranks_[band], requests_.ranks()).last * grid_.tile_cols <= best_.tile) ++band;
    std::vector<RouteKey> keys;
    for (;;) {
      execution_.check();
      ValuePacker to;
      to.add(RoundStep::trace);
      to.add(from);
      const Bytes answer = one(band, to.take());
      ValueUnpacker found(answer, fmt::format("rank {}", ranks_[band]));
      const auto end = found.take<TraceEnd>();
      const auto part = found.take_list<RouteKey>();
      execution_.reserve(2 * (keys.size() + part.size()) * sizeof(RouteKey));
      keys.insert(keys.end(), part.begin(), part.end());
      if (end.is_root != 0) return keys;
      const bool is_below = end.border == below;
      if (part.empty() || (is_below ? band == 0 : band + 1 == ranks_.size())) found.refuse();
      band = is_below ? band - 1 : band + 1;
      from = {static_cast<std::uint32_t>(side), 1, is_below ? above : below, 0, end.crossing};
    }
  }

  /// Asks each band, by number: body(band, to) adds what it needs; take(band, from) takes its answer, when all have
  /// answered.
  template <class Body, class Take>
  void all(RoundStep step, const Body& body, const Take& take) {
    std::vector<Bytes> messages;
    std::vector<unsigned> awaited;
    for (std::size_t band = 0; band < ranks_.size(); ++band) {
      ValuePacker to;
      to.add(step);
      body(band, to);
      messages.push_back(to.take());
      if (ranks_[band] == 0) continue;
      requests_.ask_one(ranks_[band], Request::rounds, messages[band]);
      awaited.push_back(ranks_[band]);
    }
    const Bytes own = ranks_[0] == 0 ? one(0, messages[0]) : Bytes();
    const std::vector<Bytes> others = requests_.answers(std::move(awaited));
    for (std::size_t band = 0; band < ranks_.size(); ++band) {
      const Bytes& answer = ranks_[band] == 0 ? own : others[ranks_[band]];
      take(band, ValueUnpacker(answer, fmt::format("rank {}", ranks_[band])));
    }
  }
  Bytes one(std::size_t band, const Bytes& message) {
    if (ranks_[band] > 0) {
      requests_.ask_one(ranks_[band], Request::rounds, message);
      return requests_.answer(ranks_[band]);
    }
    ValueUnpacker from(message, "rank 0");
    ValuePacker to;
    rounds_->serve(from, to);
    return to.take();
  }
  /// The same of a step that is answered by states: take(from) takes what follows them.
  template <class Body, class Take>
  void all_states(RoundStep step, const Body& body, const Take& take) {
    for (Side& side : sides_) {
      side.least = nothing_open;
      side.settled = 0;
    }
    all(step, body, [&](std::size_t, ValueUnpacker from) {
      for (Side& side : sides_) {
        const auto state = from.take<SideState>();
        side.least = std::min(side.least, state.least);
        side.settled += state.settled;
      }
      take(from);
    });
  }
  /// What bands tell over their borders is on its way to their neighbours, until the next message.
  void tell(const std::vector<ToldLabels>& told) {
    on_way_.assign(ranks_.size(), {});
    const auto hand_on = [&](std::size_t to, Border at, std::size_t from, Border over) {
      for (std::size_t side = 0; side < side_count; ++side) {
        on_way_[to].of[side][at] = told[from].of[side][over];
        for (const CrossingLabel& label : told[from].of[side][over]) {
          sides_[side].least = std::min(sides_[side].least, std::floor(label.label));
        }
      }
    };
    for (std::size_t b = 0; b + 1 < ranks_.size(); ++b) {
      hand_on(b + 1, below, b, above);
      hand_on(b, above, b + 1, below);
    }
  }

  Requests& requests_;
  BandRounds* const rounds_;
  const TileGrid grid_;
  const Execution execution_;
  std::optional<SearchLack>& lack_;
  std::vector<unsigned> ranks_;     // that have tiles, by band
  std::vector<ToldLabels> on_way_;  // by the band that they are for
  std::array<Side, side_count> sides_;
  Meeting best_;
};

}  // namespace

std::unique_ptr<BandRounds> band_rounds(const TileGrid& grid, Range rows, const OverlayEnds& ends,
                                        std::vector<TileSummary> tiles, const Execution& execution) {
  return std::make_unique<RoundsOfBand>(grid, rows, ends, std::move(tiles), execution);
}

ToldRoute search_over_ranks(Requests& requests, BandRounds* rounds, const TileGrid& grid, const OverlayEnds& ends,
                            const Execution& execution, std::optional<SearchLack>& lack) {
  return SharedSearch(requests, rounds, grid, execution, lack).run(ends);
}

}  // namespace warren::distributed
