// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tile_plane.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/instruction_set.hpp"
#include "core/plane/geometry.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {
namespace {

/// First and one past the last local number, ring included, of lattice points inside [low, high] of `count`.
struct Span {
  int first;
  int end;
};

Span standing(double low, double high, std::uint32_t count, std::uint32_t origin, int ring_end) {
  const double first = std::max(0.0, std::ceil(low) - 1);
  const double end = std::min(static_cast<double>(count), std::floor(high));  // points stand at 1 .. count
  const double from = std::clamp(first - origin, -1.0, static_cast<double>(ring_end));
  return {static_cast<int>(from), static_cast<int>(std::clamp(end - origin, from, static_cast<double>(ring_end)))};
}

using plane_bit::edges, plane_bit::kept;
using Byte = std::uint8_t;

[[gnu::always_inline]] inline void find_dead_ends(const Byte* __restrict row, Byte* __restrict found, int width) {
  for (int i = 0; i < width; ++i) {
    const auto open = static_cast<Byte>(row[i] & edges);
    const auto more = static_cast<Byte>(open & (open - 1));
    const auto held = static_cast<Byte>(row[i] & kept);
    found[i] = (more | held) == 0 ? open : Byte{0};
  }
}

[[gnu::always_inline]] inline void peel(Byte* __restrict row, Byte* __restrict above, Byte* __restrict below,
                                        Byte* __restrict ends, int width) {
  find_dead_ends(row, ends, width);
  ends[-1] = 0;
  ends[width] = 0;
  for (int i = 0; i < width; ++i) {
    const auto from_left = static_cast<Byte>((ends[i - 1] & plane_bit::right) << 2);
    const auto from_right = static_cast<Byte>((ends[i + 1] & plane_bit::left) >> 2);
    const auto open = static_cast<Byte>(row[i] & ~(from_left | from_right));
    const auto met = static_cast<Byte>(ends[i] & from_right);  // by the dead end on its right: stays, without edges
    row[i] = (ends[i] ^ met) == 0 ? open : Byte{0};
    above[i] = static_cast<Byte>(above[i] & ~((ends[i] & plane_bit::up) << 2));
    below[i] = static_cast<Byte>(below[i] & ~((ends[i] & plane_bit::down) >> 2));
  }
}

[[gnu::always_inline]] inline void find_keys(const Byte* __restrict row, Byte* __restrict found, int width) {
  for (int i = 0; i < width; ++i) {
    const auto open = static_cast<Byte>(row[i] & edges);
    const auto two = static_cast<Byte>(open & (open - 1));
    const auto three = static_cast<Byte>(two & (two - 1));
    const auto held = static_cast<Byte>(row[i] & kept);
    const auto between = static_cast<Byte>((two != 0 ? 255 : 0) & ((three | held) == 0 ? 255 : 0));
    found[i] = static_cast<Byte>(row[i] & ~between);
  }
}

[[gnu::always_inline]] inline void peel_row(const PlaneRow& r) { peel(r.row, r.above, r.below, r.found, r.width); }
[[gnu::always_inline]] inline void dead_ends_of_row(const PlaneRow& r) { find_dead_ends(r.row, r.found, r.width); }
[[gnu::always_inline]] inline void keys_of_row(const PlaneRow& r) { find_keys(r.row, r.found, r.width); }

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
  if (!ascends || !within || !chains) return false;
  constexpr std::uint8_t most_ends = 4;
  std::vector<std::uint8_t> ends(keys, 0);
  for (const Chain& chain : tile.chains) {
    if (++ends[chain.from] > most_ends || ++ends[chain.to] > most_ends) return false;
  }
  const auto crosses = [&](const std::vector<std::uint16_t>& crossing) {
    return std::all_of(crossing.begin(), crossing.end(), [&](std::uint16_t key) { return key < keys; });
  };
  return std::all_of(tile.crossings.begin(), tile.crossings.end(), crosses);
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

constexpr std::size_t slot_of(std::uint64_t key) { return (key * 0x9e3779b97f4a7c15U) >> 56; }

void clear_bits(std::uint8_t& byte, unsigned bits) { byte = static_cast<std::uint8_t>(byte & ~bits); }

/// What a wall blocks of the point (col, row), its right and its upper edge, as bits; asked only for bits in `wanted`.
unsigned blocked_bits(const Segment& wall, Vec2 point, unsigned wanted, double clearance) {
  unsigned blocked = 0;
  const auto ask = [&](unsigned bit, Vec2 end) {
    if ((wanted & bit) != 0 && blocks_edge(wall, {point, end}, clearance)) blocked |= bit;
  };
  ask(plane_bit::milestone, point);
  ask(plane_bit::right, {point.x + 1, point.y});
  ask(plane_bit::up, {point.x, point.y + 1});
  return blocked;
}

}  // namespace

void TilePlane::reset(std::size_t tile, const Box& box) {
  tile_ = tile;
  std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0});
  const Span cols = standing(box.min.x, box.max.x, grid_.cols, grid_.first_col(tile), width() + 1);
  const Span rows = standing(box.min.y, box.max.y, grid_.rows, grid_.first_row(tile), height() + 1);
  if (cols.first >= cols.end) return;
  for (int row = rows.first; row < rows.end; ++row) {
    unsigned bits = plane_bit::edges | plane_bit::milestone;
    if (row == rows.first) bits &= ~unsigned{plane_bit::down};
    if (row + 1 == rows.end) bits &= ~unsigned{plane_bit::up};
    std::fill(at(cols.first, row), at(cols.end, row), static_cast<std::uint8_t>(bits));
    *at(cols.first, row) &= static_cast<std::uint8_t>(~plane_bit::left);
    *at(cols.end - 1, row) &= static_cast<std::uint8_t>(~plane_bit::right);
  }
}

std::vector<PlaneRowWork> plane_row_variants() {
  using detail::InstructionSet;
  using Peel = detail::VersionsOf<&peel_row>;
  using DeadEnds = detail::VersionsOf<&dead_ends_of_row>;
  using Keys = detail::VersionsOf<&keys_of_row>;
  std::vector<PlaneRowWork> variants{{"baseline", Peel::baseline, DeadEnds::baseline, Keys::baseline}};
  const InstructionSet best = detail::best_instruction_set();
  if (best >= InstructionSet::avx2) variants.push_back({"AVX2", Peel::avx2, DeadEnds::avx2, Keys::avx2});
  if (best == InstructionSet::avx512) variants.push_back({"AVX-512", Peel::avx512, DeadEnds::avx512, Keys::avx512});
  return variants;
}

const PlaneRowWork& plane_row_work() {
  static const PlaneRowWork fastest = plane_row_variants().back();
  return fastest;
}

bool blocks_edge(const Segment& wall, const Segment& edge, double clearance) noexcept {
  if (clearance <= 0.0) return segments_touch(edge, wall);
  return box_of(edge).grown(clearance).meets(box_of(wall)) && !segments_keep_distance(edge, wall, clearance);
}

WallMarker::WallMarker(double clearance)
    : clearance_(clearance), reach_(static_cast<int>(std::ceil(clearance))), slots_(slot_count), shapes_(slot_count) {
  assert(clearance >= 0.0 && clearance <= largest_clearance * (1 + 1e-8));
}

void WallMarker::mark(const TileWalls& walls, TilePlane& plane) {
  assert(plane.margin() >= margin());
  if (stride_ != plane.stride()) {
    std::fill(slots_.begin(), slots_.end(), Slot());
    taken_ = 0;
    stride_ = plane.stride();
  }
  const int middle = static_cast<int>(plane.grid().side() / 2);
  std::uint8_t* const origin = plane.at(middle, middle);
  const auto stride = static_cast<std::int16_t>(plane.stride());
  const std::span<const NarrowWall> narrow = walls.narrow;
  for (std::size_t i = 0; i < narrow.size(); i += 2) {
    const bool single = i + 1 == narrow.size();
    const auto [one, other] = detail::wall_shapes(narrow.data() + i, single, stride);
    mark_shape(one.key, narrow[i], origin + one.place, plane);
    if (!single) mark_shape(other.key, narrow[i + 1], origin + other.place, plane);
  }
  walls.for_each_wide([&](const Segment& wall) { mark_one(wall, plane); });
}

inline void WallMarker::mark_shape(std::uint64_t key, const NarrowWall& wall, std::uint8_t* cell, TilePlane& plane) {
  Slot& slot = slots_[slot_of(key)];
  if (slot.known != key) {
    const bool came_before = std::exchange(slot.seen, key) == key;
    if (!came_before) return mark_one(plane.grid().segment(plane.tile(), wall), plane);
    if (slot.shape == nullptr) slot.shape = &shapes_[taken_++];
    learn(key, *slot.shape, plane.stride());
    slot.known = key;
  }
  const Shape& shape = *slot.shape;
  if (shape.count > most_clears) return mark_one(plane.grid().segment(plane.tile(), wall), plane);
  for (unsigned c = 0; c < shape.count; ++c) cell[shape.offset[c]] &= shape.keep_bits[c];
}

/// Finds out what walls of this shape clear; a count above most_clears says that it is too much to remember. The wall
/// stands where its lower left corner's cell is the lattice point (0, 0): coordinates differ from the world's, their
/// differences don't.
void WallMarker::learn(std::uint64_t key, Shape& shape, int stride) const {
  constexpr double unit = 1.0 / narrow_unit;
  const auto coordinate = [&](unsigned i) { return static_cast<double>((key >> (16 * i)) & 0xffff) * unit; };
  const Segment wall{{coordinate(0), coordinate(1)}, {coordinate(2), coordinate(3)}};
  const Vec2 corner = box_of(wall).max;
  shape.count = corner.x > longest_shape || corner.y > longest_shape ? most_clears + 1 : 0;
  const auto clear = [&](int col, int row, unsigned bits) {
    const auto offset = static_cast<std::int16_t>(row * stride + col);
    if (shape.count > most_clears) return;
    const auto* end = shape.offset.cbegin() + shape.count;
    const auto* found = std::find(shape.offset.cbegin(), end, offset);
    const auto at = static_cast<std::size_t>(found - shape.offset.cbegin());
    if (found == end) {
      if (++shape.count > most_clears) return;
      shape.offset[at] = offset;
      shape.keep_bits[at] = 0xff;
    }
    clear_bits(shape.keep_bits[at], bits);
  };
  const int last_row = static_cast<int>(corner.y) + 1 + reach_;
  for (int row = -1 - reach_; row <= last_row && shape.count <= most_clears; ++row) {
    for (int col = -1 - reach_; col <= static_cast<int>(corner.x) + 1 + reach_; ++col) {
      constexpr unsigned all = plane_bit::milestone | plane_bit::right | plane_bit::up;
      const Vec2 point{static_cast<double>(col), static_cast<double>(row)};
      const unsigned blocked = blocked_bits(wall, point, all, clearance_);
      if (blocked != 0) clear(col, row, blocked);
      if ((blocked & plane_bit::right) != 0) clear(col + 1, row, plane_bit::left);
      if ((blocked & plane_bit::up) != 0) clear(col, row + 1, plane_bit::down);
    }
  }
}

void WallMarker::mark_one(const Segment& wall, TilePlane& plane) const {
  const TileGrid& grid = plane.grid();
  const std::int64_t first_col = grid.first_col(plane.tile());
  const std::int64_t first_row = grid.first_row(plane.tile());
  const Vec2 origin = TileGrid::point(first_col, first_row);
  const double reach = clearance_ + 1e-6;  // far above the rounding error of what follows
  const auto from = [](double x, int end) { return static_cast<int>(std::clamp(std::floor(x), -1.0, 1.0 + end)); };
  const auto to = [](double x, int end) { return static_cast<int>(std::clamp(std::ceil(x), -2.0, 0.0 + end)); };
  const Box box = box_of(wall);
  const int last_row = to(box.max.y + reach - origin.y, plane.height());
  for (int row = from(box.min.y - reach - origin.y - 1, plane.height()); row <= last_row; ++row) {
    const double low = origin.y + row - reach;
    const BandInterval x = x_range_in_band(wall, low, low + 1 + 2 * reach);
    const int last_col = to(x.high + reach - origin.x, plane.width());
    for (int col = from(x.low - reach - origin.x - 1, plane.width()); col <= last_col; ++col) {
      std::uint8_t* at = plane.at(col, row);
      if (*at == 0) continue;
      const unsigned blocked = blocked_bits(wall, TileGrid::point(first_col + col, first_row + row), *at, clearance_);
      clear_bits(*at, blocked);
      if ((blocked & plane_bit::right) != 0) clear_bits(at[1], plane_bit::left);
      if ((blocked & plane_bit::up) != 0) clear_bits(at[plane.stride()], plane_bit::down);
    }
  }
}

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
    : offset_{1, plane.stride(), -1, -plane.stride()},
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
  for (unsigned open = *at & edges; open != 0 && (open & (open - 1)) == 0 && (*at & kept) == 0; open = *at & edges) {
    const unsigned direction = first_direction(open);
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
      bits |= plane_bit::key;
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
    if ((bits & plane_bit::key) != 0) {
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
