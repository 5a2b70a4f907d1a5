// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/solid_index.hpp"

#include <limits>
#include <string>

#include "core/base/error.hpp"

namespace warren {
namespace {

bool is_coordinate(double x) { return std::abs(x) <= largest_coordinate; }

void check(const Sphere& s, std::size_t number) {
  if (is_coordinate(s.x) && is_coordinate(s.y) && is_coordinate(s.z) && s.radius >= 0.0 && is_coordinate(s.radius))
    return;
  throw InputError("sphere " + std::to_string(number), "must be numbers of at most 1e60, the radius 0 at least");
}

void check(const SolidBox& box, std::size_t number) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (is_coordinate(box.low[axis]) && is_coordinate(box.high[axis]) && box.low[axis] <= box.high[axis]) continue;
    throw InputError("box " + std::to_string(number), "must be numbers of at most 1e60, the lower corner first");
  }
}

BoxOf<3> bounds_of(const Sphere& s) {
  return {{s.x - s.radius, s.y - s.radius, s.z - s.radius}, {s.x + s.radius, s.y + s.radius, s.z + s.radius}};
}

/// The square of the distance of a segment's points from a box, as a function of the share t along the segment.
class BoxProfile {
 public:
  BoxProfile(const Spine& spine, const SolidBox& box)
      : spine_(spine), low_(box.low[0], box.low[1], box.low[2]), high_(box.high[0], box.high[1], box.high[2]) {}

  double at(double t) const { return gap(t).squaredNorm(); }
  /// Half the derivative.
  double slope(double t) const { return gap(t).dot(spine_.way); }
  /// Half the second derivative of the piece around t, which holds no break.
  double curvature(double t) const {
    const Vec3 outside = gap(t);
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (outside[axis] != 0.0) sum += spine_.way[axis] * spine_.way[axis];
    }
    return sum;
  }
  /// Narrows [low, high], where the slope turns, to a piece without breaks: the slope only grows along the segment.
  void narrow(double& low, double& high) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (spine_.way[axis] == 0.0) continue;
      for (const double face : {low_[axis], high_[axis]}) {
        const double t = (face - spine_.a[axis]) / spine_.way[axis];
        if (t > low && t < high) (slope(t) < 0.0 ? low : high) = t;
      }
    }
  }

 private:
  /// From the box to the point, coordinate by coordinate.
  Vec3 gap(double t) const {
    const Vec3 p = spine_.a + t * spine_.way;
    return p - p.cwiseMax(low_).cwiseMin(high_);
  }

  const Spine& spine_;
  Vec3 low_;
  Vec3 high_;
};

}  // namespace

SolidIndex::SolidIndex(std::span<const Sphere> spheres, std::span<const SolidBox> boxes, const Execution& execution)
    : boxes_(boxes.begin(), boxes.end()) {
  std::vector<Solid> solids;
  std::vector<BoxOf<3>> bounds;
  for (const Sphere& s : spheres) {
    check(s, solids.size());
    solids.push_back({{s.x, s.y, s.z}, s.radius, no_box});
    bounds.push_back(bounds_of(s));
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    check(boxes[i], i);
    const Vec3 low(boxes[i].low[0], boxes[i].low[1], boxes[i].low[2]);
    const Vec3 high(boxes[i].high[0], boxes[i].high[1], boxes[i].high[2]);
    solids.push_back({0.5 * (low + high), 0.5 * (high - low).norm(), as_whole<std::int32_t>(i)});
    bounds.push_back({boxes[i].low, boxes[i].high});
  }
  for (const BoxOf<3>& b : bounds) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent_ = std::max({extent_, std::abs(b.low[axis]), std::abs(b.high[axis])});
    }
  }
  if (solids.size() <= most_without_tree) {
    solids_ = std::move(solids);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const Solid& solid : solids_) middles_[axis].push_back(solid.centre[as_whole<Eigen::Index>(axis)]);
    }
    return;
  }
  tree_ = BoxTree<3>(bounds, execution);
  for (const std::uint32_t i : tree_.order()) solids_.push_back(solids[i]);
}

BoxOf<3> SolidIndex::box_around(const Spine& spine) {
  const Vec3 b = spine.a + spine.way;
  const Vec3 low = spine.a.cwiseMin(b);
  const Vec3 high = spine.a.cwiseMax(b);
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

std::size_t SolidIndex::squares_from(const Vec3& p, std::array<double, most_without_tree>& squares) const {
  const std::size_t count = solids_.size();
  const double* x = middles_[0].data();
  const double* y = middles_[1].data();
  const double* z = middles_[2].data();
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = x[i] - p.x();
    const double dy = y[i] - p.y();
    const double dz = z[i] - p.z();
    squares[i] = dx * dx + dy * dy + dz * dz;
  }
  return as_whole<std::size_t>(std::min_element(squares.begin(), squares.begin() + count) - squares.begin());
}

Approach SolidIndex::box_approach(const Spine& spine, const SolidBox& box) {
  return {std::sqrt(distance_square(spine, box)), Vec3::Zero(), Vec3::Zero(), 0.0};
}

double SolidIndex::distance(const Spine& spine, double enough) const {
  double nearest = std::numeric_limits<double>::infinity();
  for_each_within(spine, enough, [&](const Approach& found) {
    nearest = std::min(nearest, std::max(0.0, found.distance));
    return nearest > 0.0 ? std::min(enough, nearest) : -1.0;
  });
  return nearest;
}

double distance_square(const Spine& spine, const SolidBox& box) {
  const BoxProfile profile(spine, box);
  if (profile.slope(0.0) >= 0.0) return profile.at(0.0);
  double low = 0.0;
  double high = 1.0;
  profile.narrow(low, high);
  const double least = std::min(profile.at(low), profile.at(high));
  const double middle = 0.5 * (low + high);
  const double curvature = profile.curvature(middle);
  if (!(curvature > 0.0)) return least;
  const double t = std::clamp(middle - profile.slope(middle) / curvature, low, high);
  return std::min(least, profile.at(t));
}

/// After Ericson, Real-Time Collision Detection (2005), 5.1.9: the lines' nearest points, brought back into the
/// segments one after the other. Parallel lines take any point of the first; the ends decide then.
double distance_square(const Spine& s, const Spine& t) {
  const Vec3 apart = s.a - t.a;
  const double ss = s.way.squaredNorm();
  const double tt = t.way.squaredNorm();
  const double st = s.way.dot(t.way);
  const double down_s = s.way.dot(apart);
  const double down_t = t.way.dot(apart);
  const double square = ss * tt - st * st;
  double best = std::min({distance_square(t, s.a), distance_square(t, s.a + s.way), distance_square(s, t.a),
                          distance_square(s, t.a + t.way)});
  constexpr double nearly_parallel = 1e-24;  // of the sine squared: there the ends are as near, to rounding
  if (!(square > nearly_parallel * ss * tt)) return best;
  const double along_s = (st * down_t - down_s * tt) / square;
  const double along_t = (ss * down_t - st * down_s) / square;
  if (along_s <= 0.0 || along_s >= 1.0 || along_t <= 0.0 || along_t >= 1.0) return best;
  return std::min(best, (apart + along_s * s.way - along_t * t.way).squaredNorm());
}

}  // namespace warren
