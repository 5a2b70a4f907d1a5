// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/scaling_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "apps/studies/statistics.hpp"
#include "solve/answer/answer.hpp"

namespace warren::studies {
namespace {

/// One study: mazes outside, runs inside.
class ScalingStudy {
 public:
  ScalingStudy(const ScalingOptions& options, const Execution& execution,
               const std::function<void(std::string_view)>& note)
      : options_(options), execution_(execution), note_(note) {
    result_.no_hardware_counts = counters_.refusal();
  }

  ScalingResult run_all() {
    try {
      for (const auto& [rows, cols] : options_.sizes) {
        for (const std::uint64_t seed : options_.seeds) run_maze(rows, cols, seed);
      }
    } catch (const Stopped& stopped) {
      result_.signal = stopped.reason;
    }
    return std::move(result_);
  }

 private:
  void run_maze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed) {
    MazeOptions maze = options_.maze;
    maze.rows = rows;
    maze.cols = cols;
    maze.seed = seed;
    double generate_s = 0.0;
    const std::optional<Scene> scene = generated(maze, generate_s);
    if (!scene) return;
    const std::size_t first_run = result_.runs.size();
    for (unsigned repeat = 0; repeat < options_.repeats; ++repeat) run_once(*scene, maze, generate_s, repeat);
    say(maze, first_run);
  }
  std::optional<Scene> generated(const MazeOptions& maze, double& seconds) {
    const bool alone = options_.planners.size() == 1;
    const SolveOptions& planner = alone ? options_.planners.front() : SolveOptions{};
    std::optional<Scene> scene;
    if (memory_holds([&] { scene = generate_trial(maze, planner, execution_, seconds); })) return scene;
    result_.ungenerated.emplace_back(maze.rows, maze.cols);
    note_(fmt::format("{:>6} x {:<6} too little memory to generate it", maze.rows, maze.cols));
    return std::nullopt;
  }
  void run_once(const Scene& scene, const MazeOptions& maze, double generate_s, unsigned repeat) {
    for (const SolveOptions& planner : options_.planners) {
      for (const unsigned threads : options_.threads) {
        Execution execution = execution_;
        execution.threads = threads;
        const double arithmetic_before = arithmetic_per_second(execution);
        const RunCounts before = counters_.read();
        MazeTrial trial = solve_trial(scene, maze, options_.question, planner, options_.budget_s, execution);
        const RunCounts counts = counters_.read() - before;
        trial.generate_s = generate_s;
        result_.runs.push_back({std::move(trial), repeat, counts});
        result_.runs.back().arithmetic_per_s = 0.5 * (arithmetic_before + arithmetic_per_second(execution));
      }
    }
  }
  void say(const MazeOptions& maze, std::size_t first_run) const {
    const MazeTrial* fastest = nullptr;
    for (std::size_t i = first_run; i < result_.runs.size(); ++i) {
      const MazeTrial& t = result_.runs[i].trial;
      if (t.verified && (fastest == nullptr || t.solve_s < fastest->solve_s)) fastest = &t;
    }
    note_(fmt::format("{:>6} x {:<6} seed {}: {} runs, {}", maze.rows, maze.cols, maze.seed,
                      result_.runs.size() - first_run,
                      fastest == nullptr ? "none solved" : "fastest " + human_seconds(fastest->solve_s)));
  }

  const ScalingOptions& options_;
  const Execution& execution_;
  const std::function<void(std::string_view)>& note_;
  const RunCounters counters_;  // made before any thread that works
  ScalingResult result_;
};

/// Each stage's least, and each link's.
void take_least(MazeTrial& least, const MazeTrial& other) {
  for (double StageTimes::*stage :
       {&StageTimes::index, &StageTimes::sample, &StageTimes::neighbours, &StageTimes::connect, &StageTimes::graph,
        &StageTimes::reduce, &StageTimes::search, &StageTimes::optimise, &StageTimes::verify}) {
    least.seconds.*stage = std::min(least.seconds.*stage, other.seconds.*stage);
  }
  for (StageCost& cost : least.costs) {
    for (const StageCost& o : other.costs) {
      if (std::string_view(o.name) == cost.name) cost.wall_s = std::min(cost.wall_s, o.wall_s);
    }
  }
}

ScalingRow row_of(const std::vector<const ScalingRun*>& runs) {
  const ScalingRun& fastest = **std::min_element(
      runs.begin(), runs.end(), [](const auto* a, const auto* b) { return a->trial.solve_s < b->trial.solve_s; });
  ScalingRow row{.fastest = fastest.trial, .runs = runs.size(), .counts = fastest.counts};
  row.fastest.seconds = runs.front()->trial.seconds;
  row.fastest.costs = runs.front()->trial.costs;
  std::vector<double> seconds;
  std::map<std::uint64_t, std::pair<double, double>> extremes;  // by seed
  for (const ScalingRun* run : runs) {
    const MazeTrial* t = &run->trial;
    seconds.push_back(t->solve_s);
    take_least(row.fastest, *t);
    row.peak_memory_bytes = std::max(row.peak_memory_bytes, t->peak_memory_bytes);
    auto& [low, high] = extremes.try_emplace(t->seed, t->solve_s, t->solve_s).first->second;
    low = std::min(low, t->solve_s);
    high = std::max(high, t->solve_s);
  }
  for (const auto& [seed, extreme] : extremes) row.spread = std::max(row.spread, extreme.second / extreme.first - 1.0);
  row.median_s = median_of(seconds);
  return row;
}

void add_speed_ups(std::vector<ScalingRow>& rows) {
  for (ScalingRow& row : rows) {
    const ScalingRow* base = &row;
    for (const ScalingRow& other : rows) {
      const MazeTrial& a = other.fastest;
      const MazeTrial& b = row.fastest;
      const bool same_problem =
          a.planner == b.planner && a.sampler == b.sampler && a.rows == b.rows && a.cols == b.cols;
      if (same_problem && a.threads < base->fastest.threads) base = &other;
    }
    row.speed_up = base->fastest.threads * base->fastest.solve_s / row.fastest.solve_s;
  }
}

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

ScalingResult run_scaling_study(const ScalingOptions& options, const Execution& execution,
                                const std::function<void(std::string_view)>& note) {
  return ScalingStudy(options, execution, note).run_all();
}

std::vector<ScalingRow> scaling_rows(const ScalingResult& result) {
  std::vector<const ScalingRun*> solved;
  for (const ScalingRun& run : result.runs) {
    if (run.trial.verified) solved.push_back(&run);
  }
  const auto in_common = [](const ScalingRun* run) {
    const MazeTrial& t = run->trial;
    return std::tuple(t.planner, t.sampler, t.rows, t.cols, t.threads);
  };
  std::vector<ScalingRow> rows;
  for (const auto& group : in_groups(solved, in_common)) rows.push_back(row_of(group));
  std::stable_sort(rows.begin(), rows.end(), [](const ScalingRow& a, const ScalingRow& b) {
    return std::tie(a.fastest.planner, a.fastest.sampler) < std::tie(b.fastest.planner, b.fastest.sampler);
  });
  add_speed_ups(rows);
  return rows;
}

std::optional<double> common_exponent(std::span<const std::vector<Vec2>> groups) {
  double xx = 0.0;
  double xy = 0.0;
  for (const std::vector<Vec2>& group : groups) {
    Vec2 mean;
    for (const Vec2 p : group) mean = mean + Vec2{std::log(p.x), std::log(p.y)};
    if (!group.empty()) mean = 1.0 / static_cast<double>(group.size()) * mean;
    for (const Vec2 p : group) {
      const Vec2 d = Vec2{std::log(p.x), std::log(p.y)} - mean;
      xx += d.x * d.x;
      xy += d.x * d.y;
    }
  }
  constexpr double least = 1e-9;  // below it all x are the same but for rounding
  return xx > least ? std::optional(xy / xx) : std::nullopt;
}

std::vector<std::pair<std::string, double>> stage_exponents(std::span<const ScalingRow> rows) {
  constexpr double least_s = 20e-6;
  std::vector<std::pair<std::string, double>> exponents;
  for (const std::string& stage : all_stages()) {
    std::map<std::tuple<std::string, std::string, unsigned>, std::vector<Vec2>> by_way;
    for (const ScalingRow& row : rows) {
      const MazeTrial& t = row.fastest;
      const double seconds = seconds_of(t, stage);
      if (seconds >= least_s) by_way[{t.planner, t.sampler, t.threads}].push_back({t.cells(), seconds});
    }
    std::vector<std::vector<Vec2>> groups;
    for (auto& [way, points] : by_way) groups.push_back(std::move(points));
    if (const auto exponent = common_exponent(groups)) exponents.emplace_back(stage, *exponent);
  }
  return exponents;
}

std::vector<std::string> stage_names() {
  StageTimes all{0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1};  // what is zero may go unnamed: reading and generating do
  std::vector<std::string> names;
  for (const auto& [name, seconds] : named_stages(all)) names.emplace_back(name);
  return names;
}

std::vector<std::string> link_names() { return {"queries", "checks", "rows", "components", "reduction", "expansion"}; }

std::vector<std::string> all_stages() {
  std::vector<std::string> stages = stage_names();
  for (std::string& link : link_names()) stages.push_back(std::move(link));
  stages.emplace_back("solve");
  return stages;
}

double seconds_of(const MazeTrial& trial, std::string_view stage) {
  if (stage == "solve") return trial.solve_s;
  for (const auto& [name, seconds] : named_stages(trial.seconds)) {
    if (stage == name) return seconds;
  }
  for (const StageCost& cost : trial.costs) {
    if (stage == cost.name) return cost.wall_s;
  }
  return 0.0;
}

std::vector<ThreadGain> thread_gains(const ScalingResult& result, unsigned cores) {
  std::map<decltype(repeat_of(result.runs.front())), const ScalingRun*> fewest;
  for (const ScalingRun& run : result.runs) {
    if (!counts(run)) continue;
    const ScalingRun*& least = fewest.try_emplace(repeat_of(run), &run).first->second;
    if (run.trial.threads < least->trial.threads) least = &run;
  }
  std::vector<Pair> pairs;
  for (const ScalingRun& run : result.runs) {
    if (!counts(run)) continue;
    const ScalingRun* const base = fewest.at(repeat_of(run));
    if (base->trial.threads != run.trial.threads) pairs.push_back({base, &run});
  }
  const auto in_common = [](const Pair& pair) {
    const MazeTrial& t = pair.more->trial;
    return std::tuple(t.planner, t.sampler, t.pipeline, t.rows, t.cols, t.threads);
  };
  std::vector<ThreadGain> gains;
  for (const std::vector<Pair>& group : in_groups(pairs, in_common)) gains.push_back(gain_of(group, cores));
  return gains;
}

std::string text_of(const ThreadGain& gain) {
  const MazeTrial& t = gain.first;
  std::string text = fmt::format(
      "{} x {}, {}, {} threads: {:.2f} times as fast as one (median of {} {}), arithmetic alone {:.2f} times", t.rows,
      t.cols, planner_text(t), t.threads, gain.gain, gain.pairs, gain.pairs == 1 ? "pair of runs" : "pairs of runs",
      gain.arithmetic);
  if (!gain.quiet_gain) return text + "; the machine was quiet in none of them";
  text += fmt::format("; while the machine was quiet, in {} of them, {:.2f} times", gain.quiet_pairs, *gain.quiet_gain);
  std::string stages;
  for (const auto& [name, value] : gain.quiet_stages) {
    stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", name, value);
  }
  return stages.empty() ? text : text + " (" + stages + ")";
}

}  // namespace warren::studies
