// SPDX-License-Identifier: BSD-3-Clause
// How far is a polygon from the obstacles of the plane? Three box trees: convex polygons of up to 16 sides; the sides
// of the other polygons and the walls; those other polygons. Distances are those of core/plane/polygon, less a
// bound of their rounding; only obstacles nearer than the best so far are looked at, so the cost grows with their
// density around the body, not with their number. A pair of sides costs 15 ns. Of a convex polygon a side that has the
// whole body farther before it than asked for settles it, for a product a corner; else only the sides that have a
// corner of the body before them are measured.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "spatial/obstacles/box_tree.hpp"

namespace warren {

/// A polygon body where it stands: its corners, and what finish() makes of them.
struct Footprint {
  explicit Footprint(std::size_t count)
      : corners(count), sides(count), inverse_squares(count), velocities(count), bends(count) {}
  /// To be called when all corners are set.
  void finish();

  std::vector<Vec2> corners;
  std::vector<Vec2> sides;              ///< the vectors to the next corners
  std::vector<double> inverse_squares;  ///< of the sides' lengths; 0 for 0
  Box box;
  /// For ObstacleTree::room: where each corner would be after a unit of time if it went straight on, and how far from
  /// there it is at most, at the time t times t^2.
  std::vector<Vec2> velocities;
  std::vector<double> bends;  ///< see velocities
};

/// How much room a body has to move.
enum class Room : std::uint8_t { blocked, narrow, clear };

/// How long and how far a body moves from where it stands, forwards and backwards in time.
struct Move {
  double time;
  double travel;  ///< no point of the body goes farther
};

/// Immutable after construction; any number of threads may query.
class ObstacleTree {
 public:
  /// Copies walls, polygons and bounds. `reach`: the body's radius and clearance, a car's turning radius, too:
  /// what coordinates may exceed those of the world by. Throws InputError for a polygon that is not simple, Stopped.
  ObstacleTree(const Scene& scene, double reach, const Execution& execution = {});

  /// A lower bound of the distance between the body and the nearest obstacle, within 1e-13 of the coordinates' size;
  /// <= 0 where they touch or overlap, or the body is not wholly in the bounds. Where the distance exceeds `enough`
  /// (>= 0), any number above `enough`.
  double clearance(const Footprint& body, double enough) const;

  /// blocked: the body is at most `reach` (>= 0) away from an obstacle, or not wholly in the bounds; clear: it stays
  /// more than that away for the whole move, for it is farther away than it travels, or a line along a side of the
  /// obstacle stays between the two, as far as the body's velocities and bends let it come. All up to rounding.
  Room room(const Footprint& body, const Move& move, double reach) const;

  /// Convex obstacles, and sides of the others.
  std::size_t piece_count() const { return convex_.size() + sides_.size(); }
  /// Takes the bits of places away at which a convex body, mirrored at its reference point, would come nearer than
  /// `reach` to an obstacle (worlds/rasters/lattice_polygons.hpp); of polygons that aren't convex, to a side.
  void take_blocked_places(std::span<const Vec2> mirrored_body, double reach, PlaceGrid& free) const;

  const std::optional<Box>& bounds() const { return bounds_; }
  /// The box of walls and polygons; empty without any.
  const Box& obstacle_box() const { return box_; }

 private:
  struct Side {
    Vec2 a;
    Vec2 along;                // to the other end
    double inverse_length_sq;  // 0 for sides of length zero
  };
  /// A side of a convex polygon.
  struct ConvexSide {
    Side side;
    Vec2 outward;  // of length 1
  };
  /// Its sides are first .. last - 1 of convex_sides_.
  struct ConvexPolygon {
    std::uint32_t first;
    std::uint32_t last;
    Box box;
  };
  static double distance_sq(const Footprint& body, const Side& side);
  double distance_to(const Footprint& body, const ConvexPolygon& polygon, double enough) const;
  bool swallows(const Footprint& body) const;
  Room room_in_bounds(const Footprint& body, const Move& move, double reach) const;

  std::optional<Box> bounds_;
  Box box_;
  double rounding_ = 0.0;  // no distance is computed further than this from the true one
  BoxTree<2> convex_tree_;
  std::vector<ConvexPolygon> convex_;  // in the tree's order
  std::vector<ConvexSide> convex_sides_;
  BoxTree<2> side_tree_;
  std::vector<Side> sides_;  // in the tree's order
  BoxTree<2> polygon_tree_;
  std::vector<std::vector<Vec2>> polygons_;  // in the tree's order; without the convex ones
};

// What bodies with a heading have in common, however they move: an outline, what is kept around it, and the obstacles
// of the plane. Samples are poses at which the body is in the bounds, if it can be there at that angle; where nothing
// but the obstacles' box confines it, poses whose reference point is in that box.
//
// On a map the body moves among the borders between free and blocked cells, which the scene has as walls
// (worlds/rasters/lattice_polygons.hpp). A body that touches none of them is wholly among free cells or wholly among
// blocked ones: one of its corners tells which.

/// Immutable after construction; one Query a thread.
class BodyAmongObstacles {
 public:
  static constexpr std::size_t dimension = 3;
  using State = Se2;
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
