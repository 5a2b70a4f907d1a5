// SPDX-License-Identifier: BSD-3-Clause
#include "studies/sizes/largest_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pictures/plots/plot.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/answer/answer.hpp"

namespace warren::studies {
namespace {

using Json = nlohmann::ordered_json;

void line(std::string& text, const Palette& palette, std::string_view name, const std::string& what) {
  text += fmt::format("  {}{}\n", palette.faint(fmt::format("{:<14}", name)), what);
}

bool by_seconds(const MazeTrial& a, const MazeTrial& b) { return a.solve_s < b.solve_s; }

std::string headline(const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  if (result.best.empty()) {
    return result.signal
               ? palette.doubtful("interrupted") + " before a maze was solved within the budget\n"
               : palette.bad("none") + fmt::format(": no maze was solved within {}\n", human_seconds(options.budget_s));
  }
  const MazeTrial& best = result.best.front();
  const std::string size = palette.strong(fmt::format("{} x {}", best.rows, best.cols));
  if (!result.confirmed)
    return fmt::format("{} is the largest maze so far: {}\n", size, palette.doubtful("interrupted"));
  return fmt::format("{} is the largest maze {} within {}\n", size, palette.good("solved and verified"),
                     human_seconds(options.budget_s));
}

std::string loops_text(double loops) {
  return loops > 0.0 ? human_number(loops) + " of the remaining walls taken out" : "perfect";
}

void add_size(std::string& text, const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  const MazeTrial& median = median_trial(result);
  const auto [fastest, slowest] = std::minmax_element(result.best.begin(), result.best.end(), by_seconds);
  line(text, palette, "size",
       fmt::format("{} cells, {} mazes, {}", grouped(static_cast<std::uint64_t>(median.cells())),
                   name_of(options.maze.algorithm), loops_text(options.maze.loops)));
  line(text, palette, "planner",
       fmt::format("{}, clearance {}, {} {}", planner_text(median), human_number(median.clearance), median.threads,
                   median.threads == 1 ? "thread" : "threads"));
  line(text, palette, "solve",
       fmt::format("{}, the median of {} {} ({} to {})", palette.strong(human_seconds(median.solve_s)),
                   result.best.size(), result.best.size() == 1 ? "seed" : "seeds", human_seconds(fastest->solve_s),
                   human_seconds(slowest->solve_s)));
  line(text, palette, "rate",
       fmt::format("{} cells a second, {:.1f} ns a cell", human_count(median.cells() / median.solve_s),
                   median.solve_s * 1e9 / median.cells()));
}

void add_stages(std::string& text, const LargestResult& result, const Palette& palette) {
  const MazeTrial& median = median_trial(result);
  for (const auto& [name, seconds] : named_stages(median.seconds)) {
    if (seconds == 0.0) continue;  // no stage of this planner: tiles do several in one
    line(text, palette, fmt::format("  {}", name),
         fmt::format("{:>9}  {:>5.1f} %  {:>7.2f} ns a cell", human_seconds(seconds), 100.0 * seconds / median.solve_s,
                     seconds * 1e9 / median.cells()));
  }
}

void add_memory(std::string& text, const LargestResult& result, const Palette& palette) {
  const MazeTrial& median = median_trial(result);
  const auto bytes = static_cast<double>(median.peak_memory_bytes);
  line(text, palette, "memory",
       fmt::format("{} at the peak, walls included: {:.1f} B a cell", human_bytes(bytes), bytes / median.cells()));
  const MemoryTouch& touch = result.touch;
  if (touch.bytes == 0) return;
  line(text, palette, "first touch",
       fmt::format("{} took {} cold and {} warm, before the clock: a cold start adds {}",
                   human_bytes(static_cast<double>(touch.bytes)), human_seconds(touch.cold_s),
                   human_seconds(touch.warm_s), human_seconds(touch.cold_s - touch.warm_s)));
}

void add_bar(std::string& text, const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  if (!result.bar || result.best.empty()) return;
  const MazeTrial& same = result.best.back();  // the bar's own maze
  line(text, palette, "BFS + funnel",
       fmt::format("{} from the same walls to {} path, touching allowed: {:.1f} times as fast, {:.1f} % shorter",
                   human_seconds(result.bar->seconds), options.maze.loops > 0.0 ? "a taut" : "the shortest",
                   same.solve_s / result.bar->seconds, 100.0 * (1.0 - result.bar->length / same.length)));
}

/// Why not larger?
void add_limit(std::string& text, const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  const double cells = result.best.empty() ? 0.0 : result.best.front().cells();
  const MazeTrial* next = nullptr;
  for (const MazeTrial& t : result.trials) {
    const bool fits = t.verified && t.solve_s <= options.budget_s;
    if (!fits && t.cells() > cells && (next == nullptr || t.cells() < next->cells())) next = &t;
  }
  if (next != nullptr) {
    line(text, palette, "too large",
         fmt::format("{} x {}, seed {}: {}, {}", next->rows, next->cols, next->seed, human_seconds(next->solve_s),
                     next->verified ? std::string_view{"over the budget"} : verdict_of(*next)));
  }
  for (const UnbegunSize& size : result.unbegun) {
    line(text, palette, "not begun",
         fmt::format("{} x {}: it would need {}", size.rows, size.cols,
                     human_bytes(static_cast<double>(size.expected_bytes))));
  }
}

Json best_json(const LargestResult& result) {
  Json json = Json::object();
  if (result.best.empty()) {
    for (const char* key : {"rows", "cols", "cells", "solve_s"}) json[key] = nullptr;
    json["verified"] = false;
    return json;
  }
  const MazeTrial& median = median_trial(result);
  json["rows"] = median.rows;
  json["cols"] = median.cols;
  json["cells"] = static_cast<std::uint64_t>(median.cells());
  json["solve_s"] = median.solve_s;
  json["verified"] = std::all_of(result.best.begin(), result.best.end(), [](const auto& t) { return t.verified; });
  return json;
}

/// The maze's seeds at the largest size, spread of their times, rate, memory a cell.
void add_figures(Json& json, const LargestResult& result) {
  if (result.best.empty()) return;
  const MazeTrial& median = median_trial(result);
  const auto [fastest, slowest] = std::minmax_element(result.best.begin(), result.best.end(), by_seconds);
  json["confirmed"] = result.confirmed;
  json["seeds"] = Json::array();
  for (const MazeTrial& t : result.best) json["seeds"].push_back(t.seed);
  json["solve_s_range"] = {fastest->solve_s, slowest->solve_s};
  json["cells_per_s"] = median.cells() / median.solve_s;
  json["stages_s"] = trial_json(median)["stages_s"];
  json["bytes_per_cell"] = static_cast<double>(median.peak_memory_bytes) / median.cells();
}

}  // namespace

std::string largest_summary(const LargestOptions& options, const LargestResult& result, const Palette& palette) {
  std::string text = headline(options, result, palette);
  if (!result.best.empty()) {
    add_size(text, options, result, palette);
    add_stages(text, result, palette);
    add_memory(text, result, palette);
    add_bar(text, options, result, palette);
  }
  add_limit(text, options, result, palette);
  line(text, palette, "machine", text_of(this_machine()));
  return text;
}

std::string largest_json(const LargestOptions& options, const LargestResult& result) {
  Json json{{"schema", "warren.largest/1"}, {"warren_version", WARREN_VERSION}, {"budget_s", options.budget_s}};
  json.update(best_json(result));
  const MazeTrial* shown =
      !result.best.empty() ? &median_trial(result) : (result.trials.empty() ? nullptr : &result.trials.back());
  json["planner"] = shown == nullptr ? Json(nullptr) : Json(shown->planner);
  json["sampler"] = shown == nullptr ? Json(nullptr) : Json(shown->sampler);
  json["threads"] = shown == nullptr ? Json(nullptr) : Json(shown->threads);
  json["peak_memory_bytes"] = shown == nullptr ? Json(nullptr) : Json(shown->peak_memory_bytes);
  json["bfs_funnel_s"] = result.bar ? Json(result.bar->seconds) : Json(nullptr);
  json["bfs_funnel_length"] = result.bar ? Json(result.bar->length) : Json(nullptr);
  json["algorithm"] = name_of(options.maze.algorithm);
  json["loops"] = options.maze.loops;
  if (result.signal) json["stopped_by"] = name_of(*result.signal);
  add_figures(json, result);
  const MemoryTouch& touch = result.touch;
  json["first_touch"] = {{"bytes", touch.bytes}, {"cold_s", touch.cold_s}, {"warm_s", touch.warm_s}};
  json["machine"] = machine_json(this_machine());
  json["not_begun"] = Json::array();
  for (const UnbegunSize& size : result.unbegun) {
    json["not_begun"].push_back({{"rows", size.rows}, {"cols", size.cols}, {"expected_bytes", size.expected_bytes}});
  }
  json["trials"] = Json::array();
  for (const MazeTrial& t : result.trials) json["trials"].push_back(trial_json(t));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

PlotSheet largest_plot(const LargestOptions& options, const LargestResult& result) {
  PlotSeries tried{.name = "solved, fastest of a size", .points = {}};
  PlotSeries cut{.name = "cut or unsolved", .points = {}, .joined = false};
  PlotSeries largest{.name = "largest size, a seed each", .points = {}, .joined = false};
  for (const MazeTrial& t : result.trials) (t.verified ? tried : cut).points.push_back({t.cells(), t.solve_s});
  for (const MazeTrial& t : result.best) largest.points.push_back({t.cells(), t.solve_s});
  std::sort(tried.points.begin(), tried.points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto same_size = [](Vec2 a, Vec2 b) { return a.x == b.x; };
  tried.points.erase(std::unique(tried.points.begin(), tried.points.end(), same_size), tried.points.end());
  Plot plot{.title = "Largest maze solved within the budget",
            .x_label = "cells",
            .y_label = "seconds, from walls in memory to path verified",
            .log_x = true,
            .log_y = true,
            .series = {},
            .level = options.budget_s,
            .level_name = fmt::format("budget {}", human_seconds(options.budget_s))};
  if (!result.best.empty()) {
    const MazeTrial& best = median_trial(result);
    plot.title =
        fmt::format("{} x {} in {}: {}", best.rows, best.cols, human_seconds(best.solve_s), planner_text(best));
  }
  for (const PlotSeries& series : {tried, cut, largest}) {
    if (!series.points.empty()) plot.series.push_back(series);
  }
  return sheet_of(plot);
}

}  // namespace warren::studies
