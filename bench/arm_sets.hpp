// SPDX-License-Identifier: BSD-3-Clause
// MoveIt problems as MotionBenchMaker has them: sceneNNNN.yaml beside requestNNNN.yaml, a set a folder.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "planners/trees/rrt_connect.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/question/question_of_arm.hpp"
#include "worlds/arms/arm_world.hpp"

namespace warren {

struct SetProblem {
  Scene scene;
  ArmProblem arm;
};

inline std::vector<std::filesystem::path> scenes_of(const std::string& folder) {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("scene") && entry.path().extension() == ".yaml") scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// As in its file's name.
inline std::string number_of(const std::filesystem::path& scene) { return scene.stem().string().substr(5); }

inline SetProblem read_set_problem(const std::filesystem::path& file, const RobotSpec& robot,
                                   const Execution& execution) {
  Scene scene = read_world(file.string(), execution);
  const auto request = file.parent_path() / ("request" + number_of(file) + ".yaml");
  take_moveit_request(scene, InputFile(request.string(), execution), execution);
  Question question;
  question.robot = robot;
  ArmProblem arm = arm_problem(scene, question, execution);
  return {std::move(scene), std::move(arm)};
}

/// As solve/kinds/solve_arm.cpp has them for arms of files.
inline RrtOptions options_of_sets() {
  RrtOptions options;
  options.step = 1.0;
  options.domain = 5.0;
  options.moving = 6.0;
  options.sampler = SamplerKind::random;
  options.nodes = 100'000;
  return options;
}

/// The value below which such a share of them lies; not a number: there are none.
inline double at_share(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

/// So many of the states on a way in joint space, a radian of it, are looked at where motions are sampled: VAMP's.
inline constexpr double states_a_radian = 32.0;

/// Looks at states of the way, and at nothing between.
struct SampledArmWorld : ArmWorld {
  using ArmWorld::ArmWorld;
  bool is_free_motion(const JointState& a, const JointState& b, Query& query) const {
    const int count = std::max(1, static_cast<int>(std::ceil(states_a_radian * distance(a, b))));
    for (int i = count; i > 0; --i) {
      if (!is_free(interpolate(a, b, static_cast<double>(i) / count), query)) return false;
    }
    return true;
  }
  bool is_free_step(const JointState& a, const JointState& b, Query& query) const {
    return is_free_motion(a, b, query);
  }
};

}  // namespace warren
