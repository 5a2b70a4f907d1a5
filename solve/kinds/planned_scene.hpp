// SPDX-License-Identifier: BSD-3-Clause
// The scene as it is planned in: itself, or a copy with a map's borders as walls. Bodies that are planned among walls
// see a map so; the others look at the cells.
#pragma once

#include <optional>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// Refers to the scene.
class PlannedScene {
 public:
  PlannedScene(const Scene& scene, const Question& question, PlannerKind planner, const Execution& execution);
  const Scene& get() const { return copy_ ? *copy_ : scene_; }

 private:
  const Scene& scene_;
  std::optional<Scene> copy_;
};

}  // namespace warren
