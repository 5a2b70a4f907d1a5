// SPDX-License-Identifier: BSD-3-Clause
// Strips of columns are looked at twice: how many walls each has says where the chunks of the hash begin in it. What a
// strip has before its first chunk and behind its last is joined with its neighbours'.
#include "scenes/mazes/hash_of_cells.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "parallel/chunks.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {
namespace {

constexpr std::size_t grain = WallsHash::grain;
constexpr std::size_t most_parts = 16;  // each holds up to two chunks of walls

/// A byte a cell, column by column, of one column of tiles.
class Strip {
 public:
  explicit Strip(const CellWallSource& cells) : cells_(cells), reader_(cells.reader()) {}

  void read(std::size_t number, const Execution& execution) {
    const std::size_t rows = cells_.rows();
    for (std::size_t place = number; place < cells_.tile_count(); place += cells_.tile_cols()) {
      execution.check();
      reader_->read(place, tile_);
      first_col_ = tile_.first_col;
      bytes_.resize(tile_.width * rows);
      for (std::uint32_t row = 0; row < tile_.height; ++row) {
        const std::uint8_t* from = tile_.walls.data() + tile_.index(0, row);
        std::uint8_t* to = bytes_.data() + tile_.first_row + row;
        for (std::uint32_t col = 0; col < tile_.width; ++col) to[col * rows] = from[col];
      }
    }
    leave_out_the_outline();
  }
  std::size_t wall_count() const {
    std::size_t count = 0;
    for (const std::uint8_t walls : bytes_) count += (walls & 1U) + (walls >> 1U & 1U);
    return count;
  }
  /// Hands on the walls of each column, in the course's order: written without branches, for half of them stand.
  template <class Take>
  void for_each_column(const Take& take) {
    const std::size_t rows = cells_.rows();
    walls_.resize(2 * rows + 1);
    for (std::size_t first = 0; first < bytes_.size(); first += rows) {
      const double right = static_cast<double>(first_col_ + first / rows) + 1.5;
      std::size_t count = 0;
      for (std::size_t row = 0; row < rows; ++row) {
        const double high = static_cast<double>(row) + 1.5;
        walls_[count] = {right, high - 1, right, high};
        count += bytes_[first + row] & 1U;
        walls_[count] = {right - 1, high, right, high};
        count += bytes_[first + row] >> 1U & 1U;
      }
      take(std::span<const DoubleWall>(walls_).first(count));
    }
  }

 private:
  void leave_out_the_outline() {
    const std::size_t rows = cells_.rows();
    for (std::size_t i = rows; i <= bytes_.size(); i += rows)
      bytes_[i - 1] = static_cast<std::uint8_t>(bytes_[i - 1] & ~CellTile::upper_wall);
    if (first_col_ + bytes_.size() / rows < cells_.cols()) return;
    for (std::size_t i = bytes_.size() - rows; i < bytes_.size(); ++i)
      bytes_[i] = static_cast<std::uint8_t>(bytes_[i] & ~CellTile::right_wall);
  }

  const CellWallSource& cells_;
  std::unique_ptr<CellWallReader> reader_;
  CellTile tile_;
  std::size_t first_col_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::vector<DoubleWall> walls_;  // of a column
};

/// The walls of some strips: those before the first chunk that begins in them, chunks, and what is left.
struct Part {
  std::vector<DoubleWall> head;
  std::vector<std::uint64_t> chunks;
  std::vector<DoubleWall> tail;

  /// Walls in a row, of which the first has this number among all.
  void add(std::size_t number, std::span<const DoubleWall> walls) {
    if (!is_begun) {
      const std::size_t before = std::min(walls.size(), (grain - number % grain) % grain);
      head.insert(head.end(), walls.begin(), walls.begin() + static_cast<std::ptrdiff_t>(before));
      walls = walls.subspan(before);
      is_begun = !walls.empty();
    }
    while (!walls.empty()) {
      const std::size_t count = std::min(walls.size(), grain - tail.size());
      tail.insert(tail.end(), walls.begin(), walls.begin() + static_cast<std::ptrdiff_t>(count));
      walls = walls.subspan(count);
      if (tail.size() < grain) continue;
      chunks.push_back(WallsHash::of_chunk(std::span<const DoubleWall>(tail)));
      tail.clear();
    }
  }
  bool is_begun = false;
};

std::vector<DoubleWall> outline(const CellWallSource& cells) {
  const double right = cells.cols() + 0.5;
  const double top = cells.rows() + 0.5;
  return {{0.5, 0.5, right, 0.5}, {0.5, top, right, top}, {0.5, 1.5, 0.5, top}, {right, 0.5, right, top - 1}};
}

/// Joins the parts.
class Joined {
 public:
  explicit Joined(std::size_t walls) : hash_(walls) {}
  void add(std::span<const DoubleWall> walls) {
    for (const DoubleWall& wall : walls) {
      open_.push_back(wall);
      if (open_.size() == grain) close();
    }
  }
  void add(const Part& part) {
    add(part.head);
    for (const std::uint64_t chunk : part.chunks) hash_.add(chunk);
    add(part.tail);
  }
  std::string text() {
    if (!open_.empty()) close();
    return hash_.text();
  }

 private:
  void close() {
    hash_.add(WallsHash::of_chunk(std::span<const DoubleWall>(open_)));
    open_.clear();
  }
  WallsHash hash_;
  std::vector<DoubleWall> open_;  // of a chunk that is not whole
};

}  // namespace

HashedCells hash_of_cells(const CellWallSource& cells, const Execution& execution) {
  const std::size_t strips = cells.tile_cols();
  const std::size_t size = std::max<std::size_t>(1, (strips + most_parts - 1) / most_parts);
  execution.reserve(2 * most_parts * grain * sizeof(DoubleWall));
  const std::vector<DoubleWall> frame = outline(cells);
  std::vector<std::size_t> first(strips + 1, frame.size());
  for_chunks(strips, size, execution, [&](Range r) {
    Strip strip(cells);
    for (std::size_t i = r.first; i < r.last; ++i) {
      strip.read(i, execution);
      first[i + 1] = strip.wall_count();
    }
  });
  for (std::size_t i = 0; i < strips; ++i) first[i + 1] += first[i];
  std::vector<Part> parts(chunk_count(strips, size));
  for_chunks(strips, size, execution, [&](Range r) {
    Strip strip(cells);
    for (std::size_t i = r.first; i < r.last; ++i) {
      strip.read(i, execution);
      std::size_t number = first[i];
      strip.for_each_column([&](std::span<const DoubleWall> walls) {
        parts[r.first / size].add(number, walls);
        number += walls.size();
      });
    }
  });
  Joined joined(first.back());
  joined.add(frame);
  for (const Part& part : parts) joined.add(part);
  return {joined.text(), first.back()};
}

}  // namespace warren
