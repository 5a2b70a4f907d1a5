// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/noding.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "spatial/obstacles/segment_grid.hpp"

namespace warren {
namespace {

/// How far rounding to the nearest point of a grid moves a point at most, in units of the grid.
constexpr double rounding_units = 0.7072;

/// A place where a piece must be cut.
struct PieceCut {
  std::uint32_t piece;
  Vec2 at;
  friend bool operator==(const PieceCut&, const PieceCut&) = default;
};

struct CrossingCuts {
  RawVector<PieceCut> cuts;  ///< some more than once
  bool crossed = false;      ///< is one of them a rounded crossing?
};

Vec2 rounded_crossing(const IntegerPiece& p, const IntegerPiece& q) {
  const Vec2 along = p.b - p.a;
  const Vec2 other = q.b - q.a;
  const double t = std::clamp(cross(q.a - p.a, other) / cross(along, other), 0.0, 1.0);
  return {std::nearbyint(p.a.x + t * along.x), std::nearbyint(p.a.y + t * along.y)};
}

/// Where do two pieces have to be split? Ends that lie inside the other, and the rounded point of a crossing.
void cut_pair(const std::vector<IntegerPiece>& pieces, std::uint32_t i, std::uint32_t j, CrossingCuts& found,
              const Execution& execution) {
  const IntegerPiece& p = pieces[i];
  const IntegerPiece& q = pieces[j];
  const auto cut = [&](std::uint32_t number, const IntegerPiece& piece, Vec2 at) {
    if (!(at == piece.a) && !(at == piece.b)) push_asked(found.cuts, {number, at}, execution);
  };
  if (segments_cross({p.a, p.b}, {q.a, q.b})) {
    const Vec2 at = rounded_crossing(p, q);
    const std::size_t before = found.cuts.size();
    cut(i, p, at);
    cut(j, q, at);
    found.crossed = found.crossed || found.cuts.size() > before;
    return;
  }
  for (const Vec2 end : {q.a, q.b}) {
    if (on_segment(end, {p.a, p.b})) cut(i, p, end);
  }
  for (const Vec2 end : {p.a, p.b}) {
    if (on_segment(end, {q.a, q.b})) cut(j, q, end);
  }
}

/// What is left to cut. Throws Stopped at the deadline and the memory limit: crowded pieces have many cuts.
CrossingCuts find_cuts(const std::vector<IntegerPiece>& pieces, const Execution& execution) {
  CrossingCuts found;
  execution.reserve(pieces.size() * sizeof(Segment));
  std::vector<Segment> segments;
  segments.reserve(pieces.size());
  for (const IntegerPiece& p : pieces) segments.push_back({p.a, p.b});
  SegmentGrid(segments, execution).for_each_pair(segments, execution, [&](std::uint32_t i, std::uint32_t j) {
    cut_pair(pieces, i, j, found, execution);
    return true;
  });
  return found;
}

constexpr double largest_snapped = 0x1.0p29;
constexpr int most_rounds = 24;
constexpr std::size_t snapped_per_poll = 1 << 14;

/// The least power of two of which `most` times is no less than a size > 0; 1 for 0.
double unit_for(double size, double most) {
  int exponent = 0;
  if (size > 0.0) std::frexp(size / most, &exponent);
  return std::ldexp(1.0, exponent);
}

SnapGrid grid_of(std::span<const Segment> segments) {
  Box box;
  for (const Segment& s : segments) box.include(box_of(s));
  SnapGrid grid;
  if (box.empty()) return grid;
  grid.unit = unit_for(0.5 * std::max(box.width(), box.height()), largest_snapped);
  const auto rounded = [&](double c) { return std::nearbyint(c / grid.unit) * grid.unit; };
  grid.origin = {rounded(0.5 * box.min.x + 0.5 * box.max.x), rounded(0.5 * box.min.y + 0.5 * box.max.y)};
  return grid;
}

Vec2 snapped(const SnapGrid& grid, Vec2 p) {
  return {std::nearbyint((p.x - grid.origin.x) / grid.unit), std::nearbyint((p.y - grid.origin.y) / grid.unit)};
}

/// Splits the pieces at their cuts, in order along each.
std::vector<IntegerPiece> split(const std::vector<IntegerPiece>& pieces, RawVector<PieceCut>& cuts,
                                const Execution& execution) {
  polled_sort(cuts.begin(), cuts.end(), execution, [](const PieceCut& c, const PieceCut& d) {
    return c.piece != d.piece ? c.piece < d.piece : is_before(c.at, d.at);
  });
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<IntegerPiece> parts;
  execution.reserve((pieces.size() + cuts.size()) * sizeof(IntegerPiece));
  parts.reserve(pieces.size() + cuts.size());
  auto cut = cuts.begin();
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (i % snapped_per_poll == 0) execution.check();
    Vec2 from = pieces[i].a;
    for (; cut != cuts.end() && cut->piece == i; ++cut) {
      parts.push_back({from, cut->at, pieces[i].source});
      from = cut->at;
    }
    parts.push_back({from, pieces[i].b, pieces[i].source});
  }
  return parts;
}

/// Turns pieces to run from left to right and drops doubles (the lowest source stays).
void tidy(std::vector<IntegerPiece>& pieces, const Execution& execution) {
  for (IntegerPiece& p : pieces) {
    if (is_before(p.b, p.a)) std::swap(p.a, p.b);
  }
  polled_sort(pieces.begin(), pieces.end(), execution, [](const IntegerPiece& p, const IntegerPiece& q) {
    if (!(p.a == q.a)) return is_before(p.a, q.a);
    return p.b == q.b ? p.source < q.source : is_before(p.b, q.b);
  });
  const auto same = [](const IntegerPiece& p, const IntegerPiece& q) { return p.a == q.a && p.b == q.b; };
  pieces.erase(std::unique(pieces.begin(), pieces.end(), same), pieces.end());
}

constexpr double largest_integer = 0x1.0p45;

double largest_of(std::span<const Vec2> corners) {
  double largest = 0.0;
  for (const Vec2 p : corners) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

/// Appends the ring without corners that equal the one before; a ring that has no room is left empty.
void add_ring(std::vector<Vec2> ring, PolygonSet& to) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() < 3) ring.clear();
  to.add(ring);
}

PolygonSet rounded(const PolygonSet& polygons, double unit) {
  PolygonSet result;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::vector<Vec2> ring;
    for (const Vec2 p : polygons[i]) ring.push_back({std::nearbyint(p.x / unit), std::nearbyint(p.y / unit)});
    add_ring(std::move(ring), result);
  }
  return result;
}

/// Piece i is the side that begins at corner i.
std::vector<IntegerPiece> sides_of(const PolygonSet& polygons) {
  std::vector<IntegerPiece> sides;
  sides.reserve(polygons.corners.size());
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    for_each_side(polygons[p], [&](Vec2 a, Vec2 b) {
      sides.push_back({a, b, static_cast<std::uint32_t>(sides.size())});
    });
  }
  return sides;
}

/// Puts the cuts, in the order along their sides, between the sides' ends.
PolygonSet with_cuts(const PolygonSet& polygons, const std::vector<IntegerPiece>& sides, RawVector<PieceCut>& cuts,
                     const Execution& execution) {
  const auto along = [&](const PieceCut& c) {
    return dot(c.at - sides[c.piece].a, sides[c.piece].b - sides[c.piece].a);
  };
  polled_sort(cuts.begin(), cuts.end(), execution, [&](const PieceCut& c, const PieceCut& d) {
    if (c.piece != d.piece) return c.piece < d.piece;
    return along(c) != along(d) ? along(c) < along(d) : is_before(c.at, d.at);
  });
  PolygonSet result;
  auto cut = cuts.begin();
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    std::vector<Vec2> ring;
    for (std::uint32_t i = polygons.first[p]; i < polygons.first[p + 1]; ++i) {
      ring.push_back(polygons.corners[i]);
      for (; cut != cuts.end() && cut->piece == i; ++cut) ring.push_back(cut->at);
    }
    add_ring(std::move(ring), result);
  }
  return result;
}

}  // namespace

SnappedSegments snap_segments(std::span<const Segment> segments, const Execution& execution) {
  if (segments.size() >= std::size_t{1} << 31) throw InputError("medial axis", "expected fewer than 2^31 segments");
  execution.reserve(segments.size() * 2 * sizeof(IntegerPiece));
  SnappedSegments result{grid_of(segments), {}, 0.0};
  std::vector<IntegerPiece>& pieces = result.segments;
  pieces.reserve(segments.size());
  bool is_exact = true;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (i % snapped_per_poll == 0) execution.check();
    const Vec2 a = snapped(result.grid, segments[i].a);
    const Vec2 b = snapped(result.grid, segments[i].b);
    is_exact = is_exact && result.grid.at(a.x, a.y) == segments[i].a && result.grid.at(b.x, b.y) == segments[i].b;
    pieces.push_back({a, b, static_cast<std::uint32_t>(i)});
  }
  result.error = is_exact ? 0.0 : rounding_units * result.grid.unit;
  for (int round = 0;; ++round) {
    tidy(pieces, execution);
    CrossingCuts found = find_cuts(pieces, execution);
    if (found.cuts.empty()) break;
    if (round == most_rounds) throw InputError("medial axis", "obstacles cross too often within a rounding unit");
    if (found.crossed) result.error += rounding_units * result.grid.unit;
    pieces = split(pieces, found.cuts, execution);
  }
  return result;
}

NodedPolygons node_polygons(const PolygonSet& polygons, const Execution& execution) {
  if (polygons.corners.size() >= std::size_t{1} << 31) throw InputError("union", "expected fewer than 2^31 sides");
  const double unit = unit_for(largest_of(polygons.corners), largest_integer);
  NodedPolygons result{rounded(polygons, unit), rounding_units * unit};
  for (int round = 0;; ++round) {
    const std::vector<IntegerPiece> sides = sides_of(result.polygons);
    execution.reserve(sides.size() * (sizeof(IntegerPiece) + sizeof(Vec2)));
    CrossingCuts found = find_cuts(sides, execution);
    if (found.cuts.empty()) break;
    if (round == most_rounds) throw InputError("union", "outlines cross too often within a rounding unit");
    if (found.crossed) result.error += rounding_units * unit;
    result.polygons = with_cuts(result.polygons, sides, found.cuts, execution);
  }
  for (Vec2& corner : result.polygons.corners) corner = unit * corner;  // exact: a power of two
  return result;
}

}  // namespace warren
