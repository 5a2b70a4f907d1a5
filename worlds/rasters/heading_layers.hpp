// SPDX-License-Identifier: BSD-3-Clause
// The layers of a turning body among walls and polygons: for each heading the lattice positions where it touches
// something, made by marking the rows of Minkowski sums (each wall minus each convex piece of the body), and the same
// for what the body sweeps on each step and each turn, so that a path over free bits is free all the way. Headings at
// which the body covers the same set share their layers. O(layers * walls * (corners + rows)), layers in parallel.
//
// report004 is what a course report did: the walls drawn two cells thick, widened by a disc as wide as half the body's
// projection, rounded up to cells; steps and turns between all free states. It is neither safe nor complete.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/enum_names.hpp"
#include "core/base/types.hpp"
#include "core/plane/heading_layers.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

enum class LayerKind : std::uint8_t { exact, report004 };
constexpr auto enum_names(LayerKind) { return std::array<std::string_view, 2>{"exact", "report004"}; }

struct LayerOptions {
  GridSpec grid;
  LayerKind kind = LayerKind::exact;
  double clearance = 0.0;          ///< room around the body, exact layers only; >= 0; 0: touching is blocked
  std::optional<Box> region = {};  ///< where positions lie, instead of the bounds
};

/// Point, disc or polygon robots (others: InputError). States lie at i * cell from the lower corner of the bounds, for
/// i = 0 ... extent / cell - 1; without bounds the obstacles' box takes their place and confines the reference point
/// only. Points and discs have one heading. Throws InputError where there is no extent, or more than
/// HeadingLayers::most_states; Stopped.
HeadingLayers orientation_layers(const Scene& scene, const RobotSpec& robot, const LayerOptions& options,
                                 const Execution& execution);

/// The layers of a turning body on an occupancy map: states stand at the middles of the map's cells, blocked cells are
/// closed squares, and what lies outside of the map is blocked. Which cells around a position touch the body there (or
/// what it sweeps on a step or a turn) is the same everywhere: a stamp, found once a layer by the exact sum of body and
/// square. The layer is the blocked cells widened by the stamp, 64 cells at a time: each of the stamp's rows is an
/// interval or a few, and an interval of any length is two shifted copies of a doubled row. O(layers * stamp rows *
/// cells / 64), whatever the map holds; layers in parallel.
///
/// outline: three corners or more around the reference point, world units; clearance: room around the body, >= 0; 0:
/// touching is blocked. Positions and headings are the map's own: as if its origin were (0, 0) and it were not turned.
/// Throws InputError for more than HeadingLayers::most_states, no heading, and a body that reaches over 4096 cells;
/// Stopped.
HeadingLayers map_layers(const OccupancyMap& map, std::span<const Vec2> outline, std::uint32_t angles, double clearance,
                         const Execution& execution);

}  // namespace warren
