// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/world_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/base/error.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"
#include "serve/api/swept_bodies.hpp"

namespace warren {
namespace {

constexpr const char* no_roadmap =
    "each question of this world is solved by itself; open a roadmap, which 'warren build' makes of it";

LayerAccount roadmap_account(const ServedWorld& world) {
  LayerAccount account{.name = "roadmap"};
  if (world.query() == nullptr) account.why = no_roadmap;
  if (world.query() == nullptr || world.query()->roadmap().lattice == nullptr) return account;
  const TileGrid& grid = world.tiles().grid();
  while (account.from_zoom + 1 < grid.levels && !shows_passages(grid.pixel(account.from_zoom))) ++account.from_zoom;
  return account;
}

LayerAccount components_account(const ServedWorld& world) {
  LayerAccount account{.name = "components"};
  if (world.query() == nullptr) {
    account.why = no_roadmap;
  } else if (world.query()->roadmap().lattice != nullptr) {
    account.why = "the roadmap of a maze's lattice holds passages and no components";
  }
  return account;
}

LayerAccount sweep_account(const ServedWorld& world) {
  LayerAccount account{.name = "sweep", .is_of_path = true};
  if (!(reach_of(world.robot()) > 0.0)) account.why = "a point has no extent, so it sweeps no more than its path";
  return account;
}

std::string json_of_account(const LayerAccount& account, const std::string& hash) {
  JsonObject json;
  json.add("name", account.name);
  json.add("there", account.why.empty());
  if (!account.why.empty()) {
    json.add("why", account.why);
    return json.closed();
  }
  if (account.is_of_path) {
    json.add("of_path", std::string("/api/path/{id}/") + std::string(account.name));
    return json.closed();
  }
  const std::string address = fmt::format("/v/{}/layers/{}/", hash, account.name);
  json.add("url", address + "{z}/{x}/{y}.png");
  json.add("legend", address + "legend");
  json.add("from_zoom", std::uint32_t{account.from_zoom});
  return json.closed();
}

class Legend {
 public:
  void add(Rgb color, std::string_view words) {
    JsonObject entry;
    entry.add("color", fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue));
    entry.add("words", words);
    text_ += (text_.size() > 1 ? "," : "") + entry.closed();
  }
  std::string closed() const { return text_ + "]"; }

 private:
  std::string text_ = "[";
};

std::string passages_legend(const Roadmap& roadmap, const Execution& execution) {
  Legend legend;
  legend.add(component_inks[0], fmt::format("{} between {}, drawn where a cell has 8 pixels or more",
                                            counted(count_edges(roadmap, execution).free, "passage", "passages"),
                                            counted(count_states(roadmap), "cell", "cells")));
  return legend.closed();
}

std::string edges_legend(const RoadmapLayer& layer, bool has_curves) {
  Legend legend;
  legend.add(component_inks[0],
             fmt::format("{} and {}{}; where a tile has more than {} edges, milestones alone",
                         counted(layer.milestones(), "milestone", "milestones"),
                         counted(layer.free_edges(), "free edge", "free edges"),
                         has_curves ? ", which cars drive as curves" : "", grouped(most_drawn_edges)));
  return legend.closed();
}

std::string components_legend(const RoadmapLayer& layer) {
  Legend legend;
  const auto& milestones = layer.milestones_of_ink();
  for (std::size_t rank = 0; rank + 1 < component_inks.size(); ++rank) {
    if (milestones[rank] == 0) break;
    legend.add(component_inks[rank], fmt::format("{}: {}", rank == 0 ? "largest" : fmt::format("number {}", rank + 1),
                                                 counted(milestones[rank], "milestone", "milestones")));
  }
  if (layer.small_components() > 0) {
    legend.add(component_inks.back(), fmt::format("{}: {}", counted(layer.small_components(), "other", "others"),
                                                  counted(milestones.back(), "milestone", "milestones")));
  }
  return legend.closed();
}

}  // namespace

WorldLayers::WorldLayers(const ServedWorld& world)
    : world_(world), accounts_{roadmap_account(world), components_account(world), sweep_account(world)} {}

std::string WorldLayers::json() const {
  std::string text = "[";
  for (const LayerAccount& account : accounts_) {
    text += (text.size() > 1 ? "," : "") + json_of_account(account, world_.hash());
  }
  return text + "]";
}

bool WorldLayers::knows(std::string_view name) const {
  return std::ranges::any_of(accounts_, [&](const LayerAccount& account) { return account.name == name; });
}

void WorldLayers::refuse_missing(std::string_view name) const {
  for (const LayerAccount& account : accounts_) {
    if (account.name != name) continue;
    if (!account.why.empty()) throw UsageError(fmt::format("there is no layer '{}': {}", name, account.why));
    if (account.is_of_path) throw UsageError(fmt::format("'{0}' is no tiles; ask /api/path/ID/{0}", name));
  }
}

const RoadmapLayer& WorldLayers::roadmap(const Execution& execution) const {
  return roadmap_.get(
      execution, [&] { return std::make_unique<RoadmapLayer>(world_.query()->roadmap().arrays.parts(), execution); });
}

std::string WorldLayers::legend(std::string_view name, const Execution& execution) const {
  refuse_missing(name);
  if (world_.passages(execution) != nullptr) return passages_legend(world_.query()->roadmap(), execution);
  if (name == "components") return components_legend(roadmap(execution));
  return edges_legend(roadmap(execution), world_.robot().kind == RobotKind::car);
}

std::string WorldLayers::draw(std::string_view name, const TilePlace& tile, const Execution& execution) const {
  refuse_missing(name);
  const TileGrid& grid = world_.tiles().grid();
  const Box box = grid.box_of(tile);
  const double pixel = grid.pixel(tile.zoom);
  if (const LatticePassages* passages = world_.passages(execution)) {
    return draw_passages(*passages, box, pixel, execution);
  }
  return roadmap(execution).draw(box, pixel, name == "components" ? RoadmapInk::by_component : RoadmapInk::one,
                                 execution);
}

}  // namespace warren
