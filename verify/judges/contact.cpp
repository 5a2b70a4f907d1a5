// SPDX-License-Identifier: BSD-3-Clause
// May a path that touches obstacles be moved off them by an arbitrarily small amount? That is what "contact allowed"
// means: running along a wall, touching its end and sliding along a polygon are free; changing the side of a wall,
// passing a corner where walls meet, or an inside, is not.
//
// The path is walked from contact point to contact point. Around each the obstacles' directions cut the plane into
// sectors, in exact order; the path may come in by one and must leave in the same one. A stretch that runs along a wall
// lies on its left or its right side: both possibilities are carried on until a contact point rules them out.
#include <cmath>

#include "core/base/whole.hpp"
#include "verify/judges/leg_reports.hpp"

namespace warren {
namespace {

/// Sides of a stretch on which the path may lie. Where it doesn't run along an obstacle they are the same side.
constexpr unsigned left_side = 1;
constexpr unsigned right_side = 2;
constexpr unsigned both_sides = left_side | right_side;

/// Order of directions from `at`, anticlockwise from +x; directions are given by a point that lies in them.
class DirectionOrder {
 public:
  explicit DirectionOrder(Vec2 at) : at_(at) {}
  bool operator()(Vec2 p, Vec2 q) const {
    const bool p_low = is_low(p);
    const bool q_low = is_low(q);
    return p_low != q_low ? q_low : exact::side_of(at_, p, q) > 0;
  }
  bool same(Vec2 p, Vec2 q) const { return is_low(p) == is_low(q) && exact::side_of(at_, p, q) == 0; }

 private:
  bool is_low(Vec2 p) const { return p.y < at_.y || (p.y == at_.y && p.x < at_.x); }
  Vec2 at_;
};

/// What surrounds one contact point: directions taken by obstacles, and the sectors between them.
class Surroundings {
 public:
  explicit Surroundings(Vec2 at) : at_(at) {}

  void add(const Obstacles& obstacles, std::size_t number) {
    const Segment s = obstacles.segment(number);
    if (number >= obstacles.wall_count())
      return add_side(obstacles, obstacles.sides()[number - obstacles.wall_count()]);
    if (!(s.a == at_)) directions_.push_back(s.a);
    if (!(s.b == at_)) directions_.push_back(s.b);
  }

  /// Where a wall lies on the box that confines the path, nobody gets between the two: all that lies beyond is blocked,
  /// at the wall's ends beside the wall.
  void close_beyond(const Segment& wall, const Box& box) {
    const BoxSide side = side_under(wall, box);
    if (side == BoxSide::none) return;
    const double reach = std::max({box.width(), box.height(), std::abs(at_.x), std::abs(at_.y)});
    const bool level = side == BoxSide::bottom || side == BoxSide::top;
    const Vec2 along = level ? Vec2{reach, 0.0} : Vec2{0.0, reach};
    const bool beyond_is_left = side == BoxSide::top || side == BoxSide::left;  // of `along`
    const Vec2 first = beyond_is_left ? at_ + along : at_ - along;
    const Vec2 last = beyond_is_left ? at_ - along : at_ + along;
    const Vec2 outwards = beyond_is_left ? at_ + Vec2{-along.y, along.x} : at_ + Vec2{along.y, -along.x};
    const auto place = [&](Vec2 p) { return level ? p.x : p.y; };
    const bool goes_on = std::max(place(wall.a), place(wall.b)) > place(at_);
    const bool came = std::min(place(wall.a), place(wall.b)) < place(at_);
    if (beyond_is_left ? goes_on : came) block(first, outwards);
    if (beyond_is_left ? came : goes_on) block(outwards, last);
  }

  /// The sides of the stretch at_ -> `to` that are not blocked: those that can be reached from `sides` of the stretch
  /// `from` -> at_, where there is one.
  unsigned passable(const std::optional<Vec2>& from, unsigned sides, Vec2 to) {
    sort();
    unsigned result = 0;
    for (const unsigned out : {left_side, right_side}) {
      const std::size_t target = sector(to, out == left_side);
      if (blocked(target)) continue;
      // Looking back along the stretch that came in, its left side is clockwise of it.
      const auto leads_on = [&](unsigned in) { return (sides & in) != 0 && sector(*from, in == right_side) == target; };
      if (!from || leads_on(left_side) || leads_on(right_side)) result |= out;
    }
    return result;
  }

 private:
  /// Blocked anticlockwise from direction `first` to direction `last`.
  struct Blocked {
    Vec2 first, last;
  };

  void block(Vec2 first, Vec2 last) {
    blocked_.push_back({first, last});
    directions_.push_back(first);
    directions_.push_back(last);
  }

  void add_side(const Obstacles& obstacles, const Obstacles::Side& side) {
    const std::vector<Vec2>& corners = obstacles.rings()[side.ring].corners;
    const std::size_t n = corners.size();
    const Vec2 a = corners[side.side];
    add_side(corners[(side.side + n - 1) % n], a, corners[(side.side + 1) % n]);
    const Vec2 b = corners[(side.side + 1) % n];
    if (at_ == b && !(a == b)) add_side(a, b, corners[(side.side + 2) % n]);
  }

  /// The side here -> next of a ring, and the one that ends in it.
  void add_side(Vec2 last, Vec2 here, Vec2 next) {
    if (at_ == here) {
      if (!(here == next)) block(next, last);  // else a ring of one point
    } else if (!(at_ == next) && exact::contains({here, next}, at_)) {
      block(next, here);
    }
  }

  void sort() {
    const DirectionOrder order(at_);
    std::sort(directions_.begin(), directions_.end(), order);
    const auto same = [&](Vec2 p, Vec2 q) { return order.same(p, q); };
    directions_.erase(std::unique(directions_.begin(), directions_.end(), same), directions_.end());
  }

  /// The number of the sector around direction p: sector i lies anticlockwise of directions_[i]. On a direction, the
  /// sector anticlockwise or clockwise of it.
  std::size_t sector(Vec2 p, bool anticlockwise) const {
    const std::size_t n = directions_.size();
    if (n < 2) return 0;
    const DirectionOrder order(at_);
    const auto after = std::upper_bound(directions_.begin(), directions_.end(), p, order);
    const std::size_t i = as_whole<std::size_t>(after - directions_.begin()) + n - 1;
    const bool on_direction = order.same(directions_[i % n], p);
    return (on_direction && !anticlockwise ? i + n - 1 : i) % n;
  }

  bool blocked(std::size_t number) const {
    const std::size_t n = directions_.size();
    return std::any_of(blocked_.begin(), blocked_.end(), [&](const Blocked& b) {
      const std::size_t first = sector(b.first, true);
      const std::size_t end = sector(b.last, true);
      return (number + n - first) % n < (end + n - first) % n;
    });
  }

  Vec2 at_;
  std::vector<Vec2> directions_;
  std::vector<Blocked> blocked_;
};

/// The contacts of one leg in its order: each holds on an interval of the leg, mostly a single point.
class LegContacts {
 public:
  LegContacts(Segment leg, const Obstacles& obstacles, std::span<const LegContact> contacts) : leg_(leg) {
    const Vec2 run = leg.b - leg.a;
    along_x_ = std::abs(run.x) >= std::abs(run.y);
    forward_ = along_x_ ? leg.b.x > leg.a.x : leg.b.y > leg.a.y;
    for (const LegContact& c : contacts) add(obstacles.segment(c.obstacle), c.obstacle);
    std::ranges::sort(events_, {}, &Event::place);
    const auto same = [](const Event& e, const Event& f) { return e.place == f.place; };
    events_.erase(std::unique(events_.begin(), events_.end(), same), events_.end());
    std::ranges::sort(intervals_, {}, &Interval::first);
  }

  std::size_t event_count() const { return events_.size(); }
  Vec2 point(std::size_t event) const { return events_[event].point; }
  /// Obstacles that contain the event's point, lowest first. Ask for events in order.
  const std::vector<std::size_t>& obstacles_at(std::size_t event) {
    const double place = events_[event].place;
    std::erase_if(open_, [&](const Interval& i) { return i.last < place; });
    for (; next_ < intervals_.size() && intervals_[next_].first <= place; ++next_) {
      if (intervals_[next_].last >= place) open_.push_back(intervals_[next_]);
    }
    here_.clear();
    for (const Interval& i : open_) here_.push_back(i.obstacle);
    std::sort(here_.begin(), here_.end());
    return here_;
  }

 private:
  struct Event {
    double place;
    Vec2 point;
  };
  struct Interval {
    double first, last;
    std::size_t obstacle;
  };

  /// Grows along the leg; on the leg's line different points have different places.
  double place(Vec2 p) const {
    const double c = along_x_ ? p.x : p.y;
    return forward_ ? c : -c;
  }

  void add(const Segment& wall, std::size_t obstacle) {
    std::vector<Vec2> shared;
    for (const Vec2 p : {wall.a, wall.b}) {
      if (exact::contains(leg_, p)) shared.push_back(p);
    }
    for (const Vec2 p : {leg_.a, leg_.b}) {
      if (exact::contains(wall, p)) shared.push_back(p);
    }
    if (shared.empty()) return;  // a crossing inside both: somebody else's matter
    Interval interval{place(shared.front()), place(shared.front()), obstacle};
    for (const Vec2 p : shared) {
      events_.push_back({place(p), p});
      interval.first = std::min(interval.first, place(p));
      interval.last = std::max(interval.last, place(p));
    }
    intervals_.push_back(interval);
  }

  Segment leg_;
  bool along_x_;
  bool forward_;
  std::vector<Event> events_;
  std::vector<Interval> intervals_;
  std::vector<Interval> open_;
  std::vector<std::size_t> here_;
  std::size_t next_ = 0;
};

/// Carries the sides from leg to leg.
class Walk {
 public:
  Walk(const Box& frame, const Obstacles& obstacles, Vec2 start) : frame_(frame), obstacles_(obstacles), at_(start) {}

  /// Walks the leg up to its end. The obstacle where that fails, if it does.
  std::optional<std::size_t> leg(Vec2 end, std::span<const LegContact> contacts) {
    LegContacts here({at_, end}, obstacles_, contacts);
    const Vec2 begin = at_;
    std::size_t event = 0;
    if (here.event_count() > 0 && here.point(0) == begin) {
      touching_ = here.obstacles_at(0);
      event = 1;
    }
    // What touches the leg's end is asked about once the next leg tells where the path goes on.
    for (;; ++event) {
      const Vec2 to = event < here.event_count() ? here.point(event) : end;
      if (const auto obstacle = go_on(to)) return obstacle;
      touching_.clear();
      if (event < here.event_count()) touching_ = here.obstacles_at(event);
      if (to == end) return std::nullopt;
    }
  }

 private:
  std::optional<std::size_t> go_on(Vec2 to) {
    if (touching_.empty()) {
      sides_ = both_sides;
    } else {
      Surroundings around(at_);
      for (const std::size_t obstacle : touching_) {
        around.add(obstacles_, obstacle);
        if (obstacle < obstacles_.wall_count()) around.close_beyond(obstacles_.segment(obstacle), frame_);
      }
      sides_ = around.passable(from_, sides_, to);
      if (sides_ == 0) return touching_.front();
    }
    from_ = at_;
    at_ = to;
    return std::nullopt;
  }

  const Box& frame_;
  const Obstacles& obstacles_;
  Vec2 at_;
  std::optional<Vec2> from_;  // where the stretch that led to at_ began, if there is one
  unsigned sides_ = both_sides;
  std::vector<std::size_t> touching_;  // obstacles at at_
};

}  // namespace

std::optional<LegContact> first_forbidden_contact(std::span<const Vec2> path, std::size_t leg_end, const Box& frame,
                                                  const Obstacles& obstacles, std::span<const LegContact> contacts,
                                                  const Execution& execution) {
  Walk walk(frame, obstacles, path.front());
  auto next = contacts.begin();
  for (std::size_t leg = 0; leg < leg_end; ++leg) {
    if (leg % 1024 == 0) execution.check();
    const auto first = next;
    while (next != contacts.end() && next->leg == leg) ++next;
    if (path[leg] == path[leg + 1]) continue;
    if (const auto obstacle = walk.leg(path[leg + 1], {first, next})) return LegContact{leg, *obstacle};
  }
  return std::nullopt;
}

}  // namespace warren
