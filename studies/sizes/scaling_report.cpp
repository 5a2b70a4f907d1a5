// SPDX-License-Identifier: BSD-3-Clause
#include "studies/sizes/scaling_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "scenes/text/human_units.hpp"
#include "studies/measure/machine_memory.hpp"
#include "studies/sizes/thread_gains.hpp"

namespace warren::studies {
namespace {

using Json = nlohmann::ordered_json;

Json exponents_json(std::span<const ScalingRow> rows) {
  Json json = Json::object();
  for (const auto& [stage, exponent] : stage_exponents(rows)) json[stage] = exponent;
  return json;
}

Json gain_json(const ThreadGain& gain) {
  const MazeTrial& t = gain.first;
  Json stages = Json::object();
  for (const auto& [name, value] : gain.quiet_stages) stages[name] = value;
  return {{"rows", t.rows},
          {"cols", t.cols},
          {"threads", t.threads},
          {"planner", t.planner},
          {"sampler", t.sampler},
          {"pipeline", t.pipeline},
          {"pairs", gain.pairs},
          {"gain", gain.gain},
          {"arithmetic", gain.arithmetic},
          {"quiet_pairs", gain.quiet_pairs},
          {"quiet_gain", gain.quiet_gain ? Json(*gain.quiet_gain) : Json(nullptr)},
          {"quiet_stage_gains", std::move(stages)}};
}

std::string side_text(const MazeTrial& t) { return fmt::format("{} x {}", t.rows, t.cols); }

std::string table_line(const ScalingRow& row) {
  const MazeTrial& t = row.fastest;
  const auto bytes = static_cast<double>(row.peak_memory_bytes);
  return fmt::format("{:>15}  {:<30} {:>7}  {:>9}  {:>9}  {:>5.1f} %  {:>8.1f}  {:>8.2f}  {:>9}  {:>8.1f}\n",
                     side_text(t), planner_text(t), t.threads, human_seconds(t.solve_s), human_seconds(row.median_s),
                     100.0 * row.spread, t.solve_s * 1e9 / t.cells(), row.speed_up, human_bytes(bytes),
                     bytes / t.cells());
}

std::string unsolved_text(const ScalingResult& result) {
  std::string text;
  std::set<std::string> said;
  for (const ScalingRun& run : result.runs) {
    if (run.trial.verified) continue;
    const std::string what = fmt::format("  {}, {}, {}: {}\n", side_text(run.trial), planner_text(run.trial),
                                         counted(run.trial.threads, "thread", "threads"), verdict_of(run.trial));
    if (said.insert(what).second) text += what;
  }
  for (const auto& [rows, cols] : result.ungenerated) {
    text += fmt::format("  {} x {}: too little memory to generate it\n", rows, cols);
  }
  return text;
}

}  // namespace

TextTable exponent_table(std::span<const ScalingRow> rows) {
  std::vector<std::pair<std::string, std::vector<ScalingRow>>> contenders;
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    const std::string name = fmt::format("{}, {}", planner_text(t), counted(t.threads, "thread", "threads"));
    auto at = std::find_if(contenders.begin(), contenders.end(), [&](const auto& own) { return own.first == name; });
    if (at == contenders.end()) at = contenders.insert(at, {name, {}});
    at->second.push_back(row);
  }
  TextTable table{{"contender"}, 1, {}};
  const std::vector<std::string> stages = all_stages();
  table.head.insert(table.head.end(), stages.begin(), stages.end());
  for (const auto& [name, own] : contenders) {
    std::map<std::string, double> exponents;
    for (const auto& [stage, exponent] : stage_exponents(own)) exponents[stage] = exponent;
    if (exponents.empty()) continue;
    table.rows.push_back({name});
    for (const std::string& stage : stages) {
      const auto found = exponents.find(stage);
      table.rows.back().push_back(found == exponents.end() ? "" : fmt::format("{:.2f}", found->second));
    }
  }
  return table;
}

std::string noise_text(std::span<const ScalingRow> rows) {
  std::vector<double> spreads;
  for (const ScalingRow& row : rows) {
    if (row.runs > 1) spreads.push_back(100.0 * row.spread);
  }
  if (spreads.empty()) return "not known: nothing was repeated";
  std::sort(spreads.begin(), spreads.end());
  return fmt::format("repeats of one maze differ by {:.1f} % in the median, by {:.1f} % at most",
                     spreads[spreads.size() / 2], spreads.back());
}

std::string scaling_summary(const ScalingResult& result, const Palette& palette) {
  const std::vector<ScalingRow> rows = scaling_rows(result);
  std::string text = palette.strong(fmt::format("{:>15}  {:<30} {:>7}  {:>9}  {:>9}  {:>7}  {:>8}  {:>8}  {:>9}  {:>8}",
                                                "size", "planner", "threads", "minimum", "median", "spread", "ns/cell",
                                                "speed-up", "memory", "B/cell"));
  text += '\n';
  for (const ScalingRow& row : rows) text += table_line(row);
  text += unsolved_text(result);
  const auto line = [&](std::string_view name, const std::string& what) {
    text += fmt::format("{}{}\n", palette.faint(fmt::format("{:<11}", name)), what);
  };
  if (const TextTable exponents = exponent_table(rows); !exponents.rows.empty()) {
    line("exponents", "of least times against cells");
    text += exponents.text(palette);
  }
  for (const ThreadGain& gain : thread_gains(result, this_machine().cores)) line("threads", text_of(gain));
  line("noise", noise_text(rows));
  line("machine", text_of(this_machine()));
  if (result.signal) text += palette.doubtful("interrupted") + ": these are the runs so far\n";
  return text;
}

std::string scaling_json(const ScalingOptions& options, const ScalingResult& result) {
  const std::vector<ScalingRow> rows = scaling_rows(result);
  Json json{{"schema", "warren.scale/1"}, {"warren_version", WARREN_VERSION}, {"repeats", options.repeats}};
  json["algorithm"] = name_of(options.maze.algorithm);
  json["loops"] = options.maze.loops;
  json["machine"] = machine_json(this_machine());
  const bool counted = result.no_hardware_counts.empty();
  json["hardware_counts"] = counted ? Json(RunCounts::hardware_names) : Json(nullptr);
  if (!counted) json["no_hardware_counts"] = result.no_hardware_counts;
  if (result.signal) json["stopped_by"] = name_of(*result.signal);
  json["runs"] = Json::array();
  for (const ScalingRun& run : result.runs) {
    Json entry = trial_json(run.trial);
    entry["repeat"] = run.repeat;
    entry["arithmetic_per_s"] = run.arithmetic_per_s;
    entry.update(counts_json(run.counts));
    json["runs"].push_back(std::move(entry));
  }
  json["rows"] = Json::array();
  for (const ScalingRow& row : rows) {
    const MazeTrial& t = row.fastest;
    json["rows"].push_back({{"rows", t.rows},
                            {"cols", t.cols},
                            {"threads", t.threads},
                            {"planner", t.planner},
                            {"sampler", t.sampler},
                            {"runs", row.runs},
                            {"min_s", t.solve_s},
                            {"median_s", row.median_s},
                            {"spread", row.spread},
                            {"ns_per_cell", t.solve_s * 1e9 / t.cells()},
                            {"speed_up", row.speed_up},
                            {"efficiency", row.speed_up / t.threads},
                            {"bytes_per_cell", static_cast<double>(row.peak_memory_bytes) / t.cells()}});
  }
  json["thread_gains"] = Json::array();
  for (const ThreadGain& gain : thread_gains(result, this_machine().cores))
    json["thread_gains"].push_back(gain_json(gain));
  json["exponents"] = exponents_json(rows);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string scaling_csv(const ScalingResult& result) {
  const std::vector<std::string> stages = stage_names();
  std::string text = "rows,cols,cells,planner,sampler,pipeline,threads,seed,repeat,status,verified,solve_s";
  for (const std::string& stage : stages) text += "," + stage + "_s";
  text += ",generate_s,length,peak_memory_bytes,cpu_s,page_faults,involuntary_switches";
  for (const std::string_view name : RunCounts::hardware_names) text += fmt::format(",{}", name);
  for (const std::string& link : link_names()) text += "," + link + "_s";
  text += '\n';
  for (const ScalingRun& run : result.runs) {
    const MazeTrial& t = run.trial;
    text += fmt::format("{},{},{:.0f},{},{},{},{},{},{},{},{},{}", t.rows, t.cols, t.cells(), t.planner, t.sampler,
                        t.pipeline, t.threads, t.seed, run.repeat, name_of(t.outcome), t.verified, t.solve_s);
    for (const std::string& stage : stages) text += fmt::format(",{}", seconds_of(t, stage));
    text += fmt::format(",{},{},{},{},{},{}", t.generate_s, t.verified ? fmt::format("{}", t.length) : "",
                        t.peak_memory_bytes, run.counts.cpu_s, run.counts.page_faults, run.counts.involuntary_switches);
    for (const std::string_view name : RunCounts::hardware_names) {
      const auto count = run.counts.hardware_count(name);
      text += count ? fmt::format(",{:.0f}", *count) : ",";
    }
    for (const std::string& link : link_names()) text += fmt::format(",{}", seconds_of(t, link));
    text += '\n';
  }
  return text;
}

}  // namespace warren::studies
