// SPDX-License-Identifier: BSD-3-Clause
#include "verify/streamed/looked_up_walls.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"

namespace warren {

class LookedUpWalls::Reader : public CellWallReader {
 public:
  explicit Reader(const LookedUpWalls& walls) : walls_(walls) {}
  void read(std::size_t number, CellTile& tile) override {
    walls_.place(number, tile);
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
      for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{tile.width}; ++col) {
        tile.walls[tile.index(col, row)] =
            as_whole<std::uint8_t>(walls_.walls_at(std::ptrdiff_t{tile.first_col} + col, tile.first_row + row));
      }
    }
  }

 private:
  const LookedUpWalls& walls_;
};

std::unique_ptr<CellWallReader> LookedUpWalls::reader() const { return std::make_unique<Reader>(*this); }

namespace {

bool bit(const RawVector<std::uint64_t>& bits, std::uint64_t at) { return (bits[at / 64] >> at % 64 & 1U) != 0; }
void set_bit(RawVector<std::uint64_t>& bits, std::uint64_t at) { bits[at / 64] |= std::uint64_t{1} << at % 64; }

constexpr std::size_t first_cell = 64;  // bytes before it
constexpr unsigned tile_side_log2 = 8;

std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = size; i > 0; --i) number = number << 8U | as_whole<unsigned char>(bytes[at + i - 1]);
  return number;
}

std::uint64_t row_bytes(std::uint64_t cols) { return (2 * cols + 7) / 8; }

/// Rows at byte 16, columns at byte 24.
std::uint32_t side_at(const std::string& name, std::string_view bytes, std::size_t at) {
  const bool is_known = bytes.size() >= first_cell && bytes.starts_with("\x89WRMAZE\n") && number_at(bytes, 8, 4) == 1;
  const std::uint64_t side = is_known ? number_at(bytes, at, 8) : 0;
  if (side < 1 || side >= std::uint64_t{1} << 27U) throw InputError(name, "is no .maze file that can be judged");
  return as_whole<std::uint32_t>(side);
}

/// Where the numbers begin: behind a header whose length stands at byte 8, in 2 bytes in version 1, in 4 in others.
std::size_t begin_of_numbers(const std::string& name, std::string_view bytes) {
  if (bytes.size() < 12 || !bytes.starts_with("\x93NUMPY"))
    throw InputError(name, "is no .npy file that can be judged");
  const std::size_t begin = bytes[6] == 1 ? 10 + number_at(bytes, 8, 2) : 12 + number_at(bytes, 8, 4);
  if (begin > bytes.size()) throw InputError(name, "is no .npy file that can be judged");
  return begin;
}

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

JudgedGridLines::JudgedGridLines(std::uint32_t rows, std::uint32_t cols, unsigned side_log2, Range held,
                                 const Execution& execution)
    : LookedUpWalls(rows, cols, side_log2), held_(held) {
  const std::size_t upright = ((cols + std::size_t{1}) * held.size() + 63) / 64;
  const std::size_t level = ((held.size() + 1) * cols + 63) / 64;
  execution.reserve((upright + level) * sizeof(std::uint64_t));
  const auto poll = [&] { execution.check(); };
  assign_polled(upright_, upright, std::uint64_t{0}, poll);
  assign_polled(level_, level, std::uint64_t{0}, poll);
}

JudgedGridLines::JudgedGridLines(const WallSet& walls, std::uint32_t rows, std::uint32_t cols,
                                 const Execution& execution)
    : JudgedGridLines(rows, cols, usual_side_log2, {0, rows}, execution) {
  constexpr std::size_t polled = std::size_t{1} << 16;
  Box around;
  walls.visit([&](auto held) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (i % polled == 0) execution.check();
      const Segment s = held[i].segment();
      take("walls", s.a.x, s.a.y, s.b.x, s.b.y, execution);
      around.include(box_of(s));
    }
  });
  if (around.min != box().min || around.max != box().max) throw InputError("walls", "do not reach around their maze");
}

void JudgedGridLines::take(const std::string& where, double x1, double y1, double x2, double y2,
                           const Execution& execution) {
  constexpr std::uint64_t units_per_poll = std::uint64_t{1} << 16;  // walls may be as long as the maze is wide
  const double dx = x2 > x1 ? 1 : x2 < x1 ? -1 : 0;
  const double dy = y2 > y1 ? 1 : y2 < y1 ? -1 : 0;
  const auto is_inside = [](double x, double side) {
    return x >= 0.5 && x <= side + 0.5 && static_cast<double>(bounded_whole<std::uint64_t>(x)) + 0.5 == x;
  };
  if ((dx == 0) == (dy == 0) || !is_inside(x1, cols()) || !is_inside(x2, cols()) || !is_inside(y1, rows()) ||
      !is_inside(y2, rows())) {
    throw InputError(where, "holds walls off the grid of its maze, which can't be judged");
  }
  for (; x1 != x2 || y1 != y2; x1 += dx, y1 += dy) {
    if (++units_ % units_per_poll == 0) execution.check();
    const auto col = bounded_whole<std::uint64_t>(dx < 0 ? x1 - 1 : x1);  // of the unit's lower or left end, from 0
    const auto row = bounded_whole<std::uint64_t>(dy < 0 ? y1 - 1 : y1);
    if (row < held_.first || row > held_.last) continue;
    if (dx != 0) {
      set_bit(level_, (row - held_.first) * cols() + col);
    } else if (row < held_.last) {
      set_bit(upright_, col * held_.size() + row - held_.first);
    }
  }
}

/// The lines right of and above the cell.
unsigned JudgedGridLines::walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const {
  const auto x = as_whole<std::uint64_t>(col + 1);
  const auto y = as_whole<std::uint64_t>(row + 1);
  assert(y >= held_.first && y <= held_.last);
  const bool right = y > held_.first && bit(upright_, x * held_.size() + y - 1 - held_.first);
  const bool above = x > 0 && bit(level_, (y - held_.first) * cols() + x - 1);
  return (right ? CellTile::right_wall : 0U) | (above ? CellTile::upper_wall : 0U);
}

JudgedMazeFile::JudgedMazeFile(const std::string& name, std::string_view bytes, Forget forget)
    : CellWallSource(side_at(name, bytes, 16), side_at(name, bytes, 24), tile_side_log2),
      bytes_(bytes),
      forget_(std::move(forget)) {
  const std::uint64_t bands = (std::uint64_t{rows()} + 255) / 256;
  if (bytes.size() != first_cell + rows() * row_bytes(cols()) + 4 * bands) {
    throw InputError(name, "has another size than its header says");
  }
}

class JudgedMazeFile::Reader : public CellWallReader {
 public:
  explicit Reader(const JudgedMazeFile& file) : file_(file) {}
  ~Reader() override {
    const std::uint64_t stride = row_bytes(file_.cols());
    if (file_.forget_ && first_ < last_) file_.forget_(first_cell + first_ * stride, first_cell + last_ * stride);
  }

  void read(std::size_t number, CellTile& tile) override {
    file_.place(number, tile);
    first_ = std::min<std::uint64_t>(first_, tile.first_row);
    last_ = std::max<std::uint64_t>(last_, std::uint64_t{tile.first_row} + tile.height);
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
      for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{tile.width}; ++col) {
        tile.walls[tile.index(col, row)] = walls_of(std::ptrdiff_t{tile.first_col} + col, tile.first_row + row);
      }
    }
  }

 private:
  /// Left of and below the maze its outline stands, but for the door of the first row. Of a cell the file's lower bit
  /// is its right wall, the other one its upper wall.
  std::uint8_t walls_of(std::ptrdiff_t col, std::ptrdiff_t row) const {
    if (col < 0) return row == 0 ? 0 : CellTile::right_wall;
    if (row < 0) return CellTile::upper_wall;
    const std::uint64_t bit = 2 * as_whole<std::uint64_t>(col);
    const std::uint64_t row_begin = first_cell + as_whole<std::uint64_t>(row) * row_bytes(file_.cols());
    const auto bits = as_whole<unsigned char>(file_.bytes_[row_begin + bit / 8]) >> bit % 8;
    static_assert(CellTile::right_wall == 1 && CellTile::upper_wall == 2);
    return as_whole<std::uint8_t>(bits & (CellTile::right_wall | CellTile::upper_wall));
  }

  const JudgedMazeFile& file_;
  std::uint64_t first_ = std::numeric_limits<std::uint64_t>::max();  // rows looked at
  std::uint64_t last_ = 0;
};

std::unique_ptr<CellWallReader> JudgedMazeFile::reader() const { return std::make_unique<Reader>(*this); }

JudgedNpyMaze::JudgedNpyMaze(const std::string& name, std::string_view bytes, std::uint32_t rows, std::uint32_t cols,
                             Range held, const JudgedMazeFile::Forget& forget, const Execution& execution)
    : JudgedGridLines(rows, cols, tile_side_log2, held, execution) {
  constexpr std::size_t window = std::size_t{1} << 23;  // bytes
  const std::size_t begin = begin_of_numbers(name, bytes);
  const bool is_float = bytes.substr(0, begin).find("<f4") != std::string_view::npos;
  const auto take_all = [&]<class T>(std::array<T, 4> wall, std::string_view numbers) {
    for (std::size_t at = 0; at + sizeof wall <= numbers.size(); at += sizeof wall) {
      if (at % (std::size_t{1} << 20) == 0) execution.check();
      std::memcpy(wall.data(), numbers.data() + at, sizeof wall);
      take(name, wall[0], wall[1], wall[2], wall[3], execution);
    }
  };
  for (std::size_t at = begin; at < bytes.size(); at += window) {
    const std::string_view numbers = bytes.substr(at, window);
    is_float ? take_all(std::array<float, 4>{}, numbers) : take_all(std::array<double, 4>{}, numbers);
    if (forget) forget(at, at + numbers.size());
  }
}

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
