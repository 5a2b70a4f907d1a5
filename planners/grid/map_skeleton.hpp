// SPDX-License-Identifier: BSD-3-Clause
// The skeleton of a map's free cells: a network one cell thin, as far from what is blocked as it can be, by thinning in
// the order of the distance transform. The nearest cell to what is blocked that can go without changing the topology
// goes first: the free cells stay as connected as they were over common sides, and no loop around blocked cells closes
// or opens (a simple point of the 4-connected plane: Kong, Rosenfeld, Computer Vision 48, 1989; the order: Pudney,
// Computer Vision and Image Understanding 72, 1998). Cells that shall be kept stay, so the skeleton joins them wherever
// the map does. What remains: the kept cells, a loop around each island of blocked cells, and what joins these; dead
// ends are gone.
// O(cells log distances) time, serial; 9 bits a cell and 4 bytes a cell that waits.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/bitmap.hpp"
#include "parallel/execution.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {

/// What becomes of ends of lines that nobody has asked to keep. go: all dead ends are gone. stay: where from the end
/// the distance grows by less than half a cell a cell in every direction, over the next cell and over the next three.
/// So lines stay that lead to the ends of corridors, and those go that lead into the corners of rooms (0.71 a cell) and
/// behind the bumps of walls.
enum class SkeletonEnds : std::uint8_t { go, stay };

/// blocked: set bits; the outside is blocked too. field: of what keeps its distance, the same size; its order counts,
/// and where ends stay its slope. kept: free cells that stay. Set bits of the result are the skeleton. Throws Stopped.
Bitmap map_skeleton(const Bitmap& blocked, const DistanceField& field, std::span<const Cell> kept,
                    const Execution& execution, SkeletonEnds ends = SkeletonEnds::go);

}  // namespace warren
