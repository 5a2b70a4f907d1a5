// SPDX-License-Identifier: BSD-3-Clause
#include "apps/distributed/ranks_report_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/enum_names.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::distributed {
namespace {

std::string_view scaling_of(const RanksRun& run) { return run.is_strong ? "strong" : "weak"; }

}  // namespace

double RanksRun::cpu_s() const {
  double sum = 0.0;
  for (const RankUse& rank : used) sum += rank.cpu_s;
  return sum;
}

std::uint64_t RanksRun::bytes_sent() const {
  std::uint64_t sum = 0;
  for (const RankUse& rank : used) sum += rank.bytes_sent;
  return sum;
}

std::uint64_t RanksRun::peak_bytes() const {
  std::uint64_t most = 0;
  for (const RankUse& rank : used) most = std::max(most, rank.peak_bytes);
  return most;
}

studies::TextTable ranks_table(std::span<const RanksRun> runs) {
  studies::TextTable table{
      {"scaling", "ranks", "maze", "clock", "CPU", "CPU a cell", "of 1 rank", "sent a cell", "peak a rank"}, 1, {}};
  for (const RanksRun& run : runs) {
    const auto first =
        std::find_if(runs.begin(), runs.end(), [&](const RanksRun& r) { return r.is_strong == run.is_strong; });
    const double cpu_ns = 1e9 * run.cpu_s() / run.cells();
    table.rows.push_back({std::string(scaling_of(run)), std::to_string(run.ranks),
                          fmt::format("{}x{}", run.rows, run.cols), fmt::format("{:.2f} s", run.seconds),
                          fmt::format("{:.2f} s", run.cpu_s()), fmt::format("{:.2f} ns", cpu_ns),
                          fmt::format("{:.3f}", cpu_ns / (1e9 * first->cpu_s() / first->cells())),
                          fmt::format("{:.4f} B", static_cast<double>(run.bytes_sent()) / run.cells()),
                          human_bytes(static_cast<double>(run.peak_bytes()))});
  }
  return table;
}

std::string ranks_json(std::span<const RanksRun> runs, const RanksSettings& settings) {
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
    list.push_back({{"scaling", scaling_of(run)},
                    {"ranks", run.ranks},
                    {"rows", run.rows},
                    {"cols", run.cols},
                    {"length", run.length},
                    {"clock_s", run.seconds},
                    {"cpu_s", run.cpu_s()},
                    {"bytes_sent", run.bytes_sent()},
                    {"bytes_by_request", traffic},
                    {"by_rank", ranks}});
  }
  const nlohmann::ordered_json whole{{"schema", "warren.ranks/1"},
                                     {"seed", settings.seed},
                                     {"loops", settings.loops},
                                     {"threads", settings.threads},
                                     {"runs", list}};
  return whole.dump(2) + "\n";
}

}  // namespace warren::distributed
