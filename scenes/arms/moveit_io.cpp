// SPDX-License-Identifier: BSD-3-Clause
// Planning scenes and requests of MoveIt as YAML, as MotionBenchMaker writes them: what is in an arm's way, which links
// may touch, where joints stand, what is carried; where the arm starts and shall go. The arm itself is none of it: its
// URDF is named beside them, and joints are known by their names alone.
//
// Of a scene: the primitives box, sphere and cylinder of collision objects and attached ones, meshes as their convex
// hulls, the matrix of allowed collisions, the state of the joints. Cones, planes and octomaps are refused. Of a
// request: group, start, goals by joints or one by a pose. Its workspace and its planner are left out, constraints on
// the way are refused. Tolerances are left out: a goal is met as it stands.
//
// Poses become those in the frame of the world, in which the SRDF's virtual joint has the robot's root. A frame is, as
// in MoveIt, the first of these that has its name: a link, what is carried or an object that is read before, or one of
// its subframes, a fixed frame. In the frame of a link or of what it carries an object stands where the scene's state
// has the link; a goal would move with it, and is refused unless the link is fixed to the root.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/text/yaml_file_io.hpp"

namespace warren {
namespace {

using YAML::Node;

/// Place and quaternion as scenes have them, so that a pose which nothing moves is written as it was read.
using PoseNumbers = std::array<double, 7>;
constexpr PoseNumbers at_origin{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};

bool is_identity(const PoseNumbers& pose) {
  return std::all_of(pose.begin(), pose.end() - 1, [](double x) { return x == 0.0; });
}
bool is_identity(const Eigen::Isometry3d& pose) { return pose.matrix() == Eigen::Matrix4d::Identity(); }

PoseNumbers joined(const Eigen::Isometry3d& outer, const PoseNumbers& inner) {
  if (is_identity(outer)) return inner;
  const Eigen::Isometry3d whole = outer * pose_of_numbers(inner);
  const Vec3 at = whole.translation();
  const auto [x, y, z, w] = quaternion_of_turn(whole.linear());
  return {at.x(), at.y(), at.z(), x, y, z, w};
}

/// Scenes and requests: nodes as what they should be, and what they say of the scene. Each error names its line.
class MoveItReader {
 public:
  /// What is read goes into the scene and the frames.
  MoveItReader(Scene& scene, MoveItFrames& frames, const InputFile& file, std::string_view what,
               const Execution& execution)
      : scene_(scene), frames_(frames), yaml_(file, what, most_mebibytes, execution), execution_(execution) {}

  void read_scene() {
    const Node& root = yaml_.root();
    expect_keys(root, "a planning scene of MoveIt",
                {"name", "robot_state", "robot_model_name", "fixed_frame_transforms", "allowed_collision_matrix",
                 "link_padding", "link_scale", "object_colors", "world", "is_diff"});
    const Node world = at(root, "world");
    expect_keys(world, "the world of a planning scene", {"collision_objects", "octomap"});
    const Node stamped = at(world, "octomap");
    expect_keys(stamped, "an octomap", {"header", "origin", "octomap"});
    expect_keys(at(stamped, "octomap"), "an octomap", {"header", "binary", "id", "resolution", "data"});
    const Node octomap = at(at(stamped, "octomap"), "data");
    if (octomap.IsScalar() ? !octomap.Scalar().empty() : octomap.size() > 0)
      yaml_.fail(at(world, "octomap"), "octomaps are not read");
    const Node state = at(root, "robot_state");
    take_state(state);
    for (const bool is_apart : {false, true}) take_fixed_frames(root, is_apart);
    take_all_attached(state);
    for_each(world, "collision_objects", [&](const Node& object) { take_object(object); });
    take_matrix(at(root, "allowed_collision_matrix"));
    refuse_sizes(root, "link_padding", "padding", 0.0);
    refuse_sizes(root, "link_scale", "scale", 1.0);
  }
  void read_request() {
    is_request_ = true;
    const Node& root = yaml_.root();
    expect_keys(
        root, "a request of MoveIt",
        {"workspace_parameters", "start_state", "goal_constraints", "path_constraints", "trajectory_constraints",
         "reference_trajectories", "pipeline_id", "planner_id", "group_name", "num_planning_attempts",
         "allowed_planning_time", "max_velocity_scaling_factor", "max_acceleration_scaling_factor",
         "cartesian_speed_limited_link", "cartesian_speed_end_effector_link", "max_cartesian_speed"});
    if (!root["group_name"] && !root["start_state"] && !root["goal_constraints"])
      yaml_.place(root).fail("a request of MoveIt needs `group_name`, `start_state` or `goal_constraints`");
    if (const Node group = at(root, "group_name"); !group.IsNull()) {
      arm().group = word(group, "group_name");
      ArmFiles* line = robot_line();
      if (line != nullptr && line->srdf.empty() && !(line->base.empty() && line->tip.empty()))
        yaml_.fail(group, "the robot's line says base and tip, and no SRDF that has the group; leave one out");
      if (line != nullptr && !line->srdf.empty()) {  // which has the group
        line->group = arm().group;
        line->base.clear();
        line->tip.clear();
      }
    }
    take_state(at(root, "start_state"));
    take_all_attached(at(root, "start_state"));
    const Node way = at(root, "path_constraints");
    expect_constraint(way);
    for (const char* key : kinds) {
      if (count(way, key) > 0) yaml_.fail(at(way, key), "constraints on the way are not kept: `path_constraints`");
    }
    const Node along = at(root, "trajectory_constraints");
    expect_keys(along, "constraints on the way", {"constraints"});
    if (count(along, "constraints") > 0)
      yaml_.fail(along, "constraints on the way are not kept: `trajectory_constraints`");
    scene_.goal.clear();
    scene_.named_goals.clear();
    scene_.goal_pose.reset();
    for_each(root, "goal_constraints", [&](const Node& goal) { take_goal(goal); });
    const bool by_place = scene_.goal_pose || !scene_.goal.empty();
    if (by_place && count(root, "goal_constraints") > 1) {
      yaml_.fail(at(root, "goal_constraints"), "goals are several where all are by `joint_constraints`");
    }
  }

 private:
  static constexpr std::size_t most_mebibytes = 64;
  static constexpr std::array<const char*, 4> kinds{"joint_constraints", "position_constraints",
                                                    "orientation_constraints", "visibility_constraints"};

  /// Null where the key, or the map itself, is missing.
  Node at(const Node& map, const char* key) const {
    if (map.IsNull()) return Node();
    if (!map.IsMap()) yaml_.fail(map, fmt::format("expected keys with values here, `{}` among them", key));
    const Node found = map[key];
    return found ? found : Node();
  }
  /// What has a key that nobody reads, or one twice, is not what its writer means.
  void expect_keys(const Node& map, std::string_view what, std::initializer_list<std::string_view> known) const {
    if (map.IsNull()) return;
    if (!map.IsMap()) yaml_.fail(map, fmt::format("expected {}: keys with values", what));
    std::set<std::string> seen;
    for (const auto& entry : map) {
      execution_.check();
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
      if (std::ranges::find(known, key) == known.end()) {
        yaml_.fail(entry.first, fmt::format("no key of {}, which are {}", what, fmt::join(known, ", ")));
      }
      if (!seen.insert(key).second) yaml_.fail(entry.first, "this key stands here twice");
    }
  }
  /// A list; null where the key is missing.
  Node items(const Node& map, const char* key) const {
    const Node found = at(map, key);
    if (!found.IsNull() && !found.IsSequence()) yaml_.fail(found, fmt::format("`{}` must be a list", key));
    return found;
  }
  template <class Take>
  void for_each(const Node& map, const char* key, const Take& take) const {
    for (const Node& item : items(map, key)) {
      execution_.check();
      take(item);
    }
  }
  std::size_t count(const Node& map, const char* key) const { return items(map, key).size(); }
  Node needed(const Node& map, const char* key) const {
    const Node found = at(map, key);
    if (found.IsNull()) yaml_.place(map).fail(fmt::format("the key `{}` is missing here", key));
    return found;
  }
  double number(const Node& node, std::string_view key) const {
    return yaml_.number(node, key, "a number of at most 1e60",
                        [](double x) { return std::abs(x) <= largest_coordinate; });
  }
  /// A list, or x, y, z and w by these names.
  template <std::size_t N>
  std::array<double, N> numbers(const Node& node, std::string_view key) const {
    constexpr std::array<const char*, 4> names{"x", "y", "z", "w"};
    if (!node.IsMap() && (!node.IsSequence() || node.size() != N)) {
      yaml_.fail(node, fmt::format("`{}` must be {} numbers", key, N));
    }
    const auto what = fmt::format("`{}`", key);
    if (node.IsMap() && N == 4) expect_keys(node, what, {"x", "y", "z", "w"});
    if (node.IsMap() && N < 4) expect_keys(node, what, {"x", "y", "z"});
    std::array<double, N> found{};
    for (std::size_t i = 0; i < N; ++i) {
      found[i] = number(node.IsMap() ? needed(node, names[i]) : Node(node[i]), node.IsMap() ? names[i] : key);
    }
    return found;
  }
  PoseNumbers pose(const Node& node, const char* at_key = "position", const char* turn_key = "orientation") const {
    expect_keys(node, "a pose", {at_key, turn_key});
    PoseNumbers pose = at_origin;
    if (const Node place = at(node, at_key); !place.IsNull())
      std::ranges::copy(numbers<3>(place, at_key), pose.begin());
    if (const Node turn = at(node, turn_key); !turn.IsNull()) take_turn(turn, turn_key, pose);
    return pose;
  }
  void take_turn(const Node& node, std::string_view key, PoseNumbers& pose) const {
    const auto turn = numbers<4>(node, key);
    if (turn == std::array<double, 4>{}) yaml_.place(node).fail("a quaternion must not be 0 0 0 0");
    std::ranges::copy(turn, pose.begin() + 3);
  }
  /// A word, as a line of a scene holds it.
  std::string word(const Node& node, std::string_view key) const {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    if (scene_text::is_word(text)) return text;
    yaml_.fail(node, fmt::format("`{}` must be a name without blanks, commas and #", key));
  }
  bool truth(const Node& node, std::string_view key) const {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    constexpr std::array<std::string_view, 6> yes{"true", "True", "TRUE", "1", "yes", "on"};
    constexpr std::array<std::string_view, 6> no{"false", "False", "FALSE", "0", "no", "off"};
    if (std::ranges::count(yes, text) > 0) return true;
    if (std::ranges::count(no, text) > 0) return false;
    yaml_.fail(node, fmt::format("`{}` must be true or false", key));
  }

  /// Of a robot_state or start_state.
  void take_state(const Node& state) {
    expect_keys(state, "a robot's state",
                {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"});
    const Node joints = at(state, "joint_state");
    expect_keys(joints, "a state of joints", {"header", "name", "position", "velocity", "effort"});
    expect_keys(at(state, "multi_dof_joint_state"), "a state of joints",
                {"header", "joint_names", "transforms", "twist", "wrench"});
    for (const char* key : {"joint_state", "multi_dof_joint_state"}) know_frame(frame_name(at(state, key)));
    if (!joints.IsNull()) take_joints(joints);
    take_base(at(state, "multi_dof_joint_state"));
  }
  bool base_is_said() const {
    const ArmFiles* const line = robot_line();
    return (scene_.arm && scene_.arm->base_pose) || (line != nullptr && line->base_pose);
  }
  /// Where the virtual joint of the SRDF has the root; at 0 0 0 it need not be named, unless the root was elsewhere.
  void take_base(const Node& state) {
    const Node names = items(state, "joint_names");
    std::size_t i = 0;
    for_each(state, "transforms", [&](const Node& transform) {
      const PoseNumbers place = pose(transform, "translation", "rotation");
      const Node name = i < names.size() ? names[i++] : Node();
      if (is_identity(place) && !base_is_said()) return;
      const RobotFrames* const known = robot();
      if (known == nullptr || !name.IsScalar() || name.Scalar().empty() || name.Scalar() != known->base_joint) {
        if (known != nullptr && is_identity(place)) return;
        yaml_.fail(
            transform,
            "only the SRDF's virtual joint, by its name in `joint_names`, has the robot's root apart from 0 0 0; "
            "name both files beside the scene: `--robot \"urdf FILE srdf FILE\"`");
      }
      const bool is_flat = place[2] == 0.0 && place[3] == 0.0 && place[4] == 0.0;
      if (!is_identity(place) && known->base_kind != "floating" && !(is_flat && known->base_kind == "planar"))
        yaml_.fail(transform, fmt::format("joint {} is {} in the SRDF, so the robot can't stand like this; make it "
                                          "floating there",
                                          known->base_joint, known->base_kind));
      if (robot_line() != nullptr) robot_line()->base_pose.reset();
      arm().base_pose = place;
      robot_.reset();
      if (const std::string frame = frame_name(state); !frame.empty() && !is_world(frame))
        yaml_.fail(at(at(state, "header"), "frame_id"), "the robot's root is placed in the frame of the world alone");
    });
  }
  void take_all_attached(const Node& state) {
    for_each(state, "attached_collision_objects", [&](const Node& attached) { take_attached(attached); });
  }
  /// A box, ball or cylinder, or a mesh's hull: take(solid) for each. frame: what the object's pose is in.
  template <class Take>
  void for_each_solid(const Node& object, const Eigen::Isometry3d& frame, const Take& take) const {
    expect_keys(object, "a collision object",
                {"header", "id", "pose", "type", "primitives", "primitive_poses", "meshes", "mesh_poses", "planes",
                 "plane_poses", "subframe_names", "subframe_poses", "operation"});
    const Node operation = at(object, "operation");
    const std::string does = operation.IsScalar() ? operation.Scalar() : "";
    constexpr std::string_view zero("\0", 1);  // as ROS 2 prints a byte
    if (!operation.IsNull() && does != "0" && does != zero && does != "add" && does != "ADD")
      yaml_.fail(operation, "`operation` must be 0 or add: the objects that are there");
    const Eigen::Isometry3d stand = pose_of_numbers(joined(frame, pose(at(object, "pose"))));
    for (const char* key : {"planes", "plane_poses"}) {
      if (count(object, key) > 0) yaml_.fail(at(object, key), "planes are not read: a box does instead");
    }
    const auto each = [&](const char* shapes, const char* poses, const auto& make) {
      if (count(object, shapes) != count(object, poses)) {
        yaml_.place(object).fail(fmt::format("`{}` must have as many items as `{}`", poses, shapes));
      }
      std::size_t i = 0;
      for_each(object, shapes, [&](const Node& shape) {
        Solid solid = make(shape, joined(stand, pose(at(object, poses)[i++])));
        if (const Node id = at(object, "id"); id.IsScalar()) solid.name = id.Scalar();
        take(std::move(solid));
      });
    };
    each("primitives", "primitive_poses", [&](const Node& n, const PoseNumbers& p) { return primitive(n, p); });
    each("meshes", "mesh_poses", [&](const Node& n, const PoseNumbers& p) { return mesh(n, p); });
  }

  /// Of the world's frame.
  void know_frame(const std::string& name) {
    if (!name.empty()) frames_.named.emplace(name, NamedFrame{});
  }
  std::string frame_name(const Node& posed) const {
    const Node header = at(posed, "header");
    expect_keys(header, "a header", {"seq", "stamp", "frame_id"});
    const Node name = at(header, "frame_id");
    if (!name.IsNull() && !name.IsScalar()) yaml_.fail(name, "`frame_id` must be a name");
    return name.IsScalar() ? name.Scalar() : "";
  }
  /// nullptr: nobody names the robot. Asked once it is known where joints are.
  const RobotFrames* robot() {
    if (!frames_.robot) return nullptr;
    if (!robot_) {
      ArmFiles robot = *frames_.robot;
      if (scene_.arm) robot.held.insert(robot.held.begin(), scene_.arm->held.begin(), scene_.arm->held.end());
      const bool is_said = scene_.arm && scene_.arm->base_pose;  // else a scene has it at 0 0 0, whatever --robot says
      if (is_said || !is_request_) robot.base_pose = is_said ? scene_.arm->base_pose : std::nullopt;
      robot_ = read_robot_frames(robot, execution_);
    }
    return &*robot_;
  }
  const LinkFrame* link_frame(const std::string& link) {
    const RobotFrames* const all = robot();
    if (all == nullptr) return nullptr;
    const auto found = all->links.find(link);
    return found != all->links.end() ? &found->second : nullptr;
  }
  std::optional<LinkFrame> known_frame(const std::string& name) {
    if (name.empty()) return LinkFrame{};
    if (const LinkFrame* const link = link_frame(name)) return *link;
    const auto found = frames_.named.find(name);
    if (found == frames_.named.end()) return name == "world" ? std::optional(LinkFrame{}) : std::nullopt;
    const auto& [pose, link] = found->second;
    if (link.empty()) return LinkFrame{.pose = pose};
    const LinkFrame* const carrier = link_frame(link);
    if (carrier == nullptr) return std::nullopt;
    return LinkFrame{carrier->pose * pose, carrier->moves_with, carrier->open};
  }
  bool is_world(const std::string& name) {
    const auto frame = known_frame(name);
    return !name.empty() && frame && frame->moves_with.empty() && is_identity(frame->pose);
  }
  LinkFrame frame_of(const Node& posed) {
    if (auto frame = known_frame(frame_name(posed))) return std::move(*frame);
    yaml_.fail(at(at(posed, "header"), "frame_id"),
               "nobody says where this frame is: poses are in \"\", world, one of the scene's `fixed_frame_transforms` "
               "or objects before, or a link of the robot that `--robot \"urdf FILE\"` names beside the scene, or what "
               "such a link carries");
  }
  /// Where the frame of an object stands in that of the world, or of a goal, which the arm may not move.
  Eigen::Isometry3d frame_in_world(const Node& posed, bool of_goal = false) {
    const LinkFrame frame = frame_of(posed);
    const std::string& joint = of_goal ? frame.moves_with : frame.open;
    if (joint.empty()) return frame.pose;
    yaml_.fail(at(at(posed, "header"), "frame_id"),
               fmt::format("this frame moves with joint {}; {}", joint,
                           of_goal ? "give the goal in a frame that stands still"
                                   : "the scene's `joint_state` must say where that is"));
  }
  /// The frame of what the link carries, in the link's.
  Eigen::Isometry3d frame_on_link(const std::string& link, const Node& object) {
    const std::string name = frame_name(object);
    if (name.empty() || name == link) return Eigen::Isometry3d::Identity();
    if (const LinkFrame* const carrier = link_frame(link)) {
      const LinkFrame frame = frame_of(object);
      if (carrier->moves_with == frame.moves_with || (carrier->open.empty() && frame.open.empty()))
        return carrier->pose.inverse() * frame.pose;
    }
    yaml_.fail(at(at(object, "header"), "frame_id"),
               fmt::format("what is attached must be in the frame {0}, or in one that the robot, named by `--robot`, "
                           "and `joint_state` place against {0}",
                           link));
  }
  /// Those at 0 0 0, which name the frame of the world, or those apart from it: as MoveIt has them, not as tf does,
  /// from the header's frame into the child's.
  void take_fixed_frames(const Node& root, bool is_apart) {
    for_each(root, "fixed_frame_transforms", [&](const Node& frame) {
      expect_keys(frame, "a fixed frame", {"header", "child_frame_id", "transform"});
      const PoseNumbers place = pose(needed(frame, "transform"), "translation", "rotation");
      if (is_identity(place) == is_apart) return;
      const std::string name = frame_name(frame);
      const std::string to(YamlFile::text_of(at(frame, "child_frame_id")));
      const bool has_no_name = is_apart && (name.empty() || name == to || frames_.named.contains(name));
      const bool is_to_link = base_is_said() && link_frame(to) != nullptr;
      if (has_no_name || ((is_apart || is_to_link) && !is_world(to))) {
        yaml_.fail(frame,
                   "`transform` is where the frame of `header` stands in that of `child_frame_id`, which must be the "
                   "world's: world, the robot's first link where it is at 0 0 0, or one that another fixed frame at "
                   "0 0 0 names");
      }
      know_frame(to);
      if (!name.empty()) frames_.named.emplace(name, NamedFrame{pose_of_numbers(place)});
    });
  }

  ArmFiles& arm() const { return scene_.arm ? *scene_.arm : scene_.arm.emplace(); }
  /// What the world's own line says of the robot, which the request takes the place of; null: nothing.
  ArmFiles* robot_line() const { return scene_.robot && scene_.robot->files ? &*scene_.robot->files : nullptr; }

  void take_joints(const Node& joints) const {
    NamedState state;
    std::map<std::string, double> values;
    for_each(joints, "name", [&](const Node& name) {
      push_asked(state.names, word(name, "name"), execution_);
      if (!values.emplace(state.names.back(), 0.0).second) yaml_.fail(name, "this joint stands here twice");
    });
    for_each(joints, "position", [&](const Node& n) { state.values.push_back(number(n, "position")); });
    if (state.names.size() != state.values.size()) {
      yaml_.place(joints).fail("`position` must have as many numbers as `name` has joints");
    }
    if (state.names.empty()) return;
    for (std::size_t i = 0; i < state.names.size(); ++i) values[state.names[i]] = state.values[i];
    if (ArmFiles* line = robot_line())
      std::erase_if(line->held, [&](const auto& joint) { return values.contains(joint.first); });
    auto& held = arm().held;
    for (const auto& joint : held) values.insert(joint);
    held.assign(values.begin(), values.end());
    scene_.start.clear();
    scene_.named_start = std::move(state);
  }
  /// Takes the place of what had this name before: a request's that of the scene's.
  void take_attached(const Node& attached) {
    expect_keys(attached, "what is attached", {"link_name", "object", "touch_links", "detach_posture", "weight"});
    const std::string link = word(needed(attached, "link_name"), "link_name");
    std::vector<std::string> touched = words(attached, "touch_links");
    const Node object = needed(attached, "object");
    const Eigen::Isometry3d frame = frame_on_link(link, object);
    std::vector<AttachedSolid>& all = arm().attached;
    const std::string name(YamlFile::text_of(at(object, "id")));
    std::erase_if(all, [&](const AttachedSolid& old) {
      if (name.empty() || old.solid.name != name) return false;
      for (const std::string& other : old.may_touch)
        if (std::ranges::find(touched, other) == touched.end()) touched.push_back(other);
      return true;
    });
    if (count(object, "primitives") + count(object, "meshes") == 0)
      yaml_.place(object).fail("what is attached needs its shapes here: `primitives` or `meshes`");
    for_each_solid(object, frame, [&](Solid solid) { push_asked(all, {link, std::move(solid), touched}, execution_); });
    name_frames(object, {frame, link});
  }
  Solid primitive(const Node& shape, const PoseNumbers& pose) const {
    expect_keys(shape, "a primitive", {"type", "dimensions", "polygon"});
    const Node type = needed(shape, "type");
    const std::string name = type.IsScalar() ? type.Scalar() : "";
    const Node size = needed(shape, "dimensions");
    const auto solid = [&](std::string_view word, const std::vector<double>& numbers) {
      return solid_of_numbers(*solid_word_named(word), numbers, yaml_.place(shape), execution_);
    };
    const auto [x, y, z, qx, qy, qz, qw] = pose;
    if (name == "box" || name == "1") {
      const auto sides = numbers<3>(size, "dimensions");
      return solid("obox", {x, y, z, qx, qy, qz, qw, 0.5 * sides[0], 0.5 * sides[1], 0.5 * sides[2]});
    }
    if (name == "sphere" || name == "2") return solid("sphere", {x, y, z, numbers<1>(size, "dimensions")[0]});
    if (name == "cylinder" || name == "3") {
      const auto [height, radius] = numbers<2>(size, "dimensions");
      if (height < 0.0) yaml_.place(size).fail("a cylinder's height must be at least 0", fmt::format("{}", height));
      const Vec3 reach = 0.5 * height * pose_of_numbers(pose).linear().col(2);
      return solid("cylinder",
                   {x - reach.x(), y - reach.y(), z - reach.z(), x + reach.x(), y + reach.y(), z + reach.z(), radius});
    }
    yaml_.fail(type, "`type` must be box, sphere or cylinder");
  }
  Solid mesh(const Node& shape, const PoseNumbers& stand) const {
    expect_keys(shape, "a mesh", {"vertices", "triangles"});
    const Eigen::Isometry3d pose = pose_of_numbers(stand);
    std::vector<double> all;
    for_each(shape, "vertices", [&](const Node& vertex) {
      const auto [x, y, z] = numbers<3>(vertex, "vertices");
      for (const double c : Vec3(pose * Vec3(x, y, z))) push_asked(all, c, execution_);
    });
    if (all.empty()) yaml_.place(shape).fail("a mesh needs `vertices`");
    execution_.reserve(3 * all.size() * sizeof(double));
    return solid_of_numbers(*solid_word_named("hull"), all, yaml_.place(shape), execution_);
  }

  /// Links are as large as their files say.
  void refuse_sizes(const Node& root, const char* list, const char* key, double usual) const {
    for_each(root, list, [&](const Node& link) {
      expect_keys(link, "a link's size", {"link_name", key});
      const Node size = needed(link, key);
      if (number(size, key) == usual) return;
      yaml_.fail(size, fmt::format("`{}` must be {}: links are not made larger; `clearance` keeps room", list, usual));
    });
  }
  void take_object(const Node& object) {
    const Eigen::Isometry3d frame = frame_in_world(object);
    for_each_solid(object, frame, [&](Solid solid) {
      if (solid.kind == SolidKind::sphere) {
        const Vec3 at = solid.pose.translation();
        push_asked(scene_.spheres, {at.x(), at.y(), at.z(), solid.half.x()}, execution_);
      } else {
        push_asked(scene_.solids, std::move(solid), execution_);
      }
    });
    if (const Node id = at(object, "id"); id.IsScalar()) ids_.insert(id.Scalar());
    name_frames(object, {frame});
  }
  /// Of an object, where it has one shape and no pose that of the shape, and its subframes. What is carried is known by
  /// its name before what stands.
  void name_frames(const Node& object, const NamedFrame& frame) {
    const Node id = at(object, "id");
    if (!id.IsScalar()) return;
    const auto name = [&](const std::string& called, const Eigen::Isometry3d& pose) {
      NamedFrame& known = frames_.named[called];
      if (known.link.empty() || !frame.link.empty()) known = {pose, frame.link};
    };
    PoseNumbers own = pose(at(object, "pose"));
    const bool is_mesh = count(object, "primitives") == 0;
    if (is_identity(own) && count(object, "primitives") + count(object, "meshes") == 1)
      own = pose(at(object, is_mesh ? "mesh_poses" : "primitive_poses")[0]);
    const Eigen::Isometry3d stand = pose_of_numbers(joined(frame.pose, own));
    name(id.Scalar(), stand);
    const Node names = items(object, "subframe_names");
    if (names.size() != count(object, "subframe_poses"))
      yaml_.place(object).fail("`subframe_poses` must have as many items as `subframe_names`");
    std::size_t i = 0;
    for_each(object, "subframe_poses", [&](const Node& place) {
      name(id.Scalar() + "/" + names[i++].Scalar(), pose_of_numbers(joined(stand, pose(place))));
    });
  }
  /// As MoveIt reads it: what stands above the diagonal; defaults where there is no entry, false before true.
  void take_matrix(const Node& matrix) {
    expect_keys(matrix, "a matrix of allowed collisions",
                {"entry_names", "entry_values", "default_entry_names", "default_entry_values"});
    const std::vector<std::string> names = words(matrix, "entry_names");
    std::size_t row = 0;
    for_each(matrix, "entry_values", [&](const Node& values) {
      if (values.IsMap()) expect_keys(values, "a row of the matrix", {"enabled"});
      const Node list = values.IsMap() ? at(values, "enabled") : values;
      if (!list.IsSequence() || list.size() != names.size() || row == names.size()) {
        yaml_.fail(values, fmt::format("`entry_values` must be {0} lists of {0}", names.size()));
      }
      std::size_t column = 0;
      for (const Node& value : list) {
        if (truth(value, "entry_values") && column > row) allow(names[row], names[column]);
        ++column;
      }
      ++row;
    });
    if (row != names.size())
      yaml_.place(matrix).fail(fmt::format("`entry_values` must be {0} lists of {0}", names.size()));
    take_defaults(matrix, names);
  }
  void take_defaults(const Node& matrix, std::vector<std::string> known) {
    const std::vector<std::string> names = words(matrix, "default_entry_names");
    if (count(matrix, "default_entry_values") != names.size()) {
      yaml_.place(matrix).fail("`default_entry_values` must have as many items as `default_entry_names`");
    }
    std::set<std::string> never;  // may touch nobody: one of their entries says so
    std::size_t i = 0;
    for_each(matrix, "default_entry_values", [&](const Node& value) {
      if (!truth(value, "default_entry_values")) never.insert(names[i]);
      ++i;
    });
    std::set<std::string> paired(known.begin(), known.end());
    for (const std::string& name : names) {
      if (!paired.insert(name).second) continue;
      for (const std::string& other : known) {
        if (!never.contains(name) && !never.contains(other)) allow(name, other);
      }
      known.push_back(name);
    }
  }
  std::vector<std::string> words(const Node& map, const char* key) const {
    std::vector<std::string> all;
    for_each(map, key, [&](const Node& n) { push_asked(all, word(n, key), execution_); });
    return all;
  }
  /// Of links alone: an object of the world is in the way of all.
  void allow(const std::string& first, const std::string& second) {
    execution_.check();
    if (ids_.contains(first) || ids_.contains(second) || first == second) return;
    bool is_attached = false;
    for (AttachedSolid& attached : arm().attached) {
      if (attached.solid.name != first && attached.solid.name != second) continue;
      is_attached = true;
      attached.may_touch.push_back(attached.solid.name == first ? second : first);
    }
    if (!is_attached) push_asked(arm().allowed, {first, second}, execution_);
  }

  void expect_constraint(const Node& node) const {
    expect_keys(node, "constraints", {"name", kinds[0], kinds[1], kinds[2], kinds[3]});
  }
  void take_goal(const Node& goal) {
    expect_constraint(goal);
    if (count(goal, kinds[3]) > 0) yaml_.fail(at(goal, kinds[3]), "`visibility_constraints` are not kept");
    if (count(goal, kinds[0]) > 0) {
      if (count(goal, kinds[1]) + count(goal, kinds[2]) > 0) {
        yaml_.fail(goal, "a goal is by joints or by a place of the tool, not by both");
      }
      return take_joint_goal(goal);
    }
    if (count(goal, kinds[1]) != 1 || count(goal, kinds[2]) > 1) {
      yaml_.place(goal).fail("a goal needs `joint_constraints`, or one of `position_constraints`");
    }
    const Node place = at(goal, kinds[1])[0];
    expect_keys(place, "a position", {"header", "link_name", "target_point_offset", "constraint_region", "weight"});
    const Node offset = at(place, "target_point_offset");
    if (!offset.IsNull() && numbers<3>(offset, "target_point_offset") != std::array<double, 3>{})
      yaml_.fail(offset, "`target_point_offset` must be 0 0 0");
    if (const Node link = at(place, "link_name"); !link.IsNull()) {
      arm().tool = word(link, "link_name");
      if (ArmFiles* line = robot_line()) line->tool = arm().tool;
    }
    if (count(goal, kinds[2]) > 0) {
      const Node link = at(at(goal, kinds[2])[0], "link_name");
      const bool same = !link.IsScalar() || link.Scalar() == arm().tool;
      if (!same) yaml_.fail(link, "place and turn must be of one link, here " + arm().tool);
    }
    const Node region = needed(place, "constraint_region");
    expect_keys(region, "a region", {"primitives", "primitive_poses", "meshes", "mesh_poses"});
    if (count(region, "meshes") > 0 || count(region, "primitive_poses") != 1)
      yaml_.fail(region, "a place needs one of `primitive_poses`");
    const Eigen::Isometry3d frame = frame_in_world(place, true);
    const Node middle = at(region, "primitive_poses")[0];
    expect_keys(middle, "a pose", {"position", "orientation"});
    PoseNumbers pose = at_origin;
    std::ranges::copy(numbers<3>(needed(middle, "position"), "position"), pose.begin());
    pose = joined(frame, pose);
    if (count(goal, kinds[2]) == 0) {
      scene_.goal.assign(pose.begin(), pose.begin() + 3);
      return;
    }
    const Node turned = at(goal, kinds[2])[0];
    expect_keys(turned, "an orientation",
                {"header", "orientation", "link_name", "absolute_x_axis_tolerance", "absolute_y_axis_tolerance",
                 "absolute_z_axis_tolerance", "parameterization", "weight"});
    const Eigen::Isometry3d turned_frame = frame_in_world(turned, true);
    PoseNumbers turn = at_origin;
    take_turn(needed(turned, "orientation"), "orientation", turn);
    turn = joined(turned_frame, turn);
    std::copy(turn.begin() + 3, turn.end(), pose.begin() + 3);
    scene_.goal_pose = pose_of_numbers(pose);
  }
  void take_joint_goal(const Node& goal) const {
    NamedState state;
    std::set<std::string> seen;
    for_each(goal, kinds[0], [&](const Node& joint) {
      expect_keys(joint, "a joint's goal", {"joint_name", "position", "tolerance_above", "tolerance_below", "weight"});
      const Node name = needed(joint, "joint_name");
      if (!seen.insert(word(name, "joint_name")).second) yaml_.fail(name, "this joint stands here twice");
      state.names.push_back(name.Scalar());
      state.values.push_back(number(needed(joint, "position"), "position"));
    });
    push_asked(scene_.named_goals, std::move(state), execution_);
  }

  Scene& scene_;
  MoveItFrames& frames_;
  YamlFile yaml_;
  const Execution& execution_;
  bool is_request_ = false;
  std::optional<RobotFrames> robot_;  ///< none: not read yet
  std::set<std::string> ids_;         ///< of the world's objects
};

/// read: one of MoveItReader's. yaml-cpp's own words for a node that is not what its reader takes it for.
void read_moveit(Scene& scene, MoveItFrames& frames, const InputFile& file, std::string_view what,
                 void (MoveItReader::*read)(), const Execution& execution) {
  try {
    (MoveItReader(scene, frames, file, what, execution).*read)();
  } catch (const YAML::Exception& error) {
    throw InputError(file.name(), "expected YAML of MoveIt: " + error.msg);
  }
}

}  // namespace

bool is_moveit_scene(std::string_view name, std::string_view bytes) {
  constexpr std::size_t head = 4096;
  if (name.ends_with(".yaml") || name.ends_with(".yml")) {
    return bytes.find("collision_objects") != bytes.npos || bytes.find("robot_model_name") != bytes.npos;
  }
  const std::string_view begin = bytes.substr(0, head);
  for (const std::string key : {"world:", "robot_model_name:", "allowed_collision_matrix:"}) {
    if (begin.starts_with(key) || begin.find("\n" + key) != begin.npos) return true;
  }
  return false;
}

Scene read_moveit_scene(const InputFile& file, const Execution& execution, MoveItFrames* frames) {
  Scene scene;
  MoveItFrames own;
  MoveItFrames& known = frames != nullptr ? *frames : own;
  read_moveit(scene, known, file, "a planning scene of MoveIt", &MoveItReader::read_scene, execution);
  scene.source = file.name();
  return scene;
}

void take_moveit_request(Scene& scene, const InputFile& file, const Execution& execution, MoveItFrames frames) {
  if (!frames.robot && scene.robot) frames.robot = scene.robot->files;
  read_moveit(scene, frames, file, "a request of MoveIt", &MoveItReader::read_request, execution);
}

}  // namespace warren
