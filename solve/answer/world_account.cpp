// SPDX-License-Identifier: BSD-3-Clause
#include "solve/answer/world_account.hpp"

#include <fmt/format.h>

#include <utility>

#include "scenes/formats/scene_io.hpp"
#include "scenes/scene/unit_of.hpp"
#include "scenes/text/human_units.hpp"

namespace warren {

WorldAccount account_of(const Scene& scene, const Execution& execution) {
  return account_of(scene, scene_hash(scene, execution));
}

WorldAccount account_of(const Scene& scene, std::string hash) {
  std::string unit{unit_of(scene)};
  if (scene.map) return {scene.source, "map", 0, 0, std::move(hash), 0, 0, std::move(unit)};
  const bool plane = scene.walls.size() > 0 || !has_solids(scene);
  const char* kind = scene.maze ? "maze" : !scene.polygons.empty() ? "polygons" : plane ? "walls" : "solids";
  const bool is_tree = is_unmade(scene) && scene.formula && scene.formula->loops == 0.0;
  const std::size_t walls =
      is_tree ? 4 + (scene.maze->rows - std::size_t{1}) * (scene.maze->cols - std::size_t{1}) : scene.walls.size();
  return {scene.source,       kind,           walls, scene.polygons.size(), std::move(hash), scene.spheres.size(),
          scene.boxes.size(), std::move(unit)};
}

WorldAccount account_of(const Scene& scene, std::string hash, std::size_t walls) {
  WorldAccount account = account_of(scene, std::move(hash));
  account.walls = walls;
  return account;
}

std::string description_of(const Scene& scene) {
  if (scene.map) {
    return fmt::format("map of {} x {} cells, {} free", scene.map->width(), scene.map->height(),
                       grouped(scene.map->free));
  }
  std::string text = scene.maze ? fmt::format("{} x {} maze, ", scene.maze->rows, scene.maze->cols) : "";
  if (!scene.polygons.empty()) text += counted(scene.polygons.size(), "polygon", "polygons");
  if (!scene.polygons.empty() && scene.walls.size() > 0) text += ", ";
  const bool nothing_else = scene.polygons.empty() && !has_solids(scene);
  if (nothing_else || scene.walls.size() > 0) text += counted(scene.walls.size(), "wall", "walls");
  const auto add_solids = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  add_solids(scene.spheres.size(), "sphere", "spheres");
  add_solids(scene.boxes.size(), "box", "boxes");
  return text;
}

}  // namespace warren
