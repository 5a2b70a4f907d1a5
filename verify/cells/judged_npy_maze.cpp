// SPDX-License-Identifier: BSD-3-Clause
#include "verify/cells/judged_npy_maze.hpp"

#include <cstring>

#include "core/base/error.hpp"

namespace warren {
namespace {

constexpr unsigned tile_side_log2 = 8;

bool bit(const RawVector<std::uint64_t>& bits, std::uint64_t at) { return (bits[at / 64] >> at % 64 & 1U) != 0; }
void set_bit(RawVector<std::uint64_t>& bits, std::uint64_t at) { bits[at / 64] |= std::uint64_t{1} << at % 64; }

/// Where the numbers begin: behind a header whose length stands at byte 8, in 2 bytes in version 1, in 4 in others.
std::size_t begin_of_numbers(const std::string& name, std::string_view bytes) {
  const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(bytes[at])}; };
  if (bytes.size() < 12 || !bytes.starts_with("\x93NUMPY"))
    throw InputError(name, "is no .npy file that can be judged");
  const std::size_t begin = byte(6) == 1
                                ? 10 + byte(8) + 256 * byte(9)
                                : 12 + byte(8) + 256 * byte(9) + 65536 * byte(10) + std::size_t{16777216} * byte(11);
  if (begin > bytes.size()) throw InputError(name, "is no .npy file that can be judged");
  return begin;
}

}  // namespace

JudgedNpyMaze::JudgedNpyMaze(const std::string& name, std::string_view bytes, std::uint32_t rows, std::uint32_t cols,
                             const Forget& forget, const Execution& execution)
    : CellWallSource(rows, cols, tile_side_log2) {
  constexpr std::size_t window = std::size_t{1} << 23;  // bytes
  const std::size_t upright = ((cols + std::size_t{1}) * rows + 63) / 64;
  const std::size_t level = ((rows + std::size_t{1}) * cols + 63) / 64;
  execution.reserve((upright + level) * sizeof(std::uint64_t));
  const auto poll = [&] { execution.check(); };
  assign_polled(upright_, upright, std::uint64_t{0}, poll);
  assign_polled(level_, level, std::uint64_t{0}, poll);
  const std::size_t begin = begin_of_numbers(name, bytes);
  const bool is_float = bytes.substr(0, begin).find("<f4") != std::string_view::npos;
  for (std::size_t at = begin; at < bytes.size(); at += window) {
    const std::string_view numbers = bytes.substr(at, window);
    is_float ? take<float>(name, numbers, execution) : take<double>(name, numbers, execution);
    if (forget) forget(at, at + numbers.size());
  }
}

template <class T>
void JudgedNpyMaze::take(const std::string& name, std::string_view numbers, const Execution& execution) {
  T wall[4];
  for (std::size_t at = 0; at + sizeof wall <= numbers.size(); at += sizeof wall) {
    if (at % (std::size_t{1} << 20) == 0) execution.check();
    std::memcpy(wall, numbers.data() + at, sizeof wall);
    take(name, wall[0], wall[1], wall[2], wall[3]);
  }
}

/// Unit by unit, from one end to the other.
void JudgedNpyMaze::take(const std::string& name, double x1, double y1, double x2, double y2) {
  const double dx = x2 > x1 ? 1 : x2 < x1 ? -1 : 0;
  const double dy = y2 > y1 ? 1 : y2 < y1 ? -1 : 0;
  const auto is_inside = [](double x, double side) {
    return x >= 0.5 && x <= side + 0.5 && static_cast<double>(static_cast<std::uint64_t>(x)) + 0.5 == x;
  };
  if ((dx == 0) == (dy == 0) || !is_inside(x1, cols()) || !is_inside(x2, cols()) || !is_inside(y1, rows()) ||
      !is_inside(y2, rows())) {
    throw InputError(name, "holds walls off the grid of its maze, which can't be judged");
  }
  for (; x1 != x2 || y1 != y2; x1 += dx, y1 += dy) {
    const auto col = static_cast<std::uint64_t>(dx < 0 ? x1 - 1 : x1);  // of the unit's lower or left end, from 0
    const auto row = static_cast<std::uint64_t>(dy < 0 ? y1 - 1 : y1);
    if (dx == 0) {
      set_bit(upright_, col * rows() + row);
    } else {
      set_bit(level_, row * cols() + col);
    }
  }
}

class JudgedNpyMaze::Reader : public CellWallReader {
 public:
  explicit Reader(const JudgedNpyMaze& maze) : maze_(maze) {}
  void read(std::size_t number, CellTile& tile) override {
    maze_.place(number, tile);
    for (std::uint32_t row = 0; row <= tile.height; ++row) {
      for (std::uint32_t col = 0; col <= tile.width; ++col) {  // the lines left of and below column and row
        const std::uint64_t x = std::uint64_t{tile.first_col} + col;
        const std::uint64_t y = std::uint64_t{tile.first_row} + row;
        const bool right = row > 0 && bit(maze_.upright_, x * maze_.rows() + y - 1);
        const bool above = col > 0 && bit(maze_.level_, y * maze_.cols() + x - 1);
        tile.walls[tile.index(std::ptrdiff_t{col} - 1, std::ptrdiff_t{row} - 1)] =
            static_cast<std::uint8_t>((right ? CellTile::right_wall : 0) | (above ? CellTile::upper_wall : 0));
      }
    }
  }

 private:
  const JudgedNpyMaze& maze_;
};

std::unique_ptr<CellWallReader> JudgedNpyMaze::reader() const { return std::make_unique<Reader>(*this); }

}  // namespace warren
