// SPDX-License-Identifier: BSD-3-Clause
// One obstacle of a scene of the plane, with nothing else around: how deep a body stands in it is asked there.
#pragma once

#include <optional>
#include <string_view>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// name: as Violation::obstacle. A wall, or a polygon with all that were cut from the same one, within bounds that
/// leave `room` around it; the bounds without what lies in them; of a cell the whole map. None for all others, such as
/// what is outside. Throws Stopped.
std::optional<Scene> obstacle_alone(const Scene& scene, std::string_view name, double room, const Execution& execution);

}  // namespace warren
