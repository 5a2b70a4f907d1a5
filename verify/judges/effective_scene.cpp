// SPDX-License-Identifier: BSD-3-Clause
// What prices do to places, by verify_price.hpp: which they close and open, and how dear they make them.
#include <bitset>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/verify_price.hpp"

namespace warren {
namespace {

constexpr double on_border = 1e-9;
constexpr double whole_turn = 2.0 * std::numbers::pi;

/// A mask's value in that use: a factor, >= 1; none: blocked.
std::optional<double> judged_factor(const PriceMask& mask, int value) {
  if (value <= 0) return 1.0;
  if (mask.kind == MaskKind::speed) {
    const double per_cent = mask.base + mask.multiplier * value;
    if (!(per_cent > 0.0)) return std::nullopt;
    return std::min(std::max(100.0 / per_cent, 1.0), largest_price);
  }
  if (mask.kind == MaskKind::keep_out) return value < 100 ? std::optional(1.0) : mask.factor;
  if (value >= 100) return std::nullopt;
  return 1.0 + (mask.factor.value_or(1.0) - 1.0) * value / 100.0;
}

/// A place in cells of the map; on the line between cells where it is within a billionth of it.
Vec2 judged_corner(const OccupancyMap& map, Vec2 in_world) {
  const Vec2 p = map_point(map, in_world);
  const auto on_line = [](double x) {
    const double line = std::floor(x + 0.5);
    return std::abs(x - line) <= on_border ? line + 0.0 : x;
  };
  return {on_line(p.x), on_line(p.y)};
}

/// Corner (column, row) of a mask's cells, in the world.
Vec2 mask_place(const MaskCells& mask, std::uint32_t column, std::uint32_t row) {
  const double x = mask.cell * column;
  const double y = mask.cell * row;
  if (mask.yaw_rad == 0.0) return mask.origin + Vec2{x, y};
  const auto [sine, cosine] = portable::sin_and_cos(mask.yaw_rad);
  return mask.origin + Vec2{x * cosine - y * sine, x * sine + y * cosine};
}

/// Which values, from 0 to 100, block a cell of the mask.
std::bitset<101> blocked_values(const PriceMask& mask) {
  std::bitset<101> blocked;
  for (int value = 0; value <= 100; ++value) blocked[as_whole<std::size_t>(value)] = !judged_factor(mask, value);
  return blocked;
}

/// The blocked cells of a mask, row by row in runs: calls run(row, first column, end).
template <class Run>
void blocked_runs(const PriceMask& mask, const Execution& execution, const Run& run) {
  const MaskCells& cells = *mask.read;
  const std::bitset<101> blocked = blocked_values(mask);
  for (std::uint32_t y = 0; y < cells.height; ++y) {
    execution.check();
    const auto is_blocked = [&](std::uint32_t x) {
      const int value = cells.values[std::size_t{y} * cells.width + x];
      return value > 0 && blocked[as_whole<std::size_t>(std::min(value, 100))];
    };
    for (std::uint32_t x = 0; x < cells.width; ++x) {
      if (!is_blocked(x)) continue;
      const std::uint32_t first = x;
      while (x < cells.width && is_blocked(x)) ++x;
      run(y, first, x);
    }
  }
}

/// Does a side meet the open square? Their boxes do, and corners lie on both sides of it.
bool passes(Vec2 a, Vec2 b, double x, double y) {
  if (!(std::max(a.x, b.x) > x && std::min(a.x, b.x) < x + 1.0)) return false;
  if (a == b) return true;
  int least = 1;
  int most = -1;
  for (const Vec2 corner : Box{{x, y}, {x + 1.0, y + 1.0}}.corners()) {
    const int side = exact::side_of(a, b, corner);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return least < 0 && most > 0;
}

/// Of one row of a map the cells that a side of the polygon passes through, and those whose middle is inside.
void close_row(OccupancyMap& map, std::span<const Vec2> corners, std::uint32_t row, std::vector<Segment>& around) {
  const double low = row;
  const double width = map.width();
  const auto close = [&](std::uint32_t x) {
    map.blocked.set(x, row);
    if (!map.water.empty()) map.water.clear(x, row);
  };
  around.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = exact::outline_side(corners, i);
    if ((a.y <= low + 0.5) != (b.y <= low + 0.5)) around.push_back(a.y < b.y ? Segment{a, b} : Segment{b, a});
    if (!(std::max(a.y, b.y) > low && std::min(a.y, b.y) < low + 1.0)) continue;
    const auto from = bounded_whole<std::uint32_t>(std::floor(std::min(a.x, b.x)), 0.0, width);
    const auto to = bounded_whole<std::uint32_t>(std::ceil(std::max(a.x, b.x)), 0.0, width);
    for (std::uint32_t x = from; x < to; ++x) {
      if (passes(a, b, x, low)) close(x);
    }
  }
  if (around.empty()) return;
  Box box;
  for (const Segment& side : around) box.include(box_of(side));
  const auto end = bounded_whole<std::uint32_t>(std::ceil(box.max.x), 0.0, width);
  for (auto x = bounded_whole<std::uint32_t>(std::floor(box.min.x), 0.0, width); x < end; ++x) {
    const auto left = std::count_if(around.begin(), around.end(), [&](const Segment& side) {
      return exact::side_of(side.a, side.b, {x + 0.5, low + 0.5}) < 0;  // upwards: its right is beyond it
    });
    if (left % 2 == 1) close(x);
  }
}

void restrict_map(OccupancyMap& map, const Prices& prices, const Execution& execution) {
  if (prices.opens_unknown()) map.blocked.remove(map.unknown, [&] { execution.check(); });
  std::vector<Vec2> corners;
  std::vector<Segment> around;  // sides that pass the middle of a row, upwards
  const auto close = [&] {
    Box box;
    for (const Vec2 p : corners) box.include(p);
    const auto first = bounded_whole<std::uint32_t>(std::floor(box.min.y), 0.0, map.height());
    const auto end = bounded_whole<std::uint32_t>(std::ceil(box.max.y), 0.0, map.height());
    for (std::uint32_t row = first; row < end; ++row) {
      execution.check();
      close_row(map, corners, row, around);
    }
  };
  for (const ScenePolygon& area : prices.keep_out) {
    corners.clear();
    for (const Vec2 p : area.corners) corners.push_back(judged_corner(map, p));
    close();
  }
  for (const PriceMask& mask : prices.masks) {
    blocked_runs(mask, execution, [&](std::uint32_t row, std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t x = first; x < end; ++x) {  // each its own square: lines between them are free
        corners.clear();
        for (const auto& [column, at] : {std::pair{x, row}, {x + 1, row}, {x + 1, row + 1}, {x, row + 1}}) {
          corners.push_back(judged_corner(map, mask_place(*mask.read, column, at)));
        }
        close();
      }
    });
  }
}

void restrict_plane(Scene& scene, const Prices& prices, const Execution& execution) {
  for (const ScenePolygon& area : prices.keep_out) scene.polygons.push_back(area);
  for (const PriceMask& mask : prices.masks) {
    blocked_runs(mask, execution, [&](std::uint32_t row, std::uint32_t first, std::uint32_t end) {
      scene.polygons.push_back({{mask_place(*mask.read, first, row), mask_place(*mask.read, end, row),
                                 mask_place(*mask.read, end, row + 1), mask_place(*mask.read, first, row + 1)},
                                0});
    });
  }
}

Vec2 in_mask(const MaskCells& mask, Vec2 in_world) {
  const auto [sine, cosine] = portable::sin_and_cos(mask.yaw_rad);
  const Vec2 d = in_world - mask.origin;
  const Vec2 turned = mask.yaw_rad == 0.0 ? d : Vec2{cosine * d.x + sine * d.y, cosine * d.y - sine * d.x};
  return (1.0 / mask.cell) * turned;
}

/// The least of the cells that the place is in, or on the border of.
template <class OfCell>
double least_at(Vec2 p, const OfCell& of_cell) {
  const auto cell = [](double x) { return bounded_whole<std::int64_t>(std::floor(x)); };
  return std::min(
      {of_cell(cell(p.x - on_border), cell(p.y - on_border)), of_cell(cell(p.x + on_border), cell(p.y - on_border)),
       of_cell(cell(p.x - on_border), cell(p.y + on_border)), of_cell(cell(p.x + on_border), cell(p.y + on_border))});
}

/// Adds the shares at which an arc crosses the line through `on` along a direction. Along the line's normal, which has
/// the angle b, a way of radius R from heading h to heading g leads R (sin(g - b) - sin(h - b)).
void add_crossings(const JudgedArc& arc, Vec2 on, Vec2 along, std::vector<double>& cuts) {
  const Vec2 normal = (1.0 / std::sqrt(dot(along, along))) * Vec2{-along.y, along.x};
  const double b = portable::atan2(normal.y, normal.x);
  const double off = dot(normal, on - arc.from) * arc.turn_rad / arc.length;
  const double sine = portable::sin(arc.heading_rad - b) + off;
  if (!(std::abs(sine) <= 1.0)) return;
  const double angle = portable::asin(sine);
  for (const double end : {angle, std::numbers::pi - angle}) {
    const double turned = std::remainder(b + end - arc.heading_rad, whole_turn);
    for (const double whole : {-whole_turn, 0.0, whole_turn}) {
      const double share = (turned + whole) / arc.turn_rad;
      if (share > 0.0 && share < 1.0) cuts.push_back(share);
    }
  }
}

/// The same for the lines of the unit grid that it may cross.
void add_grid_crossings(const JudgedArc& arc, std::vector<double>& cuts) {
  Box box;
  for (const double share : {0.0, 0.5, 1.0}) box.include(arc.at(share));
  box = box.grown(std::abs(arc.length) * 0.25);  // no place of a half is farther from its ends
  for (double x = std::ceil(box.min.x); x <= box.max.x; x += 1.0) add_crossings(arc, {x, 0.0}, {0.0, 1.0}, cuts);
  for (double y = std::ceil(box.min.y); y <= box.max.y; y += 1.0) add_crossings(arc, {0.0, y}, {1.0, 0.0}, cuts);
}

}  // namespace

std::optional<Scene> effective_scene(const Scene& scene, const Prices& prices, const Execution& execution) {
  for (const PriceMask& mask : prices.masks) {
    if (!mask.read) throw InputError(mask.file, "this mask has not been read");
  }
  const bool opens = prices.opens_unknown() && scene.map && !scene.map->unknown.empty();
  const auto blocks = [](const PriceMask& mask) { return blocked_values(mask).any(); };
  if (!opens && prices.keep_out.empty() && std::none_of(prices.masks.begin(), prices.masks.end(), blocks)) {
    return std::nullopt;
  }
  if (scene.map) execution.reserve(scene.map->blocked.bytes() + scene.map->unknown.bytes() + scene.map->water.bytes());
  Scene effective = scene;
  if (effective.map) {
    restrict_map(*effective.map, prices, execution);
  } else {
    restrict_plane(effective, prices, execution);
  }
  return effective;
}

Vec2 JudgedArc::at(double share) const {
  const double half = 0.5 * share * turn_rad;
  const double chord = half != 0.0 ? length * share * portable::sin(half) / half : length * share;
  const auto [sine, cosine] = portable::sin_and_cos(heading_rad + half);
  return from + chord * Vec2{cosine, sine};
}

void add_grid_lines(Vec2 from, Vec2 by, double length, std::vector<double>& cuts) {
  for (const auto& [at, slope] : {std::pair{from.x, by.x}, {from.y, by.y}}) {
    if (slope == 0.0) continue;
    const double end = at + slope * length;
    for (double line = std::ceil(std::min(at, end)); line <= std::max(at, end); line += 1.0) {
      const double t = (line - at) / slope;
      if (t > 0.0 && t < length) cuts.push_back(t);
    }
  }
}

JudgedFactors::JudgedFactors(const Scene& scene, const Prices& prices, const Execution& execution)
    : map_(scene.map ? &*scene.map : nullptr), execution_(execution) {
  if (map_ != nullptr && !map_->unknown.empty()) unknown_ = prices.unknown_factor();
  for (const PricedArea& area : prices.areas) {
    if (!(area.factor > 1.0)) continue;
    areas_.push_back({area.factor, {}});
    for (const Vec2 p : area.corners) areas_.back().corners.push_back(map_ != nullptr ? judged_corner(*map_, p) : p);
  }
  for (const PriceMask& mask : prices.masks) masks_.push_back(&mask);
}

double JudgedFactors::over(const Segment& leg) {
  const Segment own = map_ != nullptr ? Segment{map_point(*map_, leg.a), map_point(*map_, leg.b)} : leg;
  const JudgedRay ray(own);
  if (!(ray.length > 0.0)) return 0.0;  // places that differ in the world alone
  cuts_.clear();
  for (const Area& area : areas_) {
    for (std::size_t i = 0; i < area.corners.size(); ++i) {
      const Segment side = exact::outline_side(area.corners, i);
      const Vec2 along = side.b - side.a;
      const double t = cross(side.a - ray.from, along) / cross(ray.u, along);
      if (t > 0.0 && t < ray.length) cuts_.push_back(t);  // not NaN, where it runs along
    }
  }
  if (unknown_ > 1.0) add_grid_lines(ray.from, ray.u, ray.length, cuts_);
  const double to_world = distance(leg.a, leg.b) / ray.length;
  for (const PriceMask* mask : masks_) {
    const Vec2 from = in_mask(*mask->read, leg.a);
    add_grid_lines(from, (1.0 / ray.length) * (in_mask(*mask->read, leg.b) - from), ray.length, cuts_);
  }
  return to_world * sum_of_pieces(cuts_, ray.length, execution_, [&](double from, double to) {
           const double middle = 0.5 * (from + to);
           return (to - from) * (factor(ray.at(middle), leg.a + (middle / ray.length) * (leg.b - leg.a)) - 1.0);
         });
}

double JudgedFactors::over(const JudgedArc& arc) {
  constexpr double hardly = 1e-9;  // radians: then the bend is below rounding
  if (std::abs(arc.turn_rad) <= hardly) {
    const Segment leg{arc.from, arc.at(1.0)};
    return distance(leg.a, leg.b) > 0.0 ? over(leg) : 0.0;
  }
  const auto own = [&](Vec2 p) { return map_ != nullptr ? map_point(*map_, p) : p; };
  JudgedArc in_map = arc;
  if (map_ != nullptr) in_map = {own(arc.from), arc.heading_rad - map_->yaw_rad, arc.turn_rad, arc.length / map_->cell};
  cuts_.clear();
  for (const Area& area : areas_) {
    for (std::size_t i = 0; i < area.corners.size(); ++i) {
      const Segment side = exact::outline_side(area.corners, i);
      if (side.a != side.b) add_crossings(in_map, side.a, side.b - side.a, cuts_);
    }
  }
  if (unknown_ > 1.0) add_grid_crossings(in_map, cuts_);
  for (const PriceMask* mask : masks_) {
    const MaskCells& cells = *mask->read;
    add_grid_crossings(
        {in_mask(cells, arc.from), arc.heading_rad - cells.yaw_rad, arc.turn_rad, arc.length / cells.cell}, cuts_);
  }
  return std::abs(arc.length) * sum_of_pieces(cuts_, 1.0, execution_, [&](double from, double to) {
           const Vec2 middle = arc.at(0.5 * (from + to));
           return (to - from) * (factor(own(middle), middle) - 1.0);
         });
}

/// In the open polygon, and not within `on_border` of its outline. By how often it is wound around the place.
bool JudgedFactors::Area::holds(Vec2 p) const {
  int wound = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Segment s = exact::outline_side(corners, i);
    if (exact::distance(s, {p, p}) <= on_border) return false;
    if ((s.a.y <= p.y) == (s.b.y <= p.y)) continue;
    const int left = exact::side_of(s.a, s.b, p);
    if (s.a.y <= p.y ? left > 0 : left < 0) wound += left;
  }
  return wound != 0;
}

double JudgedFactors::factor(Vec2 p, Vec2 in_world) const {
  double greatest = 1.0;
  for (const Area& area : areas_) {
    if (area.factor > greatest && area.holds(p)) greatest = area.factor;
  }
  if (unknown_ > greatest) {
    greatest = std::max(greatest, least_at(p, [&](std::int64_t x, std::int64_t y) {
                          return map_->unknown.holds(x, y) ? unknown_ : 1.0;
                        }));
  }
  for (const PriceMask* mask : masks_) {
    const MaskCells& cells = *mask->read;
    greatest =
        std::max(greatest, least_at(in_mask(cells, in_world), [&](std::int64_t x, std::int64_t y) {
                   if (x < 0 || y < 0 || x >= cells.width || y >= cells.height) return 1.0;
                   return judged_factor(*mask, cells.values[as_whole<std::size_t>(y * cells.width + x)]).value_or(1.0);
                 }));
  }
  return greatest;
}

}  // namespace warren
