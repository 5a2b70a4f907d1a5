// SPDX-License-Identifier: BSD-3-Clause
// What a picture shows, as data: a world, what planners made in it, paths and marks, and the words around them. How it
// looks on a page is page.hpp's, how it becomes a file formats/'.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "pictures/model/colors.hpp"
#include "pictures/model/picture_options.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {
/// The shapes of marks: start is a disc, goal a star with five points; a front is a triangle.
enum class MarkShape : std::uint8_t { disc, star, front };

/// The outline around the origin; y up; the star stands on two points, the front points to the right. All look equally
/// large.
std::vector<Vec2> mark_outline(MarkShape shape, double radius);

/// Corners of a circle, anticlockwise from the right where y runs up.
std::vector<Vec2> circle_outline(Vec2 middle, double radius, int corners);

/// A ball that went from a to b (a == b: a ball), the box between these corners, or the face of a body: a triangle,
/// anticlockwise from outside, which is seen from there alone.
struct SeenSolid {
  Vec3 a;                      ///< a ball's first place, or a corner
  Vec3 b;                      ///< its last one, or the corner across, or the next
  double radius = 0.0;         ///< of the ball; < 0: a box or a face
  Rgb color = {};              ///< before light and shade
  Part part = Part::world;     ///< that it goes with
  std::optional<Vec3> c = {};  ///< of a face, the third corner
};

/// Calls take(point, radius) for a ball at either end of its way, or with radius 0 for the corners of anything else.
/// The hull of these is that of the solid.
template <class Take>
void for_each_point(const SeenSolid& s, const Take& take) {
  if (s.radius >= 0.0) {
    take(s.a, s.radius);
    if (s.a != s.b) take(s.b, s.radius);
  } else if (s.c) {
    for (const Vec3& p : {s.a, s.b, *s.c}) take(p, 0.0);
  } else {
    for (int k = 0; k < 8; ++k) {
      take(Vec3{((k & 1) != 0 ? s.a : s.b).x(), ((k & 2) != 0 ? s.a : s.b).y(), ((k & 4) != 0 ? s.a : s.b).z()}, 0.0);
    }
  }
}

/// From space into a picture's world: which axes run right and up, and where the space's zero stands.
struct Projection {
  std::array<int, 2> axes;  ///< right, up
  Vec2 shift;               ///< where zero stands
  /// Where a point is seen.
  Vec2 at(const Vec3& p) const { return shift + Vec2{p[axes[0]], p[axes[1]]}; }
};

/// An arm that moves: where its joints are at moments of its path.
struct MovingArm {
  double radius = 0.0;                 ///< of the line
  std::vector<Projection> views = {};  ///< that show it
  std::vector<double> moments = {};    ///< 0 .. 1, by the way in joint space; as many as spines, none or at least one
  std::vector<Vec3> tools = {};        ///< the tool's way; a line
  std::vector<std::vector<Vec3>> spines = {};  ///< a line through its joints, from the base; all of one size
  std::vector<std::vector<Eigen::Isometry3d>> frames = {};  ///< of the base and its joints, as many as moments
  /// A solid of it, in one of the frames.
  struct Link {
    int frame;                      ///< an index of those of a moment
    std::vector<SeenSolid> shapes;  ///< in it
  };
  std::vector<Link> links = {};  ///< all that are drawn
};

/// A body that moves along a picture's path.
struct MovingBody {
  std::vector<Vec2> outline = {};    ///< around the reference point; empty: a disc
  double radius = 0.0;               ///< of the disc
  bool heads = false;                ///< a disc that has a heading: it is marked
  std::vector<Se2> poses = {};       ///< along the path, at least one; a leg turns the shorter way
  std::vector<double> lengths = {};  ///< of the leg that ends at each pose; the first is 0
};

// Solids of space seen in perspective, as one part of a picture: plain data; formats/solid_raster.cpp draws them.

/// A floor with squares below the solids, and shadows on it, makes depth readable; what is far is paler.
struct SolidView {
  Box box = {};                        ///< in the picture's world: where it stands
  Vec3 target;                         ///< the middle of what is seen
  double reach = 1.0;                  ///< of a ball around the target that just fits into the box, > 0
  double azimuth_rad = 0.0;            ///< where the eye stands, as seen from the target: from x to y
  double rise_rad = 0.0;               ///< and above the floor
  Vec3 floor;                          ///< the corner of the floor with the least x and y
  double floor_side = 1.0;             ///< > 0
  double square = 1.0;                 ///< side of the floor's squares
  std::vector<SeenSolid> solids = {};  ///< all that are seen
  bool is_thinned = false;             ///< lines of a roadmap are thinner and paler, being so many
};

/// Of links and paths that are to be seen, in reaches.
inline constexpr double least_radius = 0.006;

/// The eye is so many reaches away from the target.
inline constexpr double eye_distance = 3.2;

/// Lines or areas of one kind: cells, a visibility graph, a medial axis, bodies along a path.
struct PictureLayer {
  std::string id;                        ///< the SVG group's
  std::string label = {};                ///< in the legend; empty: not there
  std::optional<MarkShape> swatch = {};  ///< in the legend, instead of a line or an area
  Part part = Part::roadmap;             ///< that it goes with
  Rgb color = colors::layer;             ///< of the lines
  double width = widths::edge;           ///< as widths say; 0: no lines
  PolygonSet lines = {};                 ///< each a chain of points; a chain of one point twice is a dot
  bool closed = false;                   ///< the chains are outlines, as all that have a fill are
  std::optional<Rgb> fill = {};          ///< of outlines that do not overlap, or may be taken together
  double opacity = 1.0;                  ///< 0 .. 1
  bool blocks = true;                    ///< an area of Part::world is an obstacle
  bool over_roadmap = false;             ///< drawn after the roadmap's edges
  std::vector<double> opacities = {};    ///< of each chain, times `opacity`; empty: all 1
  /// The turn of the arc that leads to each corner of `lines`, anticlockwise, at most a half turn; 0: a straight.
  /// Empty: all are straight.
  std::vector<double> turns = {};

  /// Those of one chain.
  std::span<const double> turns_of(std::size_t line) const {
    if (turns.empty()) return {};
    return std::span(turns).subspan(lines.first[line], lines.first[line + 1] - lines.first[line]);
  }
};

/// The points with arcs cut into chords that turn by some degrees; turns as in PictureLayer.
std::vector<Vec2> without_arcs(std::span<const Vec2> points, std::span<const double> turns);

/// Radius of the arc that turns by `turn` over a chord.
double arc_radius(Vec2 from, Vec2 to, double turn);

/// A part of the picture with axes of its own.
struct AxesPanel {
  Box box = {};              ///< in the picture's world
  Vec2 origin = {};          ///< where the panel's own zero is
  std::string x_label = {};  ///< below the axis
  std::string y_label = {};  ///< beside the axis
  bool has_ticks = true;     ///< else a frame and the labels alone
};

/// A further picture of an answer: the same world with other layers, without roadmap and path.
struct PicturePage {
  std::string id;                    ///< ends the name of its file
  std::vector<PictureLayer> layers;  ///< in the order in which they are drawn
};

/// Owns all but the scene, which must outlive it.
struct Picture {
  const Scene& scene;                                ///< of a map, the walls shown are those of add_map_walls()
  std::unique_ptr<const Scene> stage = {};           ///< the scene itself, where it is views of a world not plane
  std::optional<PlannedRoadmap<Vec2>> roadmap = {};  ///< of bodies whose states stand in the plane
  std::vector<PictureLayer> layers = {};             ///< in the order in which they are drawn, over the obstacles
  Path<Vec2> path = {};                              ///< of the reference point
  std::vector<double> path_turns = {};               ///< as PictureLayer::turns
  std::optional<Vec2> start = {};                    ///< none: not shown
  std::optional<Vec2> goal = {};                     ///< none: not shown
  std::vector<AxesPanel> panels = {};                ///< empty: one, around all
  std::optional<SolidView> solids = {};              ///< seen in perspective in a box of its own
  std::string path_label = "path";                   ///< as the legend calls it
  std::string title = {};                            ///< the world
  std::string subtitle = {};                         ///< a line or two below the title: planner, samples, length, seed
  std::string description = {};                      ///< in words, for those who can't see it
  MovingBody body = {};                              ///< what goes along the path. Without poses: the path's points
  std::optional<MovingArm> arm = {};                 ///< that goes along a path
  bool moves = false;                                ///< SVG: it is seen moving; HTML has a slider always
  std::vector<PicturePage> pages = {};               ///< what deserves a picture of its own each
};

/// The part of the world that is shown, and what counts as one unit there: a maze's cell, else a fortieth of the
/// extent.
struct Canvas {
  Box box;                        ///< in the world
  double unit = 1.0;              ///< in the world's units
  std::optional<Box> whole = {};  ///< the map that it is the known part of; none: all is shown
};
/// Of what the picture shows. Throws Stopped.
Canvas canvas_of(const Picture& picture, const Execution& execution);

/// For each vertex the rank of its component: the `own` largest ones of two vertices or more are told apart, the
/// largest first, all others have rank `own`. labels: the smallest vertex of each one's component; own >= 1. Throws
/// Stopped.
std::vector<std::uint8_t> component_ranks(std::span<const VertexId> labels, std::uint8_t own,
                                          const Execution& execution);
/// The same as indices of colors::components.
std::vector<std::uint8_t> component_colors(const Graph& graph, const Execution& execution);

// The part of a map that a picture shows: a map server's image often reaches far beyond what its robot has seen.

/// The box, in the world, of all cells that are not unknown, with a fortieth of its longer side around them, two cells
/// at least. Nothing where it would leave out less than a tenth of the map's width and of its height, or where all is
/// unknown. O(cells / 64). Throws Stopped.
std::optional<Box> known_part(const OccupancyMap& map, const Execution& execution);

/// What lies in the box of an outline that is convex (Sutherland and Hodgman, 1974), in the same order; fewer than
/// three points where nothing does.
std::vector<Vec2> part_in_box(std::span<const Vec2> outline, const Box& box);

}  // namespace warren
