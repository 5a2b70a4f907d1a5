// SPDX-License-Identifier: BSD-3-Clause
// How start and goal of the grid planner get onto its lattice. A pose that is one of the lattice's states is that
// state. Any other is joined to the free states around it, as a roadmap would join it: by motions that are certified
// against the obstacles themselves, at the cost of their way and turn in steps.
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/plane/heading_layers.hpp"
#include "core/plane/se2.hpp"
#include "parallel/execution.hpp"
#include "planners/grid/heading_layer_search.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "worlds/plane/maze_world.hpp"
#include "worlds/plane/polygon_world.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {

/// Where a lattice's coordinates lie in the world: those of a scene are the world's own, those of a map begin in its
/// corner and turn with it.
class LatticeFrame {
 public:
  explicit LatticeFrame(const Scene& scene);
  Se2 in_world(const Se2& pose) const;
  Se2 in_lattice(const Se2& pose) const;

 private:
  bool is_moved_ = false;
  Vec2 origin_;
  double yaw_rad_ = 0.0;
};

/// The pose of a state, in the lattice's coordinates.
Se2 pose_of(const HeadingLayers& layers, const LayerState& state);

/// A start or a goal, in the lattice's coordinates.
struct LatticeEnd {
  Se2 pose;
  bool any_heading = false;  ///< pose.theta does not matter
};

/// The states of the lattice at a pose: one, or one a heading; none if it lies between them.
std::vector<LayerEnd> states_at(const HeadingLayers& layers, const LatticeEnd& end);

/// The robot around one end, for motions between it and the lattice.
class EndWorld {
 public:
  /// Of a map only what the body may reach from the end. Throws what the worlds throw.
  EndWorld(const Scene& scene, const Problem& problem, const HeadingLayers& layers, const LatticeEnd& end,
           const Execution& execution);

  /// The free states near the end to which its motion is certified, with what it costs; none if the end is not free.
  std::vector<LayerEnd> joined(const LayerSearchOptions& costs) const;

 private:
  std::vector<LayerEnd> joined_within(std::int64_t reach, const LayerSearchOptions& costs) const;
  bool is_free_motion(const Se2& from, const Se2& to) const;

  const HeadingLayers& layers_;
  LatticeEnd end_;
  const Execution& execution_;
  std::variant<std::monostate, MazeWorld, PolygonWorld, Se2World> world_;
};

}  // namespace warren
