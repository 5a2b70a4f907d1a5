// SPDX-License-Identifier: BSD-3-Clause
// `warren-mpi scale`: the same maze by more and more ranks (strong), and mazes that grow with them (weak). What was
// measured becomes a table for people and JSON (warren.ranks/1).
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/distributed/shared_solve.hpp"
#include "apps/studies/machine.hpp"
#include "apps/studies/study_report.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::distributed {
namespace {

constexpr tools::OptionSpec scale_specs[] = {
    {"--side", "N", "the maze of the strong runs is N x N; those of k ranks N k x N in the weak ones (default: 4000)"},
    {"--loops", "F", "fraction of the walls left that are taken out (default: 0)"},
    {"--seed", "N", "of the mazes (default: 1)"},
    {"--ranks", "LIST",
     "numbers of ranks, separated by commas, at most those that mpirun has started (default: 1 and all)"},
    {"--json", "FILE", "write warren.ranks/1; - is standard output"},
};

struct RankUse {
  double cpu_s;
  std::uint64_t bytes_sent, peak_bytes;
};

struct RanksRun {
  bool is_strong;  ///< the same maze by more ranks; else one that grows with them
  std::uint32_t ranks, rows, cols;
  double length = 0.0;
  double seconds = 0.0;
  std::vector<RankUse> used = {};                         ///< by rank
  std::array<std::uint64_t, request_count> traffic = {};  ///< bytes, by what was asked

  double cells() const { return static_cast<double>(rows) * cols; }
  std::string_view scaling() const { return is_strong ? "strong" : "weak"; }
  template <class T>
  T sum(T RankUse::*figure) const {
    T all = 0;
    for (const RankUse& rank : used) all += rank.*figure;
    return all;
  }
  std::uint64_t peak_bytes() const { return std::ranges::max(used, {}, &RankUse::peak_bytes).peak_bytes; }
};

studies::TextTable ranks_table(std::span<const RanksRun> runs) {
  studies::TextTable table{
      {"scaling", "ranks", "maze", "clock", "CPU", "CPU a cell", "of 1 rank", "sent a cell", "peak a rank"}, 1, {}};
  for (const RanksRun& run : runs) {
    const auto first = std::ranges::find(runs, run.is_strong, &RanksRun::is_strong);
    const double cpu_ns = 1e9 * run.sum(&RankUse::cpu_s) / run.cells();
    table.rows.push_back({std::string(run.scaling()), std::to_string(run.ranks),
                          fmt::format("{}x{}", run.rows, run.cols), fmt::format("{:.2f} s", run.seconds),
                          fmt::format("{:.2f} s", run.sum(&RankUse::cpu_s)), fmt::format("{:.2f} ns", cpu_ns),
                          fmt::format("{:.3f}", cpu_ns / (1e9 * first->sum(&RankUse::cpu_s) / first->cells())),
                          fmt::format("{:.4f} B", static_cast<double>(run.sum(&RankUse::bytes_sent)) / run.cells()),
                          human_bytes(static_cast<double>(run.peak_bytes()))});
  }
  return table;
}

std::string ranks_json(std::span<const RanksRun> runs, const MazeOptions& mazes, unsigned threads) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const RanksRun& run : runs) {
    nlohmann::ordered_json ranks = nlohmann::ordered_json::array();
    for (const RankUse& used : run.used) {
      ranks.push_back({{"cpu_s", used.cpu_s}, {"bytes_sent", used.bytes_sent}, {"peak_memory_bytes", used.peak_bytes}});
    }
    nlohmann::ordered_json traffic = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < request_count; ++i) {
      if (run.traffic[i] > 0) traffic[std::string(name_of(static_cast<Request>(i)))] = run.traffic[i];
    }
    list.push_back({{"scaling", run.scaling()},
                    {"ranks", run.ranks},
                    {"rows", run.rows},
                    {"cols", run.cols},
                    {"length", run.length},
                    {"clock_s", run.seconds},
                    {"cpu_s", run.sum(&RankUse::cpu_s)},
                    {"bytes_sent", run.sum(&RankUse::bytes_sent)},
                    {"bytes_by_request", traffic},
                    {"by_rank", ranks}});
  }
  const nlohmann::ordered_json whole{
      {"schema", "warren.ranks/1"}, {"seed", mazes.seed}, {"loops", mazes.loops}, {"threads", threads}, {"runs", list}};
  return whole.dump(2) + "\n";
}

/// The first ranks of a run, as if they were all.
class FirstRanks : public Transport {
 public:
  FirstRanks(Transport& all, unsigned ranks) : all_(all), ranks_(ranks) {}
  unsigned rank() const override { return all_.rank(); }
  unsigned ranks() const override { return ranks_; }
  void send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) override {
    all_.send(to, bytes, execution);
  }
  Bytes receive(unsigned from, const Execution& execution) override { return all_.receive(from, execution); }
  bool has_message(unsigned from) override { return all_.has_message(from); }

 private:
  Transport& all_;
  const unsigned ranks_;
};

/// What rank 0 tells the others before each run; no ranks: there is none.
struct NextRun {
  std::uint32_t ranks, rows, cols;
};

class UsedMeter {
 public:
  explicit UsedMeter(const Transport& transport) : transport_(transport), bytes_(transport.bytes_sent()) {
    studies::restart_peak_memory();
  }
  RankUse used() const {
    return {(process_.read() - before_).cpu_s, transport_.bytes_sent() - bytes_, peak_resident_bytes()};
  }

 private:
  const Transport& transport_;
  const std::uint64_t bytes_;
  const studies::RunCounters process_{std::span<const studies::PerfEvent>()};
  const studies::RunCounts before_ = process_.read();
};

struct Mazes {
  explicit Mazes(const tools::Arguments& arguments)
      : side(tools::given_count(arguments, "--side", 1, 1'000'000).value_or(4000)),
        made(tools::maze_words(arguments, {.seed = tools::seed_word(arguments), .algorithm = MazeAlgorithm::mst})) {}
  BandTask task(const NextRun& run) const {
    MazeOptions sized = made;
    sized.rows = run.rows;
    sized.cols = run.cols;
    const Scene unmade = unmade_maze_scene(sized);
    return {unmade, keeping_off(unmade, {}, "")};
  }
  std::uint32_t side;
  MazeOptions made;  // but for its size
};

/// The line of a stop comes before the others are ended, which may take longer than a launcher waits.
RanksRun measured(Transport& transport, const Mazes& mazes, bool is_strong, const NextRun& next,
                  const Execution& execution) {
  const auto told = [&](const auto& work) { telling_where_stopped(transport, *execution.progress, work); };
  told([&] {
    for (unsigned rank = 1; rank < transport.ranks(); ++rank) transport.send_value(rank, next, execution);
  });
  const UsedMeter meter(transport);
  const auto begin = std::chrono::steady_clock::now();
  RanksRun found{.is_strong = is_strong, .ranks = next.ranks, .rows = next.rows, .cols = next.cols};
  {
    FirstRanks first(transport, next.ranks);
    const EndOfFollowers end(first);
    told([&] {
      const BandTask task = mazes.task(next);
      const auto leader = leader_of(first, task, execution);
      PathArrayFile nobodys("", execution);
      SolveOptions options;
      options.roadmap.pipeline = PipelineKind::streamed;
      const Answer answer =
          solve_streamed_within(task.unmade, {}, options, execution, {.taker = &nobodys, .team = leader.get()});
      if (answer.stop_reason) throw Stopped(*answer.stop_reason);
      found.length = answer.length;
      found.traffic = leader->traffic();
    });
  }
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  found.used.push_back(meter.used());
  told([&] {
    for (unsigned rank = 1; rank < next.ranks; ++rank) {
      found.used.push_back(ValueUnpacker(transport.receive(rank, execution), "rank").take<RankUse>());
    }
  });
  return found;
}

std::vector<unsigned> ranks_asked(const tools::Arguments& arguments, unsigned most) {
  std::vector<unsigned> ranks = tools::given_values(arguments, "--ranks", "--ranks", [&](auto option, auto text) {
    return static_cast<unsigned>(tools::count_value(option, text, 1, most));
  });
  if (ranks.empty()) ranks = {1, most};
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

int lead(const tools::Arguments& arguments, Transport& transport) {
  const Mazes mazes(arguments);
  const std::vector<unsigned> ranks = ranks_asked(arguments, transport.ranks());
  tools::Run run(arguments);
  std::vector<RanksRun> runs;
  for (const bool is_strong : {true, false}) {
    for (const unsigned count : ranks) {
      const NextRun next{count, is_strong ? mazes.side : mazes.side * count, mazes.side};
      runs.push_back(measured(transport, mazes, is_strong, next, run.execution()));
    }
  }
  run.end();
  tools::write_report(arguments, "--json", [&] { return ranks_json(runs, mazes.made, run.threads()); });
  run.conclude([&] { return ranks_table(runs).text(run.palette()); });
  return tools::exit_code::success;
}

int follow_runs(const tools::Arguments& arguments, Transport& transport) {
  const Mazes mazes(arguments);
  ranks_asked(arguments, transport.ranks());
  return follow_as(arguments, transport, [&](const FollowerLimits& limits) {
    const Deadline waiting(std::numeric_limits<double>::infinity(), limits.memory_bytes, limits.signal);
    for (;;) {
      const Bytes bytes = transport.receive(0, {.deadline = &waiting});
      if (bytes.size() != sizeof(NextRun)) return;  // the end
      const auto next = ValueUnpacker(bytes, "rank 0").take<NextRun>();
      if (transport.rank() >= next.ranks) continue;
      const UsedMeter meter(transport);
      FirstRanks first(transport, next.ranks);
      follow(first, mazes.task(next), limits);
      transport.send_value(0, meter.used(), {.deadline = &waiting});
    }
  });
}

}  // namespace

tools::Command shared_scale_command(Transport& transport) {
  return {"scale", "", "measure how a streamed solve spreads over ranks",
          tools::joined_options({scale_specs, tools::run_option_specs()}), [&](const tools::Arguments& arguments) {
            return transport.rank() > 0 ? follow_runs(arguments, transport) : lead(arguments, transport);
          }};
}

}  // namespace warren::distributed
