// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/convex_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warren {
namespace {

constexpr double upwards = 1.0 + 1e-14;

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
      take_corners(std::move(corners));
      break;
  }
}

void ConvexBody::take_corners(std::vector<Vec3> corners) {
  Eigen::AlignedBox3d box;
  for (const Vec3& corner : corners) box.extend(corner);
  centre_ = box.center();
  for (const Vec3& corner : corners) radius_ = std::max(radius_, upwards * (corner - centre_).norm());
  split_corners(corners, 0, corners.size());
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
  Farthest best{-std::numeric_limits<double>::infinity(), centre_};
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
  for (std::size_t i = 0; i < edge_count_; ++i) {
    if (direction.dot(edges_[i]) < 0.0) {
      point -= edges_[i];
    } else {
      point += edges_[i];
    }
  }
  if (is_round_) {
    const double x = direction.dot(rim_[0]);
    const double y = direction.dot(rim_[1]);
    const double length = std::sqrt(x * x + y * y);
    if (length > 0.0) point += (x / length) * rim_[0] + (y / length) * rim_[1];
  }
  return point;
}

Vec3 ConvexBody::support(const Vec3& direction) const {
  const double length = direction.norm();
  const Vec3 of_core = core_support(direction);
  return length > 0.0 ? Vec3(of_core + (margin_ / length) * direction) : of_core;
}

}  // namespace warren
