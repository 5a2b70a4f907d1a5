// SPDX-License-Identifier: BSD-3-Clause
// The words that a question has beside start, goal and body, as a table: how each is asked, by what name a refusal has
// to call it, and by what an answer shows that it was heard. And bodies in worlds, for which all of them are asked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::test {

struct AskedRow {
  std::string name;  ///< of the option, as a refusal spells it
  std::function<void(Question&, SolveOptions&)> ask;
  std::function<bool(const Answer&)> is_heard;
  bool by_all = false;  ///< does every planner take it?
  /// Makes the answer claim what its path does not do, which the judge has to see; empty: it claims nothing of the
  /// word.
  std::function<void(Answer&)> spoil = {};
  std::string with = {};  ///< another word that is asked with it, and may be refused first
};

/// A body in a world, whose start and goal are free and joined, and a place that is not on the shortest way.
struct AskedBody {
  std::string name;
  Scene scene;
  RobotSpec robot;
};

/// All words. Their places are those of asked_bodies().
std::vector<AskedRow> asked_rows();
/// Points, discs, polygons that turn, cars and differential drives, on a map and among polygons; an arm at a sphere.
std::vector<AskedBody> asked_bodies();
/// What a question of the body names for a place of the plane: its two coordinates; of an arm the posture that its own
/// plane has there, two of its joints. Headings are added by the caller.
std::vector<double> state_at(const RobotSpec& robot, Vec2 place);

}  // namespace warren::test
