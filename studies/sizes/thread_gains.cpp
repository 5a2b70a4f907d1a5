// SPDX-License-Identifier: BSD-3-Clause
#include "studies/sizes/thread_gains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "studies/measure/statistics.hpp"

namespace warren::studies {
namespace {

struct Pair {
  const ScalingRun* fewer;
  const ScalingRun* more;

  double scaled(double ratio) const { return ratio * fewer->trial.threads; }
  double gain() const { return scaled(fewer->trial.solve_s / more->trial.solve_s); }
  double arithmetic() const { return scaled(more->arithmetic_per_s / fewer->arithmetic_per_s); }
  bool is_quiet(unsigned cores) const {
    const double all = std::min(more->trial.threads, cores);
    return std::abs(arithmetic() - all) <= 0.05 * all;  // more: the other run was disturbed
  }
};

/// Was it solved, and the arithmetic beside it timed?
bool counts(const ScalingRun& run) { return run.trial.verified && run.arithmetic_per_s > 0.0; }

/// What the runs of a repeat have in common.
auto repeat_of(const ScalingRun& run) {
  const MazeTrial& t = run.trial;
  return std::make_tuple(t.planner, t.sampler, t.pipeline, t.rows, t.cols, t.seed, run.repeat);
}

template <class Value>
double median(const std::vector<Pair>& pairs, const Value& value) {
  std::vector<double> values;
  for (const Pair& pair : pairs) values.push_back(value(pair));
  return median_of(values);
}

std::vector<std::pair<std::string, double>> stage_gains(const std::vector<Pair>& pairs) {
  constexpr double least_s = 2e-4;
  std::vector<std::pair<std::string, double>> gains;
  for (const std::string& stage : stage_names()) {
    const auto fewer = [&](const Pair& p) { return seconds_of(p.fewer->trial, stage); };
    if (median(pairs, fewer) < least_s) continue;
    const auto gain = [&](const Pair& p) { return p.scaled(fewer(p) / seconds_of(p.more->trial, stage)); };
    gains.emplace_back(stage, median(pairs, gain));
  }
  return gains;
}

ThreadGain gain_of(const std::vector<Pair>& pairs, unsigned cores) {
  ThreadGain gain{.first = pairs.front().more->trial, .pairs = pairs.size()};
  gain.gain = median(pairs, [](const Pair& p) { return p.gain(); });
  gain.arithmetic = median(pairs, [](const Pair& p) { return p.arithmetic(); });
  std::vector<Pair> quiet;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(quiet), [&](const Pair& p) { return p.is_quiet(cores); });
  gain.quiet_pairs = quiet.size();
  if (quiet.empty()) return gain;
  gain.quiet_gain = median(quiet, [](const Pair& p) { return p.gain(); });
  gain.quiet_stages = stage_gains(quiet);
  return gain;
}

}  // namespace

std::vector<ThreadGain> thread_gains(const ScalingResult& result, unsigned cores) {
  std::map<decltype(repeat_of(result.runs.front())), const ScalingRun*> fewest;
  for (const ScalingRun& run : result.runs) {
    if (!counts(run)) continue;
    const ScalingRun*& least = fewest.try_emplace(repeat_of(run), &run).first->second;
    if (run.trial.threads < least->trial.threads) least = &run;
  }
  using Key = std::tuple<std::string, std::string, std::string, std::uint32_t, std::uint32_t, unsigned>;
  std::map<Key, std::size_t> place;
  std::vector<std::vector<Pair>> groups;
  for (const ScalingRun& run : result.runs) {
    if (!counts(run)) continue;
    const ScalingRun* const base = fewest.at(repeat_of(run));
    const MazeTrial& t = run.trial;
    if (base->trial.threads == t.threads) continue;
    const Key key{t.planner, t.sampler, t.pipeline, t.rows, t.cols, t.threads};
    const auto [at, is_new] = place.try_emplace(key, groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back({base, &run});
  }
  std::vector<ThreadGain> gains;
  for (const std::vector<Pair>& pairs : groups) gains.push_back(gain_of(pairs, cores));
  return gains;
}

std::string text_of(const ThreadGain& gain) {
  const MazeTrial& t = gain.first;
  std::string text = fmt::format(
      "{} x {}, {}, {} threads: {:.2f} times in the median of {} {}, arithmetic alone {:.2f}", t.rows, t.cols,
      planner_text(t), t.threads, gain.gain, gain.pairs, gain.pairs == 1 ? "pair" : "pairs", gain.arithmetic);
  if (!gain.quiet_gain) return text + "; the machine was quiet in none of them";
  text += fmt::format("; {:.2f} in the {} in which the machine was quiet", *gain.quiet_gain, gain.quiet_pairs);
  std::string stages;
  for (const auto& [name, value] : gain.quiet_stages) {
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", name, value);
  }
  return stages.empty() ? text : text + " (" + stages + ")";
}

}  // namespace warren::studies
