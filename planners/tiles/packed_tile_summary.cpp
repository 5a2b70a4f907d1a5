// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/packed_tile_summary.hpp"

#include <algorithm>
#include <functional>

namespace warren {
namespace {

bool is_of(const TileSummary& tile, std::uint32_t side) {
  const std::size_t keys = tile.keys.size();
  const bool ascends = std::is_sorted(tile.keys.begin(), tile.keys.end(), std::less_equal<>());
  const bool within = keys == 0 || tile.keys.back() < side * side;
  const auto stands = [&](const Chain& chain) {
    const bool has_steps = tile.steps.empty() || (chain.first_step <= tile.steps.size() &&
                                                  chain.length <= tile.steps.size() - chain.first_step);
    return chain.from < keys && chain.to < keys && chain.length > 0 && has_steps;
  };
  const bool chains = std::all_of(tile.chains.begin(), tile.chains.end(), stands);
  const auto crosses = [&](const std::vector<std::uint16_t>& crossing) {
    return std::all_of(crossing.begin(), crossing.end(), [&](std::uint16_t key) { return key < keys; });
  };
  return ascends && within && chains && std::all_of(tile.crossings.begin(), tile.crossings.end(), crosses);
}

}  // namespace

void pack_summary(const TileSummary& tile, ValuePacker& to) {
  to.add_list(tile.keys);
  to.add_list(tile.chains);
  to.add_list(tile.steps);
  for (const auto& crossing : tile.crossings) to.add_list(crossing);
  for (const std::uint64_t count : {tile.milestones, tile.candidate_edges, tile.free_edges, tile.closed_components}) {
    to.add(count);
  }
}

TileSummary unpack_summary(ValueUnpacker& from, std::uint32_t side) {
  TileSummary tile;
  tile.keys = from.take_list<std::uint16_t>();
  tile.chains = from.take_list<Chain>();
  tile.steps = from.take_list<std::uint8_t>();
  for (auto& crossing : tile.crossings) crossing = from.take_list<std::uint16_t>();
  for (std::uint64_t* count : {&tile.milestones, &tile.candidate_edges, &tile.free_edges, &tile.closed_components}) {
    *count = from.take<std::uint64_t>();
  }
  if (!is_of(tile, side)) from.refuse();
  return tile;
}

}  // namespace warren
