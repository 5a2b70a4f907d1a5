// SPDX-License-Identifier: BSD-3-Clause
// A comparison as warren.compare/1: a row a contender, null where nothing is known.
#include <cmath>
#include <nlohmann/json.hpp>

#include "solve/answer/write_answer_io.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/compare/queue_crossings.hpp"
#include "studies/measure/machine_memory.hpp"

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

/// Of options that were dealt out, the names: "options" has their values.
Json names_of(const std::vector<std::pair<std::string, std::string>>& dealt) {
  Json names = Json::array();
  for (const auto& [name, word] : dealt) names.push_back(name);
  return names;
}

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
  if (!c.dealt.empty()) json["dealt"] = names_of(c.dealt);
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

}  // namespace warren::studies
