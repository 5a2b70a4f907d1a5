// SPDX-License-Identifier: BSD-3-Clause
// Out of where a car that backs up can hardly move, such as a parking bay with half a metre to spare: by strokes,
// straight or at full lock, each as long as it is certified free. Such strokes are shorter than the motions of a
// lattice, and no sample falls between them. Searched breadth first, so the fewest strokes come first; poses that
// differ by less than a hundredth of a turning radius and of a radian are one, then by less than 0.003 and by 0.001. A
// queue of its own: core's searches have vertices, and a stroke has no end before it is driven.
#include <algorithm>
#include <cmath>
#include <set>

#include "worlds/poses/car_world.hpp"

namespace warren {
namespace {

constexpr double long_stroke = 0.8;                       // in turning radii, as all lengths here
constexpr double short_strokes[] = {0.01, 0.003, 0.001};  // one after the other, until there is a way
constexpr int halvings = 12;
constexpr std::size_t most_poses = 10'000;

class WaysOut {
 public:
  WaysOut(const CarBody& body, const Se2& from, double short_stroke, const Execution& execution)
      : body_(body),
        execution_(execution),
        radius_(body.turning_radius()),
        short_(short_stroke),
        query_(body.make_query()) {
    poses_.push_back({from, 0, Steer::straight, 0});
    is_new(from);
  }

  /// Nothing where the car has a long stroke where it stands.
  std::optional<std::vector<Path<Se2>>> run(std::size_t most) {
    std::vector<Path<Se2>> found;
    for (std::size_t at = 0; at < poses_.size() && found.size() < most; ++at) {
      for (const Steer steer : {Steer::left, Steer::straight, Steer::right}) {
        for (const std::int8_t gear : {std::int8_t{1}, std::int8_t{-1}}) {
          if (gear == poses_[at].gear && steer == poses_[at].steer) continue;  // strokes go as far as they can
          execution_.check();
          const std::optional<Se2> to = longest(poses_[at].pose, steer, gear);
          if (!to) continue;
          if (is_long_) {
            if (at == 0) return std::nullopt;
            if (found.size() < most) found.push_back(way_to(at, *to));
          } else if (poses_.size() < most_poses && is_new(*to)) {
            poses_.push_back({*to, at, steer, gear});
          }
        }
      }
    }
    return found;
  }

 private:
  struct Reached {
    Se2 pose;
    std::size_t parent;
    Steer steer;
    std::int8_t gear;  // of the stroke that led here; 0: none
  };

  Se2 after(const Se2& a, Steer steer, double length) const {
    const Se2 to = after_piece({0.0, 0.0, a.theta}, {steer, length});
    return {a.x + radius_ * to.x, a.y + radius_ * to.y, wrapped_angle(to.theta)};
  }
  /// By the curve that a path's reader makes of both ends.
  bool is_free(const Se2& a, const Se2& b, double length) {
    const SteeringWord word = ReedsSheppCurve::shortest(a, b, radius_);
    const bool is_stroke = word.length <= length * (1.0 + 1e-6) + 8.0 * off_by_rounding(a, b, radius_);
    return is_stroke && body_.is_free_curve({a, b, word, radius_}, query_);
  }
  /// The end of the longest free stroke, up to a thousandth of the long one; sets is_long_.
  std::optional<Se2> longest(const Se2& a, Steer steer, std::int8_t gear) {
    const auto to = [&](double length) { return after(a, steer, gear * length); };
    is_long_ = is_free(a, to(long_stroke), long_stroke);
    if (is_long_) return to(long_stroke);
    double free = 0.0;
    double blocked = long_stroke;
    for (int i = 0; i < halvings && blocked > short_; ++i) {
      const double middle = 0.5 * (free + blocked);
      (is_free(a, to(middle), middle) ? free : blocked) = middle;
    }
    if (free < short_) return std::nullopt;
    return to(free);
  }
  bool is_new(const Se2& pose) {
    const Se2& from = poses_.front().pose;
    const auto part = [&](double x) { return bounded_whole<std::int32_t>(std::floor(x / short_)); };
    return met_.insert({part((pose.x - from.x) / radius_), part((pose.y - from.y) / radius_), part(pose.theta)}).second;
  }
  Path<Se2> way_to(std::size_t at, const Se2& last) const {
    Path<Se2> way{last};
    for (; at != 0; at = poses_[at].parent) way.push_back(poses_[at].pose);
    way.push_back(poses_.front().pose);
    std::reverse(way.begin(), way.end());
    return way;
  }

  const CarBody& body_;
  const Execution& execution_;
  double radius_;
  double short_;  // no stroke is shorter, and poses so near are one
  CarBody::Query query_;
  std::vector<Reached> poses_;  // in the order in which they were reached
  std::set<std::array<std::int32_t, 3>> met_;
  bool is_long_ = false;
};

}  // namespace

std::vector<Path<Se2>> ways_out(const CarBody& body, const Se2& from, std::size_t most, const Execution& execution) {
  for (const double short_stroke : short_strokes) {
    std::optional<std::vector<Path<Se2>>> ways = WaysOut(body, from, short_stroke, execution).run(most);
    if (!ways) break;
    if (!ways->empty()) return *std::move(ways);
  }
  return {};
}

}  // namespace warren
