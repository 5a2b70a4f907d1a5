// SPDX-License-Identifier: BSD-3-Clause
// Random graphs of many sizes as text: a table a search, sizes down, queues across, and the crossings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/text/human_units.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/compare/queue_crossings.hpp"
#include "studies/measure/text_table.hpp"

namespace warren::studies {
namespace {

std::vector<std::string> searches_of(const std::vector<SweepCurve>& curves) {
  std::vector<std::string> searches;
  for (const SweepCurve& curve : curves) add_once(searches, curve.search);
  return searches;
}

std::string time_at(const SweepCurve& curve, double size) {
  const auto found = std::find_if(curve.points.begin(), curve.points.end(), [&](const Vec2 p) { return p.x == size; });
  return found == curve.points.end() ? "-" : precise_seconds(found->y);
}

std::string curve_name(const SweepCurve& curve) {
  if (curve.library != "warren") return curve.library;
  return curve.queue.empty() ? "median" : curve.queue;
}

TextTable table_of(const std::vector<SweepCurve>& curves, const std::string& search) {
  TextTable table{{search + " on"}, 0, {}};
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

}  // namespace

std::vector<ReportTable> sweep_tables(const Comparison& comparison) {
  const std::vector<SweepCurve> curves = sweep_curves(comparison);
  std::vector<ReportTable> tables;
  for (const std::string& search : searches_of(curves)) tables.push_back({"", table_of(curves, search)});
  TextTable crossings{{"search", "array", "against", "from which size on the array is slower"}, 4, {}};
  for (const QueueCrossing& c : queue_crossings(curves)) {
    crossings.rows.push_back({c.search, c.array, c.heap, crossing_text(c)});
  }
  if (!crossings.rows.empty()) tables.push_back({"", std::move(crossings)});
  return tables;
}

}  // namespace warren::studies
