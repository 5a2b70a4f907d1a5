// SPDX-License-Identifier: BSD-3-Clause
#include "studies/compare/queue_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "studies/searches/graph_search.hpp"

namespace warren::studies {
namespace {

constexpr double least_s = 1e-9;  // a time that the clock's cost has eaten up

bool same_way(const SweepCurve& curve, const Contender& c) {
  return curve.search == c.search && curve.queue == c.queue && curve.library == c.library;
}

/// The line y = level + slope · x of least squares; none where all x are alike.
struct Line {
  double level;
  double slope;
};
std::optional<Line> fitted_line(const std::vector<Vec2>& points) {
  Vec2 mean;
  for (const Vec2 p : points) mean = mean + p;
  mean = 1.0 / static_cast<double>(points.size()) * mean;
  double xx = 0.0;
  double xy = 0.0;
  for (const Vec2 p : points) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
  }
  if (xx <= 0.0) return std::nullopt;
  return Line{mean.y - xy / xx * mean.x, xy / xx};
}

/// Where the line through these points, both axes as logarithms, rises through 1.
std::optional<double> rise_through_one(const std::vector<Vec2>& points) {
  std::vector<Vec2> logarithms;
  for (const Vec2 p : points) logarithms.push_back({std::log(p.x), std::log(p.y)});
  const std::optional<Line> line = fitted_line(logarithms);
  if (!line || line->slope <= 0.0) return std::nullopt;
  const double size = std::exp(-line->level / line->slope);
  return std::isfinite(size) ? std::optional(size) : std::nullopt;
}

std::vector<Vec2> ratios_of(const SweepCurve& array, const SweepCurve& heap) {
  std::vector<Vec2> ratios;
  for (const Vec2 a : array.points) {
    for (const Vec2 h : heap.points) {
      if (a.x == h.x) ratios.push_back({a.x, a.y / h.y});
    }
  }
  return ratios;
}

QueueCrossing crossing_of(const SweepCurve& array, const SweepCurve& heap) {
  QueueCrossing c;
  c.search = array.search;
  c.array = array.queue;
  c.heap = heap.queue;
  c.ratios = ratios_of(array, heap);
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

std::vector<SweepCurve> sweep_curves(const Comparison& comparison) {
  std::vector<SweepCurve> curves;
  std::vector<std::map<std::uint64_t, std::vector<double>>> medians;  // of each curve, by size
  for (const Contender& c : comparison.contenders) {
    const ComparedProblem& problem = comparison.problems[c.problem];
    const ComparisonRow row = row_of(c);
    if (problem.kind != "geometric" || row.solved == 0 || row.solved < row.runs) continue;
    const auto curve = std::find_if(curves.begin(), curves.end(), [&](const auto& s) { return same_way(s, c); });
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
