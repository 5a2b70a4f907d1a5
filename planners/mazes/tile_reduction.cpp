// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tile_reduction.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "core/base/error.hpp"

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

/// Column or row, by the side (0 right, 1 above, 2 left, 3 below), of the points that cross it.
bool agree(const TileGrid& grid, const TileSummary& tile, const TileSummary& beyond, unsigned side) {
  const auto place = [&](const TileSummary& of, std::uint16_t key) {
    const std::uint32_t local = of.keys[key];
    return side == 0 ? local >> grid.side_log2 : local & (grid.side() - 1);
  };
  return std::equal(tile.crossings[side].begin(), tile.crossings[side].end(), beyond.crossings[side ^ 2U].begin(),
                    beyond.crossings[side ^ 2U].end(), [&](std::uint16_t ours, std::uint16_t theirs) {
                      return place(tile, ours) == place(beyond, theirs);
                    });
}

using plane_bit::edges, plane_bit::kept, plane_bit::key;

/// One edge and not kept. A table of 64 answers in a word.
constexpr std::uint64_t dead_end_set = [] {
  std::uint64_t set = 0;
  for (unsigned bits = 0; bits < 64; ++bits) {
    if (std::has_single_bit(bits & edges) && (bits & kept) == 0) set |= std::uint64_t{1} << bits;
  }
  return set;
}();
constexpr bool is_dead_end(unsigned bits) { return ((dead_end_set >> (bits & 63)) & 1) != 0; }

/// Calls visit(i) for each of the bytes that has a bit of `mask`; eight bytes are skipped at once where none has.
template <class Visit>
void for_each_with(const std::uint8_t* bytes, int count, std::uint8_t mask, const Visit& visit) {
  const std::uint64_t masks = 0x0101010101010101U * mask;
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i, 8);
    for (word &= masks; word != 0;) {
      const int byte = std::countr_zero(word) / 8;
      visit(i + byte);
      word &= ~(std::uint64_t{0xff} << (8 * byte));
    }
  }
  for (; i < count; ++i) {
    if ((bytes[i] & mask) != 0) visit(i);
  }
}

/// Sums of single bits fit a byte for 255 points at a time, so that compilers add 16 or more points at once.
void count_points(const TilePlane& plane, TileSummary& summary) {
  constexpr int batch = 64;
  for (int row = 0; row < plane.height(); ++row) {
    for (int first = 0; first < plane.width(); first += batch) {
      const std::uint8_t* at = plane.at(first, row);
      const std::uint8_t* above = plane.at(first, row + 1);
      const int n = std::min(batch, plane.width() - first);
      std::uint8_t stand = 0;
      std::uint8_t pairs = 0;
      std::uint8_t open = 0;
      for (int i = 0; i < n; ++i) {
        stand = static_cast<std::uint8_t>(stand + ((at[i] >> 4) & 1));
        pairs = static_cast<std::uint8_t>(pairs + (((at[i] & at[i + 1]) >> 4) & 1) + (((at[i] & above[i]) >> 4) & 1));
        open = static_cast<std::uint8_t>(open + (at[i] & 1) + ((at[i] >> 1) & 1));
      }
      summary.milestones += stand;
      summary.candidate_edges += pairs;
      summary.free_edges += open;
    }
  }
}

/// Calls visit(point, direction) for each point at a border and the direction that leads over it, along each border.
template <class Visit>
void for_each_at_border(TilePlane& plane, const Visit& visit) {
  for (int row = 0; row < plane.height(); ++row) {
    visit(plane.at(plane.width() - 1, row), 0U);
    visit(plane.at(0, row), 2U);
  }
  for (int col = 0; col < plane.width(); ++col) {
    visit(plane.at(col, plane.height() - 1), 1U);
    visit(plane.at(col, 0), 3U);
  }
}

PlaneRow row_of(TilePlane& plane, int row, std::vector<std::uint8_t>& found) {
  return {plane.at(0, row), plane.at(0, row + 1), plane.at(0, row - 1), found.data() + 1, plane.width()};
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

void check_borders(const TileGrid& grid, std::span<const TileSummary> tiles, const Execution& execution) {
  const TileSummary nothing;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    execution.poll(t);
    const bool is_last = t % grid.tile_cols + 1 == grid.tile_cols;
    const bool is_top = t + grid.tile_cols >= tiles.size();
    if (agree(grid, tiles[t], is_last ? nothing : tiles[t + 1], 0) &&
        agree(grid, tiles[t], is_top ? nothing : tiles[t + grid.tile_cols], 1)) {
      continue;
    }
    throw InputError("tiles", "neighbours do not agree about the border between them", std::to_string(t));
  }
}

TileReduction::TileReduction(const TilePlane& plane)
    : offset_(plane.offsets()),
      found_(static_cast<std::size_t>(plane.stride()) + 2),
      number_(static_cast<std::size_t>(plane.stride()) * static_cast<std::size_t>(plane.stride())),
      steps_(2 * std::size_t{plane.grid().side()} * plane.grid().side()) {}

TileSummary TileReduction::reduce(TilePlane& plane) {
  TileSummary summary;
  count_points(plane, summary);
  for_each_at_border(plane, [](std::uint8_t* at, unsigned direction) {
    if ((*at & (1U << direction)) != 0) *at |= kept;
  });
  peel(plane);
  number_keys(plane, summary);
  cut_crossings(plane, summary);
  chain_keys(plane);
  close_rings(plane, summary);
  summary.keys = keys_;
  summary.chains = chains_;
  summary.steps.assign(steps_.begin(), steps_.begin() + step_count_);
  return summary;
}

/// Passes over all rows, upwards and downwards in turn: most dead ends are short, and many points are looked at per
/// instruction. What is left is followed one by one. A vertex that is peeled becomes 0; the last one of a tree keeps
/// its milestone bit.
void TileReduction::peel(TilePlane& plane) {
  const PlaneRowWork& work = plane_row_work();
  const int height = plane.height();
  for (int pass = 0; pass < bulk_passes; ++pass) {
    for (int i = 0; i < height; ++i) work.peel(row_of(plane, pass % 2 == 0 ? i : height - 1 - i, found_));
  }
  for (int row = 0; row < height; ++row) {
    const PlaneRow line = row_of(plane, row, found_);
    work.find_dead_ends(line);
    for_each_with(line.found, line.width, edges, [&](int col) { follow_dead_end(line.row + col); });
  }
}

void TileReduction::follow_dead_end(std::uint8_t* at) const {
  while (is_dead_end(*at)) {
    const unsigned direction = first_direction(*at & edges);
    *at = 0;
    at += offset_[direction];
    *at &= static_cast<std::uint8_t>(~opposite_bit(direction));
  }
}

void TileReduction::number_keys(TilePlane& plane, TileSummary& summary) {
  keys_.clear();
  places_.clear();
  const std::uint8_t* const base = plane.at(-plane.margin(), -plane.margin());
  for (int row = 0; row < plane.height(); ++row) {
    const PlaneRow line = row_of(plane, row, found_);
    plane_row_work().find_keys(line);
    for_each_with(line.found, line.width, 255, [&](int col) {
      std::uint8_t& bits = line.row[col];
      if ((bits & (edges | kept)) == 0) {
        ++summary.closed_components;
        return;
      }
      const auto place = static_cast<std::int32_t>(line.row + col - base);
      number_[static_cast<std::size_t>(place)] = static_cast<std::uint16_t>(keys_.size());
      keys_.push_back(static_cast<std::uint16_t>(row * static_cast<int>(plane.grid().side()) + col));
      places_.push_back(place);
      bits |= key;
    });
  }
}

/// Edges over the border are the neighbours' as well: they leave the plane and are listed side by side.
void TileReduction::cut_crossings(TilePlane& plane, TileSummary& summary) {
  const std::uint8_t* const base = plane.at(-plane.margin(), -plane.margin());
  for_each_at_border(plane, [&](std::uint8_t* at, unsigned direction) {
    if ((*at & (1U << direction)) == 0) return;
    *at &= static_cast<std::uint8_t>(~(1U << direction));
    summary.crossings[direction].push_back(number_[static_cast<std::size_t>(at - base)]);
  });
}

void TileReduction::chain_keys(TilePlane& plane) {
  chains_.clear();
  step_count_ = 0;
  std::uint8_t* const base = plane.at(-plane.margin(), -plane.margin());
  for (const std::int32_t place : places_) {
    std::uint8_t* const at = base + place;
    for (unsigned left = *at & edges; left != 0; left = *at & edges) follow(at, first_direction(left), plane);
  }
}

/// Walks from a key to the next, wiping out the way. A way back to the same key is on no shortest path.
void TileReduction::follow(std::uint8_t* from, unsigned direction, const TilePlane& plane) {
  const std::uint8_t* const base = plane.at(-plane.margin(), -plane.margin());
  std::uint8_t* const first_step = steps_.data() + step_count_;
  std::uint8_t* step = first_step;
  std::uint8_t* at = from;
  *at &= static_cast<std::uint8_t>(~(1U << direction));
  for (;;) {
    *step++ = static_cast<std::uint8_t>(direction);
    at += offset_[direction];
    const unsigned bits = *at & ~static_cast<unsigned>(opposite_bit(direction));
    if ((bits & key) != 0) {
      *at = static_cast<std::uint8_t>(bits);
      break;
    }
    direction = first_direction(bits & edges);
    *at = 0;
  }
  if (at == from) return;
  const auto length = static_cast<std::uint32_t>(step - first_step);
  chains_.push_back({number_[static_cast<std::size_t>(from - base)], number_[static_cast<std::size_t>(at - base)],
                     step_count_, length});
  step_count_ += length;
}

/// What is left now are rings without a key: each is a component of its own.
void TileReduction::close_rings(TilePlane& plane, TileSummary& summary) const {
  for (int row = 0; row < plane.height(); ++row) {
    std::uint8_t* const line = plane.at(0, row);
    for_each_with(line, plane.width(), edges, [&](int col) {
      std::uint8_t* at = line + col;
      if ((*at & edges) == 0) return;  // of the ring before
      while ((*at & edges) != 0) {
        const unsigned direction = first_direction(*at & edges);
        *at &= static_cast<std::uint8_t>(~(1U << direction));
        at += offset_[direction];
        *at &= static_cast<std::uint8_t>(~opposite_bit(direction));
      }
      ++summary.closed_components;
    });
  }
}

}  // namespace warren
