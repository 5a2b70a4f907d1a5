// SPDX-License-Identifier: BSD-3-Clause
// What is in a world, line by line, for people and as JSON (warren.info/1).
#pragma once

#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

struct Fact {
  std::string name;
  std::string text;  ///< for people
  std::string json;
};

/// Throws Stopped. O(size of the scene), for its hash.
std::vector<Fact> facts_of(const Scene& scene, const Execution& execution);
std::string facts_json(const std::vector<Fact>& facts);

}  // namespace warren
