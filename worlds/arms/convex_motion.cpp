// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/convex_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warren {
namespace {

constexpr double upwards = 1.0 + 1e-14;
constexpr double no_bound = std::numeric_limits<double>::infinity();

/// Where a body is, to first order: a point r of its frame at linear * r + shift.
struct PlacedBody {
  PlacedBody() = default;
  PlacedBody(const MovingFrame& frame, double t) : linear(frame.turn), shift(frame.at) {
    if (t == 0.0) return;
    for (int side = 0; side < 3; ++side) linear.col(side) += t * frame.spin.cross(frame.turn.col(side));
    shift += t * frame.velocity;
  }
  Vec3 support(const ConvexBody& body, const Vec3& direction, std::size_t& near) const {
    return linear * body.core_support(linear.transpose() * direction, near) + shift;
  }
  Eigen::Matrix3d linear;
  Vec3 shift;
};

/// All b - a, for the cores of two bodies at one or two times.
struct CoreDifference {
  CoreDifference(const ConvexBody& first, const MovingFrame& at_first, const ConvexBody& second,
                 const MovingFrame& at_second, double half)
      : a(first),
        b(second),
        ends(half > 0.0 ? 2 : 1),
        b_rests(at_second.spin.isZero(0.0) && at_second.velocity.isZero(0.0)) {
    for (std::size_t end = 0; end < ends; ++end) {
      at_a[end] = PlacedBody(at_first, end == 0 ? -half : half);
      at_b[end] = PlacedBody(at_second, end == 0 ? -half : half);
    }
  }
  /// What lies least along n.
  Vec3 lowest(const Vec3& n) {
    const Vec3 of_b = at_b[0].support(b, -n, near_b);
    const Vec3 least = of_b - at_a[0].support(a, n, near_a);
    if (ends == 1) return least;
    const Vec3 other = (b_rests ? of_b : at_b[1].support(b, -n, near_b)) - at_a[1].support(a, n, near_a);
    return n.dot(other) < n.dot(least) ? other : least;
  }
  const ConvexBody& a;
  const ConvexBody& b;
  std::size_t ends;
  bool b_rests;
  std::size_t near_a = 0;
  std::size_t near_b = 0;
  std::array<PlacedBody, 2> at_a;
  std::array<PlacedBody, 2> at_b;
};

/// Up to four points, and what of their hull is nearest to the origin. That is told as a mean of points with weights
/// >= 0, so it lies in the hull, however weights are rounded.
class NearestOfHull {
 public:
  const Vec3& nearest() const { return nearest_; }
  /// Is the origin inside of a tetrahedron?
  bool encloses() const { return kept_ == 4; }
  /// How deep, where it is; rounding taken off.
  double depth() const { return depth_; }
  bool has(const Vec3& point) const {
    return std::find(points_.begin(), points_.begin() + size_, point) != points_.begin() + size_;
  }
  void add(const Vec3& point) {
    points_[size_++] = point;
    best_sq_ = no_bound;
    if (size_ == 1) take<1>({0}, {1.0});
    if (size_ == 2) try_edge(0, 1);
    if (size_ == 3) try_triangle(0, 1, 2);
    if (size_ == 4) try_tetrahedron();
    keep_best();
  }

 private:
  template <std::size_t count>
  void take(const std::array<std::size_t, count>& corners, const std::array<double, count>& weights) {
    Vec3 mean = Vec3::Zero();
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      mean += weights[i] * points_[corners[i]];
      sum += weights[i];
    }
    mean /= sum;
    if (!(mean.squaredNorm() < best_sq_)) return;
    best_sq_ = mean.squaredNorm();
    nearest_ = mean;
    kept_ = count;
    std::copy(corners.begin(), corners.end(), kept_corners_.begin());
  }
  void try_edge(std::size_t a, std::size_t b) {
    const Vec3 along = points_[b] - points_[a];
    const double t = -points_[a].dot(along);
    const double square = along.squaredNorm();
    if (!(t > 0.0)) return take<1>({a}, {1.0});
    if (t >= square) return take<1>({b}, {1.0});
    take<2>({a, b}, {square - t, t});
  }
  void try_triangle(std::size_t a, std::size_t b, std::size_t c) {
    const Vec3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    const double of_a = normal.dot(points_[b].cross(points_[c]));
    const double of_b = normal.dot(points_[c].cross(points_[a]));
    const double of_c = normal.dot(points_[a].cross(points_[b]));
    if (of_a > 0.0 && of_b > 0.0 && of_c > 0.0) return take<3>({a, b, c}, {of_a, of_b, of_c});
    if (!(of_a > 0.0)) try_edge(b, c);
    if (!(of_b > 0.0)) try_edge(c, a);
    if (!(of_c > 0.0)) try_edge(a, b);
  }
  void try_tetrahedron() {
    constexpr std::array<std::array<std::size_t, 4>, 4> faces{{{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    double size = 0.0;
    for (const Vec3& point : points_) size = std::max(size, point.norm());
    bool outside = false;
    double depth = no_bound;
    std::array<double, 4> weights{};
    for (const auto& [a, b, c, top] : faces) {
      const Vec3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
      const double origin = -normal.dot(points_[a]);
      const double whole = normal.dot(points_[top] - points_[a]);
      weights[top] = std::abs(origin);
      depth = std::min(depth, (std::abs(origin) - 1e-14 * size * size * size) / normal.norm());
      if ((origin > 0.0) == (whole > 0.0) && origin != 0.0 && whole != 0.0) continue;
      outside = true;
      try_triangle(a, b, c);
    }
    if (outside) return;
    depth_ = depth;
    take<4>({0, 1, 2, 3}, weights);
  }
  void keep_best() {
    std::sort(kept_corners_.begin(), kept_corners_.begin() + kept_);
    for (std::size_t i = 0; i < kept_; ++i) points_[i] = points_[kept_corners_[i]];
    size_ = kept_;
  }

  std::array<Vec3, 4> points_;
  std::size_t size_ = 0;
  Vec3 nearest_ = Vec3::Zero();
  double best_sq_ = no_bound;
  double depth_ = -1.0;
  std::array<std::size_t, 4> kept_corners_{};
  std::size_t kept_ = 0;
};

struct DistanceBounds {
  double below = -no_bound;
  double above = no_bound;  // below 0: the cores overlap, so deep
  Vec3 direction = Vec3::UnitX();
};

/// Of the origin from the cores' differences, until it is above `enough`, below `too_near`, or known.
DistanceBounds bounds_of(CoreDifference cores, const Vec3& first, double enough, double too_near) {
  constexpr int most_steps = 64;
  DistanceBounds bounds;
  NearestOfHull hull;
  Vec3 towards = first;
  for (int step = 0; step < most_steps; ++step) {
    const double length = towards.norm();
    const Vec3 n = length > 0.0 ? Vec3(towards / length) : Vec3::UnitX();
    const Vec3 lowest = cores.lowest(n);
    const double below = n.dot(lowest);
    if (below > bounds.below) {
      bounds.below = below;
      bounds.direction = n;
    }
    if (bounds.below > enough || hull.has(lowest)) break;
    hull.add(lowest);
    towards = hull.nearest();
    const double above = towards.norm();
    if (hull.encloses()) {
      bounds.above = hull.depth() > 0.0 ? -hull.depth() : above;
      break;
    }
    if (!(above < bounds.above)) break;
    bounds.above = above;
    if (above < too_near || above - bounds.below <= 1e-12 * above) break;
  }
  return bounds;
}

/// Balls around two bodies, and what rounding may do.
struct BallsOfBodies {
  BallsOfBodies(const ConvexBody& a, const MovingFrame& at_a, const ConvexBody& b, const MovingFrame& at_b, double half,
                double room) {
    const Vec3 to_a = at_a.turn * a.centre();
    const Vec3 to_b = at_b.turn * b.centre();
    between = at_b.at + to_b - at_a.at - to_a;
    const double spins = half * (at_a.spin.norm() * a.radius() + at_b.spin.norm() * b.radius());
    const Vec3 way = half * (at_b.velocity + at_b.spin.cross(to_b) - at_a.velocity - at_a.spin.cross(to_a));
    away = between.norm() - way.norm() - spins - a.radius() - b.radius();
    const double arms = (1.0 + half * at_a.spin.norm()) * (to_a.norm() + a.radius()) +
                        (1.0 + half * at_b.spin.norm()) * (to_b.norm() + b.radius());
    rounding =
        1e-13 * (at_a.at.norm() + at_b.at.norm() + arms + room + half * (at_a.velocity.norm() + at_b.velocity.norm()));
  }
  Vec3 between;     // their centres
  double away;      // of each other, to first order
  double rounding;  // 1e-13 of all lengths
};

}  // namespace

ConvexBody::ConvexBody(const Solid& solid) : centre_(solid.pose.translation()) {
  const Eigen::Matrix3d turn = solid.pose.linear();
  const Vec3& half = solid.half;
  const auto add_edge = [&](int side, double length) {
    if (length > 0.0) edges_[edge_count_++] = length * turn.col(side);
  };
  switch (solid.kind) {
    case SolidKind::sphere:
      margin_ = radius_ = half.x();
      break;
    case SolidKind::capsule:
      add_edge(2, half.z());
      margin_ = half.x();
      radius_ = upwards * (half.x() + half.z());
      break;
    case SolidKind::box:
      for (int side = 0; side < 3; ++side) add_edge(side, half[side]);
      radius_ = upwards * half.norm();
      break;
    case SolidKind::cylinder:
      add_edge(2, half.z());
      is_round_ = half.x() > 0.0;
      rim_ = {half.x() * turn.col(0), half.x() * turn.col(1)};
      radius_ = upwards * std::sqrt(half.x() * half.x() + half.z() * half.z());
      break;
    case SolidKind::hull:
      std::vector<Vec3> corners;
      for (const Vec3& corner : solid.corners) corners.push_back(placed_point(solid.pose, corner));
      Eigen::AlignedBox3d box;
      for (const Vec3& corner : corners) box.extend(corner);
      centre_ = box.center();
      for (const Vec3& corner : corners) radius_ = std::max(radius_, upwards * (corner - centre_).norm());
      split_corners(corners, 0, corners.size());
      break;
  }
}

/// Halves along the longest side, until what is near each other is together.
void ConvexBody::split_corners(std::vector<Vec3>& corners, std::size_t begin, std::size_t end) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = begin; i < end; ++i) box.extend(corners[i]);
  if (end - begin > lanes) {
    Eigen::Index side = 0;
    box.sizes().maxCoeff(&side);
    const std::size_t groups = (end - begin + lanes - 1) / lanes;
    const std::size_t middle = begin + (groups / 2) * lanes;
    std::sort(corners.data() + begin, corners.data() + end, [side](const Vec3& a, const Vec3& b) {
      return a[side] != b[side] ? a[side] < b[side]
                                : std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    });
    split_corners(corners, begin, middle);
    split_corners(corners, middle, end);
    return;
  }
  Corners group;
  group.centre = box.center();
  for (std::size_t i = 0; i < lanes; ++i) {
    const Vec3& corner = corners[std::min(begin + i, end - 1)];
    group.x[i] = corner.x();
    group.y[i] = corner.y();
    group.z[i] = corner.z();
    group.radius = std::max(group.radius, upwards * (corner - group.centre).norm());
  }
  corners_.push_back(group);
}

void ConvexBody::look(const Corners& corners, const Vec3& direction, Farthest& best) {
  std::array<double, lanes> along;
  for (std::size_t i = 0; i < lanes; ++i) {
    along[i] = direction.x() * corners.x[i] + direction.y() * corners.y[i] + direction.z() * corners.z[i];
  }
  std::array<double, lanes> high = along;
  for (std::size_t half = lanes / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) high[i] = std::max(high[i], high[i + half]);
  }
  if (!(high[0] > best.along)) return;
  std::size_t most = 0;
  while (most + 1 < lanes && along[most] < high[0]) ++most;
  best = {along[most], {corners.x[most], corners.y[most], corners.z[most]}};
}

Vec3 ConvexBody::hull_support(const Vec3& direction, std::size_t& near) const {
  const double length = upwards * direction.norm();
  Farthest best{-no_bound, centre_};
  const std::size_t first = near < corners_.size() ? near : 0;
  look(corners_[first], direction, best);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const double before = best.along;
    if (i == first || !(direction.dot(corners_[i].centre) + length * corners_[i].radius > before)) continue;
    look(corners_[i], direction, best);
    if (best.along > before) near = i;
  }
  return best.corner;
}

Vec3 ConvexBody::core_support(const Vec3& direction, std::size_t& near) const {
  if (!corners_.empty()) return hull_support(direction, near);
  Vec3 point = centre_;
  for (std::size_t i = 0; i < edge_count_; ++i) point += (direction.dot(edges_[i]) < 0.0 ? -1.0 : 1.0) * edges_[i];
  if (is_round_) {
    const double x = direction.dot(rim_[0]);
    const double y = direction.dot(rim_[1]);
    const double length = std::sqrt(x * x + y * y);
    if (length > 0.0) point += (x / length) * rim_[0] + (y / length) * rim_[1];
  }
  return point;
}

Apart keep_apart(const ConvexBody& a, const MovingFrame& at_a, const ConvexBody& b, const MovingFrame& at_b,
                 double half, double room) {
  const BallsOfBodies balls(a, at_a, b, at_b, half, room);
  const double bend = 0.5 * half * half * (at_a.bend + at_b.bend);
  if (balls.away - balls.rounding > room + bend * (1.0 + 1e-12)) return Apart::proved;
  const double apart = room + a.margin() + b.margin();
  const double enough = apart + bend * (1.0 + 1e-12) + balls.rounding;
  const double too_near = apart - balls.rounding;
  const CoreDifference way(a, at_a, b, at_b, half);
  DistanceBounds bounds = bounds_of(way, balls.between, enough, half > 0.0 ? enough : too_near);
  if (bounds.below > enough) return Apart::proved;
  if (half > 0.0) bounds = bounds_of({a, at_a, b, at_b, 0.0}, balls.between, apart, too_near);
  return bounds.above < too_near ? Apart::meet : Apart::open;
}

PlaneBetween plane_between(const ConvexBody& a, const MovingFrame& at_a, const ConvexBody& b, const MovingFrame& at_b,
                           double enough) {
  const BallsOfBodies balls(a, at_a, b, at_b, 0.0, 0.0);
  const double margins = a.margin() + b.margin() + balls.rounding;
  const DistanceBounds bounds = bounds_of({a, at_a, b, at_b, 0.0}, balls.between, enough + margins, -no_bound);
  return {bounds.below - margins, bounds.direction};
}

}  // namespace warren
