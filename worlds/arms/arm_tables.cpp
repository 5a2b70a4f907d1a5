// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_certificate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "worlds/arms/arm_lanes.hpp"

namespace warren::detail {
namespace {

using Doubles = ArmTables<double>;

/// A rotation that turns z into the axis.
Eigen::Matrix3d z_turned_to(const Vec3& axis) {
  if (axis.x() == 0.0 && axis.y() == 0.0 && axis.z() > 0.0) return Eigen::Matrix3d::Identity();
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3 z = axis.normalized();
  const Vec3 x = (Vec3::Unit(least) - Vec3::Unit(least).dot(z) * z).normalized();
  Eigen::Matrix3d turn;
  turn << x, z.cross(x), z;
  return turn;
}

/// Balls that cover a solid, in its link's frame.
class ArmCover {
 public:
  ArmCover(const Solid& solid, std::vector<Doubles::Ball>& balls) : solid_(solid), balls_(balls) {
    const double r = solid.half.x();
    const double z = solid.half.z();
    switch (solid.kind) {
      case SolidKind::sphere:
        add(Vec3::Zero(), r, r);
        break;
      case SolidKind::capsule:
        cut_capsule(r, z);
        break;
      case SolidKind::cylinder:
        cut({r, r, z}, {1, 1, parts(z, r, 8)}, Vec3::Zero());
        break;
      case SolidKind::box:
      case SolidKind::hull:
        cut_box();
        break;
    }
  }

 private:
  static int parts(double half, double unit, int most) {
    if (!(half > unit)) return 1;
    return half < most * unit ? bounded_whole<int>(std::ceil(half / unit)) : most;
  }
  void add(const Vec3& centre, double outer, double inner) {
    const Vec3 at = solid_.pose * centre;
    balls_.push_back({at.x(), at.y(), at.z(), outer, inner});
  }
  void cut_capsule(double r, double z) {
    add({0.0, 0.0, z}, r, r);
    if (z == 0.0) return;
    add({0.0, 0.0, -z}, r, r);
    const int n = parts(z, r, 8);
    const double half = z / n;
    for (int i = 0; i < n; ++i) add({0.0, 0.0, (2 * i + 1) * half - z}, portable::hypot(r, half), r);
  }
  void cut_box() {
    Vec3 half = solid_.half;
    Vec3 middle = Vec3::Zero();
    if (solid_.kind == SolidKind::hull) {
      Eigen::AlignedBox3d box;
      for (const Vec3& corner : solid_.corners) box.extend(corner);
      middle = box.center();
      half = 0.5 * box.sizes();
    }
    const double unit = std::max(half.minCoeff(), half.maxCoeff() / 4);
    cut(half, {parts(half.x(), unit, 4), parts(half.y(), unit, 4), parts(half.z(), unit, 4)}, middle);
  }
  void cut(const Vec3& half, const std::array<int, 3>& n, const Vec3& middle) {
    const Vec3 cell(half.x() / n[0], half.y() / n[1], half.z() / n[2]);
    const bool is_one = n[0] * n[1] * n[2] == 1;
    for (int i = 0; i < n[0]; ++i) {
      for (int j = 0; j < n[1]; ++j) {
        for (int k = 0; k < n[2]; ++k) {
          const Vec3 at = middle - half + cell.cwiseProduct(Vec3(2 * i + 1, 2 * j + 1, 2 * k + 1));
          add(at, outer_of(cell, at, is_one), inner_of(cell, at));
        }
      }
    }
  }
  double outer_of(const Vec3& cell, const Vec3& at, bool is_one) const {
    if (solid_.kind == SolidKind::cylinder) return portable::hypot(cell.x(), cell.z());
    if (solid_.kind == SolidKind::box || !is_one) return cell.norm();
    double most = 0.0;
    for (const Vec3& corner : solid_.corners) most = std::max(most, (corner - at).norm());
    return most;
  }
  double inner_of(const Vec3& cell, const Vec3& at) const {
    if (solid_.kind != SolidKind::hull) return cell.minCoeff();
    double least = solid_.faces.empty() ? 0.0 : std::numeric_limits<double>::infinity();
    for (const auto& face : solid_.faces) {
      const Vec3& a = solid_.corners[face[0]];
      const Vec3 out = (solid_.corners[face[1]] - a).cross(solid_.corners[face[2]] - a);
      if (out.norm() > 0.0) least = std::min(least, (a - at).dot(out) / out.norm() * (1.0 - 1e-9));
    }
    return least;
  }

  const Solid& solid_;
  std::vector<Doubles::Ball>& balls_;
};

/// A ball around balls: its centre walks towards the farthest of them, a little less each time (Badoiu and Clarkson).
Doubles::Ball ball_around(std::span<const Doubles::Ball> balls) {
  Vec3 centre(balls[0].x, balls[0].y, balls[0].z);
  double most = 0.0;
  constexpr int steps = 100;
  for (int step = 1; step <= steps; ++step) {
    Vec3 far = centre;
    most = 0.0;
    for (const Doubles::Ball& ball : balls) {
      const Vec3 at(ball.x, ball.y, ball.z);
      const double away = (at - centre).norm() + ball.outer;
      if (away <= most) continue;
      most = away;
      far = at;
    }
    if (balls.size() == 1 || step == steps) break;
    centre += (far - centre) / (step + 1);
  }
  return {centre.x(), centre.y(), centre.z(), most * (1.0 + 1e-12), balls.size() == 1 ? balls[0].inner : 0.0};
}

/// Where a link's points may be in a frame: so far from its z axis, between two heights, so far from the origin.
struct ArmZone {
  double radius = 0.0;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double far = 0.0;

  void take(const Doubles::Ball& ball, double more) {
    const Vec3 at(ball.x, ball.y, ball.z);
    radius = std::max(radius, at.head<2>().norm() + more);
    low = std::min(low, at.z() - more);
    high = std::max(high, at.z() + more);
    far = std::max(far, at.norm() + more);
  }
  /// The same, after the frame's joint has gone anywhere, in the parent's frame.
  ArmZone in_parent(const ArmDrive& drive, const Doubles::Frame& frame) const {
    const double slide_low = drive.slides ? drive.low : 0.0;
    const double slide_high = drive.slides ? drive.high : 0.0;
    const Vec3 at(frame.at[0], frame.at[1], frame.at[2]);
    const Vec3 z(frame.turn[6], frame.turn[7], frame.turn[8]);
    const double aslant = radius * std::sqrt(std::max(0.0, 1.0 - z.z() * z.z()));
    const double most_far = at.norm() + far + std::max(std::abs(slide_low), std::abs(slide_high));
    ArmZone zone;
    for (const double height : {low + slide_low, high + slide_high}) {
      const Vec3 middle = at + height * z;
      zone.radius = std::max(zone.radius, middle.head<2>().norm() + radius);
      zone.low = std::min(zone.low, middle.z() - aslant);
      zone.high = std::max(zone.high, middle.z() + aslant);
      zone.far = std::max(zone.far, middle.norm() + radius);
    }
    zone.far = std::min(zone.far, most_far);
    zone.radius = std::min(zone.radius, zone.far);
    zone.low = std::max(zone.low, -zone.far);
    zone.high = std::min(zone.high, zone.far);
    return zone;
  }
};

constexpr double rounded_up = 1.0 + 1e-6;

/// Fills the setup's tables, in doubles.
class ArmBuilder {
 public:
  ArmBuilder(ArmSetup& setup, const ArmModel& model) : setup_(setup), tables_(setup.doubles), model_(model) {}

  void take_joints() {
    setup_.drives.emplace_back();
    tables_.frames.push_back({{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}});
    turns_.push_back(Eigen::Matrix3d::Identity());
    for (const ArmJoint& joint : model_.joints) take_joint(joint);
  }

  /// Those that move first; a pair's links by their new numbers.
  void take_links(const Execution& execution) {
    std::vector<std::uint32_t> number(model_.links.size());
    for (const bool moves : {true, false}) {
      for (std::size_t i = 0; i < model_.links.size(); ++i) {
        if ((model_.links[i].frame != base_frame) != moves) continue;
        execution.check();
        number[i] = as_whole<std::uint32_t>(setup_.links.size());
        take_link(model_.links[i]);
      }
      if (moves) setup_.moving = setup_.links.size();
    }
    for (const LinkPair& pair : model_.pairs) {
      const auto [a, b] = std::minmax(number[pair[0]], number[pair[1]]);
      const std::uint32_t common = common_slot(setup_.links[a].slot, setup_.links[b].slot);
      if (setup_.links[a].slot == setup_.links[b].slot) {
        keep_still(solids_of(a), solids_of(b));
      } else {
        setup_.pairs.push_back({a, b, common});
      }
    }
  }

  void take_reaches() {
    const auto padded = [](std::size_t n) { return (n + 7) / 8 * 8; };
    setup_.link_lanes = padded(setup_.links.size());
    setup_.pair_lanes = padded(setup_.pairs.size());
    tables_.reach.assign(slots() * setup_.link_lanes, 0.0);
    tables_.pair_reach.assign(slots() * setup_.pair_lanes, 0.0);
    for (std::size_t link = 0; link < setup_.links.size(); ++link) take_reach(link);
    for (std::size_t pair = 0; pair < setup_.pairs.size(); ++pair) {
      const auto [a, b, common] = setup_.pairs[pair];
      for (const std::uint32_t link : {a, b}) {
        for (std::size_t slot = setup_.links[link].slot; slot != common; slot = setup_.drives[slot].parent) {
          tables_.pair_reach[slot * setup_.pair_lanes + pair] = tables_.reach[slot * setup_.link_lanes + link];
        }
      }
    }
  }

  void take_obstacles(std::span<const Solid> obstacles, const Execution& execution) {
    double most_outer = 0.0;
    for (const Doubles::Ball& ball : tables_.hulls) most_outer = std::max(most_outer, 2 * ball.outer);
    for (const Solid& solid : obstacles) {
      execution.check();
      const ConvexBody body(solid);
      for (std::size_t link = setup_.moving; link < setup_.links.size(); ++link) {
        for (const ConvexBody& part : solids_of(link)) keep_still({&part, 1}, {&body, 1});
      }
      if (body.centre().norm() - body.radius() > rounded_up * (far_ + most_outer) + setup_.clearance) continue;
      take_obstacle(solid);
      setup_.bodies.push_back(body);
    }
    setup_.obstacle_lanes = (setup_.bodies.size() + 7) / 8 * 8;
    take_bounds();
  }

  /// See the head of arm_certificate.hpp, (8) and (9).
  template <class T>
  void take_slack(ArmTables<T>& tables) const {
    constexpr double u = unit_rounding<T>;
    struct Error {
      double turn = 0.0;
      double at = 0.0;
    };
    std::vector<Error> errors(slots());
    for (std::size_t slot = 1; slot < slots(); ++slot) {
      const ArmDrive& drive = setup_.drives[slot];
      const auto& at = tables_.frames[slot].at;
      const double length = portable::hypot(at[0], at[1], at[2]);
      const Error& before = errors[drive.parent];
      // The value itself is told in doubles; that is reduced by turns, whose number has 53 bits.
      const double value = u * (7.0 + 3.0 * drive.most_way) + 3 * unit_rounding<double> * drive.most_value;
      errors[slot].turn = before.turn + 16 * u + 2 * double{largest_sine_error<T>} + 1.5 * (drive.slides ? 0.0 : value);
      errors[slot].at = before.at + before.turn * length + 7 * u * length + 2 * u * far_;
      if (!drive.slides) continue;
      const double slide = std::max(std::abs(drive.low), std::abs(drive.high));
      errors[slot].at += (errors[slot].turn + 12 * u) * slide + u * far_;
    }
    double turn = 0.0;
    double centre = 0.0;
    for (std::size_t link = 0; link < setup_.links.size(); ++link) {
      const Error& error = errors[setup_.links[link].slot];
      turn = std::max(turn, error.turn);
      centre = std::max(centre, error.at + (error.turn + 8 * u) * own_far_[link] + u * far_);
    }
    const double size = std::max(far_, size_);
    const double slots_count = static_cast<double>(slots());
    tables.slack = static_cast<T>(1.01 * (2 * centre + 64 * u * size));
    tables.way_slack = static_cast<T>(
        2.02 * (2 * turn * std::max(1.0, far_) + 2 * centre + (64 + 4 * slots_count) * u * std::max(1.0, far_)));
  }

 private:
  std::size_t slots() const { return setup_.drives.size(); }
  std::span<const ConvexBody> solids_of(std::size_t link) const {
    return std::span(setup_.solids).subspan(first_solid_[link], first_solid_[link + 1] - first_solid_[link]);
  }
  std::uint32_t common_slot(std::size_t a, std::size_t b) const {
    while (a != b) (a > b ? a : b) = setup_.drives[std::max(a, b)].parent;  // parents have lower numbers
    return as_whole<std::uint32_t>(a);
  }
  /// Bodies that never move against each other.
  void keep_still(std::span<const ConvexBody> a, std::span<const ConvexBody> b) {
    for (const ConvexBody& one : a) {
      for (const ConvexBody& other : b) {
        const Apart apart = keep_apart(one, {}, other, {}, 0.0, setup_.clearance);
        setup_.always_touches |= apart != Apart::proved;
        setup_.always_meets |= apart == Apart::meet;
      }
    }
  }

  void take_joint(const ArmJoint& joint) {
    const ArmVariable& variable = model_.variables[joint.variable];
    ArmDrive drive{as_whole<std::size_t>(joint.parent + 1), joint.slides, joint.variable, joint.multiplier,
                   joint.offset};
    const double low = joint.multiplier * variable.low + joint.offset;
    const double high = joint.multiplier * variable.high + joint.offset;
    const double rounding = 1e-9 * (1.0 + std::max(std::abs(low), std::abs(high)));
    drive.low = std::min(low, high) - rounding;
    drive.high = std::max(low, high) + rounding;
    drive.most_way =
        variable.continuous ? 2.0 * std::numbers::pi * std::abs(joint.multiplier) + rounding : drive.high - drive.low;
    drive.most_value = std::max({1000.0, std::abs(drive.low), std::abs(drive.high)});
    const Eigen::Matrix3d own = z_turned_to(joint.axis);
    const Eigen::Matrix3d& above = turns_[drive.parent];
    const Eigen::Matrix3d turn = above.transpose() * joint.origin.linear() * own;
    const Vec3 at = above.transpose() * joint.origin.translation();
    Doubles::Frame frame;
    Eigen::Map<Eigen::Matrix3d>(frame.turn.data()) = turn;
    Eigen::Map<Vec3>(frame.at.data()) = at;
    setup_.drives.push_back(drive);
    tables_.frames.push_back(frame);
    turns_.push_back(own);
  }

  void take_link(const ArmLink& link) {
    const auto slot = as_whole<std::uint32_t>(link.frame + 1);
    const std::size_t first = tables_.balls.size();
    for (Solid solid : link.solids) {
      solid.pose = Eigen::Isometry3d(turns_[slot].transpose()) * solid.pose;
      const ArmCover cover(solid, tables_.balls);
      setup_.solid_of_ball.resize(tables_.balls.size(), as_whole<std::uint32_t>(setup_.solids.size()));
      setup_.is_whole_ball.resize(tables_.balls.size(), solid.kind == SolidKind::sphere ? 1 : 0);
      setup_.solids.emplace_back(solid);
    }
    setup_.links.push_back({slot, as_whole<std::uint32_t>(first), as_whole<std::uint32_t>(tables_.balls.size())});
    tables_.hulls.push_back(ball_around(std::span(tables_.balls).subspan(first)));
    first_solid_.push_back(setup_.solids.size());
  }

  void take_reach(std::size_t link) {
    ArmZone zone;
    zone.take(tables_.hulls[link], 0.0);
    for (std::uint32_t ball = setup_.links[link].first_ball; ball < setup_.links[link].end_ball; ++ball) {
      zone.take(tables_.balls[ball], setup_.is_whole_ball[ball] != 0 ? 0.0 : tables_.balls[ball].outer);
    }
    own_far_.push_back(zone.far);
    for (std::size_t slot = setup_.links[link].slot; slot != 0; slot = setup_.drives[slot].parent) {
      ArmDrive& drive = setup_.drives[slot];
      const double reach = rounded_up * (drive.slides ? 1.0 : zone.radius);
      tables_.reach[slot * setup_.link_lanes + link] = reach;
      drive.most_reach = std::max(drive.most_reach, reach);
      zone = zone.in_parent(drive, tables_.frames[slot]);
    }
    far_ = std::max(far_, zone.far);
  }

  void take_obstacle(const Solid& solid) {
    Vec3 half = solid.half;
    Vec3 centre = solid.pose.translation();
    const Eigen::Matrix3d& axes = solid.pose.linear();
    double inflate = setup_.clearance;
    ArmObstacleShape shape = ArmObstacleShape::box;
    switch (solid.kind) {
      case SolidKind::sphere:
      case SolidKind::capsule:
        shape =
            solid.kind == SolidKind::sphere || half.z() == 0.0 ? ArmObstacleShape::point : ArmObstacleShape::segment;
        inflate += half.x();
        half.x() = half.y() = 0.0;
        if (shape == ArmObstacleShape::point) half.z() = 0.0;
        break;
      case SolidKind::cylinder:
        shape = ArmObstacleShape::cylinder;
        half.y() = half.x();
        break;
      case SolidKind::hull: {
        Eigen::AlignedBox3d box;
        for (const Vec3& corner : solid.corners) box.extend(corner);
        centre = solid.pose * box.center();
        half = 0.5 * box.sizes();
        break;
      }
      case SolidKind::box:
        break;
    }
    clip(axes, shape, centre, half);
    if (shape == ArmObstacleShape::box && axes == Eigen::Matrix3d::Identity()) shape = ArmObstacleShape::upright_box;
    Doubles::Obstacle obstacle{centre.x(), centre.y(), centre.z(), {}, {half.x(), half.y(), half.z()}, inflate};
    Eigen::Map<Eigen::Matrix3d>(obstacle.axes.data()) = axes;
    tables_.obstacles.push_back(obstacle);
    setup_.shapes.push_back(shape);
    setup_.is_whole_obstacle.push_back(solid.kind == SolidKind::hull ? 0 : 1);
    size_ = std::max(size_, centre.norm() + half.norm());
  }

  /// What of a box or an axis is farther than the arm gets is nearest to no point of it; without it sizes, and so the
  /// slack of rounding, are the arm's own.
  void clip(const Eigen::Matrix3d& axes, ArmObstacleShape shape, Vec3& centre, Vec3& half) const {
    const Vec3 base = -(axes.transpose() * centre);
    const double reach = 1.01 * far_ + 0.01;
    for (int axis = shape == ArmObstacleShape::box ? 0 : 2; axis < 3; ++axis) {
      double& h = half[axis];
      if (h <= reach) continue;
      const double low = std::clamp(base[axis] - reach, -h, h);
      const double high = std::clamp(base[axis] + reach, -h, h);
      centre += 0.5 * (low + high) * axes.col(axis);
      h = 0.5 * (high - low);
    }
  }

  void take_bounds() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < 6; ++row) tables_.bounds[row].assign(setup_.obstacle_lanes, row < 3 ? inf : -inf);
    for (std::size_t i = 0; i < tables_.obstacles.size(); ++i) {
      const Doubles::Obstacle& o = tables_.obstacles[i];
      const std::array<double, 3> centre{o.x, o.y, o.z};
      for (std::size_t row = 0; row < 3; ++row) {
        double half = o.inflate;
        for (std::size_t axis = 0; axis < 3; ++axis) half += std::abs(o.axes[3 * axis + row]) * o.half[axis];
        tables_.bounds[row][i] = centre[row] - half;
        tables_.bounds[row + 3][i] = centre[row] + half;
      }
    }
  }

  ArmSetup& setup_;
  Doubles& tables_;
  const ArmModel& model_;
  std::vector<Eigen::Matrix3d> turns_;  // slot by slot: from the joint's frame to that whose z is the axis
  std::vector<std::size_t> first_solid_{0};
  std::vector<double> own_far_;  // by link: in its frame
  double far_ = 0.0;             // of any link's centres, from the base's origin
  double size_ = 0.0;
};

/// Of numbers, or of structs of nothing but numbers, in floats.
template <class From, class To>
void copy_numbers(const std::vector<From>& from, std::vector<To>& to) {
  constexpr std::size_t count = sizeof(From) / sizeof(double);  // NOLINT(bugprone-sizeof-expression): of numbers 1
  for (const From& some : from) {
    const auto numbers = std::bit_cast<std::array<double, count>>(some);
    std::array<float, count> floats;
    std::transform(numbers.begin(), numbers.end(), floats.begin(), [](double x) { return static_cast<float>(x); });
    to.push_back(std::bit_cast<To>(floats));
  }
}

}  // namespace

ArmSetup::ArmSetup(const ArmModel& model, std::span<const Solid> obstacles, double room, double finest,
                   const Execution& execution)
    : clearance(room), resolution(finest) {
  execution.reserve(obstacles.size() * (sizeof(ConvexBody) + 2 * sizeof(Doubles::Obstacle)));
  doubles.clearance = room;
  ArmBuilder builder(*this, model);
  builder.take_joints();
  builder.take_links(execution);
  builder.take_reaches();
  builder.take_obstacles(obstacles, execution);
  copy_numbers(doubles.frames, floats.frames);
  copy_numbers(doubles.hulls, floats.hulls);
  copy_numbers(doubles.balls, floats.balls);
  copy_numbers(doubles.obstacles, floats.obstacles);
  for (std::size_t row = 0; row < floats.bounds.size(); ++row) copy_numbers(doubles.bounds[row], floats.bounds[row]);
  copy_numbers(doubles.reach, floats.reach);
  copy_numbers(doubles.pair_reach, floats.pair_reach);
  floats.clearance = static_cast<float>(room);
  builder.take_slack(floats);
  constexpr float most_slack = 1e3F;  // of sizes up to 3e8, which floats tell apart by tens
  floats_hold = floats.slack < most_slack;
  builder.take_slack(doubles);
}

}  // namespace warren::detail
