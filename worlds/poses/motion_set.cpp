// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/motion_set.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "parallel/chunks.hpp"
#include "worlds/poses/certified_motion.hpp"

namespace warren {
namespace {

using Vector = std::array<std::int32_t, 2>;

Vector turned(Vector v, std::uint32_t quarters) {
  for (std::uint32_t i = 0; i < quarters; ++i) v = {-v[1], v[0]};
  return v;
}

/// All, by their angle.
std::vector<Vector> heading_vectors(std::uint32_t headings) {
  const std::vector<Vector> sixteen{{1, 0}, {2, 1}, {1, 1}, {1, 2}};
  const std::vector<Vector> thirty_two{{1, 0}, {3, 1}, {2, 1}, {3, 2}, {1, 1}, {2, 3}, {1, 2}, {1, 3}};
  std::vector<Vector> all;
  for (std::uint32_t q = 0; q < 4; ++q) {
    for (const Vector& v : headings == 16 ? sixteen : thirty_two) all.push_back(turned(v, q));
  }
  return all;
}

double norm_of(const Vector& v) { return std::sqrt(1.0 * v[0] * v[0] + 1.0 * v[1] * v[1]); }

/// The way back: of a turn on the spot the other one.
SteeringWord reversed(const SteeringWord& word) {
  SteeringWord back;
  for (std::size_t i = word.count; i-- > 0;) {
    const auto& [steer, length] = word.pieces[i];
    is_on_spot(steer) ? back.add(Steer::right_on_spot, length) : back.add(steer, -length);
  }
  return back;
}

constexpr double resolution = 0x1p-4;  // cells

/// The cells that a body may touch along one shape, row by row; all in cells.
std::vector<Vector> swept_cells(const MotionSet& motions, const MotionShape& shape, std::span<const Vec2> outline,
                                double reach, const Execution& execution) {
  const SteeringCurve curve({0.0, 0.0, motions.heading_rad(shape.from)},
                            {1.0 * shape.dx, 1.0 * shape.dy, motions.heading_rad(shape.to)}, shape.word,
                            motions.turning_radius());
  const CurveTravel travelled(curve, outline);
  const double length = curve.length();
  const Box box = box_around(outline);
  // A lower bound of the distance between body and square, less the reach; exact where it is small.
  const auto clearance = [&](const Se2& pose, Vec2 middle, double enough) {
    constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;
    const Rotation turned(-pose.theta);
    const Vec2 seen = turned(middle - pose.position());
    const double aside = std::max({box.min.x - seen.x, seen.x - box.max.x, 0.0});
    const double above = std::max({box.min.y - seen.y, seen.y - box.max.y, 0.0});
    const double at_least = std::sqrt(aside * aside + above * above) - half_diagonal - reach;
    if (at_least > enough) return at_least;
    std::array<Vec2, 4> square = Box{{-0.5, -0.5}, {0.5, 0.5}}.corners();
    for (Vec2& p : square) p = seen + turned(p);
    return distance(outline, square) - reach;
  };
  const auto is_clear_of = [&](Vec2 middle) {
    return certified_motion([&](double t, double enough) { return clearance(curve.at(t * length), middle, enough); },
                            [&](double t, double u) { return travelled(u * length) - travelled(t * length); },
                            resolution) == MotionVerdict::free;
  };
  std::vector<Vector> touched;
  const Box wide = curve.box().grown(outline_reach(outline) + reach + 1.0);
  const auto whole = [](double x) { return bounded_whole<std::int32_t>(x, least_whole<std::int32_t>); };
  for (std::int32_t y = whole(std::floor(wide.min.y)); y <= whole(std::ceil(wide.max.y)); ++y) {
    execution.check();
    for (std::int32_t x = whole(std::floor(wide.min.x)); x <= whole(std::ceil(wide.max.x)); ++x) {
      if (!is_clear_of({1.0 * x, 1.0 * y})) touched.push_back({x, y});
    }
  }
  return touched;
}

}  // namespace

MotionSet::MotionSet(const MotionSetOptions& options, const Execution& execution)
    : options_(options), vectors_(heading_vectors(options.headings)) {
  for (const Vector& v : vectors_) radians_.push_back(wrapped_angle(portable::atan2(v[1], v[0])));
  motions_.resize(vectors_.size());
  for (std::uint32_t k = 0; k < options.headings / 4; ++k) add_shapes(k, execution);
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
    execution.check();
    relaxed_ratio_ = std::max(relaxed_ratio_, ratio_of(shapes_[i], execution));
    add_motions(i);
  }
}

std::uint32_t MotionSet::nearest_heading(double radians) const {
  const auto off = [&](double heading) { return std::abs(turn_between(radians, heading)); };
  return as_whole<std::uint32_t>(std::ranges::min_element(radians_, {}, off) - radians_.begin());
}

std::uint64_t MotionSet::cost_of(const SteeringWord& word) const {
  double cost = 0.0;
  for (const SteeringPiece& piece : word.used()) {
    const double length = std::abs(piece.length);
    if (!is_on_spot(piece.steer))
      cost += options_.turning_radius * length * (piece.length < 0.0 ? options_.reverse_cost : 1.0);
    if (piece.steer != Steer::straight) cost += options_.turn_cost * length;
  }
  return bounded_whole<std::uint64_t>(std::round(cost / cost_unit));
}

void MotionSet::add_shapes(std::uint32_t from, const Execution& execution) {
  const Vector& v = vectors_[from];
  const double unit = norm_of(v);
  const auto longer = bounded_whole<std::int32_t>(std::ceil(options_.turning_radius / unit), 2, 64);
  for (const std::int32_t count : {1, longer}) {
    MotionShape shape{from, from, count * v[0], count * v[1]};
    shape.word.add(Steer::straight, count * unit / options_.turning_radius);
    shapes_.push_back(shape);
  }
  execution.check();
  if (options_.turns_on_spot) {
    MotionShape turn{from, (from + 1) % headings()};
    turn.word.add(Steer::left_on_spot, warren::turn_between(radians_[from], radians_[turn.to]));
    shapes_.push_back(turn);
    return;
  }
  for (const std::uint32_t apart : {1U, 2U}) {
    add_turns(from, (from + apart) % headings());
    add_turns(from, (from + headings() - apart) % headings());
  }
}

/// Of the ends a v + b w with lengths of at least rho tan(turn / 2) those that are such neither a v nor a w nearer. a
/// and b are multiples of 1 / |v x w|: as many ends as that, one for each part of a.
void MotionSet::add_turns(std::uint32_t from, std::uint32_t to) {
  const Vector& v = vectors_[from];
  const Vector& w = vectors_[to];
  const double turn = warren::turn_between(radians_[from], radians_[to]);
  const double tangent = options_.turning_radius * portable::tan(0.5 * std::abs(turn));
  const std::int64_t parts = std::abs(std::int64_t{v[0]} * w[1] - std::int64_t{v[1]} * w[0]);
  const auto least = [&](const Vector& u) {
    return bounded_whole<std::int64_t>(std::ceil(tangent / norm_of(u) * static_cast<double>(parts)));
  };
  const std::int64_t first = std::max<std::int64_t>(least(v), 1);
  const std::int64_t second = std::max<std::int64_t>(least(w), 1);
  // From any a on, `parts` of them after each other, the first b that makes a whole end.
  for (std::int64_t a = first; a < first + parts; ++a) {
    for (std::int64_t b = second; b < second + parts; ++b) {
      const std::int64_t x = a * v[0] + b * w[0];
      const std::int64_t y = a * v[1] + b * w[1];
      if (x % parts != 0 || y % parts != 0) continue;
      MotionShape shape{from, to, as_whole<std::int32_t>(x / parts), as_whole<std::int32_t>(y / parts)};
      const auto along = [&](std::int64_t n, const Vector& u) {
        const double length = static_cast<double>(n) / static_cast<double>(parts) * norm_of(u);
        return std::max(0.0, length - tangent) / options_.turning_radius;
      };
      shape.word.add(Steer::straight, along(a, v));
      shape.word.add(turn > 0.0 ? Steer::left : Steer::right, std::abs(turn));
      shape.word.add(Steer::straight, along(b, w));
      shapes_.push_back(shape);
    }
  }
}

/// In all four quarters, backwards too.
void MotionSet::add_motions(std::uint32_t number) {
  const MotionShape& shape = shapes_[number];
  const std::int8_t gear = is_on_spot(shape.word.pieces[0].steer) ? 0 : 1;
  const SteeringWord back = reversed(shape.word);
  for (std::uint32_t q = 0; q < 4; ++q) {
    const std::uint32_t from = (shape.from + q * headings() / 4) % headings();
    const std::uint32_t to = (shape.to + q * headings() / 4) % headings();
    const Vector d = turned({shape.dx, shape.dy}, q);
    motions_[from].push_back({d[0], d[1], to, gear, cost_of(shape.word), shape.word, number, q});
    if (gear != 0 && !options_.reverses) continue;
    motions_[to].push_back({-d[0], -d[1], from, as_whole<std::int8_t>(-gear), cost_of(back), back, number, q});
  }
}

/// The shortest chain of steps to the motion's end over cells whose middles are within `slack` of its way, against its
/// length: a Dijkstra among a few dozen cells.
double MotionSet::ratio_of(const MotionShape& shape, const Execution& execution) const {
  if (is_on_spot(shape.word.pieces[0].steer)) return 1.0;
  const double rho = options_.turning_radius;
  const SteeringCurve curve({0.0, 0.0, radians_[shape.from]}, {1.0 * shape.dx, 1.0 * shape.dy, radians_[shape.to]},
                            shape.word, rho);
  // Between its points the way bends by less than 1/100 cell.
  const double spacing = std::min(0.25, 0.25 * std::sqrt(0.08 * rho));
  const double pieces = std::ceil(curve.length() / spacing);
  std::vector<Vec2> way;
  for (double i = 0.0; i <= pieces; i += 1.0) way.push_back(curve.at(curve.length() * i / pieces).position());
  const Box box = curve.box().grown(2.0);
  const auto low_x = bounded_whole<std::int32_t>(std::floor(box.min.x), least_whole<std::int32_t>);
  const auto low_y = bounded_whole<std::int32_t>(std::floor(box.min.y), least_whole<std::int32_t>);
  const auto width = bounded_whole<std::int32_t>(std::ceil(box.max.x)) - low_x + 1;
  const auto height = bounded_whole<std::int32_t>(std::ceil(box.max.y)) - low_y + 1;
  const auto number = [&](std::int32_t x, std::int32_t y) {
    return as_whole<std::size_t>(y - low_y) * as_whole<std::size_t>(width) + as_whole<std::size_t>(x - low_x);
  };
  const auto is_beside = [&](std::int32_t x, std::int32_t y) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      if (distance(Vec2{1.0 * x, 1.0 * y}, Segment{way[i - 1], way[i]}) <= slack - 0.01) return true;
    }
    return false;
  };
  constexpr double unknown = -1.0;
  constexpr double never = std::numeric_limits<double>::infinity();
  const std::size_t cells = as_whole<std::size_t>(width) * as_whole<std::size_t>(height);
  execution.reserve(cells * sizeof(double));
  std::vector<double> reached(cells, unknown);
  using Entry = std::pair<double, Vector>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  reached[number(0, 0)] = 0.0;
  open.push({0.0, {0, 0}});
  while (!open.empty()) {
    execution.check();  // each may be held against all of the way
    const auto [cost, at] = open.top();
    open.pop();
    if (at[0] == shape.dx && at[1] == shape.dy) return cost / curve.length();
    if (cost > reached[number(at[0], at[1])]) continue;
    for (const auto& step : knight_steps) {
      const Vector to{at[0] + step[0], at[1] + step[1]};
      if (to[0] < low_x || to[1] < low_y || to[0] >= low_x + width || to[1] >= low_y + height) continue;
      double& there = reached[number(to[0], to[1])];
      if (there == unknown) there = is_beside(to[0], to[1]) ? never : -2.0;
      const double sum = cost + norm_of(step);
      if (there < 0.0 || sum >= there) continue;
      there = sum;
      open.push({sum, to});
    }
  }
  return never;  // no chain of neighbours is that far from a way
}

SweptStamps::SweptStamps(const MotionSet& motions, std::span<const Vec2> outline, double reach,
                         const Execution& execution) {
  const std::span<const MotionShape> shapes = motions.shapes();
  auto touched = parts_of_chunks(shapes.size(), 1, execution.quiet(), [&](Range r) {
    return swept_cells(motions, shapes[r.first], outline, reach, execution);
  });
  constexpr std::int32_t bits = 64;
  for (std::vector<Vector>& cells : touched) {
    for (std::uint32_t quarters = 0; quarters < 4; ++quarters) {
      std::ranges::sort(cells, {}, [](const Vector& cell) { return std::pair(cell[1], cell[0]); });
      Stamp stamp{rows_.size(), 0, 0, 0, 0, 0};
      for (const auto& [x, y] : cells) {
        stamp.min_x = std::min(stamp.min_x, x);
        stamp.max_x = std::max(stamp.max_x, x);
        stamp.min_y = std::min(stamp.min_y, y);
        stamp.max_y = std::max(stamp.max_y, y);
        const bool fits = rows_.size() > stamp.first && rows_.back().y == y && x - rows_.back().x < bits;
        if (!fits) rows_.push_back({x, y, 0});
        rows_.back().bits |= std::uint64_t{1} << as_whole<unsigned>(x - rows_.back().x);
      }
      stamp.last = rows_.size();
      stamps_.push_back(stamp);
      for (Vector& cell : cells) cell = turned(cell, 1);
    }
  }
}

bool SweptStamps::is_free(const FreeCells& map, Cell from, const LatticeMotion& motion) const {
  const Stamp& stamp = stamps_[4 * motion.shape + motion.quarter_turns];
  std::int64_t x = from.x;
  std::int64_t y = from.y;
  if (motion.gear < 0) {  // its shape begins where it ends
    x += motion.dx;
    y += motion.dy;
  }
  if (x + stamp.min_x < 0 || y + stamp.min_y < 0 || x + stamp.max_x >= map.width() || y + stamp.max_y >= map.height())
    return false;
  const std::int64_t begin = std::int64_t{map.number({0, 0})} + y * map.stride() + x;
  for (std::size_t i = stamp.first; i < stamp.last; ++i) {
    const Row& row = rows_[i];
    const auto number = as_whole<VertexId>(begin + std::int64_t{row.y} * map.stride() + row.x);
    if ((~map.from(number) & row.bits) != 0) return false;
  }
  return true;
}

}  // namespace warren
