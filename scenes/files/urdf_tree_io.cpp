// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/urdf_tree_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "core/base/types.hpp"

namespace warren {

UrdfTree::UrdfTree(const XmlFile& xml, const Execution& execution) : xml_(xml), execution_(execution) {
  constexpr std::size_t bytes_a_part = 1024;
  const auto parts = xml.root().children();
  execution.reserve(static_cast<std::size_t>(std::distance(parts.begin(), parts.end())) * bytes_a_part);
  read_links();
  read_joints();
  find_root();
  sort_joints();
  find_leaders();
}

std::size_t UrdfTree::number_in(const Numbers& numbers, const std::string& name) {
  const auto found = numbers.find(name);
  return found != numbers.end() ? found->second : no_urdf_part;
}

void UrdfTree::read_links() {
  for (const pugi::xml_node node : xml_.root().children("link")) {
    UrdfLink link{xml_.word(node, "name"), node};
    if (!link_numbers_.emplace(link.name, links_.size()).second)
      xml_.fail(node, "a second link of this name", link.name);
    links_.push_back(std::move(link));
  }
  if (links_.empty()) xml_.fail(xml_.root(), "a robot has at least one <link>");
  execution_.check();
}

void UrdfTree::read_joints() {
  for (const pugi::xml_node node : xml_.root().children("joint")) {
    UrdfJoint joint = read_joint(node);
    if (!joint_numbers_.emplace(joint.name, joints_.size()).second)
      xml_.fail(node, "a second joint of this name", joint.name);
    UrdfLink& below = links_[joint.below];
    if (below.joint != no_urdf_part) {
      xml_.fail(node, fmt::format("its child hangs on joint {} already", joints_[below.joint].name), below.name);
    }
    below.joint = joints_.size();
    links_[joint.above].joints.push_back(joints_.size());
    joints_.push_back(std::move(joint));
  }
  execution_.check();
}

UrdfJoint UrdfTree::read_joint(pugi::xml_node node) const {
  UrdfJoint joint{xml_.word(node, "name"), node};
  const std::string kind = xml_.word(node, "type");
  if (const auto known = enum_named<UrdfJointKind>(kind)) {
    joint.kind = *known;
  } else {
    xml_.fail(node, "`type` must be fixed, revolute, continuous or prismatic", kind);
  }
  if (joint.kind == UrdfJointKind::planar)
    xml_.fail(node, "planar joints are not planned for; make it fixed, or of two prismatic ones and a continuous one");
  joint.above = link_of(node, "parent");
  joint.below = link_of(node, "child");
  joint.origin = urdf_origin(xml_, node);
  if (!joint.moves()) return joint;
  joint.axis = xml_.vector(node.child("axis"), "xyz", joint.axis);
  const double length = joint.axis.stableNorm();
  if (!(length > 0.0)) xml_.fail(node.child("axis"), "the axis has no direction");
  joint.axis /= length;
  read_limits(joint);
  return joint;
}

void UrdfTree::read_limits(UrdfJoint& joint) const {
  const pugi::xml_node limit = joint.node.child("limit");
  joint.speed = xml_.number(limit, "velocity").value_or(0.0);
  if (joint.speed < 0.0) xml_.fail(limit, "`velocity` must be at least 0");
  if (joint.kind == UrdfJointKind::continuous) return;
  joint.low = xml_.number(limit, "lower").value_or(joint.low);
  joint.high = xml_.number(limit, "upper").value_or(joint.high);
  if (joint.low > joint.high) xml_.fail(limit, "`lower` must not exceed `upper`", fmt::format("{}", joint.low));
}

std::size_t UrdfTree::link_of(pugi::xml_node joint, const char* end) const {
  const pugi::xml_node node = joint.child(end);
  if (!node) xml_.fail(joint, fmt::format("<{} link=\"…\"> is missing", end));
  const std::string name = xml_.word(node, "link");
  const std::size_t link = link_named(name);
  if (link == no_urdf_part) xml_.fail(node, "no link has this name", name);
  return link;
}

void UrdfTree::find_root() {
  root_ = no_urdf_part;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].joint != no_urdf_part) continue;
    if (root_ != no_urdf_part)
      xml_.fail(links_[i].node, fmt::format("a second link that hangs on no joint, as {} does", links_[root_].name),
                links_[i].name);
    root_ = i;
  }
  if (root_ == no_urdf_part) xml_.fail(xml_.root(), "the joints go around in a circle");
}

void UrdfTree::sort_joints() {
  std::vector<UrdfJoint> sorted;
  std::vector<std::size_t> left{root_};
  while (!left.empty()) {
    UrdfLink& link = links_[left.back()];
    left.pop_back();
    if (link.joint != no_urdf_part) {
      sorted.push_back(std::move(joints_[link.joint]));
      link.joint = sorted.size() - 1;
      joint_numbers_[sorted.back().name] = link.joint;
    }
    std::sort(link.joints.begin(), link.joints.end(),
              [&](std::size_t a, std::size_t b) { return joints_[a].name > joints_[b].name; });
    for (const std::size_t joint : link.joints) left.push_back(joints_[joint].below);
    link.joints.clear();
    if (sorted.size() % 64 == 0) execution_.check();
  }
  if (sorted.size() != joints_.size()) xml_.fail(xml_.root(), "some joints go around in a circle");
  joints_ = std::move(sorted);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (joints_[j].kind == UrdfJointKind::floating && joints_[j].above != root_)
      xml_.fail(joints_[j].node, "floating joints are not planned for; make it fixed where the body is");
    links_[joints_[j].above].joints.push_back(j);
  }
}

/// Along each chain of followers: value = m (m' value' + o') + o.
void UrdfTree::find_leaders() {
  std::vector<UrdfJoint> read = joints_;
  for (UrdfJoint& joint : read) {
    const pugi::xml_node mimic = joint.moves() ? joint.node.child("mimic") : pugi::xml_node();
    if (!mimic) continue;
    joint.leader = joint_named(xml_.word(mimic, "joint"));
    if (joint.leader == no_urdf_part) xml_.fail(mimic, "no joint has this name", mimic.attribute("joint").value());
    joint.multiplier = xml_.number(mimic, "multiplier").value_or(1.0);
    joint.offset = xml_.number(mimic, "offset").value_or(0.0);
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    execution_.check();
    UrdfJoint& joint = joints_[j];
    std::size_t steps = 0;
    for (const UrdfJoint* at = &read[j]; at->leader != no_urdf_part; at = &read[joint.leader]) {
      joint.leader = at->leader;
      joint.offset += joint.multiplier * at->offset;
      joint.multiplier *= at->multiplier;
      if (++steps > joints_.size()) xml_.fail(joint.node, "joints mimic each other in a circle", joint.name);
    }
    if (!(std::abs(joint.multiplier) <= largest_coordinate && std::abs(joint.offset) <= largest_coordinate))
      xml_.fail(joint.node, "`multiplier` and `offset` along its mimics must not exceed 1e60", joint.name);
  }
}

std::vector<std::size_t> UrdfTree::between(std::size_t base, std::size_t tip) const {
  std::vector<bool> above_base(links_.size(), false);
  const auto parent = [&](std::size_t link) { return joints_[links_[link].joint].above; };
  for (std::size_t link = base; link != root_; link = parent(link)) above_base[link] = true;
  above_base[root_] = true;
  std::vector<std::size_t> found;
  std::size_t link = tip;
  for (; !above_base[link]; link = parent(link)) found.push_back(links_[link].joint);
  for (const std::size_t common = link; base != common; base = parent(base)) found.push_back(links_[base].joint);
  return found;
}

Eigen::Isometry3d urdf_origin(const XmlFile& xml, pugi::xml_node node) {
  const pugi::xml_node origin = node.child("origin");
  const Vec3 rpy = xml.vector(origin, "rpy", Vec3::Zero());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Matrix3d yaw_pitch =
      portable_product(turn_about(Vec3::UnitZ(), rpy.z()), turn_about(Vec3::UnitY(), rpy.y()));
  pose.linear() = portable_product(yaw_pitch, turn_about(Vec3::UnitX(), rpy.x()));
  pose.translation() = xml.vector(origin, "xyz", Vec3::Zero());
  return pose;
}

namespace {

/// Reads one group and those that it names.
class SrdfGroupReader {
 public:
  SrdfGroupReader(const UrdfTree& tree, const XmlFile& srdf) : tree_(tree), srdf_(srdf) {
    group_.has.assign(tree.joints().size(), false);
  }

  UrdfGroup read(const std::string& name) {
    names_ = {name};
    for (std::size_t i = 0; i < names_.size(); ++i)
      read_group(find(i == 0 ? srdf_.root() : named_in_[i - 1], names_[i]));
    for (const pugi::xml_node passive : srdf_.root().children("passive_joint")) {
      const std::size_t joint = tree_.joint_named(passive.attribute("name").value());
      if (joint != no_urdf_part) group_.has[joint] = false;
    }
    return std::move(group_);
  }

 private:
  pugi::xml_node find(pugi::xml_node asked, const std::string& name) const {
    std::string known;
    for (const pugi::xml_node group : srdf_.root().children("group")) {
      if (group.attribute("name").value() == name) return group;
      if (known.size() < 200) known += fmt::format("{}{}", known.empty() ? "" : ", ", group.attribute("name").value());
    }
    srdf_.fail(asked, known.empty() ? "it has no groups" : fmt::format("its groups are {}", known), name);
  }
  std::size_t link_named(pugi::xml_node node, const char* attribute) const {
    const std::size_t link = tree_.link_named(srdf_.word(node, attribute));
    if (link == no_urdf_part)
      srdf_.fail(node, fmt::format("{} has no link of this name", tree_.xml().name()),
                 node.attribute(attribute).value());
    return link;
  }
  void add_joint(pugi::xml_node node) {
    const std::string name = srdf_.word(node, "name");
    const pugi::xml_node base = srdf_.root().find_child_by_attribute("virtual_joint", "name", name.c_str());
    if (std::string_view(base.attribute("type").value()) == "fixed") return;
    const std::size_t joint = tree_.joint_named(name);
    if (base || (joint != no_urdf_part && tree_.joints()[joint].kind == UrdfJointKind::floating))
      srdf_.fail(node, "a base that moves is not planned for; name the joints of the arm alone", name);
    if (joint == no_urdf_part) srdf_.fail(node, fmt::format("{} has no joint of this name", tree_.xml().name()), name);
    group_.has[joint] = true;
  }
  void read_group(pugi::xml_node group) {
    bool has_tip = group_.tip != no_urdf_part;
    for (const pugi::xml_node chain : group.children("chain")) {
      const std::size_t tip = link_named(chain, "tip_link");
      for (const std::size_t joint : tree_.between(link_named(chain, "base_link"), tip)) group_.has[joint] = true;
      if (!has_tip) group_.tip = tip;
    }
    for (const pugi::xml_node joint : group.children("joint")) add_joint(joint);
    for (const pugi::xml_node link : group.children("link")) {
      const std::size_t joint = tree_.links()[link_named(link, "name")].joint;
      if (joint != no_urdf_part) group_.has[joint] = true;
    }
    for (const pugi::xml_node inner : group.children("group")) {
      std::string name = srdf_.word(inner, "name");
      if (!seen_.insert(name).second) continue;
      names_.push_back(std::move(name));
      named_in_.push_back(inner);
    }
  }

  const UrdfTree& tree_;
  const XmlFile& srdf_;
  UrdfGroup group_;
  std::vector<std::string> names_;
  std::vector<pugi::xml_node> named_in_;  // of all names but the first
  std::set<std::string> seen_;
};

}  // namespace

UrdfGroup read_srdf_group(const UrdfTree& tree, const XmlFile& srdf, const std::string& name) {
  return SrdfGroupReader(tree, srdf).read(name);
}

}  // namespace warren
