// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/hop_walk.hpp"

#include <bit>

#include "core/base/error.hpp"

namespace warren {
namespace {

constexpr std::size_t side_by_side = 4;
constexpr std::size_t ahead = 4;  // hops whose first tile is asked for before their turn

[[noreturn]] void refuse_hop() { throw InputError("route index", "its fronts contradict its marks: build it again"); }

class HopWalk {
 public:
  explicit HopWalk(const RouteIndex& index)
      : index_(index),
        marks_(index.marks()),
        next_{1, index.places().size().cols, ~CellId{0}, ~index.places().size().cols + 1} {}

  void begin(const Hop& hop) {
    hop_ = hop;
    left_ = hop.length;
    came_from_ = 0;
    cell_ = index_.places().cell_of(hop.from);
    to_ = hop.first;
    *to_ = cell_;
    stand_at(hop.from);
  }
  /// Asks the memory for what a walk looks at soon.
  void prefetch(LatticePlace p) const { marks_.prefetch_tile(LatticePlaces::tile_of(p)); }
  bool goes() const { return left_ > 0; }
  void step() {
    unsigned onwards = exits() & ~came_from_;
    if ((one_exit >> onwards & 1U) == 0) [[unlikely]]
      onwards = choice(onwards);
    const auto way = static_cast<unsigned>(std::countr_zero(onwards));
    came_from_ = 1U << (way ^ 2U);
    cell_ += next_[way];
    to_ += hop_.direction;
    *to_ = cell_;
    const std::uint32_t next = at_ + motion[way];
    if ((next & guards) != 0) [[unlikely]]
      cross(way);
    else
      at_ = next;
    if (--left_ == 0 && place() != hop_.to) refuse_hop();
  }

 private:
  // Column in bits 0 to 5, row in bits 7 to 12, as in tile_climb.hpp.
  static constexpr std::uint32_t col_bits = 63;
  static constexpr unsigned row_shift = 7;
  static constexpr std::uint32_t guards = ~(col_bits | col_bits << row_shift);
  static constexpr std::array<std::uint32_t, 4> motion{1, 1U << row_shift, ~std::uint32_t{0}, ~(1U << row_shift) + 1};
  static constexpr unsigned one_exit = 1U << 1 | 1U << 2 | 1U << 4 | 1U << 8;

  /// Chains that leave the cell: its own marks, and those of the neighbours to the left and below.
  unsigned exits() const {
    const std::uint32_t col = at_ & col_bits;
    const std::uint64_t* const row = words_ + std::size_t{at_ >> row_shift} * mark_word::count;
    const unsigned own = static_cast<unsigned>(row[mark_word::low] >> col & 1U) |
                         static_cast<unsigned>(row[mark_word::high] >> col & 1U) << 1;
    if (col == 0 || at_ <= col_bits) [[unlikely]]
      return own | exits_over_the_rim();
    const std::uint64_t* const below = row - mark_word::count;
    return own | static_cast<unsigned>((row[mark_word::low] & row[mark_word::core]) >> (col - 1) & 1U) << 2 |
           static_cast<unsigned>((below[mark_word::high] & below[mark_word::core]) >> col & 1U) << 3;
  }
  unsigned exits_over_the_rim() const {
    const LatticePlace at = place();
    const LatticePlaces& places = index_.places();
    return static_cast<unsigned>(places.col(at) > 0 && goes_on(places.step(at, 2), mark_word::low)) << 2 |
           static_cast<unsigned>(places.row(at) > 0 && goes_on(places.step(at, 3), mark_word::high)) << 3;
  }
  bool goes_on(LatticePlace p, std::size_t word) const {
    index_.look_at_tile(p);
    const std::uint64_t* const row = marks_.tile(0) + std::size_t{p / 64} * mark_word::count;
    return (row[word] & row[mark_word::core] & std::uint64_t{1} << p % 64) != 0;
  }
  unsigned choice(unsigned onwards) {
    if (onwards == 0) refuse_hop();
    return next_turn(onwards, hop_.turns);
  }
  void cross(unsigned way) {
    const LatticePlace next = index_.places().step(place(), way);
    if (next >= index_.places().place_count()) refuse_hop();
    prefetch(next);
    stand_at(next);
  }
  void stand_at(LatticePlace p) {
    tile_ = LatticePlaces::tile_of(p);
    index_.look_at_tile(p);
    words_ = marks_.tile(tile_);
    const std::uint32_t in_tile = p % LatticePlaces::tile_places;
    at_ = in_tile >> 6U << row_shift | (in_tile & col_bits);
  }
  LatticePlace place() const {
    return tile_ * LatticePlaces::tile_places + ((at_ >> row_shift) << 6U | (at_ & col_bits));
  }

  const RouteIndex& index_;
  const CellMarks marks_;
  const std::array<CellId, 4> next_;  // what a motion adds to a cell, modulo 2^32
  Hop hop_{};
  std::uint32_t left_ = 0;
  unsigned came_from_ = 0;  // the motion that leads back, as a bit
  CellId cell_ = 0;
  CellId* to_ = nullptr;
  std::uint32_t tile_ = 0;
  std::uint32_t at_ = 0;  // in it
  const std::uint64_t* words_ = nullptr;
};

}  // namespace

void write_hops(const RouteIndex& index, std::span<const Hop> hops) {
  std::array<HopWalk, side_by_side> walks{HopWalk(index), HopWalk(index), HopWalk(index), HopWalk(index)};
  std::size_t next = 0;
  for (bool goes = true; goes;) {
    goes = false;
    for (HopWalk& walk : walks) {
      if (walk.goes()) {
        walk.step();
      } else if (next < hops.size()) {
        walk.begin(hops[next++]);
        if (next + ahead < hops.size()) walk.prefetch(hops[next + ahead].from);
      } else {
        continue;
      }
      goes = true;
    }
  }
}

}  // namespace warren
