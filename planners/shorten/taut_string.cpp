// SPDX-License-Identifier: BSD-3-Clause
#include "planners/shorten/taut_string.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

constexpr double backwards = -1e-10;  // radians: a bend that is less than this the wrong way counts as straight

double turn_between(Vec2 u, Vec2 v) { return portable::atan2(cross(u, v), dot(u, v)); }

bool is_disc(const TautString::Stop& stop) { return stop.turn != 0.0; }

bool same_disc(const TautString::Stop& a, const TautString::Stop& b) {
  return is_disc(a) && a.turn == b.turn && a.center == b.center;
}

}  // namespace

TautString::TautString(const WallIndex& walls, double radius, double least, Vec2 origin)
    : walls_(walls), radius_(radius), least_(least), origin_(origin) {
  search_size_ = 4.0 * (radius + wall_spacing(walls));
}

double wall_spacing(const WallIndex& walls) {
  if (walls.wall_count() == 0) return 1.0;
  const auto count = static_cast<double>(walls.wall_count());
  const Box& box = walls.box();
  const double of_area = std::sqrt(box.width() / count) * std::sqrt(box.height());
  const double of_line = std::max(box.width(), box.height()) / count;
  return of_area > 0.0 ? of_area : of_line > 0.0 ? of_line : 1.0;
}

TautString::Tangent TautString::tangent(const Stop& a, const Stop& b) const {
  const Vec2 between = b.center - a.center;
  const double length = norm(between);
  if (length == 0.0) return {a.center, b.center, {}};
  const Vec2 ahead = (1.0 / length) * between;
  // The normal that points left: it rises by the difference of the signed radii from a's center to b's.
  const double along = std::clamp(radius_ * (b.turn - a.turn) / length, -1.0, 1.0);
  const double across = std::sqrt(1.0 - along * along);
  const Vec2 normal{along * ahead.x - across * ahead.y, along * ahead.y + across * ahead.x};
  return {a.center - (radius_ * a.turn) * normal, b.center - (radius_ * b.turn) * normal, {normal.y, -normal.x}};
}

TautString::Bend TautString::bend(const Stop& a, const Stop& b, const Stop& c) const {
  const Tangent in = tangent(a, b);
  const Tangent out = tangent(b, c);
  return {in, out, turn_between(in.direction, out.direction)};
}

bool TautString::is_taut(Stop& b, const Bend& bend) const {
  if (!is_disc(b)) return false;
  constexpr double whole = 2.0 * std::numbers::pi;
  const double turned = b.turn * bend.turn;
  b.arc = turned + whole * std::round((b.arc - turned) / whole);  // arcs change by less than half a turn at once
  return b.arc >= backwards;
}

/// Does the tangent from `from` to a disc at `end` point between the directions first and last, turning to `side`?
bool TautString::leaves_within(const Stop& from, Vec2 end, Vec2 first, Vec2 last, double side) const {
  const Vec2 u = tangent(from, {end, side, 0.0}).direction;
  return !(u == Vec2{}) && side * cross(first, u) >= backwards && side * cross(u, last) > -backwards;
}

bool TautString::arrives_within(Vec2 end, const Stop& to, Vec2 first, Vec2 last, double side) const {
  const Vec2 u = tangent({end, side, 0.0}, to).direction;
  return !(u == Vec2{}) && side * cross(first, u) > -backwards && side * cross(u, last) >= backwards;
}

/// Does the disc at `end` keep the string, falling to `side` about `from`, from reaching the tangent?
bool TautString::obstructs(Vec2 end, const Stop& from, const Tangent& tangent, double side) const {
  const Vec2 to = end - tangent.from;
  if (dot(tangent.direction, to) >= 0.0) {
    return side * cross(tangent.direction, to) < radius_ * (1.0 - 1e-10);
  }
  const Vec2 u =
      this->tangent(from, {end, side, 0.0}).direction;  // the string has met the disc before it turned so far
  return side * cross(u, tangent.direction) > -backwards;
}

/// The same for the last tangent, that to c: a disc that lies beyond c doesn't.
bool TautString::obstructs_last(Vec2 end, const Stop& from, const Stop& c, const Tangent& tangent, double side) const {
  if (!obstructs(end, from, tangent, side)) return false;
  if (dot(tangent.direction, end - tangent.to) <= 0.0) return true;
  return side * cross(tangent.direction, this->tangent({end, side, 0.0}, c).direction) > -backwards;
}

/// Is the wall end inside the bend, and in the way of the direct tangent?
bool TautString::is_inside(Vec2 end, const Fall& fall) const {
  const auto& [in, out, turn] = fall.bend;
  const Vec2 from_a = end - in.from;
  const Vec2 from_c = end - out.to;
  const bool behind_a = dot(in.direction, from_a) < 0.0;
  const bool beyond_c = dot(out.direction, from_c) > 0.0;
  if (!behind_a && fall.side * cross(in.direction, from_a) < least_) return false;
  if (!beyond_c && fall.side * cross(out.direction, from_c) < least_) return false;
  if (!obstructs_last(end, fall.a, fall.c, fall.direct, fall.side)) return false;
  // Near the ends of the bend the legs' lines say nothing: there the tangents' directions decide.
  if (behind_a && !leaves_within(fall.a, end, in.direction, fall.direct.direction, fall.side)) return false;
  return !beyond_c || arrives_within(end, fall.c, fall.direct.direction, out.direction, fall.side);
}

/// Where the string bends when b is let go: at the point itself; for a disc, where the tangents cross before they
/// reach it.
Vec2 TautString::corner(const Stop& b, const Bend& bend) const {
  if (!is_disc(b)) return b.center;
  const double back = radius_ * portable::tan(0.5 * std::abs(bend.turn));
  const double room = std::min(distance(bend.in.from, bend.in.to), distance(bend.out.from, bend.out.to));
  return back < room ? bend.in.to - back * bend.in.direction : bend.in.to;
}

/// Wall ends inside the bend, into ends_. A large triangle is halved, since its box may be much larger than itself.
void TautString::gather(const Vec2 (&triangle)[3], const Fall& fall, int depth) {
  Box box;
  for (const Vec2 p : triangle) box.include(p);
  constexpr int deepest = 24;
  if (depth < deepest && std::min(box.width(), box.height()) > search_size_) {
    int from = 0;  // the longest side begins here
    for (const int i : {1, 2}) {
      if (distance(triangle[i], triangle[(i + 1) % 3]) > distance(triangle[from], triangle[(from + 1) % 3])) from = i;
    }
    const Vec2 p = triangle[from];
    const Vec2 q = triangle[(from + 1) % 3];
    const Vec2 opposite = triangle[(from + 2) % 3];
    const Vec2 middle = 0.5 * (p + q);
    gather({p, middle, opposite}, fall, depth + 1);
    gather({middle, q, opposite}, fall, depth + 1);
    return;
  }
  const Box searched = box.grown(2.0 * radius_);
  walls_.for_each_near({searched.min + origin_, searched.max + origin_}, [&](const Segment& wall) {
    for (const Vec2 end : {wall.a - origin_, wall.b - origin_}) {
      if (is_inside(end, fall)) ends_.push_back(end);
    }
    return true;
  });
}

/// The convex chain from a to c around ends_, into chain_: always on to the end whose tangent lies outermost.
void TautString::wrap(const Fall& fall) {
  Stop from = fall.a;
  while (chain_.size() < ends_.size()) {
    Tangent outermost = chain_.empty() ? fall.direct : tangent(from, fall.c);
    bool found = false;
    Stop next;
    for (const Vec2 end : ends_) {
      if (is_disc(from) && distance(end, from.center) <= 1e-9 * radius_) continue;
      const bool outer =
          found ? obstructs(end, from, outermost, fall.side) : obstructs_last(end, from, fall.c, outermost, fall.side);
      if (!outer) continue;
      next = {end, fall.side, 0.0};
      outermost = tangent(from, next);
      found = true;
    }
    if (!found) return;
    chain_.push_back(next);
    from = next;
  }
}

/// How much of the second leg, from `at` to its end, the string has fallen past when it no longer lies on a and turns
/// about the stop before a: 0 for nothing, 1 for all.
double TautString::fallen_when_free(const Stop& a, const Bend& bend, Vec2 at) const {
  const double side = bend.turn > 0.0 ? 1.0 : -1.0;
  if (!is_disc(a) || a.turn == side) return 1.0;
  const Tangent direct = tangent(a, right_[right_.size() - 2]);
  if (side * turn_between(bend.in.direction, direct.direction) <= a.arc) return 1.0;
  const Tangent before = tangent(left_[left_.size() - 2], a);
  const Vec2 leg = bend.out.to - at;
  const double area = cross(before.direction, leg);
  if (a.arc <= -backwards) return 0.0;
  return area == 0.0 ? 1.0 : std::clamp(cross(before.direction, before.to - at) / area, 0.0, 1.0);
}

/// Lets go of the next stop, right_.back(), or of the one before where that has to go first.
void TautString::release(const Bend& bend) {
  const Vec2 at = corner(right_.back(), bend);
  const double part = fallen_when_free(left_.back(), bend, at);
  if (part == 0.0) {
    left_.pop_back();
    return;
  }
  if (part == 1.0) return fall(bend, at);
  const Stop split{at + part * (bend.out.to - at), 0.0, 0.0};
  right_.insert(right_.end() - 1, split);
  fall({bend.in, {bend.out.from, split.center, bend.out.direction}, bend.turn}, at);
}

/// Takes out the next stop, right_.back(), and puts in what the string then comes to lie on. at: where it bent.
void TautString::fall(const Bend& bend, Vec2 at) {
  const Stop b = right_.back();
  right_.pop_back();
  const Stop a = left_.back();
  Stop& c = right_.back();
  const double side = bend.turn > 0.0 ? 1.0 : -1.0;
  ends_.clear();
  chain_.clear();
  if (std::abs(bend.turn) > 1e-14) {
    const Stop first{bend.in.from, 0.0, 0.0};
    const Stop last{bend.out.to, 0.0, 0.0};
    const bool cut_short = is_disc(b) && at == bend.in.to;
    const Bend legs = cut_short ? this->bend(a, {at, 0.0, 0.0}, last) : bend;
    const Tangent direct = a.center == c.center ? tangent(first, last) : tangent(a, c);
    const Fall fall{a, c, legs, direct, side};
    gather({first.center, at, last.center}, fall, 0);
    wrap(fall);
  }
  if (chain_.empty() && same_disc(a, c)) {  // what lay between is gone: one disc, wound around for both
    c.arc += a.arc + a.turn * bend.turn;
    left_.pop_back();
  }
  right_.insert(right_.end(), chain_.rbegin(), chain_.rend());
  if (left_.size() > 1) {
    right_.push_back(left_.back());
    left_.pop_back();
  }
}

std::vector<TautString::Stop> TautString::pull(std::span<const Vec2> points, const Execution& execution) {
  left_.assign(1, {points.front() - origin_, 0.0, 0.0});
  right_.clear();
  for (std::size_t i = points.size(); i-- > 1;) right_.push_back({points[i] - origin_, 0.0, 0.0});
  const std::size_t most_steps = 1000 + 200 * points.size();  // never reached unless rounding makes it go in circles
  for (std::size_t step = 0; right_.size() > 1 && step < most_steps; ++step) {
    if (step % 1024 == 0) execution.check();
    Stop& b = right_.back();
    const Bend here = bend(left_.back(), b, right_[right_.size() - 2]);
    if (is_taut(b, here)) {
      left_.push_back(b);
      right_.pop_back();
    } else {
      release(here);
    }
  }
  left_.insert(left_.end(), right_.rbegin(), right_.rend());
  return std::move(left_);
}

}  // namespace warren
