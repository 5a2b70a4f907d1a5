// SPDX-License-Identifier: BSD-3-Clause
// The layers that a service draws above its world: which there are, what their colours mean, and their tiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/serve/api/served_world.hpp"
#include "apps/serve/http/kept_values.hpp"
#include "apps/serve/tiles/roadmap_layer.hpp"

namespace warren::serve {

/// What a page says of a layer before it is looked at.
struct LayerAccount {
  std::string_view name;     ///< in its address, a literal
  std::string why = {};      ///< there is none in this world; empty: there is
  unsigned from_zoom = 0;    ///< tiles of smaller zooms are empty
  bool is_of_path = false;   ///< it has no tiles: what it shows goes along a path
  bool is_of_start = false;  ///< its addresses want the start: ?from=x,y
};

/// Any number of threads may draw. What a layer needs is made when it is first looked at.
class WorldLayers {
 public:
  /// Refers to the world.
  explicit WorldLayers(const ServedWorld& world);

  /// All of them as JSON, for questions of this body.
  std::string json(const RobotSpec& robot) const;
  /// nullptr: there is none of that name.
  const LayerAccount* account_of(std::string_view name) const;
  /// Colours and what they mean, with figures, as JSON. Throws as draw().
  /// from: the start, of layers that want one.
  std::string legend(std::string_view name, const std::optional<std::vector<double>>& from,
                     const Execution& execution) const;
  /// A PNG. Throws UsageError where this world has no such layer, InputError for a damaged file, Stopped.
  std::string draw(std::string_view name, const TilePlace& tile, const std::optional<std::vector<double>>& from,
                   const Execution& execution) const;

 private:
  void refuse_missing(std::string_view name) const;
  template <class Use>
  std::string from_start(const std::optional<std::vector<double>>& from, const Execution& execution,
                         const Use& use) const;
  const RoadmapLayer& roadmap(const Execution& execution) const;
  const ClearanceLayer& clearance(const Execution& execution) const;
  const RoadmapLayer& axis(const Execution& execution) const;

  const ServedWorld& world_;
  std::vector<LayerAccount> accounts_;
  MadeOnce<RoadmapLayer> roadmap_;
  MadeOnce<std::uint64_t> passages_;  // how many
  MadeOnce<ClearanceLayer> clearance_;
  MadeOnce<RoadmapArrays> axis_arrays_;
  MadeOnce<RoadmapLayer> axis_;
  std::size_t bytes_a_start_;
  mutable KeptValues<std::unique_ptr<MadeOnce<StartDistances>>> starts_;
};

}  // namespace warren::serve
