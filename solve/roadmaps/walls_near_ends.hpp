// SPDX-License-Identifier: BSD-3-Clause
// The walls near ends that are no milestones of a lattice. Where they can be looked up, that is all there is to it;
// else the first few such ends cost a pass over all walls each; from then on an index of them all is asked, which takes
// as long as some forty passes and 20 to 40 bytes a wall. Where the memory does not hold it, each end goes on costing a
// pass.
#pragma once

#include <optional>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "parallel/made_once.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/roadmaps/kept_world.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {

/// Cells each way that an end looks at: the 256 nearest lie within 10.
inline constexpr int widest_look = 11;

/// Refers to the world. Any number of threads may ask.
class WallsNearEnds {
 public:
  /// `reach`: what the body's reference point keeps from all walls.
  WallsNearEnds(const KeptWorld& world, double reach) : world_(world), reach_(reach) {}

  /// Calls look(const MazeWorld&) with a world that is the whole one for all motions within the widest look of p.
  /// Throws Stopped, InputError.
  template <class Look>
  void look(Vec2 p, const Execution& execution, const Look& look) const {
    if (const KeptCells* cells = world_.looked_up(execution); cells != nullptr) {
      return look(MazeWorld(cells->walls_in(room_of_motions(p)), reach_, execution));
    }
    const Scene& whole = world_.whole(execution);
    if (const Indexed* indexed = index(execution); indexed != nullptr && indexed->world) return look(*indexed->world);
    look(MazeWorld(around(whole, p, execution), reach_, execution));
  }
  /// An end will be looked at: the index is made now, on the execution's threads, if its turn has come.
  void expect(const Execution& execution) const {
    if (world_.looked_up(execution) == nullptr) index(execution);
  }

 private:
  struct Indexed {
    std::optional<MazeWorld> world;  // none: too large
  };
  const Indexed* index(const Execution& execution) const;
  Box room_of_motions(Vec2 p) const {
    Box near;
    near.include(p);
    return near.grown(widest_look + 1.0 + 2.0 * reach_);
  }
  Scene around(const Scene& whole, Vec2 p, const Execution& execution) const;

  const KeptWorld& world_;
  double reach_;
  MadeOnce<Indexed> indexed_;
};

}  // namespace warren
