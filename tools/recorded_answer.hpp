// SPDX-License-Identifier: BSD-3-Clause
// An answer read back from JSON: ours or anybody's that has a "path". Strict JSON, read in one pass without a tree, so
// a path of millions of points takes its own memory only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "parallel/execution.hpp"
#include "tools/problem.hpp"
#include "worlds/scene.hpp"

namespace warren {

struct RecordedAnswer {
  ProblemOptions problem;  ///< what the answer says of the problem
  std::optional<std::string> world_hash;
  std::optional<double> length;
  std::vector<Vec2> path;  ///< may be empty only where the answer says that there is none
};

/// "-" is standard input. Throws ReadError, InputError naming file and key, Stopped.
RecordedAnswer read_answer(const std::string& file, const Execution& execution);

/// Throws InputError if the answer names the hash of another world.
void check_same_world(const RecordedAnswer& answer, const std::string& file, const Scene& scene,
                      const Execution& execution);

}  // namespace warren
