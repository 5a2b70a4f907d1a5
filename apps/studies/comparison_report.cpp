// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "apps/studies/machine.hpp"
#include "core/base/printable.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::studies {
namespace {

template <class Text>
std::string if_known(const std::optional<Distribution>& d, const Text& text) {
  return d ? text(*d) : "-";
}

std::string median_number(const std::optional<Distribution>& d) {
  return if_known(d, [](const Distribution& k) { return human_number(k.median); });
}

std::string seconds_text(const std::optional<Distribution>& d, double Distribution::*figure) {
  return d ? precise_seconds((*d).*figure) : "-";
}

std::string median_interval(const Distribution& d) {
  if (!d.median_ci95) return "-";
  return precise_seconds(d.median_ci95->low) + " to " + precise_seconds(d.median_ci95->high);
}

/// A column's name, with the unit of its lengths where that is no cell.
std::string of_lengths(const Comparison& comparison, std::size_t problem, std::string_view name) {
  return std::string(name).append(metres_behind(comparison.problems[problem].unit).empty() ? "" : " (m)");
}

/// Searches of one graph: the figures of a path are the same in every run.
TextTable search_table(const Comparison& comparison, std::size_t problem) {
  const ComparedProblem& p = comparison.problems[problem];
  TextTable table{
      {"search", "queue", "library", of_lengths(comparison, problem, "length"), "hops", "settled", "trials", "median",
       "95 % for the median", "mean"},
      3,
      fmt::format("{}: graph of {}, {} vertices, {} edges", printable(p.source), p.kind, p.vertices, p.edges)};
  const bool with_library =
      std::ranges::any_of(comparison.contenders, [](const Contender& c) { return c.library != "warren"; });
  for (const Contender& c : comparison.contenders) {
    if (c.problem != problem) continue;
    const ComparisonRow row = row_of(c);
    const auto seconds = [&](double Distribution::*figure) { return seconds_text(row.time_s, figure); };
    const auto length = [](const Distribution& d) { return fmt::format("{:.10g}", d.median); };
    table.rows.push_back({c.search, c.queue.empty() ? "-" : c.queue, with_library ? c.library : "",
                          if_known(row.length, length), median_number(row.hops), median_number(row.expanded),
                          std::to_string(row.runs), seconds(&Distribution::median),
                          if_known(row.time_s, median_interval), seconds(&Distribution::mean)});
  }
  return table;
}

TextTable planner_table(const Comparison& comparison, std::size_t problem) {
  constexpr double degree = std::numbers::pi / 180.0;
  const auto of = [&](std::string_view name) { return of_lengths(comparison, problem, name); };
  TextTable table{{"planner", "solved", "95 %", of("length q1"), "median", "q3", of("cost"), "hops", "cells",
                   "turning (deg)", "expanded", of("clearance"), "time q1", "median", "q3"},
                  1};
  for (const Contender& c : comparison.contenders) {
    if (c.problem != problem) continue;
    const ComparisonRow row = row_of(c);
    const auto number = [&](double Distribution::*figure) {
      return if_known(row.length, [&](const Distribution& d) { return human_number(d.*figure); });
    };
    const auto seconds = [&](double Distribution::*figure) { return seconds_text(row.time_s, figure); };
    const std::string options = options_text(c);
    const std::string success = fmt::format("{:.0f} to {:.0f} %", 100.0 * row.success.low, 100.0 * row.success.high);
    table.rows.push_back({contender_name(c, true) + (options.empty() ? "" : ", " + printable(options)),
                          fmt::format("{} of {}", row.solved, row.runs), c.deterministic ? "deterministic" : success,
                          number(&Distribution::q1), number(&Distribution::median), number(&Distribution::q3),
                          row.priced_cost ? median_number(row.priced_cost) : "", median_number(row.hops),
                          row.cells ? median_number(row.cells) : "",
                          row.turn_rad ? human_number(row.turn_rad->median / degree) : "", median_number(row.expanded),
                          median_number(row.min_clearance), seconds(&Distribution::q1), seconds(&Distribution::median),
                          seconds(&Distribution::q3)});
  }
  return table;
}

// Random graphs of many sizes as text: a table a search, sizes down, queues across, and the crossings.

std::string time_at(const SweepCurve& curve, double size) {
  const auto found = std::find_if(curve.points.begin(), curve.points.end(), [&](const Vec2 p) { return p.x == size; });
  return found == curve.points.end() ? "-" : precise_seconds(found->y);
}

std::string curve_name(const SweepCurve& curve) {
  if (curve.library != "warren") return curve.library;
  return curve.queue.empty() ? "median" : curve.queue;
}

TextTable table_of(const std::vector<SweepCurve>& curves, const std::string& search) {
  TextTable table{{search + " on"}};
  std::set<double> sizes;
  for (const SweepCurve& curve : curves) {
    if (curve.search != search) continue;
    table.head.push_back(curve_name(curve));
    for (const Vec2 p : curve.points) sizes.insert(p.x);
  }
  for (const double size : sizes) {
    std::vector<std::string> row{fmt::format("{:.0f} vertices", size)};
    for (const SweepCurve& curve : curves) {
      if (curve.search == search) row.push_back(time_at(curve, size));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// "1.31 times", "394 times"
std::string times_text(double ratio) {
  constexpr double plain = 9.995;
  return fmt::format("{:.{}f} times", ratio, ratio < plain ? 2 : 0);
}

/// "slower from 300 on, no slower at 100; they cross near 181 (by all sizes: 240)"
std::string crossing_text(const QueueCrossing& c) {
  if (c.ratios.size() < 2) return "too few sizes to tell";
  const Vec2 last = c.ratios.back();
  const std::string at_last = fmt::format("{} at {:.0f}", times_text(last.y), last.x);
  if (!c.slower_from) return fmt::format("no slower up to {:.0f} vertices ({})", last.x, at_last);
  if (!c.not_slower_at) {
    return fmt::format("slower from the smallest on ({} at {:.0f}, {})", times_text(c.ratios.front().y),
                       c.ratios.front().x, at_last);
  }
  std::string text =
      fmt::format("no slower at {:.0f}, slower from {:.0f} on ({})", *c.not_slower_at, *c.slower_from, at_last);
  if (c.crossing) text += fmt::format(": they cross near {}", grouped(std::llround(*c.crossing)));
  const bool within = c.fitted && *c.fitted > 0.1 * c.ratios.front().x && *c.fitted < 10.0 * last.x;
  if (within) text += fmt::format(", by a line through all sizes near {}", grouped(std::llround(*c.fitted)));
  return text;
}

/// The tables of the summary.
std::vector<TextTable> comparison_tables(const Comparison& comparison) {
  std::vector<TextTable> tables;
  for (std::size_t problem = 0; problem < comparison.problems.size(); ++problem) {
    const ComparedProblem& p = comparison.problems[problem];
    if (p.kind.empty()) {
      tables.push_back(planner_table(comparison, problem));
    } else if (p.kind != "geometric") {  // the sweep's have tables of their own
      tables.push_back(search_table(comparison, problem));
    }
  }
  for (TextTable& table : sweep_tables(comparison)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace

std::string comparison_document(const Comparison& comparison, std::string_view ending) {
  const bool is_latex = ending == ".tex";
  std::string text;
  for (const TextTable& table : comparison_tables(comparison)) {
    text += text.empty() ? "" : "\n";
    if (!table.title.empty()) text += fmt::format("{}{}\n{}", is_latex ? "% " : "", table.title, is_latex ? "" : "\n");
    text += is_latex ? table.latex() : table.markdown();
  }
  return text;
}

std::string comparison_summary(const Comparison& comparison, const Palette& palette) {
  std::string text;
  for (const TextTable& table : comparison_tables(comparison)) {
    if (!text.empty()) text += '\n';
    if (!table.title.empty()) text += table.title + '\n';
    text += table.text(palette);
  }
  const auto line = [&](std::string_view name, const std::string& what) {
    text += fmt::format("{}{}\n", palette.faint(fmt::format("{:<11}", name)), what);
  };
  for (const std::string& note : comparison.notes) line("note", printable(note));
  if (comparison.clock_s > 0.0) line("clock", precise_seconds(comparison.clock_s) + " a reading, taken off each time");
  line("machine", text_of(this_machine()));
  if (comparison.stopped) text += palette.doubtful(text_of(*comparison.stopped)) + ": these are the runs so far\n";
  return text;
}

std::vector<TextTable> sweep_tables(const Comparison& comparison) {
  const std::vector<SweepCurve> curves = sweep_curves(comparison);
  std::vector<TextTable> tables;
  std::vector<std::string> searches;
  for (const SweepCurve& curve : curves) add_once(searches, curve.search);
  for (const std::string& search : searches) tables.push_back(table_of(curves, search));
  TextTable crossings{{"search", "array", "against", "from which size on the array is slower"}, 4};
  for (const QueueCrossing& c : queue_crossings(curves)) {
    crossings.rows.push_back({c.search, c.array, c.heap, crossing_text(c)});
  }
  if (!crossings.rows.empty()) tables.push_back(std::move(crossings));
  return tables;
}

std::string comparison_page(const Comparison& comparison, const std::string& command_line) {
  ReportPage page{.title = "Planners and searches side by side",
                  .command_line = command_line,
                  .tables = comparison_tables(comparison),
                  .remarks = comparison.notes};
  for (const PlotSheet& sheet : comparison_panels(comparison)) page.plots.push_back(sheet.svg());
  page.notes.push_back(fmt::format("Machine: {}.{}", text_of(this_machine()),
                                   comparison.stopped ? " Interrupted: these are the runs so far." : ""));
  return page.html();
}

}  // namespace warren::studies
