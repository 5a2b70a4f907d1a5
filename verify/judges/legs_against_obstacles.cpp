// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/legs_against_obstacles.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/near/leg_boxes.hpp"
#include "verify/near/leg_index.hpp"
#include "verify/near/path_cells.hpp"
#include "verify/near/path_screen.hpp"

namespace warren {
namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();
constexpr std::size_t verify_grain = std::size_t{1} << 14;
constexpr std::size_t small_grain = 1024;  // where one obstacle takes microseconds
constexpr std::size_t sample_block = 512;  // walls in a row: as many as make one visit to memory worth it
constexpr std::size_t sample_stride = 32 * sample_block;

/// One such comparison in progress.
class ObstaclePass {
 public:
  ObstaclePass(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs, const VerifyOptions& options,
               const Execution& execution)
      : scene_(scene),
        options_(options),
        execution_(execution),
        obstacles_(obstacles),
        legs_(legs),
        half_wall_(typical_wall()) {}

  Tally run() {
    const double bound = least_of_some();
    const double reach = std::max(bound, options_.reach());
    PathScreen screen(legs_, {obstacles_.size(), 2.0 * half_wall_}, execution_);
    if (!(reach <= 4.0 * screen.cell())) return compare_unscreened();
    // What the screens drop is as far as they are told from a leg or its box; between the two, only a leg almost along
    // an axis may be taken to be nearer than it is.
    const double far = legs_.has_skew() ? bound * (1.0 + 4.0 * exact::distance_error) : bound;
    screen.set_reach(far, options_.reach());
    const PathScreen::Rest rest = screened(screen, far);
    Tally tally = compare(rest.doubtful, reach);
    tally.box = rest.box;
    tally.least = std::min(tally.least, bound);
    return tally;
  }

 private:
  /// Runs `compare(comparison, i)` for i = 0 .. count - 1 in chunks of `size`, each with a comparison of its own.
  template <class Compare>
  Tally tally_of(std::size_t count, std::size_t size, double at_most, const Compare& compare) const {
    std::vector<Tally> parts(chunk_count(count, size));
    for_chunks(count, size, execution_, [&](Range r) {
      Comparison comparison(legs_, options_, at_most);
      for (std::size_t i = r.first; i < r.last; ++i) compare(comparison, i);
      parts[r.first / size] = comparison.take();
    });
    Tally all;
    for (Tally& part : parts) all.join(std::move(part));
    return all;
  }

  /// Half the extent of the middle one of some walls.
  double typical_wall() const {
    constexpr std::size_t most = 255;
    const std::size_t step = std::max<std::size_t>(1, scene_.walls.size() / most);
    std::vector<double> halves;
    for (std::size_t i = 0; i < scene_.walls.size(); i += step) {
      const Box box = box_of(scene_.walls.segment(i));
      halves.push_back(0.5 * std::max(box.width(), box.height()));
    }
    if (halves.empty()) return 0.0;
    const auto middle = halves.begin() + as_whole<std::ptrdiff_t>(halves.size() / 2);
    std::nth_element(halves.begin(), middle, halves.end());
    return *middle;
  }

  /// Some runs of obstacles: a 64th of a few, a 1024th of many.
  std::vector<Range> some() const {
    constexpr std::size_t most_runs = 64;
    constexpr std::size_t run = 64;  // obstacles in a row
    const std::size_t count = obstacles_.size();
    const std::size_t runs = std::clamp<std::size_t>(count / (1024 * run), std::min<std::size_t>(count, 1), most_runs);
    const std::size_t length = std::min(run, count / 64 + 1);
    std::vector<Range> ranges;
    for (std::size_t i = 0; i < runs; ++i) ranges.push_back({count / runs * i, count / runs * i + length});
    return ranges;
  }

  /// A distance from the path that some obstacle has: nothing beyond it matters for the least one.
  double least_of_some() const {
    const std::vector<Range> runs = some();
    if (runs.empty()) return boundless;
    const auto compare = [&](Comparison& comparison, std::size_t i) {
      comparison.with_all_legs(obstacles_.segment(i), i);
    };
    Comparison first(legs_, options_, boundless);
    for (std::size_t i = runs[0].first; i < std::min(runs[0].first + 8, runs[0].last); ++i) compare(first, i);
    const double bound = first.take().least;  // so that every chunk starts with a good one
    const std::size_t length = runs[0].size();
    const auto compare_next = [&](Comparison& comparison, std::size_t i) {
      compare(comparison, runs[i / length].first + i % length);
    };
    return std::min(bound, tally_of(runs.size() * length, 128, bound, compare_next).least);
  }

  /// About so many obstacles the screen will leave.
  std::size_t expected_rest(const PathScreen& screen) const {
    PathScreen::Rest rest;
    std::size_t asked = 0;
    for (const Range& run : some()) {
      std::vector<DoubleWall> walls;
      for (std::size_t i = run.first; i < run.last; ++i) walls.push_back(wall_of(obstacles_.segment(i)));
      screen.sift(walls, run.first, rest);
      asked += walls.size();
    }
    return asked == 0 ? 0 : rest.doubtful.size() * (obstacles_.size() / asked);
  }

  static DoubleWall wall_of(const Segment& s) { return {s.a.x, s.a.y, s.b.x, s.b.y}; }

  /// What the screens leave; the box is that of walls and polygons.
  PathScreen::Rest screened(const PathScreen& screen, double bound) const {
    std::optional<PathBoxes> boxes;  // pays where the path doesn't keep to the cells' lines
    if (expected_rest(screen) > legs_.leg_count() / 2 + verify_grain) {
      boxes.emplace(legs_, 2.0 * half_wall_, execution_);
      boxes->set_reach(bound, options_.reach());
    }
    PathScreen::Rest all = scene_.walls.visit([&](auto walls) {
      return screened(screen, boxes, walls.size(), 0, [walls](Range r) { return walls.subspan(r.first, r.size()); });
    });
    const auto sides_in = [&](Range r) {
      std::vector<DoubleWall> sides;
      for (std::size_t i = r.first; i < r.last; ++i) sides.push_back(wall_of(obstacles_.side_segment(i)));
      return sides;
    };
    const PathScreen::Rest sides =
        screened(screen, boxes, obstacles_.sides().size(), obstacles_.wall_count(), sides_in);
    all.doubtful.insert(all.doubtful.end(), sides.doubtful.begin(), sides.doubtful.end());
    for (const Ring& ring : obstacles_.rings()) include_corners(ring, all.box);
    return all;
  }

  /// Numbers count from `first_number`.
  template <class WallsIn>
  PathScreen::Rest screened(const PathScreen& screen, const std::optional<PathBoxes>& boxes, std::size_t count,
                            std::size_t first_number, const WallsIn& walls_in) const {
    std::vector<PathScreen::Rest> parts(chunk_count(count, verify_grain));
    for_chunks(count, verify_grain, execution_, [&](Range r) {
      PathScreen::Rest part;
      const auto& walls = walls_in(r);
      screen.sift(std::span(walls), first_number + r.first, part);
      std::size_t budget = 65536 + 64 * r.size();  // words of cells: for many short obstacles and a few long ones
      const auto is_clear = [&](std::size_t number) {
        return boxes->is_clear(box_of(walls[number - first_number - r.first].segment()), budget);
      };
      if (boxes) std::erase_if(part.doubtful, is_clear);
      parts[r.first / verify_grain] = std::move(part);
    });
    PathScreen::Rest all;
    for (const PathScreen::Rest& part : parts) {
      all.doubtful.insert(all.doubtful.end(), part.doubtful.begin(), part.doubtful.end());
      all.box.include(part.box);
    }
    return all;
  }

  /// The obstacles of these numbers with the legs nearer than the reach.
  Tally compare(const std::vector<std::size_t>& numbers, double reach) const {
    if (numbers.size() <= legs_.leg_count() / 16 + 64) {
      return tally_of(numbers.size(), small_grain, reach, [&](Comparison& comparison, std::size_t i) {
        comparison.with_all_legs(obstacles_.segment(numbers[i]), numbers[i]);
      });
    }
    LegIndex index(legs_, {reach, numbers.size(), half_wall_}, execution_);
    index.set_reach(reach, execution_);
    return tally_of(numbers.size(), small_grain, reach, [&](Comparison& comparison, std::size_t i) {
      comparison.with_near_legs(index, obstacles_.segment(numbers[i]), numbers[i]);
    });
  }

  /// The bounds are no obstacle in this sense.
  static void include_corners(const Ring& ring, Box& box) {
    if (ring.polygon == Ring::none) return;
    for (const Vec2 p : ring.corners) box.include(p);
  }

  Tally compare_unscreened() const {
    LegIndex index(legs_, {options_.reach(), obstacles_.size(), half_wall_}, execution_);
    const double widest = 4.0 * index.cell();
    double bound = boundless;  // a distance that some wall has: nothing beyond it matters for the least one
    if (scene_.walls.size() > 8 * sample_stride) {
      index.set_reach(widest, execution_);
      bound = sampled_least(index, widest);
    }
    const double reach = std::max(options_.reach(), std::min(bound, widest));
    index.set_reach(reach, execution_);
    Tally tally = walls_against_path(index, reach);
    tally.join(sides_against_path(index, reach));
    tally.least = std::min(tally.least, bound);
    if (tally.least > reach) tally.least = least_of_far();
    return tally;
  }

  double sampled_least(const LegIndex& index, double reach) const {
    return scene_.walls.visit([&](auto walls) {
      const std::size_t blocks = walls.size() / sample_stride;
      const auto compare = [&, walls](Comparison& comparison, std::size_t block) {
        const std::size_t first = block * sample_stride;
        for (std::size_t i = first; i < first + sample_block; ++i)
          comparison.with_near_legs(index, walls[i].segment(), i);
      };
      return tally_of(blocks, 64, reach, compare).least;
    });
  }

  Tally walls_against_path(const LegIndex& index, double reach) const {
    return scene_.walls.visit([&](auto walls) {
      const auto compare = [&, walls](Comparison& comparison, std::size_t i) {
        comparison.with_near_legs(index, walls[i].segment(), i);
      };
      return tally_of(walls.size(), verify_grain, reach, compare);
    });
  }

  Tally sides_against_path(const LegIndex& index, double reach) const {
    const auto compare = [&](Comparison& comparison, std::size_t i) {
      comparison.with_near_legs(index, obstacles_.side_segment(i), obstacles_.wall_count() + i);
    };
    Tally tally = tally_of(obstacles_.sides().size(), verify_grain, reach, compare);
    tally.box = {};
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
    const double bound = tally_of(some, verify_grain, boundless, compare_some).least;
    return std::min(bound, tally_of(obstacles_.size(), verify_grain, bound, compare).least);
  }

  const Scene& scene_;
  const VerifyOptions& options_;
  const Execution& execution_;
  const Obstacles& obstacles_;
  const LegBoxes& legs_;
  double half_wall_;
};

}  // namespace

Tally compare_obstacles(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs,
                        const VerifyOptions& options, const Execution& execution) {
  return ObstaclePass(scene, obstacles, legs, options, execution).run();
}

namespace {

constexpr std::size_t leg_grain = 256;
constexpr std::size_t looks_a_poll = 4096;
constexpr std::size_t legs_a_stretch = 64;
constexpr std::size_t legs_a_group = 8;
constexpr std::size_t most_around = 256;  // blocks near a stretch: more are a wide one, whose groups have fewer
constexpr std::size_t most_near = 32;     // blocks near a group: more are long legs, each of which has fewer

class IndexedTally {
 public:
  IndexedTally(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
               const Execution& execution)
      : index_(index),
        legs_(legs),
        execution_(execution),
        comparison_(legs, options, std::numeric_limits<double>::infinity()) {}

  Tally of(Range range) {
    const BoxedSegment leg(legs_.leg(range.first), range.first);
    index_.sides().for_some_near(leg.box, [&](std::size_t i) { comparison_.with_leg(leg, side(i)); });
    compare_alone(leg);  // what is nearest to it keeps the searches of the others narrow
    for (std::size_t first = range.first; first < range.last; first += legs_a_stretch) {
      compare_stretch({first, std::min(first + legs_a_stretch, range.last)});
    }
    return comparison_.take();
  }

 private:
  Box box_around(Range legs) const;
  void compare_stretch(Range stretch);
  void compare_group(Range group);
  void find_around(const Box& legs);
  void find_near(const Box& legs);
  void compare_with_near(const BoxedSegment& leg);
  void compare_alone(const BoxedSegment& leg);
  BoxedSegment side(std::size_t number) const { return {index_.obstacles().segment(number), number}; }
  bool skips(const BoxedSegment& leg, const Box& blocks) {
    poll();
    return comparison_.skips(leg, blocks);
  }
  void poll() {
    if (++looks_ % looks_a_poll == 0) execution_.check();
  }

  /// Of boxes near a group, and where its sides begin among those.
  struct Block {
    std::size_t number;
    std::size_t first;
  };

  const ObstacleIndex& index_;
  const LegBoxes& legs_;
  const Execution& execution_;
  Comparison comparison_;
  std::vector<std::size_t> around_;  // blocks near a stretch
  std::vector<Block> near_;
  std::vector<BoxedSegment> sides_;  // of the blocks
  std::size_t looks_ = 0;
};

Box IndexedTally::box_around(Range legs) const {
  Box box;
  for (std::size_t leg = legs.first; leg < legs.last; ++leg) box.include(box_of(legs_.leg(leg)));
  return box;
}

/// The index is asked for the blocks near all legs of it; each group chooses among those.
void IndexedTally::compare_stretch(Range stretch) {
  find_around(box_around(stretch));
  for (std::size_t first = stretch.first; first < stretch.last; first += legs_a_group) {
    compare_group({first, std::min(first + legs_a_group, stretch.last)});
  }
}

void IndexedTally::find_around(const Box& legs) {
  around_.clear();
  const auto skip = [&](const Box& blocks) {
    poll();
    return around_.size() > most_around || comparison_.skips(legs, blocks);
  };
  index_.sides().for_each_block(skip, [&](std::size_t block) { around_.push_back(block); });
}

/// By the blocks near all legs of it; each leg by itself where they are many.
void IndexedTally::compare_group(Range group) {
  find_near(box_around(group));
  for (std::size_t number = group.first; number < group.last; ++number) {
    const BoxedSegment leg(legs_.leg(number), number);
    if (near_.size() > most_near) {
      compare_alone(leg);
    } else {
      compare_with_near(leg);
    }
  }
}

void IndexedTally::find_near(const Box& legs) {
  near_.clear();
  sides_.clear();
  const auto skip = [&](const Box& blocks) {
    poll();
    return near_.size() > most_near || comparison_.skips(legs, blocks);
  };
  const auto add = [&](std::size_t block) {
    near_.push_back({block, sides_.size()});
    index_.sides().for_each_in(block, [&](std::size_t i) { sides_.push_back(side(i)); });
  };
  if (around_.size() > most_around) return index_.sides().for_each_block(skip, add);
  for (const std::size_t block : around_) {
    if (!skip(index_.sides().block_box(block))) add(block);
  }
}

void IndexedTally::compare_with_near(const BoxedSegment& leg) {
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (skips(leg, index_.sides().block_box(near_[i].number))) continue;
    const std::size_t last = i + 1 < near_.size() ? near_[i + 1].first : sides_.size();
    for (std::size_t k = near_[i].first; k < last; ++k) comparison_.with_leg(leg, sides_[k]);
  }
}

void IndexedTally::compare_alone(const BoxedSegment& leg) {
  index_.sides().for_each([&](const Box& blocks) { return skips(leg, blocks); },
                          [&](std::size_t i) { comparison_.with_leg(leg, side(i)); });
}

}  // namespace

Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution) {
  std::vector<Tally> parts(chunk_count(legs.leg_count(), leg_grain));
  for_chunks(legs.leg_count(), leg_grain, execution,
             [&](Range r) { parts[r.first / leg_grain] = IndexedTally(index, legs, options, execution).of(r); });
  Tally all;
  all.box = index.box();
  for (Tally& part : parts) all.join(std::move(part));
  return all;
}

}  // namespace warren
