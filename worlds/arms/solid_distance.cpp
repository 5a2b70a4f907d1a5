// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/solid_distance.hpp"

namespace warren {
namespace {

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
