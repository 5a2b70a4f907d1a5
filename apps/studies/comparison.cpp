// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "apps/studies/search_contest.hpp"
#include "core/base/rng.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/answer/write_answer_io.hpp"

namespace warren::studies {
namespace {

Interval success_of(const Contender& contender, const ComparisonRow& row) {
  if (row.runs == 0) return {0.0, 1.0};
  const double solved = row.solved > 0 ? 1.0 : 0.0;
  // A run that was cut says nothing about others.
  const bool is_known = contender.deterministic && contender.runs.front().outcome != Outcome::stopped;
  return is_known ? Interval{solved, solved} : wilson_interval(row.solved, row.runs);
}

/// "samples 50", "full"
std::vector<std::string> option_parts(const Contender& contender) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : contender.options) {
    const bool is_word = value.size() >= 2 && value.front() == '"';
    parts.push_back(value == "true" ? name : name + " " + (is_word ? value.substr(1, value.size() - 2) : value));
  }
  return parts;
}

std::vector<std::string> name_parts(const Contender& c, bool with_planner) {
  if (!c.dealt.empty()) {
    std::vector<std::string> parts{c.planner};
    for (const auto& [option, word] : c.dealt) parts.push_back(fmt::format("{} {}", option, word));
    return parts;
  }
  if (c.library != "warren") return {c.search, c.library};
  std::vector<std::string> parts{with_planner ? c.planner : "", c.search, c.queue};
  std::erase(parts, "");
  if (with_planner) std::ranges::copy(option_parts(c), std::back_inserter(parts));
  return parts;
}

/// Where the line of least squares through these points, both axes as logarithms, rises through 1.
std::optional<double> rise_through_one(const std::vector<Vec2>& points) {
  const auto slope = common_exponent(std::span(&points, 1));
  if (!slope || *slope <= 0.0) return std::nullopt;  // all x are alike, or it falls
  const Vec2 mean = mean_logarithms(points);
  const double size = std::exp(-(mean.y - *slope * mean.x) / *slope);
  return std::isfinite(size) ? std::optional(size) : std::nullopt;
}

QueueCrossing crossing_of(const SweepCurve& array, const SweepCurve& heap) {
  QueueCrossing c{.search = array.search, .array = array.queue, .heap = heap.queue, .ratios = {}};
  for (const Vec2 a : array.points) {
    for (const Vec2 h : heap.points) {
      if (a.x == h.x) c.ratios.push_back({a.x, a.y / h.y});
    }
  }
  const auto last_not_slower = std::find_if(c.ratios.rbegin(), c.ratios.rend(), [](Vec2 r) { return r.y <= 1.0; });
  if (last_not_slower != c.ratios.rend()) c.not_slower_at = last_not_slower->x;
  if (last_not_slower != c.ratios.rbegin()) c.slower_from = std::prev(last_not_slower)->x;
  if (c.not_slower_at && c.slower_from) c.crossing = rise_through_one({*last_not_slower, *std::prev(last_not_slower)});
  if (!c.ratios.empty()) c.fitted = rise_through_one(c.ratios);
  return c;
}

bool is_heap(const SweepCurve& curve) {
  return curve.queue == name_of(QueuePolicy::heap) || curve.queue == name_of(QueuePolicy::lazy_heap);
}

}  // namespace

ComparisonRow row_of(const Contender& contender) {
  ComparisonRow row;
  row.runs = contender.runs.size();
  for (const ComparedRun& run : contender.runs) row.solved += run.solved() ? 1 : 0;
  row.success = success_of(contender, row);
  // Of a figure, or of one that some of the runs have.
  const auto of = [&](const auto& runs, auto ComparedRun::*figure) {
    std::vector<double> values;
    for (const ComparedRun& run : contender.runs) {
      const std::optional<double> value = run.*figure;
      if (value && runs(run)) values.push_back(*value);
    }
    return distribution_of(values);
  };
  const auto all = [](const ComparedRun&) { return true; };
  const auto solved = [](const ComparedRun& run) { return run.solved(); };
  const auto priced = [](const ComparedRun& run) { return run.solved() && run.is_priced; };
  row.length = of(solved, &ComparedRun::length);
  row.priced_cost = of(priced, &ComparedRun::cost);
  row.hops = of(solved, &ComparedRun::hops);
  row.min_clearance = of(solved, &ComparedRun::min_clearance);
  row.cells = of(solved, &ComparedRun::cells);
  row.turn_rad = of(solved, &ComparedRun::turn_rad);
  row.search_s = of(solved, &ComparedRun::search_s);
  row.expanded = of(all, &ComparedRun::expanded);
  row.time_s = of(all, &ComparedRun::time_s);
  return row;
}

std::vector<std::pair<std::string, std::string>> json_options(const std::vector<NamedFigure>& options) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& [name, value] : options) texts.emplace_back(name, figure_json(value));
  return texts;
}

std::optional<double> number_in_word(std::string_view word) {
  const auto value = scene_text::number_in_full<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string contender_name(const Contender& contender, bool with_planner) {
  std::vector<std::string> parts{with_planner ? contender.planner : "", contender.search, contender.queue};
  std::erase(parts, "");
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string options_text(const Contender& contender) {
  return fmt::format("{}", fmt::join(option_parts(contender), ", "));
}

std::vector<NamedContender> named_contenders(const Comparison& comparison, std::size_t problem) {
  std::vector<NamedContender> named;
  std::vector<std::vector<std::string>> all;
  for (const Contender& c : comparison.contenders) {
    if (c.problem != problem) continue;
    named.emplace_back("", &c);
    all.push_back(name_parts(c, comparison.problems[problem].kind.empty()));
  }
  const auto is_common = [&](const std::string& part) {
    const auto has_it = [&](const auto& parts) { return std::ranges::find(parts, part) != parts.end(); };
    return all.size() > 1 && std::ranges::all_of(all, has_it);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::string> own;
    std::remove_copy_if(all[i].begin(), all[i].end(), std::back_inserter(own), is_common);
    named[i].first = fmt::format("{}", fmt::join(own.empty() ? all[i] : own, ", "));
  }
  return named;
}

std::vector<std::size_t> turns(std::size_t count, std::uint64_t round) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  SequentialRng rng(round);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[rng.below(i)]);
  return order;
}

std::vector<SweepCurve> sweep_curves(const Comparison& comparison) {
  constexpr double least_s = 1e-9;  // a time that the clock's cost has eaten up
  std::vector<SweepCurve> curves;
  std::vector<std::map<std::uint64_t, std::vector<double>>> medians;  // of each curve, by size
  for (const Contender& c : comparison.contenders) {
    const ComparedProblem& problem = comparison.problems[c.problem];
    const ComparisonRow row = row_of(c);
    if (problem.kind != "geometric" || row.solved == 0 || row.solved < row.runs) continue;
    const auto curve = std::find_if(curves.begin(), curves.end(), [&](const SweepCurve& s) {
      return s.search == c.search && s.queue == c.queue && s.library == c.library;
    });
    const auto place = static_cast<std::size_t>(curve - curves.begin());
    if (curve == curves.end()) {
      curves.push_back({c.search, c.queue, c.library, {}});
      medians.emplace_back();
    }
    medians[place][problem.vertices].push_back(std::max(least_s, row.time_s->median));
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const auto& [size, times] : medians[i]) {
      double sum = 0.0;
      for (const double t : times) sum += std::log(t);
      curves[i].points.push_back({static_cast<double>(size), std::exp(sum / static_cast<double>(times.size()))});
    }
  }
  return curves;
}

std::vector<QueueCrossing> queue_crossings(const std::vector<SweepCurve>& curves) {
  std::vector<QueueCrossing> crossings;
  for (const SweepCurve& array : curves) {
    if (array.queue.empty() || is_heap(array) || array.library != name_of(SearchLibrary::warren)) continue;
    for (const SweepCurve& heap : curves) {
      if (is_heap(heap) && heap.search == array.search) crossings.push_back(crossing_of(array, heap));
    }
  }
  return crossings;
}

}  // namespace warren::studies
