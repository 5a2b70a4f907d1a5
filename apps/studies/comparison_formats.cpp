// SPDX-License-Identifier: BSD-3-Clause
// A comparison in files: as warren.compare/1 (a row a contender, null where nothing is known), as CSV, and as the log
// that OMPL's benchmarks write.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "apps/studies/comparison_report.hpp"
#include "apps/studies/machine.hpp"
#include "core/base/printable.hpp"
#include "solve/answer/write_answer_io.hpp"

namespace warren::studies {
namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// A median of counts: whole where it is.
Json count_json(const std::optional<Distribution>& d) {
  if (!d) return nullptr;
  return d->median == std::floor(d->median) ? Json(static_cast<std::uint64_t>(d->median)) : Json(d->median);
}

Json interval_json(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return Json{finite(interval->low), finite(interval->high)};
}

/// Median and quartiles, each null where nothing is known.
Json quartiles_json(const std::optional<Distribution>& d) {
  if (!d) return {{"median", nullptr}, {"q1", nullptr}, {"q3", nullptr}};
  return {{"median", finite(d->median)},
          {"q1", finite(d->q1)},
          {"q3", finite(d->q3)},
          {"min", finite(d->least)},
          {"max", finite(d->most)}};
}

Json seconds_json(const std::optional<Distribution>& d) {
  Json json = quartiles_json(d);
  json["mean"] = d ? finite(d->mean) : Json(nullptr);
  json["ci95"] = d ? interval_json(d->mean_ci95) : Json(nullptr);
  json["median_ci95"] = d ? interval_json(d->median_ci95) : Json(nullptr);
  return json;
}

Json problem_json(const ComparedProblem& problem) {
  Json json{{"source", problem.source}};
  if (problem.kind.empty()) return json;
  json["graph"] = problem.kind;
  json["vertices"] = problem.vertices;
  json["edges"] = problem.edges;
  return json;
}

Json word_or_null(const std::string& word) { return word.empty() ? Json(nullptr) : Json(word); }

Json row_json(const Comparison& comparison, const Contender& c) {
  const ComparisonRow row = row_of(c);
  Json options = Json::object();
  for (const auto& [name, value] : c.options) options[name] = Json::parse(value);
  Json json{{"planner", c.planner},
            {"search", word_or_null(c.search)},
            {"queue", word_or_null(c.queue)},
            {"library", c.library},
            {"options", std::move(options)},
            {"problem", problem_json(comparison.problems[c.problem])},
            {"runs", row.runs},
            {"solved", row.solved},
            {"success_ci95", interval_json(row.success)},
            {"length", quartiles_json(row.length)},
            {"hops", count_json(row.hops)},
            {"expanded", count_json(row.expanded)},
            {"time_s", seconds_json(row.time_s)}};
  if (comparison.problems[c.problem].kind.empty()) json["deterministic"] = c.deterministic;
  for (const auto& [name, word] : c.dealt) json["dealt"].push_back(name);  // "options" has their values
  if (row.priced_cost) json["cost"] = quartiles_json(row.priced_cost);
  if (row.cells) json["cells"] = quartiles_json(row.cells);
  if (row.turn_rad) json["turn_rad"] = quartiles_json(row.turn_rad);
  if (row.min_clearance) json["min_clearance"] = quartiles_json(row.min_clearance);
  if (row.search_s) json["search_s"] = seconds_json(row.search_s);
  return json;
}

Json size_or_null(const std::optional<double>& size) { return size ? finite(*size) : Json(nullptr); }

Json crossings_json(const Comparison& comparison) {
  Json json = Json::array();
  for (const QueueCrossing& c : queue_crossings(sweep_curves(comparison))) {
    Json ratios = Json::array();
    for (const Vec2 r : c.ratios) ratios.push_back({finite(r.x), finite(r.y)});
    json.push_back({{"search", c.search},
                    {"array", c.array},
                    {"heap", c.heap},
                    {"not_slower_at", size_or_null(c.not_slower_at)},
                    {"slower_from", size_or_null(c.slower_from)},
                    {"crossing", size_or_null(c.crossing)},
                    {"fitted", size_or_null(c.fitted)},
                    {"ratios", std::move(ratios)}});
  }
  return json;
}

// A comparison as CSV (RFC 4180): a line a contender, or a line a run; empty where nothing is known.

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += csv_field(field) + ',';
  line.back() = '\n';
  return line;
}

std::string csv_row(const Comparison& comparison, const Contender& c) {
  const ComparedProblem& problem = comparison.problems[c.problem];
  const ComparisonRow row = row_of(c);
  const auto of = [](const std::optional<Distribution>& d, double Distribution::*figure) {
    return d ? fmt::format("{}", (*d).*figure) : std::string{};
  };
  std::string low;
  std::string high;
  if (row.time_s && row.time_s->mean_ci95) {
    low = fmt::format("{}", row.time_s->mean_ci95->low);
    high = fmt::format("{}", row.time_s->mean_ci95->high);
  }
  const auto graph_size = [&](std::uint64_t n) { return problem.kind.empty() ? "" : std::to_string(n); };
  return csv_line({problem.source,
                   graph_size(problem.vertices),
                   graph_size(problem.edges),
                   c.planner,
                   c.search,
                   c.queue,
                   c.library,
                   options_text(c),
                   std::to_string(row.runs),
                   std::to_string(row.solved),
                   fmt::format("{}", row.success.low),
                   fmt::format("{}", row.success.high),
                   of(row.length, &Distribution::median),
                   of(row.length, &Distribution::q1),
                   of(row.length, &Distribution::q3),
                   of(row.hops, &Distribution::median),
                   of(row.expanded, &Distribution::median),
                   of(row.min_clearance, &Distribution::median),
                   of(row.time_s, &Distribution::median),
                   of(row.time_s, &Distribution::q1),
                   of(row.time_s, &Distribution::q3),
                   of(row.time_s, &Distribution::mean),
                   low,
                   high,
                   of(row.cells, &Distribution::median),
                   of(row.turn_rad, &Distribution::median),
                   problem.kind.empty() ? fmt::format("{}", c.deterministic) : ""});
}

/// As text: a word without its quotation marks.
std::string option_value(const Contender& c, const std::string& name) {
  for (const auto& [option, value] : c.options) {
    const bool is_word = value.size() >= 2 && value.front() == '"';
    if (option == name) return is_word ? value.substr(1, value.size() - 2) : value;
  }
  return {};
}

/// Wall-clock and CPU time of each; empty where the run had no such stage.
void add_costs(std::vector<std::string>& fields, const ComparedRun& run, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto found = std::find_if(run.costs.begin(), run.costs.end(), [&](const auto& c) { return c.name == name; });
    const bool is_there = found != run.costs.end();
    fields.push_back(is_there ? fmt::format("{}", found->wall_s) : "");
    fields.push_back(is_there ? fmt::format("{}", found->cpu_s) : "");
  }
}

std::string known(bool is_known, auto value) { return is_known ? fmt::format("{}", value) : std::string{}; }

/// What a run says for itself; what a planner counts is left empty for searches.
std::vector<std::string> run_fields(const ComparedRun& run, bool is_planner) {
  const auto figure = [&](const auto& value) { return known(value.has_value(), value.value_or(0)); };
  std::vector<std::string> fields{
      std::to_string(run.seed), std::string(name_of(run.outcome)), fmt::format("{}", run.time_s),
      figure(run.search_s),     known(run.solved(), run.length),   figure(run.raw_length),
      figure(run.cost),         known(run.solved(), run.hops),     figure(run.cells),
      figure(run.turn_rad),     figure(run.min_clearance),         std::to_string(run.expanded)};
  for (const std::uint64_t count :
       {run.counters.samples, run.counters.neighbour_queries, run.counters.edges_checked, run.counters.rounds,
        run.counters.refused, run.roadmap.milestones, run.roadmap.edges, run.roadmap.components}) {
    fields.push_back(known(is_planner, count));
  }
  return fields;
}

// The log that OMPL's benchmarks write, line by line as ompl_benchmark_statistics.py reads it: run lines are split at
// "; ", so each value is followed by one, and an empty value is NULL. One status more than OMPL knows stands last.

constexpr std::string_view statuses =
    "status|Unknown status|Invalid start|Invalid goal|Unrecognized goal type|Timeout|Approximate solution|"
    "Exact solution|Crash|Abort|Infeasible|Not connected";

std::string planner_name(const Contender& contender) {
  std::string name = contender.library + "_" + contender_name(contender, true);
  for (const auto& [option, value] : contender.options) name += "_" + option + "_" + value;
  std::string word;
  for (const char c : name) {
    const bool kept =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
    if (kept || !word.ends_with('_')) word += kept ? c : '_';
  }
  return word;
}

constexpr std::string_view properties =
    "10 properties for each run\n"
    "status ENUM\ntime REAL\nsolved BOOLEAN\ncorrect solution BOOLEAN\nsolution length REAL\nsolution clearance REAL\n"
    "solution segments INTEGER\nstates expanded INTEGER\nsearch time REAL\nseed INTEGER\n";

std::string run_line(const ComparedRun& run) {
  constexpr std::array<int, 6> by_outcome{6, 1, 2, 10, 9, 4};
  const int solved = run.solved() ? 1 : 0;
  return fmt::format("{}; {}; {}; {}; {}; {}; {}; {}; {}; {}; \n", by_outcome[static_cast<std::size_t>(run.outcome)],
                     run.time_s, solved, solved, known(run.solved(), run.length),
                     known(run.solved() && run.min_clearance, run.min_clearance.value_or(0.0)),
                     known(run.solved(), run.hops), run.expanded,
                     known(run.search_s.has_value(), run.search_s.value_or(0.0)), run.seed);
}

std::string planner_block(const Contender& contender) {
  std::string text = planner_name(contender) + "\n";
  text += fmt::format("{} common properties\n", contender.options.size());
  for (const auto& [name, value] : contender.options) text += fmt::format("{} = {}\n", name, printable(value));
  text += properties;
  text += fmt::format("{} runs\n", contender.runs.size());
  for (const ComparedRun& run : contender.runs) text += run_line(run);
  return text + ".\n";
}

}  // namespace

std::string comparison_json(const Comparison& comparison) {
  Json json{{"schema", "warren.compare/1"}, {"warren_version", WARREN_VERSION}};
  json["machine"] = machine_json(this_machine());
  if (comparison.clock_s > 0.0) json["clock_s"] = comparison.clock_s;
  if (comparison.stopped) json["stopped_by"] = name_of(*comparison.stopped);
  json["rows"] = Json::array();
  for (const Contender& c : comparison.contenders) json["rows"].push_back(row_json(comparison, c));
  if (Json crossings = crossings_json(comparison); !crossings.empty()) json["crossings"] = std::move(crossings);
  json["notes"] = comparison.notes;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "source,vertices,edges,planner,search,queue,library,options,runs,solved,success_low,success_high,length_median,"
      "length_q1,length_q3,hops,expanded,min_clearance,time_median_s,time_q1_s,time_q3_s,time_mean_s,"
      "time_mean_low_s,time_mean_high_s,cells,turn_rad,deterministic\n";
  for (const Contender& c : comparison.contenders) text += csv_row(comparison, c);
  return text;
}

std::string comparison_runs(const Comparison& comparison) {
  std::vector<std::string> options;  // those that some contender has, in the order in which they are met
  std::vector<std::string> costs;    // and stages that some run had
  for (const Contender& c : comparison.contenders) {
    for (const auto& [name, value] : c.options) add_once(options, name);
    for (const ComparedRun& run : c.runs) {
      for (const StageCost& cost : run.costs) add_once(costs, std::string(cost.name));
    }
  }
  std::vector<std::string> head{"source", "planner", "search", "queue", "library"};
  for (const std::string& name : options) head.push_back("option_" + name);
  for (const char* name :
       {"seed",          "status", "time_s",   "search_s",      "length",   "raw_length", "cost",
        "hops",          "cells",  "turn_rad", "min_clearance", "expanded", "samples",    "neighbour_queries",
        "edges_checked", "rounds", "refused",  "milestones",    "edges",    "components"}) {
    head.emplace_back(name);
  }
  for (std::string name : costs) {
    std::replace(name.begin(), name.end(), ' ', '_');
    head.push_back("stage_" + name + "_s");
    head.push_back("stage_" + name + "_cpu_s");
  }
  std::string text = csv_line(head);
  for (const Contender& c : comparison.contenders) {
    const ComparedProblem& problem = comparison.problems[c.problem];
    std::vector<std::string> contender{problem.source, c.planner, c.search, c.queue, c.library};
    for (const std::string& name : options) contender.push_back(option_value(c, name));
    for (const ComparedRun& run : c.runs) {
      std::vector<std::string> fields = contender;
      const std::vector<std::string> figures = run_fields(run, problem.kind.empty());
      fields.insert(fields.end(), figures.begin(), figures.end());
      add_costs(fields, run, costs);
      text += csv_line(fields);
    }
  }
  return text;
}

std::string comparison_curves(const Comparison& comparison) {
  std::string text = "planner,seed,seconds,cost,length,by,lower_bound,options\n";
  for (const Contender& c : comparison.contenders) {
    const std::string options = options_text(c);
    for (const ComparedRun& run : c.runs) {
      const std::string seed = std::to_string(run.seed);
      const std::string bound = run.lower_bound ? fmt::format("{}", *run.lower_bound) : "";
      for (const Improvement& one : run.improvements) {
        text += csv_line({c.planner, seed, fmt::format("{}", one.seconds), fmt::format("{}", one.cost),
                          fmt::format("{}", one.length), one.by, bound, options});
      }
      if (run.improvements.empty()) {
        text += csv_line({c.planner, seed, fmt::format("{}", run.time_s), "", "", "", bound, options});
      }
    }
  }
  return text;
}

std::string ompl_log(const Comparison& comparison, const OmplExperiment& experiment) {
  std::size_t most_runs = 0;
  for (const Contender& c : comparison.contenders) most_runs = std::max(most_runs, c.runs.size());
  std::string text =
      fmt::format("warren version {}\nExperiment {}\nRunning on {}\nStarting at {}\n<<<|\n{}\n|>>>\n<<<|\n{}\n|>>>\n",
                  WARREN_VERSION, printable(experiment.name), experiment.hostname, experiment.date,
                  printable(experiment.setup), text_of(this_machine()));
  fmt::format_to(std::back_inserter(text),
                 "{} is the random seed\n{} seconds per run\n{} MB per run\n{} runs per planner\n"
                 "{} seconds spent to collect the data\n1 enum type\n{}\n{} planners\n",
                 experiment.seed, experiment.budget_s, experiment.memory_mb, most_runs, experiment.total_s, statuses,
                 comparison.contenders.size());
  for (const Contender& c : comparison.contenders) text += planner_block(c);
  return text;
}

}  // namespace warren::studies
