// SPDX-License-Identifier: BSD-3-Clause
#include "planners/pieces/crossing_cuts.hpp"

#include <algorithm>
#include <cmath>

#include "core/plane/geometry.hpp"
#include "parallel/asked_growth.hpp"

namespace warren {
namespace {

constexpr std::size_t pieces_per_poll = 4096;

/// The pieces' neighbourhoods: each is filed under the squares that its box meets, column by column along itself.
class PieceGrid {
 public:
  PieceGrid(const std::vector<IntegerPiece>& pieces, const Execution& execution) : pieces_(pieces) {
    for (const IntegerPiece& p : pieces) box_.include(box_of({p.a, p.b}));
    const double side = std::max({box_.width(), box_.height(), 1.0});
    columns_ = static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(pieces.size())), 1.0, 4096.0));
    square_ = side / static_cast<double>(columns_) * (1.0 + 1e-12);
    const std::size_t squares = columns_ * columns_;
    execution.reserve((2 * squares + 1) * sizeof(std::size_t));
    assign_polled(first_, squares + 1, std::size_t{0}, [&] { execution.check(); });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (i % pieces_per_poll == 0) execution.check();
      for_each_square(pieces[i], [&](std::size_t s) { ++first_[s + 1]; });
    }
    RawVector<std::size_t> next(squares);
    for (std::size_t s = 0; s < squares; ++s) {
      if (s % pieces_per_poll == 0) execution.check();
      next[s] = first_[s];
      first_[s + 1] += first_[s];
    }
    execution.reserve(first_.back() * sizeof(std::uint32_t));
    filed_.resize(first_.back());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (i % pieces_per_poll == 0) execution.check();
      for_each_square(pieces[i], [&](std::size_t s) { filed_[next[s]++] = static_cast<std::uint32_t>(i); });
    }
  }

  /// Calls visit(i, j) for pieces i < j that share a square and whose boxes meet, some pairs more than once.
  template <class Visit>
  void for_each_pair(const Execution& execution, const Visit& visit) const {
    constexpr std::size_t looks_per_poll = 4096;  // exact ones take microseconds
    std::size_t looks = 0;
    for (std::size_t s = 0; s + 1 < first_.size(); ++s) {
      for (std::size_t k = first_[s]; k < first_[s + 1]; ++k) {
        const Box box = box_of({pieces_[filed_[k]].a, pieces_[filed_[k]].b});
        for (std::size_t l = k + 1; l < first_[s + 1]; ++l) {
          if (++looks % looks_per_poll == 0) execution.check();
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
  void for_each_square(const IntegerPiece& piece, const Visit& visit) const {
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

  const std::vector<IntegerPiece>& pieces_;
  Box box_;
  std::size_t columns_ = 1;
  double square_ = 1.0;
  RawVector<std::size_t> first_;
  RawVector<std::uint32_t> filed_;
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

}  // namespace

CrossingCuts find_cuts(const std::vector<IntegerPiece>& pieces, const Execution& execution) {
  CrossingCuts found;
  const PieceGrid grid(pieces, execution);
  grid.for_each_pair(execution, [&](std::uint32_t i, std::uint32_t j) { cut_pair(pieces, i, j, found, execution); });
  return found;
}

}  // namespace warren
