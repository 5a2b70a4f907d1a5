// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/matrix/matrix_worlds.hpp"
#include "tests/matrix/world_files.hpp"

namespace warren::test {
namespace {

constexpr double link_radius = 0.04;
constexpr double tool_length = 0.1;

MatrixBody polygon_body(const std::string& where, const Ring& outline) {
  return {"polygon_" + where, "polygon", polygon_text(outline), {.outline = outline}};
}

Ring scaled(Ring ring, double scale) {
  for (PlanePoint& p : ring) p = {scale * p.x, scale * p.y};
  return ring;
}

MatrixBody car_body(const std::string& where, const PlaneBody& shape, double tightest_turn, bool reverses) {
  PlaneBody body = shape;
  body.drives = true;
  body.reverses = reverses;
  body.turning_radius = tightest_turn;
  std::ostringstream text;
  text << "car ";
  if (shape.outline.empty()) {
    text << "radius " << shape.radius;
  } else {
    text << polygon_text(shape.outline);
  }
  text << " turning " << tightest_turn << " steering " << (reverses ? "reeds-shepp" : "dubins");
  return {(reverses ? "reeds_shepp_" : "dubins_") + where, "car", text.str(), body};
}

/// Three joints that lift, swing and stretch.
ArmBody short_arm() {
  constexpr double half_turn = 3.0;
  constexpr double right = 1.5707963267948966;
  return {.joints = {{0.2, 0.0, right, -half_turn, half_turn},
                     {0.0, 0.4, 0.0, -half_turn, half_turn, 0.1},
                     {0.0, 0.3, 0.0, -half_turn, half_turn}},
          .tool = 0.0,
          .radius = link_radius};
}

}  // namespace

std::vector<double> arm_start() { return {-0.9, 0.3, -0.5, 0.0, 0.0, 0.0}; }
std::vector<double> arm_goal() { return {0.9, 0.4, -0.7, 0.0, 0.0, 0.0}; }

namespace {

std::string dh_table_text() {
  std::ostringstream text;
  text.precision(17);
  text << "convention standard\nangles radians\n";
  for (const ArmJoint& j : short_arm().joints) {
    text << "joint " << j.d << ' ' << j.a << ' ' << j.alpha << ' ' << j.low << ' ' << j.high << ' ' << j.offset << '\n';
  }
  return text.str();
}

/// A standard table's arm without offsets: a link turns with its joint and is a capsule as far as the next one's axis.
std::string urdf_text(const ArmBody& arm) {
  std::ostringstream text;
  text.precision(17);
  text << "<robot name=\"arm\"><link name=\"base\"/>";
  double d = 0.0;
  double a = 0.0;
  double alpha = 0.0;
  for (std::size_t i = 0; i < arm.joints.size(); ++i) {
    const ArmJoint& j = arm.joints[i];
    text << "<joint name=\"q" << i + 1 << "\" type=\"revolute\"><parent link=\""
         << (i == 0 ? "base" : "link" + std::to_string(i)) << "\"/><child link=\"link" << i + 1 << "\"/><origin xyz=\""
         << a << " 0 " << d << "\" rpy=\"" << alpha << " 0 0\"/><axis xyz=\"0 0 1\"/><limit lower=\"" << j.low
         << "\" upper=\"" << j.high << "\" velocity=\"1\" effort=\"1\"/></joint><link name=\"link" << i + 1 << "\">";
    d = j.d + (i + 1 == arm.joints.size() ? arm.tool : 0.0);
    a = j.a;
    alpha = j.alpha;
    const double length = std::hypot(a, d);
    if (length > 0.0) {
      text << "<collision><origin xyz=\"" << 0.5 * a << " 0 " << 0.5 * d << "\" rpy=\"0 " << std::atan2(a, d)
           << " 0\"/><geometry><capsule radius=\"" << arm.radius << "\" length=\"" << length
           << "\"/></geometry></collision>";
    }
    text << "</link>\n";
  }
  text << "</robot>\n";
  return text.str();
}

/// Whatever may touch in an arm of a table: all of its links.
std::string srdf_text(const ArmBody& arm) {
  std::ostringstream text;
  text << "<robot name=\"arm\">";
  for (std::size_t i = 1; i <= arm.joints.size(); ++i) {
    for (std::size_t k = 1; k < i; ++k) {
      text << "<disable_collisions link1=\"link" << k << "\" link2=\"link" << i << "\" reason=\"Never\"/>";
    }
  }
  text << "</robot>\n";
  return text.str();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> arm_files() {
  const ArmBody puma = puma560_arm(link_radius, tool_length);
  return {{"three.dh", dh_table_text()}, {"puma.urdf", urdf_text(puma)}, {"puma.srdf", srdf_text(puma)}};
}

std::vector<MatrixBody> matrix_bodies(double scale) {
  const Ring around = scaled({{-0.2, -0.15}, {0.3, -0.15}, {0.3, 0.05}, {0.05, 0.05}, {0.05, 0.2}, {-0.2, 0.2}}, scale);
  const Ring ahead = scaled({{0.0, -0.1}, {0.4, -0.1}, {0.4, 0.1}, {0.0, 0.1}}, scale);
  const Ring beyond = scaled({{0.1, -0.08}, {0.4, -0.08}, {0.35, 0.08}, {0.1, 0.08}}, scale);
  const double turn = 0.3 * scale;
  std::vector<MatrixBody> bodies{{"point", "point", "point", {}},
                                 {"disc", "disc", "disc 0.2", {.radius = 0.2}},
                                 polygon_body("around", around),
                                 polygon_body("ahead", ahead),
                                 polygon_body("beyond", beyond)};
  for (const bool reverses : {false, true}) {
    bodies.push_back(car_body("around", {.outline = around}, turn, reverses));
    bodies.push_back(car_body("ahead", {.outline = ahead}, turn, reverses));
    bodies.push_back(car_body("beyond", {.outline = beyond}, turn, reverses));
    bodies.push_back(car_body("disc", {.radius = 0.15 * scale}, turn, reverses));
  }
  MatrixBody drive = car_body("ahead", {.outline = ahead}, turn, true);
  drive.name = "differential_ahead";
  drive.robot.replace(drive.robot.find("reeds-shepp"), std::string::npos, "differential");
  drive.plane.turns_on_spot = true;
  bodies.push_back(drive);
  bodies.push_back({"puma", "arm", "puma560 radius 0.04 tool 0.1", {}, puma560_arm(link_radius, tool_length)});
  bodies.push_back(
      {"urdf", "arm", "urdf FOLDER/puma.urdf srdf FOLDER/puma.srdf", {}, puma560_arm(link_radius, tool_length)});
  bodies.push_back({"arm_file", "arm", "arm FOLDER/three.dh radius 0.04", {}, short_arm()});
  return bodies;
}

}  // namespace warren::test
