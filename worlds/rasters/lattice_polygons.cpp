// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/lattice_polygons.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "core/plane/convex_polygons.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "spatial/maps/free_cells.hpp"

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

/// Adds where the segment meets the line at height y.
void include_segment(Vec2 a, Vec2 b, double y, Box& interval) {
  if (a.y > b.y) std::swap(a, b);
  if (y < a.y || y > b.y) return;
  if (a.y == b.y) {
    interval.include(Vec2{a.x, y});
    interval.include(Vec2{b.x, y});
  } else {
    interval.include(Vec2{a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), y});
  }
}

void include_disc(Vec2 centre, double radius, double y, Box& interval) {
  const double dy = y - centre.y;
  if (std::abs(dy) > radius) return;
  const double half = std::sqrt(radius * radius - dy * dy);
  interval.include(Vec2{centre.x - half, y});
  interval.include(Vec2{centre.x + half, y});
}

/// The line at height y within the convex polygon widened by radius: of discs around its corners and of its sides moved
/// outwards, which together have the same outline.
Box slice(std::span<const Vec2> convex, double radius, double y) {
  Box interval;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vec2 a = convex[i];
    const Vec2 b = convex[(i + 1) % convex.size()];
    include_segment(a, b, y, interval);
    if (radius == 0.0) continue;
    include_disc(a, radius, y, interval);
    const double length = distance(a, b);
    if (length == 0.0) continue;
    const Vec2 out = (radius / length) * Vec2{b.y - a.y, a.x - b.x};
    include_segment(a + out, b + out, y, interval);
  }
  return interval;
}

/// Calls add(y, from, to) for each longest run of borders between rows y - 1 and y.
template <class Add>
void for_borders_between_rows(const Bitmap& blocked, const Execution& execution, const Add& add) {
  const std::size_t words = blocked.empty() ? 0 : blocked.row(0).size();
  const auto solid = [&](std::int64_t y, std::size_t w) {
    if (y < 0 || y >= blocked.height()) return ~std::uint64_t{0};
    const std::uint64_t beyond =
        w + 1 == words && blocked.width() % 64 != 0 ? ~std::uint64_t{0} << blocked.width() % 64 : 0;
    return blocked.row(as_whole<std::uint32_t>(y))[w] | beyond;
  };
  for (std::int64_t y = 0; y <= blocked.height(); ++y) {
    if (y % 16 == 0) execution.check();
    std::int64_t first = -1;  // of the run that is open
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t differs = solid(y - 1, w) ^ solid(y, w);
      const auto base = as_whole<std::int64_t>(64 * w);
      std::int64_t x = 0;
      while (x < 64) {
        const auto next = as_whole<std::int64_t>(first < 0 ? std::countr_zero(differs) : std::countr_one(differs));
        if (x + next >= 64) break;
        x += next;
        differs >>= next;
        if (first < 0) {
          first = base + x;
        } else {
          add(y, first, base + x);
          first = -1;
        }
      }
    }
    if (first >= 0) add(y, first, std::int64_t{blocked.width()});
  }
}

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
  // From where to where the sum goes on each row; coordinates in steps of the grid.
  std::array<double, PlaceGrid::most> low;
  std::array<double, PlaceGrid::most> high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  const double scale = 1.0 / free.step;
  const double room = scale * reach;
  const auto include = [&](Vec2 p, Vec2 q) {  // a side, widened to all sides
    if (q.y < p.y) std::swap(p, q);
    const double first = std::max(0.0, std::ceil(p.y - room));
    const double last = std::min(static_cast<double>(free.rows) - 1.0, std::floor(q.y + room));
    const double slope = q.y > p.y ? (q.x - p.x) / (q.y - p.y) : 0.0;
    const bool is_flat = !(std::abs(slope) < 1e9) || q.y - p.y < 1e-9;
    for (double row = first; row <= last; row += 1.0) {
      const double below = std::clamp(row - room, p.y, q.y);
      const double above = std::clamp(row + room, p.y, q.y);
      const double from = is_flat ? p.x : p.x + slope * (below - p.y);
      const double to = is_flat ? q.x : p.x + slope * (above - p.y);
      const auto r = bounded_whole<std::size_t>(row);
      low[r] = std::min({low[r], from - room, to - room});
      high[r] = std::max({high[r], from + room, to + room});
    }
  };
  CornerWalk a(obstacle);
  CornerWalk b(mirrored_body);
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
    include(p, q);
    p = q;
  } while (!a.done() || !b.done());
  const auto last_column = static_cast<double>(free.columns - 1);
  for (std::size_t row = 0; row < free.rows; ++row) {
    const double first = std::max(0.0, std::ceil(low[row]));
    const double last = std::min(last_column, std::floor(high[row]));
    if (!(first <= last)) continue;
    const auto count = bounded_whole<std::size_t>(last - first);  // less one
    free.bits[row] &= ~(~std::uint64_t{0} >> (63 - count) << bounded_whole<std::size_t>(first));
  }
}

LatticeMarking::LatticeMarking(Vec2 origin, double cell, std::uint32_t width, std::uint32_t height)
    : origin_(origin), cell_(cell), marked_(width, height) {
  constexpr double share = 1e-9;
  rounding_ = share * (cell * std::max(width, height) + std::abs(origin.x) + std::abs(origin.y));
}

void LatticeMarking::mark_run(std::int64_t row, double from, double to) {
  if (row < 0 || row >= marked_.height()) return;
  const double first = std::max(0.0, std::ceil((from - rounding_ - origin_.x) / cell_));
  const double last = std::min<double>(marked_.width() - 1.0, std::floor((to + rounding_ - origin_.x) / cell_));
  if (first > last) return;
  marked_.set_run(as_whole<std::uint32_t>(row), bounded_whole<std::uint32_t>(first),
                  bounded_whole<std::uint32_t>(last) + 1);
}

void LatticeMarking::mark_near(std::span<const Vec2> convex, double radius) {
  const Box box = box_around(convex).grown(radius);
  const double first = std::max(0.0, std::ceil((box.min.y - rounding_ - origin_.y) / cell_));
  const double last = std::min<double>(marked_.height() - 1.0, std::floor((box.max.y + rounding_ - origin_.y) / cell_));
  for (double j = first; j <= last; ++j) {
    const auto row = bounded_whole<std::int64_t>(j);
    const Box interval = slice(convex, radius, std::clamp(row_y(row), box.min.y, box.max.y));
    if (!interval.empty()) mark_run(row, interval.min.x, interval.max.x);
  }
}

void LatticeMarking::mark_outside(std::span<const Vec2> piece, double radius, const Box& bounds) {
  const Box body = box_around(piece).grown(radius);
  const double everything = std::numeric_limits<double>::infinity();
  const double left = bounds.min.x - body.min.x;
  const double right = bounds.max.x - body.max.x;
  for (std::int64_t j = 0; j < marked_.height(); ++j) {
    const double y = row_y(j);
    if (y + body.min.y <= bounds.min.y + rounding_ || y + body.max.y >= bounds.max.y - rounding_) {
      mark_run(j, -everything, everything);
    } else {
      mark_run(j, -everything, left);
      mark_run(j, right, everything);
    }
  }
}

void LatticeMarking::mark_inside(std::span<const Vec2> polygon, Vec2 offset, const Execution& execution) {
  constexpr std::size_t sides_per_poll = std::size_t{1} << 16;
  const Box box = box_around(polygon);
  const double rows = marked_.height();
  // A row more on either side: the heights of rows are rounded, and what lies on none is not marked anyway.
  const auto row_near = [&](double y) { return std::clamp((y - offset.y - origin_.y) / cell_, -2.0, rows + 2.0); };
  const auto first = std::max<std::int64_t>(0, bounded_whole<std::int64_t>(std::floor(row_near(box.min.y))) - 1);
  const auto end = std::min<std::int64_t>(marked_.height(), bounded_whole<std::int64_t>(row_near(box.max.y)) + 2);
  std::vector<double> crossings;
  std::size_t sides = 0;
  for (std::int64_t j = first; j < end; ++j) {
    const double y = row_y(j) + offset.y;
    crossings.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (++sides % sides_per_poll == 0) execution.check();
      const Vec2 a = polygon[i];
      const Vec2 b = polygon[(i + 1) % polygon.size()];
      if ((a.y <= y) == (b.y <= y)) continue;
      crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) - offset.x);
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t c = 1; c < crossings.size(); c += 2) mark_run(j, crossings[c - 1], crossings[c]);
  }
}

std::vector<Segment> border_walls(const OccupancyMap& map, const Execution& execution) {
  std::vector<Segment> walls;
  const auto point = [&](std::int64_t x, std::int64_t y) {
    return world_point(map, {static_cast<double>(x), static_cast<double>(y)});
  };
  for_borders_between_rows(map.blocked, execution, [&](std::int64_t y, std::int64_t from, std::int64_t to) {
    walls.push_back({point(from, y), point(to, y)});
  });
  for_borders_between_rows(transposed(map.blocked, execution), execution,
                           [&](std::int64_t x, std::int64_t from, std::int64_t to) {
                             walls.push_back({point(x, from), point(x, to)});
                           });
  return walls;
}

void add_map_walls(Scene& scene, const Execution& execution) {
  if (scene.map && scene.walls.size() == 0) scene.walls = WallSet::narrowest(border_walls(*scene.map, execution));
}

const Scene& with_map_walls(const Scene& scene, std::optional<Scene>& copy, const Execution& execution) {
  if (!scene.map || scene.walls.size() > 0) return scene;
  copy = scene;
  add_map_walls(*copy, execution);
  return *copy;
}

OccupancyMap map_of_scene(const Scene& scene, double cell, const Execution& execution) {
  if (!(cell > 0.0) || !std::isfinite(cell)) throw InputError("cell", "must be above 0", std::to_string(cell));
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  if (box.empty()) throw InputError("world", "has neither walls nor bounds: nothing to draw as cells");
  constexpr double rounding = 1e-9;
  const double width = std::max(1.0, std::ceil(box.width() / cell - rounding));
  const double height = std::max(1.0, std::ceil(box.height() / cell - rounding));
  constexpr double too_many = 4294967295.0;
  if (!(width < too_many && height < too_many)) throw InputError("cell", "is too small for this world");
  check_map_size("cell", bounded_whole<std::uint64_t>(width), bounded_whole<std::uint64_t>(height));
  execution.reserve(bounded_whole<std::size_t>(width * height / 8));
  OccupancyMap map;
  map.source = scene.source;
  map.cell = cell;
  map.origin = box.min;
  // A cell is the square around its middle, and the middles are the lattice.
  LatticeMarking marking(box.min + Vec2{cell / 2, cell / 2}, cell, bounded_whole<std::uint32_t>(width),
                         bounded_whole<std::uint32_t>(height));
  const double half = cell / 2;
  const ConvexPiece square{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  const auto mark = [&](const Segment& s) {
    execution.check();  // it may meet all rows
    marking.mark_near(touching_positions(square, s), 0.0);
  };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) mark(scene.walls.segment(i));
  for (const ScenePolygon& polygon : scene.polygons) {
    for_each_side(polygon.corners, [&](Vec2 a, Vec2 b) { mark({a, b}); });
    marking.mark_inside(polygon.corners, {0.0, 0.0}, execution);
  }
  map.blocked = marking.take();
  map.occupied = map.blocked.count();
  map.free = map.blocked.size() - map.occupied;
  return map;
}

}  // namespace warren
