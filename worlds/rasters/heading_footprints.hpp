// SPDX-License-Identifier: BSD-3-Clause
// Which bitmaps the layers of a turning body need, whatever it turns among: for each heading what the body covers where
// it stands, on each of the four steps and on the turn to the next heading, as convex pieces around the reference
// point. Headings at which the body covers the same set share their jobs. O(headings squared) comparisons.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/heading_layers.hpp"
#include "worlds/rasters/convex_pieces.hpp"

namespace warren {

/// One bitmap to be made: positions at which the union of the pieces touches something.
struct LayerJob {
  std::vector<ConvexPiece> pieces;
  bool is_standing = false;  ///< a body may also stand inside an obstacle without touching its outline
};

/// For a body with layers.angles headings on a lattice with layers.cell; job i makes bitmap i. Fills in standing,
/// moving and turning. outline: a polygon around the reference point, or the reference point alone.
std::vector<LayerJob> list_layer_jobs(std::span<const Vec2> outline, HeadingLayers& layers);

}  // namespace warren
