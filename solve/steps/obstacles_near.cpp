// SPDX-License-Identifier: BSD-3-Clause
#include "solve/steps/obstacles_near.hpp"

#include <vector>

#include "core/plane/geometry.hpp"
#include "verify/near/leg_boxes.hpp"

namespace warren {
namespace {

constexpr std::size_t obstacles_a_poll = 1U << 14U;

class NearPath {
 public:
  NearPath(const Scene& scene, std::span<const Vec2> path, double reach, const Execution& execution)
      : all_(obstacle_box(scene, execution)), legs_(path, execution), reach_(reach) {}

  bool keeps(const Box& box) const {
    if (box.min.x == all_.min.x || box.min.y == all_.min.y || box.max.x == all_.max.x || box.max.y == all_.max.y) {
      return true;
    }
    const Box around = box.grown(reach_);
    const auto is_apart = [&](const Box& legs) { return !meet(legs, around); };
    bool is_near = false;
    legs_.for_each_in(
        0, legs_.leg_count() - 1, [&](const Box& legs) { return is_near || is_apart(legs); },
        [&](std::size_t leg) { is_near = is_near || meet(box_of(legs_.leg(leg)), around); });
    return is_near;
  }

 private:
  static bool meet(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y;
  }

  Box all_;
  LegBoxes legs_;
  double reach_;
};

}  // namespace

Scene obstacles_near(const Scene& scene, std::span<const Vec2> path, double reach, const Execution& execution) {
  if (scene.map || is_unmade(scene)) return scene;
  const Vec2 twice[] = {path.front(), path.front()};
  const NearPath places(scene, path.size() > 1 ? path : std::span<const Vec2>(twice), reach, execution);
  Scene near = without_arrays(scene);
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (i % obstacles_a_poll == 0) execution.check();
    const Segment wall = scene.walls.segment(i);
    if (places.keeps(box_of(wall))) walls.push_back(wall);
  }
  near.walls = WallSet::narrowest(walls);
  std::erase_if(near.polygons, [&](const ScenePolygon& polygon) {
    execution.check();
    Box box;
    for (const Vec2 corner : polygon.corners) box.include(corner);
    return !places.keeps(box);
  });
  return near;
}

}  // namespace warren
