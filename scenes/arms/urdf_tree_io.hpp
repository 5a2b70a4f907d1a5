// SPDX-License-Identifier: BSD-3-Clause
// The tree of a URDF: links, and the joints between them as the file has them. For urdf_io.cpp alone.
#pragma once

#include <fmt/format.h>
#include <pugixml.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/sort.hpp"
#include "scenes/arms/xml_file_io.hpp"
#include "scenes/scene/arm_model.hpp"

namespace warren {

inline constexpr std::size_t no_urdf_part = std::numeric_limits<std::size_t>::max();
inline constexpr double no_limit = std::numeric_limits<double>::infinity();

enum class UrdfJointKind : std::uint8_t { fixed, revolute, continuous, prismatic, floating, planar };
constexpr auto enum_names(UrdfJointKind) {
  return std::array<std::string_view, 6>{"fixed", "revolute", "continuous", "prismatic", "floating", "planar"};
}

struct UrdfJoint {
  std::string name;
  pugi::xml_node node;
  UrdfJointKind kind = UrdfJointKind::fixed;
  std::size_t above = no_urdf_part;  // number of the link that it hangs on
  std::size_t below = no_urdf_part;  // of the link that hangs on it
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  Vec3 axis{1.0, 0.0, 0.0};
  double low = -no_limit;
  double high = no_limit;
  double soft_low = -no_limit;  // a controller's, which are told, not kept
  double soft_high = no_limit;
  double speed = 0.0;
  std::size_t leader = no_urdf_part;  // the joint that it follows, which follows none:
  double multiplier = 1.0;            // its value is multiplier * that one's + offset
  double offset = 0.0;

  bool moves() const { return kind >= UrdfJointKind::revolute && kind <= UrdfJointKind::prismatic; }
};

struct UrdfLink {
  std::string name;
  pugi::xml_node node;
  std::size_t joint = no_urdf_part;  // that it hangs on; the root has none
  std::vector<std::size_t> joints = {};
};

inline Eigen::Isometry3d urdf_origin(const XmlFile& xml, pugi::xml_node node) {
  const Vec3 rpy = xml.vector(node.child("origin"), "rpy", Vec3::Zero());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      turn_about(Vec3::UnitZ(), rpy.z()) * turn_about(Vec3::UnitY(), rpy.y()) * turn_about(Vec3::UnitX(), rpy.x());
  pose.translation() = xml.vector(node.child("origin"), "xyz", Vec3::Zero());
  return pose;
}

/// Links and joints. Joints are in depth-first order, those on one link in the order of their names, as MoveIt has
/// them.
class UrdfTree {
 public:
  UrdfTree(const XmlFile& file, const Execution& execution) : xml(file), execution_(execution) {
    constexpr std::size_t bytes_a_part = 1024;
    const auto parts = xml.root().children();
    refuse_macros();
    execution.reserve(static_cast<std::size_t>(std::distance(parts.begin(), parts.end())) * bytes_a_part);
    for (const pugi::xml_node node : xml.root().children("link")) {
      execution.poll(links.size());
      links.push_back({xml.word(node, "name"), node});
      if (!link_numbers_.emplace(links.back().name, links.size() - 1).second)
        xml.fail(node, "a second link of this name", links.back().name);
    }
    for (const pugi::xml_node node : xml.root().children("joint")) add_joint(node);
    find_root();
    sort_joints();
    find_leaders();
  }

  std::size_t link_named(const std::string& name) const { return number_in(link_numbers_, name); }
  std::size_t joint_named(const std::string& name) const { return number_in(joint_numbers_, name); }
  /// The joints between two links, in any order.
  std::vector<std::size_t> between(std::size_t base, std::size_t tip) const {
    const auto parent = [&](std::size_t link) { return joints[links[link].joint].above; };
    std::vector<bool> above_base(links.size(), false);
    for (std::size_t link = base; link != root; link = parent(link)) above_base[link] = true;
    above_base[root] = true;
    std::vector<std::size_t> found;
    for (; !above_base[tip]; tip = parent(tip)) found.push_back(links[tip].joint);
    for (; base != tip; base = parent(base)) found.push_back(links[base].joint);
    return found;
  }

  const XmlFile& xml;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::size_t root = no_urdf_part;

 private:
  using Numbers = std::map<std::string, std::size_t>;
  static std::size_t number_in(const Numbers& numbers, const std::string& name) {
    const auto found = numbers.find(name);
    return found != numbers.end() ? found->second : no_urdf_part;
  }

  /// What xacro would make of them is a part of the robot.
  void refuse_macros() const {
    std::size_t seen = 0;
    const auto is_macro = [&](pugi::xml_node node) {
      if (++seen % 256 == 0) execution_.check();
      return std::string_view(node.name()).starts_with("xacro:");
    };
    if (const pugi::xml_node macro = xml.root().find_node(is_macro))
      xml.fail(macro, "not a URDF yet; `xacro FILE > robot.urdf` makes one");
  }
  void add_joint(pugi::xml_node node) {
    execution_.poll(joints.size());
    UrdfJoint joint{xml.word(node, "name"), node};
    const std::string kind = xml.word(node, "type");
    const auto known = enum_named<UrdfJointKind>(kind);
    if (!known) xml.fail(node, "`type` must be fixed, revolute, continuous or prismatic", kind);
    if (*known == UrdfJointKind::planar)
      xml.fail(node, "planar joints are not planned for; make it fixed, or of two prismatic ones and a continuous one");
    joint.kind = *known;
    joint.above = link_of(node, "parent");
    joint.below = link_of(node, "child");
    joint.origin = urdf_origin(xml, node);
    if (joint.moves()) read_motion(joint);
    UrdfLink& below = links[joint.below];
    if (below.joint != no_urdf_part)
      xml.fail(node, fmt::format("its child hangs on joint {} already", joints[below.joint].name), below.name);
    if (!joint_numbers_.emplace(joint.name, joints.size()).second)
      xml.fail(node, "a second joint of this name", joint.name);
    below.joint = joints.size();
    links[joint.above].joints.push_back(joints.size());
    joints.push_back(std::move(joint));
  }
  void read_motion(UrdfJoint& joint) const {
    joint.axis = xml.vector(joint.node.child("axis"), "xyz", joint.axis);
    if (!(joint.axis.stableNorm() > 0.0)) xml.fail(joint.node.child("axis"), "the axis has no direction");
    joint.axis /= joint.axis.stableNorm();
    const pugi::xml_node limit = joint.node.child("limit");
    joint.speed = xml.number(limit, "velocity").value_or(0.0);
    if (joint.speed < 0.0) xml.fail(limit, "`velocity` must be at least 0");
    if (joint.kind == UrdfJointKind::continuous) return;
    joint.low = xml.number(limit, "lower").value_or(joint.low);
    joint.high = xml.number(limit, "upper").value_or(joint.high);
    if (joint.low > joint.high) xml.fail(limit, "`lower` must not exceed `upper`", fmt::format("{}", joint.low));
    const pugi::xml_node safety = joint.node.child("safety_controller");
    joint.soft_low = xml.number(safety, "soft_lower_limit").value_or(joint.low);
    joint.soft_high = xml.number(safety, "soft_upper_limit").value_or(joint.high);
  }
  std::size_t link_of(pugi::xml_node joint, const char* end) const {
    const pugi::xml_node node = joint.child(end);
    if (!node) xml.fail(joint, fmt::format("<{} link=\"…\"> is missing", end));
    const std::size_t link = link_named(xml.word(node, "link"));
    if (link == no_urdf_part) xml.fail(node, "no link has this name", xml.word(node, "link"));
    return link;
  }
  void find_root() {
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i].joint != no_urdf_part) continue;
      if (root != no_urdf_part)
        xml.fail(links[i].node, fmt::format("a second link that hangs on no joint, as {} does", links[root].name),
                 links[i].name);
      root = i;
    }
    if (root == no_urdf_part) xml.fail(xml.root(), "it has no <link> that hangs on no joint");
  }
  void sort_joints() {
    std::vector<UrdfJoint> sorted;
    std::vector<std::size_t> left{root};
    while (!left.empty()) {
      UrdfLink& link = links[left.back()];
      left.pop_back();
      if (link.joint != no_urdf_part) {
        sorted.push_back(std::move(joints[link.joint]));
        link.joint = sorted.size() - 1;
        joint_numbers_[sorted.back().name] = link.joint;
      }
      polled_sort(link.joints.begin(), link.joints.end(), execution_,
                  [&](std::size_t a, std::size_t b) { return joints[a].name > joints[b].name; });
      for (const std::size_t joint : link.joints) left.push_back(joints[joint].below);
      link.joints.clear();
      if (sorted.size() % 64 == 0) execution_.check();
    }
    if (sorted.size() != joints.size()) xml.fail(xml.root(), "some joints go around in a circle");
    joints = std::move(sorted);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      execution_.poll(j);
      if (joints[j].kind == UrdfJointKind::floating && joints[j].above != root)
        xml.fail(joints[j].node, "floating joints are not planned for; make it fixed where the body is");
      links[joints[j].above].joints.push_back(j);
    }
  }
  /// Along each chain of followers: value = m (m' value' + o') + o.
  void find_leaders() {
    std::vector<UrdfJoint> read;
    read.reserve(joints.size());
    for (const UrdfJoint& in_file : joints) {
      execution_.poll(read.size());
      UrdfJoint& joint = read.emplace_back(in_file);
      const pugi::xml_node mimic = joint.moves() ? joint.node.child("mimic") : pugi::xml_node();
      if (!mimic) continue;
      joint.leader = joint_named(xml.word(mimic, "joint"));
      if (joint.leader == no_urdf_part) xml.fail(mimic, "no joint has this name", xml.word(mimic, "joint"));
      joint.multiplier = xml.number(mimic, "multiplier").value_or(1.0);
      joint.offset = xml.number(mimic, "offset").value_or(0.0);
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      execution_.check();
      UrdfJoint& joint = joints[j];
      std::size_t steps = 0;
      for (const UrdfJoint* at = &read[j]; at->leader != no_urdf_part; at = &read[joint.leader]) {
        joint.leader = at->leader;
        joint.offset += joint.multiplier * at->offset;
        joint.multiplier *= at->multiplier;
        execution_.poll(++steps);
        if (steps > joints.size()) xml.fail(joint.node, "joints mimic each other in a circle", joint.name);
      }
      if (!(std::abs(joint.multiplier) <= largest_coordinate && std::abs(joint.offset) <= largest_coordinate))
        xml.fail(joint.node, "`multiplier` and `offset` along its mimics must not exceed 1e60", joint.name);
    }
  }

  const Execution& execution_;
  Numbers link_numbers_;
  Numbers joint_numbers_;
};

}  // namespace warren
