// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/shared_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/search/bidirectional_search.hpp"
#include "core/search/union_find.hpp"

namespace warren::distributed {
namespace {

constexpr std::size_t below = static_cast<std::size_t>(Border::below);
constexpr std::size_t above = static_cast<std::size_t>(Border::above);

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

}  // namespace

SharedSearch::SharedSearch(Requests& requests, BandRounds* rounds, const TileGrid& grid)
    : requests_(requests), rounds_(rounds), grid_(grid) {
  for (unsigned rank = 0; rank < requests.ranks(); ++rank) {
    const TileRows rows = band_rows(grid.tile_rows, rank, requests.ranks());
    if (rows.first < rows.last) ranks_.push_back(rank);
  }
  on_way_.resize(ranks_.size());
}

Bytes SharedSearch::one(std::size_t band, const Bytes& message) {
  if (ranks_[band] > 0) {
    requests_.ask_one(ranks_[band], Request::rounds, message);
    return requests_.answer(ranks_[band]);
  }
  ValueUnpacker from(message, "rank 0");
  ValuePacker to;
  rounds_->serve(from, to);
  return to.take();
}

template <class Body>
std::vector<Bytes> SharedSearch::all(RoundStep step, const Body& body) {
  std::vector<Bytes> messages;
  for (std::size_t band = 0; band < ranks_.size(); ++band) {
    ValuePacker to;
    to.add(step);
    body(band, to);
    messages.push_back(to.take());
  }
  std::vector<unsigned> awaited;
  for (std::size_t band = 0; band < ranks_.size(); ++band) {
    if (ranks_[band] == 0) continue;
    requests_.ask_one(ranks_[band], Request::rounds, messages[band]);
    awaited.push_back(ranks_[band]);
  }
  std::vector<Bytes> found(ranks_.size());
  if (ranks_[0] == 0) found[0] = one(0, messages[0]);
  std::vector<Bytes> others = requests_.answers(std::move(awaited));
  for (std::size_t band = 0; band < ranks_.size(); ++band) {
    if (ranks_[band] > 0) found[band] = std::move(others[ranks_[band]]);
  }
  return found;
}

ToldRoute SharedSearch::run(const OverlayEnds& ends, const Execution& execution) {
  execution_ = execution;
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

void SharedSearch::hold(const OverlayEnds& ends, ToldRoute& route) {
  const std::vector<Bytes> answers = all(RoundStep::hold, [](std::size_t, ValuePacker&) {});
  std::vector<HeldBand> bands;
  for (std::size_t b = 0; b < answers.size(); ++b) {
    ValueUnpacker from(answers[b], fmt::format("rank {}", ranks_[b]));
    bands.push_back(HeldBand::unpack(from));
    if (bands[b].lacking_bytes > 0) {
      lack_ = Lack{ranks_[b], bands[b].lacking_bytes};
      throw Stopped(StopReason::memory);
    }
    if (b == 0 || bands[b - 1].cols[above] == bands[b].cols[below]) continue;
    throw InputError("tiles", "neighbours do not agree about the border between them",
                     fmt::format("ranks {} and {}", ranks_[b - 1], ranks_[b]));
  }
  join_bands(bands, ends.direct, execution_, route);
}

/// Until nobody's dead ends go on beyond a border.
void SharedSearch::peel() {
  using Gone = std::array<std::vector<std::uint64_t>, border_count>;
  std::vector<Gone> gone(ranks_.size());
  for (bool goes_on = true; goes_on;) {
    const std::vector<Bytes> answers = all(RoundStep::peel, [&](std::size_t band, ValuePacker& to) {
      for (const auto& crossings : gone[band]) to.add_list(crossings);
    });
    goes_on = false;
    gone.assign(ranks_.size(), {});
    for (std::size_t b = 0; b < answers.size(); ++b) {
      ValueUnpacker from(answers[b], fmt::format("rank {}", ranks_[b]));
      auto downwards = from.take_list<std::uint64_t>();
      auto upwards = from.take_list<std::uint64_t>();
      goes_on = goes_on || !downwards.empty() || !upwards.empty();
      if (b > 0) gone[b - 1][above] = std::move(downwards);
      if (b + 1 < answers.size()) gone[b + 1][below] = std::move(upwards);
    }
  }
}

/// What bands tell over their borders is on its way to their neighbours, until the next message.
void SharedSearch::tell(const std::vector<ToldLabels>& told) {
  on_way_.assign(ranks_.size(), {});
  const auto hand_on = [&](std::size_t to, std::size_t at, std::size_t from, std::size_t over) {
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

void SharedSearch::take_states(const std::vector<Bytes>& answers) {
  for (Side& side : sides_) {
    side.least = nothing_open;
    side.settled = 0;
  }
  for (const Bytes& answer : answers) {
    ValueUnpacker from(answer, "ranks");
    for (Side& side : sides_) {
      const auto state = from.take<SideState>();
      side.least = std::min(side.least, state.least);
      side.settled += state.settled;
    }
  }
}

void SharedSearch::settle_buckets(std::array<double, side_count> bucket) {
  const std::vector<Bytes> answers = all(RoundStep::settle, [&](std::size_t band, ValuePacker& to) {
    on_way_[band].pack(to);
    for (const double steps : bucket) to.add(steps);
  });
  take_states(answers);
  std::vector<ToldLabels> told;
  for (const Bytes& answer : answers) {
    ValueUnpacker from(answer, "ranks");
    for (std::size_t side = 0; side < side_count; ++side) from.take<SideState>();
    told.push_back(ToldLabels::unpack(from));
  }
  tell(told);
}

/// As StepSide::advance() of both sides. A label on its way may come too late to be the least; then so is its bucket.
void SharedSearch::settle_round(std::uint64_t keys) {
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
    settle_buckets(bucket);
  }
}

void SharedSearch::exchange() {
  const std::vector<Bytes> answers =
      all(RoundStep::exchange, [&](std::size_t band, ValuePacker& to) { on_way_[band].pack(to); });
  on_way_.assign(ranks_.size(), {});
  take_states(answers);
  for (const Bytes& answer : answers) {
    ValueUnpacker from(answer, "ranks");
    for (std::size_t side = 0; side < side_count; ++side) from.take<SideState>();
    const auto met = from.take<Meeting>();
    if (std::tie(met.length, met.tile, met.place) < std::tie(best_.length, best_.tile, best_.place)) best_ = met;
  }
  for (Side& side : sides_) side.told = side.least;
}

void SharedSearch::search() {
  take_states(all(RoundStep::begin, [](std::size_t, ValuePacker&) {}));
  for (std::uint64_t round = 0; sides_[0].told + sides_[1].told < best_.length; ++round) {
    execution_.check();
    settle_round(round_size(round));
    exchange();
  }
}

/// Labels at the borders, to and fro.
void SharedSearch::tell_rims() {
  const std::vector<Bytes> answers =
      all(RoundStep::rims, [](std::size_t, ValuePacker& to) { to.add(std::uint32_t{0}); });
  std::vector<std::array<std::array<std::vector<double>, border_count>, side_count>> rims(ranks_.size());
  for (std::size_t b = 0; b < answers.size(); ++b) {
    ValueUnpacker from(answers[b], fmt::format("rank {}", ranks_[b]));
    for (auto& side : rims[b]) {
      for (auto& labels : side) labels = from.take_list<double>();
    }
  }
  const std::vector<double> none;
  all(RoundStep::rims, [&](std::size_t b, ValuePacker& to) {
    to.add(std::uint32_t{1});
    for (std::size_t side = 0; side < side_count; ++side) {
      to.add_list(b > 0 ? rims[b - 1][side][above] : none);
      to.add_list(b + 1 < rims.size() ? rims[b + 1][side][below] : none);
    }
  });
}

/// The way back from the meeting to the side's end; steps lead to the next key of it.
std::vector<RouteKey> SharedSearch::trace(std::size_t side) {
  TraceFrom from{static_cast<std::uint32_t>(side), 0, Border::below, static_cast<std::uint32_t>(best_.place),
                 best_.tile};
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
    const bool is_below = end.border == Border::below;
    if (part.empty() || (is_below ? band == 0 : band + 1 == ranks_.size())) found.refuse();
    band = is_below ? band - 1 : band + 1;
    from = {static_cast<std::uint32_t>(side), 1, is_below ? Border::above : Border::below, 0, end.crossing};
  }
}

}  // namespace warren::distributed
