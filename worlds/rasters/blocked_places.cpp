// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/blocked_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/whole.hpp"

namespace warren {
namespace {

/// The corners of a convex polygon from its lowest one on, the leftmost of these.
class CornerWalk {
 public:
  explicit CornerWalk(std::span<const Vec2> corners)
      : corners_(corners), left_(corners.size() > 1 ? corners.size() : 0) {
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const Vec2 p = corners[i];
      const Vec2 low = corners[at_];
      if (p.y < low.y || (p.y == low.y && p.x < low.x)) at_ = i;
    }
  }
  bool done() const { return left_ == 0; }
  Vec2 corner() const { return corners_[at_]; }
  Vec2 side() const { return corners_[next()] - corners_[at_]; }
  void advance() {
    at_ = next();
    --left_;
  }

 private:
  std::size_t next() const { return at_ + 1 < corners_.size() ? at_ + 1 : 0; }
  std::span<const Vec2> corners_;
  std::size_t at_ = 0;
  std::size_t left_;
};

/// Of directions from 0 to a full turn, does a come before b?
bool comes_before(Vec2 a, Vec2 b) {
  const auto is_upper = [](Vec2 v) { return v.y > 0.0 || (v.y == 0.0 && v.x > 0.0); };
  return is_upper(a) != is_upper(b) ? is_upper(a) : cross(a, b) > 0.0;
}

/// From where to where a convex set goes on each row of a grid; coordinates in steps of the grid.
class RowSpans {
 public:
  explicit RowSpans(std::size_t rows) : rows_(static_cast<double>(rows)) {
    low_.fill(std::numeric_limits<double>::infinity());
    high_.fill(-std::numeric_limits<double>::infinity());
  }
  /// A side from p to q, widened to all sides.
  void include(Vec2 p, Vec2 q, double reach) {
    if (q.y < p.y) std::swap(p, q);
    const double first = std::max(0.0, std::ceil(p.y - reach));
    const double last = std::min(rows_ - 1.0, std::floor(q.y + reach));
    const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0.0;
    const bool is_flat = !(std::abs(slope) < 1e9) || q.y - p.y < 1e-9;
    for (double row = first; row <= last; row += 1.0) {
      const double below = std::clamp(row - reach, p.y, q.y);
      const double above = std::clamp(row + reach, p.y, q.y);
      const double from = is_flat ? p.x : p.x + slope * (below - p.y);
      const double to = is_flat ? q.x : p.x + slope * (above - p.y);
      const auto r = bounded_whole<std::size_t>(row);
      low_[r] = std::min({low_[r], from - reach, to - reach});
      high_[r] = std::max({high_[r], from + reach, to + reach});
    }
  }
  void take_from(PlaceGrid& grid) const {
    const auto last_column = static_cast<double>(grid.columns - 1);
    for (std::size_t row = 0; row < grid.rows; ++row) {
      const double first = std::max(0.0, std::ceil(low_[row]));
      const double last = std::min(last_column, std::floor(high_[row]));
      if (!(first <= last)) continue;
      const auto count = bounded_whole<std::size_t>(last - first);  // less one
      grid.bits[row] &= ~(~std::uint64_t{0} >> (63 - count) << bounded_whole<std::size_t>(first));
    }
  }

 private:
  double rows_;
  std::array<double, PlaceGrid::most> low_;
  std::array<double, PlaceGrid::most> high_;
};

}  // namespace

void take_blocked_places(std::span<const Vec2> obstacle, std::span<const Vec2> mirrored_body, double reach,
                         PlaceGrid& free) {
  CornerWalk a(obstacle);
  CornerWalk b(mirrored_body);
  RowSpans rows(free.rows);
  const double scale = 1.0 / free.step;
  Vec2 p = scale * (a.corner() + b.corner() - free.origin);
  do {
    const bool by_a = !a.done() && (b.done() || comes_before(a.side(), b.side()));
    Vec2 q = p;
    if (by_a) {
      q = p + scale * a.side();
      a.advance();
    } else if (!b.done()) {
      q = p + scale * b.side();
      b.advance();
    }
    rows.include(p, q, scale * reach);
    p = q;
  } while (!a.done() || !b.done());
  rows.take_from(free);
}

}  // namespace warren
