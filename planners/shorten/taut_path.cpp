// SPDX-License-Identifier: BSD-3-Clause
#include "planners/shorten/taut_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/trigonometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// How far walls stand apart, roughly: the square root of the area a wall; > 0.
double wall_spacing(const WallIndex& walls) {
  if (walls.wall_count() == 0) return 1.0;
  const auto count = static_cast<double>(walls.wall_count());
  const Box& box = walls.box();
  const double of_area = std::sqrt(box.width() / count) * std::sqrt(box.height());
  const double of_line = std::max(box.width(), box.height()) / count;
  return of_area > 0.0 ? of_area : of_line > 0.0 ? of_line : 1.0;
}

constexpr double backwards = -1e-10;  // radians: a bend that is less than this the wrong way counts as straight

double turn_between(Vec2 u, Vec2 v) { return portable::atan2(cross(u, v), dot(u, v)); }

/// A string pulled taut around wall ends, each widened to a disc of one radius: the locally shortest path of the
/// string's homotopy class, which is the only one. It is a list of stops, joined by tangents: the two ends, discs with
/// the side on which they are passed, and in between points of the raw path that are still to be pulled away.
///
/// One sweep with two stacks. A stop that is a point, or a disc around which the string would bend backwards, is let
/// go: the string falls from the bend a-b-c onto the convex chain around the wall ends inside the bend (gift wrapping
/// over the ends that the wall index finds there), and the stop before is looked at again. Where the string would turn
/// about a disc further than it lies on it, it falls in two parts: until it comes off that disc, and on from the stop
/// before. Each release shortens the string. A wall that reaches into the bend has an end in it, since it crosses
/// neither leg; so its ends are all that counts. How often a disc is wound around is kept: a string that circles a
/// pillar goes on circling it.
///
/// Cost: one release a raw point and a few more where stops are let go again, each the walls in the bend's triangle
/// (large triangles are searched part by part). Exact but for rounding; the caller checks the result.
class TautString {
 public:
  /// A place where the string may bend.
  struct Stop {
    Vec2 center;
    double turn = 0.0;  ///< +1: a disc on the left, passed anticlockwise; -1: on the right; 0: a point
    double arc = 0.0;   ///< radians of the disc that the string lies on
  };
  /// A straight stretch between two stops.
  struct Tangent {
    Vec2 from, to;
    Vec2 direction;  ///< of length 1, or 0 where the stops are one point
  };

  /// Refers to the walls. radius > 0: of the discs. least <= radius: the distance that the points' legs are sure to
  /// keep from the walls. Stops are counted from `origin`, near the points, so that large coordinates cost no digits.
  TautString(const WallIndex& walls, double radius, double least, Vec2 origin)
      : walls_(walls), radius_(radius), least_(least), origin_(origin) {
    search_size_ = 4.0 * (radius + wall_spacing(walls));
  }

  /// The stops of the string that was laid along `points` (at least two, consecutive ones different): the first and the
  /// last are points; where the work is given up (only if rounding made it go in circles), more are.
  std::vector<Stop> pull(std::span<const Vec2> points, const Execution& execution) {
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

  Tangent tangent(const Stop& a, const Stop& b) const {
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

 private:
  struct Bend {
    Tangent in, out;
    double turn;  ///< radians from the one to the other, in (-pi, pi]
  };

  /// What is being let go: the string a-b-c, and the stop that it may fall on next.
  struct Fall {
    Stop a, c;
    Bend bend;
    Tangent direct;  ///< from a to c
    double side;     ///< of the bend: +1 to the left
  };

  static bool is_disc(const Stop& stop) { return stop.turn != 0.0; }
  static bool same_disc(const Stop& a, const Stop& b) { return is_disc(a) && a.turn == b.turn && a.center == b.center; }
  Bend bend(const Stop& a, const Stop& b, const Stop& c) const {
    const Tangent in = tangent(a, b);
    const Tangent out = tangent(b, c);
    return {in, out, turn_between(in.direction, out.direction)};
  }

  bool is_taut(Stop& b, const Bend& bend) const {
    if (!is_disc(b)) return false;
    constexpr double whole = 2.0 * std::numbers::pi;
    const double turned = b.turn * bend.turn;
    b.arc = turned + whole * std::round((b.arc - turned) / whole);  // arcs change by less than half a turn at once
    return b.arc >= backwards;
  }

  /// How much of the second leg, from `at` to its end, the string has fallen past when it no longer lies on a and turns
  /// about the stop before a: 0 for nothing, 1 for all.
  double fallen_when_free(const Stop& a, const Bend& bend, Vec2 at) const {
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
  void release(const Bend& bend) {
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
  void fall(const Bend& bend, Vec2 at) {
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

  /// Where the string bends when b is let go: at the point itself; for a disc, where the tangents cross before they
  /// reach it.
  Vec2 corner(const Stop& b, const Bend& bend) const {
    if (!is_disc(b)) return b.center;
    const double back = radius_ * portable::tan(0.5 * std::abs(bend.turn));
    const double room = std::min(distance(bend.in.from, bend.in.to), distance(bend.out.from, bend.out.to));
    return back < room ? bend.in.to - back * bend.in.direction : bend.in.to;
  }

  /// Wall ends inside the bend, into ends_. A large triangle is halved, since its box may be much larger than itself.
  void gather(const Vec2 (&triangle)[3], const Fall& fall, int depth) {
    const Box box = box_around(triangle);
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

  /// Is the wall end inside the bend, and in the way of the direct tangent?
  bool is_inside(Vec2 end, const Fall& fall) const {
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

  /// Does the tangent from `from` to a disc at `end` point between the directions first and last, turning to `side`?
  bool leaves_within(const Stop& from, Vec2 end, Vec2 first, Vec2 last, double side) const {
    const Vec2 u = tangent(from, {end, side, 0.0}).direction;
    return !(u == Vec2{}) && side * cross(first, u) >= backwards && side * cross(u, last) > -backwards;
  }
  bool arrives_within(Vec2 end, const Stop& to, Vec2 first, Vec2 last, double side) const {
    const Vec2 u = tangent({end, side, 0.0}, to).direction;
    return !(u == Vec2{}) && side * cross(first, u) > -backwards && side * cross(u, last) >= backwards;
  }

  /// Does the disc at `end` keep the string, falling to `side` about `from`, from reaching the tangent?
  bool obstructs(Vec2 end, const Stop& from, const Tangent& tangent, double side) const {
    const Vec2 to = end - tangent.from;
    if (dot(tangent.direction, to) >= 0.0) {
      return side * cross(tangent.direction, to) < radius_ * (1.0 - 1e-10);
    }
    // The string has met the disc before it turned so far.
    const Vec2 u = this->tangent(from, {end, side, 0.0}).direction;
    return side * cross(u, tangent.direction) > -backwards;
  }

  /// The same for the last tangent, that to c: a disc that lies beyond c doesn't.
  bool obstructs_last(Vec2 end, const Stop& from, const Stop& c, const Tangent& tangent, double side) const {
    if (!obstructs(end, from, tangent, side)) return false;
    if (dot(tangent.direction, end - tangent.to) <= 0.0) return true;
    return side * cross(tangent.direction, this->tangent({end, side, 0.0}, c).direction) > -backwards;
  }

  /// The convex chain from a to c around ends_, into chain_: always on to the end whose tangent lies outermost.
  void wrap(const Fall& fall) {
    Stop from = fall.a;
    while (chain_.size() < ends_.size()) {
      Tangent outermost = chain_.empty() ? fall.direct : tangent(from, fall.c);
      bool found = false;
      Stop next;
      for (const Vec2 end : ends_) {
        if (is_disc(from) && distance(end, from.center) <= 1e-9 * radius_) continue;
        const bool outer = found ? obstructs(end, from, outermost, fall.side)
                                 : obstructs_last(end, from, fall.c, outermost, fall.side);
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

  const WallIndex& walls_;
  double radius_;
  double least_;
  Vec2 origin_;
  double search_size_;       // triangles wider than this are halved: a few walls
  std::vector<Stop> left_;   // settled, up to the stop before the one looked at
  std::vector<Stop> right_;  // still to come, the next one last
  std::vector<Vec2> ends_;   // wall ends inside the bend
  std::vector<Stop> chain_;
};

using Stop = TautString::Stop;

constexpr double widest_step = 0.16;         // radians of an arc for one tangent
constexpr double widest_tiny_step = 1.2;     // the same with clearance 0, where an arc's length is next to nothing
constexpr std::size_t most_tangents = 1024;  // times as many as that, where room is scarce
constexpr std::size_t grain = 1024;

/// Without points that repeat the last one or lie between their neighbours on a line parallel to an axis: there it is
/// certain that the longer leg is as free as its parts.
Path<Vec2> corners_of(std::span<const Vec2> path) {
  const auto between = [](Vec2 a, Vec2 b, Vec2 c) {
    const bool upright = a.x == b.x && b.x == c.x && (b.y - a.y) * (c.y - b.y) > 0.0;
    const bool level = a.y == b.y && b.y == c.y && (b.x - a.x) * (c.x - b.x) > 0.0;
    return upright || level;
  };
  Path<Vec2> corners;
  for (const Vec2 p : path) {
    if (!corners.empty() && p == corners.back()) continue;
    if (corners.size() > 1 && between(corners[corners.size() - 2], corners.back(), p)) corners.pop_back();
    corners.push_back(p);
  }
  return corners;
}

double length_of(std::span<const Vec2> path) {
  return path_length(path, [](Vec2 a, Vec2 b) { return distance(a, b); });
}

class Pulling {
 public:
  Pulling(const WallIndex& walls, std::span<const Vec2> path, double clearance, const Execution& execution)
      : walls_(walls), clearance_(clearance), execution_(execution) {
    for (const Vec2 p : path) box_.include(p);
    const Vec2 far{std::max(std::abs(box_.min.x), std::abs(box_.max.x)),
                   std::max(std::abs(box_.min.y), std::abs(box_.max.y))};
    rounding_ = 4e-16 * std::max(far.x, far.y);
    least_ = clearance > 0.0 ? clearance * (1.0 - 1e-9) : margin_of(path);
    // A little more than is asked for, so that rounded tangents keep what is asked for.
    radius_ = least_ * (1.0 + 5e-9) + 8.0 * rounding_;
  }

  /// Appends the taut path along `points` but for its first point. Where something fails the check, the halves are
  /// pulled by themselves; what can't be halved stays as it was.
  void append(std::span<const Vec2> points, Path<Vec2>& result) {
    if (points.size() > 2) {
      std::vector<Vec2> taut = pulled(points);
      if (taut.empty()) {
        const std::size_t half = points.size() / 2;
        append(points.first(half + 1), result);
        append(points.subspan(half), result);
        return;
      }
      if (length_of(taut) < length_of(points)) {
        result.insert(result.end(), taut.begin() + 1, taut.end());
        return;
      }
    }
    result.insert(result.end(), points.begin() + 1, points.end());
  }

 private:
  /// Which legs don't keep the clearance.
  std::vector<std::uint8_t> bad_legs(std::span<const Vec2> path, double clearance) const {
    std::vector<std::uint8_t> bad(path.size() - 1, 0);
    for_each_index(bad.size(), grain, execution_,
                   [&](std::size_t i) { bad[i] = walls_.keeps_clearance(path[i], path[i + 1], clearance) ? 0 : 1; });
    return bad;
  }
  static bool has_any(const std::vector<std::uint8_t>& bad) {
    return std::find(bad.begin(), bad.end(), 1) != bad.end();
  }

  /// For clearance 0: a small distance that the whole path keeps.
  double margin_of(std::span<const Vec2> path) const {
    double margin = 1e-6 * wall_spacing(walls_);
    while (margin > rounding_ && has_any(bad_legs(path, margin))) margin /= 8.0;
    return margin;
  }

  /// The polyline around the stops, stop i's arc by at least tangents[i] times the usual number of tangents;
  /// from_stop[j] is the stop of its point j.
  std::vector<Vec2> polyline(const TautString& string, const std::vector<Stop>& stops,
                             const std::vector<std::size_t>& tangents, std::vector<std::size_t>& from_stop) const {
    std::vector<Vec2> points;
    from_stop.clear();
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const Stop& stop = stops[i];
      if (stop.turn == 0.0) {
        points.push_back(inside_box(stop.center));
      } else {
        append_arc(stop, string.tangent(stops[i - 1], stop).to - stop.center, tangents[i], points);
      }
      from_stop.resize(points.size(), i);
    }
    return points;
  }

  /// Corners of the tangents at the arc that begins at `spoke` from the disc's center.
  void append_arc(const Stop& stop, Vec2 spoke, std::size_t finer, std::vector<Vec2>& points) const {
    const double arc = std::max(stop.arc, 0.0);
    const double count = static_cast<double>(finer) *
                         std::max(1.0, std::ceil(arc / (clearance_ > 0.0 ? widest_step : widest_tiny_step)));
    const double half = 0.5 * arc / count;
    for (double i = 0.0; i < count; i += 1.0) {
      const double angle = stop.turn * (2.0 * i + 1.0) * half;
      const double stretch = 1.0 / portable::cos(half);
      points.push_back(inside_box(stop.center + stretch * Rotation(angle)(spoke)));
    }
  }

  /// From the string's coordinates to the world's.
  Vec2 inside_box(Vec2 p) const {
    p = p + box_.min;
    return {std::clamp(p.x, box_.min.x, box_.max.x), std::clamp(p.y, box_.min.y, box_.max.y)};
  }

  /// The checked taut path along the points; empty if there is none.
  std::vector<Vec2> pulled(std::span<const Vec2> points) const {
    TautString string(walls_, radius_, least_, box_.min);
    const std::vector<Stop> stops = string.pull(points, execution_);
    std::vector<std::size_t> tangents(stops.size(), 1);
    std::vector<std::size_t> from_stop;
    for (std::size_t finest = 1; finest <= most_tangents; finest *= 4) {
      std::vector<Vec2> path = polyline(string, stops, tangents, from_stop);
      path.front() = points.front();
      path.back() = points.back();
      const std::vector<std::uint8_t> bad = bad_legs(path, clearance_);
      if (!has_any(bad)) return path;
      for (std::size_t leg = 0; leg < bad.size(); ++leg) {
        if (bad[leg] != 0) tangents[from_stop[leg]] = tangents[from_stop[leg + 1]] = 4 * finest;
      }
    }
    return {};
  }

  const WallIndex& walls_;
  double clearance_;
  const Execution& execution_;
  Box box_;
  double rounding_ = 0.0;  ///< of a coordinate
  double least_ = 0.0;     ///< distance that the given path keeps
  double radius_ = 0.0;    ///< distance that the taut one is to keep
};

}  // namespace

Path<Vec2> taut_path(const WallIndex& walls, std::span<const Vec2> path, double clearance, const Execution& execution) {
  const Path<Vec2> corners = corners_of(path);
  if (corners.size() < 3) return corners;
  Path<Vec2> result{corners.front()};
  Pulling(walls, corners, clearance, execution).append(corners, result);
  return result;
}

namespace {

class Puller {
 public:
  Puller(const Path<Vec2>& path, const PricedLegs& legs, const Execution& execution)
      : legs_(legs), execution_(execution) {
    for (const Vec2 place : path) {
      while (vertices_.size() > 1 && goes_straight_on(place)) vertices_.pop_back();
      vertices_.push_back({place, 0.0, legs.step, true});
    }
    for (std::size_t i = 1; i < vertices_.size(); ++i) {
      vertices_[i].leg = legs_.cost(vertices_[i - 1].place, vertices_[i].place);
    }
  }

  Path<Vec2> pulled() {
    constexpr double worth = 1e-4;
    constexpr int turns = 60;
    double older = std::numeric_limits<double>::infinity();  // two turns ago: one may be but halved steps
    double before = whole();
    for (int turn = 0; turn < turns && vertices_.size() > 1; ++turn) {
      noise_ = 1e-9 * before;
      leave_out();
      move();
      put_in();
      const double now = whole();
      if (older - now <= worth * now) break;
      older = std::exchange(before, now);
    }
    leave_out();
    Path<Vec2> path;
    for (const Vertex& v : vertices_) path.push_back(v.place);
    return path;
  }

 private:
  struct Vertex {
    Vec2 place;
    double leg = 0.0;    // what the leg to it costs
    double step = 0.0;   // of its next move
    bool is_new = true;  // has anything beside it changed since it was tried?
  };

  /// From the last vertex but one over the last: what costs the same with a vertex less.
  bool goes_straight_on(Vec2 to) const {
    constexpr double rounding = 1e-9;
    const Vec2 from = vertices_[vertices_.size() - 2].place;
    const Vec2 way = vertices_.back().place - from;
    const Vec2 rest = to - vertices_.back().place;
    return std::abs(cross(way, rest)) <= rounding * dot(way, rest) && legs_.is_free(from, to);
  }
  double whole() const {
    double sum = 0.0;
    for (const Vertex& v : vertices_) sum += v.leg;
    return sum;
  }
  double least_step() const { return legs_.step / 64.0; }

  /// Each vertex that is not worth its corner, as far back as that goes.
  void leave_out() {
    std::vector<Vertex> kept;
    for (const Vertex& next : vertices_) {
      kept.push_back(next);
      while (kept.size() > 2) {
        execution_.check();
        Vertex& last = kept.back();
        const Vertex& middle = kept[kept.size() - 2];
        const Vec2 from = kept[kept.size() - 3].place;
        if (!last.is_new && !middle.is_new) break;
        const double straight = legs_.cost(from, last.place);
        if (!(straight <= middle.leg + last.leg + noise_ * 1e-3) || !legs_.is_free(from, last.place)) break;
        last.leg = straight;
        last.is_new = true;
        kept.erase(kept.end() - 2);
        kept[kept.size() - 2].is_new = true;
      }
    }
    vertices_ = std::move(kept);
  }

  /// Where the cost of both legs falls, first across the chord, then along it.
  void move() {
    for (std::size_t i = 1; i + 1 < vertices_.size(); ++i) {
      execution_.check();
      if (vertices_[i].step < least_step()) {
        if (!vertices_[i].is_new) continue;
        vertices_[i].step = 4.0 * least_step();
      }
      const Vec2 chord = vertices_[i + 1].place - vertices_[i - 1].place;
      const double length = norm(chord);
      if (!(length > 0.0)) continue;
      const Vec2 along = (1.0 / length) * chord;
      const Vec2 across{-along.y, along.x};
      const bool moved = move_along(i, across) || move_along(i, along);
      vertices_[i].is_new = moved;
      if (!moved) vertices_[i].step *= 0.5;
    }
  }

  /// The least of a parabola through three costs, and half as far where that is not free.
  bool move_along(std::size_t i, Vec2 direction) {
    Vertex& v = vertices_[i];
    const double now = v.leg + vertices_[i + 1].leg;
    const auto at = [&](double way) {
      const Vec2 place = v.place + way * direction;
      return legs_.cost(vertices_[i - 1].place, place) + legs_.cost(place, vertices_[i + 1].place);
    };
    const double ahead = at(v.step);
    const double back = at(-v.step);
    const double bend = ahead + back - 2.0 * now;
    const double downhill = ahead < back ? v.step : -v.step;
    double best = downhill;
    if (bend > 0.0) best = std::clamp(0.5 * v.step * (back - ahead) / bend, -2.0 * v.step, 2.0 * v.step);
    for (const double way : {best, 0.5 * best, 0.25 * best}) {
      if (!(std::abs(way) > 0.25 * least_step())) break;
      if (take(i, v.place + way * direction)) {
        if (std::abs(way) > 1.5 * v.step) v.step *= 2.0;
        return true;
      }
    }
    return false;
  }

  bool take(std::size_t i, Vec2 place) {
    Vertex& v = vertices_[i];
    Vertex& next = vertices_[i + 1];
    const double in = legs_.cost(vertices_[i - 1].place, place);
    const double out = legs_.cost(place, next.place);
    if (!(in + out < v.leg + next.leg - noise_)) return false;
    if (!legs_.is_free(vertices_[i - 1].place, place) || !legs_.is_free(place, next.place)) return false;
    v.place = place;
    v.leg = in;
    next.leg = out;
    vertices_[i - 1].is_new = v.is_new = next.is_new = true;
    return true;
  }

  /// A vertex in the middle of a leg, where that is cheaper off the leg.
  void put_in() {
    std::vector<Vertex> more{vertices_.front()};
    for (std::size_t i = 1; i < vertices_.size(); ++i) {
      execution_.check();
      Vertex next = vertices_[i];
      const Vec2 from = more.back().place;
      const Vec2 leg = next.place - from;
      const double length = norm(leg);
      const double pays = next.leg - length;  // a leg that costs nothing beyond is as cheap as can be
      if ((more.back().is_new || next.is_new) && length > 2.0 * legs_.step && pays > noise_) {
        const Vec2 across{-leg.y / length, leg.x / length};
        const Vec2 middle = from + 0.5 * leg;
        for (const double way : {legs_.step, -legs_.step, 0.25 * legs_.step, -0.25 * legs_.step}) {
          const Vec2 place = middle + way * across;
          const double in = legs_.cost(from, place);
          const double out = legs_.cost(place, next.place);
          if (!(in + out < next.leg - 1e3 * noise_)) continue;
          if (!legs_.is_free(from, place) || !legs_.is_free(place, next.place)) continue;
          more.push_back({place, in, legs_.step, true});
          next.leg = out;
          next.is_new = true;
          break;
        }
      }
      more.push_back(next);
    }
    vertices_ = std::move(more);
  }

  const PricedLegs& legs_;
  const Execution& execution_;
  std::vector<Vertex> vertices_;
  double noise_ = 0.0;  // what rounding may feign
};

}  // namespace

Path<Vec2> priced_taut(Path<Vec2> path, const PricedLegs& legs, const Execution& execution) {
  if (path.size() < 2) return path;
  Path<Vec2> pulled = Puller(path, legs, execution).pulled();
  // Rounding may lose what leaving out did not gain.
  return path_length(pulled, legs.cost) <= path_length(path, legs.cost) ? pulled : path;
}

}  // namespace warren
