// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/prices/map_prices.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {
namespace {

constexpr double on_border = 1e-9;

/// A mask's value in that use: its factor, >= 1; none: blocked.
std::optional<double> mask_factor(const PriceMask& mask, int value) {
  if (value <= 0) return 1.0;
  if (mask.kind == MaskKind::speed) {
    const double limit = mask.base + mask.multiplier * value;  // per cent
    if (!(limit > 0.0)) return std::nullopt;
    return std::clamp(100.0 / limit, 1.0, largest_price);
  }
  if (mask.kind == MaskKind::keep_out) return value >= 100 ? mask.factor : std::optional(1.0);
  if (value >= 100) return std::nullopt;
  return 1.0 + (mask.factor.value_or(1.0) - 1.0) * value / 100.0;
}

/// Is that so of some value's factor?
template <class Is>
bool some_factor(const PriceMask& mask, const Is& is) {
  for (int value = 1; value <= 100; ++value) {
    if (is(mask_factor(mask, value))) return true;
  }
  return false;
}

/// Calls each(cells, x, y, factor) for the cells of value > 0 of the masks that were read.
template <class Each>
void for_mask_cells(const Prices& prices, const Execution& execution, const Each& each) {
  for (const PriceMask& mask : prices.masks) {
    if (!mask.read) continue;
    const MaskCells& cells = *mask.read;
    for (std::uint32_t y = 0; y < cells.height; ++y) {
      execution.check();
      for (std::uint32_t x = 0; x < cells.width; ++x) {
        const int value = cells.values[std::size_t{y} * cells.width + x];
        if (value > 0) each(cells, x, y, mask_factor(mask, value));
      }
    }
  }
}

/// Corner (column, row) of a mask's cells, in the world.
Vec2 mask_corner(const MaskCells& mask, double column, double row) {
  const Vec2 p{mask.cell * column, mask.cell * row};
  return mask.origin + (mask.yaw_rad == 0.0 ? p : Rotation(mask.yaw_rad)(p));
}

std::array<Vec2, 4> mask_square_in_world(const MaskCells& mask, std::uint32_t x, std::uint32_t y) {
  return {mask_corner(mask, x, y), mask_corner(mask, x + 1.0, y), mask_corner(mask, x + 1.0, y + 1.0),
          mask_corner(mask, x, y + 1.0)};
}

/// A corner in cells of the map; see the head.
Vec2 corner_in_cells(const OccupancyMap& map, Vec2 in_world) {
  Vec2 p = map_point(map, in_world);
  for (double* x : {&p.x, &p.y}) {
    const double line = std::round(*x);
    if (std::abs(*x - line) <= on_border) *x = line + 0.0;
  }
  return p;
}

/// The four corners of a mask's cell, anticlockwise, in cells of the map.
std::array<Vec2, 4> mask_square(const OccupancyMap& map, const MaskCells& mask, std::uint32_t x, std::uint32_t y) {
  std::array<Vec2, 4> corners = mask_square_in_world(mask, x, y);
  for (Vec2& p : corners) p = corner_in_cells(map, p);
  return corners;
}

/// Does the closed segment meet the open unit square at `low`? Three axes part what does not: x, y, and across it.
bool meets_square(const Segment& s, Vec2 low) {
  const Box box = box_of(s);
  const Vec2 high = low + Vec2{1.0, 1.0};
  if (!(box.max.x > low.x && box.min.x < high.x && box.max.y > low.y && box.min.y < high.y)) return false;
  if (s.a == s.b) return true;
  bool left = false;
  bool right = false;
  for (const Vec2 corner : Box{low, high}.corners()) {
    const int side = orient2d(s.a, s.b, corner);
    left |= side > 0;
    right |= side < 0;
  }
  return left && right;
}

/// In the polygon, and not on the border.
bool is_inside(std::span<const Vec2> corners, Vec2 p) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (distance(p, polygon_side(corners, i)) <= on_border) return false;
  }
  return contains(corners, p);
}

/// Sets the bits of all cells whose open square meets the open polygon; corners in cells.
void add_polygon_cells(Bitmap& cells, std::span<const Vec2> corners, const Execution& execution) {
  const Box box = box_around(corners);
  const auto whole = [](double x, std::uint32_t end) { return bounded_whole<std::uint32_t>(x, 0.0, end); };
  const std::uint32_t first_x = whole(std::floor(box.min.x), cells.width());
  const std::uint32_t last_x = whole(std::ceil(box.max.x), cells.width());
  const std::uint32_t last_y = whole(std::ceil(box.max.y), cells.height());
  for (std::uint32_t y = whole(std::floor(box.min.y), cells.height()); y < last_y; ++y) {
    execution.check();
    std::vector<std::size_t> sides;  // that come near the row
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Box side = box_of(polygon_side(corners, i));
      if (side.max.y > y && side.min.y < y + 1.0) sides.push_back(i);
    }
    for (std::uint32_t x = first_x; x < last_x; ++x) {
      if (x % 64 == 0) execution.check();
      const Vec2 low{static_cast<double>(x), static_cast<double>(y)};
      const bool is_met = std::any_of(sides.begin(), sides.end(),
                                      [&](std::size_t i) { return meets_square(polygon_side(corners, i), low); });
      if (is_met || contains(corners, low + Vec2{0.5, 0.5})) cells.set(x, y);
    }
  }
}

/// The least of the cells of a unit grid that a place is in, or on the border of.
template <class OfCell>
double least_around(Vec2 at, const OfCell& of_cell) {
  double least = std::numeric_limits<double>::infinity();
  for (const double dy : {-on_border, on_border}) {
    for (const double dx : {-on_border, on_border}) {
      least = std::min(least, of_cell(bounded_whole<std::int64_t>(std::floor(at.x + dx)),
                                      bounded_whole<std::int64_t>(std::floor(at.y + dy))));
    }
  }
  return least;
}

constexpr double half_diagonal = 0.70710678118654757;
constexpr double units = 1 << 20;  // of steps, a cell

/// (1 - (d - radius) / D)^2 is so much, over the price, as (1 - d / (D + radius))^2.
double clearance_scale(const ClearancePrice& price, double radius) {
  const double share = (clearance_reach(price, radius) + radius) / clearance_reach(price, radius);
  return price.price * share * share;
}

/// The pieces of a leg, cell by cell: calls piece(cell, u, from, to), u being the leg's direction, of length 1, which
/// says how far beyond `to` nothing is to be seen. Nothing of a leg without length. A piece begins where the leg enters
/// its cell, also behind what was left out: sums are the same however far is seen.
template <class Piece>
void walk_cells(const OccupancyMap& map, Vec2 a, Vec2 b, const Piece& piece) {
  const double length = distance(a, b);
  if (!(length > 0.0)) return;
  const Vec2 u = (1.0 / length) * (b - a);
  struct Lines {
    double at;     // where the leg begins
    double slope;  // by arc length
    double line;   // the next one
    void go_on(double t) {
      line = slope > 0.0 ? std::floor(at + slope * t) + 1.0 : std::ceil(at + slope * t) - 1.0;
      if (next() <= t) line += slope > 0.0 ? 1.0 : -1.0;
    }
    double next() const { return slope == 0.0 ? std::numeric_limits<double>::infinity() : (line - at) / slope; }
    double before() const {
      return slope == 0.0 ? -std::numeric_limits<double>::infinity() : (line - std::copysign(1.0, slope) - at) / slope;
    }
  };
  Lines columns{a.x, u.x, 0.0};
  Lines rows{a.y, u.y, 0.0};
  double t = 0.0;
  columns.go_on(t);
  rows.go_on(t);
  while (t < length) {
    const double to = std::min({columns.next(), rows.next(), length});
    const Vec2 middle = a + 0.5 * (t + to) * u;
    const Cell cell{bounded_whole<std::uint32_t>(middle.x, 0.0, map.width() - 1.0),
                    bounded_whole<std::uint32_t>(middle.y, 0.0, map.height() - 1.0)};
    const double seen = to > t ? piece(cell, u, t, to) : 0.0;
    t = to;
    if (seen > 0.0) {
      columns.go_on(to + seen);
      rows.go_on(to + seen);
      t = std::max({to, columns.before(), rows.before()});
    }
    if (columns.next() <= t) columns.go_on(t);
    if (rows.next() <= t) rows.go_on(t);
  }
}

/// The set bits of a row that are nearest to x, to its left and from it on to the right; beyond `far`: none is nearer.
std::pair<std::int64_t, std::int64_t> nearest_set(std::span<const std::uint64_t> row, std::int64_t x,
                                                  std::int64_t far) {
  const auto words = as_whole<std::int64_t>(row.size());
  const std::uint64_t from_x = ~std::uint64_t{0} << x % 64;
  std::int64_t w = x / 64;
  std::uint64_t word = row[as_whole<std::size_t>(w)] & from_x;
  while (word == 0 && ++w < words && 64 * w - x <= far) word = row[as_whole<std::size_t>(w)];
  const std::int64_t right = word != 0 ? 64 * w + std::countr_zero(word) : x + far + 1;
  w = x / 64;
  word = row[as_whole<std::size_t>(w)] & ~from_x;
  while (word == 0 && --w >= 0 && x - (64 * w + 63) <= far) word = row[as_whole<std::size_t>(w)];
  return {word != 0 ? 64 * w + 63 - std::countl_zero(word) : x - far - 1, right};
}

double squared_distance(const MapPrices::Site& site, Vec2 p) {
  const double x = site.dx == 0.0 ? 0.0 : site.at.x - p.x;
  const double y = site.dy == 0.0 ? 0.0 : site.at.y - p.y;
  return x * x + y * y;
}

/// Is `a` at least as near as `b` in all of the cell? Where a corner is nearer than another, or than a side, is convex:
/// the cell's corners say it. A side is nearer than all that is farther to the same side.
bool hides(const MapPrices::Site& a, const MapPrices::Site& b, Cell cell) {
  if (a.dx == 0.0) return a.dy == b.dy && a.dy * (b.at.y - a.at.y) >= 0.0;
  if (a.dy == 0.0) return a.dx == b.dx && a.dx * (b.at.x - a.at.x) >= 0.0;
  for (const Vec2 corner : Box{{cell.x + 0.0, cell.y + 0.0}, {cell.x + 1.0, cell.y + 1.0}}.corners()) {
    if (squared_distance(b, corner) < squared_distance(a, corner)) return false;
  }
  return true;
}

/// The segment as it is seen from a leg, where that passes `middle` and nothing changes.
StretchDistance seen(const Segment& side, Vec2 p, Vec2 u, Vec2 middle) {
  const Vec2 along = side.b - side.a;
  const double foot = dot(middle - side.a, along);
  if (!(foot > 0.0)) return StretchDistance::corner(side.a, p, u);
  if (foot >= dot(along, along)) return StretchDistance::corner(side.b, p, u);
  const Vec2 normal = (1.0 / norm(along)) * Vec2{-along.y, along.x};
  const double turned = dot(middle - side.a, normal) < 0.0 ? -1.0 : 1.0;
  return StretchDistance::side(turned * dot(p - side.a, normal), turned * dot(u, normal));
}

/// Distances are compared by their squares.
double squared(const StretchDistance& thing, double t) {
  const double side = thing.at_begin + thing.slope * t;
  return thing.is_side ? side * side : (t - thing.foot) * (t - thing.foot) + thing.apart_sq;
}
double least_squared(const StretchDistance& thing, double from, double to) {
  if (!thing.is_side) return squared(thing, std::clamp(thing.foot, from, to));
  return std::min(squared(thing, from), squared(thing, to));
}

/// The integral of sqrt(v^2 + k) between two places of which `from_d` and `to_d` are the values.
double integral_of_root(double from, double to, double from_d, double to_d, double k) {
  const double plain = to * to_d - from * from_d;
  if (!(k > 0.0)) return 0.5 * plain;
  const double ratio = from >= 0.0 ? (to + to_d) / (from + from_d)
                       : to <= 0.0 ? (from_d - from) / (to_d - to)
                                   : (to + to_d) * (from_d - from) / k;
  return 0.5 * (plain + k * portable::log(ratio));
}

double integral_of_one(const StretchDistance& thing, double from, double to, double reach) {
  const double length = to - from;
  if (thing.is_side) {
    const double a = 1.0 - thing(from) / reach;
    const double b = 1.0 - thing(to) / reach;
    return length * (a * a + a * b + b * b) / 3.0;
  }
  const double a = from - thing.foot;
  const double b = to - thing.foot;
  const double roots = integral_of_root(a, b, thing(from), thing(to), thing.apart_sq);
  const double squares = length * ((a * a + a * b + b * b) / 3.0 + thing.apart_sq);
  return std::max(0.0, length - 2.0 / reach * roots + squares / (reach * reach));
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The roots of a t^2 - 2 b t + c, both; NaN where there are none.
std::pair<double, double> roots_of(double a, double b, double c) {
  const double inside = b * b - a * c;
  if (inside < 0.0) return {none, none};
  const double root = std::sqrt(inside);
  const double larger = b >= 0.0 ? b + root : b - root;
  if (larger == 0.0) return {a == 0.0 ? none : 0.0, none};
  return {c / larger, a == 0.0 ? none : larger / a};
}

/// Where the two are equally far: up to two places, NaN for none.
std::pair<double, double> meetings(const StretchDistance& one, const StretchDistance& other) {
  if (one.is_side && other.is_side) return {(other.at_begin - one.at_begin) / (one.slope - other.slope), none};
  if (!one.is_side && !other.is_side) {
    const double apart = one.foot - other.foot;
    return {0.5 * (one.foot + other.foot + (one.apart_sq - other.apart_sq) / apart), none};
  }
  const StretchDistance& side = one.is_side ? one : other;
  const StretchDistance& corner = one.is_side ? other : one;
  // (t - foot)^2 + apart^2 = (at_begin + slope t)^2, with t from the foot so that the numbers are small
  const double at_foot = side(corner.foot);
  const auto [first, second] =
      roots_of(1.0 - side.slope * side.slope, side.slope * at_foot, corner.apart_sq - at_foot * at_foot);
  return {corner.foot + first, corner.foot + second};
}

/// Where the distance is the reach.
std::pair<double, double> ends_of_reach(const StretchDistance& thing, double reach) {
  if (thing.is_side) return {(reach - thing.at_begin) / thing.slope, none};
  const double half = std::sqrt(reach * reach - thing.apart_sq);  // NaN where it is farther everywhere
  return {thing.foot - half, thing.foot + half};
}

}  // namespace

bool restricts(const Prices& prices) {
  if (!prices.keep_out.empty() || prices.opens_unknown()) return true;
  return std::any_of(prices.masks.begin(), prices.masks.end(), [](const PriceMask& mask) {
    return some_factor(mask, [](const auto& factor) { return !factor; });
  });
}

OccupancyMap effective_map(OccupancyMap map, const Prices& prices, const Execution& execution) {
  const auto poll = [&] { execution.check(); };
  if (prices.opens_unknown()) map.blocked.remove(map.unknown, poll);
  Bitmap forbidden = cell_bitmap(map.width(), map.height(), execution);
  for (const ScenePolygon& area : prices.keep_out) {
    std::vector<Vec2> corners;
    for (const Vec2 p : area.corners) corners.push_back(corner_in_cells(map, p));
    add_polygon_cells(forbidden, corners, execution);
  }
  for_mask_cells(prices, execution, [&](const MaskCells& cells, std::uint32_t x, std::uint32_t y, const auto& factor) {
    if (!factor) add_polygon_cells(forbidden, mask_square(map, cells, x, y), execution);
  });
  map.blocked.add(forbidden, poll);
  map.water.remove(forbidden, poll);  // it is blocked all the same: but to paths that begin on it
  map.free = map.blocked.size() - map.blocked.count();
  return map;
}

Scene restricted_scene(const Scene& scene, const Prices& prices, const Execution& execution) {
  std::size_t bytes = scene.walls.bytes();
  if (const auto& map = scene.map) bytes += map->blocked.bytes() + map->unknown.bytes() + map->water.bytes();
  for (const ScenePolygon& area : scene.polygons) bytes += sizeof area + area.corners.size() * sizeof(Vec2);
  execution.reserve(bytes);
  Scene restricted = scene;
  if (restricted.map) {
    restricted.map = effective_map(std::move(*restricted.map), prices, execution);
    return restricted;
  }
  for (const ScenePolygon& area : prices.keep_out) restricted.polygons.push_back(area);
  for_mask_cells(prices, execution, [&](const MaskCells& cells, std::uint32_t x, std::uint32_t y, const auto& factor) {
    if (factor) return;
    const std::array<Vec2, 4> square = mask_square_in_world(cells, x, y);
    execution.reserve(sizeof square);
    push_asked(restricted.polygons, {{square.begin(), square.end()}, 0}, execution);
  });
  return restricted;
}

AreaFactors::AreaFactors(const Prices& prices, const OccupancyMap* map) {
  const auto placed = [map](Vec2 p) { return map != nullptr ? corner_in_cells(*map, p) : p; };
  for (const PricedArea& area : prices.areas) {
    if (!(area.factor > 1.0)) continue;
    Area own{area.factor, {}, {}};
    for (const Vec2 p : area.corners) own.corners.push_back(placed(p));
    own.box = box_around(own.corners);
    areas_.push_back(std::move(own));
  }
  for (const PriceMask& mask : prices.masks) {
    const auto is_dear = [](const std::optional<double>& factor) { return factor.value_or(1.0) > 1.0; };
    if (!mask.read || !some_factor(mask, is_dear)) continue;
    // The axes from the far corners, so that their rounding is that of one cell.
    const double width = mask.read->width;
    const double height = mask.read->height;
    const Vec2 origin = placed(mask_corner(*mask.read, 0.0, 0.0));
    const Vec2 across = placed(mask_corner(*mask.read, width, 0.0)) - origin;
    const Vec2 along = placed(mask_corner(*mask.read, 0.0, height)) - origin;
    masks_.push_back({mask, origin, (1.0 / width) * across, (1.0 / height) * along});
  }
}

double AreaFactors::factor(Vec2 p) const {
  double greatest = 1.0;
  for (const Area& area : areas_) {
    if (area.factor > greatest && area.box.contains(p) && is_inside(area.corners, p)) greatest = area.factor;
  }
  for (const Mask& mask : masks_) {
    const MaskCells& cells = *mask.mask.read;
    const Vec2 from = p - mask.origin;
    const double area = cross(mask.right, mask.up);
    const Vec2 in_mask{cross(from, mask.up) / area, cross(mask.right, from) / area};
    greatest = std::max(greatest, least_around(in_mask, [&](std::int64_t x, std::int64_t y) {
                          if (x < 0 || y < 0 || x >= cells.width || y >= cells.height) return 1.0;
                          const auto at = as_whole<std::size_t>(y * cells.width + x);
                          return mask_factor(mask.mask, cells.values[at]).value_or(1.0);
                        }));
  }
  return greatest;
}

template <class FactorAt>
double AreaFactors::over(Vec2 p, Vec2 u, double length, std::vector<double>& cuts, const FactorAt& factor_at) const {
  cuts.assign(1, 0.0);
  const Box box = box_of({p, p + length * u});
  const auto add = [&](double t) {
    if (t > 0.0 && t < length) cuts.push_back(t);  // not NaN, where a side runs along
  };
  for (const Area& area : areas_) {
    if (!area.box.meets(box)) continue;
    for (std::size_t i = 0; i < area.corners.size(); ++i) {
      const Segment side = polygon_side(area.corners, i);
      if (box_of(side).meets(box)) add(cross(side.a - p, side.b - side.a) / cross(u, side.b - side.a));
    }
  }
  for (const Mask& mask : masks_) {
    const double area = cross(mask.right, mask.up);
    const auto lines = [&](double at, double slope, double most) {
      const double to = at + slope * length;
      const double last = std::min(std::max(at, to), most);
      for (double line = std::max(std::ceil(std::min(at, to)), 0.0); line <= last; ++line) add((line - at) / slope);
    };
    lines(cross(p - mask.origin, mask.up) / area, cross(u, mask.up) / area, mask.mask.read->width);
    lines(cross(mask.right, p - mask.origin) / area, cross(mask.right, u) / area, mask.mask.read->height);
  }
  cuts.push_back(length);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (!(cuts[i] > cuts[i - 1])) continue;
    sum += (cuts[i] - cuts[i - 1]) * (factor_at(p + 0.5 * (cuts[i - 1] + cuts[i]) * u) - 1.0);
  }
  return sum;
}

double clearance_reach(const ClearancePrice& price, double radius) {
  if (price.reach) return *price.reach;
  if (radius > 0.0) return 2.0 * radius;
  throw UsageError("@clearance-price: a point has no width to reach as far as: say P,D");
}

MapPrices::MapPrices(const OccupancyMap& effective, double radius, const Prices& prices, const Execution& execution)
    : map_(effective), areas_(prices, &effective), unknown_(effective.unknown.empty() ? 1.0 : prices.unknown_factor()) {
  if (prices.clearance && prices.clearance->price > 0.0) {
    reach_ = (clearance_reach(*prices.clearance, radius) + radius) / map_.cell;
    price_ = clearance_scale(*prices.clearance, radius);
    field_.emplace(map_.blocked, CellDistance::squares, true, execution);
    const double open = 2.0 * (reach_ + half_diagonal);  // squares are halves of cells
    open_sq_ = bounded_whole<std::uint32_t>(std::ceil(open * open));
  }
  if (!(unknown_ > 1.0) && areas_.empty()) return;
  touched_ = cell_bitmap(map_.width(), map_.height(), execution);
  for (const AreaFactors::Area& area : areas_.areas()) add_polygon_cells(touched_, area.corners, execution);
  for_mask_cells(prices, execution, [&](const MaskCells& cells, std::uint32_t x, std::uint32_t y, const auto& factor) {
    if (factor && *factor > 1.0) add_polygon_cells(touched_, mask_square(map_, cells, x, y), execution);
  });
  if (unknown_ > 1.0) touched_.add(map_.unknown, [&] { execution.check(); });
}

void MapPrices::keep_near(double cells, const Execution& execution) {
  constexpr double seen = 32.0;  // in the open legs are looked at in strides
  if (field_) field_->cut_off(std::max(cells, reach_) + seen, execution);
}

void MapPrices::renew(Cell low, Cell high, const Execution& execution) {
  number_ = fresh_number();
  if (field_) field_->renew(map_.blocked, low, high, execution);
  for (std::uint32_t y = low.y; unknown_ > 1.0 && y <= high.y; ++y) {
    execution.check();
    const auto unknown = map_.unknown.row(y);
    const auto touched = touched_.row(y);
    for (std::size_t w = 0; w < touched.size(); ++w) touched[w] |= unknown[w];
  }
}

/// All that may be nearest to a place of the cell, of what is within reach: whatever is farther from the middle than
/// the nearest by more than the cell's diagonal is not. Kept, for legs come back to the same cells.
std::span<const MapPrices::Site> MapPrices::sites(Cell cell, Scratch& scratch) const {
  const std::size_t number = std::size_t{cell.y} * map_.width() + cell.x;
  if (scratch.of != number_) scratch.kept.assign(Scratch::kept_rows * Scratch::kept_columns, {});
  scratch.of = number_;
  const std::size_t begin = cell.y % Scratch::kept_rows * Scratch::kept_columns;  // of its row
  Scratch::Sites& kept = scratch.kept[begin + cell.x % Scratch::kept_columns];
  if (kept.cell == number) return kept.sites;
  kept.cell = number;
  kept.sites.clear();
  const double nearest = field_->distance(cell.x, cell.y);
  const double limit = std::min(reach_, nearest + half_diagonal);
  const double most = limit + half_diagonal + on_border;
  const Vec2 middle{cell.x + 0.5, cell.y + 0.5};
  const auto take = [&](std::int64_t edge_x, std::int64_t edge_y, int dx, int dy) {
    const Vec2 at{dx == 0 ? middle.x : static_cast<double>(edge_x), dy == 0 ? middle.y : static_cast<double>(edge_y)};
    const Vec2 away = at - middle;
    if (dot(away, away) <= most * most) kept.sites.push_back({at, static_cast<double>(dx), static_cast<double>(dy)});
  };
  const std::int64_t width = map_.width();
  const std::int64_t height = map_.height();
  const std::int64_t x = cell.x;
  const std::int64_t y = cell.y;
  const auto far = bounded_whole<std::int64_t>(limit, 0.0, 4294967296.0) + 1;
  if (x < far) take(0, 0, -1, 0);
  if (y < far) take(0, 0, 0, -1);
  if (width - 1 - x < far) take(width, 0, 1, 0);
  if (height - 1 - y < far) take(0, height, 0, 1);
  const Bitmap& blocked = map_.blocked;
  for (std::int64_t row = std::max<std::int64_t>(0, y - far); row <= std::min(height - 1, y + far); ++row) {
    const auto bits = blocked.row(as_whole<std::uint32_t>(row));
    const int dy = row > y ? 1 : row < y ? -1 : 0;
    const std::int64_t edge_y = row > y ? row : row + 1;  // the side that looks at the cell
    const auto [left, right] = nearest_set(bits, x, far);
    if (right == x) {
      if (row != y) take(0, edge_y, 0, dy);
      continue;
    }
    if (right - x <= far) take(right, edge_y, 1, dy);
    if (x - left <= far) take(left + 1, edge_y, -1, dy);
  }
  if (kept.sites.size() > 1) {
    const Site first =
        *std::ranges::min_element(kept.sites, {}, [&](const Site& site) { return squared_distance(site, middle); });
    std::erase_if(kept.sites, [&](const Site& site) {
      const bool is_first = site.at.x == first.at.x && site.at.y == first.at.y;
      return !is_first && hides(first, site, cell);
    });
  }
  return kept.sites;
}

/// Of a piece of that cell which begins at `p`.
double MapPrices::nearness_in(Cell cell, Vec2 p, Vec2 u, double length, Scratch& scratch) const {
  if (field_->squared(cell.x, cell.y) >= open_sq_) return 0.0;
  scratch.things.clear();
  for (const Site& site : sites(cell, scratch)) {
    const Vec2 away = site.at - p;
    scratch.things.push_back(site.dx == 0.0   ? StretchDistance::side(site.dy * away.y, -site.dy * u.y)
                             : site.dy == 0.0 ? StretchDistance::side(site.dx * away.x, -site.dx * u.x)
                                              : StretchDistance::corner(site.at, p, u));
  }
  return scratch.sum.integral(scratch.things, 0.0, length, reach_);
}

double MapPrices::nearness(Vec2 a, Vec2 b, Scratch& scratch) const {
  double sum = 0.0;
  walk_cells(map_, a, b, [&](Cell cell, Vec2 u, double from, double to) {
    sum += nearness_in(cell, a + from * u, u, to - from, scratch);
    const Vec2 end = a + to * u;
    const double room = field_->distance(cell.x, cell.y) - distance(end, Vec2{cell.x + 0.5, cell.y + 0.5}) - reach_;
    return std::max(0.0, room);
  });
  return sum;
}

/// The integral of factor - 1 over a piece in one cell.
double MapPrices::areas_in(Vec2 p, Vec2 u, double length, Scratch& scratch) const {
  return areas_.over(p, u, length, scratch.cuts, [&](Vec2 at) {
    const double of_areas = areas_.factor(at);
    if (!(unknown_ > of_areas)) return of_areas;
    return std::max(of_areas, least_around(at, [&](std::int64_t x, std::int64_t y) {
                      return map_.unknown.holds(x, y) ? unknown_ : 1.0;
                    }));
  });
}

double MapPrices::areas(Vec2 a, Vec2 b, Scratch& scratch) const {
  double sum = 0.0;
  walk_cells(map_, a, b, [&](Cell cell, Vec2 u, double from, double to) {
    if (is_near_area(cell)) sum += areas_in(a + from * u, u, to - from, scratch);
    return 0.0;
  });
  return sum;
}

PriceParts MapPrices::parts(Vec2 a, Vec2 b, Scratch& scratch) const {
  const Vec2 p = map_point(map_, a);
  const Vec2 q = map_point(map_, b);
  PriceParts parts;
  if (reach_ > 0.0) parts.clearance = map_.cell * price_ * nearness(p, q, scratch);
  if (!touched_.empty()) parts.areas = map_.cell * areas(p, q, scratch);
  return parts;
}

/// From the middle of a cell to the place of its rim where the step leaves it; in cells.
double MapPrices::half_step(Cell cell, unsigned direction, Scratch& scratch) const {
  const Vec2 middle{cell.x + 0.5, cell.y + 0.5};
  const double length = is_diagonal(direction) ? half_diagonal : 0.5;
  const auto [dx, dy] = cell_steps[direction];
  const Vec2 u = (0.5 / length) * Vec2{static_cast<double>(dx), static_cast<double>(dy)};
  double cost = length;
  if (reach_ > 0.0) cost += price_ * nearness_in(cell, middle, u, length, scratch);
  if (is_near_area(cell)) cost += areas_in(middle, u, length, scratch);
  return cost;
}

std::uint64_t MapPrices::step_up(Cell from, unsigned direction, Scratch& scratch) const {
  const auto [dx, dy] = cell_steps[direction];
  const Cell to{as_whole<std::uint32_t>(std::int64_t{from.x} + dx), as_whole<std::uint32_t>(std::int64_t{from.y} + dy)};
  const auto back = as_whole<unsigned>(cell_steps.size()) - 1 - direction;
  const double cost = half_step(from, direction, scratch) + half_step(to, back, scratch);
  return bounded_whole<std::uint64_t>(std::ceil(units * cost));
}

SidePrices::SidePrices(const WallIndex& sides, double radius, const Prices& prices) : sides_(sides), areas_(prices) {
  if (!prices.clearance || !(prices.clearance->price > 0.0)) return;
  reach_ = clearance_reach(*prices.clearance, radius) + radius;
  price_ = clearance_scale(*prices.clearance, radius);
}

/// Of a leg that is not much longer than the reach.
double SidePrices::nearness(Vec2 p, Vec2 u, double length, Scratch& scratch) const {
  const double half = 0.5 * length;
  if (sides_.clearance(p + half * u, reach_ + half) >= reach_ + half) return 0.0;
  const Segment leg{p, p + length * u};
  std::vector<Segment>& near = scratch.near;
  near.clear();
  double enough = reach_;  // the distance to a segment is convex, so greatest at an end of the leg
  sides_.for_each_near(box_of(leg).grown(reach_), [&](const Segment& side) {
    near.push_back(side);
    enough = std::min(enough, std::max(distance(leg.a, side), distance(leg.b, side)));
    return true;
  });
  constexpr double rounding = 1.0 + 1e-9;
  std::erase_if(near, [&](const Segment& side) { return distance(leg, side) > enough * rounding; });
  std::vector<double>& cuts = scratch.cuts;
  cuts.assign({0.0, length});
  for (const Segment& side : near) {
    const Vec2 along = side.b - side.a;
    for (const Vec2 end : {side.a, side.b}) {
      const double t = dot(end - p, along) / dot(u, along);
      if (t > 0.0 && t < length) cuts.push_back(t);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (!(cuts[i] > cuts[i - 1])) continue;
    scratch.things.clear();
    const Vec2 middle = p + 0.5 * (cuts[i - 1] + cuts[i]) * u;
    for (const Segment& side : near) scratch.things.push_back(seen(side, p, u, middle));
    sum += scratch.sum.integral(scratch.things, cuts[i - 1], cuts[i], reach_);
  }
  return sum;
}

PriceParts SidePrices::parts(Vec2 a, Vec2 b, Scratch& scratch) const {
  PriceParts parts;
  const double length = distance(a, b);
  if (!(length > 0.0)) return parts;
  const Vec2 u = (1.0 / length) * (b - a);
  if (reach_ > 0.0) {
    constexpr double most_pieces = 10'000.0;
    const double pieces = std::min(std::ceil(length / reach_), most_pieces);
    for (double i = 0.0; i < pieces; ++i) {
      const double from = i / pieces * length;
      const double to = (i + 1.0) / pieces * length;
      parts.clearance += price_ * nearness(a + from * u, u, to - from, scratch);
    }
  }
  if (!areas_.empty()) {
    parts.areas = areas_.over(a, u, length, scratch.cuts, [&](Vec2 p) { return areas_.factor(p); });
  }
  return parts;
}

double NearnessSum::integral(std::span<const StretchDistance> things, double from, double to, double reach) {
  if (!(to > from)) return 0.0;
  const auto is_all = [&](const StretchDistance& thing) {
    return std::max(squared(thing, from), squared(thing, to)) <= reach * reach;
  };
  if (things.size() == 1 && is_all(things[0])) return integral_of_one(things[0], from, to, reach);  // most often
  double enough = reach * reach;  // what is everywhere farther than this is nowhere the nearest, or beyond the reach
  for (const StretchDistance& thing : things)
    enough = std::min(enough, std::max(squared(thing, from), squared(thing, to)));
  near_.clear();
  for (const StretchDistance& thing : things) {
    if (least_squared(thing, from, to) <= enough) near_.push_back(thing);
  }
  if (near_.empty()) return 0.0;
  if (near_.size() == 1 && is_all(near_[0])) return integral_of_one(near_[0], from, to, reach);
  cuts_.assign(1, from);
  const auto cut_at = [&](const std::pair<double, double>& both) {
    for (const double t : {both.first, both.second}) {
      if (t > from && t < to) cuts_.push_back(t);
    }
  };
  for (std::size_t i = 0; i < near_.size(); ++i) {
    cut_at(ends_of_reach(near_[i], reach));
    for (std::size_t j = 0; j < i; ++j) cut_at(meetings(near_[i], near_[j]));
  }
  cuts_.push_back(to);
  std::sort(cuts_.begin(), cuts_.end());
  double sum = 0.0;
  for (std::size_t c = 1; c < cuts_.size(); ++c) {
    const double middle = 0.5 * (cuts_[c - 1] + cuts_[c]);
    const auto off_sq = [middle](const StretchDistance& thing) { return squared(thing, middle); };
    const auto nearest = std::ranges::min_element(near_, {}, off_sq);
    if (off_sq(*nearest) < reach * reach) sum += integral_of_one(*nearest, cuts_[c - 1], cuts_[c], reach);
  }
  return sum;
}

}  // namespace warren
