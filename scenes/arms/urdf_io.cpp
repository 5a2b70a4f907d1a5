// SPDX-License-Identifier: BSD-3-Clause
// Robots as ROS describes them: URDF, with groups and allowed pairs from an SRDF, as MoveIt reads both. Collision
// meshes are their convex hulls. What is taken of them is said in docs/file_formats.md, "Robots from files".
//
// Joints that don't move are folded into the poses of what hangs on them, so that each link stands in the frame of the
// last joint above it that moves. All walks go along the joints in depth-first order, none is recursive: URDFs may have
// any depth.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/arms/urdf_tree_io.hpp"
#include "scenes/arms/xml_file_io.hpp"
#include "scenes/scene/convex_hull.hpp"

namespace warren {
namespace {

constexpr std::size_t most_urdf_bytes = std::size_t{64} << 20;

/// What moves, and where the tool is.
struct UrdfGroup {
  std::vector<bool> has;           // by joint
  std::size_t tip = no_urdf_part;  // number of a link
};

/// One group of an SRDF and those that it names: chains, joints, links (the joint that each hangs on).
UrdfGroup group_of_srdf(const UrdfTree& tree, const XmlFile& srdf, const std::string& asked,
                        const Execution& execution) {
  UrdfGroup group{std::vector<bool>(tree.joints.size(), false)};
  std::vector<pugi::xml_node> groups;
  std::set<std::string> seen;
  const auto add_group = [&](pugi::xml_node by, const std::string& name) {
    if (!seen.insert(name).second) return;
    execution.check();
    std::string known;
    for (const pugi::xml_node other : srdf.root().children("group")) {
      if (other.attribute("name").value() == name) return groups.push_back(other);
      if (known.size() < 200) known += fmt::format("{}{}", known.empty() ? "" : ", ", other.attribute("name").value());
    }
    srdf.fail(by, known.empty() ? "it has no groups" : fmt::format("its groups are {}", known), name);
  };
  const auto link_of = [&](pugi::xml_node node, const char* attribute) {
    const std::string name = srdf.word(node, attribute);
    const std::size_t link = tree.link_named(name);
    if (link == no_urdf_part) srdf.fail(node, fmt::format("{} has no link of this name", tree.xml.name()), name);
    return link;
  };
  const auto add_joint = [&](pugi::xml_node node) {
    execution.check();
    const std::string name = srdf.word(node, "name");
    const pugi::xml_node base = srdf.root().find_child_by_attribute("virtual_joint", "name", name.c_str());
    if (std::string_view(base.attribute("type").value()) == "fixed") return;
    const std::size_t joint = tree.joint_named(name);
    if (base || (joint != no_urdf_part && tree.joints[joint].kind == UrdfJointKind::floating))
      srdf.fail(node, "a base that moves is not planned for; name the joints of the arm alone", name);
    if (joint == no_urdf_part) srdf.fail(node, fmt::format("{} has no joint of this name", tree.xml.name()), name);
    group.has[joint] = true;
  };
  add_group(srdf.root(), asked);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const pugi::xml_node read = groups[i];
    const bool has_tip = group.tip != no_urdf_part;
    for (const pugi::xml_node chain : read.children("chain")) {
      const std::size_t tip = link_of(chain, "tip_link");
      for (const std::size_t joint : tree.between(link_of(chain, "base_link"), tip)) group.has[joint] = true;
      if (!has_tip) group.tip = tip;
    }
    for (const pugi::xml_node joint : read.children("joint")) add_joint(joint);
    for (const pugi::xml_node link : read.children("link")) {
      const std::size_t joint = tree.links[link_of(link, "name")].joint;
      if (joint != no_urdf_part) group.has[joint] = true;
    }
    for (const pugi::xml_node inner : read.children("group")) add_group(inner, srdf.word(inner, "name"));
  }
  for (const pugi::xml_node passive : srdf.root().children("passive_joint")) {
    const std::size_t joint = tree.joint_named(passive.attribute("name").value());
    if (joint != no_urdf_part) group.has[joint] = false;
  }
  return group;
}

/// use: what the link is for, " to be the tool".
std::size_t link_named(const ArmFiles& files, const UrdfTree& tree, const std::string& name, std::string_view use) {
  const std::size_t link = tree.link_named(name);
  if (link == no_urdf_part) throw InputError(files.urdf, fmt::format("has no link of this name{}", use), name);
  return link;
}

/// Where the mesh that a URDF calls `name` may be, in this order.
std::vector<std::string> mesh_places(const std::string& name, const ArmFiles& files) {
  namespace fs = std::filesystem;
  constexpr std::string_view of_package = "package://";
  constexpr std::string_view of_file = "file://";
  if (name.starts_with(of_file)) return {name.substr(of_file.size())};
  const bool is_package = name.starts_with(of_package);
  const std::string path = is_package ? name.substr(of_package.size()) : name;
  if (fs::path(path).is_absolute()) return {path};
  std::vector<std::string> found;
  std::error_code error;
  fs::path folder = fs::absolute(files.urdf, error).lexically_normal().parent_path();
  if (!is_package) found.push_back((folder / path).string());
  const auto add = [&](const fs::path& beside) {
    found.push_back((beside / path).string());
    if (is_package) found.push_back((beside / path.substr(std::min(path.find('/'), path.size() - 1) + 1)).string());
  };
  for (const std::string& package : files.packages) add(package);
  for (std::size_t up = 0; is_package && up < 64; ++up, folder = folder.parent_path()) {
    add(folder);
    if (folder == folder.parent_path()) break;
  }
  return found;
}

/// Of what hangs on a joint that moves, from where it hangs while the joint's value is 0.
Eigen::Isometry3d motion(const UrdfJoint& joint, double value) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (joint.kind == UrdfJointKind::prismatic) {
    pose.translation() = value * joint.axis;
  } else {
    pose.linear() = turn_about(joint.axis, value);
  }
  return pose;
}

/// Of the root, in the world.
Eigen::Isometry3d base_of(const ArmFiles& files) {
  return files.base_pose ? pose_of_numbers(*files.base_pose) : Eigen::Isometry3d::Identity();
}

/// Makes the model of a tree whose group is known.
class ArmModelMaker {
 public:
  ArmModelMaker(const ArmFiles& files, const UrdfTree& tree, const UrdfGroup& group, const Execution& execution)
      : files_(files), tree_(tree), group_(group), execution_(execution) {}

  ArmModel make(const XmlFile* srdf) {
    model_.name = tree_.xml.root().attribute("name").value();
    for (const auto& [name, place] : files_.said)
      if (!is_known(name)) throw InputError(place, fmt::format("{} has no link of this name", files_.urdf), name);
    choose_variables();
    narrow_variables();
    hold_joints();
    const std::size_t tool = tool_link();
    place_links(tool);
    model_.tool_frame = frames_[tool];
    model_.tool = poses_[tool];
    model_.told.push_back(fmt::format("the tool is {}", tree_.links[tool].name));
    add_links();
    carry();
    pair_links(srdf);
    if (!missing_.empty())
      model_.told.push_back(fmt::format("named, but not in the robot: {}", fmt::join(missing_, ", ")));
    return std::move(model_);
  }

 private:
  static constexpr std::size_t no_variable = no_urdf_part;
  static constexpr std::string_view to_carry = " to attach a body to";

  void choose_variables() {
    variables_.assign(tree_.joints.size(), no_variable);
    std::size_t count = 0;
    for (std::size_t j = 0; j < tree_.joints.size(); ++j) {
      const UrdfJoint& joint = tree_.joints[j];
      if (!group_.has[j] || !joint.moves() || joint.leader != no_urdf_part || ++count > most_joints) continue;
      const bool continuous = joint.kind == UrdfJointKind::continuous;
      if (!continuous && !(std::isfinite(joint.low) && std::isfinite(joint.high)))
        tree_.xml.fail(joint.node, "a joint that moves needs <limit lower=\"…\" upper=\"…\">, or type continuous",
                       joint.name);
      if (joint.soft_low > joint.low || joint.soft_high < joint.high) {
        model_.told.push_back(fmt::format("{} keeps <limit>, {} to {}, not its soft limits, {} to {}", joint.name,
                                          joint.low, joint.high, joint.soft_low, joint.soft_high));
      }
      variables_[j] = model_.variables.size();
      model_.variables.push_back({joint.name, joint.kind == UrdfJointKind::prismatic, continuous,
                                  continuous ? -std::numbers::pi : joint.low,
                                  continuous ? std::numbers::pi : joint.high, joint.speed});
    }
    constexpr std::string_view advice = "choose some by `group NAME` of an SRDF, or by `base LINK tip LINK`";
    if (count == 0) throw InputError(files_.urdf, fmt::format("no joint moves on its own; {}", advice));
    if (count > most_joints) {
      throw InputError(files_.urdf, fmt::format("at most {} joints can be planned for; {}", most_joints, advice),
                       fmt::format("{} joints", count));
    }
  }

  /// All that follow a variable are within their limits and speeds; it has no end only where none feels the turn. Else
  /// those that follow it say where it ends.
  void narrow_variables() {
    for (const UrdfJoint& joint : tree_.joints) {
      if (joint.leader == no_urdf_part || variables_[joint.leader] == no_variable) continue;
      ArmVariable& variable = model_.variables[variables_[joint.leader]];
      const bool feels_no_turn = joint.kind == UrdfJointKind::continuous && std::fmod(joint.multiplier, 1.0) == 0.0;
      if (!variable.continuous || feels_no_turn || joint.multiplier == 0.0) continue;
      variable.continuous = false;
      variable.low = -no_limit;
      variable.high = no_limit;
    }
    for (const UrdfJoint& joint : tree_.joints) {
      if (joint.leader == no_urdf_part || variables_[joint.leader] == no_variable) continue;
      ArmVariable& variable = model_.variables[variables_[joint.leader]];
      if (joint.multiplier == 0.0) continue;
      if (joint.speed > 0.0) variable.speed = std::min(variable.speed, joint.speed / std::abs(joint.multiplier));
      if (variable.continuous) continue;
      const double one = (joint.low - joint.offset) / joint.multiplier;
      const double other = (joint.high - joint.offset) / joint.multiplier;
      variable.low = std::max(variable.low, std::min(one, other));
      variable.high = std::min(variable.high, std::max(one, other));
      if (variable.low > variable.high)
        tree_.xml.fail(joint.node, fmt::format("its limits leave no value to {}, which it mimics", variable.name),
                       joint.name);
    }
    for (ArmVariable& variable : model_.variables) {
      if (std::isfinite(variable.low) && std::isfinite(variable.high)) continue;
      constexpr double turn = 2.0 * std::numbers::pi;
      const double high = std::isfinite(variable.low) ? variable.low + turn : std::numbers::pi;
      if (std::isinf(variable.high)) variable.high = high;
      if (std::isinf(variable.low)) variable.low = variable.high - turn;
      model_.told.push_back(fmt::format("{} keeps {} to {}: what follows it has no end there, and turns out of step",
                                        variable.name, variable.low, variable.high));
    }
  }

  void hold_joints() {
    const std::vector<UrdfJoint>& joints = tree_.joints;
    held_.assign(joints.size(), 0.0);
    for (std::size_t j = 0; j < joints.size(); ++j) held_[j] = std::min(std::max(0.0, joints[j].low), joints[j].high);
    for (const auto& [name, value] : files_.held) {
      const std::size_t joint = tree_.joint_named(name);
      if (joint == no_urdf_part && value != 0.0)
        throw InputError(files_.urdf, "has no joint of this name to hold", name);
      if (joint == no_urdf_part) missing_.insert(name);
      if (joint != no_urdf_part && joints[joint].moves()) held_[joint] = value;
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].leader != no_urdf_part)
        held_[j] = joints[j].multiplier * held_[joints[j].leader] + joints[j].offset;
      if (joints[j].kind == UrdfJointKind::floating)
        push_asked(model_.assumed, fmt::format("joint {}, which floats, is where its origin is", joints[j].name),
                   execution_);
    }
  }

  /// As said; the group's tip; else what hangs on its last joint, on as far as there is one joint, which doesn't move.
  std::size_t tool_link() const {
    if (!files_.tool.empty()) return link_named(files_, tree_, files_.tool, " to be the tool");
    if (group_.tip != no_urdf_part) return group_.tip;
    const std::vector<UrdfJoint>& joints = tree_.joints;
    std::size_t last = 0;
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (variables_[j] != no_variable) last = j;
    std::size_t link = joints[last].below;
    while (tree_.links[link].joints.size() == 1) {
      const UrdfJoint& next = joints[tree_.links[link].joints[0]];
      if (next.moves()) break;
      link = next.below;
    }
    return link;
  }

  /// Is there anything on the link or farther out that a frame of its own matters to?
  std::vector<bool> links_that_matter(std::size_t tool) const {
    std::vector<bool> matters(tree_.links.size(), false);
    matters[tool] = true;
    for (const AttachedSolid& a : files_.attached) matters[link_named(files_, tree_, a.link, to_carry)] = true;
    for (std::size_t j = tree_.joints.size(); j-- > 0;) {
      const UrdfJoint& joint = tree_.joints[j];
      if (tree_.links[joint.below].node.child("collision")) matters[joint.below] = true;
      if (matters[joint.below]) matters[joint.above] = true;
    }
    return matters;
  }
  /// Of a link, or of what is carried.
  bool is_known(std::string_view name) const {
    return tree_.link_named(std::string(name)) != no_urdf_part ||
           std::ranges::any_of(files_.attached, [&](const AttachedSolid& a) { return a.solid.name == name; });
  }

  void place_links(std::size_t tool) {
    const std::vector<bool> matters = links_that_matter(tool);
    execution_.reserve(tree_.links.size() * sizeof(Eigen::Isometry3d));
    frames_.assign(tree_.links.size(), base_frame);
    poses_.assign(tree_.links.size(), Eigen::Isometry3d::Identity());
    poses_[tree_.root] = base_of(files_);
    model_.base = poses_[tree_.root].translation();
    for (std::size_t j = 0; j < tree_.joints.size(); ++j) {
      if (j % 256 == 0) execution_.check();
      const UrdfJoint& joint = tree_.joints[j];
      const Eigen::Isometry3d origin = poses_[joint.above] * joint.origin;
      const std::size_t leader = joint.leader == no_urdf_part ? j : joint.leader;
      if (variables_[leader] == no_variable || (leader != j && !matters[joint.below])) {
        frames_[joint.below] = frames_[joint.above];
        poses_[joint.below] = joint.moves() ? origin * motion(joint, held_[j]) : origin;
        if (variables_[leader] != no_variable) {
          push_asked(model_.idle_followers,
                     {.name = joint.name,
                      .variable = variables_[leader],
                      .multiplier = joint.multiplier,
                      .offset = joint.offset},
                     execution_);
        } else if (joint.moves()) {
          push_asked(model_.standing, {joint.name, held_[j]}, execution_);
        }
        continue;
      }
      if (model_.joints.size() == most_frames) {
        throw InputError(files_.urdf,
                         fmt::format("at most {} joints may move, those that mimic others included; choose fewer by "
                                     "`group NAME` of an SRDF, or by `base LINK tip LINK`",
                                     most_frames));
      }
      frames_[joint.below] = static_cast<int>(model_.joints.size());
      model_.joints.push_back({joint.name, frames_[joint.above], origin, joint.axis,
                               joint.kind == UrdfJointKind::prismatic, variables_[leader], joint.multiplier,
                               joint.offset});
    }
  }

  /// Those with solids, the root first, then depth first.
  void add_links() {
    numbers_.assign(tree_.links.size(), no_urdf_part);
    add_link(tree_.root);
    for (const UrdfJoint& joint : tree_.joints) add_link(joint.below);
  }
  void add_link(std::size_t number) {
    const UrdfLink& link = tree_.links[number];
    ArmLink made{link.name, frames_[number], {}};
    for (const pugi::xml_node collision : link.node.children("collision")) {
      execution_.check();
      Solid solid = shape(collision);
      solid.pose = poses_[number] * urdf_origin(tree_.xml, collision);
      solid.name = collision.attribute("name").value();
      made.solids.push_back(std::move(solid));
    }
    if (made.solids.empty()) return;
    numbers_[number] = model_.links.size();
    push_asked(model_.links, std::move(made), execution_);
  }
  Solid shape(pugi::xml_node collision) {
    const XmlFile& xml = tree_.xml;
    const auto is_element = [](pugi::xml_node n) { return n.type() == pugi::node_element; };
    const auto one_in = [&](pugi::xml_node outer, auto is_meant) {
      const pugi::xml_node first = outer.find_child(is_meant);
      for (pugi::xml_node next = first.next_sibling(); next; next = next.next_sibling())
        if (is_meant(next)) xml.fail(next, "a second one; each <collision> has one <geometry>, of one shape");
      return first;
    };
    const pugi::xml_node geometry =
        one_in(collision, [](pugi::xml_node n) { return std::string_view(n.name()) == "geometry"; });
    const pugi::xml_node node = one_in(geometry, is_element);
    const std::string_view kind = node.name();
    Solid solid;
    if (kind == "mesh") {
      const Solid& hull = hull_of(node);
      execution_.reserve(hull.corners.size() * sizeof(Vec3) + hull.faces.size() * sizeof(hull.faces[0]));
      return hull;
    }
    if (kind == "box") {
      solid.kind = SolidKind::box;
      solid.half = 0.5 * xml.vector(node, "size", Vec3::Constant(-1.0));
      if (!(solid.half.array() >= 0.0).all()) xml.fail(node, "`size` must be three numbers of at least 0");
    } else if (kind == "sphere") {
      solid.half.x() = xml.size(node, "radius");
    } else if (kind == "cylinder" || kind == "capsule") {
      solid.kind = kind == "capsule" ? SolidKind::capsule : SolidKind::cylinder;
      solid.half = {xml.size(node, "radius"), 0.0, 0.5 * xml.size(node, "length")};
    } else {
      xml.fail(node ? node : collision, "its <geometry> must be a box, cylinder, capsule, sphere or mesh", kind);
    }
    return solid;
  }

  /// Collision meshes as hulls, each file and scale once.
  const Solid& hull_of(pugi::xml_node mesh) {
    const std::string path = place_of(mesh, tree_.xml.word(mesh, "filename"));
    const Vec3 scale = tree_.xml.vector(mesh, "scale", Vec3::Ones());
    const auto [at, is_new] = hulls_.try_emplace({path, {scale.x(), scale.y(), scale.z()}});
    if (!is_new) return at->second;
    const Mesh read = read_mesh(InputFile(path, execution_), execution_, scale);
    at->second = convex_hull(read.points, path, execution_);
    model_.told.push_back(fmt::format("hull of {}: {}", std::filesystem::path(path).filename().string(),
                                      hull_excess(read, at->second, execution_)));
    return at->second;
  }

  std::string place_of(pugi::xml_node mesh, const std::string& name) const {
    const std::vector<std::string> tried = mesh_places(name, files_);
    for (const std::string& place : tried) {
      std::error_code error;
      if (std::filesystem::is_regular_file(place, error)) return place;
    }
    constexpr std::size_t most_shown = 6;
    const auto shown = std::span(tried).first(std::min(most_shown, tried.size()));
    tree_.xml.fail(mesh,
                   fmt::format("the mesh is not there; looked for {}{}; `package-path DIR` says where its package is",
                               fmt::join(shown, ", "), tried.size() > most_shown ? " and in the folders above" : ""),
                   name);
  }

  void carry() {
    for (const AttachedSolid& attached : files_.attached) {
      const std::size_t link = link_named(files_, tree_, attached.link, to_carry);
      Solid solid = attached.solid;
      solid.pose = poses_[link] * solid.pose;
      const std::string name = solid.name.empty() ? fmt::format("what {} carries", attached.link) : solid.name;
      model_.links.push_back({name, frames_[link], {std::move(solid)}});
    }
  }

  /// Numbers of links that may touch, the lower first; those of one's own name too.
  using Allowed = std::set<std::pair<std::size_t, std::size_t>>;
  static constexpr std::size_t bytes_a_pair = 64;

  void pair_links(const XmlFile* srdf) {
    const std::size_t count = model_.links.size();
    const std::size_t own = count - files_.attached.size();
    std::map<std::string_view, std::vector<std::size_t>> named;
    for (std::size_t i = 0; i < count; ++i) named[model_.links[i].name].push_back(i);
    const auto numbers_named = [&](std::string_view name) {
      if (!is_known(name)) missing_.emplace(name);
      const auto found = named.find(name);
      return found != named.end() ? std::span<const std::size_t>(found->second) : std::span<const std::size_t>();
    };
    Allowed allowed;
    const auto allow_numbers = [&](std::span<const std::size_t> some, std::span<const std::size_t> others) {
      for (const std::size_t a : some) {
        execution_.reserve(others.size() * bytes_a_pair);
        for (const std::size_t b : others) allowed.insert(std::minmax(a, b));
      }
    };
    const auto allow = [&](std::string_view one, std::string_view other) {
      allow_numbers(numbers_named(one), numbers_named(other));
    };
    if (srdf != nullptr) allow_by_srdf(*srdf, allow);
    for (const auto& [one, other] : files_.allowed) allow(one, other);
    for (std::size_t i = own; i < count; ++i) {
      for (const std::string& link : files_.attached[i - own].may_touch) allow_numbers({&i, 1}, numbers_named(link));
    }
    allow_neighbours(allowed);
    for (std::size_t a = 0; a < count; ++a) {
      execution_.check();
      for (std::size_t b = a + 1; b < count; ++b) {
        execution_.poll(b);
        if (model_.links[a].frame == model_.links[b].frame || allowed.contains({a, b})) continue;
        push_asked(model_.pairs, {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)}, execution_);
      }
    }
  }
  template <class Allow>
  void allow_by_srdf(const XmlFile& srdf, const Allow& allow) const {
    const auto link_in = [&](pugi::xml_node node, const char* attribute) {
      srdf.word(node, attribute);
      return std::string_view(node.attribute(attribute).value());
    };
    std::set<std::pair<std::string_view, std::string_view>> enabled;
    for (const pugi::xml_node pair : srdf.root().children("enable_collisions"))
      enabled.insert(std::minmax<std::string_view>(link_in(pair, "link1"), link_in(pair, "link2")));
    for (const pugi::xml_node node : srdf.root().children("disable_default_collisions")) {
      const std::string_view link = link_in(node, "link");
      execution_.check();
      execution_.reserve(model_.links.size() * bytes_a_pair);
      for (const ArmLink& other : model_.links)
        if (!enabled.contains(std::minmax<std::string_view>(link, other.name))) allow(link, other.name);
    }
    for (const pugi::xml_node pair : srdf.root().children("disable_collisions"))
      allow(link_in(pair, "link1"), link_in(pair, "link2"));
  }
  /// Links without solids pass on whose neighbour a link is.
  void allow_neighbours(Allowed& allowed) const {
    std::vector<std::size_t> nearest = numbers_;  // of each link, the model's link that it is or hangs on
    for (const UrdfJoint& joint : tree_.joints) {
      const std::size_t above = nearest[joint.above];
      if (nearest[joint.below] == no_urdf_part) {
        nearest[joint.below] = above;
      } else if (above != no_urdf_part) {
        allowed.insert(std::minmax(above, nearest[joint.below]));
      }
    }
  }

  const ArmFiles& files_;
  const UrdfTree& tree_;
  const UrdfGroup& group_;
  const Execution& execution_;
  ArmModel model_;
  std::vector<std::size_t> variables_;                                    // by joint
  std::vector<double> held_;                                              // by joint
  std::vector<int> frames_;                                               // by link
  std::vector<Eigen::Isometry3d> poses_;                                  // by link, in its frame
  std::vector<std::size_t> numbers_;                                      // by link, in the model
  std::set<std::string> missing_;                                         // what is named, but not there
  std::map<std::pair<std::string, std::array<double, 3>>, Solid> hulls_;  // of files and scales
};

UrdfGroup chosen_group(const ArmFiles& files, const UrdfTree& tree, const XmlFile* srdf, const Execution& execution) {
  if (!files.group.empty()) {
    if (srdf == nullptr) throw InputError(files.urdf, "`group` needs `srdf FILE`, whose group it names", files.group);
    return group_of_srdf(tree, *srdf, files.group, execution);
  }
  if (files.base.empty() && files.tip.empty()) return {std::vector<bool>(tree.joints.size(), true), no_urdf_part};
  UrdfGroup group{std::vector<bool>(tree.joints.size(), false), link_named(files, tree, files.tip, "")};
  const std::size_t base = files.base.empty() ? tree.root : link_named(files, tree, files.base, "");
  for (const std::size_t joint : tree.between(base, group.tip)) group.has[joint] = true;
  return group;
}

}  // namespace

ArmModel read_urdf(const ArmFiles& files, const Execution& execution) {
  return read_urdf(files, InputFile(files.urdf, execution), execution);
}

ArmModel read_urdf(const ArmFiles& files, const InputFile& urdf, const Execution& execution) {
  const XmlFile xml(urdf, "robot", most_urdf_bytes, execution);
  const UrdfTree tree(xml, execution);
  std::optional<InputFile> srdf_file;
  std::optional<XmlFile> srdf;
  if (!files.srdf.empty()) srdf.emplace(srdf_file.emplace(files.srdf, execution), "robot", most_urdf_bytes, execution);
  const XmlFile* rules = srdf ? &*srdf : nullptr;
  const UrdfGroup group = chosen_group(files, tree, rules, execution);
  return ArmModelMaker(files, tree, group, execution).make(rules);
}

RobotFrames read_robot_frames(const ArmFiles& files, const Execution& execution) {
  const InputFile file(files.urdf, execution);
  const XmlFile xml(file, "robot", most_urdf_bytes, execution);
  const UrdfTree tree(xml, execution);
  const std::string& root = tree.links[tree.root].name;
  RobotFrames robot;
  std::map<std::string, LinkFrame>& frames = robot.links;
  frames.emplace(root, LinkFrame{base_of(files)});
  for (const UrdfJoint& joint : tree.joints) {
    execution.check();
    LinkFrame frame = frames.at(tree.links[joint.above].name);
    frame.pose = frame.pose * joint.origin;
    if (joint.moves()) {
      const std::string& leader = joint.leader == no_urdf_part ? joint.name : tree.joints[joint.leader].name;
      const auto held = std::ranges::find(files.held, leader, [](const auto& other) { return other.first; });
      frame.moves_with = joint.name;
      if (held != files.held.end()) {
        frame.pose = frame.pose * motion(joint, joint.multiplier * held->second + joint.offset);
      } else if (frame.open.empty()) {
        frame.open = leader;
      }
    }
    frames.emplace(tree.links[joint.below].name, std::move(frame));
  }
  if (files.srdf.empty()) return robot;
  const InputFile srdf_file(files.srdf, execution);
  const XmlFile srdf(srdf_file, "robot", most_urdf_bytes, execution);
  const pugi::xml_node base = srdf.root().find_child_by_attribute("virtual_joint", "child_link", root.c_str());
  if (base) frames.emplace(base.attribute("parent_frame").value(), LinkFrame{});
  robot.base_joint = base.attribute("name").value();
  robot.base_kind = base.attribute("type").value();
  return robot;
}

}  // namespace warren
