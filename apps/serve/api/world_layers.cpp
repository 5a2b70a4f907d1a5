// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/world_layers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/serve/api/kept_path.hpp"
#include "core/base/error.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/json_text.hpp"

namespace warren::serve {
namespace {

// What the colours of layers mean, with figures.

/// The steps, and behind them what the start does not reach.
constexpr auto search_inks = step_inks_and(component_inks.back());

struct ColorMeaning {
  Rgb color;
  std::string words;
  bool is_step = false;  ///< of a scale, above the world
};
using Legend = std::vector<ColorMeaning>;

std::string json_of_legend(const Legend& legend) {
  return json_list_of(legend, ",", [](const ColorMeaning& one) {
    const std::string opacity = one.is_step ? fmt::format("{:02x}", step_opacity) : "";
    const auto [red, green, blue] = one.color;
    return json_object("color", fmt::format("#{:02x}{:02x}{:02x}{}", red, green, blue, opacity), "words", one.words);
  });
}

/// As people read it, what is before the point in groups of three.
std::string grouped_number(double value) {
  const std::string text = human_number(value);
  const std::size_t whole = std::min(text.size(), text.find_first_not_of("0123456789"));
  return whole == 0 ? text : grouped(std::stoull(text.substr(0, whole))) + text.substr(whole);
}

/// Behind a number.
std::string unit_behind(const ServedWorld& world) {
  const std::string_view unit = unit_of(world.outline());
  return unit.empty() ? "" : " " + std::string(unit);
}

Legend passages_legend(std::uint64_t passages, std::uint64_t cells) {
  return {{component_inks[0], fmt::format("{} between {}, drawn where a cell has 8 pixels or more",
                                          counted(passages, "passage", "passages"), counted(cells, "cell", "cells"))}};
}
/// turns: the axis is that of the disc around a body that turns.
Legend axis_legend(const RoadmapLayer& layer, bool turns) {
  return {{component_inks[0], fmt::format("{} and {}, as far from all obstacles as can be{}",
                                          counted(layer.milestones(), "place", "places"),
                                          counted(layer.free_edges(), "free edge", "free edges"),
                                          turns ? ", of the disc around the body" : "")}};
}
/// has_curves: cars drive the edges.
Legend edges_legend(const RoadmapLayer& layer, bool has_curves) {
  return {
      {component_inks[0], fmt::format("{} and {}{}; where a tile has more than {} edges, milestones alone",
                                      counted(layer.milestones(), "milestone", "milestones"),
                                      counted(layer.free_edges(), "free edge", "free edges"),
                                      has_curves ? ", which cars drive as curves" : "", grouped(most_drawn_edges))}};
}
Legend components_legend(const RoadmapLayer& layer) {
  Legend legend;
  const auto& milestones = layer.milestones_of_ink();
  for (std::size_t rank = 0; rank + 1 < component_inks.size(); ++rank) {
    if (milestones[rank] == 0) break;
    legend.push_back(
        {component_inks[rank], fmt::format("{}: {}", rank == 0 ? "largest" : fmt::format("number {}", rank + 1),
                                           counted(milestones[rank], "milestone", "milestones"))});
  }
  if (layer.small_components() > 0) {
    legend.push_back({component_inks.back(), fmt::format("{}: {}", counted(layer.small_components(), "other", "others"),
                                                         counted(milestones.back(), "milestone", "milestones"))});
  }
  return legend;
}
Legend search_legend(const StartDistances& found, const ServedWorld& world) {
  Legend legend;
  const std::string behind = unit_behind(world);
  for (std::size_t step = 0; step < found.steps.count && found.reached > 0; ++step) {
    const bool is_last = step + 1 == found.steps.count;
    const double high = is_last ? found.farthest : static_cast<double>(step + 1) * found.steps.each;
    legend.push_back({search_inks[step], fmt::format("{} to {}{} from the start",
                                                     grouped_number(static_cast<double>(step) * found.steps.each),
                                                     grouped_number(high), behind)});
  }
  if (const std::uint64_t others = found.inks.size() - found.reached; others > 0) {
    legend.push_back({search_inks.back(), counted(others, "milestone", "milestones") + " that it does not reach"});
  }
  return legend;
}
/// Steps below what the body needs are not seen.
Legend clearance_legend(const ClearanceLayer& layer, const ServedWorld& world) {
  Legend legend;
  const std::string behind = unit_behind(world);
  const Steps& steps = layer.steps();
  const double needed = layer.needed();
  if (needed > 0.0) {
    legend.push_back(
        {too_near_ink,
         fmt::format("nearer than {}{}: too near for {}", grouped_number(needed), behind, robot_text(world.robot())),
         true});
  }
  for (std::size_t step = 0; step < steps.count; ++step) {
    const double low = std::max(needed, static_cast<double>(step) * steps.each);
    const double high = static_cast<double>(step + 1) * steps.each;
    const bool is_last = step + 1 == steps.count;
    if (!is_last && high <= needed) continue;
    legend.push_back({step_inks[step],
                      is_last ? fmt::format("{}{} and more", grouped_number(low), behind)
                              : fmt::format("{} to {}{}", grouped_number(low), grouped_number(high), behind),
                      true});
  }
  return legend;
}

constexpr const char* no_roadmap =
    "each question of this world is solved by itself; open a roadmap, which 'warren build' makes of it";

/// The first one whose pixels are no larger.
unsigned zoom_of(double pixel, const TileGrid& grid) {
  unsigned zoom = 0;
  while (zoom + 1 < grid.levels && grid.pixel(zoom) > pixel) ++zoom;
  return zoom;
}

bool has_lattice(const ServedWorld& world) {
  return world.query() != nullptr && world.query()->roadmap().lattice != nullptr;
}

// Why a layer is not there; empty: it is.

std::string why_no_components(const ServedWorld& world) {
  if (world.query() == nullptr) return no_roadmap;
  return has_lattice(world) ? "the roadmap of a maze's lattice holds passages and no components" : "";
}

/// Up to one more than are shown.
std::size_t side_count(const Scene& scene) {
  std::size_t count = scene.walls.size();
  for (const ScenePolygon& polygon : scene.polygons) {
    count += polygon.corners.size();
    if (count > most_shapes) break;
  }
  return count;
}

std::string why_no_clearance(const Scene& outline) {
  if (outline.maze || outline.map || side_count(outline) <= most_shapes) return {};
  return fmt::format("at most {} walls and sides are measured", grouped(most_shapes));
}

std::string why_no_axis(const ServedWorld& world) {
  if (has_lattice(world)) return "the axis of a maze is its passages; see 'roadmap'";
  try {
    check_has_axis(world.outline(), world.robot(), world.clearance());
    return {};
  } catch (const UsageError& error) {
    return error.what();
  }
}

std::string why_no_search(const ServedWorld& world) {
  if (world.query() == nullptr) return no_roadmap;
  if (has_lattice(world)) return "the index of a maze's lattice finds its paths without a search";
  if (!is_round(world.robot())) return "the distances of a roadmap are drawn for points and discs";
  const auto planner = world.query()->roadmap().options.planner;
  if (planner == PlannerKind::prm) return {};
  return planner == PlannerKind::lazy_prm
             ? "this roadmap's edges are checked while it is asked; one of 'build --planner prm' has distances"
             : "distances are drawn of roadmaps of samples; one of 'build --planner prm' has them";
}

std::string why_no_sweep(const RobotSpec& robot) {
  return reach_of(robot) > 0.0 ? "" : "a point has no extent, so it sweeps no more than its path";
}

std::vector<LayerAccount> accounts_of(const ServedWorld& world) {
  const TileGrid& grid = world.tiles().grid();
  return {{"roadmap", world.query() == nullptr ? no_roadmap : "",
           has_lattice(world) ? zoom_of(largest_pixel_of_passages, grid) : 0},
          {"components", why_no_components(world)},
          {"clearance", why_no_clearance(world.outline()), zoom_of(world.tiles().largest_pixel_of_distances(), grid)},
          {"axis", why_no_axis(world)},
          {.name = "search", .why = why_no_search(world), .is_of_start = true},
          {.name = "sweep", .why = why_no_sweep(world.robot()), .is_of_path = true}};
}

std::string json_of_account(const LayerAccount& account, const std::string& hash) {
  if (!account.why.empty()) return json_object("name", account.name, "there", false, "why", account.why);
  JsonObject json;
  json.add("name", account.name, "there", true);
  const std::string address = fmt::format("v/{}/layers/{}/", hash, account.name);
  if (account.is_of_path) {
    json.add("of_path", fmt::format("api/path/{{id}}/{}", account.name));
  } else {
    json.add("url", address + "{z}/{x}/{y}.png", "legend", address + "legend", "from_zoom", account.from_zoom);
  }
  if (account.is_of_start) json.add("of_start", true);
  return json.closed();
}

}  // namespace

/// Two starts are kept at least, however large: tiles are asked for one by one, and none of them may search anew.
WorldLayers::WorldLayers(const ServedWorld& world)
    : world_(world),
      accounts_(accounts_of(world)),
      bytes_a_start_(sizeof(StartDistances) + (world.query() == nullptr ? 0 : count_states(world.query()->roadmap()))),
      starts_(std::max(std::size_t{64} << 20U, 2 * bytes_a_start_)) {}

std::string WorldLayers::json(const RobotSpec& robot) const {
  return json_list_of(accounts_, ",", [&](LayerAccount account) {
    if (account.is_of_path) account.why = why_no_sweep(robot);
    return json_of_account(account, world_.hash());
  });
}

const LayerAccount* WorldLayers::account_of(std::string_view name) const {
  const auto found = std::ranges::find(accounts_, name, &LayerAccount::name);
  return found == accounts_.end() ? nullptr : &*found;
}

void WorldLayers::refuse_missing(std::string_view name) const {
  const LayerAccount* account = account_of(name);
  if (account == nullptr) return;
  if (!account->why.empty()) throw UsageError(fmt::format("there is no layer '{}': {}", name, account->why));
  if (account->is_of_path) throw UsageError(fmt::format("'{0}' is no tiles; ask /api/path/ID/{0}", name));
}

const RoadmapLayer& WorldLayers::roadmap(const Execution& execution) const {
  return roadmap_.get(
      execution, [&] { return std::make_unique<RoadmapLayer>(world_.query()->roadmap().arrays.parts(), execution); });
}

const ClearanceLayer& WorldLayers::clearance(const Execution& execution) const {
  return clearance_.get(execution, [&] {
    const bool is_round = world_.robot().outline.empty();  // the place of others doesn't say whether they fit
    const double needed = is_round ? world_.robot().radius + world_.clearance() : 0.0;
    return std::make_unique<ClearanceLayer>(world_.tiles(), world_.box(), needed, execution);
  });
}

const RoadmapLayer& WorldLayers::axis(const Execution& execution) const {
  const RoadmapArrays& arrays = axis_arrays_.get(execution, [&] {
    const Scene& barred = world_.barred(execution);
    return std::make_unique<RoadmapArrays>(
        built_roadmap(barred, world_.robot(), world_.clearance(), {.kind = GraphKind::axis}, execution).arrays);
  });
  return axis_.get(execution, [&] { return std::make_unique<RoadmapLayer>(arrays.parts(), execution); });
}

/// use: gets the distances, which stay while it does.
template <class Use>
std::string WorldLayers::from_start(const std::optional<std::vector<double>>& from, const Execution& execution,
                                    const Use& use) const {
  if (!from) throw UsageError("from: the start of the search is expected, as ?from=x,y");
  const std::string name = fmt::format("{}", fmt::join(*from, ","));
  const auto kept =
      starts_.find_or_put(name, bytes_a_start_, [] { return std::make_unique<MadeOnce<StartDistances>>(); });
  return use((*kept)->get(
      execution, [&] { return std::make_unique<StartDistances>(start_distances(*world_.query(), *from, execution)); }));
}

std::string WorldLayers::legend(std::string_view name, const std::optional<std::vector<double>>& from,
                                const Execution& execution) const {
  refuse_missing(name);
  if (name == "search") {
    return from_start(from, execution,
                      [&](const StartDistances& made) { return json_of_legend(search_legend(made, world_)); });
  }
  if (name == "clearance") return json_of_legend(clearance_legend(clearance(execution), world_));
  if (name == "axis") return json_of_legend(axis_legend(axis(execution), !world_.robot().outline.empty()));
  if (world_.passages(execution) != nullptr) {
    const Roadmap& lattice = world_.query()->roadmap();
    const auto count = [&] { return std::make_unique<std::uint64_t>(count_edges(lattice, execution).free); };
    return json_of_legend(passages_legend(passages_.get(execution, count), count_states(lattice)));
  }
  if (name == "components") return json_of_legend(components_legend(roadmap(execution)));
  return json_of_legend(edges_legend(roadmap(execution), world_.robot().kind == RobotKind::car));
}

std::string WorldLayers::draw(std::string_view name, const TilePlace& tile,
                              const std::optional<std::vector<double>>& from, const Execution& execution) const {
  refuse_missing(name);
  if (name == "clearance") return clearance(execution).draw(tile, execution);
  const TileGrid& grid = world_.tiles().grid();
  const Box box = grid.box_of(tile);
  const double pixel = grid.pixel(tile.zoom);
  if (name == "axis") return axis(execution).draw(box, pixel, RoadmapInk::one, execution);
  if (name == "search") {
    return from_start(from, execution, [&](const StartDistances& made) {
      return roadmap(execution).draw(box, pixel, search_inks, made.inks, execution);
    });
  }
  if (const LatticePassages* passages = world_.passages(execution)) {
    return draw_passages(*passages, box, pixel, execution);
  }
  return roadmap(execution).draw(box, pixel, name == "components" ? RoadmapInk::by_component : RoadmapInk::one,
                                 execution);
}

}  // namespace warren::serve
