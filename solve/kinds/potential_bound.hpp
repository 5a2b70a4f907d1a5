// SPDX-License-Identifier: BSD-3-Clause
// What no path of a point or disc on a map costs less than, priced or not, and its proof.
#pragma once

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// Where a bound, a gap or a certificate is asked of a verified answer of grid on a map: the best bound of all paths
/// that is found until the gap is reached; of a certificate that is asked for, what it proves. `scene`: as it is
/// planned in. Stops leave the bound that there is.
void prove_on_map(Answer& answer, const Scene& scene, const SolveOptions& options, ByProducts* keep,
                  const Execution& execution);

}  // namespace warren
