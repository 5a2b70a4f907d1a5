// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/properties.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "scenes/arms/arm_files_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren::fuzz {
namespace {

/// One character off the front of UTF-8, by the shape of its bits; none where that is broken.
std::optional<std::uint32_t> take_character(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (lead < 0x80) return lead;
  int more = 0;
  while (more < 4 && (lead << more & 0x80U) != 0) ++more;
  if (more < 2 || more > 4 || (lead == 0xff) || (lead & 0xf8U) == 0xf8) return std::nullopt;
  std::uint32_t code = lead & ((1U << (7 - more)) - 1);
  for (int i = 1; i < more; ++i) {
    if (text.empty() || (static_cast<unsigned char>(text.front()) & 0xc0U) != 0x80) return std::nullopt;
    code = code << 6U | (static_cast<unsigned char>(text.front()) & 0x3fU);
    text.remove_prefix(1);
  }
  const std::uint32_t shortest = more == 2 ? 0x80 : more == 3 ? 0x800 : 0x10000;
  if (code < shortest) return std::nullopt;
  return code;
}

/// Controls, and what reorders a line or begins another.
bool disturbs(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x61c || code == 0x200e || code == 0x200f ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code > 0x10ffff ||
         (code >= 0xd800 && code < 0xe000);
}

std::vector<Segment> segments_of(const WallSet& walls) {
  std::vector<Segment> segments;
  walls.visit([&](auto span) {
    for (const auto& wall : span) segments.push_back(wall.segment());
  });
  return segments;
}

bool same_solids(const Scene& a, const Scene& b) {
  const auto same_sphere = [](const Sphere& s, const Sphere& t) {
    return s.x == t.x && s.y == t.y && s.z == t.z && s.radius == t.radius;
  };
  const auto same_box = [](const SolidBox& s, const SolidBox& t) { return s.low == t.low && s.high == t.high; };
  return std::equal(a.spheres.begin(), a.spheres.end(), b.spheres.begin(), b.spheres.end(), same_sphere) &&
         std::equal(a.boxes.begin(), a.boxes.end(), b.boxes.begin(), b.boxes.end(), same_box) &&
         std::ranges::equal(a.solids, b.solids, {}, solid_text, solid_text);
}

}  // namespace

void demand(bool holds, std::string_view what) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

void demand_message(std::string_view text) {
  demand(!text.empty(), "a message says something");
  while (!text.empty()) {
    const auto code = take_character(text);
    demand(code.has_value(), "a message is UTF-8");
    demand(!disturbs(*code), "a message is one printable line");
  }
}

const Execution& fuzz_execution() {
  constexpr std::size_t memory = std::size_t{1} << 30;
  static const Deadline deadline(std::numeric_limits<double>::infinity(), memory);
  static const Execution execution{1, &deadline};
  return execution;
}

void demand_same_robot(const RobotSpec& a, const RobotSpec& b) {
  demand(a.kind == b.kind && a.radius == b.radius && a.turning_radius == b.turning_radius && a.tool == b.tool &&
             a.steering == b.steering && a.limits == b.limits && a.table == b.table &&
             a.self_collision == b.self_collision && a.outline == b.outline,
         "the same robot");
}

void demand_same_scene(const Scene& a, const Scene& b, bool turned) {
  demand(segments_of(a.walls) == segments_of(b.walls), "the same walls");
  demand(a.polygons.size() == b.polygons.size(), "as many polygons");
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    const std::vector<Vec2>& corners = a.polygons[i].corners;
    demand((turned ? anticlockwise(corners) : corners) == b.polygons[i].corners, "the same corners");
  }
  demand(same_solids(a, b), "the same spheres and boxes");
  demand(a.bounds.has_value() == b.bounds.has_value(), "bounds or none");
  if (a.bounds) demand(a.bounds->min == b.bounds->min && a.bounds->max == b.bounds->max, "the same bounds");
  demand(a.clearance == b.clearance && a.maze == b.maze, "the same clearance and maze");
  demand(a.start == b.start && a.goal == b.goal, "the same start and goal");
  demand(a.robot.has_value() == b.robot.has_value(), "a robot or none");
  if (a.robot) demand_same_robot(*a.robot, *b.robot);
  demand(a.grid.has_value() == b.grid.has_value(), "a grid or none");
  if (a.grid) demand(a.grid->cell == b.grid->cell && a.grid->angles == b.grid->angles, "the same grid");
}

void demand_same_cells(const OccupancyMap& a, const OccupancyMap& b) {
  demand(a.blocked == b.blocked, "the same blocked cells");
  demand(a.unknown == b.unknown, "the same unknown cells");
  demand(a.water == b.water, "the same water");
  demand(a.free == b.free, "as many free cells");
}

}  // namespace warren::fuzz
