// SPDX-License-Identifier: BSD-3-Clause
// A comparison as CSV (RFC 4180): a line a contender, or a line a run; empty where nothing is known.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/text/csv_text.hpp"
#include "studies/compare/comparison_report.hpp"

namespace warren::studies {
namespace {

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

/// All options that some contender has, in the order in which they are met.
std::vector<std::string> option_names(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Contender& c : comparison.contenders) {
    for (const auto& [name, value] : c.options) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// As text: a word without its quotation marks.
std::string option_value(const Contender& c, const std::string& name) {
  for (const auto& [option, value] : c.options) {
    const bool is_word = value.size() >= 2 && value.front() == '"';
    if (option == name) return is_word ? value.substr(1, value.size() - 2) : value;
  }
  return {};
}

/// Stages that some run had, in the order in which they are met.
std::vector<std::string> cost_names(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Contender& c : comparison.contenders) {
    for (const ComparedRun& run : c.runs) {
      for (const StageCost& cost : run.costs) {
        if (std::find(names.begin(), names.end(), cost.name) == names.end()) names.emplace_back(cost.name);
      }
    }
  }
  return names;
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

/// What a run says for itself; what a planner counts is left empty for searches.
std::vector<std::string> run_fields(const ComparedRun& run, bool is_planner) {
  const auto known = [](bool is_known, auto value) { return is_known ? fmt::format("{}", value) : std::string{}; };
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

}  // namespace

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "source,vertices,edges,planner,search,queue,library,options,runs,solved,success_low,success_high,length_median,"
      "length_q1,length_q3,hops,expanded,min_clearance,time_median_s,time_q1_s,time_q3_s,time_mean_s,"
      "time_mean_low_s,time_mean_high_s,cells,turn_rad,deterministic\n";
  for (const Contender& c : comparison.contenders) text += csv_row(comparison, c);
  return text;
}

std::string comparison_runs(const Comparison& comparison) {
  const std::vector<std::string> options = option_names(comparison);
  std::vector<std::string> head{"source", "planner", "search", "queue", "library"};
  for (const std::string& name : options) head.push_back("option_" + name);
  for (const char* name :
       {"seed",          "status", "time_s",   "search_s",      "length",   "raw_length", "cost",
        "hops",          "cells",  "turn_rad", "min_clearance", "expanded", "samples",    "neighbour_queries",
        "edges_checked", "rounds", "refused",  "milestones",    "edges",    "components"}) {
    head.emplace_back(name);
  }
  const std::vector<std::string> costs = cost_names(comparison);
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

}  // namespace warren::studies
