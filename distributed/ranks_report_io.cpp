// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/ranks_report_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/enum_names.hpp"

namespace warren {

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

std::string ranks_table(std::span<const RanksRun> runs) {
  std::string text =
      "        ranks          maze   clock s     CPU s  CPU a cell  of 1 rank    sent a cell   peak a rank\n";
  for (const RanksRun& run : runs) {
    const auto first =
        std::find_if(runs.begin(), runs.end(), [&](const RanksRun& r) { return r.is_strong == run.is_strong; });
    const double cpu_ns = 1e9 * run.cpu_s() / run.cells();
    text += fmt::format("{:7} {:5} {:>13} {:9.2f} {:9.2f} {:8.2f} ns {:9.3f} {:12.4f} B {:9.1f} MiB\n",
                        run.is_strong ? "strong" : "weak", run.ranks, fmt::format("{}x{}", run.rows, run.cols),
                        run.seconds, run.cpu_s(), cpu_ns, cpu_ns / (1e9 * first->cpu_s() / first->cells()),
                        static_cast<double>(run.bytes_sent()) / run.cells(),
                        static_cast<double>(run.peak_bytes()) / (1024.0 * 1024.0));
  }
  return text;
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
    list.push_back({{"scaling", run.is_strong ? "strong" : "weak"},
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

}  // namespace warren
