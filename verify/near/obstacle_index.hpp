// SPDX-License-Identifier: BSD-3-Clause
// What the judges of bodies in the plane keep of a scene for which they are asked again and again: walls, sides and
// polygons in blocks of boxes, so that a verdict takes as long as its path, however many walls there are. The judges'
// own: nothing of it is shared with planners and their worlds. A verdict is the same bits with it and without.
//
// Built in O(n log n), some seconds for 10^7 walls; 9 bytes a wall or side, and the polygons' corners.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/exact/exact_segments.hpp"

namespace warren {
// All obstacles of a scene as one numbered list of segments: the walls as they are, then the sides of the bounds, then
// the sides of the polygons. A side remembers its neighbours in its ring, because at a corner the ring's blocked side
// counts. Polygons are turned so that their inside lies left of every side; the bounds the other way round, so that
// left of their sides is outside the world.

/// Corners without repetitions; left of every side is blocked.
struct Ring {
  std::vector<Vec2> corners;
  std::size_t polygon = 0;  ///< its number in the scene; `none`: the bounds
  Box box = {};             ///< of the corners
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
};

/// Refers to the scene's walls, which must outlive it.
class Obstacles {
 public:
  /// A side of a ring: from corner `side` to the one after it.
  struct Side {
    std::size_t ring;
    std::size_t side;
  };

  explicit Obstacles(const Scene& scene);

  std::size_t size() const { return scene_.walls.size() + sides_.size(); }
  std::size_t wall_count() const { return scene_.walls.size(); }
  const std::vector<Side>& sides() const { return sides_; }
  const std::vector<Ring>& rings() const { return rings_; }
  Segment side_segment(std::size_t i) const {
    return exact::outline_side(rings_[sides_[i].ring].corners, sides_[i].side);
  }
  Segment segment(std::size_t i) const {
    return i < wall_count() ? scene_.walls.segment(i) : side_segment(i - wall_count());
  }
  /// The number of a ring's first side.
  std::size_t first_side(std::size_t ring) const { return wall_count() + first_side_[ring]; }
  /// e.g. "wall 17: 1.5 0.5 1.5 1.5"; numbers count from 0.
  std::string name(std::size_t i) const;

 private:
  const Scene& scene_;
  std::vector<Ring> rings_;
  std::vector<Side> sides_;
  std::vector<std::size_t> first_side_;
};

/// Is p inside of the outline? on_outline: what is said of a place on it. Exact; O(corners).
bool outline_holds(std::span<const Vec2> corners, Vec2 p, bool on_outline);
/// Is p in the open inside of the ring (the side left of it)?
inline bool strictly_inside(const Ring& ring, Vec2 p) { return outline_holds(ring.corners, p, false); }

/// Boxes in blocks of eight in a row, eight of these in one above, and so on up to one around all.
class BoxLevels {
 public:
  /// Calls visit(block) for blocks of the lowest level, leaving out those in blocks for whose box skip(box) is true.
  template <class Skip, class Visit>
  void for_each_block(const Skip& skip, const Visit& visit) const {
    if (!levels_.empty()) visit_block(levels_.size() - 1, 0, skip, visit);
  }
  const Box& block_box(std::size_t block) const { return levels_[0][block]; }

 protected:
  void build_on(RawVector<Box> blocks);

  std::vector<RawVector<Box>> levels_;  ///< the blocks, and what is above them; none where there are no boxes

 private:
  template <class Skip, class Visit>
  void visit_block(std::size_t level, std::size_t block, const Skip& skip, const Visit& visit) const {
    if (skip(levels_[level][block])) return;
    if (level == 0) return visit(block);
    const std::size_t end = std::min(8 * (block + 1), levels_[level - 1].size());
    for (std::size_t part = 8 * block; part < end; ++part) visit_block(level - 1, part, skip, visit);
  }
};

// The legs of a path in boxes: one around 8 legs in a row, one around 8 of these, and so on. Consecutive legs are near
// each other, so a search by boxes finds the legs near a place without any index of the plane.
//
// Built in one pass over the path by all threads, 4.6 bytes a leg. A search for what is near a wall looks at some tens
// to hundreds of boxes, unless those near several walls in a row are looked for once
// (verify/judges/leg_reports).

/// Refers to the path, which must outlive it. Immutable: any number of threads may ask.
class LegBoxes : public BoxLevels {
 public:
  static constexpr std::size_t legs_a_sum = 8192;  ///< of length()
  /// path: at least two points.
  LegBoxes(std::span<const Vec2> path, const Execution& execution);

  std::span<const Vec2> path() const { return path_; }
  std::size_t leg_count() const { return path_.size() - 1; }
  Segment leg(std::size_t i) const { return {path_[i], path_[i + 1]}; }
  Box box() const { return levels_.back().front(); }  ///< of the whole path
  double length() const { return length_; }           ///< of the path: sums of legs_a_sum legs in a row, added up
  /// Does some leg run along an axis but for a millionth of its length?
  bool has_skew() const { return has_skew_; }

  /// The second step after for_each_block(): visit(leg) for the legs of a block.
  template <class Visit>
  void for_each_in(std::size_t block, const Visit& visit) const {
    const std::size_t end = std::min(8 * (block + 1), leg_count());
    for (std::size_t leg = 8 * block; leg < end; ++leg) visit(leg);
  }

 private:
  std::span<const Vec2> path_;
  double length_ = 0.0;
  bool has_skew_ = false;
};

// Boxes in blocks: one box around eight that lie near each other, one around eight of these, and so on up to all. Made
// once for many questions of one kind: which boxes may be near this?
//
// The boxes are sorted by the x of their middles into about sqrt(n / 8) stripes, each stripe by y (Leutenegger,
// Lopez and Edgington 1997, "STR: a simple and efficient algorithm for R-tree packing"): only the order of coordinates
// counts, so neither scale nor crowding nor a few boxes far away matter. A question passes over blocks that a test of
// its own leaves out; as a block's box holds its members', a test that is monotone leaves out no more than it would one
// by one. Where few boxes are near a question takes O(log n) looks.
//
// Building: two sorts, 28 bytes a box while it lasts; 9 bytes a box stay.

/// Holds nothing of what the boxes are around. Immutable: any number of threads may ask.
class BoxBlocks : public BoxLevels {
 public:
  /// Boxes 0 .. count - 1, fewer than 2^32; box_of(i) may be called by any thread. Throws Stopped.
  template <class BoxOf>
  BoxBlocks(std::size_t count, const BoxOf& box_of, const Execution& execution) {
    if (count == 0) return;
    execution.reserve(count * (sizeof(Middle) + sizeof(std::uint32_t)) + count / (block_size - 1) * sizeof(Box));
    RawVector<Middle> middles(count);
    for_chunks(count, grain, execution, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; ++i) {
        const Box box = box_of(i);
        middles[i] = {box.min.x + box.max.x, box.min.y + box.max.y, as_whole<std::uint32_t>(i)};
      }
    });
    put_in_order(middles, execution);
    RawVector<Box> blocks(chunk_count(count, block_size));
    for_chunks(count, grain, execution, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; i += block_size) {
        Box box;
        for_each_in(i / block_size, [&](std::size_t number) { box.include(box_of(number)); });
        blocks[i / block_size] = box;
      }
    });
    build_on(std::move(blocks));
  }

  std::size_t size() const { return order_.size(); }

  /// Calls visit(number) for all boxes but those in blocks whose box skip(box) says to leave out.
  template <class Skip, class Visit>
  void for_each(const Skip& skip, const Visit& visit) const {
    for_each_block(skip, [&](std::size_t block) { for_each_in(block, visit); });
  }

  /// The second step after for_each_block(), for who asks several questions of one neighbourhood: visit(number) for the
  /// boxes of a block.
  template <class Visit>
  void for_each_in(std::size_t block, const Visit& visit) const {
    const std::size_t end = std::min(block_size * (block + 1), order_.size());
    for (std::size_t i = block_size * block; i < end; ++i) visit(std::size_t{order_[i]});
  }

  /// Calls visit(number) for some boxes that are rather near: a start for who looks for the nearest.
  template <class Visit>
  void for_some_near(const Box& place, const Visit& visit) const {
    if (!levels_.empty()) for_each_in(block_near(place), visit);
  }

 private:
  struct Middle {
    double x, y;  ///< doubled
    std::uint32_t number;
  };
  static constexpr std::size_t block_size = 8;
  static constexpr std::size_t grain = std::size_t{1} << 13;  ///< boxes: a multiple of block_size

  void put_in_order(RawVector<Middle>& middles, const Execution& execution);
  std::size_t block_near(const Box& place) const;

  RawVector<std::uint32_t> order_;  ///< numbers of the boxes, block by block
};

/// What obstacles take of the plane.
struct ObstacleExtent {
  Box box;          ///< of walls and polygons
  Box with_bounds;  ///< of the bounds, too
  double largest_coordinate() const;
};
/// One pass over all; throws Stopped.
ObstacleExtent extent_of(const Obstacles& obstacles, const Execution& execution);

/// Refers to the scene, which must outlive it and stay as it is. Immutable: any number of threads may ask.
class ObstacleIndex {
 public:
  /// Throws Stopped, and InputError where there are 2^32 walls and sides or more.
  ObstacleIndex(const Scene& scene, const Execution& execution);

  const Scene& scene() const { return scene_; }
  const Obstacles& obstacles() const { return obstacles_; }
  const BoxBlocks& sides() const { return sides_; }  ///< numbers as obstacles() has them
  const BoxBlocks& rings() const { return rings_; }  ///< numbers of obstacles().rings()
  const ObstacleExtent& extent() const { return extent_; }

 private:
  const Scene& scene_;
  Obstacles obstacles_;
  BoxBlocks sides_;
  BoxBlocks rings_;
  ObstacleExtent extent_;
};

/// The first polygon's ring that holds p in its inside; without an index all are asked. Throws Stopped.
std::optional<std::size_t> ring_around(const Obstacles& obstacles, const ObstacleIndex* index, Vec2 p,
                                       const Execution& execution);

}  // namespace warren
