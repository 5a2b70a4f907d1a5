// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/convex_polygons.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"

namespace warren {
namespace {

/// The lowest corner, the leftmost of these.
std::size_t lowest(std::span<const Vec2> p) {
  std::size_t low = 0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p[i].y < p[low].y || (p[i].y == p[low].y && p[i].x < p[low].x)) low = i;
  }
  return low;
}

/// The directions of the sides from the lowest corner on: their angles ascend from 0 to below a full turn.
std::vector<Vec2> sides_from_lowest(std::span<const Vec2> p) {
  std::vector<Vec2> sides;
  if (p.size() < 2) return sides;
  const std::size_t low = lowest(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    sides.push_back(p[(low + i + 1) % p.size()] - p[(low + i) % p.size()]);
  }
  return sides;
}

/// Is the angle of a, in [0, 2 pi), smaller than b's?
bool before(Vec2 a, Vec2 b) {
  const auto upper = [](Vec2 v) { return v.y > 0.0 || (v.y == 0.0 && v.x > 0.0); };
  if (upper(a) != upper(b)) return upper(a);
  return orient2d({}, a, b) > 0;
}

using Ring = std::vector<std::size_t>;  // numbers of corners, counter-clockwise

/// Does the ring run clockwise? Asked at its lowest corner: there it is convex.
bool runs_clockwise(std::span<const Vec2> p) {
  const std::size_t low = lowest(p);
  // Corners on straight sides tell nothing: look for neighbours that turn.
  for (std::size_t step = 1; step < p.size(); ++step) {
    const int side = orient2d(p[(low + p.size() - 1) % p.size()], p[low], p[(low + step) % p.size()]);
    if (side != 0) return side < 0;
  }
  return false;
}

class Cutter {
 public:
  explicit Cutter(std::span<const Vec2> polygon) : corners_(polygon.begin(), polygon.end()) {
    if (runs_clockwise(polygon)) std::reverse(corners_.begin(), corners_.end());
  }

  std::vector<std::vector<Vec2>> pieces() {
    Ring ring(corners_.size());
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = i;
    drop_straight_corners(ring);
    if (is_convex(ring)) {
      rings_.push_back(ring);
    } else {
      clip_ears(ring);
      join_pieces();
    }
    std::vector<std::vector<Vec2>> pieces;
    for (const Ring& r : rings_) {
      std::vector<Vec2>& piece = pieces.emplace_back();
      for (const std::size_t i : r) piece.push_back(corners_[i]);
    }
    return pieces;
  }

 private:
  int turn(std::size_t a, std::size_t b, std::size_t c) const {
    return orient2d(corners_[a], corners_[b], corners_[c]);
  }
  static std::size_t at(const Ring& ring, std::size_t i) { return ring[i % ring.size()]; }

  void drop_straight_corners(Ring& ring) const {
    for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
      if (turn(at(ring, i + ring.size() - 1), ring[i], at(ring, i + 1)) == 0) {
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
        i = i == 0 ? 0 : i - 1;
      } else {
        ++i;
      }
    }
  }
  bool is_convex(const Ring& ring) const {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (turn(ring[i], at(ring, i + 1), at(ring, i + 2)) <= 0) return false;
    }
    return true;
  }
  bool is_ear(const Ring& ring, std::size_t i) const {
    const std::size_t a = at(ring, i + ring.size() - 1);
    const std::size_t b = ring[i];
    const std::size_t c = at(ring, i + 1);
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(ring.begin(), ring.end(), [&](std::size_t p) {
      if (corners_[p] == corners_[a] || corners_[p] == corners_[b] || corners_[p] == corners_[c]) return false;
      return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }
  void clip_ears(Ring ring) {
    while (ring.size() > 3) {
      std::size_t ear = 0;
      while (ear < ring.size() && !is_ear(ring, ear)) ++ear;
      if (ear == ring.size()) break;  // not simple: what is left is no polygon
      rings_.push_back({at(ring, ear + ring.size() - 1), ring[ear], at(ring, ear + 1)});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
      drop_straight_corners(ring);
    }
    if (turn(ring[0], ring[1], ring[2]) > 0) rings_.push_back(ring);
  }

  /// The two rings as one along their common side, or nothing where they have none or the union isn't convex.
  Ring joined(const Ring& a, const Ring& b) const {
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        if (a[i] != at(b, j + 1) || at(a, i + 1) != b[j]) continue;
        Ring ring;
        for (std::size_t k = 0; k < a.size(); ++k) ring.push_back(at(a, i + 1 + k));
        for (std::size_t k = 2; k < b.size(); ++k) ring.push_back(at(b, j + k));
        drop_straight_corners(ring);
        if (is_convex(ring)) return ring;
      }
    }
    return {};
  }
  void join_pieces() {
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      for (std::size_t j = i + 1; j < rings_.size();) {
        Ring ring = joined(rings_[i], rings_[j]);
        if (ring.empty()) {
          ++j;
          continue;
        }
        rings_[i] = std::move(ring);
        rings_.erase(rings_.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      }
    }
  }

  std::vector<Vec2> corners_;
  std::vector<Ring> rings_;
};

}  // namespace

std::vector<Vec2> minkowski_sum(std::span<const Vec2> a, std::span<const Vec2> b) {
  const std::vector<Vec2> of_a = sides_from_lowest(a);
  const std::vector<Vec2> of_b = sides_from_lowest(b);
  const std::size_t low_a = lowest(a);
  const std::size_t low_b = lowest(b);
  // Each corner is a corner of a and one of b: no sums of sums, so rounding doesn't add up.
  std::vector<Vec2> sum;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto corner = [&] { return a[(low_a + i) % a.size()] + b[(low_b + j) % b.size()]; };
  do {
    const Vec2 p = corner();
    if (sum.empty() || !(sum.back() == p)) sum.push_back(p);
    const bool a_first = j == of_b.size() || (i < of_a.size() && !before(of_b[j], of_a[i]));
    const bool b_first = i == of_a.size() || (j < of_b.size() && !before(of_a[i], of_b[j]));
    if (a_first && i < of_a.size()) ++i;
    if (b_first && j < of_b.size()) ++j;
  } while (i < of_a.size() || j < of_b.size());
  while (sum.size() > 1 && sum.front() == sum.back()) sum.pop_back();
  return sum;
}

std::vector<Vec2> polygon_around_disc(double radius, std::size_t corners) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(corners);
  const double reach = radius / portable::cos(0.5 * step);
  std::vector<Vec2> polygon;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = (static_cast<double>(i) + 0.5) * step;
    const auto [sine, cosine] = portable::sin_and_cos(angle);
    polygon.push_back({reach * cosine, reach * sine});
  }
  return polygon;
}

std::vector<std::vector<Vec2>> convex_pieces(std::span<const Vec2> polygon) { return Cutter(polygon).pieces(); }

}  // namespace warren
