// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/core_graph.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "parallel/sort.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tile_source.hpp"

namespace warren {

LatticePassages::LatticePassages(LatticeSize size, ArrayOrView<std::uint64_t> right, ArrayOrView<std::uint64_t> up)
    : size_(size), stride_(words_a_row(size.cols)), right_(std::move(right)), up_(std::move(up)) {
  check_size(size_);
  const std::size_t words = stride_ * size_.rows;
  if (right_.size() != words || up_.size() != words) {
    throw InputError("passages", "need " + std::to_string(words) + " words a plane, rows in whole words",
                     std::to_string(right_.size()) + " and " + std::to_string(up_.size()));
  }
  const std::uint64_t last = size_.cols % 64 == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << size_.cols % 64) - 1;
  for (std::uint32_t row = 0; row < size_.rows; ++row) {
    const std::size_t end = (row + std::size_t{1}) * stride_ - 1;
    if ((right_[end] & ~(last >> 1)) == 0 && (up_[end] & ~last) == 0) continue;
    throw InputError("passages", "a motion to the right leaves the lattice in row", std::to_string(row));
  }
  for (std::size_t word = words - stride_; word < words; ++word) {
    if (up_[word] != 0) throw InputError("passages", "a motion upwards leaves the lattice in its last row");
  }
}

void LatticePassages::check_size(LatticeSize size) {
  const std::uint64_t tiles = words_a_row(size.cols) * words_a_row(size.rows);
  if (size.rows >= 1 && size.cols >= 1 && tiles < (std::uint64_t{1} << 20)) return;
  throw InputError("lattice", "needs rows and columns, and less than 2^20 tiles of 64 x 64 cells",
                   std::to_string(size.rows) + " x " + std::to_string(size.cols));
}

PassageWords LatticePassages::closed(LatticeSize size, const Execution& execution) {
  check_size(size);
  const std::size_t words = words_a_row(size.cols) * size.rows;
  execution.reserve(2 * words * sizeof(std::uint64_t));
  PassageWords planes;
  const auto poll = [&] { execution.check(); };
  assign_polled(planes.right, words, std::uint64_t{0}, poll);
  assign_polled(planes.up, words, std::uint64_t{0}, poll);
  return planes;
}

std::array<std::uint64_t, 4> LatticePassages::open_words(std::uint32_t col, std::uint32_t row) const {
  const std::size_t word = row * stride_ + col / 64;
  const std::uint64_t before = col > 0 ? right_[word - 1] >> 63 : 0;
  return {right_[word], up_[word], right_[word] << 1 | before, row > 0 ? up_[word - stride_] : 0};
}

namespace {

/// Tiles are whole words wide, so each word belongs to one of them.
void pack(const TilePlane& plane, const TileGrid& grid, PassageWords& words) {
  static_assert(plane_bit::right == 1 && plane_bit::up == 2);
  const std::size_t stride = LatticePassages::words_a_row(grid.cols);
  const std::uint32_t first_col = grid.first_col(plane.tile());
  for (int row = 0; row < plane.height(); ++row) {
    std::size_t word = (grid.first_row(plane.tile()) + static_cast<std::size_t>(row)) * stride + first_col / 64;
    for (int col = 0; col < plane.width(); col += 64, ++word) {
      std::array<std::uint8_t, 64> line{};
      std::memcpy(line.data(), plane.at(col, row), static_cast<std::size_t>(std::min(64, plane.width() - col)));
      words.right[word] = gathered_bits(line.data(), 0);
      words.up[word] = gathered_bits(line.data(), 1);
    }
  }
}

}  // namespace

LatticePassages wall_passages(const WalledLattice& world, const Execution& execution) {
  if (!(world.clearance >= 0.0 && world.clearance <= WallMarker::largest_clearance)) {
    throw InputError("clearance", "must be a number from 0 to 8, in steps of the lattice");
  }
  PassageWords words = LatticePassages::closed(world.lattice, execution);
  const TileGrid grid = TileGrid::of(world.lattice);
  const double clearance = world.clearance * (1 + 1e-9);
  const double halo = 1.0 + clearance * (1 + 1e-9) + 0.01;  // an edge's length, its clearance, and rounding
  const WallPartition partition(world.walls, world.more_walls, grid, halo, execution);
  const Box box = world.box.value_or(partition.box());
  for_chunks(grid.count(), 1, execution, [&](Range r) {
    WallMarker marker(clearance);
    TilePlane plane(grid, marker.margin());
    plane.reset(r.first, box);
    marker.mark(partition.of(r.first), plane);
    pack(plane, grid, words);
  });
  return {world.lattice, std::move(words)};
}

namespace {

/// Eight bits as the lowest bits of eight bytes: each byte keeps its own of them, which a sum carries to its highest.
constexpr std::uint64_t bits_as_bytes(std::uint64_t bits) {
  const std::uint64_t own = bits * 0x0101010101010101U & 0x8040201008040201U;
  return (own + 0x00406070787c7e7fU) >> 7U & 0x0101010101010101U;
}
static_assert(bits_as_bytes(0xff) == 0x0101010101010101U && bits_as_bytes(0x92) == 0x0100000100000100U);

/// Tiles [first_col, end_col) x [first_row, end_row).
struct TileSquare {
  std::uint32_t first_col, first_row, end_col, end_row;
};

class TreePeeling {
 public:
  TreePeeling(const LatticePassages& passages, const LatticePlaces& places, const Execution& execution)
      : passages_(passages), places_(places), execution_(execution) {
    execution.reserve(places.place_count());
    bytes_.resize(places.place_count());
    touch_first(bytes_, execution);
  }

  RawVector<std::uint8_t> run() {
    for_each_index<std::uint32_t>(places_.tile_count(), 16, execution_, [&](std::uint32_t tile) {
      const std::uint32_t col = tile % places_.tile_cols();
      const std::uint32_t row = tile / places_.tile_cols();
      const LatticePlace first = tile * LatticePlaces::tile_places;
      for (std::uint32_t i = 0; i < LatticePlaces::side; ++i) {
        load_row(bytes_.data() + first + i * LatticePlaces::side, col * LatticePlaces::side,
                 row * LatticePlaces::side + i);
      }
      for (LatticePlace i = 0; i < LatticePlaces::tile_places; ++i) follow(first + i, {col, row, col + 1, row + 1});
    });
    for (std::uint32_t side = growth; side / growth < most_tiles(); side *= growth) peel_squares(side);
    return std::move(bytes_);
  }

 private:
  static constexpr std::uint32_t growth = 8;

  std::uint32_t most_tiles() const { return std::max(places_.tile_cols(), places_.tile_rows()); }
  void load_row(std::uint8_t* at, std::uint32_t col, std::uint32_t row) const {
    std::array<std::uint64_t, 4> open{};  // what fills up the lattice has no passages, and is no tree
    if (row < places_.size().rows) open = passages_.open_words(col, row);
    for (unsigned i = 0; i < LatticePlaces::side; i += 8) {
      std::uint64_t eight = 0;
      for (unsigned d = 0; d < 4; ++d) eight |= bits_as_bytes(open[d] >> i & 255U) << d;
      std::memcpy(at + i, &eight, 8);
    }
  }

  /// Squares of side x side tiles: the dead ends at the borders of the smaller squares in them.
  void peel_squares(std::uint32_t side) {
    const std::uint32_t cols = (places_.tile_cols() - 1) / side + 1;
    const std::uint32_t rows = (places_.tile_rows() - 1) / side + 1;
    const std::uint32_t inner = side / growth;
    for_chunks(std::size_t{cols} * rows, 1, execution_, [&](Range r) {
      const auto number = static_cast<std::uint32_t>(r.first);
      TileSquare square{number % cols * side, number / cols * side, 0, 0};
      square.end_col = std::min(square.first_col + side, places_.tile_cols());
      square.end_row = std::min(square.first_row + side, places_.tile_rows());
      for (std::uint32_t row = square.first_row; row < square.end_row; ++row) {
        execution_.check();
        for (std::uint32_t col = square.first_col; col < square.end_col; ++col) {
          const std::uint32_t tile = row * places_.tile_cols() + col;
          if (col % inner == inner - 1) peel_border(tile, 0, square);
          if (row % inner == inner - 1) peel_border(tile, 1, square);
          if (col % inner == 0) peel_border(tile, 2, square);
          if (row % inner == 0) peel_border(tile, 3, square);
        }
      }
    });
  }

  void peel_border(std::uint32_t tile, unsigned direction, const TileSquare& square) {
    for (unsigned along = 0; along < LatticePlaces::side; ++along) {
      const LatticePlace at = LatticePlaces::on_side(tile, direction, along);
      if (bytes_[at] == 1U << direction) follow(at, square);
    }
  }

  void follow(LatticePlace at, const TileSquare& square) {
    constexpr unsigned borders_a_poll = 1024;
    unsigned borders = 0;
    for (unsigned open = bytes_[at]; std::has_single_bit(open) && open <= peel_bit::edges; open = bytes_[at]) {
      const auto direction = static_cast<unsigned>(std::countr_zero(open));
      if (LatticePlaces::leaves_tile(at, direction)) {
        if (leaves(LatticePlaces::tile_of(at), direction, square)) return;
        if (++borders % borders_a_poll == 0) execution_.check();
      }
      bytes_[at] = static_cast<std::uint8_t>(peel_bit::peeled | direction << peel_bit::direction_shift);
      at = places_.step(at, direction);
      bytes_[at] = static_cast<std::uint8_t>(bytes_[at] & ~(1U << (direction ^ 2U)));
    }
  }

  bool leaves(std::uint32_t tile, unsigned direction, const TileSquare& square) const {
    const std::uint32_t col = tile % places_.tile_cols();
    const std::uint32_t row = tile / places_.tile_cols();
    if ((direction & 1U) == 0) return direction == 0 ? col + 1 == square.end_col : col == square.first_col;
    return direction == 1 ? row + 1 == square.end_row : row == square.first_row;
  }

  const LatticePassages& passages_;
  const LatticePlaces& places_;
  const Execution& execution_;
  RawVector<std::uint8_t> bytes_;
};

/// Junctions are found row by row of the tiles, 64 cells each.
constexpr std::size_t core_row_grain = 1024;
constexpr std::size_t junction_grain = 4096;

bool is_junction(LatticePlace p, unsigned byte) {
  return (byte & peel_bit::peeled) == 0 && exit_count(byte & peel_bit::edges) >= (is_post(p) ? 2U : 3U);
}

class CoreWalk {
 public:
  CoreWalk(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places, const Execution& execution)
      : peeled_(peeled), places_(places), execution_(execution) {}

  CoreGraph run() {
    find_junctions();
    walk_chains();
    drop_useless();
    return std::move(graph_);
  }

 private:
  void find_junctions() {
    const std::size_t rows = places_.place_count() / 64;
    execution_.reserve(rows * 12);
    bits_.resize(rows);
    first_.resize(rows);
    graph_.core_cells = sum_of_chunks(rows, core_row_grain, execution_, [&](Range r) {
      std::uint64_t cells = 0;
      for (std::size_t row = r.first; row < r.last; ++row) {
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < 64; ++i) {
          const std::size_t p = row * 64 + i;
          bits |= std::uint64_t{is_junction(static_cast<LatticePlace>(p), peeled_[p])} << i;
          cells += (peeled_[p] & peel_bit::edges) != 0 ? 1U : 0U;
        }
        bits_[row] = bits;
        first_[row] = static_cast<std::uint32_t>(std::popcount(bits));
      }
      return cells;
    });
    const std::uint64_t count = exclusive_scan(first_, execution_);
    if (count >= (std::uint64_t{1} << 30) || graph_.core_cells >= (std::uint64_t{1} << 30)) {
      throw InputError("route index", "takes less than 2^30 cells that lie on loops");
    }
    execution_.reserve(count * 36);
    graph_.place.resize(count);
    graph_.twin.resize(4 * count);
    graph_.length.resize(4 * count);
  }

  void walk_chains() {
    for_each_index(bits_.size(), core_row_grain, execution_, [&](std::size_t row) {
      JunctionId v = first_[row];
      for (std::uint64_t left = bits_[row]; left != 0; left &= left - 1, ++v) {
        graph_.place[v] = static_cast<LatticePlace>(row * 64 + static_cast<std::size_t>(std::countr_zero(left)));
        for (unsigned d = 0; d < 4; ++d) walk(v, d);
      }
    });
  }

  /// To the next junction. An edge of a core cell that isn't in the nibble leads to a tree.
  void walk(JunctionId from, unsigned direction) {
    const HalfEdge slot = 4 * from + direction;
    LatticePlace at = graph_.place[from];
    graph_.twin[slot] = no_half_edge;
    if ((peeled_[at] >> direction & 1U) == 0) return;
    std::uint32_t length = 0;
    for (;;) {
      at = places_.step(at, direction);
      execution_.poll(++length);
      const unsigned back = direction ^ 2U;
      if ((bits_[at / 64] >> at % 64 & 1U) != 0) {
        graph_.twin[slot] = 4 * junction_at(at) + back;
        graph_.length[slot] = length;
        return;
      }
      direction = static_cast<unsigned>(std::countr_zero(peeled_[at] & peel_bit::edges & ~(1U << back)));
    }
  }

  void drop_useless() {
    const std::size_t count = graph_.size();
    RawVector<std::uint8_t> useless(count);
    for_each_index<JunctionId>(count, junction_grain, execution_, [&](JunctionId v) {
      unsigned slots = 0;
      for (unsigned s = 0; s < 4; ++s) slots |= is_useless(v, s) ? 1U << s : 0;
      useless[v] = static_cast<std::uint8_t>(slots);
    });
    for_chunks(count, junction_grain, execution_, [&](Range r) {
      for (std::size_t h = 4 * r.first; h < 4 * r.last; ++h) {
        if ((useless[h / 4] >> h % 4 & 1U) != 0) graph_.twin[h] = no_half_edge;
      }
    });
  }

  /// Both ends of a chain come to the same answer.
  bool is_useless(JunctionId v, unsigned slot) const {
    const HalfEdge h = 4 * v + slot;
    const HalfEdge twin = graph_.twin[h];
    if (twin == no_half_edge) return false;
    if (twin / 4 == v) return true;
    for (unsigned other = 0; other < 4; ++other) {
      const HalfEdge rival = graph_.twin[4 * v + other];
      if (other == slot || rival == no_half_edge || rival / 4 != twin / 4) continue;
      const std::uint32_t its = graph_.length[4 * v + other];
      const std::uint32_t own = graph_.length[h];
      if (its < own || (its == own && std::min(rival, 4 * v + other) < std::min(twin, h))) return true;
    }
    return false;
  }

  JunctionId junction_at(LatticePlace p) const {
    const std::uint64_t below = (std::uint64_t{1} << p % 64) - 1;
    return first_[p / 64] + static_cast<JunctionId>(std::popcount(bits_[p / 64] & below));
  }

  const RawVector<std::uint8_t>& peeled_;
  const LatticePlaces& places_;
  const Execution& execution_;
  RawVector<std::uint64_t> bits_;   // of junctions
  RawVector<std::uint32_t> first_;  // junction of a row
  CoreGraph graph_;
};

class CoreReduction {
 public:
  CoreReduction(CoreGraph& graph, const LatticePlaces& places, RawVector<std::uint8_t>& peeled,
                const Execution& execution)
      : graph_(graph), places_(places), peeled_(peeled), execution_(execution) {}

  void run() {
    execution_.reserve(graph_.size() * 8);
    assign_polled(gone_, graph_.size(), std::uint8_t{0}, [&] { execution_.check(); });
    std::uint64_t steps = 0;
    for (JunctionId v = 0; v < graph_.size(); ++v) {
      todo_.push_back(v);
      while (!todo_.empty()) {
        execution_.poll(++steps);
        const JunctionId next = todo_.back();
        todo_.pop_back();
        visit(next);
      }
    }
    renumber();
    for_each_index<JunctionId>(graph_.size(), 4096, execution_, [&](JunctionId v) { mark_chains(v); });
  }

 private:
  /// Of at most two chains: takes the junction out.
  void visit(JunctionId v) {
    if (gone_[v] != 0 || is_post(graph_.place[v])) return;
    std::array<HalfEdge, 2> chain{};
    std::size_t count = 0;
    for (HalfEdge h = 4 * v; h < 4 * v + 4; ++h) {
      if (graph_.twin[h] == no_half_edge) continue;
      if (count == 2) return;
      chain[count++] = h;
    }
    gone_[v] = 1;
    if (count == 1) drop(chain[0]);
    if (count < 2) return;
    std::uint8_t& byte = peeled_[graph_.place[v]];
    byte = static_cast<std::uint8_t>((byte & ~peel_bit::edges) | 1U << chain[0] % 4 | 1U << chain[1] % 4);
    const HalfEdge a = graph_.twin[chain[0]];
    const HalfEdge b = graph_.twin[chain[1]];
    const std::uint32_t length = graph_.length[chain[0]] + graph_.length[chain[1]];
    graph_.twin[chain[0]] = graph_.twin[chain[1]] = no_half_edge;
    join(a, b, length);
  }

  /// A chain between two slots, unless it leads back to its junction or is no shorter than one that is there.
  void join(HalfEdge a, HalfEdge b, std::uint32_t length) {
    graph_.twin[a] = b;
    graph_.twin[b] = a;
    graph_.length[a] = graph_.length[b] = length;
    if (a / 4 == b / 4) return drop(a);
    for (HalfEdge h = a & ~HalfEdge{3}; h < (a & ~HalfEdge{3}) + 4; ++h) {
      if (h == a || graph_.twin[h] == no_half_edge || graph_.twin[h] / 4 != b / 4) continue;
      return drop(graph_.length[h] <= length ? a : h);
    }
  }

  void drop(HalfEdge h) {
    const HalfEdge twin = graph_.twin[h];
    graph_.twin[h] = graph_.twin[twin] = no_half_edge;
    todo_.push_back(h / 4);
    todo_.push_back(twin / 4);
  }

  void renumber() {
    RawVector<JunctionId> number(graph_.size());
    JunctionId next = 0;
    for (JunctionId v = 0; v < graph_.size(); ++v) {
      execution_.poll(v);
      number[v] = next;
      next += gone_[v] == 0 ? 1 : 0;
    }
    for (JunctionId v = 0; v < graph_.size(); ++v) {
      execution_.poll(v);
      if (gone_[v] != 0) continue;
      graph_.place[number[v]] = graph_.place[v];
      for (HalfEdge slot = 0; slot < 4; ++slot) {
        const HalfEdge twin = graph_.twin[4 * v + slot];
        graph_.twin[4 * number[v] + slot] = twin == no_half_edge ? no_half_edge : 4 * number[twin / 4] + twin % 4;
        graph_.length[4 * number[v] + slot] = graph_.length[4 * v + slot];
      }
    }
    graph_.place.resize(next);
    graph_.twin.resize(4 * std::size_t{next});
    graph_.length.resize(4 * std::size_t{next});
  }

  /// A junction, and the cells of its chains to junctions with larger numbers: each cell is written to once.
  void mark_chains(JunctionId v) {
    constexpr unsigned right_and_up = 3;
    const auto mark = [&](LatticePlace p, unsigned edges) {
      peeled_[p] = static_cast<std::uint8_t>(peeled_[p] | (edges & right_and_up) << peel_bit::direction_shift);
    };
    mark(graph_.place[v], slots_of(graph_, v));
    for (unsigned slot = 0; slot < 4; ++slot) {
      const HalfEdge twin = graph_.twin[4 * v + slot];
      if (twin == no_half_edge || twin / 4 < v) continue;
      unsigned direction = slot;
      LatticePlace at = graph_.place[v];
      for (std::uint32_t left = graph_.length[4 * v + slot]; left > 1; --left) {
        execution_.poll(left);
        at = places_.step(at, direction);
        const unsigned edges = peeled_[at] & peel_bit::edges;
        mark(at, edges);
        direction = static_cast<unsigned>(std::countr_zero(edges & ~(1U << (direction ^ 2U))));
      }
    }
  }

  CoreGraph& graph_;
  const LatticePlaces& places_;
  RawVector<std::uint8_t>& peeled_;
  const Execution& execution_;
  RawVector<std::uint8_t> gone_;
  RawVector<JunctionId> todo_;  // whoever has lost a chain
};

}  // namespace

RawVector<std::uint8_t> peel(const LatticePassages& passages, const LatticePlaces& places, const Execution& execution) {
  return TreePeeling(passages, places, execution).run();
}

CoreGraph core_graph(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places, const Execution& execution) {
  return CoreWalk(peeled, places, execution).run();
}

void reduce_core(CoreGraph& graph, const LatticePlaces& places, RawVector<std::uint8_t>& peeled,
                 const Execution& execution) {
  CoreReduction(graph, places, peeled, execution).run();
}

RawVector<std::uint64_t> mark_words(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places,
                                    const Execution& execution) {
  const std::size_t rows = places.place_count() / 64;
  execution.reserve(rows * mark_word::count * sizeof(std::uint64_t));
  RawVector<std::uint64_t> words(rows * mark_word::count);
  constexpr std::size_t grain = 1024;
  for_each_index(rows, grain, execution, [&](std::size_t row) {
    const std::uint8_t* const bytes = peeled.data() + row * 64;
    std::uint64_t* const out = words.data() + row * mark_word::count;
    out[mark_word::low] = gathered_bits(bytes, peel_bit::direction_shift);
    out[mark_word::high] = gathered_bits(bytes, peel_bit::direction_shift + 1);
    out[mark_word::core] = ~gathered_bits(bytes, 6);  // peel_bit::peeled
  });
  return words;
}

}  // namespace warren
