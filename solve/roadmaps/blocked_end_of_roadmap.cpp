// SPDX-License-Identifier: BSD-3-Clause
#include "solve/roadmaps/blocked_end_of_roadmap.hpp"

#include <span>

#include "core/plane/cell_walls.hpp"
#include "solve/steps/blocked_cell.hpp"
#include "solve/steps/blocked_end.hpp"
#include "solve/steps/settled_ends.hpp"
#include "verify/cells/verify_steps.hpp"

namespace warren {

void explain_blocked_end(const Roadmap& roadmap, Answer& answer, const Execution& execution) {
  if (!is_blocked(answer.outcome)) return;
  const Scene& outline = roadmap.world.outline();
  const KeptCells* cells = roadmap.world.looked_up(execution);
  if (cells == nullptr) return explain_blocked_end(roadmap.world.whole(execution), answer, execution);
  const double margin = end_margin(roadmap.robot.radius + roadmap.clearance);
  const VerifyOptions options{.radius = roadmap.robot.radius, .clearance = roadmap.clearance + margin};
  const auto met_at = [&](Vec2 p) {
    return verify_steps(*cells->walls, std::span(&p, 1), options, execution).first_violation;
  };
  try {
    explain_blocked_cell(wall_problem(outline, answer.problem.question()), *outline.maze, answer, met_at);
  } catch (const Stopped&) {  // it stays as it is
  }
}

}  // namespace warren
