// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/judged_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

double length_of(const Vec3& v) { return portable::hypot(v.x(), v.y(), v.z()); }

/// From the core's nearest point to p, in the frame of a core that is no hull.
Vec3 off_core(const SolidCore& core, const Vec3& p) {
  Vec3 off = p;
  off.z() -= std::clamp(p.z(), -core.half.z(), core.half.z());
  if (core.kind == SolidKind::box) {
    off.x() -= std::clamp(p.x(), -core.half.x(), core.half.x());
    off.y() -= std::clamp(p.y(), -core.half.y(), core.half.y());
  } else if (core.kind == SolidKind::cylinder) {
    const double from_axis = portable::hypot(p.x(), p.y());
    const double share = from_axis > core.half.x() ? (from_axis - core.half.x()) / from_axis : 0.0;
    off.x() *= share;
    off.y() *= share;
  }
  return off;
}

/// From the core to the segment's nearest point: how far it is off is convex along the segment, and its slope's sign is
/// halved for.
Vec3 off_core(const SolidCore& core, const Vec3& middle, const Vec3& half) {
  const auto off_at = [&](double t) { return off_core(core, middle + t * half); };
  if (half.isZero(0.0)) return off_at(0.0);
  constexpr int halvings = 56;
  double low = -1.0;
  double high = 1.0;
  for (int i = 0; i < halvings; ++i) {
    const double t = 0.5 * (low + high);
    const Vec3 off = off_at(t);
    if (off.isZero(0.0)) return off;
    (off.dot(half) > 0.0 ? high : low) = t;
  }
  const Vec3 before = off_at(low);
  const Vec3 behind = off_at(high);
  return before.squaredNorm() < behind.squaredNorm() ? before : behind;
}

/// The point nearest to 0 among all mixtures of at most four points.
class Corral {
 public:
  explicit Corral(const Vec3& first) : nearest_(first) { points_[0] = first, shares_[0] = 1.0; }
  const Vec3& nearest() const { return nearest_; }
  /// False: that brings nothing, as far as numbers tell.
  bool add(const Vec3& point) {
    if (count_ == points_.size()) return false;
    const double before = nearest_.squaredNorm();
    points_[count_] = point;
    shares_[count_++] = 0.0;
    for (;;) {
      std::array<double, 4> wanted{};
      if (!mixture_nearest_plane(wanted)) return false;
      double way = 1.0;  // from the shares towards those that are wanted, as far as all of them stay above 0
      std::size_t first = count_;
      for (std::size_t i = 0; i < count_; ++i) {
        if (wanted[i] > 0.0) continue;
        const double until = shares_[i] / (shares_[i] - wanted[i]);
        if (first < count_ && until >= way) continue;
        first = i;
        way = shares_[i] > 0.0 ? until : 0.0;
      }
      for (std::size_t i = 0; i < count_; ++i) shares_[i] += way * (wanted[i] - shares_[i]);
      if (first == count_) break;
      --count_;
      std::swap(points_[first], points_[count_]);
      std::swap(shares_[first], shares_[count_]);
    }
    nearest_.setZero();
    for (std::size_t i = 0; i < count_; ++i) nearest_ += shares_[i] * points_[i];
    return nearest_.squaredNorm() < before;
  }

 private:
  /// Of the plane (line, point) through the points: the shares may be less than 0. False where the points lie in less.
  bool mixture_nearest_plane(std::array<double, 4>& shares) const {
    std::array<Vec3, 3> base;
    std::array<std::array<double, 3>, 3> along{};  // the way from the last point to point j, by `base`
    Vec3 rest = points_[count_ - 1];
    std::array<double, 3> wanted{};
    for (std::size_t j = 0; j + 1 < count_; ++j) {
      const Vec3 way = points_[j] - points_[count_ - 1];
      Vec3 left = way;
      for (int twice = 0; twice < 2; ++twice) {
        for (std::size_t k = 0; k < j; ++k) {
          const double more = base[k].dot(left);
          along[j][k] += more;
          left -= more * base[k];
        }
      }
      along[j][j] = left.norm();
      if (!(along[j][j] > 1e-12 * way.norm())) return false;
      base[j] = left / along[j][j];
      wanted[j] = -base[j].dot(rest);
      rest += wanted[j] * base[j];
    }
    double sum = 0.0;
    for (std::size_t j = count_ - 1; j-- > 0;) {
      double share = wanted[j];
      for (std::size_t k = j + 1; k + 1 < count_; ++k) share -= shares[k] * along[k][j];
      shares[j] = share / along[j][j];
      sum += shares[j];
    }
    shares[count_ - 1] = 1.0 - sum;
    return true;
  }

  std::array<Vec3, 4> points_{};
  std::array<double, 4> shares_{};
  std::size_t count_ = 1;
  Vec3 nearest_;
};

/// Wolfe's algorithm on b - a.
SolidGap searched_gap(const PlacedCore& a, const PlacedCore& b, double close, double enough) {
  constexpr int most_steps = 200;
  const auto farthest_back = [&](const Vec3& way) -> Vec3 {  // of b - a, against the way
    return b.frame.point(b.core.support(-b.frame.seen(way))) - a.frame.point(a.core.support(a.frame.seen(way)));
  };
  SolidGap gap;
  Corral corral(farthest_back(b.frame.at - a.frame.at));
  for (int step = 0; step < most_steps; ++step) {
    const Vec3& nearest = corral.nearest();
    const double length = length_of(nearest);
    if (step == 0 || length < gap.most) gap.most = length;
    if (!(length > 0.0)) break;
    const Vec3 back = farthest_back(nearest);
    const double least = back.dot(nearest) / length;
    if (least > gap.least || step == 0) {
      gap.least = std::max(least, 0.0);
      gap.towards = nearest / length;
    }
    if (gap.most - gap.least <= close || gap.least >= enough || !corral.add(back)) break;
  }
  return gap;
}

bool is_spine(const SolidCore& core) { return core.kind == SolidKind::sphere || core.kind == SolidKind::capsule; }

/// From a to b, a's core a point or a segment, b's no hull.
SolidGap written_gap(const PlacedCore& a, const PlacedCore& b) {
  const Vec3 middle = b.frame.seen(a.frame.at - b.frame.at);
  const Vec3 off = off_core(b.core, middle, a.core.half.z() * b.frame.seen(a.frame.axes[2]));
  const double length = length_of(off);
  SolidGap gap{length, length, Vec3::Zero()};
  if (length > 0.0) gap.towards = b.frame.turned(off / -length);
  return gap;
}

bool is_number(const Vec3& v) { return v.cwiseAbs().maxCoeff() <= largest_coordinate && v.allFinite(); }

/// Rodrigues' formula.
SolidFrame turned_about(const Vec3& axis, double angle) {
  const auto [s, c] = portable::sin_and_cos(angle);
  SolidFrame turn;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 e = turn.axes[k];
    turn.axes[k] = c * e + s * axis.cross(e) + (1.0 - c) * axis.dot(e) * axis;
  }
  return turn;
}

void check_frame(int frame, std::size_t joints, const std::string& name) {
  if (frame < base_frame || frame >= as_whole<int>(joints)) {
    throw InputError(name, "must stand in the base or in a joint before it", fmt::format("{}", frame));
  }
}

void check_model(const ArmModel& model) {
  if (model.variables.size() > most_joints || model.joints.size() > most_frames) {
    throw InputError("robot",
                     fmt::format("must have at most {} joints, {} that move on their own", most_frames, most_joints));
  }
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const ArmJoint& joint = model.joints[j];
    const std::string name = fmt::format("robot: joint {}", joint.name);
    check_frame(joint.parent, j, name);
    const bool finite =
        std::abs(joint.multiplier) <= largest_coordinate && std::abs(joint.offset) <= largest_coordinate;
    if (!finite || joint.variable >= model.variables.size()) throw InputError(name, "must follow a variable");
    if (!(std::abs(joint.axis.norm() - 1.0) <= 1e-9)) throw InputError(name, "must have an axis of length 1");
  }
  for (const ArmLink& link : model.links) {
    const std::string name = fmt::format("robot: link {}", link.name);
    check_frame(link.frame, model.joints.size(), name);
    if (link.solids.empty()) throw InputError(name, "must have a solid");
  }
  for (const auto& [a, b] : model.pairs) {
    if (a < model.links.size() && b < model.links.size() && a != b) continue;
    throw InputError("robot", "must have pairs of two of its links", fmt::format("{} {}", a, b));
  }
  check_frame(model.tool_frame, model.joints.size(), "robot: tool");
}

}  // namespace

Vec3 SolidCore::support(const Vec3& direction) const {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = direction[k] < 0.0 ? -half[k] : half[k];
  if (kind == SolidKind::hull) {
    const auto less = [&](const Vec3& one, const Vec3& other) { return one.dot(direction) < other.dot(direction); };
    return *std::max_element(corners.begin(), corners.end(), less);
  }
  if (kind == SolidKind::cylinder) {
    const double across = portable::hypot(direction.x(), direction.y());
    p.x() = across > 0.0 ? half.x() * (direction.x() / across) : half.x();
    p.y() = across > 0.0 ? half.x() * (direction.y() / across) : 0.0;
  }
  return p;
}

SolidCore core_of(const Solid& solid, SolidFrame& frame) {
  SolidCore core{solid.kind, solid.half};
  if (solid.kind == SolidKind::sphere) core.half.setZero();
  if (solid.kind == SolidKind::capsule) core.half = {0.0, 0.0, solid.half.z()};
  if (solid.kind == SolidKind::sphere || solid.kind == SolidKind::capsule) core.radius = solid.half.x();
  if (solid.kind == SolidKind::cylinder) core.half.y() = 0.0;
  core.far = length_of(core.half);
  if (solid.kind != SolidKind::hull) return core;
  Vec3 low = solid.corners.front();
  Vec3 high = low;
  for (const Vec3& p : solid.corners) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec3 middle = low + 0.5 * (high - low);
  core = {SolidKind::hull};
  core.corners = solid.corners;
  for (Vec3& p : core.corners) core.far = std::max(core.far, length_of(p -= middle));
  frame.at = frame.point(middle);
  return core;
}

SolidGap gap_between(const PlacedCore& a, const PlacedCore& b, double close, double enough) {
  if (is_spine(a.core) && b.core.kind != SolidKind::hull) return written_gap(a, b);
  if (!is_spine(b.core) || a.core.kind == SolidKind::hull) return searched_gap(a, b, close, enough);
  SolidGap gap = written_gap(b, a);
  gap.towards = -gap.towards;
  return gap;
}

SolidFrame rigid_frame(const Eigen::Isometry3d& pose, const std::string& name) {
  const Eigen::Matrix3d turn = pose.linear();
  const Eigen::Matrix3d off = turn.transpose() * turn - Eigen::Matrix3d::Identity();
  const bool rigid = off.allFinite() && off.cwiseAbs().maxCoeff() <= 1e-12;
  if (!rigid || !is_number(pose.translation()))
    throw InputError(name, "must have a rigid frame, of numbers up to 1e60");
  return {{turn.col(0), turn.col(1), turn.col(2)}, pose.translation()};
}

SolidCore checked_core(const Solid& solid, SolidFrame& frame, const std::string& name) {
  frame = rigid_frame(solid.pose, name);
  const bool is_hull = solid.kind == SolidKind::hull;
  const bool fits = is_hull
                        ? std::all_of(solid.corners.begin(), solid.corners.end(), is_number) && !solid.corners.empty()
                        : is_number(solid.half) && solid.half.minCoeff() >= 0.0;
  if (!fits)
    throw InputError(name, is_hull ? "must have corners of numbers up to 1e60" : "must have sizes from 0 to 1e60");
  return core_of(solid, frame);
}

JudgedArm::JudgedArm(const ArmModel& model, const Execution& execution) : model_(model) {
  check_model(model);
  std::size_t solids = 0;
  std::size_t corners = 0;
  for (const ArmLink& link : model.links) {
    solids += link.solids.size() + 1;
    for (const Solid& solid : link.solids) corners += solid.corners.size();
  }
  execution.reserve(2 * solids * sizeof(JudgedBody) + corners * sizeof(Vec3));
  bodies_.reserve(solids);
  for (const ArmJoint& joint : model.joints) rigid_frame(joint.origin, fmt::format("robot: joint {}", joint.name));
  rigid_frame(model.tool, "robot: tool");
  for (std::size_t i = 0; i < model.links.size(); ++i) add_link(i);
}

void JudgedArm::add_link(std::size_t link) {
  const ArmLink& from = model_.links[link];
  balls_.push_back(bodies_.size());
  if (from.solids.size() != 1) bodies_.push_back({{}, {}, from.frame, link, bodies_.size() + 1, from.solids.size()});
  Vec3 low = Vec3::Constant(largest_coordinate);
  Vec3 high = -low;
  const Vec3 origin = from.frame == base_frame ? model_.base : Vec3(Vec3::Zero());
  double reach = 0.0;
  for (const Solid& solid : from.solids) {
    JudgedBody body;
    body.core = checked_core(solid, body.frame, fmt::format("robot: link {}", from.name));
    body.joint = from.frame;
    body.owner = link;
    const Vec3 room = Vec3::Constant(body.core.far + body.core.radius);
    low = low.cwiseMin(body.frame.at - room);
    high = high.cwiseMax(body.frame.at + room);
    reach = std::max(reach, (body.frame.at - origin).norm() + body.core.far);
    bodies_.push_back(std::move(body));
  }
  JudgedBody& ball = bodies_[balls_.back()];
  if (ball.parts > 0) {
    ball.frame.at = 0.5 * low + 0.5 * high;
    for (std::size_t i = ball.first_part; i < bodies_.size(); ++i) {
      const JudgedBody& part = bodies_[i];
      const double far = (part.frame.at - ball.frame.at).norm() + part.core.far + part.core.radius;
      ball.core.radius = std::max(ball.core.radius, far * (1.0 + 1e-14));
    }
    reach = std::max(reach, (ball.frame.at - origin).norm());
  }
  reach_.push_back(reach * (1.0 + 1e-14));
}

int JudgedArm::joint_behind(int a, int b) const {
  while (a != b) {
    int& later = a > b ? a : b;
    later = model_.joints[as_whole<std::size_t>(later)].parent;
  }
  return a;
}

void JudgedArm::frames_at(const JointState& from, const JointState& way, double share,
                          std::vector<JudgedFrame>& frames) const {
  frames.resize(model_.joints.size() + 1);
  frames[0] = {};
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const ArmJoint& joint = model_.joints[j];
    const Eigen::Isometry3d& origin = joint.origin;
    const double rate = joint.multiplier * way[joint.variable];
    const double value = joint.multiplier * (from[joint.variable] + share * way[joint.variable]) + joint.offset;
    const JudgedFrame& parent = frames[as_whole<std::size_t>(joint.parent + 1)];
    const SolidFrame own = parent.frame.frame(
        {{origin.linear().col(0), origin.linear().col(1), origin.linear().col(2)}, origin.translation()});
    const Vec3 axis = joint.axis.normalized();
    const Vec3 line = own.turned(axis);
    JudgedFrame& frame = frames[j + 1];
    frame = {own, parent.spin, parent.drift};
    if (joint.slides) {
      frame.frame.at += value * line;
      frame.drift += rate * line;
    } else {
      frame.frame = own.frame(turned_about(axis, value));
      frame.spin += rate * line;
      frame.drift += rate * own.at.cross(line);
    }
  }
}

std::vector<Sway> JudgedArm::sways(std::span<const double> turns, std::span<const double> values) const {
  const std::size_t row = model_.joints.size() + 1;
  std::vector<Sway> all(model_.links.size() * row);
  for (std::size_t l = 0; l < model_.links.size(); ++l) {
    Sway sway{reach_[l]};
    int j = model_.links[l].frame;
    for (;;) {
      all[l * row + as_whole<std::size_t>(j + 1)] = sway;
      if (j == base_frame) break;
      const ArmJoint& joint = model_.joints[as_whole<std::size_t>(j)];
      const double turn = turns[as_whole<std::size_t>(j)] * (1.0 + 1e-14);
      if (joint.slides) {
        sway.reach += values[as_whole<std::size_t>(j)];
        sway.speed += turn;
      } else {
        sway.bend += turn * (turn * sway.reach + 2.0 * sway.speed);
        sway.speed += turn * sway.reach;
      }
      const Vec3 origin = joint.parent == base_frame ? model_.base : Vec3(Vec3::Zero());
      sway.reach = (sway.reach + (joint.origin.translation() - origin).norm()) * (1.0 + 1e-14);
      j = joint.parent;
    }
  }
  return all;
}

SolidFrame JudgedArm::tool_at(const JointState& q) const {
  std::vector<JudgedFrame> frames;
  frames_at(q, JointState{}, 0.0, frames);
  return frames[as_whole<std::size_t>(model_.tool_frame + 1)].frame.frame(rigid_frame(model_.tool, "robot: tool"));
}

}  // namespace warren
