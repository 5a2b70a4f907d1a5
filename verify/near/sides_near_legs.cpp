// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/sides_near_legs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/whole.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// Says of another box whether it meets one of these, which must outlive it.
auto meeting(std::span<const Box> boxes, const Execution& execution) {
  const auto box_of_number = [boxes](std::size_t i) { return boxes[i]; };
  return [boxes, blocks = BoxBlocks(boxes.size(), box_of_number, execution)](const Box& other) {
    bool found = false;
    blocks.for_each([&](const Box& block) { return found || !block.meets(other); },
                    [&](std::size_t i) { found = found || boxes[i].meets(other); });
    return found;
  };
}

/// 64 cells of a row, from column 64 w on: which are blocked. What lies outside is.
std::uint64_t blocked_word(const Bitmap& blocked, std::int64_t y, std::int64_t w) {
  const std::int64_t words = (std::int64_t{blocked.width()} + 63) / 64;
  if (y < 0 || y >= blocked.height() || w < 0 || w >= words) return ~std::uint64_t{0};
  const std::uint64_t beyond =
      w + 1 == words && blocked.width() % 64 != 0 ? ~std::uint64_t{0} << blocked.width() % 64 : 0;
  return blocked.row(as_whole<std::uint32_t>(y))[as_whole<std::size_t>(w)] | beyond;
}

std::uint64_t number_of(const OccupancyMap& map, std::int64_t x, std::int64_t y) {
  if (x < 0 || y < 0 || x >= map.width() || y >= map.height()) return NearSide::outside;
  return as_whole<std::uint64_t>(y) * map.width() + as_whole<std::uint64_t>(x);
}

/// The borders below and left of those of 64 cells that are wanted.
void gather_from_word(const OccupancyMap& map, std::int64_t y, std::int64_t w, std::uint64_t wanted,
                      std::vector<NearSide>& sides, const Execution& execution) {
  const auto point = [&](std::int64_t x, std::int64_t row) {
    return world_point(map, {static_cast<double>(x), static_cast<double>(row)});
  };
  const std::int64_t base = 64 * w;
  const std::uint64_t here = blocked_word(map.blocked, y, w);
  const std::uint64_t left = here << 1 | blocked_word(map.blocked, y, w - 1) >> 63;
  for (std::uint64_t rest = (here ^ left) & wanted; rest != 0 && y < map.height(); rest &= rest - 1) {
    const std::int64_t x = base + std::countr_zero(rest);
    const bool blocks = (here >> (x - base) & 1U) != 0;
    push_asked(sides, {{point(x, y), point(x, y + 1)}, number_of(map, blocks ? x : x - 1, y)}, execution);
  }
  const std::uint64_t below = blocked_word(map.blocked, y - 1, w);
  for (const bool blocks : {false, true}) {  // which of the two rows
    std::uint64_t rest = (blocks ? here & ~below : below & ~here) & wanted;
    while (rest != 0) {  // run by run
      const int first = std::countr_zero(rest);
      const int length = std::countr_one(rest >> first);
      const std::int64_t x = base + first;
      push_asked(sides, {{point(x, y), point(x + length, y)}, number_of(map, x, blocks ? y : y - 1)}, execution);
      rest = first + length < 64 ? rest & ~std::uint64_t{0} << (first + length) : 0;
    }
  }
}

/// The borders between free and blocked cells, the ring of blocked ones around the map included.
void gather_from_map(const OccupancyMap& map, const Box& box, std::vector<NearSide>& sides,
                     const Execution& execution) {
  Box in_cells;
  for (const Vec2 corner : box.corners()) in_cells.include(map_point(map, corner));
  const auto clamped = [](double x, double most) { return bounded_whole<std::int64_t>(x, 0.0, most); };
  constexpr double rounding = 1e-6;  // cells
  constexpr std::size_t words_a_poll = 4096;
  const std::int64_t first_x = clamped(std::floor(in_cells.min.x - rounding), map.width());
  const std::int64_t first_y = clamped(std::floor(in_cells.min.y - rounding), map.height());
  const std::int64_t last_x = clamped(std::floor(in_cells.max.x + rounding), map.width());
  const std::int64_t last_y = clamped(std::floor(in_cells.max.y + rounding), map.height());
  std::size_t words = 0;
  for (std::int64_t y = first_y; y <= last_y; ++y) {
    for (std::int64_t w = first_x / 64; w <= last_x / 64; ++w) {
      if (words++ % words_a_poll == 0) execution.check();
      std::uint64_t wanted = ~std::uint64_t{0};
      if (first_x > 64 * w) wanted <<= first_x - 64 * w;
      if (last_x < 64 * w + 63) wanted &= (std::uint64_t{2} << (last_x - 64 * w)) - 1;
      gather_from_word(map, y, w, wanted, sides, execution);
    }
  }
}

constexpr double most_turn_rad = 3.0;  // so that the run's turn is the shorter way between its ends, too

/// All poses from first to last in one direction, and how far each of them is from the line.
bool is_straight(std::span<const Se2> poses, double bend) {
  const Vec2 way = poses.back().position() - poses.front().position();
  const double length_sq = dot(way, way);
  const double most_cross = bend * std::sqrt(length_sq);
  return std::all_of(poses.begin(), poses.end(), [&](const Se2& pose) {
    const Vec2 p = pose.position() - poses.front().position();
    const double along = dot(way, p);
    const bool on_the_way = length_sq > 0.0 ? along >= 0.0 && along <= length_sq : p == Vec2{};
    return pose.theta == poses.front().theta && on_the_way && std::abs(cross(way, p)) <= most_cross;
  });
}

bool turns_on_the_spot(std::span<const Se2> poses) {
  double sum = 0.0;
  const bool left = shorter_turn(poses[0].theta, poses[1].theta) > 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double turn = shorter_turn(poses[i - 1].theta, poses[i].theta);
    sum += turn;
    if (!(poses[i].position() == poses[0].position()) || (turn > 0.0) != left) return false;
  }
  return std::abs(sum) < most_turn_rad;
}

}  // namespace

PathSurroundings::PathSurroundings(const Scene& scene, const ObstacleIndex* index, const Execution& execution)
    : scene_(scene),
      own_(index == nullptr ? std::optional<Obstacles>(scene) : std::nullopt),
      obstacles_(index == nullptr ? *own_ : index->obstacles()),
      index_(scene.map ? nullptr : index) {
  if (scene.map) {
    extent_.box = extent_.with_bounds = world_box(*scene.map);
  } else {
    extent_ = index != nullptr ? index->extent() : extent_of(obstacles_, execution);
  }
}

/// With an index there is nothing to do.
void PathSurroundings::file(std::span<const Box> boxes, const Execution& execution) {
  if (scene_.map || index_ != nullptr) return;
  constexpr std::size_t grain = std::size_t{1} << 14;
  const auto is_asked = meeting(boxes, execution);
  const auto near_in = [&](Range r) {
    RawVector<std::size_t> near;
    for (std::size_t i = r.first; i < r.last; ++i) {
      if (is_asked(box_of(obstacles_.segment(i)))) near.push_back(i);
    }
    return near;
  };
  near_ = joined_parts(parts_of_chunks(obstacles_.size(), grain, execution, near_in), execution);
  near_sides_.emplace(
      near_.size(), [&](std::size_t i) { return box_of(obstacles_.segment(near_[i])); }, execution);
}

void PathSurroundings::gather(std::span<const Box> boxes, std::vector<NearSide>& sides,
                              const Execution& execution) const {
  sides.clear();
  if (scene_.map) {
    for (const Box& box : boxes) gather_from_map(*scene_.map, box, sides, execution);
    return;
  }
  const auto is_asked = meeting(boxes, execution);
  const auto visit = [&](std::size_t i) {
    const std::size_t number = index_ != nullptr ? i : near_[i];
    const Segment segment = obstacles_.segment(number);
    if (is_asked(box_of(segment))) push_asked(sides, {segment, number}, execution);
  };
  const BoxBlocks& filed = index_ != nullptr ? index_->sides() : *near_sides_;
  filed.for_each([&](const Box& block) { return !is_asked(block); }, visit);
  std::sort(sides.begin(), sides.end(), [](const NearSide& a, const NearSide& b) { return a.number < b.number; });
}

std::string PathSurroundings::name(std::uint64_t number) const {
  if (!scene_.map) return obstacles_.name(number);
  if (number == NearSide::outside) return "map: the body reaches outside";
  return fmt::format("cell {}, {}", number % scene_.map->width(), number / scene_.map->width());
}

double shorter_turn(double a, double b) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  double turn = b - a;
  turn -= full_turn * std::floor(turn / full_turn + 0.5);
  return turn;
}

Leg leg_of(std::span<const Se2> path, const PoseRun& run) {
  const Se2& a = path[run.first];
  const Se2& b = path[run.last];
  return {.a = a, .way = b.position() - a.position(), .turn = shorter_turn(a.theta, b.theta), .number = run.first};
}

std::vector<PoseRun> pose_runs(std::span<const Se2> path, double bend, const Execution& execution) {
  constexpr std::size_t most_legs = 1024;
  constexpr std::size_t runs_a_poll = 1024;
  if (path.size() == 1) return {PoseRun{0, 0}};
  std::vector<PoseRun> runs;
  for (std::size_t first = 0; first + 1 < path.size();) {
    if (runs.size() % runs_a_poll == 0) execution.reserve(runs_a_poll * sizeof(PoseRun));  // and polls
    std::size_t legs = 1;
    while (2 * legs <= most_legs && first + 2 * legs < path.size()) {
      const std::span<const Se2> poses = path.subspan(first, 2 * legs + 1);
      if (!is_straight(poses, bend) && !turns_on_the_spot(poses)) break;
      legs *= 2;
    }
    runs.push_back({first, first + legs});
    first += legs;
  }
  return runs;
}

}  // namespace warren
