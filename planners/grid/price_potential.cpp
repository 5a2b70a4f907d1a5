// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/price_potential.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/whole.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/chunks.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {
namespace {

constexpr double half_diagonal = 0.7071067811865476;

/// The corners of a cell, anticlockwise; triangle i is between the middle, corner i and the next one.
constexpr std::array<std::array<std::uint32_t, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

Bitmap in_parts(const Bitmap& blocked, std::uint32_t parts, const Execution& execution) {
  execution.reserve(Bitmap::bytes_for(blocked.width() * parts, blocked.height() * parts));
  Bitmap finer(blocked.width() * parts, blocked.height() * parts);
  for (std::uint32_t y = 0; y < finer.height(); ++y) {
    execution.check();
    for (std::uint32_t x = 0; x < finer.width(); ++x) {
      if (blocked.test(x / parts, y / parts)) finer.set(x, y);
    }
  }
  return finer;
}

/// The triangles of all cells where the middle may be, and what length costs at least in each.
class PricedTriangles {
 public:
  PricedTriangles(const PotentialQuestion& question, const Execution& execution)
      : blocked_(question.blocked), question_(question), outside_(question.blocked) {
    const std::size_t cells = blocked_.size();
    execution.reserve(sizeof(float) * 4 * cells + 3 * sizeof(std::uint32_t) * cells);
    // Where the middle of the cell is nearer than this, all of the cell is nearer than what is kept.
    if (question.keeps > half_diagonal) {
      constexpr double rounding = 1e-8;
      outside_ = blocked_for_disc(blocked_, question.keeps * (1.0 - rounding) - half_diagonal, execution);
    }
    prices_.assign(4 * cells, 1.0F - 0x1p-23F);
    if (question.price > 0.0) price(execution);
  }

  std::uint32_t width() const { return blocked_.width(); }
  std::uint32_t height() const { return blocked_.height(); }
  bool is_outside(std::uint32_t x, std::uint32_t y) const { return outside_.test(x, y); }
  std::size_t number(std::uint32_t x, std::uint32_t y, std::size_t triangle) const {
    return 4 * (std::size_t{y} * width() + x) + triangle;
  }
  const std::vector<float>& prices() const { return prices_; }

 private:
  /// Of each cell, the nearest blocked row of its column, its own or above (below) it. Rows of the outside are -1 and
  /// height().
  std::vector<std::int32_t> nearest_rows(bool above, const Execution& execution) const {
    std::vector<std::int32_t> nearest(blocked_.size());
    std::vector<std::int32_t> last(width(), above ? as_whole<std::int32_t>(height()) : -1);
    for (std::uint32_t n = 0; n < height(); ++n) {
      execution.check();
      const std::uint32_t y = above ? height() - 1 - n : n;
      for (std::uint32_t x = 0; x < width(); ++x) {
        if (blocked_.test(x, y)) last[x] = as_whole<std::int32_t>(y);
        nearest[std::size_t{y} * width() + x] = last[x];
      }
    }
    return nearest;
  }

  /// No place of a triangle is farther from what is blocked than the farthest of its corners is from one square.
  void price(const Execution& execution) {
    const std::vector<std::int32_t> above = nearest_rows(true, execution);
    const std::vector<std::int32_t> below = nearest_rows(false, execution);
    const DistanceField field(blocked_, CellDistance::squares, true, execution);
    const double paid = question_.radius + question_.reach;
    const auto around = bounded_whole<std::int64_t>(std::ceil(paid) + 1.0, 1.0, 1e9);
    for_each_index<std::uint32_t>(height(), 16, execution, [&](std::uint32_t y) {
      for (std::uint32_t x = 0; x < width(); ++x) {
        if (is_outside(x, y) || field.distance(x, y) >= paid) continue;
        std::array<double, 4> farthest_sq;
        farthest_sq.fill(std::numeric_limits<double>::infinity());
        const std::int64_t left = std::max<std::int64_t>(-1, std::int64_t{x} - around);
        const std::int64_t right = std::min<std::int64_t>(width(), std::int64_t{x} + around);
        for (std::int64_t column = left; column <= right; ++column) {
          const double dx = static_cast<double>(column - std::int64_t{x});
          if (column < 0 || column == std::int64_t{width()}) {
            nearer_by_square(dx, 0.0, farthest_sq);
            continue;
          }
          const std::size_t at = std::size_t{y} * width() + as_whole<std::size_t>(column);
          nearer_by_square(dx, above[at] - static_cast<double>(y), farthest_sq);
          nearer_by_square(dx, below[at] - static_cast<double>(y), farthest_sq);
        }
        for (std::size_t i = 0; i < 4; ++i) {
          const double share = 1.0 - (std::sqrt(farthest_sq[i]) - question_.radius) / question_.reach;
          if (!(share > 0.0)) continue;
          constexpr double rounding = 1e-9;
          const double least = 1.0 + question_.price * std::min(share, 1.0) * std::min(share, 1.0) * (1.0 - rounding);
          prices_[number(x, y, i)] = static_cast<float>(least) * (1.0F - 0x1p-22F);
        }
      }
    });
  }

  /// The square whose lower left corner is so far from the cell's.
  static void nearer_by_square(double dx, double dy, std::array<double, 4>& farthest_sq) {
    const auto to = [&](double x, double y) {
      const double u = std::max({dx - x, x - dx - 1.0, 0.0});
      const double v = std::max({dy - y, y - dy - 1.0, 0.0});
      return u * u + v * v;
    };
    const double middle = to(0.5, 0.5);
    const std::array<double, 4> at{to(0, 0), to(1, 0), to(1, 1), to(0, 1)};
    for (std::size_t i = 0; i < 4; ++i) {
      farthest_sq[i] = std::min(farthest_sq[i], std::max({middle, at[i], at[(i + 1) % 4]}));
    }
  }

  const Bitmap& blocked_;
  const PotentialQuestion& question_;
  Bitmap outside_;
  std::vector<float> prices_;
};

class Marching {
 public:
  Marching(const PricedTriangles& triangles, const PotentialQuestion& question, const Execution& execution)
      : triangles_(triangles),
        question_(question),
        execution_(execution),
        prices_(triangles.prices()),
        goal_(cell_of(question.goal)),
        start_(cell_of(question.start)) {
    values_.width = triangles.width();
    values_.height = triangles.height();
    execution.reserve(values_.size() * (sizeof(double) + 1) + 4 * sizeof(float) * prices_.size());
    values_.values.resize(values_.size());
    is_done_.resize(values_.size());
  }

  /// Whether a way joins start and goal.
  bool march() {
    std::fill(values_.values.begin(), values_.values.end(), far);
    std::fill(is_done_.begin(), is_done_.end(), std::uint8_t{0});
    queue_.clear();
    if (triangles_.is_outside(goal_.x, goal_.y) || triangles_.is_outside(start_.x, start_.y)) return false;
    for (std::size_t i = 0; i < 4; ++i) {
      const double price = prices_[triangles_.number(goal_.x, goal_.y, i)];
      const auto first = [&](VertexId v, double x, double y) {
        offer(v, price * distance(question_.goal, Vec2{goal_.x + x, goal_.y + y}));
      };
      first(middle(goal_), 0.5, 0.5);
      first(corner(goal_, i), corners[i][0], corners[i][1]);
      first(corner(goal_, (i + 1) % 4), corners[(i + 1) % 4][0], corners[(i + 1) % 4][1]);
    }
    std::size_t left = 5;  // places around the start
    std::uint64_t turns = 0;
    double last = 0.0;
    while (!queue_.empty() && left > 0) {
      if (++turns % expansions_per_poll == 0) execution_.check();
      const QueueEntry next = queue_.pop();
      if (is_done_[next.vertex] != 0) continue;
      is_done_[next.vertex] = 1;
      last = std::max(last, next.key);
      if (next.vertex == middle(start_)) --left;
      for (std::size_t i = 0; i < 4; ++i) left -= next.vertex == corner(start_, i) ? 1 : 0;
      spread(next.vertex);
    }
    if (left > 0) return false;
    for (std::size_t v = 0; v < values_.size(); ++v) values_.values[v] = std::min(values_.values[v], last);
    return true;
  }

  /// How much too steep the worst triangle is; lowers the prices of those that are.
  double damp() {
    constexpr double harmless = 1.003;
    constexpr double more = 1.2;
    double worst = 1.0;
    for (std::uint32_t y = 0; y < values_.height; ++y) {
      if (y % 64 == 0) execution_.check();
      for (std::uint32_t x = 0; x < values_.width; ++x) {
        if (triangles_.is_outside(x, y)) continue;
        const double here = values_.values[middle({x, y})];
        double before = values_.values[corner({x, y}, 0)] - here;
        for (std::size_t i = 0; i < 4; ++i) {
          const double after = values_.values[corner({x, y}, (i + 1) % 4)] - here;
          const double slope_sq = 2.0 * (before * before + after * after);
          before = after;
          const std::size_t t = triangles_.number(x, y, i);
          const double price = triangles_.prices()[t];
          if (slope_sq <= price * price) continue;
          const double ratio = std::sqrt(slope_sq) / price;
          worst = std::max(worst, ratio);
          if (ratio > harmless) prices_[t] /= static_cast<float>(1.0 + more * (ratio - 1.0));
        }
      }
    }
    return worst;
  }

  double fall() const { return at(question_.start, start_) - at(question_.goal, goal_); }
  const CellPotential& values() const { return values_; }

 private:
  static constexpr double far = std::numeric_limits<double>::infinity();

  Cell cell_of(Vec2 p) const {
    return {bounded_whole<std::uint32_t>(p.x, 0.0, triangles_.width() - 1.0),
            bounded_whole<std::uint32_t>(p.y, 0.0, triangles_.height() - 1.0)};
  }
  VertexId middle(Cell c) const { return as_whole<VertexId>(values_.middle(c.x, c.y)); }
  VertexId corner(Cell c, std::size_t i) const {
    return as_whole<VertexId>(values_.corner(c.x + corners[i][0], c.y + corners[i][1]));
  }
  void offer(VertexId v, double value) {
    if (!(value < values_.values[v])) return;
    values_.values[v] = value;
    queue_.push(v, value);
  }

  /// All triangles around a place that is done.
  void spread(VertexId v) {
    const std::size_t row = std::size_t{values_.width} + 1;
    const auto y = as_whole<std::uint32_t>(v / row);
    const auto x = as_whole<std::uint32_t>(v % row);
    if (y > values_.height) return spread_from_middle({x, y - values_.height - 1});
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [dx, dy] = corners[i];
      if (x < dx || y < dy || x - dx >= values_.width || y - dy >= values_.height) continue;
      spread_from_corner({x - dx, y - dy}, i);
    }
  }
  void spread_from_middle(Cell cell) {
    if (triangles_.is_outside(cell.x, cell.y)) return;
    const double here = values_.values[middle(cell)];
    for (std::size_t i = 0; i < 4; ++i) {
      const double price = prices_[triangles_.number(cell.x, cell.y, i)];
      const VertexId a = corner(cell, i);
      const VertexId b = corner(cell, (i + 1) % 4);
      if (is_done_[a] == 0) offer(a, corner_value(here, known(b), price));
      if (is_done_[b] == 0) offer(b, corner_value(here, known(a), price));
    }
  }
  /// The two triangles of the cell that have the corner.
  void spread_from_corner(Cell cell, std::size_t at) {
    if (triangles_.is_outside(cell.x, cell.y)) return;
    const double here = values_.values[corner(cell, at)];
    const VertexId m = middle(cell);
    for (const std::size_t other : {(at + 1) % 4, (at + 3) % 4}) {
      const std::size_t triangle = other == (at + 1) % 4 ? at : other;
      const double price = prices_[triangles_.number(cell.x, cell.y, triangle)];
      const VertexId beside = corner(cell, other);
      if (is_done_[m] == 0) offer(m, middle_value(here, known(beside), price * half_diagonal));
      if (is_done_[beside] == 0) offer(beside, corner_value(known(m), here, price));
    }
  }
  double known(VertexId v) const { return is_done_[v] != 0 ? values_.values[v] : far; }

  /// From both ends of the legs of a right angle, each of which pays `leg`, or from one of them.
  static double middle_value(double a, double b, double leg) {
    if (a > b) std::swap(a, b);
    if (!(b - a < leg)) return a + leg;  // also where b is not known
    const double apart = b - a;
    return 0.5 * (a + b + std::sqrt(2.0 * leg * leg - apart * apart));
  }
  /// At a corner, from the middle and the corner beside it: from both where the way leads between them.
  static double corner_value(double middle, double beside, double price) {
    const double leg = price * half_diagonal;
    const double from_corner = beside + price;
    const double fall = middle - beside;
    if (!(fall > 0.0) || !(fall < std::numeric_limits<double>::infinity())) return std::min(middle + leg, from_corner);
    const double rest_sq = leg * leg - fall * fall;
    if (!(rest_sq >= fall * fall)) return from_corner;
    return middle + std::sqrt(rest_sq);
  }

  /// Linear in the triangle that holds the place.
  double at(Vec2 p, Cell cell) const {
    const double x = std::clamp(p.x - cell.x, 0.0, 1.0);
    const double y = std::clamp(p.y - cell.y, 0.0, 1.0);
    const std::size_t i = y <= x ? (y <= 1.0 - x ? 0 : 1) : (y <= 1.0 - x ? 3 : 2);
    const std::array<double, 4> share_along{x, y, 1.0 - x, 1.0 - y};
    const std::array<double, 4> share_in{y, 1.0 - x, 1.0 - y, x};
    const double a = values_.values[corner(cell, i)];
    const double b = values_.values[corner(cell, (i + 1) % 4)];
    const double m = values_.values[middle(cell)];
    return a + (b - a) * share_along[i] + ((m - a) + (m - b)) * share_in[i];
  }

  const PricedTriangles& triangles_;
  const PotentialQuestion& question_;
  const Execution& execution_;
  std::vector<float> prices_;
  Cell goal_;
  Cell start_;
  CellPotential values_;
  std::vector<std::uint8_t> is_done_;
  BucketQueue queue_{0.25};
};

}  // namespace

std::optional<PricePotential> price_potential(const PotentialQuestion& question, const PotentialEffort& effort,
                                              const Execution& execution) {
  const double parts = effort.parts;
  const Bitmap finer = effort.parts > 1 ? in_parts(question.blocked, effort.parts, execution) : Bitmap();
  const PotentialQuestion asked{effort.parts > 1 ? finer : question.blocked,
                                parts * question.start,
                                parts * question.goal,
                                parts * question.keeps,
                                parts * question.radius,
                                question.price,
                                parts * question.reach};
  const PricedTriangles triangles(asked, execution);
  Marching marching(triangles, asked, execution);
  PricePotential best;
  double divided_by = 1.0;
  for (std::uint32_t sweep = 0; sweep < effort.sweeps; ++sweep) {
    if (!marching.march()) return std::nullopt;
    const double worst = marching.damp();
    const double bound = marching.fall() / worst / parts;
    best.sweeps = sweep + 1;
    if (bound > best.bound || best.values.values.empty()) {
      best.bound = std::max(bound, 0.0);
      best.values = marching.values();
      divided_by = worst;
    }
    constexpr double flat = 1.0035;
    if (best.bound >= effort.enough && effort.enough > 0.0) break;
    if (worst < flat) break;
  }
  // Steps and differences are rounded to 2^-53 of themselves: this is more than all of that.
  constexpr double rounding = 1e-11;
  const double scale = (1.0 - rounding) / (divided_by * parts);
  for (double& value : best.values.values) value *= scale;
  best.bound = std::max(0.0, best.bound * (1.0 - 3.0 * rounding));
  return best;
}

}  // namespace warren
