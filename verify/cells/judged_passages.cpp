// SPDX-License-Identifier: BSD-3-Clause
#include "verify/cells/judged_passages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

/// Eight bits as the low bits of eight bytes, in the order of memory.
using EightBytes = std::array<std::uint8_t, 8>;
constexpr std::array<EightBytes, 256> bytes_of_bits() {
  std::array<EightBytes, 256> bytes{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    for (unsigned i = 0; i < 8; ++i) bytes[bits][i] = as_whole<std::uint8_t>(bits >> i & 1U);
  }
  return bytes;
}
constexpr std::array<EightBytes, 256> spread = bytes_of_bits();

/// The walls of eight cells of a row.
std::uint64_t walls_of(std::uint64_t right, std::uint64_t above) {
  return std::bit_cast<std::uint64_t>(spread[right & 0xffU]) | std::bit_cast<std::uint64_t>(spread[above & 0xffU])
                                                                   << 1U;
}

}  // namespace

JudgedPassages::JudgedPassages(const std::string& where, std::uint32_t rows, std::uint32_t cols,
                               std::span<const std::uint64_t> right, std::span<const std::uint64_t> up)
    : LookedUpWalls(rows, cols, usual_side_log2), right_(right), up_(up), words_a_row_((std::size_t{cols} + 63) / 64) {
  if (right.size() == words_a_row_ * rows && up.size() == right.size()) return;
  throw InputError(where, "expected two bits for each cell of the maze");
}

/// All around stands the outline, but for the doors left of the first row and right of the last.
unsigned JudgedPassages::walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const {
  if (col < 0) return row == 0 ? 0U : CellTile::right_wall;
  if (row < 0) return CellTile::upper_wall;
  const std::size_t word = as_whole<std::size_t>(row) * words_a_row_ + as_whole<std::size_t>(col) / 64;
  const unsigned bit = as_whole<unsigned>(col) % 64;
  const bool is_last_col = col + 1 == std::ptrdiff_t{cols()};
  const bool is_last_row = row + 1 == std::ptrdiff_t{rows()};
  const bool right = is_last_col ? !is_last_row : (right_[word] >> bit & 1U) == 0;
  const bool above = is_last_row || (up_[word] >> bit & 1U) == 0;
  return (right ? CellTile::right_wall : 0U) | (above ? CellTile::upper_wall : 0U);
}

class JudgedPassages::Reader : public CellWallReader {
 public:
  explicit Reader(const JudgedPassages& passages) : passages_(passages) {}
  void read(std::size_t number, CellTile& tile) override {
    passages_.place(number, tile);
    const auto width = std::ptrdiff_t{tile.width};
    for (std::ptrdiff_t row = 0; row < std::ptrdiff_t{tile.height}; ++row) {
      const std::size_t word =
          (tile.first_row + as_whole<std::size_t>(row)) * passages_.words_a_row_ + tile.first_col / 64;
      const std::uint64_t right = ~passages_.right_[word];
      const std::uint64_t above = ~passages_.up_[word];
      std::uint8_t* to = tile.walls.data() + tile.index(0, row);
      for (std::ptrdiff_t col = 0; col < width; col += 8) {
        const std::uint64_t walls = walls_of(right >> col, above >> col);
        std::memcpy(to + col, &walls, as_whole<std::size_t>(std::min<std::ptrdiff_t>(8, width - col)));
      }
      look_up(tile, -1, row);
      look_up(tile, width - 1, row);
    }
    for (std::ptrdiff_t col = -1; col < width; ++col) {
      look_up(tile, col, -1);
      look_up(tile, col, std::ptrdiff_t{tile.height} - 1);
    }
  }

 private:
  /// On the rim of the tile, which may be the maze's.
  void look_up(CellTile& tile, std::ptrdiff_t col, std::ptrdiff_t row) const {
    tile.walls[tile.index(col, row)] = as_whole<std::uint8_t>(
        passages_.walls_at(std::ptrdiff_t{tile.first_col} + col, std::ptrdiff_t{tile.first_row} + row));
  }
  const JudgedPassages& passages_;
};

std::unique_ptr<CellWallReader> JudgedPassages::reader() const {
  static_assert(usual_side_log2 == 6, "a tile is as wide as a word");
  return std::make_unique<Reader>(*this);
}

}  // namespace warren
