// SPDX-License-Identifier: BSD-3-Clause
// Which worlds a body can be planned and judged in at all. All verbs ask here, so that they refuse alike.
#pragma once

#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"

namespace warren {

/// Arms plan among spheres and boxes or in free space; all others among walls, polygons, bounds or on a map; nobody
/// where both are mixed, and no body of the plane where nothing confines it. Throws UsageError, saying what would do.
void check_plannable(const Scene& scene, const Question& problem);

}  // namespace warren
