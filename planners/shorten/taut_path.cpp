// SPDX-License-Identifier: BSD-3-Clause
#include "planners/shorten/taut_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/trigonometry.hpp"
#include "parallel/chunks.hpp"
#include "planners/shorten/taut_string.hpp"

namespace warren {
namespace {

using Stop = TautString::Stop;

constexpr double widest_step = 0.16;         // radians of an arc for one tangent
constexpr double widest_tiny_step = 1.2;     // the same with clearance 0, where an arc's length is next to nothing
constexpr std::size_t most_tangents = 1024;  // times as many as that, where room is scarce
constexpr std::size_t grain = 1024;

/// Without points that repeat the last one or lie between their neighbours on a line parallel to an axis: there it is
/// certain that the longer leg is as free as its parts.
Path<Vec2> corners_of(std::span<const Vec2> path) {
  const auto between = [](Vec2 a, Vec2 b, Vec2 c) {
    const bool upright = a.x == b.x && b.x == c.x && (b.y - a.y) * (c.y - b.y) > 0.0;
    const bool level = a.y == b.y && b.y == c.y && (b.x - a.x) * (c.x - b.x) > 0.0;
    return upright || level;
  };
  Path<Vec2> corners;
  for (const Vec2 p : path) {
    if (!corners.empty() && p == corners.back()) continue;
    if (corners.size() > 1 && between(corners[corners.size() - 2], corners.back(), p)) corners.pop_back();
    corners.push_back(p);
  }
  return corners;
}

double length_of(std::span<const Vec2> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

class Pulling {
 public:
  Pulling(const WallIndex& walls, std::span<const Vec2> path, double clearance, const Execution& execution)
      : walls_(walls), clearance_(clearance), execution_(execution) {
    for (const Vec2 p : path) box_.include(p);
    const Vec2 far{std::max(std::abs(box_.min.x), std::abs(box_.max.x)),
                   std::max(std::abs(box_.min.y), std::abs(box_.max.y))};
    rounding_ = 4e-16 * std::max(far.x, far.y);
    least_ = clearance > 0.0 ? clearance * (1.0 - 1e-9) : margin_of(path);
    // A little more than is asked for, so that rounded tangents keep what is asked for.
    radius_ = least_ * (1.0 + 5e-9) + 8.0 * rounding_;
  }

  /// Appends the taut path along `points` but for its first point. Where something fails the check, the halves are
  /// pulled by themselves; what can't be halved stays as it was.
  void append(std::span<const Vec2> points, Path<Vec2>& result) {
    if (points.size() > 2) {
      std::vector<Vec2> taut = pulled(points);
      if (taut.empty()) {
        const std::size_t half = points.size() / 2;
        append(points.first(half + 1), result);
        append(points.subspan(half), result);
        return;
      }
      if (length_of(taut) < length_of(points)) {
        result.insert(result.end(), taut.begin() + 1, taut.end());
        return;
      }
    }
    result.insert(result.end(), points.begin() + 1, points.end());
  }

 private:
  bool keeps(std::span<const Vec2> path, double clearance, std::vector<std::uint8_t>* bad_legs) const {
    std::vector<std::uint8_t> bad(path.size() - 1, 0);
    for_chunks(bad.size(), grain, execution_, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; ++i) {
        bad[i] = walls_.keeps_clearance(path[i], path[i + 1], clearance) ? 0 : 1;
      }
    });
    const bool all = std::find(bad.begin(), bad.end(), 1) == bad.end();
    if (bad_legs != nullptr) *bad_legs = std::move(bad);
    return all;
  }

  /// For clearance 0: a small distance that the whole path keeps.
  double margin_of(std::span<const Vec2> path) const {
    double margin = 1e-6 * wall_spacing(walls_);
    while (margin > rounding_ && !keeps(path, margin, nullptr)) margin /= 8.0;
    return margin;
  }

  /// The polyline around the stops, stop i's arc by at least tangents[i] times the usual number of tangents;
  /// from_stop[j] is the stop of its point j.
  std::vector<Vec2> polyline(const TautString& string, const std::vector<Stop>& stops,
                             const std::vector<std::size_t>& tangents, std::vector<std::size_t>& from_stop) const {
    std::vector<Vec2> points;
    from_stop.clear();
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const Stop& stop = stops[i];
      if (stop.turn == 0.0) {
        points.push_back(inside_box(stop.center));
      } else {
        append_arc(stop, string.tangent(stops[i - 1], stop).to - stop.center, tangents[i], points);
      }
      from_stop.resize(points.size(), i);
    }
    return points;
  }

  /// Corners of the tangents at the arc that begins at `spoke` from the disc's center.
  void append_arc(const Stop& stop, Vec2 spoke, std::size_t finer, std::vector<Vec2>& points) const {
    const double arc = std::max(stop.arc, 0.0);
    const double count = static_cast<double>(finer) *
                         std::max(1.0, std::ceil(arc / (clearance_ > 0.0 ? widest_step : widest_tiny_step)));
    const double half = 0.5 * arc / count;
    for (double i = 0.0; i < count; i += 1.0) {
      const double angle = stop.turn * (2.0 * i + 1.0) * half;
      const double stretch = 1.0 / portable::cos(half);
      const auto [sine, cosine] = portable::sin_and_cos(angle);
      const Vec2 to{cosine * spoke.x - sine * spoke.y, sine * spoke.x + cosine * spoke.y};
      points.push_back(inside_box(stop.center + stretch * to));
    }
  }

  /// From the string's coordinates to the world's.
  Vec2 inside_box(Vec2 p) const {
    p = p + box_.min;
    return {std::clamp(p.x, box_.min.x, box_.max.x), std::clamp(p.y, box_.min.y, box_.max.y)};
  }

  /// The checked taut path along the points; empty if there is none.
  std::vector<Vec2> pulled(std::span<const Vec2> points) const {
    TautString string(walls_, radius_, least_, box_.min);
    const std::vector<Stop> stops = string.pull(points, execution_);
    std::vector<std::size_t> tangents(stops.size(), 1);
    std::vector<std::size_t> from_stop;
    std::vector<std::uint8_t> bad;
    for (std::size_t finest = 1; finest <= most_tangents; finest *= 4) {
      std::vector<Vec2> path = polyline(string, stops, tangents, from_stop);
      path.front() = points.front();
      path.back() = points.back();
      if (keeps(path, clearance_, &bad)) return path;
      for (std::size_t leg = 0; leg < bad.size(); ++leg) {
        if (bad[leg] != 0) tangents[from_stop[leg]] = tangents[from_stop[leg + 1]] = 4 * finest;
      }
    }
    return {};
  }

  const WallIndex& walls_;
  double clearance_;
  const Execution& execution_;
  Box box_;
  double rounding_ = 0.0;  ///< of a coordinate
  double least_ = 0.0;     ///< distance that the given path keeps
  double radius_ = 0.0;    ///< distance that the taut one is to keep
};

}  // namespace

Path<Vec2> taut_path(const WallIndex& walls, std::span<const Vec2> path, double clearance, const Execution& execution) {
  const Path<Vec2> corners = corners_of(path);
  if (corners.size() < 3) return corners;
  Path<Vec2> result{corners.front()};
  Pulling(walls, corners, clearance, execution).append(corners, result);
  return result;
}

}  // namespace warren
