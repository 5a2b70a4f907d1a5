// SPDX-License-Identifier: BSD-3-Clause
// How long a whole run will still take, where its stages and their shares of the time are known: the time that has
// passed tells how fast this machine is. Nothing is said where a stage comes that was not expected, where one takes
// half as long again as its share, and before a twentieth is done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace warren::tools {

/// A stage that a run will come to, and its share of the run's time, in any unit.
struct ExpectedStage {
  std::string_view stage;
  double share;
};
using ExpectedStages = std::span<const ExpectedStage>;

/// What is seen of a run at a moment.
struct RunMoment {
  std::string_view stage;
  std::uint64_t done = 0;
  std::uint64_t total = 0;  ///< 0: not known
  double seconds = 0.0;     ///< since the run began
};

/// Asked in the order of time. What comes before the first of the stages is not counted.
class WholeRun {
 public:
  /// All stages to come, in their order; they outlive it. None: nobody knows.
  explicit WholeRun(ExpectedStages stages) : stages_(stages) {}

  /// The part of the run that is done, never less than it was before; none: nobody knows.
  std::optional<double> part_done(const RunMoment& moment);
  /// Of the wall clock.
  std::optional<double> seconds_left(const RunMoment& moment);

 private:
  bool enter(const RunMoment& moment);

  ExpectedStages stages_;
  bool has_begun_ = false;
  bool is_lost_ = false;  // a stage came that was not expected
  double began_s_ = 0.0;  // the first of the stages, or what is seen of the run
  std::size_t stage_ = 0;
  double stage_began_s_ = 0.0;
  double before_ = 0.0;  // shares of the stages that are over
  double part_ = 0.0;
};

}  // namespace warren::tools
