// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/lines_side_by_side.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

namespace warren {
namespace {

using Leg = std::array<double, 4>;               // of its ends, the lesser first
using PathNumbers = std::vector<std::uint32_t>;  // ascending, each once

constexpr std::size_t legs_per_poll = 1 << 12;

Leg leg_between(Vec2 a, Vec2 b) {
  if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
  return {a.x, a.y, b.x, b.y};
}

/// Paths with a corner wherever one of them has one on a leg of another (or of its own), so that legs which overlap
/// become legs that are the same. Corners lie on a raster below what is seen: paths that are pulled taut by different
/// ways differ by a millionth.
class PathsCut {
 public:
  PathsCut(std::span<const std::vector<Vec2>> paths, const Execution& execution) : execution_(execution) {
    Box box;
    for (const std::vector<Vec2>& path : paths) {
      for (const Vec2 p : path) box.include(p);
    }
    const double extent = box.empty() ? 0.0 : std::max(box.width(), box.height());
    constexpr int bits = 14;
    if (extent > 0.0) step_ = std::ldexp(1.0, std::ilogb(extent) - bits);
    for (const std::vector<Vec2>& path : paths) {
      std::vector<Vec2>& on_raster = paths_.emplace_back();
      for (const Vec2 p : path) on_raster.push_back(rounded(p));
      by_x_.insert(by_x_.end(), on_raster.begin(), on_raster.end());
    }
    by_y_ = by_x_;
    sort(by_x_, x_first);
    sort(by_y_, y_first);
  }

  std::vector<std::vector<Vec2>> take() {
    std::vector<std::vector<Vec2>> all;
    for (const std::vector<Vec2>& path : paths_) {
      std::vector<Vec2>& cut = all.emplace_back();
      for (std::size_t k = 0; k < path.size(); ++k) {
        if (k > 0 && !(path[k - 1] == path[k])) add_corners_between(path[k - 1], path[k], cut);
        cut.push_back(path[k]);
      }
    }
    return all;
  }

 private:
  static bool x_first(Vec2 a, Vec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); }
  static bool y_first(Vec2 a, Vec2 b) { return std::pair(a.y, a.x) < std::pair(b.y, b.x); }
  template <class Less>
  static void sort(std::vector<Vec2>& points, const Less& less) {
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  Vec2 rounded(Vec2 p) const {
    if (step_ == 0.0) return p;
    return {std::nearbyint(p.x / step_) * step_, std::nearbyint(p.y / step_) * step_};
  }
  template <class Less>
  static std::span<const Vec2> range(const std::vector<Vec2>& points, Vec2 low, Vec2 high, const Less& less) {
    const auto first = std::lower_bound(points.begin(), points.end(), low, less);
    return std::span(first, std::upper_bound(first, points.end(), high, less));
  }
  /// All corners that may lie on the leg: the fewer of those in its columns and in its rows.
  std::span<const Vec2> near(Vec2 a, Vec2 b) const {
    const Vec2 low{std::min(a.x, b.x), std::min(a.y, b.y)};
    const Vec2 high{std::max(a.x, b.x), std::max(a.y, b.y)};
    if (a.x == b.x) return range(by_x_, low, high, x_first);
    if (a.y == b.y) return range(by_y_, low, high, y_first);
    constexpr double endless = std::numeric_limits<double>::infinity();
    const auto columns = range(by_x_, {low.x, -endless}, {high.x, endless}, x_first);
    const auto rows = range(by_y_, {-endless, low.y}, {endless, high.y}, y_first);
    return columns.size() < rows.size() ? columns : rows;
  }
  void add_corners_between(Vec2 a, Vec2 b, std::vector<Vec2>& cut) {
    const Vec2 leg = b - a;
    const double reach = 2.0 * step_ * norm(leg);
    std::vector<std::pair<double, Vec2>> on_leg;
    for (const Vec2 p : near(a, b)) {
      if (++polled_ % legs_per_poll == 0) execution_.check();
      const double along = dot(p - a, leg);
      if (!(p == a) && !(p == b) && along > 0.0 && along < dot(leg, leg) && std::abs(cross(leg, p - a)) <= reach) {
        on_leg.emplace_back(along, p);
      }
    }
    std::sort(on_leg.begin(), on_leg.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [along, p] : on_leg) cut.push_back(p);
  }

  const Execution& execution_;
  double step_ = 0.0;
  std::vector<std::vector<Vec2>> paths_;
  std::vector<Vec2> by_x_;
  std::vector<Vec2> by_y_;
  std::size_t polled_ = 0;
};

class SharedLegs {
 public:
  SharedLegs(std::span<const std::vector<Vec2>> paths, double dash, const Execution& execution)
      : paths_(paths), dash_(dash), execution_(execution), shown_(paths.size()) {
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
      for_each_leg(i, [&](Vec2 a, Vec2 b) {
        PathNumbers& users = users_[leg_between(a, b)];
        if (users.empty() || users.back() != i) users.push_back(i);
      });
    }
  }

  /// The first path along a run of legs with the same users draws it for all of them.
  std::vector<PolygonSet> take() {
    for (std::uint32_t i = 0; i < paths_.size(); ++i) {
      std::vector<Vec2> run;
      const PathNumbers* along = nullptr;
      for_each_leg(i, [&](Vec2 a, Vec2 b) {
        const PathNumbers& users = users_.at(leg_between(a, b));
        if (along == nullptr || *along != users) {
          end_run(i, along, run);
          run = {a};
          along = &users;
        }
        run.push_back(b);
      });
      end_run(i, along, run);
    }
    return std::move(shown_);
  }

 private:
  template <class Visit>
  void for_each_leg(std::uint32_t i, const Visit& visit) const {
    const std::vector<Vec2>& path = paths_[i];
    for (std::size_t k = 1; k < path.size(); ++k) {
      if (k % legs_per_poll == 0) execution_.check();
      if (!(path[k - 1] == path[k])) visit(path[k - 1], path[k]);
    }
  }
  void end_run(std::uint32_t path, const PathNumbers* users, const std::vector<Vec2>& run) {
    if (users == nullptr || users->front() != path) return;
    if (users->size() == 1) return shown_[path].add(run);
    take_turns(*users, run);
  }
  /// Dashes of equal length, as many for each.
  void take_turns(const PathNumbers& users, const std::vector<Vec2>& run) {
    double length = 0.0;
    for (std::size_t k = 1; k < run.size(); ++k) length += distance(run[k - 1], run[k]);
    const auto rounds = std::max(std::round(length / dash_ / static_cast<double>(users.size())), 1.0);
    const auto dashes = static_cast<std::size_t>(rounds) * users.size();
    const double each = length / static_cast<double>(dashes);
    std::vector<Vec2> dash{run.front()};
    std::size_t drawn = 0;
    double walked = 0.0;
    for (std::size_t k = 1; k < run.size(); ++k) {
      const double leg = distance(run[k - 1], run[k]);
      for (; drawn + 1 < dashes && each * static_cast<double>(drawn + 1) < walked + leg; ++drawn) {
        const double share = (each * static_cast<double>(drawn + 1) - walked) / leg;
        const Vec2 end = run[k - 1] + share * (run[k] - run[k - 1]);
        dash.push_back(end);
        shown_[users[drawn % users.size()]].add(dash);
        dash = {end};
      }
      walked += leg;
      dash.push_back(run[k]);
    }
    shown_[users[drawn % users.size()]].add(dash);
  }

  std::span<const std::vector<Vec2>> paths_;
  double dash_;
  const Execution& execution_;
  std::map<Leg, PathNumbers> users_;
  std::vector<PolygonSet> shown_;
};

}  // namespace

std::vector<PolygonSet> lines_side_by_side(std::span<const std::vector<Vec2>> paths, double dash,
                                           const Execution& execution) {
  const std::vector<std::vector<Vec2>> cut = PathsCut(paths, execution).take();
  return SharedLegs(cut, dash, execution).take();
}

}  // namespace warren
