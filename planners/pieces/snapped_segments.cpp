// SPDX-License-Identifier: BSD-3-Clause
#include "planners/pieces/snapped_segments.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/polled_sort.hpp"
#include "planners/pieces/crossing_cuts.hpp"

namespace warren {
namespace {

constexpr double largest_integer = 0x1.0p29;
constexpr int most_rounds = 24;
constexpr std::size_t pieces_per_poll = 1 << 14;

SnapGrid grid_of(std::span<const Segment> segments) {
  Box box;
  for (const Segment& s : segments) box.include(box_of(s));
  SnapGrid grid;
  if (box.empty()) return grid;
  const double half = 0.5 * std::max(box.width(), box.height());
  int exponent = 0;
  if (half > 0.0) std::frexp(half / largest_integer, &exponent);  // half <= largest_integer * 2^exponent
  grid.unit = std::ldexp(1.0, exponent);
  const auto rounded = [&](double c) { return std::nearbyint(c / grid.unit) * grid.unit; };
  grid.origin = {rounded(0.5 * box.min.x + 0.5 * box.max.x), rounded(0.5 * box.min.y + 0.5 * box.max.y)};
  return grid;
}

Vec2 snapped(const SnapGrid& grid, Vec2 p) {
  return {std::nearbyint((p.x - grid.origin.x) / grid.unit), std::nearbyint((p.y - grid.origin.y) / grid.unit)};
}

/// Splits the pieces at their cuts, in order along each.
std::vector<IntegerPiece> split(const std::vector<IntegerPiece>& pieces, RawVector<Cut>& cuts,
                                const Execution& execution) {
  polled_sort(cuts.begin(), cuts.end(), execution, [](const Cut& c, const Cut& d) {
    return c.piece != d.piece ? c.piece < d.piece : is_before(c.at, d.at);
  });
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<IntegerPiece> parts;
  execution.reserve((pieces.size() + cuts.size()) * sizeof(IntegerPiece));
  parts.reserve(pieces.size() + cuts.size());
  auto cut = cuts.begin();
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (i % pieces_per_poll == 0) execution.check();
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

}  // namespace

SnappedSegments snap_segments(std::span<const Segment> segments, const Execution& execution) {
  if (segments.size() >= std::size_t{1} << 31) throw InputError("medial axis", "expected fewer than 2^31 segments");
  execution.reserve(segments.size() * (sizeof(IntegerPiece) + sizeof(SnappedSegment) + 16));
  SnappedSegments result{grid_of(segments), {}, 0.0};
  std::vector<IntegerPiece> pieces;
  pieces.reserve(segments.size());
  bool is_exact = true;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (i % pieces_per_poll == 0) execution.check();
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
  result.segments.reserve(pieces.size());
  for (const IntegerPiece& p : pieces) {
    result.segments.push_back({static_cast<std::int32_t>(p.a.x), static_cast<std::int32_t>(p.a.y),
                               static_cast<std::int32_t>(p.b.x), static_cast<std::int32_t>(p.b.y), p.source});
  }
  return result;
}

}  // namespace warren
