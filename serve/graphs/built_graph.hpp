// SPDX-License-Identifier: BSD-3-Clause
// Route graphs that nobody has to draw: the axis of what is free, or a roadmap of samples, built as `warren build` does
// and numbered as `warren export` does.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "serve/graphs/route_graph.hpp"
#include "solve/roadmaps/roadmap.hpp"

namespace warren::serve {

/// axis: as far from all obstacles as can be; of a body that turns, that of the disc around it, where it may stand in
/// all headings. roadmap: of samples.
enum class GraphKind : std::uint8_t { axis, roadmap };
constexpr auto enum_names(GraphKind) { return std::array<std::string_view, 2>{"axis", "roadmap"}; }

struct GraphOptions {
  GraphKind kind = GraphKind::axis;
  std::optional<std::uint64_t> samples = {};     ///< of a roadmap; none: it grows until what is joined stays joined
  std::optional<std::uint32_t> neighbours = {};  ///< of a roadmap; none: by its rule
  std::uint64_t seed = 1;
};

/// Throws UsageError where there is no axis in such a world; any walls will do.
void check_has_axis(const Scene& scene, const RobotSpec& robot, double clearance);
/// Throws UsageError for what can't be built in this world, Stopped.
Roadmap built_roadmap(const Scene& scene, const RobotSpec& robot, double clearance, const GraphOptions& options,
                      const Execution& execution);
/// The same as a graph. Throws HttpError, too, for more than can be edited.
RouteGraph built_graph(const Scene& scene, const RobotSpec& robot, double clearance, const GraphOptions& options,
                       const Execution& execution);

/// The free edges of a roadmap. Throws HttpError for more than can be edited, Stopped.
RouteGraph graph_of_roadmap(const Roadmap& roadmap, const Execution& execution);

}  // namespace warren::serve
