// SPDX-License-Identifier: BSD-3-Clause
// May this body go straight from here to there? Asked of the judges of verify/, which share nothing with planners,
// about edges that people draw.
//
// A body that turns stands at a place without a heading in all of them: it turns there on the spot, all round, and
// faces along the edges that it drives. Between two headings it goes straight while it turns evenly the shorter way, as
// the edges of its roadmaps do. A car can do neither, so it has no such edges.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren::serve {

struct EdgePlace {
  Vec2 at;
  std::optional<double> theta = {};  ///< radians; of bodies that turn
};

struct DrawnEdge {
  EdgePlace from;
  EdgePlace to;
};

struct EdgeVerdict {
  bool free = false;
  double clearance = 0.0;  ///< least distance between the body and anything, where it is free
  std::string by = {};     ///< what is in the way, where it is not: Violation::obstacle
  double distance = 0.0;   ///< to that, of the edge or of the body that turns
  double needed = 0.0;     ///< what that should be
};

/// Whether bodies of the plane fit along edges, and how much room they have. Refers to the scene. Any number of threads
/// may ask.
class EdgeJudge {
 public:
  /// room: the box of all that there is; nothing is free outside of it.
  EdgeJudge(const Scene& scene, const Box& room, RobotSpec robot, double clearance);

  /// One verdict an edge. Throws UsageError for bodies that have none, InputError for places that are no numbers,
  /// Stopped.
  std::vector<EdgeVerdict> judge(const std::vector<DrawnEdge>& edges, const Execution& execution) const;
  /// Least distance between the body that stands there, in the room, and anything; infinite where there is nothing.
  /// theta is there where the body's outline turns. Throws UsageError for arms, Stopped.
  double clearance_at(const EdgePlace& place, const Execution& execution) const;

 private:
  const ObstacleIndex* index(const Execution& execution) const;
  EdgeVerdict judge(const DrawnEdge& edge, const ObstacleIndex* index, const Execution& execution) const;

  const Scene& scene_;
  Box room_;
  RobotSpec robot_;
  double clearance_;
  MadeOnce<ObstacleIndex> index_;
};

/// Throws UsageError for bodies that drive no straight edges: cars and arms.
void check_drives_edges(const RobotSpec& robot);

/// "cell 3, 4 is 0.1 away, and 0.25 is needed"
std::string words_of(const EdgeVerdict& verdict);

}  // namespace warren::serve
