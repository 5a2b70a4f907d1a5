// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/cell_bits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {
namespace {

static_assert(std::endian::native == std::endian::little, "four cells are copied as one number");

/// The four cells of a byte, a byte each.
constexpr std::array<std::uint32_t, 256> cells_of_byte = [] {
  std::array<std::uint32_t, 256> cells{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    cells[byte] = (byte & 3U) | (byte >> 2U & 3U) << 8U | (byte >> 4U & 3U) << 16U | (byte >> 6U) << 24U;
  }
  return cells;
}();

void unpack(const std::uint8_t* bits, std::uint32_t count, std::uint8_t* out) {
  const std::uint32_t whole = count / 4;
  for (std::uint32_t i = 0; i < whole; ++i) std::memcpy(out + 4 * std::size_t{i}, &cells_of_byte[bits[i]], 4);
  for (std::uint32_t i = 4 * whole; i < count; ++i) out[i] = bits[whole] >> (2 * (i % 4)) & 3U;
}

constexpr std::size_t grain = WallsHash::grain;
constexpr std::size_t most_parts = 16;  // each holds up to a chunk of walls

/// Two bits of each of 8 bytes, side by side.
std::uint64_t pairs_of(std::uint64_t bytes) {
  bytes = (bytes | bytes >> 6U) & 0x000f000f000f000fU;
  bytes = (bytes | bytes >> 12U) & 0x000000ff000000ffU;
  return (bytes | bytes >> 24U) & 0xffffU;
}

/// One column of tiles.
class Strip {
 public:
  explicit Strip(const CellWallSource& cells) : cells_(cells), reader_(cells.reader()) {}

  std::size_t wall_count(std::size_t number, const Execution& execution) {
    std::size_t count = 0;
    for_each_tile(number, execution, [&] {
      for (std::uint32_t row = 0; row < tile_.height; ++row) {
        const std::uint8_t* const walls = tile_.walls.data() + tile_.index(0, row);
        for (std::uint32_t col = 0; col < tile_.width; ++col) count += (walls[col] & 1U) + (walls[col] >> 1U & 1U);
      }
    });
    return count;
  }
  /// A byte a cell, column by column.
  void read(std::size_t number, const Execution& execution) {
    const std::size_t rows = cells_.rows();
    for_each_tile(number, execution, [&] {
      bytes_.resize(tile_.width * rows);
      for (std::uint32_t row = 0; row < tile_.height; ++row) {
        const std::uint8_t* from = tile_.walls.data() + tile_.index(0, row);
        std::uint8_t* to = bytes_.data() + tile_.first_row + row;
        for (std::uint32_t col = 0; col < tile_.width; ++col) to[col * rows] = from[col];
      }
    });
  }
  /// Calls take(x, first row, bits) for each column's cells of what was read, 32 at a time, in the course's order: the
  /// bits are the right and the upper wall of a cell, of the next one, and so on; the right ones stand at x.
  template <class Take>
  void for_each_word(const Take& take) const {
    const std::size_t rows = cells_.rows();
    for (std::size_t first = 0; first < bytes_.size(); first += rows) {
      const double x = static_cast<double>(tile_.first_col + first / rows) + 1.5;
      for (std::size_t row = 0; row < rows; row += 32)
        take(x, row, word_at(first + row, std::min<std::size_t>(32, rows - row)));
    }
  }

 private:
  template <class See>
  void for_each_tile(std::size_t number, const Execution& execution, const See& see) {
    for (std::size_t place = number; place < cells_.tile_count(); place += cells_.tile_cols()) {
      execution.check();
      reader_->read(place, tile_);
      leave_out_the_outline();
      see();
    }
  }
  void leave_out_the_outline() {
    const auto keep = [&](std::uint32_t col, std::uint32_t row, std::uint8_t kept) {
      tile_.walls[tile_.index(col, row)] &= kept;
    };
    if (tile_.first_row + tile_.height == cells_.rows()) {
      for (std::uint32_t col = 0; col < tile_.width; ++col) keep(col, tile_.height - 1, CellTile::right_wall);
    }
    if (tile_.first_col + tile_.width < cells_.cols()) return;
    for (std::uint32_t row = 0; row < tile_.height; ++row) keep(tile_.width - 1, row, CellTile::upper_wall);
  }
  std::uint64_t word_at(std::size_t at, std::size_t cells) const {
    std::uint8_t bytes[32] = {};
    std::memcpy(bytes, bytes_.data() + at, cells);
    std::uint64_t word = 0;
    for (unsigned i = 0; i < 4; ++i) {
      std::uint64_t eight = 0;
      for (unsigned k = 0; k < 8; ++k) eight |= std::uint64_t{bytes[8 * i + k]} << (8 * k);
      word |= pairs_of(eight) << (16 * i);
    }
    return word;
  }

  const CellWallSource& cells_;
  std::unique_ptr<CellWallReader> reader_;
  CellTile tile_;
  std::vector<std::uint8_t> bytes_;
};

/// The wall of the lowest of the bits that for_each_word() gave.
DoubleWall wall_of(double x, std::size_t first_row, std::uint64_t bits) {
  const auto bit = static_cast<unsigned>(std::countr_zero(bits));
  const double upper = static_cast<double>(bit & 1U);
  const double high = static_cast<double>(first_row + (bit >> 1U)) + 1.5;
  return {x - upper, high - 1.0 + upper, x, high};
}

/// The walls of some strips: those before the first chunk of the hash that begins in them, and chunks.
struct Part {
  std::vector<DoubleWall> head;
  std::vector<std::uint64_t> whole;  ///< values of chunks
  WallsChunk open;                   ///< the last one

  /// first: the number of its first wall among all.
  void add(Strip& strip, std::size_t first) {
    const std::size_t before = (grain - first % grain) % grain;
    head.reserve(before);
    strip.for_each_word([&](double x, std::size_t row, std::uint64_t bits) {
      for (; bits != 0 && head.size() < before; bits &= bits - 1) head.push_back(wall_of(x, row, bits));
      const auto count = static_cast<std::size_t>(std::popcount(bits));
      if (open.walls + count < grain) {
        WallsChunk chunk = open;  // in registers
        for (; bits != 0; bits &= bits - 1) chunk.fold(wall_of(x, row, bits).segment());
        chunk.walls += count;
        open = chunk;
      }
      for (; bits != 0; bits &= bits - 1) {
        open.fold(wall_of(x, row, bits).segment());
        if (++open.walls == grain) whole.push_back(std::exchange(open, {}).value());
      }
    });
  }
};

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

/// Strips of columns are looked at twice: how many walls each has says where the chunks of the hash begin in it. The
/// walls that a part has before its first chunk are those of its neighbour's last one, which they end.
HashedCells hash_of_cells(const CellWallSource& cells, const Execution& execution) {
  const std::size_t strips = cells.tile_cols();
  const std::size_t size = std::max<std::size_t>(1, (strips + most_parts - 1) / most_parts);
  execution.reserve(most_parts * grain * sizeof(DoubleWall));
  const auto frame = maze_outline<DoubleWall>(cells.rows(), cells.cols());
  std::vector<std::size_t> first(strips + 1, frame.size());
  for_chunks(strips, size, execution, [&](Range r) {
    Strip strip(cells);
    for (std::size_t i = r.first; i < r.last; ++i) first[i + 1] = strip.wall_count(i, execution);
  });
  for (std::size_t i = 0; i < strips; ++i) first[i + 1] += first[i];
  std::vector<Part> parts(chunk_count(strips, size));
  for_chunks(strips, size, execution, [&](Range r) {
    Strip strip(cells);
    for (std::size_t i = r.first; i < r.last; ++i) {
      strip.read(i, execution);
      parts[r.first / size].add(strip, first[r.first]);
    }
  });
  WallsHash hash(first.back());
  hash.add(std::span<const DoubleWall>(frame), execution);
  for (const Part& part : parts) {
    hash.add(std::span<const DoubleWall>(part.head), execution);
    for (const std::uint64_t chunk : part.whole) hash.add(chunk);
    if (part.open.walls > 0) hash.begin(part.open);
  }
  return {hash.text(), first.back()};
}

}  // namespace warren
