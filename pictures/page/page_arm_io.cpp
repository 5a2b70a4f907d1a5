// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/page/page_arm_io.hpp"

#include <nlohmann/json.hpp>

#include "pictures/page/number_array.hpp"
#include "pictures/page/page_layers_io.hpp"

namespace warren {
namespace {

using Json = nlohmann::ordered_json;

Json facts_of(const SolidView& solids, const MovingArm& arm, Vec2 origin) {
  const Vec2 low = solids.box.min - origin;
  const Vec2 high = solids.box.max - origin;
  const Vec3 floor = solids.floor - solids.target;
  Json about{{"box", {low.x, low.y, high.x, high.y}},
             {"reach", solids.reach},
             {"azimuth", solids.azimuth_rad},
             {"rise", solids.rise_rad},
             {"floor", {floor.x(), floor.y(), floor.z()}},
             {"floorSide", solids.floor_side},
             {"square", solids.square},
             {"radius", arm.radius},
             {"least", least_radius * solids.reach},
             {"ends", arm.spines.front().size()},
             {"colors",
              {{"solid", css_color(colors::blocked_cell)},
               {"start", css_color(colors::start)},
               {"goal", css_color(colors::goal)},
               {"moving", css_color(colors::path)}}},
             {"views", Json::array()}};
  for (const Projection& view : arm.views) {
    const Vec2 zero = view.at(solids.target) - origin;
    about["views"].push_back({view.axes[0], view.axes[1], zero.x, zero.y});
  }
  return about;
}

}  // namespace

void write_page_arm(const Picture& picture, Parts parts, Vec2 origin, const Execution& execution, const Write& write) {
  const SolidView& solids = *picture.solids;
  const MovingArm& arm = *picture.arm;
  std::string text = facts_of(solids, arm, origin).dump();
  text.pop_back();
  write(",\"arm\":" + text);
  const auto place = [&](NumberArray<float>& to, const Vec3& p) {
    for (int k = 0; k < 3; ++k) to.add(p[k] - solids.target[k]);
  };
  NumberArray<float> spheres("spheres", execution, write);
  for (const Solid& s : solids.solids) {
    if (s.part != Part::world || s.radius < 0.0 || !parts.has(s.part)) continue;
    place(spheres, s.a);
    spheres.add(s.radius);
  }
  spheres.end();
  NumberArray<float> boxes("boxes", execution, write);
  for (const Solid& s : solids.solids) {
    if (s.radius >= 0.0 || !parts.has(s.part)) continue;
    place(boxes, s.a);
    place(boxes, s.b);
  }
  boxes.end();
  NumberArray<float> tools("tools", execution, write);
  if (parts.has(Part::path)) {
    for (const Vec3& p : arm.tools) place(tools, p);
  }
  tools.end();
  NumberArray<float> spines("spines", execution, write);
  for (const std::vector<Vec3>& spine : arm.spines) {
    for (const Vec3& end : spine) place(spines, end);
  }
  spines.end();
  NumberArray<double> moments("moments", execution, write);
  for (const double moment : arm.moments) moments.add(moment);
  moments.end();
  write("}");
}

}  // namespace warren
