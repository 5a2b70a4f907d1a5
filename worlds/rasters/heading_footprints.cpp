// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/heading_footprints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/whole.hpp"
#include "core/plane/se2.hpp"

namespace warren {
namespace {

/// Corners in order from the least: the same for every heading that covers the same set.
ConvexPiece key_of(ConvexPiece corners) {
  const auto less = [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
  return corners;
}

/// The turn to the next heading, larger ones in parts, so that arcs stay near their tangents.
LayerJob turn_job(const std::vector<ConvexPiece>& pieces, std::uint32_t angles) {
  LayerJob job;
  const double angle_rad = 2.0 * std::numbers::pi / angles;
  constexpr double widest = std::numbers::pi / 24;
  const int parts = bounded_whole<int>(std::ceil(angle_rad / widest));
  for (const ConvexPiece& piece : pieces) {
    for (int part = 0; part < parts; ++part) {
      ConvexPiece from;
      for (const Vec2 p : piece) from.push_back(Rotation(part * angle_rad / parts)(p));
      for (ConvexPiece& swept : swept_by_turn(from, angle_rad / parts)) job.pieces.push_back(std::move(swept));
    }
  }
  return job;
}

class JobList {
 public:
  explicit JobList(HeadingLayers& layers) : layers_(layers) {}

  void add_heading(const std::vector<ConvexPiece>& pieces) {
    layers_.standing.push_back(add({pieces, true}));
    std::array<std::uint32_t, 4> moving{};
    for (std::size_t s = 0; s < moving.size(); ++s) {
      const auto [dx, dy] = HeadingLayers::steps[s];
      LayerJob job;
      for (const ConvexPiece& piece : pieces) {
        job.pieces.push_back(swept_by_step(piece, {dx * layers_.cell, dy * layers_.cell}));
      }
      moving[s] = add(std::move(job));
    }
    layers_.moving.push_back(moving);
    if (layers_.angles > 1) layers_.turning.push_back(add(turn_job(pieces, layers_.angles)));
  }
  void repeat_heading(std::size_t same) {
    layers_.standing.push_back(layers_.standing[same]);
    layers_.moving.push_back(layers_.moving[same]);
    if (layers_.angles > 1) layers_.turning.push_back(layers_.turning[same]);
  }
  std::vector<LayerJob> take() { return std::move(jobs_); }

 private:
  std::uint32_t add(LayerJob job) {
    jobs_.push_back(std::move(job));
    return as_whole<std::uint32_t>(jobs_.size() - 1);
  }

  HeadingLayers& layers_;
  std::vector<LayerJob> jobs_;
};

}  // namespace

std::vector<LayerJob> list_layer_jobs(std::span<const Vec2> outline, HeadingLayers& layers) {
  JobList jobs(layers);
  std::vector<ConvexPiece> keys;
  for (std::uint32_t k = 0; k < layers.angles; ++k) {
    keys.push_back(key_of(turned(outline, k, layers.angles)));
    const auto same = as_whole<std::size_t>(std::find(keys.begin(), keys.end(), keys.back()) - keys.begin());
    if (same < k) {
      jobs.repeat_heading(same);
    } else {
      jobs.add_heading(outline_pieces(turned(outline, k, layers.angles)));
    }
  }
  return jobs.take();
}

}  // namespace warren
