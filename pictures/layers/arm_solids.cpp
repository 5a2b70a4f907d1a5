// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/arm_solids.hpp"

#include <algorithm>
#include <numbers>

#include "pictures/model/ticks.hpp"

namespace warren {
namespace {

Vec3 corner(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }

}  // namespace

SolidView solids_of(const Scene& scene, const Box& box, const Vec3& low, const Vec3& high, const Execution& execution) {
  constexpr double azimuth_rad = -0.3 * std::numbers::pi;
  constexpr double rise_rad = 0.13 * std::numbers::pi;
  constexpr double floor_a_reach = 1.3;
  SolidView view;
  view.box = box;
  view.azimuth_rad = azimuth_rad;
  view.rise_rad = rise_rad;
  view.target = 0.5 * (low + high);
  execution.reserve((scene.spheres.size() + scene.boxes.size()) * sizeof(Solid));
  double reach = 0.0;
  const auto include = [&](const Vec3& p, double radius) {
    reach = std::max(reach, (p - view.target).norm() + radius);
  };
  for (const Sphere& s : scene.spheres) {
    const Vec3 centre{s.x, s.y, s.z};
    if (s.radius > 0.0) view.solids.push_back({centre, centre, s.radius, colors::blocked_cell, Part::world});
    include(centre, s.radius);
  }
  for (const auto& [from, to] : scene.boxes) {
    view.solids.push_back({corner(from), corner(to), -1.0, colors::blocked_cell, Part::world});
    for (int k = 0; k < 8; ++k) {
      include({(k & 1) != 0 ? from[0] : to[0], (k & 2) != 0 ? from[1] : to[1], (k & 4) != 0 ? from[2] : to[2]}, 0.0);
    }
  }
  // What is not an obstacle is inside of low and high.
  include({low.x(), 0.5 * (low.y() + high.y()), 0.5 * (low.z() + high.z())}, 0.0);
  include({0.5 * (low.x() + high.x()), low.y(), 0.5 * (low.z() + high.z())}, 0.0);
  include({0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), low.z()}, 0.0);
  view.reach = reach > 0.0 ? reach : 1.0;
  view.floor_side = 2.0 * floor_a_reach * view.reach;
  const double half = floor_a_reach * view.reach;
  constexpr double squares = 12.0;
  view.square = tick_step(view.floor_side, squares);
  view.floor = {view.target.x() - half, view.target.y() - half, low.z()};
  return view;
}

void add_arm(SolidView& view, const ArmPath& path, double radius, const Execution& execution) {
  constexpr int postures = 5;
  constexpr double trace_pieces = 200.0;
  constexpr unsigned pale = 45;
  const auto add = [&](const JointState& q, Rgb color, double by) {
    const std::vector<Vec3> spine = path.spine(q);
    const double r = std::max(by * radius, least_radius * view.reach);
    for (std::size_t i = 1; i < spine.size(); ++i) {
      view.solids.push_back({spine[i - 1], spine[i], r, color, Part::body});
    }
  };
  add(path.states().front(), colors::start, 1.0);
  if (path.states().size() == 1) return;
  // Where these stand in start and goal they are under them.
  constexpr double thinner = 0.98;
  for (int k = 1; k <= postures; ++k) {
    add(path.at(static_cast<double>(k) / (postures + 1)), mixed(colors::body, colors::paper, pale), thinner);
  }
  add(path.states().back(), colors::goal, 1.0);
  const std::vector<ArmPath::Place> trace = path.places(trace_pieces, execution);
  const double thin = std::max(0.2 * radius, least_radius * view.reach);
  for (std::size_t i = 1; i < trace.size(); ++i) {
    view.solids.push_back({path.tool(trace[i - 1].q), path.tool(trace[i].q), thin, colors::path, Part::path});
  }
}

}  // namespace warren
