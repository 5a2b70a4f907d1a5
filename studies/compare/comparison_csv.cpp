// SPDX-License-Identifier: BSD-3-Clause
// A comparison as CSV (RFC 4180): a line a contender, empty where nothing is known.
#include <fmt/format.h>

#include "scenes/text/csv_text.hpp"
#include "studies/compare/comparison_report.hpp"

namespace warren {
namespace {

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ",") + csv_field(field);
  return line + '\n';
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
                   of(row.turn_rad, &Distribution::median)});
}

}  // namespace

std::string comparison_csv(const Comparison& comparison) {
  std::string text =
      "source,vertices,edges,planner,search,queue,library,options,runs,solved,success_low,success_high,length_median,"
      "length_q1,length_q3,hops,expanded,min_clearance,time_median_s,time_q1_s,time_q3_s,time_mean_s,"
      "time_mean_low_s,time_mean_high_s,cells,turn_rad\n";
  for (const Contender& c : comparison.contenders) text += csv_row(comparison, c);
  return text;
}

}  // namespace warren
