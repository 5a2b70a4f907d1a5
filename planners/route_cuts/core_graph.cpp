// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_cuts/core_graph.hpp"

#include <array>
#include <bit>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "parallel/scan.hpp"
#include "planners/route_trees/peeling.hpp"

namespace warren {
namespace {

/// Junctions are found row by row of the tiles, 64 cells each.
constexpr std::size_t row_grain = 1024;
constexpr std::size_t junction_grain = 4096;

/// Bit e: of nibbles of edges e, have they `least` edges or more? Processors without an instruction to count bits call
/// a function for each cell.
constexpr std::uint32_t nibbles_with(int least) {
  std::uint32_t bits = 0;
  for (unsigned e = 0; e < 16; ++e) bits |= std::uint32_t{std::popcount(e) >= least} << e;
  return bits;
}

bool is_junction(LatticePlace p, unsigned byte) {
  if ((byte & peel_bit::peeled) != 0) return false;
  constexpr std::uint32_t two = nibbles_with(2);
  constexpr std::uint32_t three = nibbles_with(3);
  return ((is_post(p) ? two : three) >> (byte & peel_bit::edges) & 1U) != 0;
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
  void find_junctions();
  void walk_chains();
  void walk(JunctionId from, unsigned direction);
  void drop_useless();
  bool is_useless(JunctionId v, unsigned slot) const;
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

void CoreWalk::find_junctions() {
  const std::size_t rows = places_.place_count() / 64;
  execution_.reserve(rows * 12);
  bits_.resize(rows);
  first_.resize(rows);
  std::vector<std::uint64_t> cells(chunk_count(rows, row_grain));
  for_chunks(rows, row_grain, execution_, [&](Range r) {
    for (std::size_t row = r.first; row < r.last; ++row) {
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < 64; ++i) {
        const std::size_t p = row * 64 + i;
        bits |= std::uint64_t{is_junction(static_cast<LatticePlace>(p), peeled_[p])} << i;
        cells[r.first / row_grain] += (peeled_[p] & peel_bit::edges) != 0 ? 1U : 0U;
      }
      bits_[row] = bits;
      first_[row] = static_cast<std::uint32_t>(std::popcount(bits));
    }
  });
  for (const std::uint64_t part : cells) graph_.core_cells += part;
  const std::uint64_t count = exclusive_scan(first_, execution_);
  if (count >= (std::uint64_t{1} << 30) || graph_.core_cells >= (std::uint64_t{1} << 30)) {
    throw InputError("route index", "takes less than 2^30 cells that lie on loops");
  }
  execution_.reserve(count * 36);
  graph_.place.resize(count);
  graph_.twin.resize(4 * count);
  graph_.length.resize(4 * count);
}

void CoreWalk::walk_chains() {
  for_chunks(bits_.size(), row_grain, execution_, [&](Range r) {
    for (std::size_t row = r.first; row < r.last; ++row) {
      JunctionId v = first_[row];
      for (std::uint64_t left = bits_[row]; left != 0; left &= left - 1, ++v) {
        graph_.place[v] = static_cast<LatticePlace>(row * 64 + static_cast<std::size_t>(std::countr_zero(left)));
        for (unsigned d = 0; d < 4; ++d) walk(v, d);
      }
    }
  });
}

/// To the next junction. An edge of a core cell that isn't in the nibble leads to a tree.
void CoreWalk::walk(JunctionId from, unsigned direction) {
  const HalfEdge slot = 4 * from + direction;
  LatticePlace at = graph_.place[from];
  graph_.twin[slot] = no_half_edge;
  if ((peeled_[at] >> direction & 1U) == 0) return;
  std::uint32_t length = 0;
  for (;;) {
    at = places_.step(at, direction);
    ++length;
    const unsigned back = direction ^ 2U;
    if ((bits_[at / 64] >> at % 64 & 1U) != 0) {
      graph_.twin[slot] = 4 * junction_at(at) + back;
      graph_.length[slot] = length;
      return;
    }
    direction = static_cast<unsigned>(std::countr_zero(peeled_[at] & peel_bit::edges & ~(1U << back)));
  }
}

/// Both ends of a chain come to the same answer.
bool CoreWalk::is_useless(JunctionId v, unsigned slot) const {
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

void CoreWalk::drop_useless() {
  const std::size_t count = graph_.size();
  RawVector<std::uint8_t> useless(count);
  for_chunks(count, junction_grain, execution_, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) {
      unsigned slots = 0;
      for (unsigned s = 0; s < 4; ++s) slots |= is_useless(static_cast<JunctionId>(v), s) ? 1U << s : 0;
      useless[v] = static_cast<std::uint8_t>(slots);
    }
  });
  for_chunks(count, junction_grain, execution_, [&](Range r) {
    for (std::size_t h = 4 * r.first; h < 4 * r.last; ++h) {
      if ((useless[h / 4] >> h % 4 & 1U) != 0) graph_.twin[h] = no_half_edge;
    }
  });
}

}  // namespace

CoreGraph core_graph(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places, const Execution& execution) {
  return CoreWalk(peeled, places, execution).run();
}

}  // namespace warren
