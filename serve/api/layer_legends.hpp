// SPDX-License-Identifier: BSD-3-Clause
// What the colours of layers mean, with figures: each a JSON list of "color" and "words".
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "serve/api/served_world.hpp"
#include "serve/api/start_distances.hpp"
#include "serve/tiles/clearance_layer.hpp"
#include "serve/tiles/roadmap_layer.hpp"

namespace warren::serve {

/// The steps, and behind them what the start does not reach.
inline constexpr std::array<Rgb, unreached_ink + 1> search_inks = [] {
  std::array<Rgb, unreached_ink + 1> inks{};
  for (std::size_t step = 0; step < step_inks.size(); ++step) inks[step] = step_inks[step];
  inks.back() = component_inks.back();
  return inks;
}();

/// Of a maze's lattice.
std::string passages_legend(std::uint64_t passages, std::uint64_t cells);
/// turns: the axis is that of the disc around a body that turns.
std::string axis_legend(const RoadmapLayer& layer, bool turns);
/// has_curves: cars drive the edges.
std::string edges_legend(const RoadmapLayer& layer, bool has_curves);
std::string components_legend(const RoadmapLayer& layer);
std::string search_legend(const StartDistances& found, const ServedWorld& world);
std::string clearance_legend(const ClearanceLayer& layer, const ServedWorld& world);

}  // namespace warren::serve
