// SPDX-License-Identifier: BSD-3-Clause
// What a .roadmap file says of itself, whatever is in it.
#pragma once

#include <cstdint>
#include <string>

namespace warren {

struct RoadmapFileHeader {
  std::uint64_t world_hash = 0;   ///< of the world that it was made for
  std::uint64_t recipe_hash = 0;  ///< of body, options and seed
  std::string writer;             ///< program and version: "warren 0.1.0"; at most 16 printable characters of ASCII
};

}  // namespace warren
