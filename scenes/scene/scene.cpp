// SPDX-License-Identifier: BSD-3-Clause
// Box and hash of a scene. Walls are hashed as the doubles that they mean (-0 as 0), so floats and doubles agree; each
// wall costs two 64 x 64 -> 128 bit multiplications in two independent chains, and chunks are folded in their order.
#include "scenes/scene/scene.hpp"

#include "core/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <set>

#include "core/base/rng.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// Folds numbers, and how many there are, into a hash.
class Hasher {
 public:
  explicit Hasher(std::uint64_t state) : state_(state) {}
  void add(std::uint64_t bits) { state_ = folded_words(state_ ^ fold_secret_a, bits ^ fold_secret_b); }
  void add(double x) { add(hashed_word(x)); }
  template <class Numbers>
  void add_each(const Numbers& numbers) {
    for (const double x : numbers) add(x);
  }
  std::uint64_t value() const { return mix64(state_); }

 private:
  std::uint64_t state_;
};

/// The numbers that shape it: those of its pose, of its size, and its corners.
void add_solid(Hasher& hasher, const Solid& solid) {
  hasher.add(std::uint64_t{static_cast<std::uint8_t>(solid.kind)});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) hasher.add(solid.pose(row, column));
  }
  hasher.add_each(solid.half);
  hasher.add(std::uint64_t{solid.corners.size()});
  for (const Vec3& corner : solid.corners) hasher.add_each(corner);
}

void add_word(Hasher& hasher, std::string_view word) {
  hasher.add(std::uint64_t{word.size()});
  for (const char letter : word) hasher.add(std::uint64_t{static_cast<unsigned char>(letter)});
}

/// Of blocked and water cells and of the map's place.
std::string map_hash(const OccupancyMap& map, const Execution& execution) {
  std::uint64_t hash = mix64(map.blocked.size() ^ (std::uint64_t{map.width()} << 32));
  std::uint64_t words = 0;
  const auto add = [&](std::uint64_t word) {
    execution.poll(words++);
    hash = mix64(hash * 0x9e3779b97f4a7c15U + word);
  };
  for (const std::uint64_t word : map.blocked.words()) add(word);
  for (const std::uint64_t word : map.water.words()) add(word);
  for (const double number : {map.cell, map.origin.x, map.origin.y, map.yaw_rad}) {
    add(std::bit_cast<std::uint64_t>(number + 0.0));
  }
  return fmt::format("{:016x}", hash);
}

std::string outline_words(const RobotSpec& robot) {
  std::string words = "polygon";
  for (const Vec2 p : robot.outline) words += fmt::format(" {} {}", p.x + 0.0, p.y + 0.0);
  return words;
}

/// The steering only where it is not the usual one.
std::string car_words(const RobotSpec& robot) {
  const std::string body = robot.outline.empty() ? fmt::format("radius {}", robot.radius + 0.0) : outline_words(robot);
  const std::string words = fmt::format("car {} turning {}", body, robot.turning_radius + 0.0);
  return robot.steering == SteeringKind::dubins ? words : fmt::format("{} steering {}", words, name_of(robot.steering));
}

std::string arm_words(const RobotSpec& robot) {
  std::string words = robot.kind == RobotKind::arm ? "arm " + robot.table : "puma560";
  words += fmt::format(" radius {} tool {}", robot.radius + 0.0, robot.tool + 0.0);
  if (!robot.limits.empty()) words += " limits " + robot.limits;
  if (robot.self_collision) words += " self-collision";
  return words;
}

std::string urdf_words(const ArmFiles& files) {
  std::string words = "urdf " + files.urdf;
  const auto add = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) words += fmt::format(" {} {}", name, value);
  };
  add("srdf", files.srdf);
  add("group", files.group);
  add("base", files.base);
  add("tip", files.tip);
  add("tool", files.tool);
  for (const std::string& package : files.packages) add("package-path", package);
  if (files.base_pose) words += " base-pose";
  for (const double x : files.base_pose ? std::span<const double>(*files.base_pose) : std::span<const double>())
    words += fmt::format(" {}", x + 0.0);
  for (const auto& [joint, value] : files.held) words += fmt::format(" hold {} {}", joint, value + 0.0);
  for (const auto& [one, other] : files.allowed) words += fmt::format(" allow {} {}", one, other);
  return words;
}

}  // namespace

std::string robot_text(const RobotSpec& robot) {
  if (robot.kind == RobotKind::point) return "point";
  if (robot.kind == RobotKind::disc) return fmt::format("disc {}", robot.radius + 0.0);
  if (robot.kind == RobotKind::polygon) return outline_words(robot);
  if (robot.kind == RobotKind::car) return car_words(robot);
  return robot.kind == RobotKind::urdf ? urdf_words(*robot.files) : arm_words(robot);
}

std::size_t state_size(const RobotSpec& robot) {
  if (robot.kind == RobotKind::point || robot.kind == RobotKind::disc) return 2;
  if (robot.kind == RobotKind::polygon || robot.kind == RobotKind::car) return 3;
  if (robot.kind != RobotKind::urdf) return most_chain_joints;
  return robot.files && robot.files->read ? robot.files->read->variables.size() : most_joints;
}

RobotSpec with_what_is_said(RobotSpec robot, const Scene& scene) {
  if (!robot.files || robot.files->read || !scene.arm) return robot;
  ArmFiles& files = *robot.files;
  const ArmFiles& said = *scene.arm;
  const bool has_group = !files.group.empty() || !files.base.empty() || !files.tip.empty();
  if (!has_group) files.group = said.group;
  if (files.tool.empty()) files.tool = said.tool;
  if (!files.base_pose) files.base_pose = said.base_pose;
  for (const auto& joint : said.held) {
    const auto same = [&](const auto& other) { return other.first == joint.first; };
    if (std::ranges::none_of(files.held, same)) files.held.push_back(joint);
  }
  const std::set<std::array<std::string, 2>> own(files.allowed.begin(), files.allowed.end());
  std::ranges::copy_if(said.allowed, std::back_inserter(files.allowed),
                       [&](const auto& p) { return !own.contains(p); });
  files.attached.insert(files.attached.end(), said.attached.begin(), said.attached.end());
  files.said.insert(files.said.end(), said.said.begin(), said.said.end());
  return robot;
}

RobotSpec without_what_is_said(RobotSpec robot, const Scene& scene) {
  if (!robot.files) return robot;
  ArmFiles& files = *robot.files;
  files.read.reset();
  if (!scene.arm) return robot;
  std::erase_if(files.held, [&](const auto& joint) { return std::ranges::count(scene.arm->held, joint) > 0; });
  const std::set<std::array<std::string, 2>> said(scene.arm->allowed.begin(), scene.arm->allowed.end());
  std::erase_if(files.allowed, [&](const auto& pair) { return said.contains(pair); });
  if (files.group == scene.arm->group) files.group.clear();
  if (files.tool == scene.arm->tool) files.tool.clear();
  if (files.base_pose == scene.arm->base_pose) files.base_pose.reset();
  files.attached.clear();
  files.said.clear();
  return robot;
}

std::string unmade_hash(const Scene& scene) {
  if (scene.packed) return scene.packed->hash ? fmt::format("{:016x}", *scene.packed->hash) : std::string();
  Hasher hasher(std::uint64_t{0x6d7374});  // "mst"
  hasher.add(std::uint64_t{scene.maze->rows});
  hasher.add(std::uint64_t{scene.maze->cols});
  hasher.add(scene.formula->seed);
  hasher.add(scene.formula->loops);
  return fmt::format("{:016x}", hasher.value());
}

std::string scene_hash(const Scene& scene, const Execution& execution) {
  if (is_unmade(scene)) return unmade_hash(scene);
  if (scene.map) return map_hash(*scene.map, execution);
  WallsHash hash(scene.walls.size());
  scene.walls.visit([&](auto walls) { hash.add(walls, execution); });
  return hash.text(scene);
}

template <class Wall>
void WallsChunk::add(std::span<const Wall> more) {
  WallsChunk all = *this;  // in registers
  for (const Wall& wall : more) all.fold(wall.segment());
  all.walls += more.size();
  *this = all;
}

template <class Wall>
void WallsHash::add(std::span<const Wall> walls, const Execution& execution) {
  execution.check();
  if (open_.walls > 0) {
    const std::span<const Wall> more = walls.first(std::min(walls.size(), grain - open_.walls));
    walls = walls.subspan(more.size());
    open_.add(more);
    if (open_.walls < grain) return;
    add(std::exchange(open_, WallsChunk{}).value());
  }
  const std::size_t whole = walls.size() / grain * grain;
  const auto chunk_of = [&](Range r) {
    WallsChunk chunk;
    chunk.add(walls.subspan(r.first, r.size()));
    return chunk;
  };
  for (const WallsChunk& chunk : parts_of_chunks(whole, grain, execution, chunk_of)) add(chunk.value());
  open_.add(walls.subspan(whole));
}

template void WallsHash::add(std::span<const PackedWall>, const Execution&);
template void WallsHash::add(std::span<const FloatWall>, const Execution&);
template void WallsHash::add(std::span<const DoubleWall>, const Execution&);

std::string WallsHash::text(const Scene& beside) const {
  Hasher hasher(state_);
  if (open_.walls > 0) hasher.add(open_.value());
  hasher.add(std::uint64_t{beside.polygons.size()});
  for (const ScenePolygon& polygon : beside.polygons) {
    hasher.add(std::uint64_t{polygon.corners.size()});
    for (const Vec2 corner : polygon.corners) hasher.add_each(std::array{corner.x, corner.y});
  }
  hasher.add(std::uint64_t{beside.spheres.size()});
  for (const Sphere& s : beside.spheres) hasher.add_each(std::array{s.x, s.y, s.z, s.radius});
  for (const SolidBox& box : beside.boxes) {  // nothing where there are none: worlds keep the hash they have
    hasher.add_each(box.low);
    hasher.add_each(box.high);
  }
  for (const Solid& solid : beside.solids) add_solid(hasher, solid);
  if (beside.arm) {  // what it carries; what else a world says of an arm, its robot's words say, too
    for (const AttachedSolid& attached : beside.arm->attached) {
      add_word(hasher, attached.link);
      for (const std::string& link : attached.may_touch) add_word(hasher, link);
      add_solid(hasher, attached.solid);
    }
  }
  hasher.add(std::uint64_t{beside.bounds.has_value()});
  if (const auto& box = beside.bounds) hasher.add_each(std::array{box->min.x, box->min.y, box->max.x, box->max.y});
  return fmt::format("{:016x}", hasher.value());
}

Scene without_arrays(const Scene& scene) {
  Scene rest;
  rest.polygons = scene.polygons;
  rest.spheres = scene.spheres;
  rest.boxes = scene.boxes;
  rest.solids = scene.solids;
  rest.bounds = scene.bounds;
  rest.clearance = scene.clearance;
  rest.maze = scene.maze;
  rest.robot = scene.robot;
  rest.start = scene.start;
  rest.goal = scene.goal;
  rest.arm = scene.arm;
  rest.named_start = scene.named_start;
  rest.other_goals = scene.other_goals;
  rest.named_goals = scene.named_goals;
  rest.goal_pose = scene.goal_pose;
  rest.grid = scene.grid;
  rest.source = scene.source;
  return rest;
}

Box box_of_walls(const WallSet& set, const Execution& execution) {
  return set.visit([&](auto walls) {
    const auto box_of_chunk = [&](Range r) {
      Box box;
      for (const auto& wall : walls.subspan(r.first, r.size())) {
        const Segment s = wall.segment();
        box.include(s.a);
        box.include(s.b);
      }
      return box;
    };
    Box all;
    for (const Box& part : parts_of_chunks(walls.size(), WallsHash::grain, execution, box_of_chunk)) all.include(part);
    return all;
  });
}

Box obstacle_box(const Scene& scene, const Execution& execution) {
  Box box = box_of_walls(scene.walls, execution);
  std::size_t polygons = 0;
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.poll(polygons++);
    for (const Vec2 corner : polygon.corners) box.include(corner);
  }
  if (scene.map) box.include(world_box(*scene.map));
  return box;
}

std::vector<Segment> bounds_walls(const Scene& scene) {
  if (!scene.bounds) return {};
  const auto corners = scene.bounds->corners();
  return {{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[3]}, {corners[3], corners[0]}};
}

double checked_length(const char* name, double value, bool may_be_zero) {
  const bool is_enough = may_be_zero ? value >= 0.0 : value > 0.0;
  if (is_enough && value <= largest_coordinate) return value;
  throw InputError(name, may_be_zero ? "must be a number from 0 to 1e60" : "must be a number above 0, up to 1e60",
                   std::to_string(value));
}

double checked_clearance(double clearance) { return checked_length("clearance", clearance, true); }

}  // namespace warren
