// SPDX-License-Identifier: BSD-3-Clause
// What bodies with a heading have in common, however they move: an outline, what is kept around it, and the obstacles
// of the plane. Samples are poses at which the body is in the bounds, if it can be there at that angle; where nothing
// but the obstacles' box confines it, poses whose reference point is in that box.
//
// On a map the body moves among the borders between free and blocked cells, which the scene has as walls
// (worlds/rasters/lattice_polygons.hpp). A body that touches none of them is wholly among free cells or wholly among
// blocked ones: one of its corners tells which.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/poses/obstacle_tree.hpp"

namespace warren {

/// Immutable after construction; one Query a thread.
class BodyAmongObstacles {
 public:
  struct Query {
    Footprint footprint;
    std::uint64_t refused = 0;  ///< motions that were neither proved free nor blocked
  };

  /// outline: of a disc its middle. reach: kept around it. further: what coordinates on the body's ways may exceed
  /// those by besides. name: of the body. Copies a map. Throws InputError for polygons that are not simple and where
  /// nothing confines the body, Stopped.
  BodyAmongObstacles(const Scene& scene, std::span<const Vec2> outline, double reach, double further,
                     const std::string& name, const Execution& execution)
      : outline_(outline.begin(), outline.end()),
        reach_(reach),
        tree_(scene, outline_reach(outline) + reach + further, execution),
        box_(scene.bounds ? *scene.bounds : tree_.obstacle_box()),
        map_(scene.map) {
    if (box_.empty()) throw InputError("world", "has neither obstacles nor bounds: nothing confines the " + name);
  }

  Query make_query() const { return {Footprint(outline_.size())}; }
  /// Where the reference point may be at this heading; empty where the bounds are too narrow.
  Box places(double theta) const {
    if (!tree_.bounds()) return box_;
    const Rotation turned(theta);
    Box body;
    for (const Vec2 p : outline_) body.include(turned(p));
    const Box wide = body.grown(reach_);
    return {box_.min - wide.min, box_.max - wide.max};
  }
  /// The pose at u in the unit cube: u[2] says the angle, u[0] and u[1] the place, the middle where there is no room.
  Se2 at_unit(const std::array<double, 3>& u) const {
    const double theta = wrapped_angle((2.0 * u[2] - 1.0) * std::numbers::pi);
    const Box at = places(theta);
    const auto at_share = [](double low, double high, double share) {
      return high > low ? low + share * (high - low) : 0.5 * (low + high);
    };
    return {at_share(at.min.x, at.max.x, u[0]), at_share(at.min.y, at.max.y, u[1]), theta};
  }
  /// Lower bound of the distance to the nearest obstacle less the reach; <= 0: not free. More than `enough` counts as
  /// any number above it.
  double clearance(const Se2& a, double enough, Query& query) const {
    const std::span<Vec2> corners = query.footprint.corners;
    if (corners.size() == 1) {
      corners.front() = a.position();
    } else {
      const Rotation turned(a.theta);
      for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = a.position() + turned(outline_[i]);
    }
    query.footprint.finish();
    return tree_.clearance(query.footprint, enough + reach_) - reach_;
  }
  bool is_free(const Se2& a, Query& query) const { return is_confined(a) && clearance(a, 0.0, query) > 0.0; }

  std::span<const Vec2> outline() const { return outline_; }
  double reach() const { return reach_; }
  const ObstacleTree& obstacles() const { return tree_; }
  const Box& box() const { return box_; }  ///< the bounds, else the box of the obstacles
  const std::optional<OccupancyMap>& map() const { return map_; }

 private:
  /// Is the body where it may be, if it touches no obstacle?
  bool is_confined(const Se2& a) const {
    if (!map_) return tree_.bounds() || box_.contains(a.position());
    const std::optional<Cell> cell = cell_at(*map_, placed(a, outline_.front()));
    return cell && !map_->blocked.test(cell->x, cell->y);
  }

  std::vector<Vec2> outline_;
  double reach_;
  ObstacleTree tree_;
  Box box_;
  std::optional<OccupancyMap> map_;
};

}  // namespace warren
