// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/car_world.hpp"

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "worlds/poses/pose_in_bounds.hpp"

namespace warren {
namespace {

double positive_size(const char* name, double value) {
  if (value > 0.0 && value <= largest_coordinate) return value;
  throw InputError(name, "must be a number above 0, up to 1e60", std::to_string(value));
}

double not_negative(const char* name, double value) {
  if (value >= 0.0 && value <= largest_coordinate) return value;
  throw InputError(name, "must be a number from 0 to 1e60", std::to_string(value));
}

std::vector<Vec2> outline_of(const CarOptions& options, const Execution& execution) {
  if (options.outline.empty()) return {Vec2{}};
  check_body(options.outline, "robot", execution);
  return options.outline;
}

double outline_radius(std::span<const Vec2> outline) {
  double radius = 0.0;
  for (const Vec2 p : outline) radius = std::max(radius, norm(p));
  return radius;
}

/// What planning keeps beyond what it must: a factor, and what the poses of a curve are rounded by.
double planning_reach(const CarOptions& options) {
  constexpr double more = 1e-9;
  const double asked = not_negative("clearance", options.clearance) +
                       (options.outline.empty() ? not_negative("robot: radius", options.radius) : 0.0);
  return asked * (1.0 + more) + more * options.turning_radius;
}

double usual_resolution(const CarOptions& options) {
  constexpr double share = 1e-4;
  const double size = options.outline.empty() ? options.radius : outline_radius(options.outline);
  return share * (size > 0.0 ? size : options.turning_radius);
}

/// How far the body has gone after the way s along a curve, at most.
class BodyTravel {
 public:
  BodyTravel(const CarBody& body, const SteeringCurve& curve) : count_(curve.piece_count()) {
    for (std::size_t i = 0; i < count_; ++i) {
      lengths_[i] = curve.piece_length(i);
      paces_[i] = body.pace(curve.piece(i).steer);
    }
  }
  double operator()(double s) const {
    double travel = 0.0;
    for (std::size_t i = 0; i < count_ && s > 0.0; ++i) {
      travel += paces_[i] * std::min(s, lengths_[i]);
      s -= lengths_[i];
    }
    return travel;
  }

 private:
  std::array<double, SteeringWord::most_pieces> lengths_{};
  std::array<double, SteeringWord::most_pieces> paces_{};
  std::size_t count_;
};

}  // namespace

CarBody::CarBody(const Scene& scene, const CarOptions& options, const Execution& execution)
    : outline_(outline_of(options, execution)),
      turning_radius_(positive_size("robot: turning radius", options.turning_radius)),
      reach_(planning_reach(options)),
      resolution_(positive_size("resolution", options.resolution.value_or(usual_resolution(options)))),
      tree_(scene, outline_radius(outline_) + reach_ + turning_radius_, execution) {
  if (!options.outline.empty()) {
    for (const int side : {-1, 1}) {
      const Vec2 center{0.0, side * turning_radius_};
      for (const Vec2 p : outline_) {
        double& pace = pace_[as_whole<std::size_t>(side + 1)];
        pace = std::max(pace, norm(p - center) / turning_radius_);
      }
    }
  }
  box_ = scene.bounds ? *scene.bounds : tree_.obstacle_box();
  if (box_.empty()) throw InputError("world", "has neither obstacles nor bounds: nothing confines the car");
  map_ = scene.map;
}

Se2 CarBody::at_unit(const std::array<double, 3>& u) const {
  return confined_pose(box_, tree_.bounds().has_value(), outline_, reach_, u);
}

double CarBody::clearance(const Se2& a, double enough, Query& query) const {
  const std::span<Vec2> corners = query.footprint.corners();
  if (corners.size() == 1) {
    corners.front() = a.position();
  } else {
    const Rotation turned(a.theta);
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = a.position() + turned(outline_[i]);
  }
  query.footprint.finish();
  return tree_.clearance(query.footprint, enough + reach_) - reach_;
}

bool CarBody::confines(const Box& way) const {
  constexpr double rounding = 1e-11;
  if (tree_.bounds() || map_) return true;  // they are obstacles like the others, and so is the rim of a map
  const Box room = box_.grown(rounding * (turning_radius_ + box_.width() + box_.height()));
  return room.contains(way.min) && room.contains(way.max);
}

bool CarBody::is_confined(const Se2& a) const {
  if (!map_) return tree_.bounds() || box_.contains(a.position());
  const std::optional<Cell> cell = cell_at(*map_, placed(a, outline_.front()));
  return cell && !map_->blocked.test(cell->x, cell->y);
}

bool CarBody::is_free(const Se2& a, Query& query) const { return is_confined(a) && clearance(a, 0.0, query) > 0.0; }

MotionVerdict CarBody::judge(const SteeringCurve& curve, Query& query) const {
  if (!confines(curve.box())) return MotionVerdict::blocked;
  const BodyTravel travelled(*this, curve);
  const double length = curve.length();
  return certified_motion([&](double t, double enough) { return clearance(curve.at(t * length), enough, query); },
                          [&](double t, double u) { return travelled(u * length) - travelled(t * length); },
                          resolution_);
}

bool CarBody::is_free_curve(const SteeringCurve& curve, Query& query) const {
  const MotionVerdict verdict = judge(curve, query);
  if (verdict == MotionVerdict::refused) ++query.refused;
  return verdict == MotionVerdict::free;
}

}  // namespace warren
