// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_trees/peeling.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "parallel/chunks.hpp"
#include "parallel/first_touch.hpp"

namespace warren {
namespace {

/// Eight bits as the lowest bits of eight bytes.
constexpr std::array<std::uint64_t, 256> bits_as_bytes = [] {
  std::array<std::uint64_t, 256> table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    for (unsigned i = 0; i < 8; ++i) table[bits] |= std::uint64_t{bits >> i & 1U} << (8 * i);
  }
  return table;
}();

/// Tiles [first_col, end_col) x [first_row, end_row).
struct TileSquare {
  std::uint32_t first_col, first_row, end_col, end_row;
};

class Peeling {
 public:
  Peeling(const LatticePassages& passages, const LatticePlaces& places, const Execution& execution)
      : passages_(passages), places_(places), execution_(execution) {
    execution.reserve(places.place_count());
    bytes_.resize(places.place_count());
    touch_first(bytes_, execution);
  }

  RawVector<std::uint8_t> run() {
    for_chunks(places_.tile_count(), 16, execution_, [&](Range r) {
      for (std::size_t tile = r.first; tile < r.last; ++tile) {
        load(static_cast<std::uint32_t>(tile));
        peel_tile(static_cast<LatticePlace>(tile * LatticePlaces::tile_places));
      }
    });
    for (std::uint32_t side = growth; side / growth < most_tiles(); side *= growth) peel_squares(side);
    return std::move(bytes_);
  }

 private:
  static constexpr std::uint32_t growth = 8;

  std::uint32_t most_tiles() const { return std::max(places_.tile_cols(), places_.tile_rows()); }
  void load(std::uint32_t tile);
  void load_row(std::uint8_t* at, std::uint32_t col, std::uint32_t row) const;
  void peel_tile(LatticePlace first);
  void peel_squares(std::uint32_t side);
  void peel_border(std::uint32_t tile, unsigned direction, const TileSquare& square);
  void follow(LatticePlace at, const TileSquare& square);
  bool leaves(std::uint32_t tile, unsigned direction, const TileSquare& square) const;

  const LatticePassages& passages_;
  const LatticePlaces& places_;
  const Execution& execution_;
  RawVector<std::uint8_t> bytes_;
};

void Peeling::load(std::uint32_t tile) {
  std::uint8_t* at = bytes_.data() + std::size_t{tile} * LatticePlaces::tile_places;
  const std::uint32_t col = tile % places_.tile_cols() * LatticePlaces::side;
  const std::uint32_t row = tile / places_.tile_cols() * LatticePlaces::side;
  for (std::uint32_t i = 0; i < LatticePlaces::side; ++i) load_row(at + i * LatticePlaces::side, col, row + i);
}

void Peeling::load_row(std::uint8_t* at, std::uint32_t col, std::uint32_t row) const {
  std::memset(at, 0, LatticePlaces::side);  // what fills up the lattice is no tree
  if (row >= places_.size().rows) return;
  const std::array<std::uint64_t, 4> open = passages_.open_words(col, row);
  const std::uint32_t width = std::min(LatticePlaces::side, places_.size().cols - col);
  std::array<std::uint8_t, LatticePlaces::side> line;
  for (unsigned i = 0; i < LatticePlaces::side; i += 8) {
    std::uint64_t eight = 0;
    for (unsigned d = 0; d < 4; ++d) eight |= bits_as_bytes[open[d] >> i & 255U] << d;
    std::memcpy(line.data() + i, &eight, 8);
  }
  std::memcpy(at, line.data(), width);
}

/// Dead ends of a tile whose way goes on in it.
void Peeling::peel_tile(LatticePlace first) {
  std::uint8_t* const tile = bytes_.data() + first;
  for (LatticePlace start = 0; start < LatticePlaces::tile_places; ++start) {
    LatticePlace at = start;
    for (unsigned open = tile[at]; std::has_single_bit(open); open = tile[at]) {
      const auto direction = static_cast<unsigned>(std::countr_zero(open));
      if (direction > 3 || LatticePlaces::leaves_tile(at, direction)) break;
      tile[at] = static_cast<std::uint8_t>(peel_bit::peeled | direction << peel_bit::direction_shift);
      at = places_.step_inside(at, direction);
      tile[at] = static_cast<std::uint8_t>(tile[at] & ~(1U << (direction ^ 2U)));
    }
  }
}

/// Squares of side x side tiles: the dead ends at the borders of the smaller squares in them.
void Peeling::peel_squares(std::uint32_t side) {
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

void Peeling::peel_border(std::uint32_t tile, unsigned direction, const TileSquare& square) {
  const unsigned last = LatticePlaces::side - 1;
  const std::array<LatticePlace, 4> corner{last, last * LatticePlaces::side, 0, 0};
  const LatticePlace along = (direction & 1U) == 0 ? LatticePlaces::side : 1;
  LatticePlace at = tile * LatticePlaces::tile_places + corner[direction];
  for (unsigned i = 0; i <= last; ++i, at += along) {
    if (bytes_[at] == 1U << direction) follow(at, square);
  }
}

bool Peeling::leaves(std::uint32_t tile, unsigned direction, const TileSquare& square) const {
  const std::uint32_t col = tile % places_.tile_cols();
  const std::uint32_t row = tile / places_.tile_cols();
  switch (direction) {
    case 0:
      return col + 1 == square.end_col;
    case 1:
      return row + 1 == square.end_row;
    case 2:
      return col == square.first_col;
    default:
      return row == square.first_row;
  }
}

void Peeling::follow(LatticePlace at, const TileSquare& square) {
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

}  // namespace

RawVector<std::uint8_t> peel(const LatticePassages& passages, const LatticePlaces& places, const Execution& execution) {
  return Peeling(passages, places, execution).run();
}

}  // namespace warren
