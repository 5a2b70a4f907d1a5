// SPDX-License-Identifier: BSD-3-Clause
#include "verify/streamed/verify_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/whole.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/near/leg_boxes.hpp"
#include "verify/streamed/looked_up_walls.hpp"

namespace warren {
namespace {

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

/// Legs first .. last, in a row, that come near a tile.
struct Run {
  std::size_t tile, first, last;
};

/// One look at all legs, as far as `reach` around each.
class LegsAmongCells {
 public:
  LegsAmongCells(const CellWallSource& cells, Range tiles, const LegBoxes& legs, const VerifyOptions& options,
                 double reach, const Execution& execution)
      : cells_(cells), tiles_(tiles), legs_(legs), options_(options), reach_(reach), execution_(execution) {
    file_legs();
  }

  Tally compare() const {
    constexpr std::size_t grain = 4;  // a reader's scratch is large
    const auto compare = [&](Range r, Comparison& comparison) {
      const auto reader = cells_.reader();
      CellTile tile;
      for (std::size_t i = r.first; i < r.last; ++i) {
        execution_.check();
        reader->read(runs_[passed_[i].first].tile, tile);
        for (std::size_t run = passed_[i].first; run < passed_[i].last; ++run) {
          for (std::size_t leg = runs_[run].first; leg <= runs_[run].last; ++leg) compare_leg(tile, leg, comparison);
        }
      }
    };
    return tally_chunks(passed_.size(), grain, options_, std::numeric_limits<double>::infinity(), execution_, compare);
  }

 private:
  /// The cells around a leg.
  Cells around(std::size_t leg) const {
    const Box box = box_of(legs_.leg(leg)).grown(reach_);
    const auto cell = [](double x, std::uint32_t count) {
      return bounded_whole<std::uint32_t>(x - 0.5, 0.0, count - 1.0);
    };
    return {cell(box.min.x, cells_.cols()), cell(box.min.y, cells_.rows()), cell(box.max.x, cells_.cols()),
            cell(box.max.y, cells_.rows())};
  }

  /// A leg lengthens the runs of the leg before it where both come near few tiles; where they come near many, each has
  /// runs of its own.
  void add_runs(std::size_t leg, RawVector<Run>& runs) const {
    constexpr std::size_t few = 4;
    const Cells near = around(leg);
    const unsigned shift = cells_.side_log2();
    const std::size_t recent = runs.size() - std::min(runs.size(), few);
    for (std::size_t row = near.low_row >> shift; row <= near.high_row >> shift; ++row) {
      for (std::size_t col = near.low_col >> shift; col <= near.high_col >> shift; ++col) {
        const std::size_t tile = row * cells_.tile_cols() + col;
        if (tile < tiles_.first || tile >= tiles_.last) continue;
        std::size_t i = runs.size();
        while (i > recent && !(runs[i - 1].tile == tile && runs[i - 1].last + 1 == leg)) --i;
        if (i > recent) {
          runs[i - 1].last = leg;
        } else {
          push_asked(runs, Run{tile, leg, leg}, execution_);
        }
      }
    }
  }

  /// Runs by tile, in the order of the path within each.
  void file_legs() {
    constexpr std::size_t grain = std::size_t{1} << 14;
    auto parts = parts_of_chunks(legs_.leg_count(), grain, execution_.quiet(), [&](Range r) {
      RawVector<Run> runs;
      for (std::size_t leg = r.first; leg < r.last; ++leg) add_runs(leg, runs);
      return runs;
    });
    std::size_t total = 0;
    for (const RawVector<Run>& part : parts) total += part.size();
    execution_.reserve(total * (sizeof(Run) + sizeof(Range)));
    runs_.reserve(total);
    for (RawVector<Run>& part : parts) {
      runs_.insert(runs_.end(), part.begin(), part.end());
      let_go(part);
    }
    const auto before = [](const Run& a, const Run& b) {
      return std::tie(a.tile, a.first) < std::tie(b.tile, b.first);
    };
    polled_sort(runs_.begin(), runs_.end(), execution_, before);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (i == 0 || runs_[i].tile != runs_[i - 1].tile) push_asked(passed_, {i, i}, execution_);
      passed_.back().last = i + 1;
    }
  }

  void compare_leg(const CellTile& tile, std::size_t number, Comparison& comparison) const {
    const BoxedSegment leg(legs_.leg(number), number);
    const Cells near = around(leg.number);
    const auto local = [](std::uint32_t x, std::uint32_t first, std::uint32_t size) {
      return std::clamp(std::ptrdiff_t{x} - std::ptrdiff_t{first}, std::ptrdiff_t{-1}, std::ptrdiff_t{size} - 1);
    };
    const std::ptrdiff_t last_row = local(near.high_row, tile.first_row, tile.height);
    const std::ptrdiff_t last_col = local(near.high_col, tile.first_col, tile.width);
    for (std::ptrdiff_t row = local(near.low_row, tile.first_row, tile.height) - 1; row <= last_row; ++row) {
      for (std::ptrdiff_t col = local(near.low_col, tile.first_col, tile.width) - 1; col <= last_col; ++col) {
        if (row < -1 || col < -1) continue;
        const unsigned walls = tile.walls[tile.index(col, row)];
        const auto with = [&](bool is_upper) {
          const std::size_t wall =
              number_of(as_whole<std::uint32_t>(std::ptrdiff_t{tile.first_col} + col + 1),
                        as_whole<std::uint32_t>(std::ptrdiff_t{tile.first_row} + row + 1), is_upper);
          comparison.with_leg(leg, {wall_of(wall), wall});
        };
        if ((walls & CellTile::right_wall) != 0 && row >= 0) with(false);
        if ((walls & CellTile::upper_wall) != 0 && col >= 0) with(true);
      }
    }
  }

  const CellWallSource& cells_;
  const Range tiles_;
  const LegBoxes& legs_;
  const VerifyOptions& options_;
  const double reach_;
  const Execution& execution_;
  RawVector<Run> runs_;        // by tile
  std::vector<Range> passed_;  // the runs of each tile that has some
};

Violation described(const LegContact& found, const LegBoxes& legs, const Box& box) {
  if (found.obstacle == box_number) {
    return {found.leg, 0.0, fmt::format("box: {} {} {} {}", box.min.x, box.min.y, box.max.x, box.max.y)};
  }
  const Segment wall = wall_of(found.obstacle);
  return {found.leg, exact::distance(legs.leg(found.leg), wall),
          fmt::format("wall: {} {} {} {}", wall.a.x, wall.a.y, wall.b.x, wall.b.y)};
}

constexpr double half = 0.5;  // from the middle of a cell to its walls

/// A cell by its column and row from 0.
struct Cell {
  std::ptrdiff_t col, row;
};

/// The cell whose middle this is.
std::optional<Cell> cell_at(const LookedUpWalls& walls, Vec2 p) {
  if (!(p.x >= 1.0 && p.y >= 1.0 && p.x <= walls.cols() && p.y <= walls.rows())) return std::nullopt;
  const Cell cell{bounded_whole<std::ptrdiff_t>(p.x) - 1, bounded_whole<std::ptrdiff_t>(p.y) - 1};
  const bool is_middle = static_cast<double>(cell.col + 1) == p.x && static_cast<double>(cell.row + 1) == p.y;
  return is_middle ? std::optional(cell) : std::nullopt;
}

/// Are they neighbours with no wall between them?
bool is_open(const LookedUpWalls& walls, Cell a, Cell b) {
  const Cell low{std::min(a.col, b.col), std::min(a.row, b.row)};
  const std::ptrdiff_t way = a.col + b.col - 2 * low.col + a.row + b.row - 2 * low.row;
  const unsigned between = a.row == b.row ? CellTile::right_wall : CellTile::upper_wall;
  return way == 1 && (walls.walls_at(low.col, low.row) & between) == 0;
}

bool has_wall(const LookedUpWalls& walls, Cell cell) {
  return walls.walls_at(cell.col, cell.row) != 0 ||
         (walls.walls_at(cell.col - 1, cell.row) & CellTile::right_wall) != 0 ||
         (walls.walls_at(cell.col, cell.row - 1) & CellTile::upper_wall) != 0;
}

/// What some legs in a row come to.
struct Steps {
  bool are_open = true;        ///< all are steps that no wall is in the way of
  bool pass_by_walls = false;  ///< a wall stands beside one of them
  double length = 0.0;         ///< added leg by leg, as LegBoxes does
};

/// Legs of the path; of its first and last leg the length alone, where these are no steps.
Steps look_at(const LookedUpWalls& walls, std::span<const Vec2> path, Range legs) {
  Steps steps;
  std::optional<Cell> from = cell_at(walls, path[legs.first]);
  for (std::size_t leg = legs.first; leg < legs.last; ++leg) {
    const std::optional<Cell> to = cell_at(walls, path[leg + 1]);
    const bool is_end = leg == 0 || leg + 2 == path.size();
    if (from && to && is_open(walls, *from, *to)) {
      steps.length += 1.0;
      steps.pass_by_walls = steps.pass_by_walls || has_wall(walls, *from);
    } else {
      steps.length += norm(path[leg + 1] - path[leg]);
      if (!is_end) return {.are_open = false};
    }
    from = to;
  }
  return steps;
}

/// The length where all legs but the first and the last are such steps.
std::optional<double> length_of_steps(const LookedUpWalls& walls, std::span<const Vec2> path,
                                      const Execution& execution) {
  constexpr std::size_t grain = LegBoxes::legs_a_sum;
  const auto steps_in = [&](Range legs) { return look_at(walls, path, legs); };
  Steps all;
  for (const Steps& part : parts_of_chunks(path.size() - 1, grain, execution, steps_in)) {
    all.are_open = all.are_open && part.are_open;
    all.pass_by_walls = all.pass_by_walls || part.pass_by_walls;
    all.length += part.length;
  }
  return all.are_open && all.pass_by_walls ? std::optional(all.length) : std::nullopt;
}

}  // namespace

NearestWalls nearest_among_cells(const CellWallSource& cells, Range tiles, std::span<const Vec2> path,
                                 const VerifyOptions& options, double reach, const Execution& execution) {
  const LegBoxes legs(path, execution);
  const Tally tally = LegsAmongCells(cells, tiles, legs, options, reach, execution).compare();
  return {tally.least, tally.violation.leg, tally.violation.obstacle};
}

JudgeAmongCells::JudgeAmongCells(const CellWallSource& cells, const VerifyOptions& options, const Execution& execution,
                                 JudgesElsewhere* others)
    : cells_(cells), options_(options), execution_(execution), others_(others) {
  if (options.contact == Contact::allowed)
    throw InputError("contact", "is not judged where walls are made tile by tile");
}

/// Looks farther where nothing came as near as was looked, or as something else did: the least distance, if it is below
/// that of the pieces before, is then the true one.
Tally JudgeAmongCells::compared(const LegBoxes& legs) const {
  const double farthest = static_cast<double>(cells_.rows()) + cells_.cols();
  for (double reach = std::max(1.0, std::ceil(options_.reach() + 1e-6));; reach *= 2) {
    if (others_ != nullptr) others_->begin(legs.path(), reach);
    const Range tiles = others_ != nullptr ? others_->own_tiles() : Range{0, cells_.tile_count()};
    Tally tally = LegsAmongCells(cells_, tiles, legs, options_, reach, execution_).compare();
    for (const NearestWalls& found : others_ != nullptr ? others_->take() : std::vector<NearestWalls>{}) {
      tally.least = std::min(tally.least, found.least);
      tally.violation = std::min(tally.violation, LegContact{found.leg, found.wall});
    }
    if (std::min(tally.least, report_.least) <= reach || reach > farthest) return tally;
  }
}

void JudgeAmongCells::add(std::span<const Vec2> piece) {
  check_judged_path(piece, options_, execution_);
  assert(points_ == 0 || piece.front() == ends_[1]);
  const Vec2 twice[] = {piece.front(), piece.front()};
  const LegBoxes legs(piece.size() > 1 ? piece : std::span<const Vec2>(twice), execution_);
  Tally tally = compared(legs);
  check_box(cells_.box(), legs, tally);
  LegReport report{.least = tally.least};
  if (tally.violation != no_violation) {
    report.violation = described(tally.violation, legs, cells_.box());
    report.violation->leg += points_ == 0 ? 0 : points_ - 1;
  }
  report_.add(report);
  length_ += legs.length();
  if (points_ == 0) ends_[0] = piece.front();
  ends_[1] = piece.back();
  points_ += piece.size() - (points_ == 0 ? 0 : 1);
}

Verification JudgeAmongCells::verdict() const {
  assert(points_ > 0);
  Verification verdict = verdict_on(report_, wrong_ends(ends_, options_, legs_of(points_)));
  verdict.length = length_;
  verdict.min_clearance -= options_.radius;
  return verdict;
}

Verification verify_among_cells(const CellWallSource& cells, std::span<const Vec2> path, const VerifyOptions& options,
                                const Execution& execution) {
  JudgeAmongCells judge(cells, options, execution);
  judge.add(path);
  return judge.verdict();
}

Verification verify_steps(const LookedUpWalls& walls, std::span<const Vec2> path, const VerifyOptions& options,
                          const Execution& execution) {
  check_judged_path(path, options, execution);
  const bool may_be_steps = path.size() > 3 && options.reach() < half && options.contact == Contact::blocked;
  const std::optional<double> length = may_be_steps ? length_of_steps(walls, path, execution) : std::nullopt;
  if (!length) return verify_among_cells(walls, path, options, execution);
  const Verification first = verify_among_cells(walls, path.first(2), {options.radius, options.clearance}, execution);
  const Verification last = verify_among_cells(walls, path.last(2), {options.radius, options.clearance}, execution);
  if (!first.verified || !last.verified) return verify_among_cells(walls, path, options, execution);
  const LegReport legs{.least = half};
  Verification verdict = verdict_on(legs, wrong_ends(path, options, legs_of(path.size())));
  verdict.length = *length;
  verdict.min_clearance = std::min({half - options.radius, first.min_clearance, last.min_clearance});
  return verdict;
}

}  // namespace warren
