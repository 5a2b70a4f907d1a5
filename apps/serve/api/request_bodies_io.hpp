// SPDX-License-Identifier: BSD-3-Clause
// What requests say in their bodies, as JSON. POST /api/query: one object, a question. POST /api/update: what people
// draw into a world and take out of it, and the world that comes of it. A change has an inverse, so that it can be
// taken back: {"add": {"walls": [[x, y, x, y], ...], "polygons": [[[x, y], ...], ...]}, "remove": the same,
// "erase": [[x, y, reach], ...]}. Of a map cells change: {"block": [[x, y, x, y], ...], "free": the same,
// "cells": [[column, row, is it blocked?], ...]}.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/serve/api/served_world.hpp"
#include "scenes/text/json_text.hpp"
#include "solve/replanner.hpp"

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
  std::vector<Box> block = {};         ///< cells of a map whose middle is in one of them
  std::vector<Box> free = {};          ///< the same, after these
  std::vector<CellChange> cells = {};  ///< after both

  std::size_t of_shapes() const { return add.size() + remove.size() + erase.size(); }
  std::size_t of_cells() const { return block.size() + free.size() + cells.size(); }
};

inline constexpr std::size_t most_changed_shapes = 10'000;

struct CellCounts {
  std::uint64_t blocked = 0;  ///< that were free
  std::uint64_t freed = 0;    ///< that were blocked
  std::uint64_t known = 0;    ///< that were unknown or water, which no change makes them again
};

/// The scene without what is removed and with what is added, and the change that was made, with names for what was
/// erased. Of a map: the first most_changed_shapes cells that were blocked or freed.
struct ChangedScene {
  Scene scene;
  SceneChange made;
  std::optional<CellCounts> cells = {};  ///< of a map
};
/// maze: what the walls were once of; they still are where all lie on its grid, and walls like any others where not.
/// Throws HttpError: 400 "not_there" for shapes to remove that are not in the scene; InputError for polygons that are
/// not simple and walls without length, and cells outside of the map; UsageError for shapes in worlds that are cells
/// and cells in worlds that are shapes; Stopped.
ChangedScene changed(const Scene& scene, const SceneChange& change, const std::optional<MazeHint>& maze,
                     const Execution& execution);

/// Throws HttpError with the place of what is none, Stopped.
SceneChange read_scene_change(std::string_view json, const Execution& execution);
/// [[[x, y], ...], ...]. Throws Stopped.
std::string json_chains(const std::vector<std::vector<Vec2>>& chains, const Execution& execution);
/// What was made, as an answer tells it: added and removed, each {"walls": ..., "polygons": ...}; of a map
/// blocked_cells, freed_cells, known_cells, can_be_taken_back and, unless there are too many, the lists blocked and
/// freed.
void tell_change(JsonObject& json, const ChangedScene& change);

}  // namespace warren::serve
