// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_price.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "parallel/asked_memory.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/near/obstacle_index.hpp"
#include "verify/near/sides_near_legs.hpp"

namespace warren {
namespace {

// The integral of what nearness costs along a straight piece. The squared distance to each thing is a quadratic of the
// arc length; where any two of them cross, and where one is at the reach, the piece is cut, and in each interval the
// one that is least in its middle counts.

/// a t^2 + b t + c, the squared distance where the piece has gone t from its begin; never below 0.
struct SquaredDistance {
  double a;
  double b;
  double c;
  double apart_sq;       ///< of a place: of the line that the piece is on
  bool is_line = false;  ///< is the distance itself a straight line, off - slope t?
  double off = 0.0;
  double slope = 0.0;

  /// To a place that lies so far off the piece's begin; u: the piece's direction, of length 1.
  static SquaredDistance to_place(Vec2 off, Vec2 u) {
    const double apart = cross(u, off);
    return {1.0, -2.0 * dot(off, u), dot(off, off), apart * apart};
  }
  /// To a straight line that is so far off at the begin, and nears by so much.
  static SquaredDistance to_line(double off, double slope) {
    return {slope * slope, -2.0 * off * slope, off * off, 0.0, true, off, slope};
  }
  double at(double t) const { return (a * t + b) * t + c; }
};

double least_of(const SquaredDistance& q, double length) {
  const double ends = std::min(q.at(0.0), q.at(length));
  const bool turns_inside = !q.is_line && q.b < 0.0 && -q.b < 2.0 * q.a * length;
  return turns_inside ? std::min(ends, q.apart_sq) : ends;
}

/// Adds the places inside where a t^2 + b t + c is 0.
void add_roots(double a, double b, double c, double length, std::vector<double>& cuts) {
  const auto add = [&](double t) {
    if (t > 0.0 && t < length) cuts.push_back(t);  // not NaN
  };
  if (a == 0.0) return add(-c / b);
  const double inside = b * b - 4.0 * a * c;
  if (inside < 0.0) return;
  const double sum = -0.5 * (b + std::copysign(std::sqrt(inside), b));
  add(sum / a);
  add(c / sum);
}

/// The integral of the distance itself.
double integral_of_distance(const SquaredDistance& q, double from, double to) {
  constexpr double no_area = 1e-30;
  if (q.is_line) return (to - from) * std::abs(q.off - 0.5 * q.slope * (from + to));
  const auto until = [&](double t) {
    const double v = t + 0.5 * q.b;
    const double d = std::sqrt(v * v + q.apart_sq);
    const double bend = q.apart_sq > no_area ? q.apart_sq * portable::asinh(v / std::sqrt(q.apart_sq)) : 0.0;
    return 0.5 * (v * d + bend);
  };
  return until(to) - until(from);
}

double integral_of_one(const SquaredDistance& q, double from, double to, double reach) {
  const double length = to - from;
  const double squares = length / 6.0 * (q.at(from) + 4.0 * q.at(0.5 * (from + to)) + q.at(to));
  return length - 2.0 / reach * integral_of_distance(q, from, to) + squares / (reach * reach);
}

/// The integral of (1 - d / reach)^2, where the least distance d is below the reach, over t = 0 .. length. Scratch of
/// one thread.
class NearnessCost {
 public:
  double over(std::span<const SquaredDistance> things, double length, double reach) {
    double enough = reach * reach;
    for (const SquaredDistance& q : things) enough = std::min(enough, std::max(q.at(0.0), q.at(length)));
    near_.clear();
    for (const SquaredDistance& q : things) {
      if (least_of(q, length) <= enough * (1.0 + 1e-12)) near_.push_back(q);
    }
    if (near_.empty()) return 0.0;
    cuts_.assign({0.0, length});
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const SquaredDistance& q = near_[i];
      add_roots(q.a, q.b, q.c - reach * reach, length, cuts_);
      for (std::size_t j = i + 1; j < near_.size(); ++j) {
        add_roots(q.a - near_[j].a, q.b - near_[j].b, q.c - near_[j].c, length, cuts_);
      }
    }
    std::sort(cuts_.begin(), cuts_.end());
    double sum = 0.0;
    for (std::size_t i = 1; i < cuts_.size(); ++i) {
      const double middle = 0.5 * (cuts_[i - 1] + cuts_[i]);
      const auto nearest =
          std::ranges::min_element(near_, {}, [middle](const SquaredDistance& q) { return q.at(middle); });
      if (nearest->at(middle) < reach * reach) sum += integral_of_one(*nearest, cuts_[i - 1], cuts_[i], reach);
    }
    return std::max(sum, 0.0);
  }

 private:
  std::vector<SquaredDistance> near_;
  std::vector<double> cuts_;
};

/// Nearness among the cells of a map; lengths in cells.
class NearCells {
 public:
  /// reach: of the middle.
  NearCells(const OccupancyMap& map, bool on_water, double reach, const Execution& execution)
      : map_(map), on_water_(on_water), reach_(reach), execution_(execution) {}

  double over(const JudgedRay& ray) {
    cuts_.clear();
    add_grid_lines(ray.from, ray.u, ray.length, cuts_);
    return sum_of_pieces(cuts_, ray.length, execution_, [&](double from, double to) {
      return over_piece(ray.at(from), ray.u, to - from, ray.at(0.5 * (from + to)));
    });
  }

 private:
  bool closed(std::int64_t x, std::int64_t y) const {
    return on_water_ ? !map_.water.holds(x, y) : map_.blocked.holds(x, y);
  }

  /// Bit i: is the cell (first + i, row) closed? 0 beyond `last`.
  std::uint64_t closed_from(std::int64_t first, std::int64_t row, std::int64_t last) const {
    const std::span<const std::uint64_t> words =
        (on_water_ ? map_.water : map_.blocked).row(as_whole<std::uint32_t>(row));
    const auto word = as_whole<std::size_t>(first) / Bitmap::word_bits;
    const auto shift = as_whole<std::size_t>(first) % Bitmap::word_bits;
    std::uint64_t bits = words[word] >> shift;
    if (shift != 0 && word + 1 < words.size()) bits |= words[word + 1] << (Bitmap::word_bits - shift);
    if (on_water_) bits = ~bits;
    const std::int64_t count = last - first + 1;
    return count >= Bitmap::word_bits ? bits : bits & ((std::uint64_t{1} << count) - 1);
  }

  double over_piece(Vec2 p, Vec2 u, double length, Vec2 middle) {
    const auto x = bounded_whole<std::int64_t>(std::floor(middle.x), 0.0, map_.width() - 1.0);
    const auto y = bounded_whole<std::int64_t>(std::floor(middle.y), 0.0, map_.height() - 1.0);
    for (std::int64_t around = 1;; around *= 2) {
      things_ = {SquaredDistance::to_line(p.x, -u.x), SquaredDistance::to_line(p.y, -u.y),
                 SquaredDistance::to_line(map_.width() - p.x, u.x), SquaredDistance::to_line(map_.height() - p.y, u.y)};
      const std::int64_t last = std::min<std::int64_t>(x + around, map_.width() - 1);
      const std::int64_t last_row = std::min<std::int64_t>(y + around, map_.height() - 1);
      for (std::int64_t row = std::max<std::int64_t>(y - around, 0); row <= last_row; ++row) {
        if (row % 64 == 0) execution_.check();
        for (std::int64_t first = std::max<std::int64_t>(x - around, 0); first <= last; first += Bitmap::word_bits) {
          for (std::uint64_t rest = closed_from(first, row, last); rest != 0; rest &= rest - 1) {
            add_cell(x, y, first + std::countr_zero(rest), row, p, u);
          }
        }
      }
      double enough = std::numeric_limits<double>::infinity();
      for (const SquaredDistance& q : things_) enough = std::min(enough, std::max(q.at(0.0), q.at(length)));
      const auto seen = static_cast<double>(around);  // what is not in the window is at least so far away
      if (seen >= reach_ || seen * seen >= enough) return nearness_.over(things_, length, reach_);
    }
  }

  /// A closed cell as the piece in cell (x, y) sees it: by one side, or by a corner. None behind another one.
  void add_cell(std::int64_t x, std::int64_t y, std::int64_t column, std::int64_t row, Vec2 p, Vec2 u) {
    const std::int64_t right = (column > x) - (column < x);
    const std::int64_t up = (row > y) - (row < y);
    const auto hides = [&](std::int64_t at_x, std::int64_t at_y) {
      return (at_x != x || at_y != y) && closed(at_x, at_y);
    };
    if (right != 0 && hides(column - right, row)) return;
    if (up != 0 && hides(column, row - up)) return;
    const double off_x = static_cast<double>(right > 0 ? column : column + 1) - p.x;
    const double off_y = static_cast<double>(up > 0 ? row : row + 1) - p.y;
    if (right != 0 && up != 0) return push_asked(things_, SquaredDistance::to_place({off_x, off_y}, u), execution_);
    if (right != 0) return push_asked(things_, SquaredDistance::to_line(off_x, u.x), execution_);
    if (up != 0) return push_asked(things_, SquaredDistance::to_line(off_y, u.y), execution_);
    things_.push_back(SquaredDistance::to_line(0.0, 0.0));
  }

  const OccupancyMap& map_;
  bool on_water_;
  double reach_;
  const Execution& execution_;
  NearnessCost nearness_;
  std::vector<SquaredDistance> things_;
  std::vector<double> cuts_;
};

/// Nearness among walls, sides of polygons and bounds.
class NearSides {
 public:
  NearSides(const Scene& scene, double reach, const Execution& execution)
      : index_(scene, execution), reach_(reach), execution_(execution) {}

  double over(const JudgedRay& ray) {
    const Segment leg{ray.from, ray.at(ray.length)};
    const Box box = box_of(leg);
    near_.clear();
    cuts_.clear();
    index_.sides().for_each([&](const Box& block) { return exact::gap_sq(block, box) > reach_ * reach_; },
                            [&](std::size_t number) {
                              const Segment side = index_.obstacles().segment(number);
                              if (exact::gap_sq(box_of(side), box) > reach_ * reach_) return;
                              push_asked(near_, side, execution_);
                              for (const Vec2 end : {side.a, side.b}) {
                                const double along = dot(ray.u, side.b - side.a);
                                const double t = dot(end - ray.from, side.b - side.a) / along;
                                if (t > 0.0 && t < ray.length) push_asked(cuts_, t, execution_);
                              }
                            });
    return sum_of_pieces(cuts_, ray.length, execution_, [&](double from, double to) {
      things_.clear();
      const Vec2 p = ray.at(from);
      const Vec2 middle = ray.at(0.5 * (from + to));
      for (const Segment& side : near_) push_asked(things_, seen(side, p, ray.u, middle), execution_);
      return nearness_.over(things_, to - from, reach_);
    });
  }

 private:
  static SquaredDistance seen(const Segment& side, Vec2 p, Vec2 u, Vec2 middle) {
    const Vec2 along = side.b - side.a;
    const double foot = dot(middle - side.a, along);
    if (!(foot > 0.0)) return SquaredDistance::to_place(side.a - p, u);
    if (foot >= dot(along, along)) return SquaredDistance::to_place(side.b - p, u);
    const double length = norm(along);
    const double turned = cross(along, middle - side.a) < 0.0 ? -1.0 / length : 1.0 / length;
    return SquaredDistance::to_line(turned * cross(along, p - side.a), -turned * cross(along, u));
  }

  const ObstacleIndex index_;
  double reach_;
  const Execution& execution_;
  NearnessCost nearness_;
  std::vector<Segment> near_;
  std::vector<SquaredDistance> things_;
  std::vector<double> cuts_;
};

// What the path of a body that turns costs beside its length, recomputed: of polygons that turn as they go straight and
// of cars, whose legs are arcs. Nothing of worlds/ or planners/ is used.
//
// Nearness has no closed form here, but it has bounds. No point of the body goes farther on a piece of a leg than the
// piece is long and its turn times the body's extent; by so much at most the body's distance changes. So the distance
// in the piece's middle bounds the integral from both sides, in closed form. A piece is halved until both are as near
// as a thousandth of what it costs; half of what is left is the error. The distance is the least between corners of
// the one and sides of the other, since a body that is free crosses nothing; from piece to half only those pairs are
// kept that may be the least there. Areas are priced where the reference point is (JudgedFactors).

/// A leg by shares from 0 to 1.
struct BodyLeg {
  JudgedArc arc;
  bool is_straight;  // the turn is the body's, not the way's
  Vec2 chord;

  Se2 pose(double share) const {
    const Vec2 p = is_straight ? arc.from + share * chord : arc.at(share);
    return {p.x, p.y, arc.heading_rad + share * arc.turn_rad};
  }
  double length() const { return std::abs(arc.length); }
};

BodyLeg leg_of(const RobotSpec& robot, const Se2& a, const Se2& b) {
  const Vec2 chord{b.x - a.x, b.y - a.y};
  if (robot.kind != RobotKind::car) {
    const double length = portable::hypot(chord.x, chord.y);
    return {{a.position(), a.theta, shorter_turn(a.theta, b.theta), length}, true, chord};
  }
  const CarLeg leg = car_leg_between(a, b);
  return {{a.position(), a.theta, leg.turn, std::copysign(leg.length, leg.ahead)}, false, chord};
}

double square_to(Vec2 p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double length_sq = dot(along, along);
  const double share = length_sq > 0.0 ? std::clamp(dot(p - s.a, along) / length_sq, 0.0, 1.0) : 0.0;
  const Vec2 off = p - (s.a + share * along);
  return dot(off, off);
}

/// What nearness costs a body along its path.
class BodyNearness {
 public:
  BodyNearness(const Scene& scene, const RobotSpec& robot, const ClearancePrice& price, std::span<const BodyLeg> legs,
               const Execution& execution)
      : surroundings_(scene, nullptr, execution),
        execution_(execution),
        outline_(robot.outline.empty() ? std::vector<Vec2>{Vec2{}} : robot.outline),
        radius_(robot.radius),
        price_(price.price),
        reach_(price.reach.value_or(2.0 * robot.radius)) {
    if (!(reach_ > 0.0)) throw InputError("clearance_price", "says no reach, and the body has no width");
    for (const Vec2 p : outline_) extent_ = std::max(extent_, norm(p));
    std::vector<Box> boxes;  // around all parts of all legs, in their order
    for (const BodyLeg& leg : legs) {
      execution_.check();
      for (double i = 0.0, parts = parts_of(leg); i < parts; ++i) {
        push_asked(boxes, box_of_part(leg, i, parts), execution_);
      }
    }
    surroundings_.file(boxes, execution_);
  }

  /// Of one of the legs.
  void add(const BodyLeg& leg, PriceParts& parts) {
    if (!(leg.length() > 0.0)) return;
    low_ = high_ = 0.0;
    for (double i = 0.0, count = parts_of(leg); i < count; ++i) {
      execution_.check();
      sides_.clear();
      const Box box = box_of_part(leg, i, count);
      surroundings_.gather(std::span(&box, 1), sides_, execution_);
      pairs_.clear();
      const std::size_t most = 2 * outline_.size() * sides_.size();
      if (most > pairs_.capacity()) execution_.reserve(most * (sizeof(Pair) + sizeof(double)));
      pairs_.reserve(most);
      for (std::uint32_t side = 0; side < sides_.size(); ++side) {
        execution_.poll(polled_++);
        for (std::uint32_t k = 0; k < outline_.size(); ++k) {
          pairs_.push_back({k, side, true});
          if (outline_.size() > 1) pairs_.push_back({k, side, false});
        }
      }
      piece(leg, i / count, (i + 1.0) / count, 0);
    }
    parts.clearance += 0.5 * (high_ + low_);
    parts.error += 0.5 * (high_ - low_);
  }

 private:
  /// A corner of the body and a side, or a side of the body and both ends of one.
  struct Pair {
    std::uint32_t of_body;
    std::uint32_t side;
    bool is_corner;
  };
  static constexpr double enough = 1e-3;

  /// How far a point of the body goes on a share of the leg, at most.
  double travel(const BodyLeg& leg, double share) const {
    return share * (leg.length() + extent_ * std::abs(leg.arc.turn_rad)) * (1.0 + 1e-12);
  }
  double parts_of(const BodyLeg& leg) const {
    constexpr double most = 1e5;
    return std::clamp(std::ceil(travel(leg, 1.0) / (reach_ + radius_ + extent_)), 1.0, most);
  }
  Box box_of_part(const BodyLeg& leg, double number, double count) const {
    Box box;
    box.include(leg.pose((number + 0.5) / count).position());
    return box.grown(extent_ + radius_ + reach_ + travel(leg, 1.0 / count));
  }
  double distance_of(const Pair& pair) const {
    const Segment& side = sides_[pair.side].segment;
    if (pair.is_corner) return std::sqrt(square_to(corners_[pair.of_body], side));
    const Segment own = exact::outline_side(corners_, pair.of_body);
    return std::sqrt(std::min(square_to(side.a, own), square_to(side.b, own)));
  }
  /// The integral of (1 - u / reach)^2 from x on.
  double beyond(double x) const {
    if (x >= reach_) return 0.0;
    const double left = 1.0 - std::max(x, 0.0) / reach_;
    return reach_ / 3.0 * left * left * left + std::max(-x, 0.0);
  }

  /// The pairs that count are the last ones of pairs_; they are left as they are.
  void piece(const BodyLeg& leg, double from, double to, int depth) {
    constexpr int deepest = 45;
    const Se2 pose = leg.pose(0.5 * (from + to));
    const auto [sine, cosine] = portable::sin_and_cos(pose.theta);
    corners_.clear();
    for (const Vec2 c : outline_) {
      corners_.push_back({pose.x + cosine * c.x - sine * c.y, pose.y + sine * c.x + cosine * c.y});
    }
    const std::size_t first = begin_;
    const std::size_t last = pairs_.size();
    distances_.resize(last);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < last; ++i) {
      execution_.poll(polled_++);
      distances_[i] = distance_of(pairs_[i]) - radius_;
      least = std::min(least, distances_[i]);
    }
    const double rounding =
        16.0 * std::numeric_limits<double>::epsilon() * (std::abs(pose.x) + std::abs(pose.y) + extent_ + reach_);
    const double way = travel(leg, 0.5 * (to - from)) + rounding;
    if (least - way >= reach_) return;
    // Over the piece the distance is within v t of the middle's: t of either half, v how fast the body is there.
    const double scale = price_ * leg.length() * (to - from) / way;
    const double high = scale * (beyond(least - way) - beyond(least));
    const double low = scale * (beyond(least) - beyond(least + way));
    const double cost = leg.length() * (to - from) + low;
    if (high - low <= enough * cost || depth >= deepest || way <= 4.0 * rounding) {
      low_ += low;
      high_ += high;
      return;
    }
    for (std::size_t i = first; i < last; ++i) {
      if (distances_[i] <= std::min(reach_ + way, least + 2.0 * way)) pairs_.push_back(pairs_[i]);
    }
    begin_ = last;
    piece(leg, from, 0.5 * (from + to), depth + 1);
    begin_ = last;
    piece(leg, 0.5 * (from + to), to, depth + 1);
    pairs_.resize(last);
    begin_ = first;
  }

  PathSurroundings surroundings_;
  const Execution& execution_;
  std::vector<Vec2> outline_;
  double radius_;
  double price_;
  double reach_;
  double extent_ = 0.0;
  double low_ = 0.0;  // of the leg
  double high_ = 0.0;
  std::uint64_t polled_ = 0;
  std::size_t begin_ = 0;  // of the pairs that count
  std::vector<Pair> pairs_;
  std::vector<double> distances_;
  std::vector<Vec2> corners_;
  std::vector<NearSide> sides_;
};

}  // namespace

PriceParts verify_price(const Scene& scene, std::span<const Vec2> path, const Prices& prices, double radius,
                        const Execution& execution) {
  PriceParts parts;
  JudgedFactors factors(scene, prices, execution);
  std::optional<NearCells> near_cells;
  std::optional<NearSides> near_sides;
  double reach = 0.0;
  if (prices.clearance && prices.clearance->price > 0.0) {
    reach = prices.clearance->reach.value_or(2.0 * radius);
    if (!(reach > 0.0)) throw InputError("clearance_price", "says no reach, and a point has no width");
    if (scene.map) {
      const OccupancyMap& map = *scene.map;
      const auto first = cell_at(map, path.front());
      const bool on_water = first && map.water.holds(first->x, first->y);
      near_cells.emplace(map, on_water, (reach + radius) / map.cell, execution);
    } else {
      near_sides.emplace(scene, reach + radius, execution);
    }
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Segment leg{path[i - 1], path[i]};
    if (!(distance(leg.a, leg.b) > 0.0)) continue;
    if (factors.any()) parts.areas += factors.over(leg);
    if (!(reach > 0.0)) continue;
    // (1 - (d - r) / D)^2 is ((D + r) / D)^2 times (1 - d / (D + r))^2
    const double scale = prices.clearance->price * ((reach + radius) / reach) * ((reach + radius) / reach);
    if (near_cells) {
      const Segment own{map_point(*scene.map, leg.a), map_point(*scene.map, leg.b)};
      parts.clearance += scale * scene.map->cell * near_cells->over(JudgedRay(own));
    } else {
      parts.clearance += scale * near_sides->over(JudgedRay(leg));
    }
  }
  return parts;
}

PriceParts verify_body_price(const Scene& scene, std::span<const Se2> path, const RobotSpec& robot,
                             const Prices& prices, const Execution& execution) {
  PriceParts parts;
  execution.reserve(path.size() * sizeof(BodyLeg));
  std::vector<BodyLeg> legs;
  legs.reserve(path.size());
  for (std::size_t i = 1; i < path.size(); ++i) legs.push_back(leg_of(robot, path[i - 1], path[i]));
  JudgedFactors factors(scene, prices, execution);
  for (const BodyLeg& leg : legs) {
    if (!factors.any() || !(leg.length() > 0.0)) continue;
    parts.areas +=
        leg.is_straight ? factors.over(Segment{leg.arc.from, leg.arc.from + leg.chord}) : factors.over(leg.arc);
  }
  if (!prices.clearance || !(prices.clearance->price > 0.0)) return parts;
  BodyNearness nearness(scene, robot, *prices.clearance, legs, execution);
  for (const BodyLeg& leg : legs) nearness.add(leg, parts);
  return parts;
}

}  // namespace warren
