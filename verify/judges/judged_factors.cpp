// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/judged_factors.hpp"

#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/judges/effective_scene.hpp"

namespace warren {
namespace {

constexpr double on_border = 1e-9;
constexpr double whole_turn = 2.0 * std::numbers::pi;

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
  if (map_ != nullptr && !map_->unknown.empty()) unknown_ = prices.unknown.value_or(1.0);
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
  double sum = 0.0;
  for_pieces(cuts_, ray.length, execution_, [&](double from, double to) {
    const double middle = 0.5 * (from + to);
    sum += (to - from) * (factor(ray.at(middle), leg.a + (middle / ray.length) * (leg.b - leg.a)) - 1.0);
  });
  return sum * to_world;
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
  double sum = 0.0;
  for_pieces(cuts_, 1.0, execution_, [&](double from, double to) {
    const Vec2 middle = arc.at(0.5 * (from + to));
    sum += (to - from) * (factor(own(middle), middle) - 1.0);
  });
  return sum * std::abs(arc.length);
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
