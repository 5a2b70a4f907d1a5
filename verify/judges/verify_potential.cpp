// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_potential.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/whole.hpp"

namespace warren {
namespace {

/// More than what the few steps of each formula below are rounded by, as a share.
constexpr double rounding = 1e-12;

/// Blocked cells column by column, each a run of rows sorted from below: the nearest ones of a row by bisection.
class BlockedColumns {
 public:
  BlockedColumns(const OccupancyMap& map, const Execution& execution) : height_(map.height()), columns_(map.width()) {
    execution.reserve(sizeof(std::uint32_t) * map.blocked.count());
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      execution.check();
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (map.blocked.test(x, y)) columns_[x].push_back(y);
      }
    }
  }

  /// Calls visit(low, high) for squares x .. x + 1 of rows low .. high: of each direction the nearest. What lies beyond
  /// the map is blocked.
  template <class Visit>
  void around(std::int64_t x, std::uint32_t y, const Visit& visit) const {
    constexpr double endless = std::numeric_limits<double>::infinity();
    if (x < 0 || x >= as_whole<std::int64_t>(columns_.size())) return visit(-endless, endless);
    const std::vector<std::uint32_t>& rows = columns_[as_whole<std::size_t>(x)];
    const auto above = std::lower_bound(rows.begin(), rows.end(), y);
    if (above == rows.end()) {
      visit(height_, endless);
    } else {
      visit(*above, *above + 1.0);
    }
    if (above == rows.begin()) {
      visit(-endless, 0.0);
    } else {
      visit(*std::prev(above), *std::prev(above) + 1.0);
    }
  }

 private:
  double height_;
  std::vector<std::vector<std::uint32_t>> columns_;
};

double outside_by(double x, double low, double high) { return std::max({low - x, x - high, 0.0}); }

class Proof {
 public:
  Proof(const OccupancyMap& map, const PotentialClaim& claim, const CellPotential& proof, const Execution& execution)
      : map_(map),
        claim_(claim),
        proof_(proof),
        execution_(execution),
        parts_(proof.width / map.width()),
        columns_(map, execution) {}

  /// Of the first triangle that is too steep; empty: none is.
  std::string fault() const {
    for (std::uint32_t y = 0; y < proof_.height; ++y) {
      execution_.check();
      for (std::uint32_t x = 0; x < proof_.width; ++x) {
        if (map_.blocked.test(x / parts_, y / parts_)) continue;
        for (std::size_t i = 0; i < 4; ++i) {
          const double slope = slope_in(x, y, i);
          if (slope <= 1.0 - rounding) continue;
          const double least = least_price(x, y, i);
          if (slope * (1.0 + rounding) <= least) continue;
          return fmt::format("the certificate rises by {} a unit in its cell {}, {}, where a path pays {}", slope, x, y,
                             least);
        }
      }
    }
    return {};
  }

  /// What the certificate says of a place: not more, or not less, whatever is rounded. NaN outside of the map.
  double value(Vec2 place, double side) const {
    const Vec2 p = static_cast<double>(parts_) * map_point(map_, place);
    if (!(p.x >= 0.0 && p.y >= 0.0 && p.x <= proof_.width && p.y <= proof_.height)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const auto x = bounded_whole<std::uint32_t>(p.x, 0.0, proof_.width - 1.0);
    const auto y = bounded_whole<std::uint32_t>(p.y, 0.0, proof_.height - 1.0);
    // The middle's share falls from 1 to 0 at the rim, the rest is the two corners'.
    const Vec2 from_middle{p.x - x - 0.5, p.y - y - 0.5};
    const double rim = 2.0 * std::max(std::abs(from_middle.x), std::abs(from_middle.y));
    const bool is_flat = std::abs(from_middle.x) < std::abs(from_middle.y);  // below or above the middle
    const double along = is_flat ? from_middle.x : from_middle.y;
    const std::size_t column = x + (!is_flat && from_middle.x > 0.0 ? 1 : 0);
    const std::size_t row = y + (is_flat && from_middle.y > 0.0 ? 1 : 0);
    const double low = proof_.values[proof_.corner(column, row)];
    const double high = proof_.values[proof_.corner(column + (is_flat ? 1 : 0), row + (is_flat ? 0 : 1))];
    const double middle = proof_.values[proof_.middle(x, y)];
    const double at = (1.0 - rim) * middle + (0.5 * rim - along) * low + (0.5 * rim + along) * high;
    // A place is rounded where the map is turned or far from the origin; the slope is at most that of all prices.
    const double misplaced = 1e-14 * (norm(place) + norm(map_.origin) + map_.cell);
    const double most = std::abs(middle) + std::abs(low) + std::abs(high);
    return at + side * (rounding * 1e-2 * most + misplaced * (1.0 + claim_.price));
  }

 private:
  std::array<Vec2, 3> places(std::uint32_t x, std::uint32_t y, std::size_t i) const {
    constexpr std::array<Vec2, 5> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
    const Vec2 low{static_cast<double>(x), static_cast<double>(y)};
    const double cell = 1.0 / parts_;
    return {cell * (low + Vec2{0.5, 0.5}), cell * (low + around[i]), cell * (low + around[i + 1])};
  }

  /// By the legs of the right angle at the middle.
  double slope_in(std::uint32_t x, std::uint32_t y, std::size_t i) const {
    constexpr std::array<std::array<std::size_t, 2>, 5> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
    const double middle = proof_.values[proof_.middle(x, y)];
    const double a = proof_.values[proof_.corner(x + around[i][0], y + around[i][1])] - middle;
    const double b = proof_.values[proof_.corner(x + around[i + 1][0], y + around[i + 1][1])] - middle;
    return std::sqrt(2.0 * (a * a + b * b)) * parts_ / map_.cell;
  }

  /// Of length in the triangle; infinite where the middle can't be. The distance to a square is convex: nowhere in the
  /// triangle is it more than at one of the corners.
  double least_price(std::uint32_t x, std::uint32_t y, std::size_t i) const {
    const double keeps = claim_.keeps / map_.cell * (1.0 - 1e-9);
    const double radius = claim_.radius / map_.cell;
    const double reach = claim_.price > 0.0 ? claim_.reach / map_.cell : 0.0;
    const std::array<Vec2, 3> at = places(x, y, i);
    const std::uint32_t row = y / parts_;
    const std::int64_t column = x / parts_;
    const auto around = bounded_whole<std::int64_t>(std::max(keeps, radius + reach) + 2.0, 1.0, 1e9);
    double nearest_sq = std::numeric_limits<double>::infinity();
    for (std::int64_t c = std::max<std::int64_t>(-1, column - around);
         c <= std::min<std::int64_t>(map_.width(), column + around); ++c) {
      const auto low_x = static_cast<double>(c);
      columns_.around(c, row, [&](double low_y, double high_y) {
        double farthest_sq = 0.0;
        for (const Vec2 p : at) {
          const double dx = c < 0                             ? p.x
                            : c == std::int64_t{map_.width()} ? low_x - p.x
                                                              : outside_by(p.x, low_x, low_x + 1.0);
          const double dy = outside_by(p.y, low_y, high_y);
          farthest_sq = std::max(farthest_sq, dx * dx + dy * dy);
        }
        nearest_sq = std::min(nearest_sq, farthest_sq);
      });
    }
    const double farthest = std::sqrt(nearest_sq);
    if (farthest < keeps) return std::numeric_limits<double>::infinity();
    const double share = reach > 0.0 ? 1.0 - (farthest - radius) / reach : 0.0;
    if (!(share > 0.0)) return 1.0;
    return 1.0 + claim_.price * std::min(share, 1.0) * std::min(share, 1.0) * (1.0 - rounding);
  }

  const OccupancyMap& map_;
  const PotentialClaim& claim_;
  const CellPotential& proof_;
  const Execution& execution_;
  std::uint32_t parts_;
  BlockedColumns columns_;
};

}  // namespace

JudgedBound verify_potential(const OccupancyMap& map, const PotentialClaim& claim, const CellPotential& proof,
                             const Execution& execution) {
  const bool is_of_map = proof.width >= map.width() && proof.width % map.width() == 0 &&
                         proof.height % map.height() == 0 && proof.width / map.width() == proof.height / map.height() &&
                         proof.values.size() == proof.size();
  if (!is_of_map) {
    return {BoundVerdict::refuted,
            fmt::format("the certificate has {} x {} cells, which are no parts of the map's {} x {}", proof.width,
                        proof.height, map.width(), map.height())};
  }
  const Proof judged(map, claim, proof, execution);
  const double bound = judged.value(claim.start, -1.0) - judged.value(claim.goal, 1.0);
  if (!(claim.lower_bound <= std::max(bound, 0.0))) {
    return {BoundVerdict::refuted, fmt::format("the answer says {}, its certificate {}", claim.lower_bound, bound)};
  }
  const std::string fault = judged.fault();
  if (!fault.empty()) return {BoundVerdict::refuted, fault};
  return {BoundVerdict::checked, {}};
}

}  // namespace warren
