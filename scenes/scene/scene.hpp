// SPDX-License-Identifier: BSD-3-Clause
// Everything that a world file can say, as plain data: the common ground of readers, writers, generator and worlds.
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"

namespace warren {

/// A closed ball.
struct Sphere {
  double x;       ///< of the middle
  double y;       ///< of the middle
  double z;       ///< of the middle
  double radius;  ///< >= 0
};

/// A closed box with faces square to the axes.
struct SolidBox {
  std::array<double, 3> low;   ///< least x, y, z
  std::array<double, 3> high;  ///< >= low
};

/// "this is a maze": walls lie on the unit grid, cell centres at 1..cols x 1..rows.
struct MazeHint {
  std::uint32_t rows = 0;  ///< of cells
  std::uint32_t cols = 0;  ///< of cells
  friend bool operator==(const MazeHint&, const MazeHint&) = default;
};

/// Where the walls of a maze of the algorithm mst come from: with the hint's rows and columns all that they follow from
/// (scenes/mazes/spanning_maze.hpp).
struct MazeFormula {
  std::uint64_t seed = 1;  ///< as MazeOptions::seed
  double loops = 0.0;      ///< as MazeOptions::loops
};

/// The file that a maze's walls are in, .maze or .npy, and what tells it from others.
struct PackedMaze {
  std::string file;                   ///< its path
  std::optional<std::uint64_t> hash;  ///< nothing: who reads the walls will know
};

/// arm: a serial chain whose table is in a file. urdf: an arm whose joints and links are in a URDF.
enum class RobotKind : std::uint8_t { point, disc, polygon, car, puma560, arm, urdf };
constexpr auto enum_names(RobotKind) {
  return std::array<std::string_view, 7>{"point", "disc", "polygon", "car", "puma560", "arm", "urdf"};
}

/// A solid that an arm carries.
struct AttachedSolid {
  std::string link;                         ///< that it is fixed to
  Solid solid;                              ///< in that link's frame
  std::vector<std::string> may_touch = {};  ///< links beside that one
};

/// An arm that files describe.
struct ArmFiles {
  std::string urdf;                        ///< a path
  std::string srdf = {};                   ///< a path; empty: none
  std::string group = {};                  ///< of the SRDF; empty: base and tip say what moves, or all joints do
  std::string base = {};                   ///< a link
  std::string tip = {};                    ///< a link
  std::vector<std::string> packages = {};  ///< folders where package:// is looked for, in this order
  std::vector<std::pair<std::string, double>> held = {};  ///< joints outside of the group, and where they are
  std::vector<std::array<std::string, 2>> allowed = {};   ///< pairs of links that may touch, beside the SRDF's
  std::vector<AttachedSolid> attached = {};               ///< what the arm carries
  std::string tool = {};  ///< the link whose frame the tool is; empty: the group's tip, or what hangs on its last joint
  /// Where the URDF's root stands in the world: x, y, z, and a quaternion of any length but 0; none: at 0 0 0.
  std::optional<std::array<double, 7>> base_pose = {};
  /// Names of links that lines of text say, each with its place: one that the robot lacks is refused. MoveIt's are
  /// none of these; one that is lacking is told.
  std::vector<std::pair<std::string, std::string>> said = {};
  std::optional<ArmModel> read = {};  ///< what the files say, where somebody has read them
};

/// A state of an arm by its joints' names: where their order is not known yet.
struct NamedState {
  std::vector<std::string> names;  ///< of joints, none twice
  std::vector<double> values;      ///< as many, radians or metres
};

/// How a car drives: dubins, forwards only; reeds_shepp, backwards too; differential, straight both ways, and it turns
/// on the spot: then its turning radius says what a radian of turning counts.
enum class SteeringKind : std::uint8_t { dubins, reeds_shepp, differential };
constexpr auto enum_names(SteeringKind) {
  return std::array<std::string_view, 3>{"dubins", "reeds-shepp", "differential"};
}

/// A body: what moves. Lengths in the units of the world.
struct RobotSpec {
  RobotKind kind = RobotKind::point;  ///< which of the members below mean something
  double radius = 0.0;                ///< disc, car, links of puma560 and arm; >= 0
  double turning_radius = 0.0;        ///< car; > 0
  double tool = 0.0;                  ///< puma560, arm: tool length; >= 0
  std::vector<Vec2> outline = {};     ///< polygon, around the reference point; a car's too: empty where it is a disc
  SteeringKind steering = SteeringKind::dubins;  ///< car
  std::string limits = {};                       ///< puma560: the name of its joint limits; empty: the classic ones
  std::string table = {};                        ///< arm: the file of its Denavit-Hartenberg table
  bool self_collision = false;                   ///< puma560, arm: may links not touch each other?
  std::optional<ArmFiles> files = {};            ///< urdf
};

/// Raster for the grid planner.
struct GridSpec {
  double cell = 1.0;         ///< > 0
  std::uint32_t angles = 1;  ///< >= 1
};

/// A world as plain data: what blocks, and what its file says of the question.
struct Scene {
  WallSet walls;                       ///< closed segments
  std::vector<ScenePolygon> polygons;  ///< whose open insides are blocked
  std::vector<Segment> seams;   ///< where a polygon with holes was cut into several: no outline of what the file says
  std::vector<Sphere> spheres;  ///< what only arms can meet
  std::vector<SolidBox> boxes;  ///< the same
  std::vector<Solid> solids;    ///< the same: turned boxes, cylinders, capsules, hulls
  std::optional<Box> bounds;    ///< the box that nothing may leave; none: the world has no end
  std::optional<double> clearance;     ///< that the file asks for
  std::optional<MazeHint> maze;        ///< is it a maze, and of which size?
  std::optional<MazeFormula> formula;  ///< of the maze's walls; these may be left out (is_unmade)
  std::optional<PackedMaze> packed;    ///< the same of walls that a file holds
  std::optional<RobotSpec> robot;      ///< that the file asks for; none: a point
  /// Of the arm, beside what its robot's line says: group, where its root stands, joints held, links that may touch,
  /// attached solids; `urdf` is empty. with_what_is_said() joins the two.
  std::optional<ArmFiles> arm;
  std::vector<double> start;                     ///< 2, 3 or 6 numbers, of an arm of files up to 14; empty: none
  std::vector<double> goal;                      ///< the same; an arm's 3 are a place of its tool
  std::optional<NamedState> named_start;         ///< instead of `start`
  std::vector<std::vector<double>> other_goals;  ///< beside `goal`, of the plane; any of them
  std::vector<NamedState> named_goals;           ///< instead of `goal`; any of them
  std::optional<Eigen::Isometry3d> goal_pose;    ///< of the arm's tool, instead of `goal`
  std::optional<GridSpec> grid;                  ///< that the file asks for
  Prices prices;                                 ///< of places and of nearness, that the file asks for
  /// Cells instead of walls and polygons. Walls beside a map are its own borders (add_map_walls) and no obstacles more.
  std::optional<OccupancyMap> map;
  std::string source;  ///< file name or maze:... as given
};

/// "point", "disc 0.2", …: what a scene's line says behind `robot`, and answers say; no negative zeros. Attached solids
/// have lines of their own.
std::string robot_text(const RobotSpec& robot);

/// "polygon" and "car" turn, so their states have an angle; 2, 3 or 6 numbers.
std::size_t state_size(const RobotSpec& robot);

/// The robot with what the scene says of its arm (Scene::arm) in its files; others as they are.
RobotSpec with_what_is_said(RobotSpec robot, const Scene& scene);

/// The robot without what the scene says of its arm, and without what its files say: for a scene that says other
/// things.
RobotSpec without_what_is_said(RobotSpec robot, const Scene& scene);

/// A 64-bit hash of everything that shapes the free space (walls in order, polygons, solids, bounds, what an arm
/// carries), as 16 hex digits: the same for the same world whatever file it came from and however its walls are held.
/// Words are folded by wide multiplications (as wyhash does), chunk by chunk in parallel; about memory speed. Not for
/// adversaries. Of walls that are left out: of their formula or file, another number than of the walls.
std::string scene_hash(const Scene& scene, const Execution& execution = {});

/// Are the walls left out, because they are many and can be had tile by tile?
inline bool is_unmade(const Scene& scene) { return (scene.formula || scene.packed) && scene.walls.size() == 0; }

/// What scene_hash says of a maze whose walls are left out, whether they are or not; needs formula or packed.
/// Empty where the file has not been read.
std::string unmade_hash(const Scene& scene);

// The hash of walls that follow each other, wall by wall: a chunk of scene_hash()'s, also for whoever holds no walls.

/// Two words in one: the halves of their product.
inline std::uint64_t folded_words(std::uint64_t a, std::uint64_t b) {
  __extension__ using Wide = unsigned __int128;
  const Wide product = static_cast<Wide>(a) * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}
/// The words of a double, where -0 is 0; never equal to a secret, which are no doubles of a sane size.
inline std::uint64_t hashed_word(double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }

/// What the words of a wall are mixed with.
inline constexpr std::uint64_t fold_secret_a = 0xa0761d6478bd642fU;
/// The same for every other word.
inline constexpr std::uint64_t fold_secret_b = 0xe7037ed1a0b428dbU;

/// A chunk of walls as far as it has come.
struct WallsChunk {
  std::uint64_t first = fold_secret_a;   ///< of the walls' first ends
  std::uint64_t second = fold_secret_b;  ///< of their second ends
  std::size_t walls = 0;                 ///< how many they are

  /// The next wall, which the caller counts.
  void fold(const Segment& s) {
    first = folded_words(hashed_word(s.a.x) ^ fold_secret_a, hashed_word(s.a.y) ^ first);
    second = folded_words(hashed_word(s.b.x) ^ fold_secret_b, hashed_word(s.b.y) ^ second);
  }
  /// Those that follow.
  template <class Wall>
  void add(std::span<const Wall> more);
  /// What the chunk adds to the hash.
  std::uint64_t value() const { return folded_words(first ^ fold_secret_b, second ^ fold_secret_a ^ walls); }
};

/// scene_hash() of walls that nobody holds all at once.
class WallsHash {
 public:
  static constexpr std::size_t grain = std::size_t{1} << 16;  ///< walls of each chunk but the last
  /// walls: how many there are in all.
  explicit WallsHash(std::size_t walls) : state_(walls) {}
  /// Those that follow: of PackedWall, FloatWall or DoubleWall. Whole chunks are hashed on all threads. Throws Stopped.
  template <class Wall>
  void add(std::span<const Wall> walls, const Execution& execution);
  /// The value of the chunk that follows, for whoever folds it.
  void add(std::uint64_t chunk) { state_ = folded_words(state_ ^ fold_secret_a, chunk ^ fold_secret_b); }
  /// The first walls of the chunk that follows.
  void begin(const WallsChunk& chunk) { open_ = chunk; }
  /// After all walls: as scene_hash() of a scene that has them, and beside them what `beside` has.
  std::string text(const Scene& beside = {}) const;

 private:
  std::uint64_t state_;
  WallsChunk open_;
};

/// A copy without what can be large: walls, seams, cells of a map.
Scene without_arrays(const Scene& scene);

/// Is there anything that only a body in space can meet?
inline bool has_solids(const Scene& scene) {
  return !scene.spheres.empty() || !scene.boxes.empty() || !scene.solids.empty();
}

/// The box of all walls; empty if there are none.
Box box_of_walls(const WallSet& walls, const Execution& execution);
/// The box of all walls and polygons (not of the bounds, nor of solids); empty if there are none.
Box obstacle_box(const Scene& scene, const Execution& execution = {});

/// The four sides of the bounds as walls; none without bounds.
std::vector<Segment> bounds_walls(const Scene& scene);

/// The value, if it is above 0, or 0 where that may be, up to largest_coordinate; else throws InputError naming it.
double checked_length(const char* name, double value, bool may_be_zero);
/// The same of a clearance that a body shall keep, which may be 0.
double checked_clearance(double clearance);

/// What a unit of a scene's coordinates is called, where its file says so. "cells" of mazes, of Moving AI's maps and of
/// images, "m" of maps of map_server; "": nobody says.
inline std::string_view unit_of(const Scene& scene) {
  if (scene.maze) return "cells";
  if (!scene.map) return {};
  return scene.map->format == MapFormat::ros ? "m" : "cells";
}

/// " m" behind lengths that are metres; nothing behind others, whose unit is that of all coordinates.
inline std::string_view metres_behind(std::string_view unit) { return unit == "m" ? " m" : ""; }

// A Denavit-Hartenberg table of a serial chain of revolute joints, as plain data: what planners and judges of arms have
// in common. What it means is said in worlds/arms/serial_chain.hpp.

/// Joints that a Denavit-Hartenberg table may have; states of its arm have as many numbers.
inline constexpr std::size_t most_chain_joints = 6;

/// Where a joint's frame stands: at its far end (standard), or at its near one (modified, as Craig has it).
enum class DhConvention : std::uint8_t { standard, modified };

/// A row of the table: lengths in the world's unit, angles in radians. Limits are of q, without the offset.
struct DhJoint {
  double d = 0.0;           ///< along the joint's axis
  double a = 0.0;           ///< length of the link
  double alpha_rad = 0.0;   ///< twist of the link
  double low_rad = 0.0;     ///< finite
  double high_rad = 0.0;    ///< >= low_rad
  double offset_rad = 0.0;  ///< is added to q
};

/// A serial chain of revolute joints.
struct DhTable {
  DhConvention convention = DhConvention::standard;        ///< how its rows are read
  std::vector<DhJoint> joints;                             ///< 1 .. most_chain_joints
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();  ///< from the last frame
};

}  // namespace warren
