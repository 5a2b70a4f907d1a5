// SPDX-License-Identifier: BSD-3-Clause
// One question asked again and again while cells of its map change and the robot moves on. Each answer is that of a
// fresh solve(), byte by byte, but for the account of the work: what a change does not touch is not done anew. Where a
// map is searched by its priced cells (grid, points and discs) the field of costs is repaired, which pays where changes
// are small beside the map; all other questions are solved afresh.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/question/limits.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

class KeptWays;  // solve/kinds/kept_ways.hpp

/// A cell of a map that is blocked or free from now on; unknown or water it is no more.
struct CellChange {
  Cell cell;
  bool blocked = true;
};

/// Changes the cells of the scene's map, one after the other. Throws UsageError where the world is no map, InputError
/// for a cell outside of it; then nothing has changed.
void change_cells(Scene& scene, std::span<const CellChange> cells);
/// All cells whose middle is in the box, world coordinates. Throws UsageError as above, Stopped, after which some have
/// changed. Costs what the cells cost that are near the box.
void change_cells(Scene& scene, const Box& box, bool blocked, const Execution& execution = {});

/// Holds its world. One thread.
class Replanner : NotCopied {
 public:
  /// limits: of each solve.
  Replanner(Scene scene, Question question, SolveOptions options = {}, Limits limits = {});
  ~Replanner();

  /// As change_cells().
  void update(std::span<const CellChange> cells) { change_cells(scene_, cells); }
  /// The same.
  void update(const Box& box, bool blocked) { change_cells(scene_, box, blocked); }
  /// From there; empty: as the question says. Throws as solve() does.
  Answer solve(const std::vector<double>& start = {});
  /// The same with an execution that goes on.
  Answer solve_within(const std::vector<double>& start, const Execution& execution);
  /// The world as it is now.
  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
  Question question_;
  SolveOptions options_;
  Limits limits_;
  std::unique_ptr<KeptWays> kept_;
};

}  // namespace warren
