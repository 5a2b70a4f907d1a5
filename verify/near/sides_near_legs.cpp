// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/sides_near_legs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/whole.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr std::uint64_t most_cells_a_side = 64;

template <class T>
void sort_once_each(std::vector<T>& some) {
  std::sort(some.begin(), some.end());
  some.erase(std::unique(some.begin(), some.end()), some.end());
}

}  // namespace

PathSurroundings::PathSurroundings(const Scene& scene, const Obstacles& obstacles, const ObstacleIndex* index,
                                   const Execution& execution)
    : scene_(scene), obstacles_(obstacles), index_(scene.map ? nullptr : index) {
  if (scene.map) {
    extent_.box = extent_.with_bounds = world_box(*scene.map);
  } else {
    extent_ = index != nullptr ? index->extent() : extent_of(obstacles, execution);
  }
}

/// Cells about as wide as the boxes, but not more than a million.
void PathSurroundings::lay_grid(std::span<const Box> boxes, const Execution& execution) {
  constexpr double most_cells = 1048576.0;
  grid_ = {};
  double sum = 0.0;
  for (const Box& box : boxes) {
    grid_.include(box);
    sum += std::max(box.width(), box.height());
  }
  const double mean = sum / static_cast<double>(boxes.size());
  const double longest = std::max(grid_.width(), grid_.height());
  side_ = std::max({mean, longest / 65536.0, std::sqrt(grid_.width() / most_cells) * std::sqrt(grid_.height())});
  if (!(side_ > 0.0) || !std::isfinite(side_)) side_ = 1.0;
  columns_ = bounded_whole<std::uint32_t>(grid_.width() / side_, 0.0, 65536.0) + 1;
  rows_ = bounded_whole<std::uint32_t>(grid_.height() / side_, 0.0, 65536.0) + 1;
  marked_.assign(std::size_t{columns_} * rows_, false);
  for (const Box& box : boxes) {
    execution.check();
    for_each_cell(range_of(box), [&](std::size_t cell) { marked_[cell] = true; });
  }
}

PathSurroundings::Range PathSurroundings::range_of(const Box& box) const {
  if (!box.meets(grid_)) return {1, 1, 0, 0};
  const auto index = [&](double x, double low, std::uint32_t count) {
    return bounded_whole<std::uint32_t>((x - low) / side_, 0.0, count - 1.0);
  };
  return {index(box.min.x, grid_.min.x, columns_), index(box.min.y, grid_.min.y, rows_),
          index(box.max.x, grid_.min.x, columns_), index(box.max.y, grid_.min.y, rows_)};
}

template <class Visit>
void PathSurroundings::for_each_cell(const Range& range, const Visit& visit) const {
  if (range.first_x > range.last_x) return;
  for (std::uint32_t y = range.first_y; y <= range.last_y; ++y) {
    for (std::uint32_t x = range.first_x; x <= range.last_x; ++x) visit(std::size_t{y} * columns_ + x);
  }
}

bool PathSurroundings::is_marked(const Range& range) const {
  bool marked = false;
  for_each_cell(range, [&](std::size_t cell) { marked = marked || marked_[cell]; });
  return marked;
}

void PathSurroundings::file(std::span<const Box> boxes, const Execution& execution) {
  if (scene_.map || boxes.empty()) return;
  lay_grid(boxes, execution);
  sift(index_ != nullptr ? may_be_marked(boxes, execution) : std::nullopt, execution);
  file_in_cells(execution);
}

/// Numbers of the obstacles whose cells share one with a box, by the index; nothing where a pass over all is as good. A
/// block's cells hold those of its members, so none is missed.
std::optional<std::vector<std::size_t>> PathSurroundings::may_be_marked(std::span<const Box> boxes,
                                                                        const Execution& execution) const {
  constexpr std::size_t numbers_a_poll = 4096;
  execution.reserve(boxes.size() * sizeof(Range));
  std::vector<Range> ranges;
  for (const Box& box : boxes) ranges.push_back(range_of(box));
  sort_once_each(ranges);
  std::vector<std::size_t> numbers;
  for (const Range& range : ranges) {
    execution.check();
    const auto skip = [&](const Box& box) {
      const Range cells = range_of(box);
      return cells.first_x > cells.last_x || !cells.overlaps(range) || numbers.size() >= obstacles_.size();
    };
    index_->sides().for_each(skip, [&](std::size_t number) {
      if (numbers.size() % numbers_a_poll == 0) execution.reserve(numbers_a_poll * sizeof(std::size_t));  // and polls
      numbers.push_back(number);
    });
  }
  if (numbers.size() >= obstacles_.size()) return std::nullopt;
  sort_once_each(numbers);
  return numbers;
}

/// Keeps those of the obstacles of these numbers, of all where there are none, that meet marked cells, and all that lie
/// across many.
void PathSurroundings::sift(const std::optional<std::vector<std::size_t>>& numbers, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  struct Part {
    std::vector<NearSide> near;
    std::vector<NearSide> far_across;
  };
  const auto sides_in = [&](warren::Range r) {
    Part part;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const std::size_t number = numbers ? (*numbers)[i] : i;
      const NearSide side{obstacles_.segment(number), number};
      const Range range = range_of(box_of(side.segment));
      if (range.first_x > range.last_x) continue;
      if (range.count() > most_cells_a_side) {
        part.far_across.push_back(side);
      } else if (is_marked(range)) {
        part.near.push_back(side);
      }
    }
    return part;
  };
  near_.clear();
  long_.clear();
  const std::size_t count = numbers ? numbers->size() : obstacles_.size();
  for (const Part& part : parts_of_chunks(count, grain, execution, sides_in)) {
    near_.insert(near_.end(), part.near.begin(), part.near.end());
    long_.insert(long_.end(), part.far_across.begin(), part.far_across.end());
  }
}

void PathSurroundings::file_in_cells(const Execution& execution) {
  constexpr std::size_t obstacles_a_poll = 4096;
  begin_.assign(marked_.size() + 1, 0);
  const auto for_each_place = [&](const auto& visit) {
    for (std::size_t n = 0; n < near_.size(); ++n) {
      if (n % obstacles_a_poll == 0) execution.check();
      for_each_cell(range_of(box_of(near_[n].segment)), [&](std::size_t cell) {
        if (marked_[cell]) visit(cell, as_whole<std::uint32_t>(n));
      });
    }
  };
  for_each_place([&](std::size_t cell, std::uint32_t) { ++begin_[cell + 1]; });
  for (std::size_t cell = 0; cell < marked_.size(); ++cell) begin_[cell + 1] += begin_[cell];
  execution.reserve(begin_.back() * sizeof(std::uint32_t));
  members_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for_each_place([&](std::size_t cell, std::uint32_t n) { members_[next[cell]++] = n; });
}

void PathSurroundings::gather(std::span<const Box> boxes, std::vector<NearSide>& sides,
                              const Execution& execution) const {
  sides.clear();
  if (scene_.map) {
    for (const Box& box : boxes) gather_from_map(box, sides, execution);
    return;
  }
  std::vector<std::uint32_t> cells;  // boxes one beside the other share them
  for (const Box& box : boxes) {
    for_each_cell(range_of(box),
                  [&](std::size_t cell) { push_asked(cells, as_whole<std::uint32_t>(cell), execution); });
  }
  sort_once_each(cells);
  std::vector<std::uint32_t> found;
  for (const std::uint32_t cell : cells) {
    for (std::uint32_t i = begin_[cell]; i < begin_[cell + 1]; ++i) push_asked(found, members_[i], execution);
  }
  sort_once_each(found);
  const auto meets = [&](const NearSide& side) {
    const Box around = box_of(side.segment);
    return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return box.meets(around); });
  };
  for (const std::uint32_t n : found) push_asked(sides, near_[n], execution);
  for (const NearSide& side : long_) {
    if (boxes.size() >= most_cells_a_side) execution.check();
    if (meets(side)) push_asked(sides, side, execution);
  }
}

/// 64 cells of a row, from column 64 w on: which are blocked. What lies outside is.
std::uint64_t PathSurroundings::blocked_word(std::int64_t y, std::int64_t w) const {
  const Bitmap& blocked = scene_.map->blocked;
  const std::int64_t words = (std::int64_t{blocked.width()} + 63) / 64;
  if (y < 0 || y >= blocked.height() || w < 0 || w >= words) return ~std::uint64_t{0};
  const std::uint64_t beyond =
      w + 1 == words && blocked.width() % 64 != 0 ? ~std::uint64_t{0} << blocked.width() % 64 : 0;
  return blocked.row(as_whole<std::uint32_t>(y))[as_whole<std::size_t>(w)] | beyond;
}

std::uint64_t PathSurroundings::number_of(std::int64_t x, std::int64_t y) const {
  const OccupancyMap& map = *scene_.map;
  if (x < 0 || y < 0 || x >= map.width() || y >= map.height()) return NearSide::outside;
  return as_whole<std::uint64_t>(y) * map.width() + as_whole<std::uint64_t>(x);
}

/// The borders between free and blocked cells, the ring of blocked ones around the map included.
void PathSurroundings::gather_from_map(const Box& box, std::vector<NearSide>& sides, const Execution& execution) const {
  const OccupancyMap& map = *scene_.map;
  Box in_cells;
  for (const Vec2 corner : box.corners()) in_cells.include(map_point(map, corner));
  const auto clamped = [](double x, double most) { return bounded_whole<std::int64_t>(x, 0.0, most); };
  constexpr double rounding = 1e-6;  // cells
  constexpr std::size_t words_a_poll = 4096;
  const std::int64_t first_x = clamped(std::floor(in_cells.min.x - rounding), map.width());
  const std::int64_t first_y = clamped(std::floor(in_cells.min.y - rounding), map.height());
  const std::int64_t last_x = clamped(std::floor(in_cells.max.x + rounding), map.width());
  const std::int64_t last_y = clamped(std::floor(in_cells.max.y + rounding), map.height());
  std::size_t words = 0;
  for (std::int64_t y = first_y; y <= last_y; ++y) {
    for (std::int64_t w = first_x / 64; w <= last_x / 64; ++w) {
      if (words++ % words_a_poll == 0) execution.check();
      std::uint64_t wanted = ~std::uint64_t{0};
      if (first_x > 64 * w) wanted <<= first_x - 64 * w;
      if (last_x < 64 * w + 63) wanted &= (std::uint64_t{2} << (last_x - 64 * w)) - 1;
      gather_from_word(y, w, wanted, sides, execution);
    }
  }
}

/// The borders below and left of those of 64 cells that are wanted.
void PathSurroundings::gather_from_word(std::int64_t y, std::int64_t w, std::uint64_t wanted,
                                        std::vector<NearSide>& sides, const Execution& execution) const {
  const auto point = [&](std::int64_t x, std::int64_t row) {
    return world_point(*scene_.map, {static_cast<double>(x), static_cast<double>(row)});
  };
  const std::int64_t base = 64 * w;
  const std::uint64_t here = blocked_word(y, w);
  const std::uint64_t left = here << 1 | blocked_word(y, w - 1) >> 63;
  for (std::uint64_t rest = (here ^ left) & wanted; rest != 0 && y < scene_.map->height(); rest &= rest - 1) {
    const std::int64_t x = base + std::countr_zero(rest);
    const bool blocks = (here >> (x - base) & 1U) != 0;
    push_asked(sides, {{point(x, y), point(x, y + 1)}, number_of(blocks ? x : x - 1, y)}, execution);
  }
  const std::uint64_t below = blocked_word(y - 1, w);
  for (const bool blocks : {false, true}) {  // which of the two rows
    std::uint64_t rest = (blocks ? here & ~below : below & ~here) & wanted;
    while (rest != 0) {  // run by run
      const int first = std::countr_zero(rest);
      const int length = std::countr_one(rest >> first);
      const std::int64_t x = base + first;
      push_asked(sides, {{point(x, y), point(x + length, y)}, number_of(x, blocks ? y : y - 1)}, execution);
      rest = first + length < 64 ? rest & ~std::uint64_t{0} << (first + length) : 0;
    }
  }
}

std::string PathSurroundings::name(std::uint64_t number) const {
  if (!scene_.map) return obstacles_.name(number);
  if (number == NearSide::outside) return "map: the body reaches outside";
  return fmt::format("cell {}, {}", number % scene_.map->width(), number / scene_.map->width());
}

}  // namespace warren
