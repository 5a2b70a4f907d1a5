// SPDX-License-Identifier: BSD-3-Clause
#include "planners/trees/rrt_connect.hpp"

#include <bit>
#include <cmath>

namespace warren {
namespace {

/// Row r of the grid stands at r + 1, so that every row has two neighbours.
using RowBits = std::array<std::uint64_t, PlaceGrid::most + 2>;

/// A column and a row.
struct Place {
  int x;
  int y;
};

/// The places of rows first .. last - 1 with their neighbours to the left and the right.
void widen(const RowBits& from, RowBits& to, std::size_t first, std::size_t last) {
  for (std::size_t r = first; r < last; ++r) to[r] = from[r] | (from[r] << 1) | (from[r] >> 1);
}

/// Places all of whose eight neighbours in the grid are set.
PlaceGrid narrowed(const PlaceGrid& grid) {
  PlaceGrid narrow = grid;
  const std::uint64_t all = ~std::uint64_t{0} >> (PlaceGrid::most - grid.columns);
  RowBits blocked{};
  RowBits wide{};
  for (std::size_t row = 0; row < grid.rows; ++row) blocked[row + 1] = ~grid.bits[row] & all;
  widen(blocked, wide, 1, grid.rows + 1);
  for (std::size_t row = 0; row < grid.rows; ++row) narrow.bits[row] &= ~(wide[row] | wide[row + 1] | wide[row + 2]);
  return narrow;
}

/// The flood of a grid from some places: which step, modulo 3, reached each place.
class FloodOfPlaces {
 public:
  FloodOfPlaces(const PlaceGrid& free, const RowBits& from) : free_(free), front_(from) {
    steps_[0] = from;
    first_ = free.rows + 1;
    for (std::size_t r = 1; r <= free.rows; ++r) {
      unseen_[r] = free.bits[r - 1] & ~from[r];
      if (from[r] == 0) continue;
      first_ = std::min(first_, r);
      last_ = r + 1;
    }
  }
  /// Takes steps until a place of `to` is reached: which one; x < 0 where none can be.
  Place reach(const RowBits& to) {
    Place met = common(to);
    RowBits wide{};
    while (met.x < 0) {
      widen(front_, wide, first_, last_);
      first_ = std::max<std::size_t>(1, first_ - 1);
      last_ = std::min(free_.rows + 1, last_ + 1);
      RowBits& reached = steps_[++step_ % 3];
      std::uint64_t any = 0;
      std::uint64_t arrived = 0;
      for (std::size_t r = first_; r < last_; ++r) {
        const std::uint64_t next = (wide[r - 1] | wide[r] | wide[r + 1]) & unseen_[r];
        front_[r] = next;
        unseen_[r] ^= next;
        reached[r] |= next;
        any |= next;
        arrived |= next & to[r];
      }
      if (any == 0) return {-1, -1};
      if (arrived != 0) met = common(to);
    }
    return met;
  }
  /// The places from the first to `last`. A neighbour of a place that step k reached, reached by step k - 1 modulo 3,
  /// was reached by step k - 1: the steps of neighbours differ by one at most.
  std::vector<Place> way_to(Place last) const {
    constexpr std::array<Place, 8> ways{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
    std::vector<Place> way(step_ + 1);
    way[step_] = last;
    std::size_t kept = 0;  // straight on where that is possible
    for (std::size_t step = step_; step-- > 0;) {
      for (std::size_t turn = 0; turn < ways.size(); ++turn) {
        const std::size_t way_number = (kept + turn) % ways.size();
        const Place p{way[step + 1].x + ways[way_number].x, way[step + 1].y + ways[way_number].y};
        if (!holds(steps_[step % 3], p)) continue;
        way[step] = p;
        kept = way_number;
        break;
      }
    }
    return way;
  }

 private:
  bool holds(const RowBits& set, Place p) const {
    return p.x >= 0 && p.y >= 0 && p.x < static_cast<int>(free_.columns) && p.y < static_cast<int>(free_.rows) &&
           (set[static_cast<std::size_t>(p.y) + 1] >> p.x & 1U) != 0;
  }
  Place common(const RowBits& to) const {
    for (std::size_t r = first_; r < last_; ++r) {
      if (const std::uint64_t met = front_[r] & to[r]; met != 0) {
        return {std::countr_zero(met), static_cast<int>(r) - 1};
      }
    }
    return {-1, -1};
  }

  const PlaceGrid& free_;
  RowBits front_;  // what the last step reached: rows first_ .. last_ - 1
  std::size_t first_ = 0;
  std::size_t last_ = 0;
  RowBits unseen_{};
  std::array<RowBits, 3> steps_{};
  std::size_t step_ = 0;
};

/// The free places next to p.
RowBits places_around(const PlaceGrid& free, Vec2 p) {
  RowBits near{};
  const double x = std::round((p.x - free.origin.x) / free.step);
  const double y = std::round((p.y - free.origin.y) / free.step);
  const bool is_near =
      std::abs(x) <= static_cast<double>(free.columns) && std::abs(y) <= static_cast<double>(free.rows);
  if (!is_near) return near;
  for (double row = y - 1.0; row <= y + 1.0; row += 1.0) {
    if (!(row >= 0.0 && row < static_cast<double>(free.rows))) continue;
    for (double column = x - 1.0; column <= x + 1.0; column += 1.0) {
      if (!(column >= 0.0 && column < static_cast<double>(free.columns))) continue;
      near[static_cast<std::size_t>(row) + 1] |= std::uint64_t{1} << static_cast<std::size_t>(column);
    }
  }
  for (std::size_t row = 0; row < free.rows; ++row) near[row + 1] &= free.bits[row];
  return near;
}

/// Are the places next to the straight line free?
bool is_straight(const PlaceGrid& free, Place a, Place b) {
  const int steps = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
  const double share = 1.0 / steps;
  const double dx = share * (b.x - a.x);
  const double dy = share * (b.y - a.y);
  double x = a.x + 0.5;
  double y = a.y + 0.5;
  for (int i = 1; i < steps; ++i) {
    x += dx;
    y += dy;
    if (!free.test(static_cast<std::size_t>(x), static_cast<std::size_t>(y))) return false;
  }
  return true;
}

PlaceWay straightened(const PlaceGrid& free, const std::vector<Place>& way, Vec2 start, Vec2 goal) {
  PlaceWay found;
  found.places.reserve(way.size() + 2);
  found.places.push_back(start);
  found.corners.push_back(0);
  for (const Place p : way)
    found.places.push_back(free.at(static_cast<std::size_t>(p.x), static_cast<std::size_t>(p.y)));
  std::size_t from = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (i == from + 1 || is_straight(free, way[from], way[i])) continue;
    from = i - 1;
    found.corners.push_back(static_cast<std::uint32_t>(from + 1));
  }
  found.corners.push_back(static_cast<std::uint32_t>(found.places.size()));
  found.places.push_back(goal);
  return found;
}

PlaceWay way_over(const PlaceGrid& free, Vec2 start, Vec2 goal) {
  FloodOfPlaces flood(free, places_around(free, start));
  const Place last = flood.reach(places_around(free, goal));
  return last.x < 0 ? PlaceWay{} : straightened(free, flood.way_to(last), start, goal);
}

}  // namespace

PlaceWay way_over_places(const PlaceGrid& free, Vec2 start, Vec2 goal) {
  if (free.columns == 0 || free.rows == 0) return {};
  PlaceWay way = way_over(narrowed(free), start, goal);
  return way.corners.empty() ? way_over(free, start, goal) : way;
}

}  // namespace warren
