// SPDX-License-Identifier: BSD-3-Clause
// What a picture shows of a roadmap that is kept: its vertices, and its edges by what is known of them. Free ones take
// the colours of their components, unchecked ones are thin and grey, blocked ones thin and red. Cars' edges are the
// curves that they drive; few states of bodies that turn have arrows. Of an arm: the places of its tool in the three
// views, and straight lines between them.
#pragma once

#include <functional>
#include <string>

#include "core/run/execution.hpp"
#include "pictures/draw_answer.hpp"
#include "solve/kept/roadmap.hpp"

namespace warren {

/// More edges are no picture but a grey.
inline constexpr std::uint64_t most_drawn_edges = 900'000;

/// Calls `draw` with the picture of world and roadmap, which lives as long as that call; start and goal are those of
/// the world. `description` is added to what the picture says of itself; heading_rad: as PictureOptions::heading.
/// Throws UsageError for more edges than most_drawn_edges; Stopped; what `draw` throws; what it throws for a table of
/// an arm, reading the roadmap has thrown before.
void draw_roadmap(const Roadmap& roadmap, const std::string& description, std::optional<double> heading_rad,
                  const Execution& execution, const std::function<void(const Picture&)>& draw);

}  // namespace warren
