// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/front_query.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace warren {

std::uint64_t front_column(const FrontArrays& fronts, const Front& f, GateRank rank) {
  const std::uint64_t width = std::uint64_t{f.gates} + f.bounds;
  if (rank < f.first) return width;
  if (rank - f.first < f.gates) return rank - f.first;
  const std::span<const GateRank> bounds = fronts.bounds.span().subspan(f.first_bound, f.bounds);
  const auto at = std::lower_bound(bounds.begin(), bounds.end(), rank);
  if (at == bounds.end() || *at != rank) return width;
  return f.gates + static_cast<std::uint64_t>(at - bounds.begin());
}

FrontQuery::FrontQuery(const RouteIndex& index)
    : index_(index), fronts_(index.arrays().fronts), lessen_(lessen_row()), lessen_short_(lessen_row_short()) {
  forward_.distance.assign(fronts_.gate_place.size(), no_way);
  backward_.distance.assign(fronts_.gate_place.size(), no_way);
}

FrontId FrontQuery::seed(Half& half, std::span<const SeenGate> seeds) const {
  half.climbed.clear();
  GateRank lowest = ~GateRank{0};
  for (const SeenGate& gate : seeds) {
    half.distance[gate.rank] = gate.steps;
    lowest = std::min(lowest, gate.rank);
  }
  return seeds.empty() ? no_front : index_.front_of(lowest);
}

std::uint32_t FrontQuery::length(std::span<const SeenGate> starts, std::span<const SeenGate> goals,
                                 std::uint32_t below) {
  best_ = below;
  climb(starts, goals);
  clear(forward_, starts);
  clear(backward_, goals);
  return best_;
}

void FrontQuery::climb(std::span<const SeenGate> starts, std::span<const SeenGate> goals) {
  FrontId up = seed(forward_, starts);
  FrontId down = seed(backward_, goals);
  while (up != no_front && down != no_front) {
    const FrontId front = std::min(up, down);
    if (up == down) {
      settle_both(front);
      up = down = fronts_.fronts[front].parent;
    } else if (front == up) {
      settle(front, forward_);
      up = fronts_.fronts[front].parent;
    } else {
      settle(front, backward_);
      down = fronts_.fronts[front].parent;
    }
  }
}

void FrontQuery::settle(FrontId front, Half& half) {
  const Front& f = index_.front(front);
  half.climbed.push_back(front);
  load_bounds(f, half, bounds_);
  for (std::uint32_t i = 0; i < f.gates; ++i) lessen_by(f, i, half, bounds_);
  store_bounds(f, half, bounds_);
}

void FrontQuery::settle_both(FrontId front) {
  const Front& f = index_.front(front);
  forward_.climbed.push_back(front);
  backward_.climbed.push_back(front);
  load_bounds(f, forward_, bounds_);
  load_bounds(f, backward_, other_bounds_);
  for (std::uint32_t i = 0; i < f.gates; ++i) {
    const std::uint32_t sum = forward_.distance[f.first + i] + backward_.distance[f.first + i];
    if (sum < best_) {
      best_ = sum;
      meeting_ = f.first + i;
    }
    lessen_by(f, i, forward_, bounds_);
    lessen_by(f, i, backward_, other_bounds_);
  }
  store_bounds(f, forward_, bounds_);
  store_bounds(f, backward_, other_bounds_);
}

void FrontQuery::lessen_by(const Front& f, std::uint32_t gate, Half& half, RawVector<std::uint32_t>& bounds) const {
  const std::uint32_t distance = half.distance[f.first + gate];
  if (distance >= best_) return;
  const std::uint64_t row = f.first_length() + row_offset(gate, f.gates, f.bounds);
  std::uint32_t* const later = half.distance.data() + f.first + gate + 1;
  const std::uint32_t count = f.gates - gate - 1;
  if (f.is_short()) {
    const std::uint16_t* const lengths = fronts_.short_lengths.data() + row;
    lessen_short_(later, lengths, distance, count);
    lessen_short_(bounds.data(), lengths + count, distance, f.bounds);
  } else {
    const std::uint32_t* const lengths = fronts_.lengths.data() + row;
    lessen_(later, lengths, distance, count);
    lessen_(bounds.data(), lengths + count, distance, f.bounds);
  }
}

void FrontQuery::load_bounds(const Front& f, const Half& half, RawVector<std::uint32_t>& bounds) const {
  bounds.resize(std::max<std::size_t>(bounds.size(), f.bounds));
  const GateRank* const rank = fronts_.bounds.data() + f.first_bound;
  for (std::uint32_t i = 0; i < f.bounds; ++i) bounds[i] = half.distance[rank[i]];
}

void FrontQuery::store_bounds(const Front& f, Half& half, const RawVector<std::uint32_t>& bounds) const {
  const GateRank* const rank = fronts_.bounds.data() + f.first_bound;
  for (std::uint32_t i = 0; i < f.bounds; ++i) half.distance[rank[i]] = bounds[i];
}

/// Bounds of a front are gates of fronts above it, which may not all have been climbed.
void FrontQuery::clear(Half& half, std::span<const SeenGate> seeds) const {
  for (const SeenGate& gate : seeds) half.distance[gate.rank] = no_way;
  for (const FrontId front : half.climbed) {
    const Front& f = fronts_.fronts[front];
    std::fill_n(half.distance.begin() + f.first, f.gates, no_way);
    const GateRank* const rank = fronts_.bounds.data() + f.first_bound;
    for (std::uint32_t i = 0; i < f.bounds; ++i) half.distance[rank[i]] = no_way;
  }
}

FrontQuery::Way FrontQuery::way(std::span<const SeenGate> starts, std::span<const SeenGate> goals,
                                std::uint32_t below) {
  best_ = below;
  climb(starts, goals);
  Way way{best_, 0, 0, {}};
  if (best_ < below) {
    way.first = trace(forward_, starts, meeting_, way.steps);
    std::reverse(way.steps.begin(), way.steps.end());
    std::vector<FrontStep> down;
    way.last = trace(backward_, goals, meeting_, down);
    for (const FrontStep& step : down) way.steps.push_back({step.front, step.to, step.from, step.length});
  }
  clear(forward_, starts);
  clear(backward_, goals);
  return way;
}

/// Back to a seed: the steps as they were climbed, the last one first. Returns the seed's index.
std::size_t FrontQuery::trace(const Half& half, std::span<const SeenGate> seeds, GateRank from,
                              std::vector<FrontStep>& steps) const {
  for (;;) {
    const auto seed = std::find_if(seeds.begin(), seeds.end(), [&](const SeenGate& gate) {
      return gate.rank == from && gate.steps == half.distance[from];
    });
    if (seed != seeds.end()) return static_cast<std::size_t>(seed - seeds.begin());
    steps.push_back(step_into(half, from));
    from = steps.back().from;
  }
}

FrontStep FrontQuery::step_into(const Half& half, GateRank to) const {
  for (const FrontId front : half.climbed) {
    const Front& f = fronts_.fronts[front];
    const std::uint64_t column = front_column(fronts_, f, to);
    if (column == std::uint64_t{f.gates} + f.bounds) continue;
    for (std::uint32_t i = 0; i < f.gates && i < column; ++i) {
      const std::uint32_t distance = half.distance[f.first + i];
      if (distance >= half.distance[to]) continue;
      const std::uint32_t length = front_entry(fronts_, f, front_place(f, i, column));
      if (distance + length == half.distance[to]) return {front, f.first + i, to, length};
    }
  }
  throw InputError("route index", "its fronts contradict each other: build it again");
}

}  // namespace warren
