// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/arm_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace warren::test {
namespace {

constexpr double farthest = 1e-3;  // that a point goes between two looks
constexpr double small = 1e-7;     // roundings of decimal answers

/// Where a frame stands: columns are its axes.
struct Frame {
  SpacePoint x{1, 0, 0};
  SpacePoint y{0, 1, 0};
  SpacePoint z{0, 0, 1};
  SpacePoint origin{0, 0, 0};
};

SpacePoint mixed(double s, const SpacePoint& a, double t, const SpacePoint& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}
SpacePoint difference(const SpacePoint& a, const SpacePoint& b) { return mixed(1.0, a, -1.0, b); }
double dot(const SpacePoint& a, const SpacePoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm_of(const SpacePoint& a) { return std::sqrt(dot(a, a)); }

/// About its own z axis, then along it.
void turn_and_lift(Frame& frame, double angle, double d) {
  const SpacePoint x = mixed(std::cos(angle), frame.x, std::sin(angle), frame.y);
  frame.y = mixed(std::cos(angle), frame.y, -std::sin(angle), frame.x);
  frame.x = x;
  frame.origin = mixed(1.0, frame.origin, d, frame.z);
}

/// Along its own x axis, and about it.
void shift_and_twist(Frame& frame, double a, double alpha) {
  const SpacePoint y = mixed(std::cos(alpha), frame.y, std::sin(alpha), frame.z);
  frame.z = mixed(std::cos(alpha), frame.z, -std::sin(alpha), frame.y);
  frame.y = y;
  frame.origin = mixed(1.0, frame.origin, a, frame.x);
}

/// Base, the frames' origins, the tool.
std::vector<SpacePoint> origins_of(const ArmBody& arm, const std::vector<double>& q) {
  Frame frame;
  std::vector<SpacePoint> origins{frame.origin};
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const ArmJoint& joint = arm.joints[i];
    if (arm.modified) shift_and_twist(frame, joint.a, joint.alpha);
    turn_and_lift(frame, q[i] + joint.offset, joint.d);
    if (!arm.modified) shift_and_twist(frame, joint.a, joint.alpha);
    origins.push_back(frame.origin);
  }
  origins.push_back(mixed(1.0, frame.origin, arm.tool, frame.z));
  return origins;
}

double distance_from_box(const SpacePoint& p, const std::array<double, 6>& box) {
  SpacePoint gap{};
  for (std::size_t i = 0; i < 3; ++i) gap[i] = p[i] - std::clamp(p[i], box[i], box[i + 3]);
  return norm_of(gap);
}

/// Convex along the link, so thirds close in on the least.
double distance_from_box(const SpacePoint& a, const SpacePoint& b, const std::array<double, 6>& box, double enough) {
  const auto at = [&](double t) { return distance_from_box(mixed(1.0 - t, a, t, b), box); };
  const double middle = at(0.5);
  if (middle - 0.5 * norm_of(difference(b, a)) > enough) return middle;
  double low = 0.0;
  double high = 1.0;
  while (high - low > 1e-9) {
    const double third = (high - low) / 3.0;
    const double left = low + third;
    const double right = high - third;
    if (at(left) < at(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return at(0.5 * (low + high));
}

double distance_from_point(const SpacePoint& a, const SpacePoint& b, const SpacePoint& p) {
  const SpacePoint way = difference(b, a);
  const double square = dot(way, way);
  const double t = square > 0.0 ? std::clamp(dot(difference(p, a), way) / square, 0.0, 1.0) : 0.0;
  return norm_of(difference(mixed(1.0, a, t, way), p));
}

std::optional<std::string> wrong_with_posture(const SpaceObstacles& obstacles, const ArmBody& arm, double clearance,
                                              const std::vector<double>& q) {
  const std::vector<SpacePoint> at = origins_of(arm, q);
  const double room = arm.radius + clearance;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    if (q[i] < arm.joints[i].low - small || q[i] > arm.joints[i].high + small) return "a joint leaves its limits";
  }
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    if (norm_of(difference(at[i + 1], at[i])) < 1e-12) continue;
    for (const auto& [x, y, z, r] : obstacles.spheres) {
      if (distance_from_point(at[i], at[i + 1], {x, y, z}) < r + room - small) return "a link meets a sphere";
    }
    for (const auto& box : obstacles.boxes) {
      if (distance_from_box(at[i], at[i + 1], box, room) < room - small) return "a link meets a box";
    }
  }
  return std::nullopt;
}

/// Upper bound of the distance of any point of the arm from any axis.
double reach_of(const ArmBody& arm) {
  double reach = arm.tool + arm.radius;
  for (const ArmJoint& joint : arm.joints) reach += std::hypot(joint.a, joint.d);
  return reach;
}

bool is_there(const ArmBody& arm, const std::vector<double>& q, const std::vector<double>& wanted) {
  if (wanted.size() == 3) {
    return norm_of(difference(origins_of(arm, q).back(), {wanted[0], wanted[1], wanted[2]})) <= small;
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (std::abs(q[i] - wanted[i]) > small) return false;
  }
  return true;
}

}  // namespace

ArmBody puma560_arm(double radius, double tool) {
  constexpr double degree = std::numbers::pi / 180.0;
  constexpr double right = 90.0 * degree;
  ArmBody arm{.joints = {{0, 0, right, -160, 160},
                         {0, 0.4318, 0, -45, 225},
                         {0.15005, 0.0203, -right, -225, 45},
                         {0.4318, 0, right, -110, 170},
                         {0, 0, -right, -100, 100},
                         {0, 0, 0, -266, 266}},
              .tool = tool,
              .radius = radius};
  for (ArmJoint& joint : arm.joints) {
    joint.low *= degree;
    joint.high *= degree;
  }
  return arm;
}

std::optional<std::string> wrong_with_path(const SpaceObstacles& obstacles, const ArmBody& arm,
                                           const ArmQuestion& question, const std::vector<std::vector<double>>& path) {
  for (const std::vector<double>& q : path) {
    if (q.size() != 6) return "a state has " + std::to_string(q.size()) + " numbers";
  }
  if (path.empty()) return "the path is empty";
  if (!is_there(arm, path.front(), question.start)) return "the path begins elsewhere";
  if (!is_there(arm, path.back(), question.goal)) return "the path ends elsewhere";
  const double reach = reach_of(arm);
  for (std::size_t leg = 0; leg + 1 < std::max<std::size_t>(path.size(), 2); ++leg) {
    const std::vector<double>& from = path[leg];
    const std::vector<double>& to = path[std::min(leg + 1, path.size() - 1)];
    double way = 0.0;
    for (std::size_t i = 0; i < 6; ++i) way += std::abs(to[i] - from[i]) * reach;
    const auto pieces = static_cast<int>(std::ceil(way / farthest)) + 1;
    for (int k = 0; k <= pieces; ++k) {
      std::vector<double> q(6);
      for (std::size_t i = 0; i < 6; ++i) q[i] = from[i] + (to[i] - from[i]) * k / pieces;
      if (auto wrong = wrong_with_posture(obstacles, arm, question.clearance, q)) {
        return "leg " + std::to_string(leg) + ", piece " + std::to_string(k) + ": " + *wrong;
      }
    }
  }
  return std::nullopt;
}

}  // namespace warren::test
