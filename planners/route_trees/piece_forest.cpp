// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_trees/piece_forest.hpp"

#include <bit>
#include <utility>

#include "parallel/chunks.hpp"
#include "parallel/scan.hpp"

namespace warren {
namespace {

constexpr std::size_t tile_grain = 64;

class PieceBuilder {
 public:
  PieceBuilder(const LatticePlaces& places, CellMarks marks, const Execution& execution)
      : places_(places), marks_(marks), execution_(execution) {}

  PieceArrays build() {
    find_exits();
    const std::size_t count = arrays_.first_exit[places_.tile_count()];
    execution_.reserve(count * 14 * sizeof(std::uint32_t));
    follow_exits(count);
    sort_children_first();
    choose_heavy();
    number_paths();
    return renumbered();
  }

 private:
  /// By exit, in the order of tiles.
  struct Exit {
    PieceId parent;
    std::uint32_t length;  // steps from its cell to the parent's exit, or to the core
    LatticePlace door;
  };

  template <class Visit>
  void for_each_poll(std::size_t n, const Visit& visit) const {
    for (std::size_t i = 0; i < n; ++i) {
      if (i % (1U << 16) == 0) execution_.check();
      visit(i);
    }
  }
  void find_exits();
  void follow_exits(std::size_t count);
  void sort_children_first();
  void choose_heavy();
  void number_paths();
  PieceArrays renumbered();

  const LatticePlaces& places_;
  const CellMarks marks_;
  const Execution& execution_;
  PieceArrays arrays_;
  RawVector<Exit> exits_;
  RawVector<std::uint32_t> order_;  // children before parents
  RawVector<PieceId> heavy_;        // largest child
  RawVector<PieceId> number_;
  RawVector<PieceId> head_;  // by number
};

void PieceBuilder::find_exits() {
  const std::size_t tiles = places_.tile_count();
  RawVector<std::uint64_t> exits(4 * tiles);
  RawVector<std::uint32_t> first(tiles + 1);
  first[tiles] = 0;
  for_chunks(tiles, tile_grain, execution_, [&](Range r) {
    for (std::size_t tile = r.first; tile < r.last; ++tile) {
      first[tile] = 0;
      for (unsigned d = 0; d < 4; ++d) {
        const std::uint64_t word = exits_of(marks_, static_cast<std::uint32_t>(tile), d);
        exits[4 * tile + d] = word;
        first[tile] += static_cast<std::uint32_t>(std::popcount(word));
      }
    }
  });
  exclusive_scan(first, execution_);
  arrays_.exits = ArrayOrView<std::uint64_t>(std::move(exits));
  arrays_.first_exit = ArrayOrView<std::uint32_t>(std::move(first));
}

void PieceBuilder::follow_exits(std::size_t count) {
  exits_.resize(count);
  RawVector<PieceId> same(count);
  for (std::size_t i = 0; i < count; ++i) same[i] = static_cast<PieceId>(i);
  arrays_.piece = ArrayOrView<PieceId>(std::move(same));
  const PieceForest forest(places_, marks_, arrays_);
  for_chunks(places_.tile_count(), tile_grain, execution_, [&](Range r) {
    std::uint32_t exit = arrays_.first_exit[r.first];
    for (std::size_t side = 4 * r.first; side < 4 * r.last; ++side) {
      for (std::uint64_t left = arrays_.exits[side]; left != 0; left &= left - 1) {
        const auto along = static_cast<LatticePlace>(std::countr_zero(left));
        const auto direction = static_cast<unsigned>(side % 4);
        constexpr unsigned last = LatticePlaces::side - 1;
        const std::array<LatticePlace, 4> cell{along * LatticePlaces::side + last, last * LatticePlaces::side + along,
                                               along * LatticePlaces::side, along};
        const LatticePlace at = static_cast<LatticePlace>(side / 4) * LatticePlaces::tile_places + cell[direction];
        const LatticePlace door = places_.step(at, direction);
        const Climb up = forest.climb(door);
        exits_[exit++] = {up.at_core ? no_piece : forest.piece_at(up.last), 1 + up.steps, door};
      }
    }
  });
}

void PieceBuilder::sort_children_first() {
  const std::size_t count = exits_.size();
  RawVector<std::uint32_t> children(count);
  for_each_poll(count, [&](std::size_t i) { children[i] = 0; });
  for_each_poll(count, [&](std::size_t i) {
    if (exits_[i].parent != no_piece) ++children[exits_[i].parent];
  });
  order_.resize(count);
  std::size_t last = 0;
  for_each_poll(count, [&](std::size_t i) {
    if (children[i] == 0) order_[last++] = static_cast<std::uint32_t>(i);
  });
  for_each_poll(count, [&](std::size_t i) {
    const PieceId parent = exits_[order_[i]].parent;
    if (parent != no_piece && --children[parent] == 0) order_[last++] = parent;
  });
}

void PieceBuilder::choose_heavy() {
  const std::size_t count = exits_.size();
  RawVector<std::uint32_t> size(count);
  RawVector<std::uint32_t> largest(count);
  heavy_.resize(count);
  for_each_poll(count, [&](std::size_t i) {
    size[i] = 1;
    largest[i] = 0;
    heavy_[i] = no_piece;
  });
  for_each_poll(count, [&](std::size_t i) {
    const PieceId child = order_[i];
    const PieceId parent = exits_[child].parent;
    if (parent == no_piece) return;
    size[parent] += size[child];
    if (size[child] < largest[parent] || (size[child] == largest[parent] && child > heavy_[parent])) return;
    largest[parent] = size[child];
    heavy_[parent] = child;
  });
}

/// From the roots down: whoever is no heavy child heads a path, numbered as a whole.
void PieceBuilder::number_paths() {
  const std::size_t count = exits_.size();
  number_.resize(count);
  head_.resize(count);
  PieceId next = 0;
  for_each_poll(count, [&](std::size_t i) {
    const PieceId top = order_[count - 1 - i];
    const PieceId parent = exits_[top].parent;
    if (parent != no_piece && heavy_[parent] == top) return;
    const PieceId head = next;
    for (PieceId p = top; p != no_piece; p = heavy_[p]) {
      head_[next] = head;
      number_[p] = next++;
    }
  });
}

PieceArrays PieceBuilder::renumbered() {
  const std::size_t count = exits_.size();
  RawVector<PieceId> parent(count);
  RawVector<std::uint32_t> depth(count);
  RawVector<LatticePlace> door(count);
  for_each_poll(count, [&](std::size_t i) {
    const Exit& exit = exits_[order_[count - 1 - i]];
    const PieceId here = number_[order_[count - 1 - i]];
    parent[here] = exit.parent == no_piece ? no_piece : number_[exit.parent];
    depth[here] = exit.length + (exit.parent == no_piece ? 0 : depth[parent[here]]);
    door[here] = exit.door;
  });
  arrays_.piece = ArrayOrView<PieceId>(std::move(number_));
  arrays_.head = ArrayOrView<PieceId>(std::move(head_));
  arrays_.parent = ArrayOrView<PieceId>(std::move(parent));
  arrays_.depth = ArrayOrView<std::uint32_t>(std::move(depth));
  arrays_.door = ArrayOrView<LatticePlace>(std::move(door));
  return std::move(arrays_);
}

}  // namespace

std::uint64_t exits_of(CellMarks marks, std::uint32_t tile, unsigned direction) {
  constexpr unsigned last = LatticePlaces::side - 1;
  const std::array<LatticePlace, 4> corner{last, last * LatticePlaces::side, 0, 0};
  const LatticePlace along = (direction & 1U) == 0 ? LatticePlaces::side : 1;
  LatticePlace at = tile * LatticePlaces::tile_places + corner[direction];
  std::uint64_t exits = 0;
  for (unsigned i = 0; i <= last; ++i, at += along) {
    exits |= std::uint64_t{!marks.is_core(at) && marks.direction(at) == direction} << i;
  }
  return exits;
}

Climb PieceForest::climb(LatticePlace from) const {
  Climb climb{from, 0, false};
  while (!marks_.is_core(climb.last) && climb.steps < LatticePlaces::tile_places) {
    const unsigned direction = marks_.direction(climb.last);
    if (LatticePlaces::leaves_tile(climb.last, direction)) return climb;
    climb.last = places_.step_inside(climb.last, direction);
    ++climb.steps;
  }
  climb.at_core = true;
  return climb;
}

PieceId PieceForest::piece_at(LatticePlace exit) const {
  const std::size_t tile = LatticePlaces::tile_of(exit);
  const unsigned direction = marks_.direction(exit);
  std::uint32_t number = arrays_.first_exit[tile];
  for (unsigned d = 0; d < direction; ++d) {
    number += static_cast<std::uint32_t>(std::popcount(arrays_.exits[4 * tile + d]));
  }
  const std::uint64_t below = (std::uint64_t{1} << LatticePlaces::along_side(exit, direction)) - 1;
  number += static_cast<std::uint32_t>(std::popcount(arrays_.exits[4 * tile + direction] & below));
  return arrays_.piece[number];
}

PieceArrays build_pieces(const LatticePlaces& places, CellMarks marks, const Execution& execution) {
  return PieceBuilder(places, marks, execution).build();
}

}  // namespace warren
