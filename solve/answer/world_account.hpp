// SPDX-License-Identifier: BSD-3-Clause
// Which world was solved, in figures and in words; what is in a world, and in a robot that files describe, line by
// line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// What an answer says of its world.
struct WorldAccount {
  std::string source;  ///< as it was asked for
  std::string kind;    ///< "map"; "maze" where the scene has the hint, else "walls", "polygons" where there are any,
                       ///< "solids" where there is nothing else
  std::uint64_t walls = 0;     ///< wall segments
  std::uint64_t polygons = 0;  ///< whose insides are blocked
  std::string hash;            ///< scene_hash
  std::uint64_t spheres = 0;   ///< that only arms meet
  std::uint64_t boxes = 0;     ///< that only arms meet
  std::string unit = {};       ///< of its lengths: "m" or "cells"; empty: nobody says
  std::uint64_t solids = 0;    ///< beside spheres and boxes, that only arms meet
};

/// Where the hash is known. O(1).
WorldAccount account_of(const Scene& scene, std::string hash);
/// Throws Stopped. O(size of the scene), for the hash.
inline WorldAccount account_of(const Scene& scene, const Execution& execution) {
  return account_of(scene, scene_hash(scene, execution));
}

/// "1,604 walls": what it holds, for people; not of a map.
std::string contents_text(const WorldAccount& world);
/// "41 x 41 maze, 1,604 walls": what a person wants to know first.
std::string description_of(const Scene& scene);

/// What is in a world, line by line, for people and as JSON (warren.info/1).
struct Fact {
  std::string name;  ///< a key of warren.info/1
  std::string text;  ///< for people
  std::string json;  ///< its value there
};

/// Throws Stopped. O(size of the scene), for its hash.
std::vector<Fact> facts_of(const Scene& scene, const Execution& execution);
/// Of a robot: its joints with limits and speeds, links, solids, pairs that are kept apart, and what is taken for
/// granted.
std::vector<Fact> facts_of(const ArmModel& model);
/// All facts as one object of warren.info/1.
std::string facts_json(const std::vector<Fact>& facts);

}  // namespace warren
