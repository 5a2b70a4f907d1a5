// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/convex_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "core/plane/convex_polygons.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"

namespace warren {
namespace {

/// Or straight ones.
bool has_left_turns_only(std::span<const Vec2> outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 b = outline[(i + 1) % outline.size()];
    if (orient2d(outline[i], b, outline[(i + 2) % outline.size()]) < 0) return false;
  }
  return true;
}

/// The arc that p runs through, within its tangents: both ends and the corners between, `parts` of them.
void add_arc(Vec2 p, double angle_rad, int parts, std::vector<Vec2>& to) {
  const double part = angle_rad / parts;
  to.push_back(p);
  for (int i = 0; i < parts; ++i) to.push_back((1.0 / portable::cos(part / 2)) * Rotation((i + 0.5) * part)(p));
  to.push_back(Rotation(angle_rad)(p));
}

constexpr int arc_parts = 4;

/// A triangle (origin, a, b), a to b counter-clockwise, whose side runs away from the origin all along or towards it.
ConvexPiece swept_triangle(Vec2 a, Vec2 b, double angle_rad) {
  std::vector<Vec2> corners{{0.0, 0.0}};
  if (dot(b, b) >= dot(a, a)) {
    corners.push_back(a);
    add_arc(b, angle_rad, arc_parts, corners);
  } else {
    add_arc(a, angle_rad, arc_parts, corners);
    corners.push_back(Rotation(angle_rad)(b));
  }
  return convex_hull(std::move(corners));
}

/// Where rounding has made a corner concave, a place that a polygon's own test would hold to be inside may not be.
bool holds_origin(const ConvexPiece& piece) {
  if (piece.size() < 3) return false;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (orient2d(piece[i], piece[(i + 1) % piece.size()], {0.0, 0.0}) < 0) return false;
  }
  return true;
}

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

ConvexPiece convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), is_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  ConvexPiece hull(2 * points.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    while (n >= 2 && orient2d(hull[n - 2], hull[n - 1], points[i]) <= 0) --n;
    hull[n++] = points[i];
  }
  const std::size_t lower = n + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    while (n >= lower && orient2d(hull[n - 2], hull[n - 1], points[i]) <= 0) --n;
    hull[n++] = points[i];
  }
  hull.resize(n - 1);
  return hull;
}

std::vector<ConvexPiece> outline_pieces(std::span<const Vec2> outline) {
  std::vector<Vec2> ring(outline.begin(), outline.end());
  if (runs_clockwise(ring)) std::reverse(ring.begin(), ring.end());
  if (ring.size() < 4 || has_left_turns_only(ring)) return {convex_hull(std::move(ring))};
  std::vector<ConvexPiece> pieces;
  for (std::vector<Vec2>& ear : clip_ears(ring, false)) pieces.push_back(convex_hull(std::move(ear)));
  pieces.push_back(convex_hull(std::move(ring)));
  return pieces;
}

ConvexPiece swept_by_step(const ConvexPiece& piece, Vec2 step) {
  std::vector<Vec2> corners = piece;
  for (const Vec2 p : piece) corners.push_back(p + step);
  return convex_hull(std::move(corners));
}

std::vector<ConvexPiece> swept_by_turn(const ConvexPiece& piece, double angle_rad) {
  std::vector<ConvexPiece> swept;
  if (!holds_origin(piece)) {
    constexpr int eighths = 8;
    for (int part = 0; part < eighths; ++part) {
      std::vector<Vec2> corners;
      for (const Vec2 p : piece) add_arc(Rotation(angle_rad / eighths * part)(p), angle_rad / eighths, 1, corners);
      swept.push_back(convex_hull(std::move(corners)));
    }
    return swept;
  }
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec2 a = piece[i];
    const Vec2 b = piece[(i + 1) % piece.size()];
    const double t = -dot(a, b - a) / dot(b - a, b - a);
    if (t <= 0.0 || t >= 1.0) {
      swept.push_back(swept_triangle(a, b, angle_rad));
    } else {
      const Vec2 foot = a + t * (b - a);
      swept.push_back(swept_triangle(a, foot, angle_rad));
      swept.push_back(swept_triangle(foot, b, angle_rad));
    }
  }
  return swept;
}

ConvexPiece touching_positions(const ConvexPiece& piece, const Segment& wall) {
  std::vector<Vec2> corners;
  corners.reserve(2 * piece.size());
  for (const Vec2 p : piece) {
    corners.push_back(wall.a - p);
    corners.push_back(wall.b - p);
  }
  return convex_hull(std::move(corners));
}

ConvexPiece turned(std::span<const Vec2> outline, std::uint32_t k, std::uint32_t n) {
  const bool quarters = n % 4 == 0;
  const std::uint32_t quarter = quarters ? k / (n / 4) : 0;
  const std::uint32_t rest = quarters ? k % (n / 4) : k;
  const Rotation by_rest(2.0 * std::numbers::pi * rest / n);
  ConvexPiece result;
  result.reserve(outline.size());
  for (Vec2 p : outline) {
    p = by_rest(p);
    for (std::uint32_t q = 0; q < quarter; ++q) p = {-p.y, p.x};
    result.push_back(p);
  }
  return result;
}

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
