// SPDX-License-Identifier: BSD-3-Clause
#include "planners/pieces/noded_polygons.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "parallel/polled_sort.hpp"
#include "planners/pieces/crossing_cuts.hpp"

namespace warren {
namespace {

constexpr double largest_integer = 0x1.0p45;
constexpr int most_rounds = 24;

double unit_for(std::span<const Vec2> corners) {
  double largest = 0.0;
  for (const Vec2 p : corners) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  int exponent = 0;
  if (largest > 0.0) std::frexp(largest / largest_integer, &exponent);  // largest <= largest_integer * 2^exponent
  return std::ldexp(1.0, exponent);
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
    const std::span<const Vec2> ring = polygons[p];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      sides.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], static_cast<std::uint32_t>(sides.size())});
    }
  }
  return sides;
}

/// Puts the cuts, in the order along their sides, between the sides' ends.
PolygonSet with_cuts(const PolygonSet& polygons, const std::vector<IntegerPiece>& sides, RawVector<Cut>& cuts,
                     const Execution& execution) {
  const auto along = [&](const Cut& c) { return dot(c.at - sides[c.piece].a, sides[c.piece].b - sides[c.piece].a); };
  polled_sort(cuts.begin(), cuts.end(), execution,
              [&](const Cut& c, const Cut& d) { return c.piece != d.piece ? c.piece < d.piece : along(c) < along(d); });
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

NodedPolygons node_polygons(const PolygonSet& polygons, const Execution& execution) {
  if (polygons.corners.size() >= std::size_t{1} << 31) throw InputError("union", "expected fewer than 2^31 sides");
  const double unit = unit_for(polygons.corners);
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
