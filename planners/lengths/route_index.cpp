// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/route_index.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/page_pool.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"
#include "parallel/sort.hpp"
#include "planners/lengths/core_graph.hpp"

namespace warren {
namespace {

constexpr std::size_t tile_grain = 64;

/// Which cells along a side of a tile point over it.
std::uint64_t exits_of(CellMarks marks, std::uint32_t tile, unsigned direction) {
  std::uint64_t exits = 0;
  for (unsigned along = 0; along < LatticePlaces::side; ++along) {
    const LatticePlace at = LatticePlaces::on_side(tile, direction, along);
    exits |= std::uint64_t{!marks.is_core(at) && marks.direction(at) == direction} << along;
  }
  return exits;
}

class PieceBuilder {
 public:
  PieceBuilder(const LatticePlaces& places, CellMarks marks, const Execution& execution)
      : places_(places), marks_(marks), execution_(execution) {}

  PieceArrays build() {
    find_exits();
    const std::size_t count = arrays_.first_exit[places_.tile_count()];
    execution_.reserve(count * 14 * sizeof(std::uint32_t));
    follow_exits(count);
    choose_heavy();
    number_paths();
    return std::move(arrays_);
  }

 private:
  /// By exit, in the order of tiles.
  struct Exit {
    PieceId parent;
    std::uint32_t length;  // steps from its cell to the parent's exit, or to the core
    LatticePlace door;
  };

  void find_exits() {
    const std::size_t tiles = places_.tile_count();
    execution_.reserve(tiles * (4 * sizeof(std::uint64_t) + sizeof(std::uint32_t)));
    RawVector<std::uint64_t> exits(4 * tiles);
    RawVector<std::uint32_t> first(tiles + 1);
    first[tiles] = 0;
    for_each_index(tiles, tile_grain, execution_, [&](std::size_t tile) {
      first[tile] = 0;
      for (unsigned d = 0; d < 4; ++d) {
        const std::uint64_t word = exits_of(marks_, static_cast<std::uint32_t>(tile), d);
        exits[4 * tile + d] = word;
        first[tile] += static_cast<std::uint32_t>(std::popcount(word));
      }
    });
    exclusive_scan(first, execution_);
    arrays_.exits = ArrayOrView<std::uint64_t>(std::move(exits));
    arrays_.first_exit = ArrayOrView<std::uint32_t>(std::move(first));
  }

  void follow_exits(std::size_t count) {
    exits_.resize(count);
    RawVector<PieceId> same(count);
    for (std::size_t i = 0; i < count; ++i) {
      execution_.poll(i);
      same[i] = static_cast<PieceId>(i);
    }
    arrays_.piece = ArrayOrView<PieceId>(std::move(same));
    const PieceForest forest(places_, marks_, arrays_);
    for_chunks(places_.tile_count(), tile_grain, execution_, [&](Range r) {
      std::uint32_t exit = arrays_.first_exit[r.first];
      for (std::size_t side = 4 * r.first; side < 4 * r.last; ++side) {
        for (std::uint64_t left = arrays_.exits[side]; left != 0; left &= left - 1) {
          const auto along = static_cast<unsigned>(std::countr_zero(left));
          const auto direction = static_cast<unsigned>(side % 4);
          const LatticePlace at = LatticePlaces::on_side(static_cast<std::uint32_t>(side / 4), direction, along);
          const LatticePlace door = places_.step(at, direction);
          const Climb up = forest.climb(door);
          exits_[exit++] = {up.at_core ? no_piece : forest.piece_at(up.last), 1 + up.steps, door};
        }
      }
    });
  }

  /// Of a piece's children the largest is heavy, of equal ones the first.
  void choose_heavy() {
    const std::size_t count = exits_.size();
    const auto poll = [this] { execution_.check(); };
    RawVector<std::uint32_t> children;  // that are still to come
    RawVector<std::uint32_t> size;
    assign_polled(children, count, std::uint32_t{0}, poll);
    assign_polled(size, count, std::uint32_t{1}, poll);
    assign_polled(heavy_, count, no_piece, poll);
    for (std::size_t i = 0; i < count; ++i) {
      execution_.poll(i);
      if (exits_[i].parent != no_piece) ++children[exits_[i].parent];
    }
    order_.resize(count);
    std::size_t last = 0;
    for (std::size_t i = 0; i < count; ++i) {
      execution_.poll(i);
      if (children[i] == 0) order_[last++] = static_cast<PieceId>(i);
    }
    for (std::size_t i = 0; i < count; ++i) {
      execution_.poll(i);
      const PieceId child = order_[i];
      const PieceId parent = exits_[child].parent;
      if (parent == no_piece) continue;
      if (--children[parent] == 0) order_[last++] = parent;
      size[parent] += size[child];
      PieceId& heavy = heavy_[parent];
      const bool is_larger = heavy == no_piece || size[child] > size[heavy];
      if (is_larger || (size[child] == size[heavy] && child < heavy)) heavy = child;
    }
  }

  /// From the roots down: whoever is no heavy child heads a path, numbered as a whole.
  void number_paths() {
    const std::size_t count = exits_.size();
    RawVector<PieceId> number(count);
    RawVector<TreePiece> pieces(count);
    PieceId next = 0;
    for (std::size_t i = 0; i < count; ++i) {
      execution_.poll(i);
      const PieceId top = order_[count - 1 - i];
      const PieceId parent = exits_[top].parent;
      if (parent != no_piece && heavy_[parent] == top) continue;
      const PieceId head = next;
      const PieceId up = parent == no_piece ? no_piece : number[parent];
      std::uint32_t depth = up == no_piece ? 0 : pieces[up].depth;
      for (PieceId p = top; p != no_piece; p = heavy_[p]) {
        execution_.poll(next);
        depth += exits_[p].length;
        pieces[next] = {head, up, depth, exits_[p].door};
        number[p] = next++;
      }
    }
    arrays_.piece = ArrayOrView<PieceId>(std::move(number));
    arrays_.pieces = ArrayOrView<TreePiece>(std::move(pieces));
  }

  const LatticePlaces& places_;
  const CellMarks marks_;
  const Execution& execution_;
  PieceArrays arrays_;
  RawVector<Exit> exits_;
  RawVector<PieceId> order_;  // children before parents
  RawVector<PieceId> heavy_;  // largest child
};

/// Goes on to the end. A way that turned in a circle is said to have come to the core.
Climb ended(TileClimb climb, std::uint32_t steps) {
  while (steps < LatticePlaces::tile_places && climb.step()) ++steps;
  return {climb.place(), steps, climb.at_core() || steps == LatticePlaces::tile_places};
}

}  // namespace

Climb PieceForest::climb(LatticePlace from) const { return ended(TileClimb(marks_, from), 0); }

std::array<Climb, 2> PieceForest::climb_both(LatticePlace a, LatticePlace b) const {
  TileClimb one(marks_, a);
  TileClimb other(marks_, b);
  std::uint32_t both = 0;
  for (;; ++both) {
    const bool one_goes = both < LatticePlaces::tile_places && one.step();
    const bool other_goes = both < LatticePlaces::tile_places && other.step();
    if (one_goes && other_goes) continue;
    return {ended(one, both + (one_goes ? 1 : 0)), ended(other, both + (other_goes ? 1 : 0))};
  }
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

namespace {

/// About 200 cells: a search of them takes a few microseconds, and larger leaves save little memory.
std::size_t leaf_size(const CoreGraph& graph) {
  const std::uint64_t junctions = 200 * graph.size() / std::max<std::uint64_t>(1, graph.core_cells);
  return std::clamp<std::uint64_t>(junctions, 4, 32);
}

/// Calls visit(name, array) for every array of the index but the passages.
template <class Arrays, class Visit>
void for_each_array(Arrays& arrays, const Visit& visit) {
  visit("marks", arrays.marks);
  visit("exits", arrays.pieces.exits);
  visit("exit.first", arrays.pieces.first_exit);
  visit("exit.piece", arrays.pieces.piece);
  visit("pieces", arrays.pieces.pieces);
  visit("gates", arrays.gates);
  visit("gates.before", arrays.gates_before);
  visit("gate.rank", arrays.gate_rank);
  visit("gate.place", arrays.fronts.gate_place);
  visit("fronts", arrays.fronts.fronts);
  visit("front.bounds", arrays.fronts.bounds);
  visit("front.lengths", arrays.fronts.lengths);
  visit("front.shorts", arrays.fronts.short_lengths);
  visit("front.ways", arrays.fronts.ways);
}

std::vector<RouteSection> sections_of(std::span<const std::uint64_t> right, std::span<const std::uint64_t> up,
                                      const RouteArrays& arrays) {
  std::vector<RouteSection> sections{{"passages.right", 8, std::as_bytes(right)},
                                     {"passages.up", 8, std::as_bytes(up)}};
  for_each_array(arrays, [&]<class T>(std::string_view name, const ArrayOrView<T>& array) {
    sections.push_back({name, sizeof(T), std::as_bytes(array.span())});
  });
  return sections;
}

template <class T>
ArrayOrView<T> elements(std::span<const RouteSection> sections, std::string_view name) {
  const auto found = std::ranges::find(sections, name, &RouteSection::name);
  if (found == sections.end()) throw InputError("route index", "a section is missing", name);
  if (found->bytes.size() % sizeof(T) != 0 || found->element_bytes != sizeof(T)) {
    throw InputError("route index", "elements of a section need " + std::to_string(sizeof(T)) + " bytes", name);
  }
  const std::span all(reinterpret_cast<const T*>(found->bytes.data()), found->bytes.size() / sizeof(T));
  return ArrayOrView<T>(all, found->first_look);
}

void require(bool holds, std::string_view what) {
  if (!holds) throw InputError("route index", "a section contradicts the others: build the index again", what);
}

/// Exits are those that the marks say, and none leaves the lattice.
void check_exits(const LatticePlaces& places, CellMarks marks, const ArrayOrView<std::uint64_t>& exits) {
  for (std::uint32_t tile = 0; tile < places.tile_count(); ++tile) {
    const std::uint32_t col = tile % places.tile_cols();
    const std::uint32_t row = tile / places.tile_cols();
    const bool at_rim[] = {col + 1 == places.tile_cols(), row + 1 == places.tile_rows(), col == 0, row == 0};
    for (unsigned d = 0; d < 4; ++d) {
      const std::uint64_t word = exits[4 * std::size_t{tile} + d];
      require(word == exits_of(marks, tile, d) && (!at_rim[d] || word == 0), "exits");
    }
  }
}

void check_pieces(const LatticePlaces& places, const PieceArrays& pieces) {
  const std::size_t count = pieces.pieces.size();
  for (std::size_t tile = 0; tile < places.tile_count(); ++tile) {
    std::uint32_t exits = 0;
    for (std::size_t d = 0; d < 4; ++d) exits += static_cast<std::uint32_t>(std::popcount(pieces.exits[4 * tile + d]));
    require(pieces.first_exit[tile + 1] == pieces.first_exit[tile] + exits, "exit.first");
  }
  for (PieceId p = 0; p < count; ++p) {
    const TreePiece& piece = pieces.pieces[p];
    require(pieces.piece[p] < count && piece.head <= p && piece.door < places.place_count(), "pieces");
    const TreePiece& head = pieces.pieces[piece.head];
    require(head.head == piece.head && head.up == piece.up, "pieces");
    require(piece.up == no_piece || piece.up < piece.head, "pieces");
  }
}

/// Fronts follow each other without gaps in all that they have.
void check_fronts(const FrontArrays& arrays) {
  const std::span<const Front> fronts = arrays.fronts.span();
  const std::size_t gates = arrays.gate_place.size();
  const std::size_t bounds = arrays.bounds.size();
  const std::size_t ways = arrays.ways.size();
  const std::array<std::uint64_t, 2> lengths{arrays.lengths.size(), arrays.short_lengths.size()};
  std::uint64_t first = 0;
  std::uint64_t bound = 0;
  std::uint64_t way = 0;
  std::array<std::uint64_t, 2> length{};
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const Front& f = fronts[i];
    const std::size_t kind = f.is_short() ? 1 : 0;
    const std::uint64_t entries = row_offset(f.gates, f.gates, f.bounds);
    require(f.first == first && f.first_bound == bound && f.first_length() == length[kind] && f.gates >= 1, "fronts");
    require(f.first_way() == way && f.way_elements() <= 4, "fronts");
    first += f.gates;
    bound += f.bounds;
    length[kind] += entries;
    way += entries * f.way_elements();
    require(first <= gates && bound <= bounds && length[kind] <= lengths[kind] && way <= ways, "fronts");
    require(f.parent == no_front || (f.parent > i && f.parent < fronts.size()), "fronts");
  }
  require(first == gates && bound == bounds && length == lengths && way == ways, "fronts");
}

/// What an index of views relies on: arrays have the sizes that the lattice and the others ask for, and fronts lie in
/// theirs. O(fronts).
void check_route_sizes(const LatticePlaces& places, const RouteArrays& arrays) {
  const std::size_t rows = places.place_count() / 64;
  const PieceArrays& pieces = arrays.pieces;
  const std::size_t gates = arrays.fronts.gate_place.size();
  require(arrays.marks.size() == rows * mark_word::count, "marks");
  require(pieces.exits.size() == 4 * places.tile_count(), "exits");
  require(pieces.first_exit.size() == places.tile_count() + 1 && pieces.first_exit[0] == 0, "exit.first");
  require(pieces.first_exit[places.tile_count()] == pieces.pieces.size(), "exit.first");
  require(pieces.piece.size() == pieces.pieces.size(), "exit.piece");
  require(arrays.gates.size() == (gates == 0 ? 0 : rows), "gates");
  require(arrays.gates_before.size() == arrays.gates.size() && arrays.gate_rank.size() == gates, "gates.before");
  check_fronts(arrays.fronts);
}

/// The bounds and lengths of a front whose place in the arrays is right, each in its range.
void check_front_arrays(const FrontArrays& arrays, const Front& f) {
  const std::uint64_t count = row_offset(f.gates, f.gates, f.bounds);
  arrays.bounds.look(f.first_bound, f.bounds);
  GateRank least = f.first + f.gates;
  for (const GateRank bound : arrays.bounds.span().subspan(f.first_bound, f.bounds)) {
    require(bound >= least && bound < arrays.gate_place.size(), "front.bounds");
    least = bound + 1;
  }
  const auto check_lengths = [&](const auto& lengths, std::uint32_t most, std::string_view name) {
    lengths.look(f.first_length(), count);
    require(std::ranges::all_of(lengths.span().subspan(f.first_length(), count),
                                [most](std::uint32_t length) { return length >= 1 && length <= most; }),
            name);
  };
  f.is_short() ? check_lengths(arrays.short_lengths, no_short_way, "front.shorts")
               : check_lengths(arrays.lengths, no_way, "front.lengths");
}

/// The gates that ways go over have lower ranks.
void check_ways(const FrontArrays& arrays, const Front& f) {
  std::uint64_t at = 0;
  for (std::uint32_t i = 0; i < f.gates; ++i) {
    for (std::uint64_t j = i + std::uint64_t{1}; j < std::uint64_t{f.gates} + f.bounds; ++j, ++at) {
      const std::uint64_t way = front_way(arrays, f, at);
      require((way & 1U) != 0 || way / 2 <= f.first + i, "front.ways");
    }
  }
}

}  // namespace

void RouteIndexOptions::validate() const {
  if (leaf <= most_leaf_junctions) return;
  throw InputError("leaf", "must be at most " + std::to_string(most_leaf_junctions), std::to_string(leaf));
}

bool route_index_pays(std::uint64_t junctions, std::uint64_t cells) { return junctions * 10 <= cells * 3; }

RouteIndex::RouteIndex(LatticePassages passages, const RouteIndexOptions& options, const Execution& execution)
    : passages_(std::move(passages)), places_(passages_.size()) {
  options.validate();
  const PagePool pages;  // what one stage leaves is warm for the next
  RawVector<std::uint8_t> peeled = peel(passages_, places_, execution);
  CoreGraph graph = core_graph(peeled, places_, execution);
  reduce_core(graph, places_, peeled, execution);
  if (!options.open_space && !route_index_pays(graph.size(), passages_.cell_count())) {
    throw InputError(
        "route index",
        "doesn't pay in open space, where more than 3 of 10 cells are junctions with a choice: search the grid",
        std::to_string(graph.size()) + " of " + std::to_string(passages_.cell_count()));
  }
  RawVector<std::uint64_t> marks = mark_words(peeled, places_, execution);
  let_go(peeled);
  arrays_.pieces = build_pieces(places_, CellMarks(marks.data()), execution);
  arrays_.fronts =
      build_fronts(graph, dissect(graph, options.leaf == 0 ? leaf_size(graph) : options.leaf, execution), execution);
  arrays_.marks = ArrayOrView<std::uint64_t>(std::move(marks));
  mark_gates(execution);
  find_fronts(execution);
  sound_ = LastingMarks(arrays_.fronts.fronts.size());
}

RouteIndex::RouteIndex(LatticePassages passages, RouteArrays arrays)
    : passages_(std::move(passages)),
      places_(passages_.size()),
      arrays_(std::move(arrays)),
      sound_(arrays_.fronts.fronts.size()) {
  check_route_sizes(places_, arrays_);
  find_fronts({});
}

GateRank RouteIndex::gate_at(LatticePlace p) const {
  const std::size_t at = number_of_gate(p);
  const std::size_t gates = arrays_.gate_rank.size();
  if (at < gates && arrays_.gate_rank[at] < gates) return arrays_.gate_rank[at];
  throw InputError("route index", "its gates contradict each other: build it again");
}

LatticePlace RouteIndex::gate_place(GateRank rank) const {
  const LatticePlace p = arrays_.fronts.gate_place[rank];
  if (p < places_.place_count()) return p;
  throw InputError("route index", "a gate of it stands nowhere: build it again");
}

void RouteIndex::check_front(FrontId number) const {
  check_front_arrays(arrays_.fronts, arrays_.fronts.fronts[number]);
  sound_.set(number);
}

void RouteIndex::find_fronts(const Execution& execution) {
  const std::span<const Front> fronts = arrays_.fronts.fronts.span();
  const std::size_t looks = (arrays_.fronts.gate_place.size() + gates_a_look - 1) / gates_a_look;
  execution.reserve(looks * sizeof(FrontId));
  front_near_.resize(looks);
  FrontId front = 0;
  for (std::size_t i = 0; i < front_near_.size(); ++i) {
    execution.poll(i);
    while (front + 1 < fronts.size() && fronts[front + 1].first <= i * gates_a_look) ++front;
    front_near_[i] = front;
  }
}

void RouteIndex::mark_gates(const Execution& execution) {
  const ArrayOrView<LatticePlace>& gate_place = arrays_.fronts.gate_place;
  if (gate_place.empty()) return;
  const std::size_t rows = places_.place_count() / 64;
  execution.reserve(rows * (sizeof(std::uint64_t) + sizeof(std::uint32_t)) + gate_place.size() * sizeof(GateRank));
  RawVector<std::uint64_t> gates;
  assign_polled(gates, rows, std::uint64_t{0}, [&] { execution.check(); });
  for (std::size_t rank = 0; rank < gate_place.size(); ++rank) {
    execution.poll(rank);
    const LatticePlace p = gate_place[rank];
    gates[p / 64] |= std::uint64_t{1} << p % 64;
  }
  RawVector<std::uint32_t> before(rows);
  for_each_index(rows, 4096, execution,
                 [&](std::size_t row) { before[row] = static_cast<std::uint32_t>(std::popcount(gates[row])); });
  exclusive_scan(before, execution);
  RawVector<GateRank> ranks(gate_place.size());
  arrays_.gates = ArrayOrView<std::uint64_t>(std::move(gates));
  arrays_.gates_before = ArrayOrView<std::uint32_t>(std::move(before));
  for (std::size_t rank = 0; rank < gate_place.size(); ++rank) {
    execution.poll(rank);
    ranks[number_of_gate(gate_place[rank])] = static_cast<GateRank>(rank);
  }
  arrays_.gate_rank = ArrayOrView<GateRank>(std::move(ranks));
}

std::vector<RouteSection> route_sections(const RouteIndex& index) {
  return sections_of(index.passages().right_words(), index.passages().up_words(), index.arrays());
}

std::vector<RouteSection> route_section_kinds() { return sections_of({}, {}, RouteArrays()); }

RouteIndex route_index_of(LatticeSize size, std::span<const RouteSection> sections) {
  RouteArrays arrays;
  for_each_array(arrays,
                 [&]<class T>(std::string_view name, ArrayOrView<T>& array) { array = elements<T>(sections, name); });
  return {LatticePassages(size, elements<std::uint64_t>(sections, "passages.right"),
                          elements<std::uint64_t>(sections, "passages.up")),
          std::move(arrays)};
}

bool is_read_in_parts(std::string_view section) {
  constexpr std::array parts{"marks",         "exit.piece",   "pieces",    "front.bounds",
                             "front.lengths", "front.shorts", "front.ways"};
  return std::find(parts.begin(), parts.end(), section) != parts.end();
}

void check_route_arrays(const LatticePlaces& places, const RouteArrays& arrays) {
  const std::size_t gates = arrays.fronts.gate_place.size();
  check_route_sizes(places, arrays);
  check_pieces(places, arrays.pieces);
  check_exits(places, CellMarks(arrays.marks.data()), arrays.pieces.exits);
  for (const Front& front : arrays.fronts.fronts.span()) {
    check_front_arrays(arrays.fronts, front);
    check_ways(arrays.fronts, front);
  }
  require(
      std::ranges::all_of(arrays.fronts.gate_place.span(), [&](LatticePlace p) { return p < places.place_count(); }),
      "gate.place");
  require(std::ranges::all_of(arrays.gate_rank.span(), [&](GateRank rank) { return rank < gates; }), "gate.rank");
  std::uint32_t before = 0;
  for (std::size_t row = 0; row < arrays.gates.size(); ++row) {
    require(arrays.gates_before[row] == before, "gates.before");
    require((arrays.gates[row] & ~arrays.marks[row * mark_word::count + mark_word::core]) == 0, "gates");
    before += static_cast<std::uint32_t>(std::popcount(arrays.gates[row]));
  }
  require(before == gates, "gates");
}

}  // namespace warren
