// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "apps/studies/machine.hpp"
#include "core/base/printable.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/write_answer_io.hpp"

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

TextTable table_of(const std::vector<SweepCurve>& curves, const std::string& search) {
  TextTable table{{search + " on"}};
  std::set<double> sizes;
  for (const SweepCurve& curve : curves) {
    if (curve.search != search) continue;
    table.head.push_back(curve.name("median"));
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
  const std::vector<SweepCurve> curves = sweep_curves(comparison);
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

// As warren.compare/1: a row a contender, null where nothing is known.

using Json = nlohmann::ordered_json;

Json finite(std::optional<double> value) { return value && std::isfinite(*value) ? Json(*value) : Json(nullptr); }

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

Json crossings_json(const Comparison& comparison) {
  Json json = Json::array();
  for (const QueueCrossing& c : queue_crossings(sweep_curves(comparison))) {
    Json ratios = Json::array();
    for (const Vec2 r : c.ratios) ratios.push_back({finite(r.x), finite(r.y)});
    json.push_back({{"search", c.search},
                    {"array", c.array},
                    {"heap", c.heap},
                    {"not_slower_at", finite(c.not_slower_at)},
                    {"slower_from", finite(c.slower_from)},
                    {"crossing", finite(c.crossing)},
                    {"fitted", finite(c.fitted)},
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

std::string known(bool is_known, auto value) { return is_known ? fmt::format("{}", value) : std::string{}; }
template <class Value>
std::string known(const std::optional<Value>& value) {
  return value ? fmt::format("{}", *value) : std::string{};
}

std::string csv_row(const Comparison& comparison, const Contender& c) {
  using D = Distribution;
  const ComparedProblem& problem = comparison.problems[c.problem];
  const ComparisonRow row = row_of(c);
  const bool is_graph = !problem.kind.empty();
  std::vector<std::string> fields;
  const auto add = [&](const auto&... values) { (fields.push_back(fmt::format("{}", values)), ...); };
  const auto add_of = [&](const auto& known, auto... figures) {
    (fields.push_back(known ? fmt::format("{}", (*known).*figures) : std::string{}), ...);
  };
  add(problem.source, known(is_graph, problem.vertices), known(is_graph, problem.edges), c.planner, c.search, c.queue,
      c.library, options_text(c), row.runs, row.solved, row.success.low, row.success.high);
  add_of(row.length, &D::median, &D::q1, &D::q3);
  add_of(row.hops, &D::median);
  add_of(row.expanded, &D::median);
  add_of(row.min_clearance, &D::median);
  add_of(row.time_s, &D::median, &D::q1, &D::q3, &D::mean);
  add_of(row.time_s ? row.time_s->mean_ci95 : std::nullopt, &Interval::low, &Interval::high);
  add_of(row.cells, &D::median);
  add_of(row.turn_rad, &D::median);
  add(known(!is_graph, c.deterministic));
  return csv_line(fields);
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

/// What a run says for itself; what a planner counts is left empty for searches.
std::vector<std::string> run_fields(const ComparedRun& run, bool is_planner) {
  std::vector<std::string> fields{
      std::to_string(run.seed), std::string(name_of(run.outcome)), fmt::format("{}", run.time_s),
      known(run.search_s),      known(run.solved(), run.length),   known(run.raw_length),
      known(run.cost),          known(run.solved(), run.hops),     known(run.cells),
      known(run.turn_rad),      known(run.min_clearance),          std::to_string(run.expanded)};
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
                     known(run.solved(), run.hops), run.expanded, known(run.search_s), run.seed);
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
  for (const std::string& note : comparison.notes) text += named_line(palette, "note", printable(note));
  if (comparison.clock_s > 0.0)
    text += named_line(palette, "clock", precise_seconds(comparison.clock_s) + " a reading, taken off each time");
  text += named_line(palette, "machine", machine_text());
  if (comparison.stopped) text += palette.doubtful(text_of(*comparison.stopped)) + ": these are the runs so far\n";
  return text;
}

std::string comparison_page(const Comparison& comparison, const std::string& command_line) {
  ReportPage page{.title = "Planners and searches side by side",
                  .command_line = command_line,
                  .tables = comparison_tables(comparison),
                  .remarks = comparison.notes};
  for (const PlotSheet& sheet : comparison_panels(comparison)) page.plots.push_back(sheet.svg());
  page.notes.push_back(fmt::format("Machine: {}.{}", machine_text(),
                                   comparison.stopped ? " Interrupted: these are the runs so far." : ""));
  return page.html();
}

std::string comparison_json(const Comparison& comparison) {
  Json json{{"schema", "warren.compare/1"}, {"warren_version", WARREN_VERSION}};
  json["machine"] = machine_json();
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
      const std::string bound = known(run.lower_bound);
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
                  printable(experiment.setup), machine_text());
  fmt::format_to(std::back_inserter(text),
                 "{} is the random seed\n{} seconds per run\n{} MB per run\n{} runs per planner\n"
                 "{} seconds spent to collect the data\n1 enum type\n{}\n{} planners\n",
                 experiment.seed, experiment.budget_s, experiment.memory_mb, most_runs, experiment.total_s, statuses,
                 comparison.contenders.size());
  for (const Contender& c : comparison.contenders) text += planner_block(c);
  return text;
}

}  // namespace warren::studies
