// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/plane_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace warren::test {
namespace {

constexpr double step = 1e-3;      // of any point of the body
constexpr double rounding = 1e-7;  // of clearances and of what a car drives: answers are decimal numbers

struct Pose {
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;
};

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

std::string shown(const Pose& pose) {
  std::ostringstream text;
  text.precision(17);
  text << " at " << pose.x << ", " << pose.y << ", " << pose.theta;
  return text.str();
}

struct Extent {
  double left = std::numeric_limits<double>::infinity();
  double low = std::numeric_limits<double>::infinity();
  double right = -std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(PlanePoint p) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  bool is_beyond(const Extent& other, double room) const {
    return left > other.right + room || right < other.left - room || low > other.high + room || high < other.low - room;
  }
};

Extent extent_of(const Ring& ring) {
  Extent extent;
  for (const PlanePoint p : ring) extent.include(p);
  return extent;
}

/// Where a body goes on one leg.
class Leg {
 public:
  Leg(const Pose& a, const Pose& b, bool drives)
      : a_(a), turn_(wrapped(b.theta - a.theta)), dx_(b.x - a.x), dy_(b.y - a.y) {
    const double chord = std::hypot(dx_, dy_);
    arc_ = drives && std::abs(turn_) > 1e-9;
    if (arc_) radius_ = chord / (2.0 * std::abs(std::sin(0.5 * turn_)));
    length_ = arc_ ? radius_ * std::abs(turn_) : chord;
    const double middle = a.theta + 0.5 * turn_;
    ahead_ = dx_ * std::cos(middle) + dy_ * std::sin(middle) >= 0.0;
    aside_ = std::abs(dy_ * std::cos(middle) - dx_ * std::sin(middle));
  }

  double length() const { return length_; }
  double turn() const { return turn_; }
  bool ahead() const { return ahead_; }
  /// How far a car would have to slip: 0 for a straight and an arc.
  double aside() const { return aside_; }
  bool is_arc() const { return arc_; }

  Pose at(double t) const {
    const double theta = a_.theta + t * turn_;
    if (!arc_) return {a_.x + t * dx_, a_.y + t * dy_, theta};
    // The centre lies to the left where heading and direction turn alike.
    const double r = (ahead_ ? 1.0 : -1.0) * (turn_ > 0.0 ? radius_ : -radius_);
    return {a_.x + r * (std::sin(theta) - std::sin(a_.theta)), a_.y - r * (std::cos(theta) - std::cos(a_.theta)),
            theta};
  }

 private:
  Pose a_;
  double turn_;
  double dx_;
  double dy_;
  bool arc_ = false;
  bool ahead_ = true;
  double radius_ = 0.0;
  double length_ = 0.0;
  double aside_ = 0.0;
};

/// Which sides of which walls a point was on last, so that a wall that is touched can't be passed.
class WallsTouched {
 public:
  explicit WallsTouched(const std::vector<PlaneLine>& walls) : walls_(walls), side_(walls.size(), 0) {}

  /// Does the point come to the other side of a wall beside which it has stayed?
  bool passes(PlanePoint p) {
    bool passed = false;
    for (std::size_t i = 0; i < walls_.size(); ++i) passed = step_past(walls_[i], p, side_[i]) || passed;
    return passed;
  }

 private:
  static bool step_past(const PlaneLine& wall, PlanePoint p, int& last) {
    const double dx = wall.b.x - wall.a.x;
    const double dy = wall.b.y - wall.a.y;
    const double length = std::hypot(dx, dy);
    const double along = ((p.x - wall.a.x) * dx + (p.y - wall.a.y) * dy) / length;
    if (!(along > touch && along < length - touch)) {
      last = 0;
      return false;
    }
    const double beside = (dx * (p.y - wall.a.y) - dy * (p.x - wall.a.x)) / length;
    const int side = beside > touch ? 1 : beside < -touch ? -1 : 0;
    const bool passed = side * last < 0;
    if (side != 0) last = side;
    return passed;
  }

  const std::vector<PlaneLine>& walls_;
  std::vector<int> side_;
};

class PathCheck {
 public:
  PathCheck(const PlaneObstacles& obstacles, const PlaneBody& body, const PlaneQuestion& question)
      : obstacles_(obstacles), body_(body), question_(question), touched_(obstacles.walls) {
    for (const PlaneLine& wall : obstacles.walls) {
      wall_extents_.push_back(extent_of({wall.a, wall.b}));
      whole_.include(wall.a);
      whole_.include(wall.b);
    }
    for (const Region& region : obstacles.regions) {
      region_extents_.push_back(extent_of(region.front()));
      for (const PlanePoint p : region.front()) whole_.include(p);
    }
    if (!body.outline.empty()) inside_ = point_inside(body.outline);
    for (const PlanePoint p : body.outline) reach_ = std::max(reach_, std::hypot(p.x, p.y));
  }

  std::optional<std::string> check(const Leg& leg) {
    if (body_.drives) {
      if (auto wrong = wrong_with_driving(leg)) return wrong;
    }
    const double way = leg.length() + reach_ * std::abs(leg.turn());
    const auto pieces = static_cast<int>(std::ceil(way / step)) + 1;
    for (int i = 0; i <= pieces; ++i) {
      const Pose pose = leg.at(static_cast<double>(i) / pieces);
      if (auto wrong = body_.outline.empty() ? wrong_with_disc(pose) : wrong_with_polygon(pose))
        return *wrong + shown(pose);
    }
    return std::nullopt;
  }

 private:
  std::optional<std::string> wrong_with_driving(const Leg& leg) const;
  std::optional<std::string> wrong_with_disc(const Pose& pose);
  std::optional<std::string> wrong_with_polygon(const Pose& pose) const;
  bool is_in_place(PlanePoint reference) const;
  bool leaves_rim(PlanePoint p, double room) const;
  bool meets(const Ring& body, const Extent& extent, PlanePoint inside, const Region& region) const;

  const PlaneObstacles& obstacles_;
  const PlaneBody& body_;
  const PlaneQuestion& question_;
  WallsTouched touched_;
  std::vector<Extent> wall_extents_;
  std::vector<Extent> region_extents_;
  Extent whole_;
  PlanePoint inside_;
  double reach_ = 0.0;
};

std::optional<std::string> PathCheck::wrong_with_driving(const Leg& leg) const {
  if (leg.aside() > rounding) return "a leg is neither a straight nor an arc";
  if (body_.turns_on_spot) return std::nullopt;
  if (!leg.is_arc() && std::abs(leg.turn()) > rounding) return "a car turns on the spot";
  const double least = body_.turning_radius * std::abs(leg.turn());
  if (leg.is_arc() && leg.length() < least - rounding) return "an arc is too tight";
  if (!body_.reverses && !leg.ahead() && leg.length() > rounding) return "a car that can't drives backwards";
  return std::nullopt;
}

/// Without bounds the obstacles' box confines the reference point.
bool PathCheck::is_in_place(PlanePoint reference) const {
  if (!obstacles_.rim.empty()) return true;
  return reference.x >= whole_.left - touch && reference.x <= whole_.right + touch &&
         reference.y >= whole_.low - touch && reference.y <= whole_.high + touch;
}

bool PathCheck::leaves_rim(PlanePoint p, double room) const {
  const Ring& rim = obstacles_.rim;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const PlanePoint a = rim[i];
    const PlanePoint b = rim[(i + 1) % rim.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double inwards = ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
    if (inwards < room - rounding) return true;
  }
  return false;
}

std::optional<std::string> PathCheck::wrong_with_disc(const Pose& pose) {
  const PlanePoint p{pose.x, pose.y};
  const double room = body_.radius + question_.clearance;
  if (!is_in_place(p)) return "the reference point leaves the obstacles' box";
  if (leaves_rim(p, room)) return "the body leaves the bounds";
  if (room == 0.0 && touched_.passes(p)) return "a wall is passed";
  const auto is_near = [&](double distance) {
    if (room > 0.0) return distance < room - rounding;
    return !question_.may_touch && !obstacles_.rounded && distance <= 0.0;
  };
  for (const PlaneLine& wall : obstacles_.walls) {
    if (is_near(distance_of(p, wall))) return "a wall is too near";
  }
  for (std::size_t i = 0; i < obstacles_.regions.size(); ++i) {
    Extent at;
    at.include(p);
    if (at.is_beyond(region_extents_[i], room)) continue;
    const double distance = distance_from_sides(obstacles_.regions[i], p);
    if (is_near(distance)) return "a polygon or cell is too near";
    if (distance > touch && holds(obstacles_.regions[i], p)) return "the point is inside of a polygon or cell";
  }
  return std::nullopt;
}

bool PathCheck::meets(const Ring& body, const Extent& extent, PlanePoint inside, const Region& region) const {
  const std::vector<PlaneLine> sides = sides_of(body);
  const double room = question_.clearance;
  for (const Ring& ring : region) {
    for (const PlaneLine& line : sides_of(ring)) {
      if (extent.is_beyond(extent_of({line.a, line.b}), room)) continue;
      for (const PlaneLine& side : sides) {
        if (crosses(side, line) || (room > 0.0 && distance_of(side, line) < room - rounding)) return true;
      }
      if (holds(body, line.a) && distance_from_sides({body}, line.a) > touch) return true;
    }
  }
  for (const PlanePoint p : body) {
    if (holds(region, p) && distance_from_sides(region, p) > touch) return true;
  }
  return holds(region, inside) && distance_from_sides(region, inside) > touch;
}

std::optional<std::string> PathCheck::wrong_with_polygon(const Pose& pose) const {
  const double c = std::cos(pose.theta);
  const double s = std::sin(pose.theta);
  const auto placed = [&](PlanePoint p) { return PlanePoint{pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y}; };
  Ring body;
  for (const PlanePoint p : body_.outline) body.push_back(placed(p));
  const double room = question_.clearance;
  if (!is_in_place({pose.x, pose.y})) return "the reference point leaves the obstacles' box";
  for (const PlanePoint p : body) {
    if (leaves_rim(p, room)) return "the body leaves the bounds";
  }
  const Extent extent = extent_of(body);
  for (std::size_t i = 0; i < obstacles_.walls.size(); ++i) {
    if (extent.is_beyond(wall_extents_[i], room)) continue;
    const PlaneLine& wall = obstacles_.walls[i];
    for (const PlaneLine& side : sides_of(body)) {
      if (crosses(side, wall)) return "a wall crosses the body";
      if (room > 0.0 && distance_of(side, wall) < room - rounding) return "a wall is too near";
    }
    for (const PlanePoint end : {wall.a, wall.b}) {
      if (holds(body, end) && distance_from_sides({body}, end) > touch) return "a wall ends in the body";
    }
  }
  for (std::size_t i = 0; i < obstacles_.regions.size(); ++i) {
    if (extent.is_beyond(region_extents_[i], room)) continue;
    if (meets(body, extent, placed(inside_), obstacles_.regions[i])) return "the body meets a polygon or cell";
  }
  return std::nullopt;
}

bool is_there(const Pose& pose, const std::array<double, 3>& wanted, bool turns) {
  const bool place = std::abs(pose.x - wanted[0]) <= touch && std::abs(pose.y - wanted[1]) <= touch;
  return place && (!turns || std::abs(wrapped(pose.theta - wanted[2])) <= rounding);
}

}  // namespace

std::optional<std::string> wrong_with_path(const PlaneObstacles& obstacles, const PlaneBody& body,
                                           const PlaneQuestion& question,
                                           const std::vector<std::vector<double>>& path) {
  std::vector<Pose> poses;
  const bool turns = body.drives || !body.outline.empty();
  for (const std::vector<double>& state : path) {
    if (state.size() != (turns ? 3U : 2U)) return "a state has " + std::to_string(state.size()) + " numbers";
    poses.push_back({state[0], state[1], turns ? state[2] : 0.0});
  }
  if (poses.empty()) return "the path is empty";
  if (!is_there(poses.front(), question.start, turns)) return "the path begins elsewhere" + shown(poses.front());
  if (!is_there(poses.back(), question.goal, turns)) return "the path ends elsewhere" + shown(poses.back());
  PathCheck check(obstacles, body, question);
  for (std::size_t i = 0; i + 1 < std::max<std::size_t>(poses.size(), 2); ++i) {
    const Leg leg(poses[i], poses[std::min(i + 1, poses.size() - 1)], body.drives);
    if (auto wrong = check.check(leg)) return "leg " + std::to_string(i) + ": " + *wrong;
  }
  return std::nullopt;
}

}  // namespace warren::test
