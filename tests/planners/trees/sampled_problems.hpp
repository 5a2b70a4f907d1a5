// SPDX-License-Identifier: BSD-3-Clause
// Problems in worlds of every kind of state, for tests of planners that take any world.
#pragma once

#include <vector>

#include "scenes/scene/scene.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/serial_chain.hpp"
#include "worlds/plane/maze_world.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren::sampled_problems {

template <class W>
struct SampledProblem {
  W world;
  typename W::State start;
  typename W::State goal;
  WorldView<W> view{world};  ///< as planners see it; so a problem stays where it is made

  double length(const Path<typename W::State>& path) const {
    return path_length(path, [this](const auto& a, const auto& b) { return world.distance(a, b); });
  }
  bool is_free(const Path<typename W::State>& path) const {
    auto query = world.make_query();
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (!world.is_free(path[i], query)) return false;
      if (i > 0 && !world.is_free_motion(path[i - 1], path[i], query)) return false;
    }
    return true;
  }
};

/// A point; with the wall, 10 is the shortest way: triangles 3, 4, 5 on both sides.
inline SampledProblem<MazeWorld> point(bool has_wall) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  const Segment wall = has_wall ? Segment{{5, 0}, {5, 5}} : Segment{{9, 9}, {9, 9.5}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{wall});
  return {MazeWorld(scene, 1e-6, {}), {2, 1}, {8, 1}};
}

/// The first two free poses that a seed draws and that no straight motion joins.
inline SampledProblem<Se2World> body(std::uint64_t seed) {
  Se2World world(body_scenes::scattered(seed), body_scenes::hook, {});
  auto query = world.make_query();
  for (std::uint64_t i = 0;; i += 2) {
    const Se2 a = uniform_state(world, seed, i);
    const Se2 b = uniform_state(world, seed, i + 1);
    const bool apart = world.is_free(a, query) && world.is_free(b, query) && !world.is_free_motion(a, b, query);
    if (apart) return {std::move(world), a, b};
  }
}

/// Three walls to be passed in a slalom. W: CarWorld<DubinsCurve> or CarWorld<ReedsSheppCurve>.
template <class W>
SampledProblem<W> car() {
  Scene scene;
  scene.bounds = Box{{0, 0}, {12, 6}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{3, 0}, {3, 3.5}}, {{6, 6}, {6, 2.5}}, {{9, 0}, {9, 3.5}}});
  return {W(scene, {.turning_radius = 0.7, .radius = 0.2}), {1, 1, 0}, {11, 1, 0}};
}

/// An arm that turns half around past a sphere.
inline SampledProblem<ArmWorld> arm() {
  Scene scene;
  scene.spheres.push_back({0.7, 0.0, 0.2, 0.25});
  return {
      ArmWorld(scene, model_of(puma560_table(), 0.05, false), {}), {-1.0, 0.0, 0.5, 0, 0, 0}, {1.0, 0.0, 0.5, 0, 0, 0}};
}

}  // namespace warren::sampled_problems
