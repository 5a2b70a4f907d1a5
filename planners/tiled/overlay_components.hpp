// SPDX-License-Identifier: BSD-3-Clause
// Components of the overlay: of its core, the vertices that are not peeled, or of a part of them. The search is
// planners/tiled/overlay_dijkstra.hpp.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"
#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"

namespace warren {

/// Union-find over the vertices of a range that are not peeled, and the edges between them. O(vertices); 4 bytes each.
class OverlayComponents {
 public:
  /// Throws Stopped.
  OverlayComponents(const Overlay& overlay, Range vertices, const Execution& execution);
  std::uint64_t count() const { return count_; }
  /// A vertex of the range that stands for v's component.
  VertexId root(VertexId v) const;

 private:
  bool join(VertexId v, VertexId w);

  const VertexId first_;
  RawVector<VertexId> parent_;  // by place in the range
  std::uint64_t count_ = 0;
};

struct CoreComponents {
  std::uint64_t count = 0;
  bool joined = false;  ///< start and goal are in one
};
CoreComponents core_components(const Overlay& overlay, const Execution& execution);

}  // namespace warren
