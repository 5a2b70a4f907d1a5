// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/body_on_leg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The way of the reference point about the point that the body turns about.
Arc arc_of(const Leg& leg) {
  const Vec2 aside{-leg.way.y, leg.way.x};
  return {leg.a.position() + 0.5 * leg.way + (0.5 / portable::tan(0.5 * leg.turn)) * aside, leg.a.position(), leg.turn};
}

double distance_to(const std::vector<Vec2>& corners, const Segment& s) {
  if (outline_holds(corners, s.a, true)) return 0.0;  // exact signs, but the corners are rounded
  double least = infinity;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    least = std::min(least, exact::distance(exact::outline_side(corners, i), s));
  }
  return least;
}

/// Where the body does not turn, it sweeps the bodies at both ends and a parallelogram a side.
double distance_to_sweep(const std::vector<Vec2>& corners, Vec2 way, const Segment& s) {
  double least = distance_to(corners, s);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = exact::outline_side(corners, i);
    const std::vector<Vec2> swept{a, b, b + way, a + way};
    least = std::min(least, distance_to(swept, s));
  }
  return least;
}

/// The corners go along arcs, and in the body's eyes the side's ends do, the other way round: apart at the start, they
/// come nearest where one of these is.
double distance_to_arcs(const std::vector<Vec2>& corners, const Arc& way, const Segment& s) {
  double least = distance_to(corners, s);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [a, b] = exact::outline_side(corners, i);
    least = std::min(least, distance(Arc{way.center, b, way.turn}, s));
    for (const Vec2 end : {s.a, s.b}) least = std::min(least, distance(Arc{way.center, end, -way.turn}, {a, b}));
  }
  return least;
}

}  // namespace

BodyVerifier::BodyVerifier(const Scene& scene, std::span<const Vec2> outline, double clearance, double poses_off,
                           const Execution& execution, const ObstacleIndex* index)
    : index_(index),
      own_obstacles_(index == nullptr ? std::optional<Obstacles>(scene) : std::nullopt),
      obstacles_(index == nullptr ? *own_obstacles_ : index->obstacles()),
      surroundings_(scene, obstacles_, index, execution),
      outline_(outline),
      clearance_(clearance),
      poses_off_(poses_off),
      execution_(execution),
      confines_(scene.bounds),
      map_(scene.map ? &*scene.map : nullptr) {
  for (const Vec2 p : outline_) radius_ = std::max(radius_, portable::hypot(p.x, p.y));
  bend_ = 1e-15 * surroundings_.largest_coordinate();
  rounding_ = 2e-14 * (surroundings_.largest_coordinate() + 2.0 * radius_ + clearance) + 4.0 * bend_;
  finest_ = std::max(1e-9 * radius_, 0.1 * rounding_);  // so no leg is halved more than some 50 times
  close_ = 1e-3 * radius_;
}

/// Around the body and its reach on parts of the leg, which are about as long as the boxes are wide. Ends are in the
/// box of the obstacles, and a turn is half of one at most: so the leg is hardly longer than that box.
std::vector<Box> BodyVerifier::boxes_of(const Leg& leg) const {
  const double around = (radius_ + reach_) * (1.0 + 1e-9) + rounding_;
  constexpr double most_parts = 65536.0;
  const bool bends = leg.is_arc && leg.turn != 0.0;
  const Arc arc = bends ? arc_of(leg) : Arc{};
  const double radius = bends ? distance(arc.center, arc.from) : 0.0;
  const double length = bends ? radius * std::abs(leg.turn) : portable::hypot(leg.way.x, leg.way.y);
  const double parts = std::clamp(std::ceil(length / (4.0 * around)), 1.0, most_parts);
  const double bulge = radius * (1.0 - portable::cos(0.5 * leg.turn / parts)) * (1.0 + 1e-9);  // over a part's chord
  const double margin = around + bulge + leg.blur;
  const auto at = [&](double part) {
    return bends ? arc.at(leg.turn * part / parts) : leg.a.position() + (part / parts) * leg.way;
  };
  std::vector<Box> boxes;
  for (double part = 0.0; part < parts; ++part) {
    Box box;
    box.include(at(part));
    box.include(at(part + 1.0));
    boxes.push_back({box.min - Vec2{margin, margin}, box.max + Vec2{margin, margin}});
  }
  return boxes;
}

void BodyVerifier::look_around(std::span<const Leg> legs, std::span<const std::uint8_t> settled, double reach) {
  reach_ = reach;
  if (map_ != nullptr) return;  // is read where it is asked
  constexpr std::size_t many = 1024;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (settled[i] != 0) continue;
    const std::vector<Box> more = boxes_of(legs[i]);
    if (i % many == 0 || more.size() >= many) execution_.reserve((many + more.size()) * sizeof(Box));  // and polls
    boxes.insert(boxes.end(), more.begin(), more.end());
  }
  surroundings_.file(boxes, execution_);
}

bool BodyVerifier::looks_everywhere(std::span<const Se2> path) const {
  Box all = surroundings_.box();
  if (confines_) all.include(*confines_);
  for (const Se2& pose : path) all.include(pose.position());
  return reach_ >= all.width() + all.height();
}

std::vector<Vec2> BodyVerifier::corners_at(const Leg& leg, double t) const {
  const double theta = leg.a.theta + t * leg.turn;
  const auto [s, c] = portable::sin_and_cos(theta);
  std::vector<Vec2> corners;
  corners.reserve(outline_.size());
  for (const Vec2 p : outline_) {
    corners.push_back({leg.a.x + t * leg.way.x + (c * p.x - s * p.y), leg.a.y + t * leg.way.y + (s * p.x + c * p.y)});
  }
  return corners;
}

/// No halving: exact but for the rounding of corners.
LegReport BodyVerifier::check_straight(const Leg& leg, const Sides& sides, std::size_t number) const {
  const std::vector<Vec2> corners = corners_at(leg, 0.0);
  Box swept;
  for (const Vec2 p : corners) {
    swept.include(p);
    swept.include(p + leg.way);
  }
  LegReport report;
  execution_.check();
  for (const NearSide& side : sides) {
    if (std::sqrt(exact::gap_sq(swept, box_of(side.segment))) > report.met) continue;
    note(distance_to_sweep(corners, leg.way, side.segment), rounding_ + leg.blur, side, number, report);
  }
  return report;
}

void BodyVerifier::note(double distance, double rounding, const NearSide& side, std::size_t number,
                        LegReport& report) const {
  if (distance >= report.met) return;
  report.met = distance;
  report.least = distance - rounding;
  if (report.least > clearance_ || (clearance_ > 0.0 && report.least >= clearance_)) return;
  report.violation = Violation{number, distance, surroundings_.name(side.number)};
}

/// No halving: exact but for rounding.
LegReport BodyVerifier::check_arc(const Leg& leg, const Sides& sides, std::size_t number) const {
  const std::vector<Vec2> corners = corners_at({leg.a, {}, 0.0}, 0.0);
  const Arc way = arc_of(leg);
  const double rounding = rounding_ + leg.blur + 1e-15 * distance(way.center, way.from);
  LegReport report;
  for (const NearSide& side : sides) {
    execution_.check();
    if (distance(way, side.segment) - radius_ > report.met) continue;
    note(distance_to_arcs(corners, way, side.segment), rounding, side, number, report);
  }
  if (!report.violation && leaves_box(way)) {
    report.violation = Violation{number, 0.0, "box: the way leaves the box of the obstacles"};
  }
  return report;
}

/// Between its ends, which are looked at as poses.
bool BodyVerifier::leaves_box(const Arc& way) const {
  if (confines_ || map_ != nullptr) return false;
  const auto [low, high] = surroundings_.box().grown(2.0 * poses_off_);
  const Segment sides[] = {
      {low, {high.x, low.y}}, {{high.x, low.y}, high}, {high, {low.x, high.y}}, {{low.x, high.y}, low}};
  return std::any_of(std::begin(sides), std::end(sides), [&](const Segment& s) { return distance(way, s) == 0.0; });
}

std::vector<BodyVerifier::Near> BodyVerifier::nearest_at(const Leg& leg, double t, double way, const Sides& sides,
                                                         const std::vector<Near>& among) const {
  const std::vector<Vec2> corners = corners_at(leg, t);
  Box body;
  for (const Vec2 p : corners) body.include(p);
  double least = infinity;
  const double spread = 2.0 * (way + rounding_);
  std::vector<Near> near;
  for (const Near& n : among) {
    const Segment& s = sides[n.side].segment;
    if (std::sqrt(exact::gap_sq(body, box_of(s))) > least + spread) continue;
    const double distance = distance_to(corners, s);
    least = std::min(least, distance);
    near.push_back({n.side, distance});
  }
  std::erase_if(near, [&](const Near& n) { return n.distance > least + spread; });
  return near;
}

void BodyVerifier::check_piece(const Leg& leg, double middle, double half, const Sides& sides,
                               const std::vector<Near>& among, std::size_t number, LegReport& report) const {
  constexpr std::size_t most_looks = 2'000'000;  // some seconds
  constexpr std::size_t enough_looks = 200'000;  // for the least distance; beyond, being apart is enough
  execution_.check();
  const bool weary = ++report.looks > most_looks;
  const double whole = portable::hypot(leg.way.x, leg.way.y) + radius_ * std::abs(leg.turn);
  const double way = half * whole * (1.0 + 1e-12);
  const std::vector<Near> near = nearest_at(leg, middle, way, sides, among);
  if (near.empty() || report.violation) return;
  const auto less = [](const Near& a, const Near& b) { return a.distance < b.distance; };
  const Near nearest = *std::min_element(near.begin(), near.end(), less);
  const double proved = nearest.distance - way - rounding_;
  report.met = std::min(report.met, nearest.distance);
  const bool settled = proved >= report.met - close_ || way < finest_ || report.looks > enough_looks;
  if (proved > clearance_ && settled) {
    report.least = std::min(report.least, proved);
    return;
  }
  if (nearest.distance <= rounding_ || nearest.distance + rounding_ < clearance_ || way < finest_ || weary) {
    report.least = std::min(report.least, nearest.distance);
    report.violation = Violation{number, nearest.distance, surroundings_.name(sides[nearest.side].number)};
    return;
  }
  check_piece(leg, middle - 0.5 * half, 0.5 * half, sides, near, number, report);
  check_piece(leg, middle + 0.5 * half, 0.5 * half, sides, near, number, report);
}

LegReport BodyVerifier::check_turning(const Leg& leg, const Sides& sides, std::size_t number) const {
  std::vector<Near> all;
  all.reserve(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) all.push_back({i, 0.0});
  LegReport report;
  check_piece(leg, 0.5, 0.5, sides, all, number, report);
  return report;
}

LegReport BodyVerifier::check_pose(const Se2& pose, std::size_t number) const {
  const std::vector<Vec2> corners = corners_at({pose, {}, 0.0}, 0.0);
  const auto bad = [&](std::string what) {
    return LegReport{.least = 0.0, .met = 0.0, .violation = Violation{number, 0.0, std::move(what)}};
  };
  if (confines_) {
    for (const Vec2 p : corners) {
      if (!confines_->contains(p)) return bad(fmt::format("bounds: the corner {} {} is outside", p.x, p.y));
    }
  } else if (map_ != nullptr) {
    const std::optional<Cell> cell = cell_at(*map_, corners.front());
    if (!cell) return bad("map: the body is outside");
    if (map_->blocked.test(cell->x, cell->y)) return bad(fmt::format("cell {}, {}", cell->x, cell->y));
  } else if (!surroundings_.box().grown(poses_off_).contains({pose.x, pose.y})) {
    return bad(fmt::format("box: {} {} is outside the box of the obstacles", pose.x, pose.y));
  }
  if (const auto ring = ring_around(obstacles_, index_, corners.front(), execution_)) {
    return bad(fmt::format("polygon {}: holds {} {}", obstacles_.rings()[*ring].polygon, corners.front().x,
                           corners.front().y));
  }
  return {};
}

}  // namespace warren
