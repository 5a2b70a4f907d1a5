// SPDX-License-Identifier: BSD-3-Clause
// The tree of links and joints that a URDF describes, and which of its joints a group of an SRDF has: as MoveIt reads
// both, but that what it takes silently for a default, and would give another robot, is refused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.hpp"
#include "parallel/execution.hpp"
#include "scenes/files/xml_file_io.hpp"

namespace warren {

inline constexpr std::size_t no_urdf_part = std::numeric_limits<std::size_t>::max();
inline constexpr std::size_t most_urdf_bytes = std::size_t{64} << 20;

enum class UrdfJointKind : std::uint8_t { fixed, revolute, continuous, prismatic, floating, planar };
constexpr auto enum_names(UrdfJointKind) {
  return std::array<std::string_view, 6>{"fixed", "revolute", "continuous", "prismatic", "floating", "planar"};
}

struct UrdfJoint {
  std::string name;
  pugi::xml_node node;
  UrdfJointKind kind = UrdfJointKind::fixed;
  std::size_t above = no_urdf_part;  ///< number of the link that it hangs on
  std::size_t below = no_urdf_part;  ///< of the link that hangs on it
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  Vec3 axis{1.0, 0.0, 0.0};                               ///< of length 1, in its own frame
  double low = -std::numeric_limits<double>::infinity();  ///< infinite: its file has no limit
  double high = std::numeric_limits<double>::infinity();
  double speed = 0.0;  ///< 0: its file has none
  /// Number of the joint that it follows, which follows none: its value is multiplier * that one's + offset.
  std::size_t leader = no_urdf_part;
  double multiplier = 1.0;
  double offset = 0.0;

  bool moves() const { return kind >= UrdfJointKind::revolute && kind <= UrdfJointKind::prismatic; }
};

struct UrdfLink {
  std::string name;
  pugi::xml_node node;
  std::size_t joint = no_urdf_part;  ///< number of the joint that it hangs on; the root has none
  std::vector<std::size_t> joints = {};
};

class UrdfTree {
 public:
  /// Throws InputError, Stopped; `xml` outlives it.
  UrdfTree(const XmlFile& xml, const Execution& execution);

  const XmlFile& xml() const { return xml_; }
  const std::vector<UrdfLink>& links() const { return links_; }
  /// Depth first: a joint comes after all above it; of those that hang on one link in the order of their names.
  const std::vector<UrdfJoint>& joints() const { return joints_; }
  std::size_t root() const { return root_; }
  /// Its number, or no_urdf_part.
  std::size_t link_named(const std::string& name) const { return number_in(link_numbers_, name); }
  std::size_t joint_named(const std::string& name) const { return number_in(joint_numbers_, name); }
  /// The joints between two links, in any order.
  std::vector<std::size_t> between(std::size_t base, std::size_t tip) const;

 private:
  using Numbers = std::map<std::string, std::size_t, std::less<>>;
  static std::size_t number_in(const Numbers& numbers, const std::string& name);
  void read_links();
  void read_joints();
  UrdfJoint read_joint(pugi::xml_node node) const;
  void read_limits(UrdfJoint& joint) const;
  std::size_t link_of(pugi::xml_node joint, const char* end) const;
  void find_root();
  void sort_joints();
  void find_leaders();

  const XmlFile& xml_;
  const Execution& execution_;
  std::vector<UrdfLink> links_;
  std::vector<UrdfJoint> joints_;
  Numbers link_numbers_;
  Numbers joint_numbers_;
  std::size_t root_ = 0;
};

/// `xyz` and `rpy` of an element's <origin>.
Eigen::Isometry3d urdf_origin(const XmlFile& xml, pugi::xml_node node);

/// What moves, and where the tool is.
struct UrdfGroup {
  std::vector<bool> has;           ///< by joint
  std::size_t tip = no_urdf_part;  ///< number of a link
};

/// Chains, joints, links (the joint that each hangs on) and groups of the group of that name, passive joints left out.
UrdfGroup read_srdf_group(const UrdfTree& tree, const XmlFile& srdf, const std::string& name);

}  // namespace warren
