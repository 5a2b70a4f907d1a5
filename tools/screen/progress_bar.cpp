// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "pictures/answer_summary.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::tools {
namespace {

using namespace std::chrono_literals;

std::string bar(double fraction, std::size_t width) {
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(width));
  std::string text(width, ' ');
  std::fill_n(text.begin(), filled, '=');
  if (filled < width) text[filled] = '>';
  return "[" + text + "]";
}

}  // namespace

std::string erasing(std::size_t columns, std::size_t width) {
  const std::size_t rows_above = columns == 0 ? 0 : (columns - 1) / std::max<std::size_t>(width, 1);
  return rows_above == 0 ? "\r\x1b[K" : fmt::format("\r\x1b[{}A\x1b[J", rows_above);
}

std::string progress_line(const RunMoment& moment, double items_per_s, std::string_view of_whole_run,
                          std::size_t width) {
  std::string line = fmt::format("{:<10}", moment.stage);
  std::string figures;
  double fraction = 0.0;
  if (moment.total > 0) {
    fraction = std::min(1.0, static_cast<double>(moment.done) / static_cast<double>(moment.total));
    figures += fmt::format(" {:3.0f} %", 100.0 * fraction);
    if (items_per_s > 0.0 && moment.done < moment.total) {
      const auto left = static_cast<double>(moment.total - moment.done);
      figures += fmt::format("  {}/s  {} left of it", human_count(items_per_s), human_seconds(left / items_per_s));
    }
  } else if (items_per_s > 0.0) {
    figures = fmt::format(" {}  {}/s", human_count(static_cast<double>(moment.done)), human_count(items_per_s));
  }
  if (!of_whole_run.empty()) figures += fmt::format("{}{}", figures.empty() ? " " : ", ", of_whole_run);
  constexpr std::size_t widest_bar = 40;
  const std::size_t used = line.size() + figures.size() + 3;
  if (moment.total > 0 && used + 8 < width) line += bar(fraction, std::min(widest_bar, width - used));
  line += figures;
  if (line.size() >= width) line.resize(width - 1);
  return line;
}

ProgressBar::ProgressBar(const Progress& progress, ProgressMode mode, std::optional<double> budget_s,
                         ExpectedStages stages)
    : progress_(progress), mode_(resolved(mode)), budget_s_(budget_s), whole_(stages), stage_begin_(begin_) {
  if (mode_ == ProgressMode::none) return;
  const auto period = mode_ == ProgressMode::bar ? 100ms : 2000ms;
  ticker_ = std::make_unique<Ticker>(1000ms, period, [this] { draw(); });
}

ProgressBar::~ProgressBar() {
  ticker_.reset();
  if (columns_ > 0 && mode_ == ProgressMode::bar) std::fputs(erasing(columns_, terminal_width()).c_str(), stderr);
}

std::string ProgressBar::whole_run_text(const RunMoment& moment, double items_per_s) {
  auto left = whole_.seconds_left(moment);
  if (left && items_per_s > 0.0 && moment.done < moment.total) {
    left = std::max(*left, static_cast<double>(moment.total - moment.done) / items_per_s);  // no less than the stage
  }
  if (left && !(budget_s_ && *budget_s_ - moment.seconds < *left)) {
    return fmt::format("about {} left in all", human_seconds(*left));
  }
  if (!budget_s_) return {};
  return fmt::format("--budget ends in {}", human_seconds(std::max(0.0, *budget_s_ - moment.seconds)));
}

void ProgressBar::tell(const Improvement& improvement) {
  best_.use([&](auto& best) { best = improvement; });
}

std::string improvement_text(const Improvement& best) {
  std::string text = fmt::format("cost {}", human_number(best.cost));
  if (best.lower_bound > 0.0) {
    const double gap = std::max(0.0, best.cost / best.lower_bound - 1.0);
    text += fmt::format(", bound {}, gap {}", human_number(best.lower_bound), share_text(gap));
  }
  return text + fmt::format(", turn {}", best.iterations);
}

void ProgressBar::draw() {
  const char* stage = progress_.stage();
  if (stage == nullptr) return;
  const auto now = std::chrono::steady_clock::now();
  const std::uint64_t done = progress_.done();
  if (stage != stage_ || done < done_at_begin_) {
    stage_ = stage;
    stage_begin_ = now;
    done_at_begin_ = done;
  }
  const double seconds = std::chrono::duration<double>(now - stage_begin_).count();
  const double rate = seconds > 0.0 ? static_cast<double>(done - done_at_begin_) / seconds : 0.0;
  const std::size_t width = terminal_width();
  RunMoment moment{stage, done, progress_.total(), std::chrono::duration<double>(now - begin_).count()};
  std::string whole_run = whole_run_text(moment, rate);
  const std::optional<Improvement> best = best_.use([](auto& now) { return now; });
  if (best && moment.stage == "search") {
    whole_run = improvement_text(*best) + (whole_run.empty() ? "" : ", " + whole_run);
  }
  const std::string line = progress_line(moment, rate, whole_run, width);
  std::fputs((mode_ == ProgressMode::bar ? erasing(columns_, width) + line : line + "\n").c_str(), stderr);
  std::fflush(stderr);
  columns_ = line.size();
}

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
