// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/disc_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/se2.hpp"

namespace warren {
namespace {

constexpr double unit_rounding = 0x1p-53;
constexpr double whole_turn = 2.0 * std::numbers::pi;
constexpr double cone_doubt = 1e-14;  // of unit vectors' products, and of angles
constexpr std::uint32_t no_tangent = 0xffffffffU;

Vec2 quarter_left(Vec2 v) { return {-v.y, v.x}; }

/// One of the two ends, or one side of a circle: 2 * circle, and 1 more where its corner is on the left of the way.
using SideId = std::uint32_t;

/// A tangent from side to side.
struct TangentWay {
  SideId from, to;
  Vec2 along;  // its direction, a unit vector
  double length;
  double out, in;  // where it leaves `from` and arrives at `to`: radians travelled on from the cone's begin
  double doubt;    // of its direction, radians
  double cost = std::numeric_limits<double>::infinity();  // at its end
  std::uint32_t parent = no_tangent;
  bool settled = false;
};

/// A side of a circle, once something has arrived there.
struct CircleSide {
  std::vector<std::uint32_t> ways;      // that leave it, by `out`
  std::vector<double> blocked;          // ascending: arcs that pass here are blocked
  std::vector<std::uint32_t> arrivals;  // ways that arrived, but for those that were dropped
  bool known = false;                   // is `blocked`?
  bool left = false;                    // are the ways drawn?
};

/// What counts as free.
struct DiscRoom {
  double radius;  ///< of circles
  double least;   ///< what is nearer than this to the centre blocks: less than `radius` by more than rounding
  bool loose;     ///< in doubt free
};

/// Which segments come near a leg; scratch of one thread. The ground must outlive it.
class NearSegments {
 public:
  explicit NearSegments(const DiscGround& ground) : ground_(ground), epoch_(ground.segments.size(), 0) {}

  /// Calls visit(number) once for all segments of the ground that come nearer to s than `within`, and some more, until
  /// it returns false; whether it never did. `within` allows for the rounding of the caller's coordinates.
  template <class Visit>
  bool for_each(const Segment& s, double within, const Visit& visit) {
    const SegmentGrid& grid = ground_.grid;
    if (ground_.segments.empty() || !box_of(s).grown(within).meets(grid.box())) return true;
    if (++now_ == 0) {
      std::fill(epoch_.begin(), epoch_.end(), 0U);
      now_ = 1;
    }
    return grid.for_each_cell_near(s, within, [&](SegmentGrid::Cell cell) {
      for (const std::uint32_t number : grid.in_cell(cell)) {
        if (epoch_[number] == now_) continue;
        epoch_[number] = now_;
        if (!visit(number)) return false;
      }
      return true;
    });
  }

 private:
  const DiscGround& ground_;
  std::vector<std::uint32_t> epoch_;
  std::uint32_t now_ = 0;
};

/// What of the searches of one question is the same.
class DiscSight {
 public:
  /// known: who sees whom, where that is there already; nullptr: nowhere.
  DiscSight(const DiscGround& ground, const Graph* known, Vec2 start, Vec2 goal, double radius,
            const Execution& execution)
      : ground(ground),
        start(start),
        goal(goal),
        radius(radius),
        execution(execution),
        near(ground),
        known_(known),
        sight_(ground.corners, execution),
        candidates_(asked_for(ground, execution)),
        looked_(candidates_.size(), 0) {}

  std::uint32_t ends() const { return static_cast<std::uint32_t>(ground.circles.size()); }
  /// Circles that can follow on this side, ends(): the goal; of 2 * ends(): on the start. Throws Stopped.
  std::span<const std::uint32_t> candidates(SideId side) {
    if (looked_[side] == 0) look(side);
    return candidates_[side];
  }

  const DiscGround& ground;
  const Vec2 start, goal;
  const double radius;
  const Execution& execution;
  NearSegments near;

 private:
  /// Asks for the memory of both searches, too.
  static std::size_t asked_for(const DiscGround& ground, const Execution& execution) {
    const std::size_t count = 2 * ground.circles.size() + 1;
    execution.reserve(count * (2 * sizeof(CircleSide) + sizeof(std::vector<std::uint32_t>) + 1) +
                      ground.segments.size() * sizeof(std::uint32_t));
    return count;
  }

  void look(SideId side) {
    execution.check();
    const std::uint32_t circle = side / 2;
    std::vector<std::uint32_t>& found = candidates_[side];
    const bool is_whole = circle < ends() && ground.circles[circle].whole();
    if (is_whole) {
      for (std::uint32_t c = 0; c < ground.first_whole; ++c) found.push_back(c);
      found.push_back(ends());
    } else {
      see(side);
      for (const VertexId v : seen_) found.push_back(v == CornerSight::target ? ends() : ground.circle_of[v]);
    }
    for (std::uint32_t c = ground.first_whole; c < ends(); ++c) {
      if (c != circle) found.push_back(c);
    }
    execution.reserve(found.size() * sizeof(std::uint32_t));
    looked_[side] = 1;
  }

  void see(SideId side) {
    if (side / 2 == ends()) return sight_.from_point(start, VisibilityEdges::discs, goal, seen_);
    const DiscCircle& circle = ground.circles[side / 2];
    const VertexId v = circle.vertex;
    if (known_ == nullptr) return sight_.within_ranges(v, ranges_of(circle, side % 2 != 0), goal, seen_);
    if (!goal_seen_) {
      sight_.from_point(goal, VisibilityEdges::discs, std::nullopt, seen_);
      goal_seen_ = seen_;
    }
    seen_.assign(known_->neighbours(v).begin(), known_->neighbours(v).end());
    if (std::binary_search(goal_seen_->begin(), goal_seen_->end(), v)) seen_.push_back(CornerSight::target);
  }

  /// Where the corners of circles are that ways lead to from one side of a circle. A way runs in a direction of the
  /// cone, a quarter turn on; the corner that it leads to lies ahead, or, on the other side, so far aside as the
  /// distance allows.
  std::array<PlaceRange, 6> ranges_of(const DiscCircle& circle, bool left) const {
    constexpr std::array<double, 6> turns{0.0, 0.1, 0.2, 0.4, 0.8, 0.5 * std::numbers::pi};  // off the way, radians
    constexpr double wider = 1.0 + 1e-6;
    const Vec2 straight = left ? -1.0 * circle.first : -1.0 * circle.last;  // the cone's first way
    const double ahead = direction_place(straight);
    std::array<PlaceRange, 6> ranges;
    ranges[0] =
        left ? PlaceRange{ahead, direction_place(circle.last)} : PlaceRange{direction_place(circle.first), ahead};
    for (std::size_t i = 1; i < ranges.size(); ++i) {
      const auto aside = [&](double turn) {
        const auto [sine, cosine] = portable::sin_and_cos(turn);
        return direction_place(cosine * straight + (left ? -sine : sine) * quarter_left(straight));
      };
      const double reach =
          i == 1 ? std::numeric_limits<double>::infinity() : wider * 2.0 * radius / portable::sin(turns[i - 1]);
      ranges[i] = left ? PlaceRange{aside(turns[i]), aside(turns[i - 1]), reach}
                       : PlaceRange{aside(turns[i - 1]), aside(turns[i]), reach};
    }
    return ranges;
  }

  const Graph* known_;
  CornerSight sight_;
  std::vector<VertexId> seen_;
  std::optional<std::vector<VertexId>> goal_seen_;  // where the others are known
  std::vector<std::vector<std::uint32_t>> candidates_;
  std::vector<std::uint8_t> looked_;
};

/// One search, with its own idea of what is free. What it does is counted in `counts`.
class DiscSearch {
 public:
  DiscSearch(DiscSight& sight, const DiscRoom& room, double reach_of_rounding, DiscPath& counts)
      : sight_(sight),
        counts_(counts),
        room_(room),
        rounding_(reach_of_rounding),
        bulge_(room.radius * turn_of_polyline_rad * turn_of_polyline_rad),
        sides_(2 * std::size_t{sight.ends()}),
        start_(2 * sight.ends()),
        goal_(start_ + 1) {}

  /// Does the disc fit there as an end?
  bool stands(Vec2 p) const {
    const auto& room = sight_.ground.room;
    if ((room && !room->contains(p)) || sight_.ground.corners.is_blocked(p)) return false;
    const double least = room_.loose ? room_.least : room_.radius;
    return sight_.near.for_each({p, p}, least + rounding_,
                                [&](std::uint32_t i) { return !(distance(p, sight_.ground.segments[i]) < least); });
  }

  /// The ways of a shortest path, start to goal; empty: there is none.
  std::vector<TangentWay> search() {
    draw_from(start_, [&](std::uint32_t number) { offer(number, ways_[number].length, no_tangent); });
    while (!queue_.empty()) {
      const std::uint32_t number = queue_.top().way;
      queue_.pop();
      if (ways_[number].settled) continue;
      ways_[number].settled = true;
      if (++settled_ % settled_per_poll == 0) sight_.execution.check();
      if (!is_free(ways_[number])) continue;
      if (ways_[number].to == goal_) return chain_to(number);
      arrive(number);
    }
    return {};
  }

  /// The same ways by this search's idea; empty where one of them is not free.
  std::vector<TangentWay> follow(const std::vector<TangentWay>& found) {
    std::vector<TangentWay> chain;
    for (const TangentWay& way : found) {
      const std::optional<TangentWay> mine = draw(way.from, way.to);
      if (!mine || !is_free(*mine)) return {};
      if (!chain.empty() && !(arc(chain.back(), *mine) <= reach(way.from, chain.back().in))) return {};
      chain.push_back(*mine);
    }
    return chain;
  }

  double length_of(const std::vector<TangentWay>& chain) const {
    double length = 0.0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (i > 0) length += room_.radius * arc(chain[i - 1], chain[i]);
      length += chain[i].length;
    }
    return length;
  }

  std::vector<DiscPiece> pieces_of(const std::vector<TangentWay>& chain) {
    std::vector<DiscPiece> pieces;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Vec2 from = i == 0 ? sight_.start : place(chain[i].from, chain[i].along);
      const Vec2 to = i + 1 == chain.size() ? sight_.goal : place(chain[i].to, chain[i].along);
      if (i > 0) add_arc(chain[i - 1], chain[i], pieces);
      pieces.push_back({from, to, std::nullopt, false, 0.0});
    }
    return pieces;
  }

 private:
  static constexpr std::uint64_t settled_per_poll = 256;

  bool is_end(SideId side) const { return side >= start_; }
  static bool is_left(SideId side) { return side % 2 != 0; }
  const DiscCircle& circle(SideId side) const { return sight_.ground.circles[side / 2]; }
  Vec2 centre(SideId side) const {
    return side == start_ ? sight_.start : side == goal_ ? sight_.goal : circle(side).centre;
  }
  /// How far to the left of a way at this side the centre of its circle is.
  double offset(SideId side) const { return is_end(side) ? 0.0 : is_left(side) ? room_.radius : -room_.radius; }
  /// From the centre of the side's circle to where a way in this direction is on it.
  Vec2 spoke(SideId side, Vec2 along) const { return -offset(side) * quarter_left(along); }
  Vec2 place(SideId side, Vec2 along) const { return centre(side) + spoke(side, along); }

  /// The tangent between two sides; none where circles overlap too much, or it leaves a cone or the room.
  std::optional<TangentWay> draw(SideId from, SideId to) const {
    const Vec2 v = centre(to) - centre(from);
    const double aside = offset(to) - offset(from);
    const double square = dot(v, v);
    double rest = square - aside * aside;
    if (!(square > 0.0)) return std::nullopt;
    if (rest < 0.0) {
      const double most = room_.loose ? std::abs(aside) - (room_.radius - room_.least) : std::abs(aside);
      if (most > 0.0 && square < most * most) return std::nullopt;
      rest = 0.0;
    }
    TangentWay way{.from = from, .to = to, .along = {}, .length = std::sqrt(rest), .out = 0, .in = 0, .doubt = 0};
    way.along = (1.0 / square) * (way.length * v - aside * quarter_left(v));
    if (rest == 0.0) way.along = (1.0 / norm(way.along)) * way.along;
    // The direction is as doubtful as the root: what is short beside the circles' distance is badly rounded.
    const double far = std::sqrt(square);
    way.doubt = way.length > 1e-8 * far ? 8.0 * unit_rounding * far / way.length : 8e-8;
    if (!leaves(from, way, way.out) || !leaves(to, way, way.in)) return std::nullopt;
    return way;
  }

  /// Does the way's direction fit to the side? `at`: where on it.
  bool leaves(SideId side, const TangentWay& way, double& at) const {
    if (is_end(side)) return true;
    const DiscCircle& c = circle(side);
    const Vec2 n = is_left(side) ? -1.0 * quarter_left(way.along) : quarter_left(way.along);
    const double doubt = cone_doubt + way.doubt;
    if (!c.whole() && (dot(n, c.first) > doubt || dot(n, c.last) > doubt)) return false;
    if (!in_room(c, n)) return false;
    at = travelled(side, angle_of(c, n));
    return true;
  }

  /// Anticlockwise from the cone's begin, in its width but for doubt.
  static double angle_of(const DiscCircle& c, Vec2 n) {
    const double angle = portable::atan2(cross(c.begin, n), dot(c.begin, n));
    return angle < (c.whole() ? 0.0 : -0.5 * std::numbers::pi) ? angle + whole_turn : angle;
  }
  double travelled(SideId side, double angle) const { return is_left(side) ? angle : circle(side).width - angle; }

  bool in_room(const DiscCircle& c, Vec2 n) const {
    const auto& room = sight_.ground.room;
    if (!room) return true;
    const double doubt = (room_.loose ? 1.0 : -1.0) * (room_.radius - room_.least);
    const Vec2 p = room_.radius * n;
    return p.x <= room->max.x - c.centre.x + doubt && p.y <= room->max.y - c.centre.y + doubt &&
           -p.x <= c.centre.x - room->min.x + doubt && -p.y <= c.centre.y - room->min.y + doubt;
  }

  /// The angle from the end of one way on to where another leaves: 0 where that is behind it by rounding alone.
  double arc(const TangentWay& before, const TangentWay& after) const {
    return arc(before.to, before.in, after.out, room_.loose ? before.doubt + after.doubt : 0.0);
  }
  /// The same between places of a side. Whole circles go round.
  double arc(SideId side, double from, double to, double doubt) const {
    const double on = to - from;
    if (on >= 0.0) return on;
    if (on >= -2.0 * cone_doubt - doubt) return 0.0;
    return circle(side).whole() ? on + whole_turn : lost;
  }
  static constexpr double lost = std::numeric_limits<double>::infinity();

  /// How far an arc from this place of the side is free: up to the next place that blocks it.
  double reach(SideId side, double from) {
    know_blocked(side / 2);
    const std::vector<double>& blocked = sides_[side].blocked;
    const auto next = std::upper_bound(blocked.begin(), blocked.end(), from);
    if (next != blocked.end()) return *next - from;
    if (circle(side).whole()) return blocked.empty() ? whole_turn : blocked.front() + whole_turn - from;
    return circle(side).width + 1.0;
  }

  /// Calls visit(direction, gap) for obstacles whose grown outline cuts or nearly cuts the circle, gap: by how much
  /// the circle's point in this direction keeps more than is asked for.
  template <class Visit>
  void for_each_direction(const DiscCircle& c, double nearly, const Visit& visit) const {
    const double within = room_.radius + room_.least + nearly;
    sight_.near.for_each({c.centre, c.centre}, within + rounding_, [&](std::uint32_t i) {
      const Segment s = sight_.ground.segments[i];
      if (s.a == c.centre || s.b == c.centre) return true;  // what ends here is the cone's affair
      const Vec2 q = nearest_from(c.centre, s);
      const double far = norm(q);
      if (far >= within) return true;
      if (far > room_.radius - room_.least) {
        visit((1.0 / far) * q, far - room_.radius - room_.least);
        return true;
      }
      for (const Vec2 end : {s.a - c.centre, s.b - c.centre}) {  // passes the corner itself
        const double length = norm(end);
        if (length > room_.radius - room_.least) visit((1.0 / length) * end, -length);
      }
      return true;
    });
    const auto& room = sight_.ground.room;
    if (!room) return;
    const double gaps[] = {room->max.x - c.centre.x, room->max.y - c.centre.y, c.centre.x - room->min.x,
                           c.centre.y - room->min.y};
    constexpr std::array<Vec2, 4> outwards{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const double doubt = (room_.loose ? 1.0 : -1.0) * (room_.radius - room_.least);
    for (std::size_t i = 0; i < 4; ++i) {
      if (gaps[i] + doubt < room_.radius + nearly) visit(outwards[i], gaps[i] + doubt - room_.radius);
    }
  }

  /// From p to the nearest point of s; its direction is right however near p is to the line.
  static Vec2 nearest_from(Vec2 p, const Segment& s) {
    const Vec2 along = s.b - s.a;
    if (dot(p - s.a, along) <= 0.0) return s.a - p;
    if (dot(p - s.b, along) >= 0.0) return s.b - p;
    return (-cross(along, p - s.a) / dot(along, along)) * quarter_left(along);
  }

  void know_blocked(std::uint32_t number) {
    CircleSide& left = sides_[2 * std::size_t{number} + 1];
    if (left.known) return;
    left.known = true;
    const DiscCircle& c = sight_.ground.circles[number];
    for_each_direction(c, 0.0, [&](Vec2 n, double gap) {
      if (gap < 0.0) left.blocked.push_back(angle_of(c, n));
    });
    std::sort(left.blocked.begin(), left.blocked.end());
    CircleSide& right = sides_[2 * std::size_t{number}];
    for (auto angle = left.blocked.rbegin(); angle != left.blocked.rend(); ++angle) {
      right.blocked.push_back(c.width - *angle);
    }
  }

  /// No obstacle nearer than asked for?
  bool is_free(const TangentWay& way) {
    ++counts_.checked;
    const Vec2 c = centre(way.from);
    const double aside = offset(way.from);
    double least = room_.least;
    if (room_.loose) least -= way.doubt * (way.length + room_.radius);
    const Vec2 p = place(way.from, way.along);
    const bool free = !(least > 0.0) ||
                      sight_.near.for_each({p, p + way.length * way.along}, least + rounding_, [&](std::uint32_t i) {
                        const Segment s = sight_.ground.segments[i];
                        const Vec2 a = s.a - c;
                        const Vec2 b = s.b - c;
                        return keeps({{dot(way.along, a), cross(way.along, a) + aside},
                                      {dot(way.along, b), cross(way.along, b) + aside}},
                                     way.length, least);
                      });
    if (free) ++counts_.free;
    return free;
  }

  /// Does the segment keep so much from the level one from 0 to (length, 0)?
  static bool keeps(const Segment& s, double length, double least) {
    const auto& [a, b] = s;
    if (std::min(a.y, b.y) >= least || std::max(a.y, b.y) <= -least) return true;
    if (std::max(a.x, b.x) <= -least || std::min(a.x, b.x) >= length + least) return true;
    const auto near = [&](Vec2 p) {
      const double x = p.x < 0.0 ? p.x : p.x > length ? p.x - length : 0.0;
      return x * x + p.y * p.y < least * least;
    };
    if (near(a) || near(b)) return false;
    if ((a.y < 0.0) != (b.y < 0.0)) {
      const double x = a.x + (b.x - a.x) * (a.y / (a.y - b.y));
      if (x >= 0.0 && x <= length) return false;
    }
    return !(distance_sq({}, s) < least * least) && !(distance_sq({length, 0.0}, s) < least * least);
  }

  /// Calls visit(number) for all tangents that leave a side or the start, which are drawn now.
  template <class Visit>
  void draw_from(SideId side, const Visit& visit) {
    for (const std::uint32_t c : sight_.candidates(side)) {
      const SideId first = c == sight_.ends() ? goal_ : 2 * c;
      for (SideId to = first; to <= (c == sight_.ends() ? goal_ : first + 1); ++to) {
        const std::optional<TangentWay> way = draw(side, to);
        if (!way) continue;
        ++counts_.candidates;
        ways_.push_back(*way);
        visit(static_cast<std::uint32_t>(ways_.size() - 1));
      }
    }
  }

  /// Draws the tangents that leave a side.
  void leave(SideId side) {
    CircleSide& here = sides_[side];
    if (here.left) return;
    here.left = true;
    constexpr std::size_t queued = 16;  // bytes of a way in the queue
    sight_.execution.reserve(2 * sight_.candidates(side).size() * (sizeof(TangentWay) + queued));
    draw_from(side, [&](std::uint32_t number) { here.ways.push_back(number); });
    std::ranges::sort(here.ways, {}, [&](std::uint32_t way) { return std::pair(ways_[way].out, ways_[way].to); });
  }

  void arrive(std::uint32_t number) {
    const SideId side = ways_[number].to;
    const double in = ways_[number].in;
    const double cost = ways_[number].cost;
    for (const std::uint32_t earlier : sides_[side].arrivals) {
      const double on = arc(side, ways_[earlier].in, in, 0.0);
      if (ways_[earlier].cost + room_.radius * on <= cost && on <= reach(side, ways_[earlier].in)) return;
    }
    ++counts_.arrivals;
    sides_[side].arrivals.push_back(number);
    leave(side);
    const double end = reach(side, in);
    for (const std::uint32_t next : sides_[side].ways) {
      const double on = arc(ways_[number], ways_[next]);
      if (on <= end) offer(next, cost + room_.radius * on + ways_[next].length, number);
    }
  }

  struct Queued {
    double key;
    std::uint32_t way;
  };
  /// Ties break by the sides, whatever the order in which ways were drawn: with a roadmap it is another.
  struct IsLater {
    const std::vector<TangentWay>* ways;
    bool operator()(const Queued& a, const Queued& b) const {
      if (a.key != b.key) return a.key > b.key;
      const TangentWay& v = (*ways)[a.way];
      const TangentWay& w = (*ways)[b.way];
      return v.from != w.from ? v.from > w.from : v.to > w.to;
    }
  };
  void offer(std::uint32_t number, double cost, std::uint32_t parent) {
    TangentWay& way = ways_[number];
    if (way.settled || !(cost < way.cost)) return;
    way.cost = cost;
    way.parent = parent;
    const double rest = norm(sight_.goal - centre(way.to) - spoke(way.to, way.along));
    queue_.push({cost + rest, number});
  }

  std::vector<TangentWay> chain_to(std::uint32_t number) const {
    std::vector<TangentWay> chain;
    for (; number != no_tangent; number = ways_[number].parent) chain.push_back(ways_[number]);
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

  /// The arc between two ways, cut where the polyline around it would bulge into what is near.
  void add_arc(const TangentWay& before, const TangentWay& after, std::vector<DiscPiece>& pieces) const {
    const DiscCircle& c = circle(before.to);
    const bool left = is_left(before.to);
    const double angle = arc(before, after);
    std::vector<double> cuts{0.0, angle};
    for_each_direction(c, bulge_ + (room_.radius - room_.least), [&](Vec2 n, double) {
      const double at = arc(before.to, before.in, travelled(before.to, angle_of(c, n)), 0.0);
      if (at < angle) cuts.push_back(at);
    });
    std::sort(cuts.begin(), cuts.end());
    const Vec2 first = spoke(before.to, before.along);
    const auto at = [&](double turn) { return c.centre + Rotation(left ? turn : -turn)(first); };
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      const Vec2 from = i == 1 ? place(before.to, before.along) : pieces.back().to;
      const Vec2 to = i + 1 == cuts.size() ? place(after.from, after.along) : at(cuts[i]);
      pieces.push_back({from, to, c.centre, left, cuts[i] - cuts[i - 1]});
    }
  }

  DiscSight& sight_;
  DiscPath& counts_;
  const DiscRoom room_;
  const double rounding_;  // of coordinates
  const double bulge_;     // of the polyline around an arc, and as much again
  std::vector<CircleSide> sides_;
  const SideId start_, goal_;
  std::vector<TangentWay> ways_;
  std::priority_queue<Queued, std::vector<Queued>, IsLater> queue_{IsLater{&ways_}};
  std::uint64_t settled_ = 0;
};

}  // namespace

std::uint64_t DiscPath::arcs() const {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].centre && (i == 0 || !(pieces[i - 1].centre == pieces[i].centre))) ++count;
  }
  return count;
}

DiscPath shortest_disc_path(const DiscGround& ground, Vec2 start, Vec2 goal, double radius, const Execution& execution,
                            const Graph* known) {
  Box world = ground.box;  // roundings are parts of its size, and of its largest coordinate
  world.include(start);
  world.include(goal);
  const double doubt = 1e-12 * radius + 64.0 * unit_rounding * (world.width() + world.height());  // is rounding
  // By which circles are larger, and more than coordinates are rounded by.
  const double room = doubt + 8.0 * unit_rounding * std::max({-world.min.x, world.max.x, -world.min.y, world.max.y});
  DiscPath path;
  path.radius = radius + room;
  path.circles = ground.circles.size();
  DiscSight sight(ground, known, start, goal, radius + room, execution);
  DiscSearch loose(sight, {radius, radius - 0.5 * doubt, true}, room, path);
  DiscSearch tight(sight, {radius + room, radius + 0.5 * room, false}, room, path);
  const auto ended = [&](Outcome outcome) {
    path.outcome = outcome;
    return std::move(path);
  };
  const auto blocked = [&](Outcome outcome) {
    path.lower_bound = std::numeric_limits<double>::infinity();
    return ended(outcome);
  };
  if (!loose.stands(start)) return blocked(Outcome::start_blocked);
  if (!loose.stands(goal)) return blocked(Outcome::goal_blocked);
  std::vector<TangentWay> found;
  if (start == goal) {
    path.pieces.push_back({start, goal, std::nullopt, false, 0.0});
  } else {
    found = loose.search();
    if (found.empty()) return blocked(Outcome::infeasible);
    const double roundings = 32.0 * static_cast<double>(found.size() + 1);
    const double length = loose.length_of(found);
    path.lower_bound = std::max(0.0, length - roundings * unit_rounding * (length + path.radius));
  }
  if (!tight.stands(start)) return ended(Outcome::start_blocked);
  if (!tight.stands(goal)) return ended(Outcome::goal_blocked);
  if (start == goal) return ended(Outcome::solved);
  std::vector<TangentWay> kept = tight.follow(found);
  if (kept.empty()) kept = tight.search();
  if (kept.empty()) return ended(Outcome::not_connected);
  path.length = tight.length_of(kept);
  path.pieces = tight.pieces_of(kept);
  return ended(Outcome::solved);
}

Path<Vec2> polyline_of(const DiscPath& path, const Execution& execution) {
  Path<Vec2> line;
  line.push_back(path.pieces.front().from);
  for (const DiscPiece& piece : path.pieces) {
    execution.check();
    if (!piece.centre) continue;
    const double parts = std::max(1.0, std::ceil(piece.angle / turn_of_polyline_rad));
    const double half = 0.5 * piece.angle / parts;
    const double longer = path.radius / (norm(piece.from - *piece.centre) * portable::cos(half));
    const Vec2 first = longer * (piece.from - *piece.centre);
    for (double part = 0.0; part < parts; ++part) {
      const double turn = (2.0 * part + 1.0) * half;
      line.push_back(*piece.centre + Rotation(piece.anticlockwise ? turn : -turn)(first));
    }
  }
  line.push_back(path.pieces.back().to);
  return line;
}

}  // namespace warren
