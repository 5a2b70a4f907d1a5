// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/piece_forest.hpp"

#include <bit>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "parallel/sort.hpp"

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
  RawVector<TreePiece> pieces(count);
  for_each_poll(count, [&](std::size_t i) {  // from the roots down
    const Exit& exit = exits_[order_[count - 1 - i]];
    const PieceId here = number_[order_[count - 1 - i]];
    const PieceId parent = exit.parent == no_piece ? no_piece : number_[exit.parent];
    const std::uint32_t depth = exit.length + (parent == no_piece ? 0 : pieces[parent].depth);
    pieces[here] = {head_[here], head_[here] == here ? parent : pieces[parent].up, depth, exit.door};
  });
  arrays_.piece = ArrayOrView<PieceId>(std::move(number_));
  arrays_.pieces = ArrayOrView<TreePiece>(std::move(pieces));
  return std::move(arrays_);
}

/// A way that turned in a circle is said to have come to the core.
Climb result_of(const TileClimb& climb, std::uint32_t steps) {
  return {climb.place(), steps, climb.at_core() || steps == LatticePlaces::tile_places};
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
  TileClimb climb(marks_, from);
  std::uint32_t steps = 0;
  while (steps < LatticePlaces::tile_places && climb.step()) ++steps;
  return result_of(climb, steps);
}

std::array<Climb, 2> PieceForest::climb_both(LatticePlace a, LatticePlace b) const {
  TileClimb one(marks_, a);
  TileClimb other(marks_, b);
  std::uint32_t both = 0;
  bool one_goes = true;
  bool other_goes = true;
  for (;; ++both) {
    one_goes = both < LatticePlaces::tile_places && one.step();
    other_goes = both < LatticePlaces::tile_places && other.step();
    if (!one_goes || !other_goes) break;
  }
  std::uint32_t one_steps = both + (one_goes ? 1 : 0);
  std::uint32_t other_steps = both + (other_goes ? 1 : 0);
  while (one_goes && (one_goes = one_steps < LatticePlaces::tile_places && one.step())) ++one_steps;
  while (other_goes && (other_goes = other_steps < LatticePlaces::tile_places && other.step())) ++other_steps;
  return {result_of(one, one_steps), result_of(other, other_steps)};
}

void PieceForest::prefetch(LatticePlace from) const {
  const std::uint32_t tile = LatticePlaces::tile_of(from);
  marks_.prefetch_tile(tile);
  __builtin_prefetch(arrays_.exits.data() + 4 * std::size_t{tile});
  __builtin_prefetch(arrays_.first_exit.data() + tile);
}

const TreePiece& PieceForest::piece(PieceId p) const {
  arrays_.pieces.look(p, 1);
  const TreePiece& piece = arrays_.pieces[p];
  const bool leads_up = piece.head <= p && (piece.up == no_piece || piece.up < piece.head);
  if (leads_up && piece.door < places_.place_count()) return piece;
  throw InputError("route index", "its pieces contradict each other: build it again");
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
  if (number < arrays_.piece.size()) {
    arrays_.piece.look(number, 1);
    const PieceId piece = arrays_.piece[number];
    if (piece < arrays_.piece.size()) return piece;
  }
  throw InputError("route index", "its exits contradict each other: build it again");
}

PieceArrays build_pieces(const LatticePlaces& places, CellMarks marks, const Execution& execution) {
  return PieceBuilder(places, marks, execution).build();
}

}  // namespace warren
