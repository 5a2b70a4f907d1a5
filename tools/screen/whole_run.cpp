// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/whole_run.hpp"

#include <algorithm>

namespace warren::tools {

/// The stage of the moment, or a later one that has begun.
bool WholeRun::enter(const RunMoment& moment) {
  const auto is_it = [&](const ExpectedStage& one) { return one.stage == moment.stage; };
  const auto here = stages_.begin() + static_cast<std::ptrdiff_t>(stage_);
  const auto found = std::find_if(here, stages_.end(), is_it);
  if (found == stages_.end()) {
    is_lost_ = has_begun_;
    began_s_ = moment.seconds;
    return false;
  }
  has_begun_ = true;
  if (found == here) return true;
  for (auto over = here; over != found; ++over) before_ += over->share;
  stage_ = static_cast<std::size_t>(found - stages_.begin());
  stage_began_s_ = moment.seconds;
  return true;
}

std::optional<double> WholeRun::part_done(const RunMoment& moment) {
  if (is_lost_ || !enter(moment)) return std::nullopt;
  double all = 0.0;
  for (const ExpectedStage& stage : stages_) all += stage.share;
  const double share = stages_[stage_].share;
  double part = 0.0;
  if (moment.total > 0) {
    part = std::min(1.0, static_cast<double>(moment.done) / static_cast<double>(moment.total));
  } else if (before_ > 0.0) {
    constexpr double too_long = 1.5;
    const double takes_s = (stage_began_s_ - began_s_) / before_ * share;
    part = (moment.seconds - stage_began_s_) / takes_s;
    if (!(part <= too_long)) return std::nullopt;
    part = std::min(1.0, part);
  }
  part_ = std::max(part_, (before_ + part * share) / all);
  return part_;
}

std::optional<double> WholeRun::seconds_left(const RunMoment& moment) {
  constexpr double tells_enough = 0.05;
  const auto part = part_done(moment);
  if (!part || *part < tells_enough) return std::nullopt;
  return (moment.seconds - began_s_) * (1.0 - *part) / *part;
}

}  // namespace warren::tools
