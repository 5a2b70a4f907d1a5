// SPDX-License-Identifier: BSD-3-Clause
// Obstacles against the legs of a path: by a pass over all of them, or by an index of those that are asked about again
// and again. Both are one loop. Segments in their order (obstacles in the one case, legs in the other) meet many that
// lie in blocks of boxes (verify/near/obstacle_index); blocks are left out that lie farther away than the least
// distance so far, by their boxes and by the segment's line (AgainstBlocks).
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
#include "verify/judges/leg_reports.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "verify/near/path_screen.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse(const Scene& scene, std::string_view what) {
  throw InputError(scene.source.empty() ? "world" : scene.source, what);
}

/// Does the wall run along sides of blocked cells, where a judge of the cells sees it?
bool runs_along_blocked(const OccupancyMap& map, const Segment& wall, const Execution& execution) {
  const double most = 2.0 + std::max(map.width(), map.height());
  Box around;  // of both ends, in whole cells
  for (const Vec2 end : {wall.a, wall.b}) {
    const Vec2 p = map_point(map, end);
    const double rounding = 1e-6 + 4e-15 * (norm(end) + norm(map.origin)) / map.cell;  // cells
    if (!(std::abs(p.x) <= most && std::abs(p.y) <= most)) return false;
    if (std::abs(p.x - std::round(p.x)) > rounding || std::abs(p.y - std::round(p.y)) > rounding) return false;
    around.include(Vec2{std::round(p.x), std::round(p.y)});
  }
  const bool level = around.height() == 0.0;
  if (!level && around.width() > 0.0) return false;
  const auto blocked = [&](std::int64_t x, std::int64_t y) {  // or beyond the map
    return x < 0 || y < 0 || x >= map.width() || y >= map.height() || map.blocked.holds(x, y);
  };
  auto x = bounded_whole<std::int64_t>(around.min.x);
  auto y = bounded_whole<std::int64_t>(around.min.y);
  const auto length = bounded_whole<std::int64_t>(level ? around.width() : around.height());
  for (std::int64_t i = 0; i < length; ++i) {  // cell by cell, on either side
    execution.poll(as_whole<std::uint64_t>(i));
    if (!blocked(x, y) && !(level ? blocked(x, y - 1) : blocked(x - 1, y))) return false;
    ++(level ? x : y);
  }
  return true;
}

/// Walls beside a map are its borders and no obstacles more (worlds/rasters/lattice_polygons.hpp).
void check_walls_of_map(const Scene& scene, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 12;
  const std::size_t count = scene.walls.size();
  const std::size_t i = first_that(count, grain, execution.quiet(), [&](std::size_t wall) {
    return !runs_along_blocked(*scene.map, scene.walls.segment(wall), execution);
  });
  if (i < count) refuse(scene, fmt::format("wall {} runs over free cells of the map: the map is judged alone", i));
}

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
    blocks_.for_each_block(
        [&](const Box& box) { return skips(one, box); },
        [&](std::size_t block) { blocks_.for_each_in(block, [&](std::size_t i) { with_(one, i); }); });
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
        continue;
      }
      const BoxedSegment& one = some_[i];
      for (const std::size_t block : near_) {
        if (skips(one, blocks_.block_box(block))) continue;
        blocks_.for_each_in(block, [&](std::size_t k) { with_(one, k); });
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

  const Blocks& blocks_;
  const Comparison& comparison_;
  const Execution& execution_;
  const With& with_;
  std::vector<BoxedSegment> some_;   // a stretch
  std::vector<std::size_t> around_;  // blocks near it
  std::vector<std::size_t> near_;    // near a group of it
  std::size_t looks_ = 0;
};

/// The extent of the middle one of some walls.
double typical_wall(const WallSet& walls) {
  constexpr std::size_t most = 255;
  const std::size_t step = std::max<std::size_t>(1, walls.size() / most);
  std::vector<double> extents;
  for (std::size_t i = 0; i < walls.size(); i += step) {
    const Box box = box_of(walls.segment(i));
    extents.push_back(std::max(box.width(), box.height()));
  }
  if (extents.empty()) return 0.0;
  const auto middle = extents.begin() + as_whole<std::ptrdiff_t>(extents.size() / 2);
  std::nth_element(extents.begin(), middle, extents.end());
  return *middle;
}

/// What the screen leaves of walls_in(range); numbers count from `first_number`.
template <class WallsIn>
PathScreen::Rest screened(const PathScreen& screen, std::size_t count, std::size_t first_number,
                          const Execution& execution, const WallsIn& walls_in) {
  const auto rest_of = [&](Range r) {
    PathScreen::Rest rest;
    const auto& walls = walls_in(r);
    screen.sift(std::span(walls), first_number + r.first, rest);
    execution.reserve(rest.doubtful.size() * sizeof(std::size_t));
    return rest;
  };
  PathScreen::Rest all;
  const std::vector<PathScreen::Rest> parts = parts_of_chunks(count, verify_grain, execution, rest_of);
  std::size_t doubtful = 0;
  for (const PathScreen::Rest& part : parts) doubtful += part.doubtful.size();
  execution.reserve(doubtful * sizeof(std::size_t));
  all.doubtful.reserve(doubtful);
  for (const PathScreen::Rest& part : parts) {
    execution.check();
    all.doubtful.insert(all.doubtful.end(), part.doubtful.begin(), part.doubtful.end());
    all.box.include(part.box);
  }
  return all;
}

/// What it leaves of all obstacles; the box is that of walls and polygons.
PathScreen::Rest screened(const PathScreen& screen, const WallSet& all_walls, const Obstacles& obstacles,
                          const Execution& execution) {
  PathScreen::Rest all = all_walls.visit([&](auto walls) {
    return screened(screen, walls.size(), 0, execution, [walls](Range r) { return walls.subspan(r.first, r.size()); });
  });
  const auto sides_in = [&](Range r) {
    std::vector<DoubleWall> sides(r.size());
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto [a, b] = obstacles.side_segment(i);
      sides[i - r.first] = {a.x, a.y, b.x, b.y};
    }
    return sides;
  };
  const PathScreen::Rest sides =
      screened(screen, obstacles.sides().size(), obstacles.wall_count(), execution, sides_in);
  execution.reserve((all.doubtful.size() + sides.doubtful.size()) * sizeof(std::size_t));
  all.doubtful.insert(all.doubtful.end(), sides.doubtful.begin(), sides.doubtful.end());
  for (const Ring& ring : obstacles.rings()) {
    if (ring.polygon != Ring::none) all.box.include(ring.box);  // the bounds are no obstacle in this sense
  }
  return all;
}

}  // namespace

void check_plane_scene(const Scene& scene, const Execution& execution) {
  // Every member by its name, so that one more in Scene does not compile before it is said here, and in
  // check_space_scene(), what it means: can it be in a body's way? The seams lie between the polygons; where walls are
  // left out there are none: judged by verify_among_cells alone.
  const auto& [walls, polygons, seams, spheres, boxes, solids, bounds, clearance, maze, formula, packed, robot, arm,
               start, goal, other_goals, named_start, named_goals, goal_pose, grid, prices, map, source] = scene;
  const char* high = !spheres.empty() ? "spheres" : !boxes.empty() ? "boxes" : !solids.empty() ? "solids" : nullptr;
  if (high != nullptr) {
    refuse(scene, fmt::format("has {}, which only arms can meet: bodies in the plane are not judged among them", high));
  }
  if (map && (!polygons.empty() || bounds)) {
    refuse(scene, polygons.empty() ? "has bounds beside a map: the map is judged alone"
                                   : "has polygons beside a map: the map is judged alone");
  }
  if (map && walls.size() > 0) check_walls_of_map(scene, execution);
  if (walls.size() > 0 || !polygons.empty() || bounds || map) return;
  refuse(scene, "has neither obstacles nor bounds: nothing confines the body");
}

void check_space_scene(const Scene& scene) {
  const char* flat = scene.walls.size() > 0    ? "walls"
                     : !scene.polygons.empty() ? "polygons"
                     : scene.bounds            ? "bounds"
                     : scene.map               ? "a map"
                                               : nullptr;
  if (flat == nullptr) return;
  refuse(scene, fmt::format("has {}, which have no height: arms are judged among spheres and boxes", flat));
}

void check_not_negative(std::string_view name, double value) {
  if (value >= 0.0 && value <= largest_coordinate) return;
  throw InputError(name, "must be a number from 0 to 1e60", fmt::format("{}", value));
}

void LegReport::add(const LegReport& more) {
  least = std::min(least, more.least);
  met = std::min(met, more.met);
  looks += more.looks;
  if (more.violation && (!violation || more.violation->leg < violation->leg)) violation = more.violation;
}

Violation elsewhere(std::string_view which, std::span<const double> wanted, double distance, std::size_t leg) {
  return {leg, distance, fmt::format("{}: {}", which, fmt::join(wanted, " "))};
}

Verification verdict_on(const LegReport& legs, const WrongEnds& ends) {
  Verification verdict;
  verdict.min_clearance = legs.least;
  verdict.first_violation = ends.start ? ends.start : legs.violation ? legs.violation : ends.goal;
  verdict.verified = !verdict.first_violation;
  return verdict;
}

void Tally::join(const Tally& other) {
  least = std::min(least, other.least);
  violation = std::min(violation, other.violation);
  contacts.insert(contacts.end(), other.contacts.begin(), other.contacts.end());
  box.include(other.box);
}

void check_box(const Box& box, const LegBoxes& legs, Tally& tally) {
  if (box.empty() || (box.contains(legs.box().min) && box.contains(legs.box().max))) return;
  for (std::size_t i = 0; i < legs.path().size(); ++i) {
    if (box.contains(legs.path()[i])) continue;
    tally.violation = std::min(tally.violation, LegContact{i == 0 ? 0 : i - 1, box_number});
    return;
  }
}

/// Does the whole box lie farther from the obstacle's line than is of interest?
bool Comparison::beside(const Segment& obstacle, const Box& box) const {
  const Vec2 along = obstacle.b - obstacle.a;
  const Vec2 low = box.min - obstacle.a;  // the box's middle itself would be rounded as its coordinates are
  const Vec2 high = box.max - obstacle.a;
  const Vec2 to = 0.5 * (low + high);
  const double spread = 0.5 * (std::abs(along.x) * box.height() + std::abs(along.y) * box.width());
  const Vec2 most{std::abs(low.x) + std::abs(high.x), std::abs(low.y) + std::abs(high.y)};
  const double error = 1e-15 * (std::abs(along.x) * most.y + std::abs(along.y) * most.x);
  const double room = std::abs(cross(along, to)) - spread - 8.0 * error;
  const double length_sq = dot(along, along);
  constexpr double trifle = 1e-280;      // squares below it are rounded, to 0 at last: they decide nothing
  constexpr double least_room = 1e-140;  // its root
  return length_sq >= trifle && room > least_room &&
         room * room > std::max(near_sq_, trifle) * length_sq * (1.0 + 4.0 * exact::distance_error);
}

void Comparison::compare(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number) {
  const double r = options_.reach();
  const double d = exact::distance(s, obstacle);
  if (d < tally_.least) {
    tally_.least = d;
    narrow();
  }
  if (r > 0.0) {
    const bool may_be_near = d <= r * (1.0 + 1e-12) || is_doubtful(d, s, obstacle);
    if (may_be_near && exact::closer_than(s, obstacle, r)) forbid(leg, number);
  } else if (d == 0.0 && exact::touch(s, obstacle)) {
    touch(s, leg, obstacle, number);
  }
}

/// Is d within its own rounding of the clearance?
bool Comparison::is_doubtful(double d, const Segment& s, const Segment& obstacle) const {
  Box both = box_of(s);
  both.include(box_of(obstacle));
  return d <= options_.reach() + 1e-14 * std::max(both.width(), both.height());
}

void Comparison::touch(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number) {
  if (options_.contact == Contact::blocked || exact::cross_inside(s, obstacle)) return forbid(leg, number);
  const LegContact contact{leg, number};
  if (tally_.contacts.empty() || tally_.contacts.back() != contact) tally_.contacts.push_back(contact);
}

void Comparison::narrow() {
  const double r = options_.reach();
  const double least = std::min(at_most_, tally_.least);
  near_sq_ = std::max(least * least, r * r * (1.0 + 1e-12));
}

Tally compare_obstacles(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs,
                        const VerifyOptions& options, const Execution& execution) {
  if (obstacles.size() == 0) return {};
  // Of the obstacles of numbers number(0) .. number(count - 1), in chunks of `size`.
  const auto tally_of = [&](std::size_t count, std::size_t size, double at_most, const auto& number) {
    const auto obstacle = [&](std::size_t i) { return BoxedSegment(obstacles.segment(number(i)), number(i)); };
    return tally_chunks(count, size, options, at_most, execution, [&](Range r, Comparison& comparison) {
      const auto with_leg = [&](const BoxedSegment& one, std::size_t leg) {
        comparison.with_leg({legs.leg(leg), leg}, one);
      };
      AgainstBlocks(legs, comparison, execution, with_leg).compare(r, obstacle);
    });
  };
  // A distance from the path that some obstacle has: nothing beyond it matters for the least one. Asked are runs in a
  // row, a 64th of a few obstacles, a 1024th of many.
  constexpr std::size_t most_runs = 64;
  constexpr std::size_t most_in_a_run = 64;
  const std::size_t count = obstacles.size();
  const std::size_t runs = std::clamp<std::size_t>(count / (1024 * most_in_a_run), 1, most_runs);
  const std::size_t length = std::min(most_in_a_run, count / 64 + 1);
  const auto number = [&](std::size_t i) { return count / runs * (i / length) + i % length; };
  const double near = tally_of(std::min<std::size_t>(length, 8), 8, boundless, number).least;  // each chunk's first
  const double bound = std::min(near, tally_of(runs * length, 128, near, number).least);
  // What the screen drops is as far as it is told from a leg; between the two, only a leg almost along an axis may be
  // taken to be nearer than it is.
  const double far = legs.has_skew() ? bound * (1.0 + 4.0 * exact::distance_error) : bound;
  PathScreen screen(legs, {obstacles.size(), typical_wall(scene.walls), std::max(far, options.reach())}, execution);
  screen.set_reach(far, options.reach());
  const PathScreen::Rest rest = screened(screen, scene.walls, obstacles, execution);
  Tally tally = tally_of(rest.doubtful.size(), small_grain, bound, [&](std::size_t i) { return rest.doubtful[i]; });
  tally.box = rest.box;
  tally.least = std::min(tally.least, bound);
  return tally;
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
