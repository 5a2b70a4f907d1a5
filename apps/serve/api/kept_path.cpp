// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/kept_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/serve/http/http_message.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/chunks.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::serve {
namespace {

constexpr std::size_t steps_in_word = 32;

/// A place that steps may begin at: all places that they lead to are numbers without fractions then.
bool is_lattice_point(Vec2 p) {
  constexpr double farthest = 4294967296.0;
  const auto is_one = [](double x) {
    return x >= 1.0 && x <= farthest && static_cast<double>(static_cast<std::uint64_t>(x)) == x;
  };
  return is_one(p.x) && is_one(p.y);
}

/// 4: no step. Of places beyond 1 none is -0.
unsigned step_between(Vec2 a, Vec2 b) {
  if (!(b.x >= 1.0 && b.y >= 1.0)) return 4;
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  if (dy == 0.0 && (dx == 1.0 || dx == -1.0)) return dx > 0.0 ? 0 : 2;
  if (dx == 0.0 && (dy == 1.0 || dy == -1.0)) return dy > 0.0 ? 1 : 3;
  return 4;
}

/// The steps of legs first .. last - 1, first a multiple of steps_in_word; false where one is none.
bool pack(std::span<const Vec2> path, std::size_t first, std::size_t last, std::span<std::uint64_t> words) {
  unsigned wrong = 0;
  for (std::size_t leg = first; leg < last; leg += steps_in_word) {
    std::uint64_t word = 0;
    for (std::size_t i = leg; i < std::min(leg + steps_in_word, last); ++i) {
      if (i == 0 || i + 2 >= path.size()) continue;
      const unsigned step = step_between(path[i], path[i + 1]);
      wrong |= step & 4U;
      word |= std::uint64_t{step & 3U} << 2 * (i % steps_in_word);
    }
    words[leg / steps_in_word] = word;
  }
  return wrong == 0;
}

constexpr std::size_t blocks_a_look = 64;
/// Points in a chain that doubles, and the same again where they are joined.
constexpr std::size_t bytes_a_block = 4 * KeptCurve::block_points * sizeof(Vec2);

struct SeenLegs {
  std::vector<std::vector<Vec2>> chains;
  bool begins_seen = false;  // the first leg is
  bool ends_seen = false;    // the last leg is: its end stands in the last chain
  std::size_t points = 0;    // of what was added

  /// What is seen of the block that follows; is_next: it begins where these legs end.
  void add(SeenLegs part, bool is_next, std::size_t most_points) {
    const bool is_open = is_next && ends_seen;  // does the last chain go on?
    for (std::vector<Vec2>& chain : part.chains) {
      if (is_open && part.begins_seen && &chain == &part.chains.front()) {
        chains.back().insert(chains.back().end(), chain.begin() + 1, chain.end());
        points += chain.size() - 1;
      } else {
        points += chain.size();
        chains.push_back(std::move(chain));
      }
    }
    if (points > most_points) {
      throw HttpError(413, "path_too_long", "query",
                      fmt::format("more than {} points; ask for a part of them by bbox and z", grouped(most_points)));
    }
    ends_seen = part.ends_seen;
  }
};

SeenLegs seen_legs(std::span<const Vec2> path, const PathView& view) {
  SeenLegs seen;
  std::vector<std::vector<Vec2>>& chains = seen.chains;
  if (path.size() == 1 && view.box.contains(path.front())) chains.push_back({path.front()});
  bool is_open = false;  // does the last chain go on?
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const bool is_seen = box_of({path[i], path[i + 1]}).meets(view.box);
    if (is_seen && !is_open) chains.push_back({path[i]});
    if (is_open && !is_seen && (chains.back().size() == 1 || chains.back().back() != path[i])) {
      chains.back().push_back(path[i]);
    }
    is_open = is_seen;
    if (i == 0) seen.begins_seen = is_seen;
    if (!is_seen) continue;
    const bool is_far = distance(chains.back().back(), path[i + 1]) >= view.pixel;
    if (is_far || i + 2 == path.size()) chains.back().push_back(path[i + 1]);
  }
  seen.ends_seen = is_open;
  return seen;
}

PathState kept_state(const Answer& answer, std::size_t i) {
  PathState state;
  state.width = answer.state_width();
  std::ranges::copy(answer.numbers(i), state.numbers.begin());
  return state;
}
Vec2 at(const PathState& state) { return {state.numbers[0], state.numbers[1]}; }

constexpr double pixels_apart = 12.0;

struct Shares {
  double first = 0.0;
  double last = 1.0;
};

/// Of a straight way, what lies in the box; nothing where none does.
std::optional<Shares> shares_in(const Box& box, Vec2 from, Vec2 to) {
  Shares seen;
  const auto clip = [&](double begin, double way, double low, double high) {
    if (way == 0.0) return begin >= low && begin <= high;
    const auto [near, far] = std::minmax({(low - begin) / way, (high - begin) / way});
    seen.first = std::max(seen.first, near);
    seen.last = std::min(seen.last, far);
    return seen.first <= seen.last;
  };
  const bool is_seen =
      clip(from.x, to.x - from.x, box.min.x, box.max.x) && clip(from.y, to.y - from.y, box.min.y, box.max.y);
  return is_seen ? std::optional(seen) : std::nullopt;
}

class BodyWalk {
 public:
  BodyWalk(const Box& box, double apart, const Execution& execution)
      : box_(box), apart_(apart), execution_(execution) {}

  /// Legs that begin so far along the way. The end of a leg is the next one's start.
  void go(const PathLegs& legs, double along) {
    for (std::size_t leg = 0; leg < legs.leg_count() && !is_full(); ++leg) {
      execution_.poll(steps_++);
      const double length = legs.length(leg);
      const auto seen = std::isfinite(legs.radius(leg)) ? std::optional(Shares{})
                                                        : shares_in(box_, at(legs.at(leg, 0.0)), at(legs.at(leg, 1.0)));
      if (seen && length > 0.0) {
        for (double k = std::ceil((along + seen->first * length) / apart_); !is_full(); k += 1.0) {
          execution_.poll(steps_++);
          const double share = std::max(0.0, (k * apart_ - along) / length);
          if (share >= 1.0 || share > seen->last) break;
          add(legs.at(leg, share));
        }
      }
      along += length;
    }
  }
  void add(const PathState& state) {
    if (box_.contains(at(state))) places_.push_back(state);
  }
  bool is_full() const { return places_.size() > most_swept_bodies; }
  const std::vector<PathState>& places() const { return places_; }

 private:
  Box box_;
  double apart_;
  const Execution& execution_;
  std::size_t steps_ = 0;
  std::vector<PathState> places_;
};

void walk_curve(const KeptCurve& curve, const Box& box, BodyWalk& walk) {
  std::vector<Vec2> room;
  Answer piece;
  for (std::size_t block = 0; block < curve.block_count() && !walk.is_full(); ++block) {
    if (!curve.box(block).meets(box)) continue;
    const std::span<const Vec2> points = curve.points(block, room);
    piece.path.assign(points.begin(), points.end());
    walk.go(PathLegs(piece), curve.length_before(block));
  }
}

PathState goal_of(const Answer& way, const KeptCurve& curve) {
  if (!way.states.empty()) return kept_state(way, way.states.size() - 1);
  std::vector<Vec2> room;
  const Vec2 last = curve.points(curve.block_count() - 1, room).back();
  return {.numbers = {last.x, last.y}};
}

}  // namespace

KeptCurve::KeptCurve(Path<Vec2> path, const Execution& execution)
    : size_(path.size()),
      points_(std::move(path)),
      blocks_(chunk_count(std::max<std::size_t>(size_, 2) - 1, block_points)) {
  ends_[0] = points_.front();
  ends_[1] = points_.back();
  execution.reserve(size_ / 4 + blocks_.size() * sizeof(Block));
  steps_.resize(chunk_count(size_, steps_in_word));
  std::vector<char> are_steps(blocks_.size());
  for_each_index(blocks_.size(), 1, execution, [&](std::size_t block) {
    const std::size_t first = block * block_points;
    const std::size_t last = first + points_in(block);
    Box box;
    for (std::size_t i = first; i < last; ++i) box.include(points_[i]);
    blocks_[block] = {.first = points_[std::min(std::max<std::size_t>(first, 1), size_ - 1)], .box = box};
    const bool begins_well = is_lattice_point(blocks_[block].first) || size_ < 4;
    are_steps[block] = begins_well && pack(points_, first, last - 1, steps_) ? 1 : 0;
  });
  if (size_ > 3 && std::ranges::count(are_steps, 0) == 0) {
    points_ = Path<Vec2>();
    return;
  }
  steps_ = std::vector<std::uint64_t>();
  for_each_index(blocks_.size(), 1, execution, [&](std::size_t block) {
    const std::size_t first = block * block_points;
    double length = 0.0;
    for (std::size_t i = first; i + 1 < first + points_in(block); ++i) length += distance(points_[i], points_[i + 1]);
    if (block + 1 < blocks_.size()) blocks_[block + 1].length_before = length;
  });
  for (std::size_t block = 1; block < blocks_.size(); ++block) {
    blocks_[block].length_before += blocks_[block - 1].length_before;
  }
}

double KeptCurve::length_before(std::size_t block) const {
  if (steps_.empty() || block == 0) return blocks_[block].length_before;
  return distance(ends_[0], blocks_[0].first) + static_cast<double>(block * block_points - 1);
}

std::size_t KeptCurve::bytes() const {
  return points_.size() * sizeof(Vec2) + steps_.size() * sizeof(std::uint64_t) + blocks_.size() * sizeof(Block);
}

std::size_t KeptCurve::points_in(std::size_t block) const {
  return std::min(block_points + 1, size_ - block * block_points);
}

std::span<const Vec2> KeptCurve::points(std::size_t block, std::vector<Vec2>& room) const {
  if (steps_.empty()) return std::span<const Vec2>(points_).subspan(block * block_points, points_in(block));
  constexpr double motion[][2] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
  const std::size_t first = block * block_points;
  const std::size_t last = first + points_in(block);
  room.resize(last - first);
  Vec2* to = room.data();
  Vec2 at = blocks_[block].first;
  std::size_t leg = first;
  if (first == 0) {
    *to++ = ends_[0];
    ++leg;
  }
  *to = at;
  for (; leg + 1 < last; ++leg) {
    const auto step = steps_[leg / steps_in_word] >> 2 * (leg % steps_in_word) & 3U;
    at = {at.x + motion[step][0], at.y + motion[step][1]};
    *++to = at;
  }
  if (last == size_) *to = ends_[1];
  return room;
}

Path<Vec2> KeptCurve::whole(const Execution& execution) const {
  execution.reserve(size_ * sizeof(Vec2));
  if (steps_.empty()) return points_;
  Path<Vec2> path(size_);
  for_each_index(blocks_.size(), 1, execution, [&](std::size_t block) {
    std::vector<Vec2> room;
    const std::span<const Vec2> points = this->points(block, room);
    // The last is the next block's, which another thread writes.
    const std::size_t count = points.size() - (block + 1 < blocks_.size() ? 1 : 0);
    std::copy_n(points.begin(), count, path.begin() + static_cast<std::ptrdiff_t>(block * block_points));
  });
  return path;
}

Path<Vec2> curve_of(const Answer& answer, const Execution& execution) {
  constexpr double most_turn_rad = 0.0873;
  const PathLegs legs(answer);
  Path<Vec2> curve{answer.path.front()};
  for (std::size_t leg = 0; leg < legs.leg_count(); ++leg) {
    execution.poll(leg);
    const double parts = std::clamp(std::ceil(legs.length(leg) / (most_turn_rad * legs.radius(leg))), 1.0, 1000.0);
    for (double k = 1.0; k <= parts; k += 1.0) curve.push_back(at(legs.at(leg, k / parts)));
  }
  return curve;
}

std::vector<std::vector<Vec2>> seen_of(const KeptCurve& curve, const PathView& view, const Execution& execution) {
  std::vector<std::size_t> blocks;
  for (std::size_t block = 0; block < curve.block_count(); ++block) {
    execution.poll(block);
    if (curve.box(block).meets(view.box)) blocks.push_back(block);
  }
  SeenLegs joined;
  std::array<SeenLegs, blocks_a_look> parts;
  for (std::size_t first = 0; first < blocks.size(); first += blocks_a_look) {
    const std::size_t count = std::min(blocks_a_look, blocks.size() - first);
    execution.reserve(count * bytes_a_block);
    for_chunks(count, 4, execution, [&](Range r) {
      std::vector<Vec2> room;
      for (std::size_t i = r.first; i < r.last; ++i) parts[i] = seen_legs(curve.points(blocks[first + i], room), view);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t block = blocks[first + i];
      const bool is_next = first + i > 0 && blocks[first + i - 1] + 1 == block;
      joined.add(std::exchange(parts[i], {}), is_next, view.most_points);
    }
  }
  return std::move(joined.chains);
}

std::vector<PathPlace> places_along(const Answer& answer, std::size_t count, const Execution& execution) {
  const PathLegs legs(answer);
  double length = 0.0;
  for (std::size_t leg = 0; leg < legs.leg_count(); ++leg) {
    execution.poll(leg);
    length += legs.length(leg);
  }
  if (length == 0.0) return {{0.0, kept_state(answer, 0)}};
  const auto wanted = [&](std::size_t k) {
    return k + 1 == count ? length : length * static_cast<double>(k) / static_cast<double>(count - 1);
  };
  std::vector<PathPlace> places;
  double before = 0.0;  // length of all legs before
  double along = 0.0;   // of the reference point's way
  for (std::size_t leg = 0; places.size() < count; ++leg) {
    execution.poll(leg);
    const double its = legs.length(leg);
    const bool turns = legs.shape() == LegShape::turning;
    const double way = turns ? distance(at(legs.at(leg, 0.0)), at(legs.at(leg, 1.0))) : its;
    const bool is_last = leg + 1 == legs.leg_count();
    while (places.size() < count && (is_last || !(before + its < wanted(places.size())))) {
      const double share = its > 0.0 ? std::clamp((wanted(places.size()) - before) / its, 0.0, 1.0) : 1.0;
      places.push_back({along + share * way, legs.at(leg, share)});
    }
    before += its;
    along += way;
  }
  return places;
}

double reach_of(const RobotSpec& robot) { return robot.outline.empty() ? robot.radius : outline_reach(robot.outline); }

SweptBodies swept_bodies(const Answer& way, const KeptCurve& curve, const PathView& view, const Execution& execution) {
  const double reach = reach_of(way.problem.robot);
  if (!(reach > 0.0)) throw UsageError("a point has no extent, so it sweeps no more than its path");
  const Box box = view.box.grown(reach);
  for (double apart = std::max(0.5 * reach, pixels_apart * view.pixel);; apart *= 2.0) {
    BodyWalk walk(box, apart, execution);
    if (way.states.empty()) {
      walk_curve(curve, box, walk);
    } else {
      walk.go(PathLegs(way), 0.0);
    }
    walk.add(goal_of(way, curve));
    if (!walk.is_full()) return {apart, walk.places()};
  }
}

}  // namespace warren::serve
