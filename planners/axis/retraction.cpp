// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/retraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plane/geometry.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tolerance = 1e-6;  // of the frame's size: how well a computed point must fit a curve
constexpr double noise = 1e-7;      // of that: p lies on the axis

double distance_to(const AxisSite& site, Vec2 p) { return distance(p, Segment{site.a, site.b}); }

/// Away from the nearest site, from p on.
struct Retraction {
  std::uint32_t site;
  Vec2 from, direction;
  double room;  ///< distance of p to the site

  /// How far the ray goes until the other site is as near; infinite if never.
  double reach(const AxisSite& other) const {
    const Vec2 to_p = from - other.a;
    if (other.is_point()) {
      const double closing = dot(direction, to_p) - room;
      return closing < 0.0 ? 0.5 * (room * room - dot(to_p, to_p)) / closing : infinity;
    }
    const Vec2 along = (1.0 / distance(other.a, other.b)) * (other.b - other.a);
    const double height = cross(along, to_p);
    const double rise = cross(along, direction);
    const double speed = height < 0.0 || (height == 0.0 && rise < 0.0) ? -rise : rise;
    return speed < 1.0 ? (std::abs(height) - room) / (1.0 - speed) : infinity;
  }
};

std::optional<Retraction> retraction_of(const MedialAxis& axis, Vec2 p) {
  const std::vector<VoronoiSite>& sites = axis.sites();
  Retraction best{0, p, {}, infinity};
  for (std::uint32_t s = 0; s < sites.size(); ++s) {
    const double d = distance_to(sites[s].shape, p);
    // An end of a segment is a site of its own, and comes first where both are as near.
    if (d < best.room || (d == best.room && sites[s].shape.is_point())) {
      best.room = d;
      best.site = s;
    }
  }
  const AxisSite& site = sites[best.site].shape;
  const Vec2 away = p - nearest_point(p, {site.a, site.b});
  if (!site.is_point()) {
    const Vec2 along = site.b - site.a;
    Vec2 normal{-along.y, along.x};
    const Vec2 inwards = 0.5 * (axis.frame().min + axis.frame().max) - p;  // for points on the frame
    if (dot(normal, best.room > 0.0 ? away : inwards) < 0.0) normal = -1.0 * normal;
    best.direction = (1.0 / norm(normal)) * normal;
  } else if (best.room > 0.0) {
    best.direction = (1.0 / norm(away)) * away;
  } else {
    return std::nullopt;
  }
  return best;
}

}  // namespace

double clearance_of_leg(const MedialAxis& axis, const Segment& leg) {
  double least = infinity;
  for (std::size_t i = 0; i < axis.true_obstacle_count(); ++i) {
    least = std::min(least, distance(leg, axis.obstacles()[i]));
  }
  return least;
}

std::optional<AxisPlace> retract(const MedialAxis& axis, Vec2 p) {
  const std::optional<Retraction> ray = retraction_of(axis, p);
  if (!ray) return std::nullopt;
  const double fit = tolerance * std::max(axis.frame().width(), axis.frame().height());
  std::optional<AxisPlace> found;
  double nearest = infinity;
  for (std::uint32_t i = 0; i < axis.edges().size(); ++i) {
    const AxisEdge& edge = axis.edges()[i];
    if (edge.site != ray->site && edge.other != ray->site) continue;
    const std::uint32_t other = edge.site == ray->site ? edge.other : edge.site;
    const double reach = std::max(0.0, ray->reach(axis.sites()[other].shape));
    if (!(reach < nearest)) continue;
    const AxisCurve curve = axis.curve(edge);
    const Vec2 hit = p + reach * ray->direction;
    const double low = std::min(curve.first(), curve.last());
    const double high = std::max(curve.first(), curve.last());
    const double parameter = std::clamp(curve.parameter_beside(hit), low, high);
    if (distance(curve.at(parameter), hit) > fit) continue;
    nearest = reach;
    const Vec2 at = curve.at(parameter);
    found = AxisPlace{i, parameter, distance(at, p) <= noise * fit ? p : at};
  }
  return found;
}

}  // namespace warren
