// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/judged_input.hpp"
#include "verify/judges/leg_against_side.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/near/leg_boxes.hpp"

namespace warren {
namespace {

constexpr std::size_t bounds_number = std::numeric_limits<std::size_t>::max() - 2;  // on one leg reported after walls

/// Walls have numbers by their place: the cell left of or below them, and on which side of it they stand.
std::size_t number_of(std::uint32_t col_and_one, std::uint32_t row_and_one, bool is_upper) {
  return std::size_t{row_and_one} << 33U | std::size_t{col_and_one} << 1U | (is_upper ? 1U : 0U);
}
Segment wall_of(std::size_t number) {
  const double x = static_cast<double>(number >> 1U & 0xffffffffU) + 0.5;
  const double y = static_cast<double>(number >> 33U) + 0.5;
  return (number & 1U) != 0 ? Segment{{x - 1, y}, {x, y}} : Segment{{x, y - 1}, {x, y}};
}

/// A rectangle of cells or tiles: low .. high, both counted.
struct Cells {
  std::uint32_t low_col, low_row, high_col, high_row;
};

/// One look at all legs, as far as `reach` around each.
class LegsAmongCells {
 public:
  LegsAmongCells(const CellWallSource& cells, const LegBoxes& legs, const VerifyOptions& options, double reach,
                 const Execution& execution)
      : cells_(cells), legs_(legs), options_(options), reach_(reach), execution_(execution) {
    file_legs();
  }

  Tally compare() const {
    constexpr std::size_t grain = 4;  // a reader's scratch is large
    std::vector<Tally> parts(chunk_count(passed_.size(), grain));
    for_chunks(passed_.size(), grain, execution_, [&](Range r) {
      const auto reader = cells_.reader();
      CellTile tile;
      Comparison comparison(legs_, options_, std::numeric_limits<double>::infinity());
      for (std::size_t i = r.first; i < r.last; ++i) {
        execution_.check();
        reader->read(passed_[i], tile);
        compare_in(tile, passed_[i], comparison);
      }
      parts[r.first / grain] = comparison.take();
    });
    Tally whole;
    for (Tally& part : parts) whole.join(std::move(part));
    return whole;
  }

 private:
  /// The cells around a leg.
  Cells around(std::size_t leg) const {
    const Box box = box_of(legs_.leg(leg)).grown(reach_);
    const auto cell = [](double x, std::uint32_t count) {
      return static_cast<std::uint32_t>(std::clamp(std::floor(x - 0.5), 0.0, count - 1.0));
    };
    return {cell(box.min.x, cells_.cols()), cell(box.min.y, cells_.rows()), cell(box.max.x, cells_.cols()),
            cell(box.max.y, cells_.rows())};
  }

  template <class Visit>
  void for_each_tile(std::size_t leg, const Visit& visit) const {
    const Cells near = around(leg);
    const unsigned shift = cells_.side_log2();
    for (std::uint32_t row = near.low_row >> shift; row <= near.high_row >> shift; ++row) {
      for (std::uint32_t col = near.low_col >> shift; col <= near.high_col >> shift; ++col) {
        visit(row * cells_.tile_cols() + col);
      }
    }
  }

  /// Legs by tile: counted, then filed, in the order of the path.
  void file_legs() {
    const std::size_t tiles = cells_.tile_count();
    execution_.reserve((tiles + 1) * sizeof(std::uint64_t));
    first_.assign(tiles + 1, 0);
    for_each_leg([&](std::size_t, std::size_t tile) { ++first_[tile + 1]; });
    for (std::size_t t = 0; t < tiles; ++t) {
      if (first_[t + 1] > 0) passed_.push_back(t);
      first_[t + 1] += first_[t];
    }
    execution_.reserve(first_.back() * sizeof(std::uint32_t) + first_.size() * sizeof(std::uint64_t));
    filed_.resize(first_.back());
    std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
    for_each_leg([&](std::size_t leg, std::size_t tile) { filed_[next[tile]++] = static_cast<std::uint32_t>(leg); });
  }
  template <class Visit>
  void for_each_leg(const Visit& visit) const {
    for (std::size_t leg = 0; leg < legs_.leg_count(); ++leg) {
      if (leg % 16384 == 0) execution_.check();
      for_each_tile(leg, [&](std::size_t tile) { visit(leg, tile); });
    }
  }

  void compare_in(const CellTile& tile, std::size_t number, Comparison& comparison) const {
    for (std::uint64_t i = first_[number]; i < first_[number + 1]; ++i) {
      const BoxedSegment leg(legs_.leg(filed_[i]), filed_[i]);
      const Cells near = around(leg.number);
      const auto local = [](std::uint32_t x, std::uint32_t first, std::uint32_t size) {
        return std::clamp(std::ptrdiff_t{x} - std::ptrdiff_t{first}, std::ptrdiff_t{-1}, std::ptrdiff_t{size} - 1);
      };
      const std::ptrdiff_t last_row = local(near.high_row, tile.first_row, tile.height);
      const std::ptrdiff_t last_col = local(near.high_col, tile.first_col, tile.width);
      for (std::ptrdiff_t row = local(near.low_row, tile.first_row, tile.height) - 1; row <= last_row; ++row) {
        for (std::ptrdiff_t col = local(near.low_col, tile.first_col, tile.width) - 1; col <= last_col; ++col) {
          if (row >= -1 && col >= -1) compare_at(tile, col, row, leg, comparison);
        }
      }
    }
  }
  static void compare_at(const CellTile& tile, std::ptrdiff_t col, std::ptrdiff_t row, const BoxedSegment& leg,
                         Comparison& comparison) {
    const unsigned walls = tile.walls[tile.index(col, row)];
    const auto place = [&](bool is_upper) {
      return number_of(static_cast<std::uint32_t>(std::ptrdiff_t{tile.first_col} + col + 1),
                       static_cast<std::uint32_t>(std::ptrdiff_t{tile.first_row} + row + 1), is_upper);
    };
    const auto with = [&](std::size_t wall) { comparison.with_leg(leg, {wall_of(wall), wall}); };
    if ((walls & CellTile::right_wall) != 0 && row >= 0) with(place(false));
    if ((walls & CellTile::upper_wall) != 0 && col >= 0) with(place(true));
  }

  const CellWallSource& cells_;
  const LegBoxes& legs_;
  const VerifyOptions& options_;
  const double reach_;
  const Execution& execution_;
  std::vector<std::uint64_t> first_;  // by tile, and the end
  RawVector<std::uint32_t> filed_;
  std::vector<std::size_t> passed_;  // tiles with legs
};

/// The first leg that leaves the box.
void check_box(const Box& box, const LegBoxes& legs, std::span<const Vec2> path, Tally& tally) {
  if (box.contains(legs.box().min) && box.contains(legs.box().max)) return;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (box.contains(path[i])) continue;
    tally.violation = std::min(tally.violation, LegContact{i == 0 ? 0 : i - 1, bounds_number});
    return;
  }
}

Violation described(const LegContact& found, const LegBoxes& legs, const Box& box) {
  if (found.obstacle == bounds_number) {
    return {found.leg, 0.0, fmt::format("box: {} {} {} {}", box.min.x, box.min.y, box.max.x, box.max.y)};
  }
  const Segment wall = wall_of(found.obstacle);
  return {found.leg, exact::distance(legs.leg(found.leg), wall),
          fmt::format("wall: {} {} {} {}", wall.a.x, wall.a.y, wall.b.x, wall.b.y)};
}

/// Looks farther where nothing came as near as was looked: the least distance is then the true one.
Tally compared(const CellWallSource& cells, const LegBoxes& legs, const VerifyOptions& options,
               const Execution& execution) {
  const double farthest = static_cast<double>(cells.rows()) + cells.cols();
  for (double reach = std::max(1.0, std::ceil(options.reach() + 1e-6));; reach *= 2) {
    Tally tally = LegsAmongCells(cells, legs, options, reach, execution).compare();
    if (tally.least <= reach || reach > farthest) return tally;
  }
}

}  // namespace

Verification verify_among_cells(const CellWallSource& cells, std::span<const Vec2> path, const VerifyOptions& options,
                                const Execution& execution) {
  check_judged_path(path, options, execution);
  if (options.contact == Contact::allowed)
    throw InputError("contact", "is not judged where walls are made tile by tile");
  const Vec2 twice[] = {path.front(), path.front()};
  const std::span<const Vec2> legs_path = path.size() > 1 ? path : std::span<const Vec2>(twice);
  const LegBoxes legs(legs_path, execution);
  Tally tally = compared(cells, legs, options, execution);
  check_box(cells.box(), legs, path, tally);
  LegReport report{.least = tally.least};
  if (tally.violation != no_violation) report.violation = described(tally.violation, legs, cells.box());
  Verification verdict = verdict_on(report, wrong_start(legs_path, options), wrong_goal(legs_path, options));
  verdict.length = legs.length();
  verdict.min_clearance -= options.radius;
  return verdict;
}

}  // namespace warren
