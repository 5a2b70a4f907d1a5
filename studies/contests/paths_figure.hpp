// SPDX-License-Identifier: BSD-3-Clause
// One figure of several paths through a world, each in a colour of its own with its name in the legend; where paths run
// along the same stretches they take turns in dashes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::studies {

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

/// Writes FOLDER/NAME. Returns what is drawn otherwise than usual, a line each that begins with the name. Throws
/// WriteError, Stopped.
std::vector<std::string> write_named(const std::string& folder, const std::string& name, const Picture& picture,
                                     const PictureOptions& look, const Execution& execution);

/// The same of the figure. A map's scene has its border walls.
std::vector<std::string> draw_paths(const std::string& folder, const std::string& name, const Scene& scene,
                                    const PathsFigure& figure, const PictureOptions& look, const Execution& execution);

}  // namespace warren::studies
