// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/swept_stamps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/whole.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "parallel/chunks.hpp"
#include "worlds/poses/certified_motion.hpp"

namespace warren {
namespace {

using CellAt = std::array<std::int32_t, 2>;

constexpr double resolution = 0x1p-4;  // cells

/// A body along one shape, in cells.
class ShapeSweep {
 public:
  ShapeSweep(const MotionSet& motions, const MotionShape& shape, std::span<const Vec2> outline, double reach)
      : outline_(outline),
        reach_(reach),
        from_rad_(motions.heading_rad(shape.from)),
        curve_({0.0, 0.0, from_rad_}, {1.0 * shape.dx, 1.0 * shape.dy, motions.heading_rad(shape.to)}, shape.word,
               motions.turning_radius()) {
    for (const Vec2 p : outline) {
      radius_ = std::max(radius_, norm(p));
      box_.include(p);
    }
    for (std::size_t i = 0; i < curve_.piece_count(); ++i) {
      lengths_[i] = curve_.piece_length(i);
      paces_[i] = pace(curve_.piece(i).steer);
    }
  }

  /// Those that may be touched, row by row.
  std::vector<CellAt> cells(const Execution& execution) const {
    std::vector<CellAt> touched;
    const Box way = curve_.box();
    const Box wide = way.grown(radius_ + reach_ + 1.0);
    const auto whole = [](double x) { return bounded_whole<std::int32_t>(x, least_whole<std::int32_t>); };
    for (std::int32_t y = whole(std::floor(wide.min.y)); y <= whole(std::ceil(wide.max.y)); ++y) {
      execution.check();
      for (std::int32_t x = whole(std::floor(wide.min.x)); x <= whole(std::ceil(wide.max.x)); ++x) {
        if (!is_clear_of({1.0 * x, 1.0 * y})) touched.push_back({x, y});
      }
    }
    return touched;
  }

 private:
  double pace(Steer steer) const {
    if (steer == Steer::straight) return 1.0;
    const double rho = curve_.turning_radius();
    if (is_on_spot(steer)) return radius_ / rho;
    const Vec2 center{0.0, steer == Steer::left ? rho : -rho};
    double most = 1.0;
    for (const Vec2 p : outline_) most = std::max(most, norm(p - center) / rho);
    return most;
  }
  Se2 pose(double t) const { return curve_.at(t * curve_.length()); }
  double travelled(double t) const {
    double s = t * curve_.length();
    double travel = 0.0;
    for (std::size_t i = 0; i < curve_.piece_count() && s > 0.0; ++i) {
      travel += paces_[i] * std::min(s, lengths_[i]);
      s -= lengths_[i];
    }
    return travel;
  }
  /// A lower bound of the distance between body and square, less the reach; exact where it is small.
  double clearance(const Se2& pose, Vec2 middle, double enough) const {
    constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;
    const Vec2 seen = Rotation(-pose.theta)(middle - pose.position());
    const double aside = std::max({box_.min.x - seen.x, seen.x - box_.max.x, 0.0});
    const double above = std::max({box_.min.y - seen.y, seen.y - box_.max.y, 0.0});
    const double at_least = std::sqrt(aside * aside + above * above) - half_diagonal - reach_;
    if (at_least > enough) return at_least;
    const Rotation turned(-pose.theta);
    std::array<Vec2, 4> square;
    constexpr std::array<Vec2, 4> corners{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
    for (std::size_t i = 0; i < 4; ++i) square[i] = seen + turned(corners[i]);
    return distance(outline_, square) - reach_;
  }
  bool is_clear_of(Vec2 middle) const {
    return certified_motion([&](double t, double enough) { return clearance(pose(t), middle, enough); },
                            [&](double t, double u) { return travelled(u) - travelled(t); },
                            resolution) == MotionVerdict::free;
  }

  std::span<const Vec2> outline_;
  double reach_;
  double from_rad_;
  SteeringCurve curve_;
  double radius_ = 0.0;
  Box box_;  // of the outline
  std::array<double, SteeringWord::most_pieces> lengths_{};
  std::array<double, SteeringWord::most_pieces> paces_{};
};

}  // namespace

SweptStamps::SweptStamps(const MotionSet& motions, std::span<const Vec2> outline, double reach,
                         const Execution& execution) {
  const std::span<const MotionShape> shapes = motions.shapes();
  std::vector<std::vector<CellAt>> touched(shapes.size());
  for_chunks(shapes.size(), 1, execution.quiet(), [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i)
      touched[i] = ShapeSweep(motions, shapes[i], outline, reach).cells(execution);
  });
  for (std::vector<CellAt>& cells : touched) {
    for (std::uint32_t quarters = 0; quarters < 4; ++quarters) {
      add(cells);
      for (CellAt& cell : cells) cell = {-cell[1], cell[0]};
    }
  }
}

void SweptStamps::add(std::vector<CellAt> cells) {
  constexpr std::int32_t bits = 64;
  std::sort(cells.begin(), cells.end(),
            [](const CellAt& a, const CellAt& b) { return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0]; });
  Stamp stamp{rows_.size(), 0, 0, 0, 0, 0};
  for (const auto& [x, y] : cells) {
    stamp.min_x = std::min(stamp.min_x, x);
    stamp.max_x = std::max(stamp.max_x, x);
    stamp.min_y = std::min(stamp.min_y, y);
    stamp.max_y = std::max(stamp.max_y, y);
    const bool fits = rows_.size() > stamp.first && rows_.back().y == y && x - rows_.back().x < bits;
    if (!fits) rows_.push_back({x, y, 0});
    rows_.back().bits |= std::uint64_t{1} << as_whole<unsigned>(x - rows_.back().x);
  }
  stamp.last = rows_.size();
  stamps_.push_back(stamp);
}

bool SweptStamps::is_free(const FreeCells& map, Cell from, const LatticeMotion& motion) const {
  const Stamp& stamp = of(motion);
  std::int64_t x = from.x;
  std::int64_t y = from.y;
  if (motion.gear < 0) {  // its shape begins where it ends
    x += motion.dx;
    y += motion.dy;
  }
  if (x + stamp.min_x < 0 || y + stamp.min_y < 0 || x + stamp.max_x >= map.width() || y + stamp.max_y >= map.height())
    return false;
  const std::int64_t begin = std::int64_t{map.number({0, 0})} + y * map.stride() + x;
  for (std::size_t i = stamp.first; i < stamp.last; ++i) {
    const Row& row = rows_[i];
    const auto number = as_whole<VertexId>(begin + std::int64_t{row.y} * map.stride() + row.x);
    if ((~map.from(number) & row.bits) != 0) return false;
  }
  return true;
}

std::vector<CellAt> SweptStamps::cells(const LatticeMotion& motion) const {
  std::vector<CellAt> cells;
  const Stamp& stamp = of(motion);
  for (std::size_t i = stamp.first; i < stamp.last; ++i) {
    for (std::int32_t bit = 0; bit < 64; ++bit) {
      if ((rows_[i].bits >> as_whole<unsigned>(bit) & 1U) != 0) cells.push_back({rows_[i].x + bit, rows_[i].y});
    }
  }
  return cells;
}

}  // namespace warren
