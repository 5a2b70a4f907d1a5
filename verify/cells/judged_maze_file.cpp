// SPDX-License-Identifier: BSD-3-Clause
#include "verify/cells/judged_maze_file.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

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

}  // namespace

JudgedMazeFile::JudgedMazeFile(const std::string& name, std::string_view bytes, Forget forget)
    : CellWallSource(side_at(name, bytes, 16), side_at(name, bytes, 24), tile_side_log2),
      bytes_(bytes),
      forget_(std::move(forget)) {
  const std::uint64_t bands = (std::uint64_t{rows()} + 255) / 256;
  if (bytes.size() != first_cell + rows() * row_bytes(cols()) + 4 * bands) {
    throw InputError(name, "has another size than its header says");
  }
}

bool JudgedMazeFile::stands(std::uint64_t col, std::uint64_t row, bool above) const {
  const std::uint64_t bit = 2 * col + (above ? 1 : 0);
  const auto byte = as_whole<unsigned char>(bytes_[first_cell + row * row_bytes(cols()) + bit / 8]);
  return (byte >> (bit % 8) & 1U) != 0;
}

class JudgedMazeFile::Reader : public CellWallReader {
 public:
  explicit Reader(const JudgedMazeFile& file) : file_(file) {}
  ~Reader() override {
    const std::uint64_t stride = row_bytes(file_.cols());
    if (file_.forget_ && first_ < last_) file_.forget_(first_cell + first_ * stride, first_cell + last_ * stride);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

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
  /// Left of and below the maze its outline stands, but for the door of the first row.
  std::uint8_t walls_of(std::ptrdiff_t col, std::ptrdiff_t row) const {
    if (col < 0) return row == 0 ? 0 : CellTile::right_wall;
    if (row < 0) return CellTile::upper_wall;
    const auto c = as_whole<std::uint64_t>(col);
    const auto r = as_whole<std::uint64_t>(row);
    return as_whole<std::uint8_t>((file_.stands(c, r, false) ? CellTile::right_wall : 0) |
                                  (file_.stands(c, r, true) ? CellTile::upper_wall : 0));
  }

  const JudgedMazeFile& file_;
  std::uint64_t first_ = std::numeric_limits<std::uint64_t>::max();  // rows looked at
  std::uint64_t last_ = 0;
};

std::unique_ptr<CellWallReader> JudgedMazeFile::reader() const { return std::make_unique<Reader>(*this); }

}  // namespace warren
