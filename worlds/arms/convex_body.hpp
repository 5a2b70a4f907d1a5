// SPDX-License-Identifier: BSD-3-Clause
// A Solid as what separating planes need of it: which of its points lies farthest in a direction. Spheres and capsules
// are a point or segment, the core, with a round margin; of the others the core is all.
// Cost: some ns; a hull's corners are held sixteen by sixteen, each with a ball around them, and sixteens whose ball
// ends before the best corner so far are passed over: 200 corners cost some 60 ns, 10,000 some 1,000.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "scenes/scene/scene.hpp"

namespace warren {

/// pose * point, the same bytes everywhere: Eigen takes these four numbers a time, in sums that arm64 fuses.
inline Vec3 placed_point(const Eigen::Isometry3d& pose, const Vec3& point) {
  return pose.linear() * point + pose.translation();
}

/// Immutable after construction; any number of threads may ask.
class ConvexBody {
 public:
  /// In the frame that the solid's pose is told in. Numbers are finite, lengths >= 0, a hull has a corner.
  explicit ConvexBody(const Solid& solid);

  /// A point of the core that lies farthest in a direction of any length, up to rounding (a few 1e-16 of its size).
  /// `near` says where a hull is looked at first, any number, and becomes what is best next for a direction much alike.
  Vec3 core_support(const Vec3& direction, std::size_t& near) const;
  Vec3 core_support(const Vec3& direction) const {
    std::size_t near = 0;
    return core_support(direction, near);
  }
  /// The same of the whole body.
  Vec3 support(const Vec3& direction) const;
  /// The body is what is within this of the core; >= 0.
  double margin() const { return margin_; }
  /// Of a ball that holds the body.
  const Vec3& centre() const { return centre_; }
  /// Of that ball.
  double radius() const { return radius_; }
  /// What a support costs against that of a box, about: a hull of 1,000 corners is 2 more than one of few.
  std::size_t cost() const { return 1 + corners_.size() / 32; }

 private:
  static constexpr std::size_t lanes = 16;
  struct Corners {
    std::array<double, lanes> x;
    std::array<double, lanes> y;
    std::array<double, lanes> z;
    Vec3 centre;  // of a ball that holds them
    double radius = 0.0;
  };
  struct Farthest {
    double along;
    Vec3 corner;
  };
  void take_corners(std::vector<Vec3> corners);
  void split_corners(std::vector<Vec3>& corners, std::size_t begin, std::size_t end);
  static void look(const Corners& corners, const Vec3& direction, Farthest& best);
  Vec3 hull_support(const Vec3& direction, std::size_t& near) const;

  Vec3 centre_ = Vec3::Zero();
  std::array<Vec3, 3> edges_;     // the core is the centre and up to so much of each to either side,
  std::size_t edge_count_ = 0;    // of so many,
  bool is_round_ = false;         // and, of a cylinder,
  std::array<Vec3, 2> rim_;       // the disc that these two span;
  std::vector<Corners> corners_;  // of a hull alone what is between these
  double margin_ = 0.0;
  double radius_ = 0.0;
};

}  // namespace warren
