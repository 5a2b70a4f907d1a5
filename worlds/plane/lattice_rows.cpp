// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/lattice_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/plane/geometry.hpp"

namespace warren {
namespace {

constexpr double beyond_rounding = 1e-6;

double row_count(const LatticeRows& rows) { return static_cast<double>(static_cast<std::int64_t>(rows.rows)); }
double last_col(const LatticeRows& rows) {
  return static_cast<double>(static_cast<std::int64_t>(rows.words_a_row * 64));
}
double last_row(const LatticeRows& rows) { return rows.first + row_count(rows) - 1.0; }
Box box_of(const LatticeRows& rows) { return {{1.0, rows.first}, {last_col(rows), last_row(rows)}}; }

/// Places first, first + 1, ... before end, of those from 0 on; none where end <= first.
struct Places {
  std::int64_t first;
  std::int64_t end;
  std::int64_t count() const { return end - first; }
  Places from_before(std::int64_t step) const { return {std::max<std::int64_t>(first - step, 0), end}; }
};

/// The whole numbers in [low, high], less `origin`, below count; from a little less than 0. By conversions, which are
/// faster than floor and ceil where a processor has no instruction for these.
inline Places places_in(double low, double high, double origin, double count) {
  const double from = std::max(low - origin, -2.0);
  const double to = std::max(high - origin, -1.0) + 1.0;
  const auto first = static_cast<std::int64_t>(std::min(from, count));
  return {first + static_cast<std::int64_t>(static_cast<double>(first) < from),
          static_cast<std::int64_t>(std::min(to, count))};
}

/// Calls test(point) for those of a row's points whose bits are set, and clears the bits for which it is false.
template <class Test>
void filter_points(const Places& points, std::uint64_t* bits, const Test& test) {
  const auto end = static_cast<std::size_t>(points.end);
  for (auto point = static_cast<std::size_t>(points.first); point < end; ++point) {
    const std::uint64_t rest = bits[point / 64] >> (point % 64);
    if (rest == 0) {
      point |= 63;
      continue;
    }
    point += static_cast<std::size_t>(std::countr_zero(rest));
    if (point >= end) return;
    if (!test(static_cast<double>(point + 1))) bits[point / 64] &= ~(std::uint64_t{1} << (point % 64));
  }
}

/// What part of a longer wall's extent in x lies in the band low_y <= y <= high_y, or a little more.
std::pair<double, double> extent_in_band(const Segment& wall, const Box& box, double low_y, double high_y) {
  const double slope = (wall.b.x - wall.a.x) / (wall.b.y - wall.a.y);
  const double at_low = wall.a.x + slope * (low_y - wall.a.y);
  const double at_high = wall.a.x + slope * (high_y - wall.a.y);
  const double margin = 1e-9 * (1.0 + std::abs(wall.a.x) + std::abs(at_low) + std::abs(at_high));
  return {std::max(box.min.x, std::min(at_low, at_high) - margin),
          std::min(box.max.x, std::max(at_low, at_high) + margin)};
}

/// box_of() without a branch: which end is which can't be foreseen.
inline Box box_around(const Segment& wall) {
  using Two = double __attribute__((vector_size(16)));
  const Two a{wall.a.x, wall.a.y};
  const Two b{wall.b.x, wall.b.y};
  const Two low = a < b ? a : b;
  const Two high = a < b ? b : a;
  return {{low[0], low[1]}, {high[0], high[1]}};
}

/// A wall, and which segments along the axes keep off it.
class NearWall {
 public:
  NearWall(const Segment& wall, double r, const LatticeRows& rows)
      : wall_(wall),
        rows_(rows),
        box_(box_around(wall)),
        r_(r),
        is_along_axis_(box_.min.x == box_.max.x || box_.min.y == box_.max.y),
        in_cols_(cols_near(box_.min.x, box_.max.x)),
        in_rows_(places_in(box_.min.y - reach(), box_.max.y + reach(), rows.first, row_count(rows))) {}

  /// Clears the bits of those segments from (x, y) to (x + right, y + up) that do not keep off.
  void filter(int right, int up, std::uint64_t* bits) const {
    Places cols = in_cols_.from_before(right);
    const Places rows = in_rows_.from_before(up);
    if (std::min(cols.count(), rows.count()) <= 0) return;  // one branch: which of the two can't be foreseen
    const bool is_whole = box_.height() <= 1.0 || box_.width() <= 1.0;  // in each row
    for (std::int64_t row = rows.first; row < rows.end; ++row) {
      const double y = rows_.first + static_cast<double>(row);
      if (!is_whole) {
        const auto [low, high] = extent_in_band(wall_, box_, y - reach(), y + up + reach());
        cols = cols_near(low, high).from_before(right);
      }
      filter_points(cols, bits + static_cast<std::size_t>(row) * rows_.words_a_row, [&](double x) {
        return keeps_off({x, y}, {x + right, y + up});
      });
    }
  }

 private:
  double reach() const { return r_ + beyond_rounding; }
  Places cols_near(double low, double high) const {
    return places_in(low - reach(), high + reach(), 1.0, last_col(rows_));
  }
  /// from, to: along an axis, from <= to. As far apart as their boxes where the wall is along an axis, too; in doubt
  /// the plain test says.
  bool keeps_off(Vec2 from, Vec2 to) const {
    if (is_along_axis_) {
      constexpr double doubt = 1e-12;
      const double dx = std::max(std::max(from.x - box_.max.x, box_.min.x - to.x), 0.0);
      const double dy = std::max(std::max(from.y - box_.max.y, box_.min.y - to.y), 0.0);
      const double apart_sq = dx * dx + dy * dy;
      if (!(r_ > 0.0)) return dx > 0.0 || dy > 0.0;
      if (apart_sq < r_ * r_ * (1.0 - doubt)) return false;
      if (apart_sq > r_ * r_ * (1.0 + doubt)) return true;
    }
    const Segment step{from, to};
    return r_ > 0.0 ? segments_keep_distance(step, wall_, r_) : !segments_touch(step, wall_);
  }

  const Segment& wall_;
  const LatticeRows& rows_;
  const Box box_;
  const double r_;
  const bool is_along_axis_;
  const Places in_cols_;
  const Places in_rows_;
};

}  // namespace

void keep_points_in_box(const Box& box, const LatticeRows& rows, std::span<std::uint64_t> bits) noexcept {
  const auto count = static_cast<std::int64_t>(rows.words_a_row * 64);
  const Places cols = places_in(box.min.x, box.max.x, 1.0, last_col(rows)).from_before(0);
  const Places inside = places_in(box.min.y, box.max.y, rows.first, row_count(rows));
  const auto none = [](double) { return false; };
  for (std::size_t row = 0; row < rows.rows; ++row) {
    std::uint64_t* const its = bits.data() + row * rows.words_a_row;
    const auto number = static_cast<std::int64_t>(row);
    const bool is_inside = number >= inside.first && number < inside.end;
    filter_points({0, is_inside ? cols.first : count}, its, none);
    filter_points({std::max(cols.first, cols.end), count}, its, none);
  }
}

void keep_off_walls(const WallIndex& walls, double r, const LatticeRows& rows, std::span<std::uint64_t> points,
                    std::span<std::uint64_t> right, std::span<std::uint64_t> up) noexcept {
  const bool with_steps = !right.empty();
  Box box = box_of(rows).grown(r);
  if (with_steps) box.max = box.max + Vec2{1.0, 1.0};
  walls.for_each_near(box, [&](const Segment& wall) {
    const NearWall near(wall, r, rows);
    near.filter(0, 0, points.data());
    if (with_steps) {
      near.filter(1, 0, right.data());
      near.filter(0, 1, up.data());
    }
    return true;
  });
}

}  // namespace warren
