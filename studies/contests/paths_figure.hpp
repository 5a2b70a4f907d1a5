// SPDX-License-Identifier: BSD-3-Clause
// One figure of several paths through a world, each in a colour of its own with its name in the legend; where paths run
// along the same legs they take turns in dashes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

struct NamedPath {
  std::string label;         ///< in the legend
  std::vector<Vec2> points;  ///< arcs as chords
};

struct PathsFigure {
  std::vector<NamedPath> paths = {};
  const PlannedRoadmap<Vec2>* roadmap = nullptr;  ///< drawn below the paths; nullptr: none
  std::optional<Vec2> start = {};
  std::optional<Vec2> goal = {};
  std::string subtitle = {};
};

/// Draws it into the file, an SVG. A map's scene has its border walls. Throws WriteError, Stopped.
void draw_paths(const std::string& file, const Scene& scene, const PathsFigure& figure, const PictureOptions& look,
                const Execution& execution);

}  // namespace warren
