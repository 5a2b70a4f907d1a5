// SPDX-License-Identifier: BSD-3-Clause
// What requests say in their bodies, as JSON. POST /api/query: one object, a question. POST /api/update: what people
// draw into a world and take out of it, and the world that comes of it. A change has an inverse, so that it can be
// taken back: {"add": {"walls": [[x, y, x, y], ...], "polygons": [[[x, y], ...], ...]}, "remove": the same,
// "erase": [[x, y, reach], ...]}.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/serve/api/served_world.hpp"
#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::serve {

/// What POST /api/query asks, and how the answer shall be told.
struct QueryBody {
  ServedQuestion question;
  bool tells_path = true;  ///< else the path is kept, to be seen part by part
  std::string watch = {};  ///< the name under which GET /api/progress tells of it while it runs; empty: none
};

/// Throws HttpError: 400 for what is no such object, nested deeper than deepest_json or has another key.
QueryBody read_query_body(std::string_view json);

struct DrawnShapes {
  std::vector<Segment> walls = {};
  std::vector<std::vector<Vec2>> polygons = {};  ///< corners in order

  std::size_t size() const { return walls.size() + polygons.size(); }
};

/// Takes all that is near the place and not farther than the nearest.
struct ErasedPlace {
  Vec2 at;
  double reach = 0.0;
};

struct SceneChange {
  DrawnShapes add = {};
  DrawnShapes remove = {};  ///< the same numbers as in the scene; a wall's ends in either order
  std::vector<ErasedPlace> erase = {};
};

inline constexpr std::size_t most_changed_shapes = 10'000;

/// The scene without what is removed and with what is added, and the change that was made, with names for what was
/// erased.
struct ChangedScene {
  Scene scene;
  SceneChange made;
};
/// maze: what the walls were once of; they still are where all lie on its grid, and walls like any others where not.
/// Throws HttpError: 400 "not_there" for shapes to remove that are not in the scene; InputError for polygons that are
/// not simple and walls without length; UsageError for worlds that are cells; Stopped.
ChangedScene changed(const Scene& scene, const SceneChange& change, const std::optional<MazeHint>& maze,
                     const Execution& execution);

/// Throws HttpError with the place of what is none, Stopped.
SceneChange read_scene_change(std::string_view json, const Execution& execution);
/// [[[x, y], ...], ...]. Throws Stopped.
std::string json_chains(const std::vector<std::vector<Vec2>>& chains, const Execution& execution);
/// {"walls": ..., "polygons": ...}
std::string shapes_json(const DrawnShapes& shapes);

}  // namespace warren::serve
