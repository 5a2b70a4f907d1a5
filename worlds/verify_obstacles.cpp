// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/verify_obstacles.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "parallel/chunks.hpp"
#include "worlds/leg_index.hpp"
#include "worlds/path_screen.hpp"

namespace warren {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t grain = std::size_t{1} << 15;
constexpr std::size_t sample_block = 512;  // walls in a row: as many as make one visit to memory worth it
constexpr std::size_t sample_stride = 32 * sample_block;

/// Runs `compare(comparison, i)` for i = 0 .. count - 1 in chunks of `size`, each with a comparison of its own.
template <class Compare>
Tally tally_of(std::size_t count, std::size_t size, const LegIndex& legs, const VerifyOptions& options, double at_most,
               const Execution& execution, const Compare& compare) {
  std::vector<Tally> parts(chunk_count(count, size));
  for_chunks(count, size, execution, [&](Range r) {
    Comparison comparison(legs, options, at_most);
    for (std::size_t i = r.first; i < r.last; ++i) compare(comparison, i);
    parts[r.first / size] = comparison.take();
  });
  Tally all;
  for (Tally& part : parts) all.join(std::move(part));
  return all;
}

/// One such comparison in progress.
class ObstaclePass {
 public:
  ObstaclePass(const Scene& scene, const Obstacles& obstacles, std::span<const Vec2> path, const VerifyOptions& options,
               const Execution& execution)
      : scene_(scene), path_(path), options_(options), execution_(execution), obstacles_(obstacles) {}

  Tally run() {
    const double half_wall = typical_wall();
    PathScreen screen(path_, 2.0 * half_wall, execution_);
    const double bound = least_of_some(screen);
    const double reach = std::max(bound, options_.clearance);
    if (!(reach <= 4.0 * screen.cell())) {
      legs_.emplace(path_, LegIndex::Plan{options_.clearance, obstacles_.size(), half_wall}, execution_);
      return compare_unscreened();
    }
    screen.set_reach(bound, options_.clearance);
    Screened screened = screened_obstacles(screen);
    Tally tally;
    if (!screened.doubtful.empty()) {
      legs_.emplace(path_, LegIndex::Plan{reach, screened.doubtful.size(), half_wall}, execution_);
      legs_->set_reach(reach, execution_);
      const auto compare = [&](Comparison& comparison, std::size_t i) {
        comparison.with_near_legs(obstacles_.segment(screened.doubtful[i]), screened.doubtful[i]);
      };
      tally = tally_of(screened.doubtful.size(), grain, *legs_, options_, reach, execution_, compare);
    }
    tally.box = screened.box;
    tally.least = std::min(tally.least, bound);
    return tally;
  }

 private:
  /// Half the extent of the middle one of some walls.
  double typical_wall() const {
    constexpr std::size_t most = 1023;
    const std::size_t step = std::max<std::size_t>(1, scene_.walls.size() / most);
    std::vector<double> halves;
    for (std::size_t i = 0; i < scene_.walls.size(); i += step) {
      const Box box = box_of(scene_.walls.segment(i));
      halves.push_back(0.5 * std::max(box.width(), box.height()));
    }
    if (halves.empty()) return 0.0;
    const auto middle = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
    std::nth_element(halves.begin(), middle, halves.end());
    return *middle;
  }

  /// A distance from the path that some wall has: nothing beyond it matters for the least one.
  double least_of_some(const PathScreen& screen) const {
    constexpr std::size_t most_blocks = 256;
    constexpr std::size_t block = 64;  // walls in a row
    const std::size_t count = obstacles_.size();
    const std::size_t blocks = std::min(most_blocks, chunk_count(count, 8 * block));
    double least = infinity;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t first = count / blocks * b;
      for (std::size_t i = first; i < std::min(first + block, count); ++i) {
        least = std::min(least, screen.distance_of_some(obstacles_.segment(i)));
      }
    }
    return least;
  }

  /// What the screen says about obstacles.
  struct Screened {
    std::vector<std::size_t> doubtful;  ///< these may be near the path
    Box box;                            ///< of all

    void join(const Screened& other) {
      doubtful.insert(doubtful.end(), other.doubtful.begin(), other.doubtful.end());
      box.include(other.box);
    }
  };

  Screened screened_obstacles(const PathScreen& screen) const {
    Screened all = scene_.walls.visit([&](auto walls) {
      return screened(screen, walls.size(), 0, [walls](std::size_t i) { return box_of(walls[i].segment()); });
    });
    const Box walls_box = all.box;
    const auto side = [&](std::size_t i) { return box_of(obstacles_.side_segment(i)); };
    all.join(screened(screen, obstacles_.sides().size(), obstacles_.wall_count(), side));
    all.box = walls_box;
    for (const Ring& ring : obstacles_.rings()) include_corners(ring, all.box);
    return all;
  }

  /// Numbers count from `first_number`.
  template <class BoxAt>
  Screened screened(const PathScreen& screen, std::size_t count, std::size_t first_number, const BoxAt& box_at) const {
    std::vector<Screened> parts(chunk_count(count, grain));
    for_chunks(count, grain, execution_, [&](Range r) {
      Screened part;
      std::size_t budget = 65536 + 64 * r.size();  // words of cells: for many short obstacles and a few long ones
      for (std::size_t i = r.first; i < r.last; ++i) {
        const Box box = box_at(i);
        part.box.min = {std::min(part.box.min.x, box.min.x), std::min(part.box.min.y, box.min.y)};
        part.box.max = {std::max(part.box.max.x, box.max.x), std::max(part.box.max.y, box.max.y)};
        if (!screen.is_clear(box, budget)) part.doubtful.push_back(first_number + i);
      }
      parts[r.first / grain] = std::move(part);
    });
    Screened all;
    for (const Screened& part : parts) all.join(part);
    return all;
  }

  /// The bounds are no obstacle in this sense.
  static void include_corners(const Ring& ring, Box& box) {
    if (ring.polygon == Ring::none) return;
    for (const Vec2 p : ring.corners) box.include(p);
  }

  Tally compare_unscreened() {
    LegIndex& legs = *legs_;
    const double widest = 4.0 * legs.cell();
    double bound = infinity;  // a distance that some wall has: nothing beyond it matters for the least one
    if (scene_.walls.size() > 8 * sample_stride) {
      legs.set_reach(widest, execution_);
      bound = sampled_least(widest);
    }
    const double reach = std::max(options_.clearance, std::min(bound, widest));
    legs.set_reach(reach, execution_);
    Tally tally = walls_against_path(reach);
    tally.join(sides_against_path(reach));
    tally.least = std::min(tally.least, bound);
    if (tally.least > reach) tally.least = least_of_far();
    return tally;
  }

  double sampled_least(double reach) const {
    return scene_.walls.visit([&](auto walls) {
      const std::size_t blocks = walls.size() / sample_stride;
      const auto compare = [&, walls](Comparison& comparison, std::size_t block) {
        const std::size_t first = block * sample_stride;
        for (std::size_t i = first; i < first + sample_block; ++i) comparison.with_near_legs(walls[i].segment(), i);
      };
      return tally_of(blocks, 64, *legs_, options_, reach, execution_, compare).least;
    });
  }

  Tally walls_against_path(double reach) const {
    return scene_.walls.visit([&](auto walls) {
      const auto compare = [walls](Comparison& comparison, std::size_t i) {
        comparison.with_near_legs(walls[i].segment(), i);
      };
      return tally_of(walls.size(), grain, *legs_, options_, reach, execution_, compare);
    });
  }

  Tally sides_against_path(double reach) const {
    const auto compare = [&](Comparison& comparison, std::size_t i) {
      comparison.with_near_legs(obstacles_.side_segment(i), obstacles_.wall_count() + i);
    };
    Tally tally = tally_of(obstacles_.sides().size(), grain, *legs_, options_, reach, execution_, compare);
    tally.box = {};  // the bounds are no obstacle in this sense
    for (const Ring& ring : obstacles_.rings()) include_corners(ring, tally.box);
    return tally;
  }

  /// For a path with nothing within reach: all legs against all obstacles, by the boxes of legs. A few of the obstacles
  /// go first, so that every chunk starts with a good bound.
  double least_of_far() const {
    const auto compare = [&](Comparison& comparison, std::size_t i) {
      comparison.with_all_legs(obstacles_.segment(i), i);
    };
    const std::size_t step = std::max<std::size_t>(1, obstacles_.size() / 512);
    const auto compare_some = [&](Comparison& comparison, std::size_t i) { compare(comparison, i * step); };
    const std::size_t some = obstacles_.size() / step;
    const double bound = tally_of(some, grain, *legs_, options_, infinity, execution_, compare_some).least;
    return std::min(bound, tally_of(obstacles_.size(), grain, *legs_, options_, bound, execution_, compare).least);
  }

  const Scene& scene_;
  std::span<const Vec2> path_;
  const VerifyOptions& options_;
  const Execution& execution_;
  const Obstacles& obstacles_;
  std::optional<LegIndex> legs_;  ///< made only where the screen leaves something open
};

}  // namespace

Tally compare_obstacles(const Scene& scene, const Obstacles& obstacles, std::span<const Vec2> path,
                        const VerifyOptions& options, const Execution& execution) {
  return ObstaclePass(scene, obstacles, path, options, execution).run();
}

}  // namespace warren
