// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/cell_bits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>

namespace warren {
namespace {

static_assert(std::endian::native == std::endian::little, "four cells are copied as one number");

/// The four cells of a byte, a byte each.
constexpr std::array<std::uint32_t, 256> make_cells() {
  std::array<std::uint32_t, 256> cells{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    cells[byte] = (byte & 3U) | (byte >> 2U & 3U) << 8U | (byte >> 4U & 3U) << 16U | (byte >> 6U) << 24U;
  }
  return cells;
}
constexpr std::array<std::uint32_t, 256> cells_of_byte = make_cells();

void unpack(const std::uint8_t* bits, std::uint32_t count, std::uint8_t* out) {
  const std::uint32_t whole = count / 4;
  for (std::uint32_t i = 0; i < whole; ++i) std::memcpy(out + 4 * std::size_t{i}, &cells_of_byte[bits[i]], 4);
  for (std::uint32_t i = 4 * whole; i < count; ++i) out[i] = bits[whole] >> (2 * (i % 4)) & 3U;
}

}  // namespace

void pack_tile(const CellTile& tile, std::size_t row_bytes, std::uint8_t* rows) {
  for (std::uint32_t row = 0; row < tile.height; ++row) {
    const std::uint8_t* cells = tile.walls.data() + tile.index(0, row);
    std::uint8_t* out = rows + row * row_bytes + tile.first_col / 4;
    std::uint32_t col = 0;
    for (; col + 4 <= tile.width; col += 4, cells += 4) {
      *out++ = static_cast<std::uint8_t>(cells[0] | cells[1] << 2U | cells[2] << 4U | cells[3] << 6U);
    }
    if (col == tile.width) continue;
    unsigned last = 0;
    for (; col < tile.width; ++col) last |= static_cast<unsigned>(*cells++) << (2 * (col % 4));
    *out = static_cast<std::uint8_t>(last);
  }
}

class CellBits::Reader : public CellWallReader {
 public:
  explicit Reader(const CellBits& cells) : cells_(cells), row_bytes_(bytes_a_row(cells.cols())) {}
  ~Reader() override {
    if (cells_.forget_ && first_row_ < last_row_) cells_.forget_(first_row_ * row_bytes_, last_row_ * row_bytes_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void read(std::size_t number, CellTile& tile) override {
    cells_.place(number, tile);
    first_row_ = std::min<std::size_t>(first_row_, tile.first_row);
    last_row_ = std::max<std::size_t>(last_row_, std::size_t{tile.first_row} + tile.height);
    for (std::ptrdiff_t row = tile.first_row > 0 ? -1 : 0; row < std::ptrdiff_t{tile.height}; ++row) {
      const auto maze_row = static_cast<std::size_t>(std::ptrdiff_t{tile.first_row} + row);
      assert(maze_row >= cells_.first_row_);
      const std::uint8_t* const bits = cells_.bits_ + (maze_row - cells_.first_row_) * row_bytes_;
      std::uint8_t* const out = tile.walls.data() + tile.index(-1, row);
      const std::uint32_t left = tile.first_col - 1;
      if (tile.first_col > 0) *out = bits[left / 4] >> (2 * (left % 4)) & 3U;
      unpack(bits + tile.first_col / 4, tile.width, out + 1);
    }
    if (number == 0) tile.walls[tile.index(-1, 0)] = 0;
  }

 private:
  const CellBits& cells_;
  std::size_t row_bytes_;
  std::size_t first_row_ = std::numeric_limits<std::size_t>::max();
  std::size_t last_row_ = 0;
};

std::unique_ptr<CellWallReader> CellBits::reader() const { return std::make_unique<Reader>(*this); }

}  // namespace warren
