// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/arms/arm_files_io.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

const std::string scene_text = R"(robot_model_name: two_arms
allowed_collision_matrix:
  entry_names: [hand, finger, arm, can, cup]
  entry_values:
    - [false, true, false, true, false]
    - [false, false, false, false, true]
    - [true, true, false, false, false]
    - [true, true, false, false, false]
    - [true, true, false, false, false]
  default_entry_names: [base]
  default_entry_values: [true]
robot_state:
  joint_state:
    name: [turn, slide]
    position: [0.5, 0.25]
  attached_collision_objects:
    - link_name: hand
      touch_links: [palm]
      object:
        id: cup
        header: {frame_id: hand}
        primitives: [{type: cylinder, dimensions: [0.2, 0.05]}]
        primitive_poses: [{position: [0, 0, 0.1], orientation: [0, 0, 0, 1]}]
world:
  collision_objects:
    - id: can
      pose: {position: [1, 0, 0], orientation: {x: 0, y: 0, z: 1, w: 1}}
      primitives:
        - {type: box, dimensions: [0.2, 0.4, 0.6]}
        - {type: 3, dimensions: [2, 0.25]}
      primitive_poses:
        - position: {x: 1, y: 0, z: 0}
          orientation: [0, 0, 0, 1]
        - {position: [0, 0, 0], orientation: [1, 0, 0, 1]}
    - id: ball
      primitives: [{type: sphere, dimensions: [0.5]}]
      primitive_poses: [{position: [3, 2, 1], orientation: [0, 0, 0, 1]}]
    - id: wedge
      meshes: [{vertices: [[0, 0, 0], [1, 0, 0], {x: 0, y: 1, z: 0}, [0, 0, 1]], triangles: []}]
      mesh_poses: [{position: [0, 0, 2], orientation: [0, 0, 0, 1]}]
)";

const std::string request_text = R"(group_name: one_arm
start_state:
  joint_state: {name: [slide, wrist], position: [0.125, -1]}
goal_constraints:
  - joint_constraints:
      - {joint_name: turn, position: 1}
      - {joint_name: slide, position: 0.5}
  - joint_constraints: [{joint_name: turn, position: 2}]
)";

InputFile file_of(std::string_view text) { return InputFile::of_bytes("a.yaml", std::string(text)); }
Scene read_moveit(std::string_view text) { return read_scene(file_of(text), {}); }
std::string with(std::string text, std::string_view old, std::string_view now) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error(std::string(old));
  return text.replace(at, old.size(), now);
}

TEST(MoveIt, ReadsWhatIsInTheWay) {
  const Scene scene = read_moveit(scene_text);
  ASSERT_EQ(scene.solids.size(), 3U);
  const Solid& box = scene.solids[0];
  EXPECT_EQ(box.name, "can");
  EXPECT_EQ(box.half, Vec3(0.1, 0.2, 0.3));
  EXPECT_TRUE(box.pose.translation().isApprox(Vec3(1, 1, 0), 1e-15)) << "turned with its object";
  EXPECT_TRUE((box.pose.linear() * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-15));
  const Solid& cylinder = scene.solids[1];
  EXPECT_EQ(cylinder.kind, SolidKind::cylinder);
  EXPECT_TRUE(cylinder.half.isApprox(Vec3(0.25, 0, 1), 1e-15));
  EXPECT_NEAR(std::abs(cylinder.pose(0, 2)), 1.0, 1e-15) << "its axis: z, about x to -y, about z to x";
  EXPECT_EQ(scene.solids[2].corners.size(), 4U);
  EXPECT_EQ(std::ranges::count(scene.solids[2].corners, Vec3(0, 0, 3)), 1);
  ASSERT_EQ(scene.spheres.size(), 1U);
  EXPECT_EQ(scene.spheres[0].radius, 0.5);
}

TEST(MoveIt, ReadsWhatIsSaidOfTheArm) {
  const ArmFiles arm = read_moveit(scene_text).arm.value();
  using Pairs = std::vector<std::array<std::string, 2>>;
  EXPECT_EQ(arm.allowed, (Pairs{{"hand", "finger"}, {"base", "hand"}, {"base", "finger"}, {"base", "arm"}}))
      << "above the diagonal, of links alone";
  ASSERT_EQ(arm.attached.size(), 1U);
  EXPECT_EQ(arm.attached[0].may_touch, (std::vector<std::string>{"palm", "finger", "base"}));
  EXPECT_EQ(arm.attached[0].solid.pose.translation(), Vec3(0, 0, 0.1));
  EXPECT_EQ(arm.held, (std::vector<std::pair<std::string, double>>{{"slide", 0.25}, {"turn", 0.5}}));
}

TEST(MoveIt, TakesARequest) {
  Scene scene = read_moveit(scene_text);
  EXPECT_EQ(scene.named_start->values, (std::vector<double>{0.5, 0.25}));
  take_moveit_request(scene, file_of(request_text), {});
  EXPECT_EQ(scene.arm->group, "one_arm");
  EXPECT_EQ(scene.named_start->names, (std::vector<std::string>{"slide", "wrist"}));
  EXPECT_EQ(scene.arm->held,
            (std::vector<std::pair<std::string, double>>{{"slide", 0.125}, {"turn", 0.5}, {"wrist", -1.0}}));
  ASSERT_EQ(scene.named_goals.size(), 2U);
  EXPECT_EQ(scene.named_goals[0].values, (std::vector<double>{1, 0.5}));
}

TEST(MoveIt, TakesAGoalByThePoseOfTheTool) {
  Scene scene;
  const std::string place =
      "goal_constraints: [{position_constraints: [{link_name: hand, constraint_region: {primitive_poses: [{position: "
      "[1, 2, 3]}]}}]";
  take_moveit_request(scene, file_of(place + "}]"), {});
  EXPECT_EQ(scene.goal, (std::vector<double>{1, 2, 3}));
  take_moveit_request(scene, file_of(place + ", orientation_constraints: [{orientation: [0, 0, 1, 1]}]}]"), {});
  EXPECT_TRUE(scene.goal.empty());
  EXPECT_TRUE((*scene.goal_pose * Vec3(1, 0, 0)).isApprox(Vec3(1, 3, 3), 1e-15));
}

TEST(MoveIt, AGoalIsOfTheLinkThatItNames) {
  Scene scene;
  const std::string place =
      "position_constraints: [{link_name: palm, constraint_region: {primitive_poses: [{position: [1, 2, 3]}]}}]";
  const auto request = [&](const std::string& link) {
    return "goal_constraints: [{" + place + ", orientation_constraints: [{link_name: " + link +
           ", orientation: [0, 0, 0, 1]}]}]";
  };
  take_moveit_request(scene, file_of(request("palm")), {});
  EXPECT_EQ(scene.arm->tool, "palm");
  std::string text;
  write_scene_text(scene, [&](std::string_view part) { text += part; }, {});
  EXPECT_EQ(read_scene(InputFile::of_bytes("a.scene", text), {}).arm->tool, "palm");
  EXPECT_THROW(take_moveit_request(scene, file_of(request("hand")), {}), InputError);
}

/// What makes links larger than their files say is refused, not passed over.
TEST(MoveIt, LinksAreAsLargeAsTheirFilesSay) {
  const auto scene = [](const std::string& padding, const std::string& scale) {
    return scene_text + "link_padding: [{link_name: hand, padding: " + padding +
           "}]\nlink_scale: [{link_name: hand, scale: " + scale + "}]\n";
  };
  EXPECT_NO_THROW(read_moveit(scene("0", "1")));
  EXPECT_NO_THROW(read_moveit(scene("-1e-400", "+1")));
  EXPECT_THROW(read_moveit(scene("0.01", "1")), InputError);
  EXPECT_THROW(read_moveit(scene("0", "1.1")), InputError);
}

/// False before true, in any order.
TEST(MoveIt, ADefaultThatForbidsWins) {
  const auto allowed = [](const std::string& names, const std::string& values) {
    return read_moveit(
               "robot_model_name: r\nallowed_collision_matrix: {entry_names: [c], entry_values: [[false]], "
               "default_entry_names: " +
               names + ", default_entry_values: " + values + "}\n")
        .arm.value_or(ArmFiles{})
        .allowed;
  };
  using Pairs = std::vector<std::array<std::string, 2>>;
  EXPECT_EQ(allowed("[a, b]", "[false, true]"), (Pairs{{"b", "c"}}));
  EXPECT_EQ(allowed("[b, a]", "[true, false]"), (Pairs{{"b", "c"}}));
  EXPECT_EQ(allowed("[b, c]", "[true, false]"), Pairs());
  EXPECT_EQ(allowed("[a, b]", "[true, true]"), (Pairs{{"a", "c"}, {"b", "c"}, {"b", "a"}}));
}

/// Without a robot objects and goals stand in the root's frame, or are refused.
TEST(MoveIt, FramesThatNobodyKnowsAreRefused) {
  const auto scene = [](const std::string& object, const std::string& more) {
    return with(scene_text, "    - id: ball", "    - id: ball\n      header: {frame_id: " + object + "}") + more;
  };
  const std::string fixed = "fixed_frame_transforms: [{header: {frame_id: base}, child_frame_id: odom, transform: {}}]";
  EXPECT_NO_THROW(read_moveit(scene("\"\"", "")));
  EXPECT_NO_THROW(read_moveit(scene("world", "")));
  EXPECT_NO_THROW(read_moveit(scene("odom", fixed)));
  EXPECT_NO_THROW(read_moveit(scene("base", fixed)));
  EXPECT_NO_THROW(read_moveit(with(scene("base", ""), "joint_state:", "joint_state:\n    header: {frame_id: base}")));
  const auto expect_refused = [](const auto& read, const std::string& place, const std::string& frame) {
    const std::string said = test::refusal<InputError>(read);
    EXPECT_TRUE(said.starts_with(place + ": nobody says where this frame is")) << frame << ' ' << said;
    EXPECT_TRUE(said.ends_with("(found: " + frame + ")")) << frame << ' ' << said;
  };
  for (const std::string frame : {"hand", "base"})
    expect_refused([&] { read_moveit(scene(frame, "")); }, "a.yaml:36", frame);
  const auto request = [](const std::string& place, const std::string& turn) {
    Scene taken;
    take_moveit_request(
        taken,
        file_of("goal_constraints:\n- position_constraints: [{header: {frame_id: " + place +
                "}, constraint_region: {primitive_poses: [{position: [1, 2, 3]}]}}]\n" +
                "  orientation_constraints: [{header: {frame_id: " + turn + "}, orientation: [0, 0, 0, 1]}]\n"),
        {});
  };
  EXPECT_NO_THROW(request("world", "\"\""));
  expect_refused([&] { request("hand", "world"); }, "a.yaml:2", "hand");
  expect_refused([&] { request("world", "hand"); }, "a.yaml:3", "hand");
}

/// A post that stands at 1 0 0, turned to the left; on it an arm that turns, a hand on it, a palm that slides on that.
const std::string post_urdf = R"(<robot name="r">
<link name="base"/><link name="post"/><link name="arm"/><link name="hand"/><link name="palm"/>
<joint name="set" type="fixed"><parent link="base"/><child link="post"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint>
<joint name="turn" type="revolute"><parent link="post"/><child link="arm"/><axis xyz="0 0 1"/><limit lower="-2" upper="2"/></joint>
<joint name="tip" type="fixed"><parent link="arm"/><child link="hand"/><origin xyz="0 0 1"/></joint>
<joint name="slide" type="prismatic"><parent link="hand"/><child link="palm"/><axis xyz="1 0 0"/><limit lower="0" upper="1"/></joint>
</robot>)";

/// Scenes and requests of the robot of post_urdf.
class MoveItFrame : public ::testing::Test {
 protected:
  MoveItFrame() { frames_.robot = ArmFiles{.urdf = directory_.write("post.urdf", post_urdf)}; }
  Scene read(const std::string& text) {
    frames_.named.clear();
    return read_scene(file_of(text), {}, MapServerRules::nav2, &frames_);
  }
  /// Where the ball is that stands at 3 2 1 in this frame. more: of the scene.
  Vec3 ball_in(const std::string& frame, const std::string& more = "") {
    const Sphere ball = read(ball_text(frame) + more).spheres.at(0);
    return {ball.x, ball.y, ball.z};
  }
  static std::string ball_text(const std::string& frame) {
    return with(scene_text, "    - id: ball", "    - id: ball\n      header: {frame_id: " + frame + "}");
  }
  /// Of a scene whose state says nothing of joint turn.
  static std::string without_turn(const std::string& text) {
    return with(text, "name: [turn, slide]\n    position: [0.5, 0.25]", "name: [slide]\n    position: [0.25]");
  }
  void expect_refused(const std::string& text, const std::string& says) {
    const std::string said = test::refusal<InputError>([&] { read(text); });
    EXPECT_NE(said.find(says), std::string::npos) << said;
  }

  TemporaryDirectory directory_;
  MoveItFrames frames_;
};

TEST_F(MoveItFrame, OfALinkIsWhereTheStateHasIt) {
  const Eigen::Isometry3d post = Eigen::Translation3d(1, 0, 0) * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ());
  const Eigen::Isometry3d palm = post * Eigen::AngleAxisd(0.5, Vec3::UnitZ()) * Eigen::Translation3d(0.25, 0, 1);
  EXPECT_EQ(ball_in("base"), Vec3(3, 2, 1));
  EXPECT_TRUE(ball_in("post").isApprox(Vec3(-1, 3, 1), 1e-12));
  EXPECT_TRUE(ball_in("palm").isApprox(palm * Vec3(3, 2, 1), 1e-12));
  expect_refused(without_turn(ball_text("palm")),
                 "a.yaml:36: this frame moves with joint turn; the scene's `joint_state` must say where");
}

/// Of objects that stand before, and their subframes; the ball, which has one shape and no pose, is where its shape is.
TEST_F(MoveItFrame, OfAnObjectIsWhereTheObjectIs) {
  EXPECT_TRUE(ball_in("can").isApprox(Vec3(-1, 3, 1), 1e-12));
  const std::string lid =
      with(ball_text("can/lid"), "    - id: can",
           "    - id: can\n      subframe_names: [lid]\n      subframe_poses: [{position: [0, 0, 2]}]");
  EXPECT_NEAR(read(lid).spheres.at(0).z, 3.0, 1e-12);
  const Scene on_ball = read(with(scene_text, "    - id: wedge", "    - id: wedge\n      header: {frame_id: ball}"));
  EXPECT_EQ(std::ranges::count(on_ball.solids.at(2).corners, Vec3(3, 2, 4)), 1);
  expect_refused(ball_text("wedge"), "a.yaml:36: nobody says where this frame is");
}

/// As MoveIt has fixed frames: the header's frame in that of the child, which is the root's.
TEST_F(MoveItFrame, OfAFixedFrameIsWhereItStandsInTheRoots) {
  const auto fixed = [](const std::string& name, const std::string& to) {
    return "fixed_frame_transforms: [{header: {frame_id: " + name + "}, child_frame_id: " + to +
           ", transform: {translation: [0, 0, 1], rotation: [0, 0, 1, 1]}}]\n";
  };
  const Vec3 there(-2, 3, 2);
  EXPECT_TRUE(ball_in("table", fixed("table", "base")).isApprox(there, 1e-12));
  EXPECT_TRUE(ball_in("table", fixed("table", "world")).isApprox(there, 1e-12));
  EXPECT_TRUE(ball_in("world", fixed("world", "base")).isApprox(there, 1e-12));
  for (const auto& [name, to] : {std::pair("base", "table"), {"world", "table"}, {"table", "post"}, {"table", "arm"}})
    expect_refused(ball_text("world") + fixed(name, to), "`child_frame_id`, which must be the world's: world, ");
  frames_.robot.reset();
  EXPECT_TRUE(ball_in("table", fixed("table", "world")).isApprox(there, 1e-12));
  expect_refused(ball_text("table") + fixed("table", "base"), "must be the world's");
}

/// Where the frame moves with the link that carries, or the state says where both are.
TEST_F(MoveItFrame, OfWhatIsCarriedIsPlacedAgainstItsLink) {
  const auto cup_in = [&](const std::string& frame, const std::string& text) -> Vec3 {
    return read(with(text, "frame_id: hand", "frame_id: " + frame)).arm->attached.at(0).solid.pose.translation();
  };
  const std::string no_turn = without_turn(scene_text);
  EXPECT_TRUE(cup_in("arm", scene_text).isApprox(Vec3(0, 0, -0.9), 1e-12));
  EXPECT_TRUE(cup_in("post", scene_text).isApprox(Vec3(0, 0, -0.9), 1e-12));
  EXPECT_TRUE(cup_in("arm", no_turn).isApprox(Vec3(0, 0, -0.9), 1e-12));
  expect_refused(with(no_turn, "frame_id: hand", "frame_id: post"), "what is attached must be in the frame hand, or");
}

/// As the link has it that carries it, with its pose; before an object of the same name. In what stands above.
TEST_F(MoveItFrame, OfWhatIsCarriedIsWhereTheStateHasIt) {
  const Eigen::Isometry3d post = Eigen::Translation3d(1, 0, 0) * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ());
  const Eigen::Isometry3d cup = post * Eigen::AngleAxisd(0.5, Vec3::UnitZ()) * Eigen::Translation3d(0, 0, 1.1);
  EXPECT_TRUE(ball_in("cup").isApprox(cup * Vec3(3, 2, 1), 1e-12));
  const auto with_cup = [&](const std::string& more) {
    return with(scene_text, "id: cup", "id: cup\n        " + more);
  };
  const std::string placed =
      "pose: {position: [0, 0, 5]}\n        subframe_names: [lid]\n        subframe_poses: [{position: [1, 0, 0]}]";
  const Scene lid = read(with(with_cup(placed), "- id: ball", "- id: ball\n      header: {frame_id: cup/lid}"));
  const Vec3 there = cup * Vec3(4, 2, 5.9);
  EXPECT_TRUE(Vec3(lid.spheres.at(0).x, lid.spheres.at(0).y, lid.spheres.at(0).z).isApprox(there, 1e-12));
  const std::string lid_on_cup =
      "    - {link_name: arm, object: {id: lid, header: {frame_id: cup}, primitives: [{type: sphere, dimensions: "
      "[0.1]}], "
      "primitive_poses: [{}]}}\nworld:";
  const Vec3 on_arm = read(with(scene_text, "world:", lid_on_cup)).arm->attached.at(1).solid.pose.translation();
  EXPECT_TRUE(on_arm.isApprox(Vec3(0, 0, 1.1), 1e-12));
  EXPECT_TRUE(read(with(ball_text("cup"), "id: can", "id: cup")).spheres.at(0).z > 2.0) << "not the standing one";
  expect_refused(with_cup("subframe_poses: [{}]"), "a.yaml:20: `subframe_poses` must have as many items");
  expect_refused(without_turn(ball_text("cup")), "a.yaml:36: this frame moves with joint turn; the scene's");
  frames_.robot.reset();
  expect_refused(ball_text("cup"), "a.yaml:36: nobody says where this frame is");
}

/// The SRDF's virtual joint has the root somewhere in the world.
class MoveItBase : public MoveItFrame {
 protected:
  MoveItBase() { frames_.robot->srdf = srdf("floating"); }
  std::string srdf(const std::string& kind) const {
    return directory_.write("post.srdf", R"(<robot name="r"><virtual_joint name="stand" type=")" + kind +
                                             R"(" parent_frame="odom" child_link="base"/></robot>)");
  }
  static std::string state(const std::string& place, const std::string& header = "odom",
                           const std::string& joint = "stand") {
    return "multi_dof_joint_state: {header: {frame_id: " + header + "}, joint_names: [" + joint +
           "], transforms: [{translation: " + place + "}]}";
  }
  static std::string standing(const std::string& text, const std::string& state) {
    return with(text, "robot_state:", "robot_state:\n  " + state);
  }
  static constexpr const char* turned = "[0, 2, 0], rotation: [0, 0, 1, 1]";

  const Eigen::Isometry3d base_ =
      Eigen::Translation3d(0, 2, 0) * Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ());
};

TEST_F(MoveItBase, IsWhereTheVirtualJointHasIt) {
  const auto ball = [&](const std::string& frame, const std::string& more = "") {
    const Sphere found = read(standing(ball_text(frame), state(turned)) + more).spheres.at(0);
    return Vec3(found.x, found.y, found.z);
  };
  for (const std::string world : {"\"\"", "world", "odom"}) EXPECT_EQ(ball(world), Vec3(3, 2, 1)) << world;
  EXPECT_TRUE(ball("base").isApprox(base_ * Vec3(3, 2, 1), 1e-12));
  EXPECT_TRUE(ball("post").isApprox(base_ * Vec3(-1, 3, 1), 1e-12));
  const std::string fixed = "fixed_frame_transforms: [{header: {frame_id: table}, child_frame_id: ";
  const std::string up = ", transform: {translation: [0, 0, 1]}}]";
  EXPECT_EQ(ball("table", fixed + "odom" + up), Vec3(3, 2, 2));
  for (const std::string& other : {fixed + "base" + up, fixed + "base, transform: {}}]"})
    expect_refused(standing(ball_text("world"), state(turned)) + other, "which must be the world's");
}

/// The arm stands there, and a scene's text says it, too. The robot's own word goes before.
TEST_F(MoveItBase, MovesTheWholeRobot) {
  Scene scene = read(standing(scene_text, state(turned)));
  std::string text;
  write_scene_text(scene, [&](std::string_view part) { text += part; }, {});
  EXPECT_NE(text.find("\nbase-pose 0 2 0 0 0 1 1\n"), std::string::npos) << text;
  const Scene back = read_scene(InputFile::of_bytes("a.scene", text), {});
  const RobotSpec robot{.kind = RobotKind::urdf, .files = ArmFiles{.urdf = frames_.robot->urdf, .tool = "hand"}};
  const ArmModel plain = read_urdf(*robot.files, {});
  const ArmModel model = read_urdf(*with_what_is_said(robot, back).files, {});
  EXPECT_EQ(model.base, Vec3(0, 2, 0));
  EXPECT_TRUE(model.joints[0].origin.isApprox(base_ * plain.joints[0].origin, 1e-12));
  EXPECT_TRUE(model.joints[1].origin.isApprox(plain.joints[1].origin, 1e-12)) << "hangs on the first";
  EXPECT_TRUE(without_what_is_said(with_what_is_said(robot, back), back).files->base_pose == std::nullopt);
  RobotSpec own = robot;
  own.files->base_pose = {1, 0, 0, 0, 0, 0, 1};
  EXPECT_EQ(with_what_is_said(own, back).files->base_pose, own.files->base_pose);
}

/// What stands in the world stays there, whatever a request says of the robot.
TEST_F(MoveItBase, IsWhereTheRequestHasIt) {
  const auto taken = [&](const std::string& start, const std::string& frame) {
    Scene scene = read(standing(ball_text("base"), state(turned)));
    take_moveit_request(scene,
                        file_of("start_state: {" + start +
                                "}\ngoal_constraints:\n- position_constraints: [{header: {frame_id: " + frame +
                                "}, constraint_region: {primitive_poses: [{position: [1, 2, 3]}]}}]\n"),
                        {}, frames_);
    EXPECT_TRUE(
        Vec3(scene.spheres[0].x, scene.spheres[0].y, scene.spheres[0].z).isApprox(base_ * Vec3(3, 2, 1), 1e-12));
    return scene;
  };
  const auto goal = [](const Scene& scene) { return Vec3(scene.goal[0], scene.goal[1], scene.goal[2]); };
  EXPECT_TRUE(goal(taken("", "base")).isApprox(base_ * Vec3(1, 2, 3), 1e-12));
  EXPECT_EQ(goal(taken("", "odom")), Vec3(1, 2, 3));
  const Scene moved = taken(state("[5, 0, 0]"), "base");
  EXPECT_EQ(goal(moved), Vec3(6, 2, 3));
  EXPECT_EQ(moved.arm->base_pose->at(0), 5.0);
  EXPECT_EQ(goal(taken(state("[0, 0, 0]"), "base")), Vec3(1, 2, 3)) << "back at the origin";
}

TEST_F(MoveItBase, RefusesWhatCannotStandSo) {
  const std::string far = standing(scene_text, state("[0, 0, 1]"));
  EXPECT_NO_THROW(read(far));
  expect_refused(standing(scene_text, state(turned, "base")), "a.yaml:13: the robot's root is placed in the frame of");
  const std::string unnamed = "a.yaml:13: only the SRDF's virtual joint, by its name in `joint_names`";
  expect_refused(standing(scene_text, state(turned, "odom", "turn")), unnamed);
  expect_refused(standing(scene_text, state(turned, "odom", "")), unnamed);
  EXPECT_NO_THROW(read(standing(scene_text, state("[0, 0, 0]", "odom", "turn"))));
  srdf("planar");
  EXPECT_NO_THROW(read(standing(scene_text, state(turned))));
  expect_refused(far, "a.yaml:13: joint stand is planar in the SRDF");
  expect_refused(standing(scene_text, state("[0, 0, 0], rotation: [1, 0, 0, 1]")), "joint stand is planar in the SRDF");
  srdf("fixed");
  expect_refused(standing(scene_text, state(turned)), "a.yaml:13: joint stand is fixed in the SRDF");
  frames_.robot->srdf.clear();
  expect_refused(far, unnamed);
  frames_.robot.reset();
  expect_refused(far, unnamed);
}

/// What the scene names its request knows, too; a goal in the frame of a link that moves would move with it.
TEST_F(MoveItFrame, OfAGoalStandsStill) {
  const auto goal_in = [&](const std::string& place, const std::string& turn) {
    Scene scene = read(scene_text);
    take_moveit_request(
        scene,
        file_of("goal_constraints:\n- position_constraints: [{header: {frame_id: " + place +
                "}, constraint_region: {primitive_poses: [{position: [1, 2, 3]}]}}]\n" +
                "  orientation_constraints: [{header: {frame_id: " + turn + "}, orientation: [0, 0, 0, 1]}]\n"),
        {}, frames_);
    return scene.goal_pose.value();
  };
  const Eigen::Isometry3d goal = goal_in("post", "can");
  EXPECT_TRUE(goal.translation().isApprox(Vec3(-1, 1, 3), 1e-12));
  EXPECT_TRUE((goal.linear() * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-12));
  for (const auto& ends : {std::pair("palm", "base"), {"base", "palm"}}) {
    const std::string said = test::refusal<InputError>([&] { goal_in(ends.first, ends.second); });
    EXPECT_NE(said.find("this frame moves with joint slide; give the goal in a frame"), std::string::npos) << said;
  }
}

TEST(MoveIt, BecomesASceneThatReadsBackTheSame) {
  const std::string carried = with(with(scene_text, "[base]", "[base, pan]"), "[true]\n", "[true, true]\n");
  Scene scene = read_moveit(with(carried, "world:",
                                 "    - {link_name: palm, object: {id: pan, primitives: [{type: sphere, dimensions: "
                                 "[0.1]}], primitive_poses: [{}]}}\nworld:"));
  take_moveit_request(scene, file_of(request_text), {});
  std::string text;
  write_scene_text(scene, [&](std::string_view part) { text += part; }, {});
  const Scene back = read_scene(InputFile::of_bytes("a.scene", text), {});
  EXPECT_EQ(scene_hash(back), scene_hash(scene));
  EXPECT_EQ(back.arm->held, scene.arm->held);
  EXPECT_EQ(back.arm->allowed, scene.arm->allowed);
  ASSERT_EQ(back.arm->attached.size(), 2U);
  EXPECT_EQ(std::ranges::count(back.arm->attached[0].may_touch, std::string("pan")), 1) << "two that are carried";
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.arm->attached[i].may_touch, scene.arm->attached[i].may_touch);
    EXPECT_EQ(back.arm->attached[i].solid.name, i == 0 ? "cup" : "pan") << "which the other one may touch";
  }
  EXPECT_TRUE(back.arm->said.empty()) << "the robot may lack what a scene of MoveIt names";
  EXPECT_EQ(back.named_goals.size(), 2U);
}

/// A request counts instead of the world: of its robot's line, of its state, of what is carried.
TEST(MoveIt, ARequestCountsInsteadOfTheWorld) {
  Scene scene = read_moveit(scene_text);
  ArmFiles line{.urdf = "a.urdf",
                .srdf = "a.srdf",
                .group = "two_arms",
                .held = {{"slide", 9.0}, {"lid", 2.0}},
                .tool = "finger"};
  scene.robot = RobotSpec{.kind = RobotKind::urdf, .files = line};
  const std::string carries =
      "  attached_collision_objects:\n    - {link_name: finger, object: {id: cup, primitives: [{type: sphere, "
      "dimensions: [0.1]}], primitive_poses: [{}]}}\n";
  const std::string place =
      "  - position_constraints: [{link_name: hand, constraint_region: {primitive_poses: "
      "[{position: [1, 2, 3]}]}}]\n";
  take_moveit_request(scene,
                      file_of("group_name: one_arm\nstart_state:\n  joint_state: {name: [slide], position: [0.125]}\n" +
                              carries + "goal_constraints:\n" + place),
                      {});
  const ArmFiles files = *with_what_is_said(*scene.robot, scene).files;
  EXPECT_EQ(files.group, "one_arm");
  EXPECT_EQ(files.tool, "hand");
  EXPECT_EQ(files.held, (std::vector<std::pair<std::string, double>>{{"lid", 2.0}, {"slide", 0.125}, {"turn", 0.5}}));
  ASSERT_EQ(files.attached.size(), 1U) << "one cup";
  EXPECT_EQ(files.attached[0].link, "finger");
  EXPECT_EQ(files.attached[0].may_touch, (std::vector<std::string>{"palm", "finger", "base"}));
}

TEST(MoveIt, MarksOfOneDocumentAreRead) {
  for (const std::string before : {"---\n", "\xef\xbb\xbf# a comment\n---\n", "%YAML 1.2\n--- # one\n"}) {
    for (const std::string behind : {"", "---\n", "...\n# the end\n"}) {
      Scene scene;
      EXPECT_NO_THROW(take_moveit_request(scene, file_of(before + request_text + behind), {})) << before << behind;
    }
  }
}

TEST(MoveIt, RefusesWhatItDoesNotRead) {
  const std::string cone = "`type` must be box, sphere or cylinder (found: cone)";
  const std::pair<std::string, std::string> scenes[] = {
      {with(scene_text, "type: box", "type: cone"), "a.yaml:29: " + cone},
      {with(scene_text, "[0.2, 0.4, 0.6]", "[0.2, 0.4]"), "a.yaml:29: `dimensions` must be 3 numbers"},
      {with(scene_text, "[0.2, 0.4, 0.6]", "[0.2, -0.4, 0.6]"), "a.yaml:29: `obox`: half the sides"},
      {with(scene_text, "[0.2, 0.05]", "[-0.2, 0.05]"),
       "a.yaml:22: a cylinder's height must be at least 0 (found: -0.2)"},
      {with(scene_text, "[0.2, 0.4, 0.6]", "[0.2, x, 0.6]"),
       "a.yaml:29: `dimensions` must be a number of at most 1e60 (found: x)"},
      {with(scene_text, "[0.2, 0.4, 0.6]", "[0.2, .nan, 0.6]"), "a.yaml:29: `dimensions` must be a number"},
      {with(scene_text, "[0.2, 0.4, 0.6]", "[0.2, +-0.4, 0.6]"), "a.yaml:29: `dimensions` must be a number"},
      {with(scene_text, "{x: 0, y: 0, z: 1, w: 1}", "[0, 0, 0, 0]"), "a.yaml:27: a quaternion must not be 0 0 0 0"},
      {with(scene_text, "    - id: ball", "    - planes: [{coef: [0, 0, 1, 0]}]"), "a.yaml:35: planes are not read"},
      {with(scene_text, "frame_id: hand", "frame_id: arm"), "a.yaml:21: what is attached must be in the frame hand"},
      {with(scene_text, "cup]", "cup, jar]"), "a.yaml:5: `entry_values` must be 6 lists of 6"},
      {with(scene_text, "position: [0.5, 0.25]", "position: [0.5]"), "a.yaml:14: `position` must have as many numbers"},
      {with(scene_text, "[turn, slide]", "[turn, turn]"), "a.yaml:14: this joint stands here twice (found: turn)"},
      {with(scene_text, "[turn, slide]", "[turn, \"sl ide\"]"), "a.yaml:14: `name` must be a name without blanks"},
      {with(scene_text, "world:", "fixed_frame_transforms: [{transform: {translation: [1, 0, 0]}}]\nworld:"),
       "a.yaml:24: `transform` is where the frame of `header` stands"},
      {with(scene_text, "    - id: ball", "    - id: ball\n      subframe_poses: [{}]"),
       "a.yaml:35: `subframe_poses` must have as many items as `subframe_names`"},
      {scene_text + "  : [", "a.yaml:"},
      // What would be an obstacle, were its key another one:
      {with(scene_text, "world:", "scene:"), "a.yaml:24: no key of a planning scene of MoveIt, which are name, "},
      {with(scene_text, "  collision_objects:\n    - id: can", "  colision_objects:\n    - id: can"),
       "a.yaml:25: no key of the world of a planning scene, which are collision_objects, octomap"},
      {"collision_objects: []\n", "a.yaml:1: no key of a planning scene of MoveIt"},
      {with(scene_text, "world:\n  collision_objects:", "world:\n"),
       "a.yaml:26: expected the world of a planning scene"},
      {with(scene_text, "world:", "world: {}\nworld:"), "a.yaml:25: this key stands here twice (found: world)"},
      {scene_text + "---\nworld: {}\n", "a.yaml:42: a second document begins here"},
      {with(scene_text, "world:\n", "world:\n  octomap: {octomap: {data: AAEC}}\n"),
       "a.yaml:25: octomaps are not read"},
      {with(scene_text, "    - id: ball", "    - planes: {coef: [0, 0, 1, 0]}"), "a.yaml:35: `planes` must be a list"},
      {with(scene_text, "    - id: ball", "    - operation: 1"), "a.yaml:35: `operation` must be 0 or add"},
      // Poses of another form:
      {with(scene_text, "{position: [3, 2, 1], orientation: [0, 0, 0, 1]}", "[3, 2, 1, 0, 0, 0, 1]"),
       "a.yaml:37: expected a pose: keys with values"},
      {with(scene_text, "{position: [3, 2, 1],", "{xyz: [3, 2, 1],"),
       "a.yaml:37: no key of a pose, which are position, orientation (found: xyz)"},
  };
  for (const auto& [text, expected] : scenes) {
    const std::string said = test::refusal<InputError>([&, &text = text] { read_moveit(text); });
    EXPECT_EQ(said.substr(0, expected.size()), expected);
  }
  const std::string both = "goal_constraints: [{joint_constraints: [1], position_constraints: [1]}]";
  const std::string one_arm = "group_name: one_arm\n";
  const std::string requests[] = {
      both,
      "goal_constraints: [{}]",
      one_arm + "path_constraints: {joint_constraints: [1]}",
      one_arm + "path_constraints: {joint_constraints: {joint_name: turn}}",
      one_arm + "path_constraints: {name: way, joints: [1]}",
      one_arm + "path_constraints: [{joint_constraints: [1]}]",
      one_arm + "trajectory_constraints: {constraints: {joint_constraints: [1]}}",
      one_arm + "trajectory_constraints: [1]",
      "motion_plan_request: {group_name: one_arm}",
      one_arm + "path_constraint: {}",
      "{}",
      "{a: 1},",
      one_arm + "...\nstart_state: {}\n",
      one_arm + "%\nstart_state: {}\n",
      one_arm +
          "goal_constraints: [{position_constraints: [{header: {frame: hand}, "
          "constraint_region: {primitive_poses: [{position: [1, 2, 3]}]}}]}]",
      one_arm + "start_state: {attached_collision_objects: [{link_name: a, object: {id: b}}]}",
      scene_text};
  for (const std::string& text : requests) {
    Scene scene;
    EXPECT_THROW(take_moveit_request(scene, file_of(text), {}), InputError) << text;
  }
}

TEST(MoveIt, AnyBytesAreReadOrRefusedInOneLine) {
  for (const std::uint64_t seed : test::seeds(1000, 200)) {
    SequentialRng rng(seed);
    const bool is_request = rng.below(3) == 0;
    std::string text = is_request ? request_text : scene_text;
    for (std::uint64_t changes = 1 + rng.below(3); changes > 0; --changes) {
      const std::size_t at = rng.below(text.size());
      const std::string_view some =
          "[]{}:,-&*!# \n\t\x01\xff"
          "019eN~|>";
      if (rng.below(2) == 0) {
        text[at] = some[rng.below(some.size())];
      } else {
        text.erase(at, rng.below(20));
      }
    }
    const std::string said = test::refusal<InputError>([&] {
      Scene scene = is_request ? Scene() : read_moveit_scene(file_of(text), {});
      if (is_request) take_moveit_request(scene, file_of(text), {});
    });
    EXPECT_EQ(said.find('\n'), std::string::npos) << seed;
  }
}

}  // namespace
}  // namespace warren
