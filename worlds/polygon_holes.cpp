// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/polygon_holes.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/geometry.hpp"
#include "worlds/plane_obstacles.hpp"

namespace warren {
namespace {

/// The polygon's inside lies left of each side: the outer ring runs anticlockwise, holes clockwise.
class HoleCutter {
 public:
  explicit HoleCutter(const Execution& execution) : execution_(execution) {}

  void add_ring(const std::vector<Vec2>& ring) {
    const auto first = static_cast<std::uint32_t>(corners_.size());
    const auto n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      corners_.push_back(ring[i]);
      add_line(first + i, first + (i + 1) % n);
    }
    ring_first_.push_back(first);
  }

  /// Ties all rings but the first one to what lies left and right of them.
  bool tie_holes() {
    for (std::size_t r = 1; r < ring_first_.size(); ++r) {
      const std::uint32_t end =
          r + 1 < ring_first_.size() ? ring_first_[r + 1] : static_cast<std::uint32_t>(corners_.size());
      std::uint32_t low = ring_first_[r];
      std::uint32_t high = low;
      for (std::uint32_t i = low; i < end; ++i) {
        if (is_before(corners_[i], corners_[low])) low = i;
        if (is_before(corners_[high], corners_[i])) high = i;
      }
      if (!tie(low, true) || !tie(high, false)) return false;
    }
    return true;
  }

  /// The outlines left of all lines; none where these do not close.
  std::vector<std::vector<Vec2>> pieces() {
    std::vector<std::vector<std::uint32_t>> leaving(corners_.size());
    for (std::uint32_t i = 0; i < lines_.size(); ++i) leaving[lines_[i].from].push_back(i);
    std::vector<char> used(lines_.size(), 0);
    std::vector<std::vector<Vec2>> result;
    for (std::uint32_t first = 0; first < lines_.size(); ++first) {
      if (used[first] != 0) continue;
      std::vector<Vec2>& outline = result.emplace_back();
      std::uint32_t line = first;
      do {
        if (used[line] != 0) return {};
        used[line] = 1;
        outline.push_back(corners_[lines_[line].from]);
        line = next_line(line, leaving[lines_[line].to]);
      } while (line != first);
      if (anticlockwise(outline) != outline) return {};
    }
    return result;
  }

 private:
  struct Line {
    std::uint32_t from, to;
  };

  void add_line(std::uint32_t from, std::uint32_t to) { lines_.push_back({from, to}); }
  Segment segment(const Line& line) const { return {corners_[line.from], corners_[line.to]}; }

  /// Cuts from the corner to the nearest one that it sees on the left (or on the right).
  bool tie(std::uint32_t corner, bool leftwards) {
    const Vec2 at = corners_[corner];
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      if (leftwards ? is_before(corners_[i], at) : is_before(at, corners_[i])) candidates.push_back(i);
    }
    std::sort(candidates.begin(), candidates.end(), [&](std::uint32_t i, std::uint32_t j) {
      const double near = distance(corners_[i], at);
      const double far = distance(corners_[j], at);
      return near != far ? near < far : i < j;
    });
    for (const std::uint32_t candidate : candidates) {
      execution_.check();
      if (!sees(corner, candidate)) continue;
      add_line(corner, candidate);
      add_line(candidate, corner);
      return true;
    }
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {  // the cut of a ring on that side
      return line.from == corner && (leftwards ? is_before(corners_[line.to], at) : is_before(at, corners_[line.to]));
    });
  }

  bool sees(std::uint32_t from, std::uint32_t to) const {
    const Segment cut{corners_[from], corners_[to]};
    return std::none_of(lines_.begin(), lines_.end(), [&](const Line& line) {
      for (const std::uint32_t end : {from, to}) {
        if (line.from != end && line.to != end) continue;
        const Vec2 other = corners_[line.from == end ? line.to : line.from];
        const Vec2 beyond = end == from ? cut.b : cut.a;
        if (on_segment(other, cut) || on_segment(beyond, {corners_[end], other})) return true;
        return false;
      }
      return segments_touch(cut, segment(line));
    });
  }

  /// Of the lines that leave the end of `arriving`, the first one clockwise of the way back.
  std::uint32_t next_line(std::uint32_t arriving, const std::vector<std::uint32_t>& leaving) const {
    const Vec2 at = corners_[lines_[arriving].to];
    const Vec2 back = corners_[lines_[arriving].from];
    std::uint32_t best = leaving.front();
    for (const std::uint32_t line : leaving) {
      if (turns_sooner(at, back, corners_[lines_[line].to], corners_[lines_[best].to])) best = line;
    }
    return best;
  }

  /// Going clockwise from `back` around `at`, a full turn for `back` itself, is p met before q?
  static bool turns_sooner(Vec2 at, Vec2 back, Vec2 p, Vec2 q) {
    const auto quarter = [&](Vec2 r) {  // 0: right of the way back; 1: straight on; 2: left of it; 3: the way back
      const int side = orient2d(at, back, r);
      if (side != 0) return side < 0 ? 0 : 2;
      return on_segment(r, {at, back}) || on_segment(back, {at, r}) ? 3 : 1;
    };
    if (quarter(p) != quarter(q)) return quarter(p) < quarter(q);
    return orient2d(at, p, q) < 0;
  }

  const Execution& execution_;
  std::vector<Vec2> corners_;
  std::vector<Line> lines_;  // sides, and each cut in both directions
  std::vector<std::uint32_t> ring_first_;
};

/// The sides that two of the pieces have, in opposite directions.
std::vector<Segment> shared_sides(std::span<const std::vector<Vec2>> pieces) {
  std::vector<Segment> sides;
  for (const std::vector<Vec2>& piece : pieces) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec2 a = piece[i];
      const Vec2 b = piece[i + 1 == piece.size() ? 0 : i + 1];
      sides.push_back(is_before(a, b) ? Segment{a, b} : Segment{b, a});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Segment& s, const Segment& t) { return s.a == t.a ? is_before(s.b, t.b) : is_before(s.a, t.a); });
  std::vector<Segment> shared;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i] == sides[i - 1]) shared.push_back(sides[i]);
  }
  return shared;
}

}  // namespace

std::vector<std::vector<Vec2>> without_holes(const std::vector<Vec2>& outer, std::span<const std::vector<Vec2>> holes,
                                             const Execution& execution) {
  HoleCutter cutter(execution);
  cutter.add_ring(anticlockwise(outer));
  for (const std::vector<Vec2>& hole : holes) {
    std::vector<Vec2> ring = anticlockwise(hole);
    std::reverse(ring.begin(), ring.end());
    if (ring.size() < 3 || anticlockwise(ring) == ring) return {};  // what has no area can't be turned
    cutter.add_ring(ring);
  }
  if (!cutter.tie_holes()) return {};
  return cutter.pieces();
}

bool add_without_holes(Scene& scene, std::size_t line, const std::vector<Vec2>& outer,
                       std::span<const std::vector<Vec2>> holes, const Execution& execution) {
  std::vector<std::vector<Vec2>> pieces = without_holes(outer, holes, execution);
  const std::vector<Segment> seams = shared_sides(pieces);
  scene.seams.insert(scene.seams.end(), seams.begin(), seams.end());
  for (std::vector<Vec2>& piece : pieces) scene.polygons.push_back({std::move(piece), line});
  return !pieces.empty();
}

bool stands_on_seam(const Scene& scene, Vec2 p) {
  return std::any_of(scene.seams.begin(), scene.seams.end(),
                     [&](const Segment& s) { return on_segment(p, s) && !(p == s.a) && !(p == s.b); });
}

}  // namespace warren
