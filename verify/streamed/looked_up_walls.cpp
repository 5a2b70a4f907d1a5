// SPDX-License-Identifier: BSD-3-Clause
#include "verify/streamed/looked_up_walls.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"

namespace warren {

class LookedUpWalls::Reader : public CellWallReader {
 public:
  explicit Reader(const LookedUpWalls& walls) : walls_(walls) {}
  ~Reader() override {
    if (rows_.first < rows_.last) walls_.forget_rows(rows_);
  }
  void read(std::size_t number, CellTile& tile) override {
    walls_.place(number, tile);
    rows_ = {std::min<std::size_t>(rows_.first, tile.first_row),
             std::max(rows_.last, std::size_t{tile.first_row} + tile.height)};
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
      walls_.read_row(std::ptrdiff_t{tile.first_col} - 1, tile.first_row + row,
                      std::span(tile.walls).subspan(tile.index(-1, row), std::size_t{tile.width} + 1));
    }
  }

 private:
  const LookedUpWalls& walls_;
  Range rows_{std::numeric_limits<std::size_t>::max(), 0};  // looked at
};

std::unique_ptr<CellWallReader> LookedUpWalls::reader() const { return std::make_unique<Reader>(*this); }

void LookedUpWalls::read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const {
  for (std::uint8_t& cell : walls) cell = as_whole<std::uint8_t>(walls_at(col++, row));
}

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

static_assert(std::endian::native == std::endian::little, "eight cells are copied as one number");
/// The low eight bits, from the lowest, as the low bits of eight bytes.
constexpr std::uint64_t spread(std::uint64_t bits) {
  const std::uint64_t one_a_byte = (bits & 0xffU) * 0x0101010101010101U & 0x8040201008040201U;
  return (one_a_byte + 0x7f7f7f7f7f7f7f7fU) >> 7U & 0x0101010101010101U;
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
    : LookedUpWalls(side_at(name, bytes, 16), side_at(name, bytes, 24), tile_side_log2),
      bytes_(bytes),
      forget_(std::move(forget)) {
  const std::uint64_t bands = (std::uint64_t{rows()} + 255) / 256;
  if (bytes.size() != first_cell + rows() * row_bytes(cols()) + 4 * bands) {
    throw InputError(name, "has another size than its header says");
  }
}

/// Left of and below the maze its outline stands, but for the door of the first row. Of a cell the file's lower bit is
/// its right wall, the other one its upper wall.
unsigned JudgedMazeFile::walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const {
  if (col < 0) return row == 0 ? 0U : CellTile::right_wall;
  if (row < 0) return CellTile::upper_wall;
  const std::uint64_t bit = 2 * as_whole<std::uint64_t>(col);
  const std::uint64_t row_begin = first_cell + as_whole<std::uint64_t>(row) * row_bytes(cols());
  static_assert(CellTile::right_wall == 1 && CellTile::upper_wall == 2);
  return unsigned{as_whole<unsigned char>(bytes_[row_begin + bit / 8])} >> bit % 8 & 3U;
}

void JudgedMazeFile::read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const {
  for (std::uint8_t& cell : walls) cell = as_whole<std::uint8_t>(JudgedMazeFile::walls_at(col++, row));
}

void JudgedMazeFile::forget_rows(Range rows) const {
  const std::uint64_t stride = row_bytes(cols());
  if (forget_) forget_(first_cell + rows.first * stride, first_cell + rows.last * stride);
}

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

void JudgedPassages::read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const {
  static_assert(usual_side_log2 == 6, "a tile is as wide as a word");
  if (row < 0 || row + 1 == std::ptrdiff_t{rows()}) return LookedUpWalls::read_row(col, row, walls);
  const std::size_t word = as_whole<std::size_t>(row) * words_a_row_ + as_whole<std::size_t>(col + 1) / 64;
  const std::uint64_t right = ~right_[word];
  const std::uint64_t above = ~up_[word];
  for (std::size_t i = 0; i + 1 < walls.size(); i += 8) {
    const std::uint64_t eight = spread(right >> i) | spread(above >> i) << 1U;
    std::memcpy(&walls[i + 1], &eight, std::min<std::size_t>(8, walls.size() - i - 1));
  }
  walls.front() = as_whole<std::uint8_t>(walls_at(col, row));  // these may be of the maze's rim
  walls.back() = as_whole<std::uint8_t>(walls_at(col + std::ssize(walls) - 1, row));
}

}  // namespace warren
