// SPDX-License-Identifier: BSD-3-Clause
#include "planners/snapped_segments.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/geometry.hpp"

namespace warren {
namespace {

constexpr double largest_integer = 0x1.0p29;
constexpr int most_rounds = 24;
constexpr double rounding = 0.7072;  // of both coordinates, in units

/// A segment in grid units: integers, held as doubles.
struct Piece {
  Vec2 a, b;
  std::uint32_t source;
};

bool is_before(Vec2 p, Vec2 q) { return p.x < q.x || (p.x == q.x && p.y < q.y); }

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

/// The pieces' neighbourhoods: each is filed under the squares that its box meets, column by column along itself.
class PieceGrid {
 public:
  PieceGrid(const std::vector<Piece>& pieces, const Execution& execution) : pieces_(pieces) {
    for (const Piece& p : pieces) box_.include(box_of({p.a, p.b}));
    const double side = std::max({box_.width(), box_.height(), 1.0});
    columns_ = static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(pieces.size())), 1.0, 4096.0));
    square_ = side / static_cast<double>(columns_) * (1.0 + 1e-12);
    first_.assign(columns_ * columns_ + 1, 0);
    for (const Piece& p : pieces) for_each_square(p, [&](std::size_t s) { ++first_[s + 1]; });
    for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
    execution.reserve(first_.back() * sizeof(std::uint32_t));
    filed_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for_each_square(pieces[i], [&](std::size_t s) { filed_[next[s]++] = static_cast<std::uint32_t>(i); });
    }
  }

  /// Calls visit(i, j) for pieces i < j that share a square and whose boxes meet, some pairs more than once.
  template <class Visit>
  void for_each_pair(const Execution& execution, const Visit& visit) const {
    std::size_t polled = 0;
    for (std::size_t s = 0; s + 1 < first_.size(); ++s) {
      for (std::size_t k = first_[s]; k < first_[s + 1]; ++k) {
        if (++polled % 4096 == 0) execution.check();
        const Box box = box_of({pieces_[filed_[k]].a, pieces_[filed_[k]].b});
        for (std::size_t l = k + 1; l < first_[s + 1]; ++l) {
          if (box.meets(box_of({pieces_[filed_[l]].a, pieces_[filed_[l]].b}))) visit(filed_[k], filed_[l]);
        }
      }
    }
  }

 private:
  std::size_t index(double from_edge) const {
    return std::min(columns_ - 1, static_cast<std::size_t>(std::max(0.0, from_edge / square_)));
  }
  template <class Visit>
  void for_each_square(const Piece& piece, const Visit& visit) const {
    const Vec2 a = is_before(piece.b, piece.a) ? piece.b : piece.a;
    const Vec2 b = is_before(piece.b, piece.a) ? piece.a : piece.b;
    const std::size_t last = index(b.x - box_.min.x);
    for (std::size_t column = index(a.x - box_.min.x); column <= last; ++column) {
      const auto height_at = [&](double x) {
        if (x <= a.x) return a.y;
        return x >= b.x ? b.y : a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
      };
      const double left = box_.min.x + square_ * static_cast<double>(column);
      const double y1 = a.x == b.x ? a.y : height_at(left);
      const double y2 = a.x == b.x ? b.y : height_at(left + square_);
      const std::size_t top = index(std::max(y1, y2) + 1.0 - box_.min.y);
      for (std::size_t row = index(std::min(y1, y2) - 1.0 - box_.min.y); row <= top; ++row) {
        visit(row * columns_ + column);
      }
    }
  }

  const std::vector<Piece>& pieces_;
  Box box_;
  std::size_t columns_ = 1;
  double square_ = 1.0;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> filed_;
};

/// A place where a piece must be split.
struct Cut {
  std::uint32_t piece;
  Vec2 at;
  friend bool operator<(const Cut& c, const Cut& d) {
    return c.piece != d.piece ? c.piece < d.piece : is_before(c.at, d.at);
  }
  friend bool operator==(const Cut&, const Cut&) = default;
};

Vec2 rounded_crossing(const Piece& p, const Piece& q) {
  const Vec2 along = p.b - p.a;
  const Vec2 other = q.b - q.a;
  const double t = std::clamp(cross(q.a - p.a, other) / cross(along, other), 0.0, 1.0);
  return {std::nearbyint(p.a.x + t * along.x), std::nearbyint(p.a.y + t * along.y)};
}

/// Where do two pieces have to be split? Ends that lie inside the other, and the rounded point of a crossing.
void cut_pair(const std::vector<Piece>& pieces, std::uint32_t i, std::uint32_t j, std::vector<Cut>& cuts) {
  const Piece& p = pieces[i];
  const Piece& q = pieces[j];
  const auto cut = [&](std::uint32_t number, const Piece& piece, Vec2 at) {
    if (!(at == piece.a) && !(at == piece.b)) cuts.push_back({number, at});
  };
  if (segments_cross({p.a, p.b}, {q.a, q.b})) {
    const Vec2 at = rounded_crossing(p, q);
    cut(i, p, at);
    cut(j, q, at);
    return;
  }
  for (const Vec2 end : {q.a, q.b}) {
    if (on_segment(end, {p.a, p.b})) cut(i, p, end);
  }
  for (const Vec2 end : {p.a, p.b}) {
    if (on_segment(end, {q.a, q.b})) cut(j, q, end);
  }
}

/// Splits the pieces at their cuts, in order along each.
std::vector<Piece> split(const std::vector<Piece>& pieces, std::vector<Cut>& cuts) {
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<Piece> parts;
  parts.reserve(pieces.size() + cuts.size());
  auto cut = cuts.begin();
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
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
void tidy(std::vector<Piece>& pieces) {
  for (Piece& p : pieces) {
    if (is_before(p.b, p.a)) std::swap(p.a, p.b);
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& p, const Piece& q) {
    if (!(p.a == q.a)) return is_before(p.a, q.a);
    return p.b == q.b ? p.source < q.source : is_before(p.b, q.b);
  });
  const auto same = [](const Piece& p, const Piece& q) { return p.a == q.a && p.b == q.b; };
  pieces.erase(std::unique(pieces.begin(), pieces.end(), same), pieces.end());
}

}  // namespace

SnappedSegments snap_segments(std::span<const Segment> segments, const Execution& execution) {
  if (segments.size() >= std::size_t{1} << 31) throw InputError("medial axis", "expected fewer than 2^31 segments");
  execution.reserve(segments.size() * (sizeof(Piece) + sizeof(SnappedSegment) + 16));
  SnappedSegments result{grid_of(segments), {}, 0.0};
  std::vector<Piece> pieces;
  pieces.reserve(segments.size());
  bool is_exact = true;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Vec2 a = snapped(result.grid, segments[i].a);
    const Vec2 b = snapped(result.grid, segments[i].b);
    is_exact = is_exact && result.grid.at(a.x, a.y) == segments[i].a && result.grid.at(b.x, b.y) == segments[i].b;
    pieces.push_back({a, b, static_cast<std::uint32_t>(i)});
  }
  result.error = is_exact ? 0.0 : rounding * result.grid.unit;
  for (int round = 0;; ++round) {
    tidy(pieces);
    std::vector<Cut> cuts;
    bool crossed = false;
    const PieceGrid grid(pieces, execution);
    grid.for_each_pair(execution, [&](std::uint32_t i, std::uint32_t j) {
      const std::size_t before = cuts.size();
      cut_pair(pieces, i, j, cuts);
      crossed =
          crossed || (cuts.size() > before && segments_cross({pieces[i].a, pieces[i].b}, {pieces[j].a, pieces[j].b}));
    });
    if (cuts.empty()) break;
    if (round == most_rounds) throw InputError("medial axis", "obstacles cross too often within a rounding unit");
    if (crossed) result.error += rounding * result.grid.unit;
    pieces = split(pieces, cuts);
  }
  result.segments.reserve(pieces.size());
  for (const Piece& p : pieces) {
    result.segments.push_back({static_cast<std::int32_t>(p.a.x), static_cast<std::int32_t>(p.a.y),
                               static_cast<std::int32_t>(p.b.x), static_cast<std::int32_t>(p.b.y), p.source});
  }
  return result;
}

}  // namespace warren
