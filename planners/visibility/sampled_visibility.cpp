// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/sampled_visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plane/geometry.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr double places_of_ends = 100.0;

class SampledSight {
 public:
  SampledSight(const PolygonIndex& polygons, double step) : polygons_(polygons), step_(step) {
    const Box& box = polygons.box();
    for (const double c : {box.min.x, box.min.y, box.max.x, box.max.y}) size_ = std::max(size_, std::abs(c));
  }

  bool sees(Vec2 a, Vec2 b, bool of_end) const {
    const double length = distance(a, b);
    const double step = of_end ? length / places_of_ends : step_;
    const double places = length > 0.0 ? std::floor(length / step) : 0.0;
    for (double k = 0.0; k <= places; ++k) {
      const double t = length > 0.0 ? k * step / length : 0.0;
      if (is_inside(a + t * (b - a))) return false;
    }
    return true;
  }

 private:
  bool is_inside(Vec2 p) const {
    constexpr double units = 1e-14;
    const double rounding = units * size_;
    const auto polygon = polygons_.polygon_around(p);
    if (!polygon) return false;
    return polygons_.for_each_side_near(*polygon, Box{p, p}.grown(rounding),
                                        [&](std::size_t side) { return distance(p, polygons_.side(side)) > rounding; });
  }

  const PolygonIndex& polygons_;
  double step_;
  double size_ = 0.0;
};

}  // namespace

std::vector<Edge> sampled_visibility(const PolygonIndex& polygons, Vec2 start, Vec2 goal, double step,
                                     const Execution& execution) {
  const SampledSight sight(polygons, step);
  std::vector<Vec2> points = polygons.polygons().corners;
  const std::size_t corners = points.size();
  points.push_back(start);
  points.push_back(goal);
  std::vector<std::vector<Edge>> parts(points.size());
  for_chunks(points.size(), 1, execution, [&](Range r) {
    const std::size_t i = r.first;
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (execution.should_stop()) execution.check();
      if (sight.sees(points[i], points[j], j >= corners)) {
        parts[i].push_back({static_cast<VertexId>(i), static_cast<VertexId>(j)});
      }
    }
  });
  std::vector<Edge> edges;
  for (const std::vector<Edge>& part : parts) edges.insert(edges.end(), part.begin(), part.end());
  return edges;
}

double depth_inside(const PolygonIndex& polygons, const Segment& segment, std::size_t places) {
  double deepest = 0.0;
  for (std::size_t k = 1; k < places; ++k) {
    const Vec2 p = segment.a + (static_cast<double>(k) / static_cast<double>(places)) * (segment.b - segment.a);
    const auto polygon = polygons.polygon_around(p);
    if (!polygon) continue;
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t side = polygons.polygons().first[*polygon]; side < polygons.polygons().first[*polygon + 1];
         ++side) {
      depth = std::min(depth, distance(p, polygons.side(side)));
    }
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

}  // namespace warren
