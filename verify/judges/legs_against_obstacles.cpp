// SPDX-License-Identifier: BSD-3-Clause
// Obstacles against the legs of a path: by a pass over all of them, or by an index of those that are asked about again
// and again. Both are one loop. Segments in their order (obstacles in the one case, legs in the other) meet many that
// lie in blocks of boxes (verify/near/leg_boxes, verify/near/obstacle_index); blocks are left out that lie farther away
// than the least distance so far, by their boxes and by the segment's line (AgainstBlocks).
//
// The pass drops most obstacles before that by a screen (verify/near/path_screen), whose cells are as wide as what some
// obstacles say of the least distance. By the index the first leg begins with some sides near it.
//
// What is left out is no matter of order (verify/exact/exact_segments.hpp, distance), so both tallies are the same
// bits.
//
// What each part earns: a verification on one thread with it, and without it. The screen: 12 and 133 ms along the
// lattice of a maze of 1500 x 1500 cells (2.2 million walls, 150,000 legs), 61 and 139 by samples anywhere in it, 43
// and 52 among 100,000 polygons. Looking for several at once: 61 and 98 ms in that maze; by an index 0.13 and 0.75 ms
// for 1000 legs of it, 0.13 and 0.21 without the 64. The segment's line: 0.27 and 0.87 s where 300 legs cross 300,000
// walls.
#include "core/base/whole.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/near/path_screen.hpp"

namespace warren {
namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();
constexpr std::size_t verify_grain = std::size_t{1} << 14;
constexpr std::size_t small_grain = 1024;  // where one obstacle takes microseconds
constexpr std::size_t looks_a_poll = 4096;
constexpr std::size_t in_a_stretch = 64;
constexpr std::size_t in_a_group = 8;
constexpr std::size_t most_around = 256;  // blocks near a stretch: more are a wide one, whose groups have fewer
constexpr std::size_t most_near = 32;     // blocks near a group: more are long ones, each of which has fewer

/// Some in their order, each against many that lie in blocks of boxes: obstacles against the legs of a path, or legs
/// against the sides of an index. Those that follow each other are near each other: the blocks near 64 are looked for
/// once, and each eight of them choose among those, unless they are many. with(one, i) compares with number i of many.
template <class Blocks, class With>
class AgainstBlocks {
 public:
  AgainstBlocks(const Blocks& blocks, const Comparison& comparison, const Execution& execution, const With& with)
      : blocks_(blocks), comparison_(comparison), execution_(execution), with_(with) {}

  /// one(i): of i in the range, a BoxedSegment.
  template <class One>
  void compare(Range range, const One& one) {
    for (std::size_t first = range.first; first < range.last; first += in_a_stretch) {
      compare_stretch({first, std::min(first + in_a_stretch, range.last)}, one);
    }
  }
  void compare_alone(const BoxedSegment& one) {
    blocks_.for_each([&](const Box& box) { return skips(one, box); }, [&](std::size_t i) { with_(one, i); });
  }

 private:
  template <class Some>
  bool skips(const Some& some, const Box& blocks) {
    if (++looks_ % looks_a_poll == 0) execution_.check();
    return comparison_.skips(some, blocks);
  }

  template <class One>
  void compare_stretch(Range stretch, const One& one) {
    some_.clear();
    for (std::size_t i = stretch.first; i < stretch.last; ++i) some_.push_back(one(i));
    around_.clear();
    const Box box = box_around({0, some_.size()});
    blocks_.for_each_block([&](const Box& blocks) { return around_.size() > most_around || skips(box, blocks); },
                           [&](std::size_t block) { around_.push_back(block); });
    for (std::size_t first = 0; first < some_.size(); first += in_a_group) {
      compare_group({first, std::min(first + in_a_group, some_.size())});
    }
  }

  Box box_around(Range group) const {
    Box box;
    for (std::size_t i = group.first; i < group.last; ++i) box.include(some_[i].box);
    return box;
  }

  /// By the blocks near all of it; each by itself where they are many.
  void compare_group(Range group) {
    find_near(box_around(group));
    for (std::size_t i = group.first; i < group.last; ++i) {
      if (near_.size() > most_near) {
        compare_alone(some_[i]);
      } else {
        compare_with_near(some_[i]);
      }
    }
  }

  void find_near(const Box& group) {
    near_.clear();
    const auto skip = [&](const Box& blocks) { return near_.size() > most_near || skips(group, blocks); };
    const auto add = [&](std::size_t block) { near_.push_back(block); };
    if (around_.size() > most_around) return blocks_.for_each_block(skip, add);
    for (const std::size_t block : around_) {
      if (!skip(blocks_.block_box(block))) add(block);
    }
  }

  void compare_with_near(const BoxedSegment& one) {
    for (const std::size_t block : near_) {
      if (skips(one, blocks_.block_box(block))) continue;
      blocks_.for_each_in(block, [&](std::size_t i) { with_(one, i); });
    }
  }

  const Blocks& blocks_;
  const Comparison& comparison_;
  const Execution& execution_;
  const With& with_;
  std::vector<BoxedSegment> some_;   // a stretch
  std::vector<std::size_t> around_;  // blocks near it
  std::vector<std::size_t> near_;    // near a group of it
  std::size_t looks_ = 0;
};

/// One comparison of all obstacles in progress.
class ObstaclePass {
 public:
  ObstaclePass(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs, const VerifyOptions& options,
               const Execution& execution)
      : scene_(scene), options_(options), execution_(execution), obstacles_(obstacles), legs_(legs) {}

  Tally run() {
    if (obstacles_.size() == 0) return {};
    const double bound = least_of_some();
    // What the screen drops is as far as it is told from a leg; between the two, only a leg almost along an axis may be
    // taken to be nearer than it is.
    const double far = legs_.has_skew() ? bound * (1.0 + 4.0 * exact::distance_error) : bound;
    PathScreen screen(legs_, {obstacles_.size(), typical_wall(), std::max(far, options_.reach())}, execution_);
    screen.set_reach(far, options_.reach());
    const PathScreen::Rest rest = screened(screen);
    Tally tally = tally_of(rest.doubtful.size(), small_grain, bound, [&](std::size_t i) { return rest.doubtful[i]; });
    tally.box = rest.box;
    tally.least = std::min(tally.least, bound);
    return tally;
  }

 private:
  /// Of the obstacles of numbers number(0) .. number(count - 1), in chunks of `size`.
  template <class Number>
  Tally tally_of(std::size_t count, std::size_t size, double at_most, const Number& number) const {
    const auto obstacle = [&](std::size_t i) { return BoxedSegment(obstacles_.segment(number(i)), number(i)); };
    return tally_chunks(count, size, options_, at_most, execution_, [&](Range r, Comparison& comparison) {
      const auto with_leg = [&](const BoxedSegment& one, std::size_t leg) {
        comparison.with_leg({legs_.leg(leg), leg}, one);
      };
      AgainstBlocks(legs_, comparison, execution_, with_leg).compare(r, obstacle);
    });
  }

  /// The extent of the middle one of some walls.
  double typical_wall() const {
    constexpr std::size_t most = 255;
    const std::size_t step = std::max<std::size_t>(1, scene_.walls.size() / most);
    std::vector<double> extents;
    for (std::size_t i = 0; i < scene_.walls.size(); i += step) {
      const Box box = box_of(scene_.walls.segment(i));
      extents.push_back(std::max(box.width(), box.height()));
    }
    if (extents.empty()) return 0.0;
    const auto middle = extents.begin() + as_whole<std::ptrdiff_t>(extents.size() / 2);
    std::nth_element(extents.begin(), middle, extents.end());
    return *middle;
  }

  /// A distance from the path that some obstacle has: nothing beyond it matters for the least one. Asked are runs in a
  /// row, a 64th of a few obstacles, a 1024th of many.
  double least_of_some() const {
    constexpr std::size_t most_runs = 64;
    constexpr std::size_t most_in_a_run = 64;
    const std::size_t count = obstacles_.size();
    const std::size_t runs = std::clamp<std::size_t>(count / (1024 * most_in_a_run), 1, most_runs);
    const std::size_t length = std::min(most_in_a_run, count / 64 + 1);
    const auto number = [&](std::size_t i) { return count / runs * (i / length) + i % length; };
    const double bound = tally_of(std::min<std::size_t>(length, 8), 8, boundless, number).least;  // each chunk's first
    return std::min(bound, tally_of(runs * length, 128, bound, number).least);
  }

  static DoubleWall wall_of(const Segment& s) { return {s.a.x, s.a.y, s.b.x, s.b.y}; }

  /// What the screen leaves; the box is that of walls and polygons.
  PathScreen::Rest screened(const PathScreen& screen) const {
    PathScreen::Rest all = scene_.walls.visit([&](auto walls) {
      return screened(screen, walls.size(), 0, [walls](Range r) { return walls.subspan(r.first, r.size()); });
    });
    const auto sides_in = [&](Range r) {
      std::vector<DoubleWall> sides(r.size());
      for (std::size_t i = r.first; i < r.last; ++i) sides[i - r.first] = wall_of(obstacles_.side_segment(i));
      return sides;
    };
    const PathScreen::Rest sides = screened(screen, obstacles_.sides().size(), obstacles_.wall_count(), sides_in);
    all.doubtful.insert(all.doubtful.end(), sides.doubtful.begin(), sides.doubtful.end());
    for (const Ring& ring : obstacles_.rings()) {
      if (ring.polygon != Ring::none) all.box.include(ring.box);  // the bounds are no obstacle in this sense
    }
    return all;
  }

  /// Numbers count from `first_number`.
  template <class WallsIn>
  PathScreen::Rest screened(const PathScreen& screen, std::size_t count, std::size_t first_number,
                            const WallsIn& walls_in) const {
    const auto rest_of = [&](Range r) {
      PathScreen::Rest rest;
      const auto& walls = walls_in(r);
      screen.sift(std::span(walls), first_number + r.first, rest);
      return rest;
    };
    PathScreen::Rest all;
    for (const PathScreen::Rest& part : parts_of_chunks(count, verify_grain, execution_, rest_of)) {
      all.doubtful.insert(all.doubtful.end(), part.doubtful.begin(), part.doubtful.end());
      all.box.include(part.box);
    }
    return all;
  }

  const Scene& scene_;
  const VerifyOptions& options_;
  const Execution& execution_;
  const Obstacles& obstacles_;
  const LegBoxes& legs_;
};

}  // namespace

Tally compare_obstacles(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs,
                        const VerifyOptions& options, const Execution& execution) {
  return ObstaclePass(scene, obstacles, legs, options, execution).run();
}

Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution) {
  constexpr std::size_t leg_grain = 256;
  const auto compare = [&](Range r, Comparison& comparison) {
    const auto with_side = [&](const BoxedSegment& leg, std::size_t side) {
      comparison.with_leg(leg, {index.obstacles().segment(side), side});
    };
    AgainstBlocks against(index.sides(), comparison, execution, with_side);
    const auto leg = [&](std::size_t i) { return BoxedSegment(legs.leg(i), i); };
    const BoxedSegment first = leg(r.first);
    index.sides().for_some_near(first.box, [&](std::size_t side) { with_side(first, side); });
    against.compare_alone(first);  // what is nearest to it keeps the searches of the others narrow
    against.compare(r, leg);
  };
  Tally all = tally_chunks(legs.leg_count(), leg_grain, options, boundless, execution, compare);
  all.box = index.extent().box;
  return all;
}

}  // namespace warren
