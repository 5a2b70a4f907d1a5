// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/rotational_sweep.hpp"

#include <utility>

#include "parallel/sort.hpp"

namespace warren {
namespace {

/// A piece that leaves the point, and how many more polygons lie anticlockwise of it than clockwise.
struct Spoke {
  Vec2 towards;
  int rise;
  PointId end;
};

void add_spokes(const PlanePieces& pieces, std::uint32_t piece, Vec2 at, std::vector<Spoke>& spokes) {
  const Segment s = pieces.segment(piece);
  if (!on_segment(at, s)) return;
  const Piece& p = pieces.pieces()[piece];
  if (!(s.a == at)) spokes.push_back({s.a, -p.rise, p.a});
  if (!(s.b == at)) spokes.push_back({s.b, p.rise, p.b});
}

/// Sorts the spokes, at least one, and calls visit(spoke, next spoke) for the free sectors between them.
template <class Visit>
void visit_free(const PlanePieces& pieces, Vec2 at, std::vector<Spoke>& spokes, const Execution& execution,
                const Visit& visit) {
  const DirectionOrder before(at);
  polled_sort(spokes.begin(), spokes.end(), execution,
              [&](const Spoke& s, const Spoke& t) { return before(s.towards, t.towards); });
  // The depth was taken just anticlockwise of +x: past the first spoke if that is +x, else before all.
  int depth = pieces.depth_beside(at);
  if (spokes[0].towards.y == at.y && spokes[0].towards.x > at.x) depth -= spokes[0].rise;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    depth += spokes[i].rise;
    if (depth == 0) visit(spokes[i], spokes[(i + 1) % spokes.size()]);
  }
}

constexpr double place_doubt = 1e-12;  // places that differ by more are in the directions' order for certain
constexpr std::size_t near_per_poll = 1 << 14;

}  // namespace

Lanes lanes_in_sector(Vec2 at, const Sector& sector, Vec2 q) {
  if (sector.whole || sector.first == sector.last) return both_lanes;
  const DirectionOrder order(at);
  const int from_first = orient2d(at, sector.first, q);
  const int from_last = orient2d(at, sector.last, q);
  if (from_first == 0 && order.is_low(sector.first) == order.is_low(q)) return left_lane;
  if (from_last == 0 && order.is_low(sector.last) == order.is_low(q)) return right_lane;
  const int turn = orient2d(at, sector.first, sector.last);
  const bool inside = turn > 0   ? from_first > 0 && from_last < 0
                      : turn < 0 ? !(from_last > 0 && from_first < 0)
                                 : from_first > 0;
  return inside ? both_lanes : no_lane;
}

std::vector<Sector> free_sectors(const PlanePieces& pieces, Vec2 at) {
  std::vector<Spoke> spokes;
  if (pieces.grid().box().contains(at)) {
    for (const std::uint32_t piece : pieces.grid().in_cell(pieces.grid().cell_of(at))) {
      add_spokes(pieces, piece, at, spokes);
    }
  }
  std::vector<Sector> sectors;
  if (!spokes.empty()) {
    visit_free(pieces, at, spokes, {}, [&](const Spoke& s, const Spoke& t) {
      sectors.push_back({s.towards, t.towards, false});
    });
  } else if (pieces.depth_beside(at) == 0) {
    sectors.push_back({{}, {}, true});
  }
  return sectors;
}

std::vector<SectorOfPoints> free_sectors_at(const PlanePieces& pieces, PointId at, const Execution& execution) {
  const Vec2 p = pieces.points()[at];
  std::vector<Spoke> spokes;
  for (const std::uint32_t piece : pieces.pieces_at(at)) add_spokes(pieces, piece, p, spokes);
  std::vector<SectorOfPoints> sectors;
  visit_free(pieces, p, spokes, execution, [&](const Spoke& s, const Spoke& t) {
    sectors.push_back({s.end, t.end, is_reflex(p, {s.towards, t.towards, false})});
  });
  return sectors;
}

RotationalSweep::RotationalSweep(const PlanePieces& pieces, const Execution& execution)
    : pieces_(pieces), execution_(execution), event_of_(pieces.points().size(), 0) {}

bool RotationalSweep::nearer_on_ray(Vec2 p, Vec2 q) const {
  if (p.x != q.x) return (p.x < q.x) == (eye_.x < q.x);
  return p.y != q.y && (p.y < q.y) == (eye_.y < q.y);
}

bool RotationalSweep::same_ray(const Event& e, const Event& f) const {
  return std::abs(e.place - f.place) < place_doubt && DirectionOrder(eye_).same(e.at, f.at);
}

bool RotationalSweep::comes_before(const Event& e, const Event& f) const {
  const DirectionOrder before(eye_);
  if (!before.same(e.at, f.at)) return before(e.at, f.at);
  if (e.at == f.at) return e.id == target && f.id != target;
  return nearer_on_ray(e.at, f.at);
}

std::uint32_t RotationalSweep::event_of(PointId p) {
  const std::uint32_t known = event_of_[p];
  if (known < events_.size() && events_[known].id == p) return known;
  const auto number = static_cast<std::uint32_t>(events_.size());
  const Vec2 at = pieces_.points()[p];
  events_.push_back({at, direction_place(at - eye_), p, none, none, false});
  event_of_[p] = number;
  return number;
}

void RotationalSweep::add_radial_piece(PointId a, PointId b) {
  const Vec2 at_a = pieces_.points()[a];
  const Vec2 at_b = pieces_.points()[b];
  const bool from_eye = at_a == eye_ || at_b == eye_;
  const bool around_eye = !from_eye && !DirectionOrder(eye_).same(at_a, at_b);
  const bool a_is_nearer = at_a == eye_ || (!from_eye && nearer_on_ray(at_a, at_b));
  const auto add = [&](PointId p, Vec2 at, bool is_farther) {
    if (at == eye_ || !is_passed(at)) return;
    Event& event = events_[event_of(p)];
    event.comes_along_a_piece = event.comes_along_a_piece || is_farther;
  };
  add(a, at_a, around_eye || !a_is_nearer);
  add(b, at_b, around_eye || a_is_nearer);
}

void RotationalSweep::add_piece(PointId a, PointId b) {
  const int turn = orient2d(eye_, pieces_.points()[a], pieces_.points()[b]);
  if (turn == 0) return add_radial_piece(a, b);
  if (turn < 0) std::swap(a, b);
  const SeenPiece seen{pieces_.points()[a], pieces_.points()[b]};
  const bool starts = is_passed(seen.first);
  const bool ends = is_passed(seen.last);
  if (!starts && !ends) return;
  const auto number = static_cast<std::uint32_t>(seen_.size());
  seen_.push_back(seen);
  next_start_.push_back(starts ? std::exchange(events_[event_of(a)].starts, number) : none);
  next_end_.push_back(ends ? std::exchange(events_[event_of(b)].ends, number) : none);
  const DirectionOrder order(eye_);
  if (order.is_low(seen.first) && !order.is_low(seen.last)) crossed_at_first_.push_back(number);
}

void RotationalSweep::sort_events() {
  order_.resize(events_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = {events_[i].place, i};
  polled_sort(order_.begin(), order_.end(), execution_,
              [](const Turned& t, const Turned& u) { return t.place < u.place; });
  // Runs of places too close to tell are sorted exactly: two points mostly, thousands where corners are collinear.
  const auto before = [&](const Turned& t, const Turned& u) {
    return comes_before(events_[t.event], events_[u.event]);
  };
  for (auto first = order_.begin(), end = first; first != order_.end(); first = end) {
    for (++end; end != order_.end() && end->place - (end - 1)->place <= place_doubt;) ++end;
    if (end - first > 1) polled_sort(first, end, execution_, before);
  }
}

void RotationalSweep::prepare(Vec2 eye, std::span<const std::uint32_t> near, std::optional<Vec2> extra) {
  eye_ = eye;
  events_.clear();
  seen_.clear();
  next_start_.clear();
  next_end_.clear();
  crossed_at_first_.clear();
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (i % near_per_poll == 0) execution_.check();
    add_piece(pieces_.pieces()[near[i]].a, pieces_.pieces()[near[i]].b);
  }
  if (extra && !(*extra == eye)) events_.push_back({*extra, direction_place(*extra - eye), target, none, none, false});
  sort_events();
}

}  // namespace warren
