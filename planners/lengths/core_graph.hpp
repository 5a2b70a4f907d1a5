// SPDX-License-Identifier: BSD-3-Clause
// The core of a lattice roadmap as a planar map: junctions, the cells where three core edges or more meet, joined by
// chains of cells without choice. A few more cells are junctions, those of every 16th column in every 16th row, so that
// chains are short and few rings have no junction at all. A junction has four slots, one a direction; slot d of
// junction j is half-edge 4 j + d, and `twin` is the half-edge at the other end of its chain: chains and the order of
// slots around a junction are all that cutting the plane needs. A chain back to its own junction, and the longer one of
// two between the same junctions, is on no shortest path between junctions and is left out.
// What planners/graph/roadmap_search.hpp makes of a graph lacks the two things that lengths need: which way each cell
// of a tree was taken off, and the order of slots. Cost: each chain is walked from both ends, O(core cells); 32 bytes a
// junction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

// The motions of a lattice roadmap as plain bits: two a cell, one for its motion to the right, one for that upwards. A
// row is whole 64-bit words, so that 64 cells are looked at at once; bits of motions that leave the lattice are 0. A
// blocked milestone is a cell without passages.

/// A constant array of plain elements that is either owned or a view of somebody else's memory, say of a mapped file:
/// what reads it can't tell. Moves keep the elements where they are; copies aren't made by accident. A view must not
/// outlive what it looks at.
template <class T>
class ArrayOrView {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  ArrayOrView() = default;
  explicit ArrayOrView(RawVector<T> elements) : own_(std::move(elements)), all_(own_) {}
  explicit ArrayOrView(std::span<const T> elements, FirstLook first_look = {})
      : all_(elements), first_look_(first_look) {}
  /// What was moved from may be assigned to or destroyed, nothing else.
  ArrayOrView(ArrayOrView&&) noexcept = default;
  ArrayOrView& operator=(ArrayOrView&&) noexcept = default;
  ~ArrayOrView() = default;

  std::size_t size() const { return all_.size(); }
  bool empty() const { return all_.empty(); }
  const T* data() const { return all_.data(); }
  const T& operator[](std::size_t i) const { return all_[i]; }
  std::span<const T> span() const { return all_; }
  /// Whoever reads a view of a large file calls it before it reads these elements, which must be there. Throws what the
  /// view's owner says of damage.
  void look(std::size_t first, std::size_t count) const { first_look_.ensure(first * sizeof(T), count * sizeof(T)); }

 private:
  RawVector<T> own_;
  std::span<const T> all_;
  FirstLook first_look_;
};

/// Number of a cell: row * cols + col, both from 0.
using CellId = std::uint32_t;

/// The two planes of bits, as they lie in memory: bit (col % 64) of word row * words_a_row + col / 64.
struct PassageWords {
  RawVector<std::uint64_t> right;
  RawVector<std::uint64_t> up;
};

/// One bit of each of 64 bytes, as a word: the first byte's is the lowest.
inline std::uint64_t gathered_bits(const std::uint8_t* bytes, unsigned bit) {
  std::uint64_t word = 0;
  for (unsigned i = 0; i < 64; i += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, bytes + i, 8);
    word |= ((eight >> bit & 0x0101010101010101U) * 0x0102040810204080U >> 56) << i;
  }
  return word;
}

/// Immutable; owns its words or looks at somebody's. Any number of threads may read.
class LatticePassages {
 public:
  /// Both planes have words_a_row(cols) * rows words. Throws InputError for another number of them, for sizes outside
  /// check_size(), and for a bit of a motion that leaves the lattice. Words that are looked at must stay.
  LatticePassages(LatticeSize size, ArrayOrView<std::uint64_t> right, ArrayOrView<std::uint64_t> up);
  LatticePassages(LatticeSize size, PassageWords words)
      : LatticePassages(size, ArrayOrView<std::uint64_t>(std::move(words.right)),
                        ArrayOrView<std::uint64_t>(std::move(words.up))) {}

  /// Throws InputError unless rows, cols >= 1 and the lattice, filled up to whole tiles of 64 x 64, has less than 2^32
  /// cells.
  static void check_size(LatticeSize size);
  static std::size_t words_a_row(std::uint32_t cols) { return (std::size_t{cols} + 63) / 64; }
  /// No passage at all. Asks `execution` for the memory.
  static PassageWords closed(LatticeSize size, const Execution& execution);

  LatticeSize size() const { return size_; }
  std::uint64_t cell_count() const { return std::uint64_t{size_.rows} * size_.cols; }
  std::span<const std::uint64_t> right_words() const { return right_.span(); }
  std::span<const std::uint64_t> up_words() const { return up_.span(); }

  /// Of cells col .. col + 63, col a multiple of 64: their motions in direction 0 right, 1 up, 2 left, 3 down, as bits.
  std::array<std::uint64_t, 4> open_words(std::uint32_t col, std::uint32_t row) const;
  /// A bit for each free motion of a cell: 1 right, 2 up, 4 left, 8 down.
  unsigned open_at(std::uint32_t col, std::uint32_t row) const {
    const std::size_t word = row * stride_ + col / 64;
    const unsigned bit = col % 64;
    unsigned open = bit_of(right_, word, bit) | bit_of(up_, word, bit) << 1;
    if (col > 0) open |= bit_of(right_, row * stride_ + (col - 1) / 64, (col - 1) % 64) << 2;
    if (row > 0) open |= bit_of(up_, word - stride_, bit) << 3;
    return open;
  }
  /// The cells that a free motion leads to, in the order of the directions.
  template <class Visit>
  void for_each_neighbour(CellId cell, const Visit& visit) const {
    const unsigned open = open_at(cell % size_.cols, cell / size_.cols);
    if ((open & 1U) != 0) visit(cell + 1);
    if ((open & 2U) != 0) visit(cell + size_.cols);
    if ((open & 4U) != 0) visit(cell - 1);
    if ((open & 8U) != 0) visit(cell - size_.cols);
  }

 private:
  static unsigned bit_of(const ArrayOrView<std::uint64_t>& plane, std::size_t word, unsigned bit) {
    return static_cast<unsigned>(plane[word] >> bit) & 1U;
  }

  LatticeSize size_;
  std::size_t stride_;
  ArrayOrView<std::uint64_t> right_;
  ArrayOrView<std::uint64_t> up_;
};

/// A world of walls and the lattice in it: point (col, row), both from 0, stands at (col + 1, row + 1). Refers to the
/// walls.
struct WalledLattice {
  const WallSet& walls;
  std::span<const Segment> more_walls;  ///< a few beside the set: the bounds
  std::optional<Box> box;               ///< the reference point stays in it; if none, in that of the walls
  double clearance = 0.0;               ///< 0 to 8; planned with r (1 + 1e-9), as MazeWorld does
  LatticeSize lattice;
};

/// The passages of the lattice roadmap among walls: bit for bit the edges that the tiled planner and the plain one with
/// the lattice sampler use. The tiles of planners/mazes make them: walls are filed by tile, each tile's plane of bytes
/// loses what they block, and its bytes are packed to bits. Cost: that of the tiled planner's first two stages, about 5
/// ns of CPU a cell in a maze, and 8 bytes a wall for the time of it. Throws Stopped, and InputError for a clearance or
/// a lattice out of range.
LatticePassages wall_passages(const WalledLattice& world, const Execution& execution);

// Three bits a cell, laid out so that a tile of 64 x 64 cells is 24 lines of cache: is the cell in the core, and if it
// isn't, which way its root is; if it is, where the chains of the reduced core that it lies on go on: to the right,
// upwards. To the left and downwards the neighbours know.

using LatticePlace = std::uint32_t;

/// Where a cell lies in the index: cells are numbered tile by tile, 64 x 64 cells a tile, row by row in it, so that
/// what is near in the plane is near in memory. A place is tile * 4096 + row in the tile * 64 + column in the tile; the
/// lattice is filled up to whole tiles with cells that have no passages. Directions are 0 right, 1 up, 2 left, 3 down;
/// the opposite of d is d ^ 2.
class LatticePlaces {
 public:
  static constexpr unsigned side = 64;
  static constexpr unsigned tile_places = side * side;

  explicit LatticePlaces(LatticeSize size)
      : size_(size),
        tile_cols_(static_cast<std::uint32_t>(LatticePassages::words_a_row(size.cols))),
        tile_rows_(static_cast<std::uint32_t>(LatticePassages::words_a_row(size.rows))),
        inner_{1, side, ~LatticePlace{0}, ~LatticePlace{side} + 1},
        over_{tile_places - (side - 1), tile_cols_ * tile_places - (side - 1) * side,
              ~LatticePlace{tile_places - (side - 1)} + 1,
              ~LatticePlace{tile_cols_ * tile_places - (side - 1) * side} + 1} {}

  LatticeSize size() const { return size_; }
  std::uint32_t tile_cols() const { return tile_cols_; }
  std::uint32_t tile_rows() const { return tile_rows_; }
  std::size_t tile_count() const { return std::size_t{tile_cols_} * tile_rows_; }
  std::size_t place_count() const { return tile_count() * tile_places; }

  LatticePlace place(std::uint32_t col, std::uint32_t row) const {
    return (row / side * tile_cols_ + col / side) * tile_places + row % side * side + col % side;
  }
  LatticePlace place_of(CellId cell) const { return place(cell % size_.cols, cell / size_.cols); }
  std::uint32_t col(LatticePlace p) const { return tile_of(p) % tile_cols_ * side + p % side; }
  std::uint32_t row(LatticePlace p) const { return tile_of(p) / tile_cols_ * side + p / side % side; }
  CellId cell_of(LatticePlace p) const { return row(p) * size_.cols + col(p); }

  static std::uint32_t tile_of(LatticePlace p) { return p / tile_places; }
  /// Does the motion lead to another tile?
  static bool leaves_tile(LatticePlace p, unsigned direction) {
    const unsigned along = (direction & 1U) == 0 ? p % side : p / side % side;
    return along == (direction < 2 ? side - 1 : 0);
  }
  /// How far along its tile's side a cell is that a motion in this direction leaves.
  static unsigned along_side(LatticePlace p, unsigned direction) {
    return (direction & 1U) == 0 ? p / side % side : p % side;
  }
  /// The cell so far along the side of a tile that a motion in this direction leaves.
  static LatticePlace on_side(std::uint32_t tile, unsigned direction, unsigned along) {
    constexpr std::array<LatticePlace, 4> corner{side - 1, (side - 1) * side, 0, 0};
    return tile * tile_places + corner[direction] + along * ((direction & 1U) == 0 ? side : 1U);
  }
  /// The neighbour, which must be in the lattice.
  LatticePlace step(LatticePlace p, unsigned direction) const {
    return p + (leaves_tile(p, direction) ? over_[direction] : inner_[direction]);
  }

 private:
  LatticeSize size_;
  std::uint32_t tile_cols_;
  std::uint32_t tile_rows_;
  std::array<LatticePlace, 4> inner_;  // what a motion adds to a place, modulo 2^32: inside a tile
  std::array<LatticePlace, 4> over_;   // and over its border
};

/// Words of row r of the lattice of tiles (a tile has 64): three each.
namespace mark_word {
inline constexpr std::size_t low = 0;   ///< lower bit of the direction; in the core: a chain goes on to the right
inline constexpr std::size_t high = 1;  ///< upper bit of the direction; in the core: a chain goes on upwards
inline constexpr std::size_t core = 2;
inline constexpr std::size_t count = 3;

/// Both bits that a cell has beside `core`, of its row's words.
inline unsigned low_and_high(const std::uint64_t* row, unsigned col) {
  return static_cast<unsigned>(row[low] >> col & 1U) | static_cast<unsigned>(row[high] >> col & 1U) << 1;
}
}  // namespace mark_word

/// Looks at the words; any number of threads may.
class CellMarks {
 public:
  explicit CellMarks(const std::uint64_t* words) : words_(words) {}

  bool is_core(LatticePlace p) const { return (row_of(p)[mark_word::core] >> p % 64 & 1U) != 0; }
  /// Of a cell outside the core.
  unsigned direction(LatticePlace p) const { return mark_word::low_and_high(row_of(p), p % 64); }

  /// The words of a tile, row by row.
  const std::uint64_t* tile(std::uint32_t number) const {
    return words_ + std::size_t{number} * LatticePlaces::side * mark_word::count;
  }
  void prefetch_tile(std::uint32_t number) const {
    constexpr std::size_t line = 8;  // words
    const std::uint64_t* const words = tile(number);
    for (std::size_t i = 0; i < LatticePlaces::side * mark_word::count; i += line) __builtin_prefetch(words + i);
  }

 private:
  const std::uint64_t* row_of(LatticePlace p) const { return words_ + std::size_t{p / 64} * mark_word::count; }

  const std::uint64_t* words_;
};

/// Cells of a tile as walks hold them: column in bits 0 to 5, row in bits 7 to 12. So a motion over the border sets a
/// bit between or above.
struct WalkedCells {
  static constexpr std::uint32_t col_bits = 63;
  static constexpr unsigned row_shift = 7;
  static constexpr std::uint32_t guards = ~(col_bits | col_bits << row_shift);
  static_assert(LatticePlaces::side == col_bits + 1);

  static std::uint32_t at(LatticePlace p) {
    const std::uint32_t in_tile = p % LatticePlaces::tile_places;
    return in_tile >> 6U << row_shift | (in_tile & col_bits);
  }
  static LatticePlace in_tile(std::uint32_t at) { return (at >> row_shift) << 6U | (at & col_bits); }
};

/// A climb towards the core, step by step, within one tile. A step waits for the marks that the one before it led to,
/// some fifteen cycles, and for nothing else: no branch depends on where the way turns. Looks at the marks of one tile.
class TileClimb : WalkedCells {
 public:
  TileClimb(CellMarks marks, LatticePlace from)
      : first_(from - from % LatticePlaces::tile_places),
        words_(marks.tile(LatticePlaces::tile_of(from))),
        at_(at(from)) {}

  /// False where the way ends: at the core, or where it would leave the tile.
  bool step() {
    if (at_core()) return false;
    const std::uint32_t next = at_ + motion();
    if ((next & guards) != 0) return false;
    at_ = next;
    return true;
  }
  LatticePlace place() const { return first_ + in_tile(at_); }
  bool at_core() const { return mark(mark_word::core) != 0; }

 private:
  std::uint32_t mark(std::size_t word) const {
    const std::uint64_t* const row = words_ + std::size_t{at_ >> row_shift} * mark_word::count;
    return static_cast<std::uint32_t>(row[word] >> (at_ & col_bits)) & 1U;
  }
  /// Right 1, up 128, left -1, down -128.
  std::uint32_t motion() const { return (1U - 2U * mark(mark_word::high)) << (row_shift * mark(mark_word::low)); }

  LatticePlace first_;
  const std::uint64_t* words_;
  std::uint32_t at_;
};

/// A cell's byte: bits 0 to 3 its core edges; `peeled` if it is no cell of the core, with its direction in bits 4
/// and 5, which are 0 in the core.
namespace peel_bit {
inline constexpr std::uint8_t edges = 15;
inline constexpr unsigned direction_shift = 4;
inline constexpr std::uint8_t peeled = 64;
}  // namespace peel_bit

/// What of a lattice roadmap is tree, and which way its root is. A dead end is taken off with its only edge and points
/// along it; what becomes a dead end by that follows, until none is left. What remains is the 2-core, where every cell
/// has two core edges or more, and one cell of each component that is a tree: its root. So each cell that is taken off
/// points towards the core, or to the root of its tree.
///
/// Each tile of 64 x 64 cells is peeled by itself, following each dead end inwards; then squares of 8 x 8 tiles,
/// squares of 8 x 8 of these, and so on: each takes up the dead ends that point over the borders inside it. Squares of
/// a size share nothing, and which cell becomes a tree's root follows from the order in a square, so the bytes are the
/// same for any thread count. Cost: one byte a cell, O(cells) time; few cells are left for the large squares. A byte a
/// place. Throws Stopped.
RawVector<std::uint8_t> peel(const LatticePassages& passages, const LatticePlaces& places, const Execution& execution);

using JunctionId = std::uint32_t;
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge no_half_edge = ~HalfEdge{0};

struct CoreGraph {
  RawVector<LatticePlace> place;    ///< of a junction, ascending
  RawVector<HalfEdge> twin;         ///< of a half-edge, no_half_edge where the slot is empty
  RawVector<std::uint32_t> length;  ///< of its chain, in steps
  std::uint64_t core_cells = 0;

  std::size_t size() const { return place.size(); }
};

/// A bit for each slot of a junction that isn't empty.
inline std::uint8_t slots_of(const CoreGraph& graph, JunctionId v) {
  unsigned slots = 0;
  for (unsigned s = 0; s < 4; ++s) slots |= graph.twin[4 * v + s] != no_half_edge ? 1U << s : 0U;
  return static_cast<std::uint8_t>(slots);
}

/// How many of four directions there are: processors without an instruction to count bits call a function.
constexpr unsigned exit_count(unsigned exits) { return 0x4332322132212110U >> 4 * exits & 15U; }

/// Is the place on the grid of posts, every 16th column in every 16th row?
constexpr bool is_post(LatticePlace p) { return (p & (15U | 15U * LatticePlaces::side)) == 0; }

/// peeled: what peel() gave. Throws Stopped, and InputError where there are 2^30 junctions or more.
CoreGraph core_graph(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places, const Execution& execution);

/// Junctions without choice leave the core's map: where the longer one of two parallel chains, or a chain back to its
/// own junction, has been left out, a junction may have two chains left, which become one, or one, which goes with it;
/// that again may make chains parallel. Lengths between junctions that stay are the same. Cells of what left are not
/// lost: a search from them walks the lattice's own cells to the junctions that stay. The cells of the chains that stay
/// are told where these go on, so that whoever follows one meets a choice at junctions that stay and nowhere else.
/// Junctions on the grid of posts stay, so that these searches remain short. In mazes with 1 % loops more than half of
/// the junctions leave, with 10 % a fifth; cuts get shorter by as much. Cost: serial, some tens of ns a junction.
///
/// peeled: as core_graph() took it. Junctions that become part of a chain have its two core edges left there, and each
/// cell on a chain that stays gets its peel_bit::direction bits: does the chain go on to the right, and upwards; a
/// junction has those of all its chains. Throws Stopped; the graph is then of no more use.
void reduce_core(CoreGraph& graph, const LatticePlaces& places, RawVector<std::uint8_t>& peeled,
                 const Execution& execution);

/// The words for peeled bytes, after reduce_core(). Throws Stopped.
RawVector<std::uint64_t> mark_words(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places,
                                    const Execution& execution);

// Nested dissection of the core: the map is cut in two by few junctions (planners/lengths/dissection.cpp), the
// parts again, until they have no more than a leaf's junctions. Nodes are the cuts and the leaves, listed children
// first; a node's junctions have chains to its own, to those of its descendants and of its ancestors only.
//
// Large regions are cut one beside the other, the small ones whole by one thread each. Which is large follows from the
// number of junctions, and all parts are joined in their order, so the result is the same for any thread count.
// Cost: O(junctions log junctions); about 60 bytes a junction of the regions being cut.

struct DissectionNode {
  std::uint32_t members;   ///< how many of the junctions are its own
  std::uint32_t children;  ///< nodes right below it, listed before it; none: a leaf, what is left between cuts
};

struct Dissection {
  RawVector<DissectionNode> node;  ///< children before parents
  RawVector<JunctionId> member;    ///< node by node, ascending in each
};

/// The most junctions of a leaf: a way through so many is told by less than 63 bits
/// (planners/lengths/separator_fronts.hpp).
inline constexpr std::size_t most_leaf_junctions = 36;

/// leaf: 1 .. most_leaf_junctions. Throws Stopped.
Dissection dissect(const CoreGraph& graph, std::size_t leaf, const Execution& execution);

}  // namespace warren
