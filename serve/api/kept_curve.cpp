// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/kept_curve.hpp"

#include <algorithm>
#include <utility>

#include "parallel/chunks.hpp"

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
  for_chunks(blocks_.size(), 1, execution, [&](Range r) {
    const std::size_t first = r.first * block_points;
    const std::size_t last = first + points_in(r.first);
    Box box;
    for (std::size_t i = first; i < last; ++i) box.include(points_[i]);
    blocks_[r.first] = {.first = points_[std::min(std::max<std::size_t>(first, 1), size_ - 1)], .box = box};
    const bool begins_well = is_lattice_point(blocks_[r.first].first) || size_ < 4;
    are_steps[r.first] = begins_well && pack(points_, first, last - 1, steps_) ? 1 : 0;
  });
  if (size_ > 3 && std::ranges::count(are_steps, 0) == 0) {
    points_ = Path<Vec2>();
  } else {
    steps_ = std::vector<std::uint64_t>();
    measure_blocks(execution);
  }
}

void KeptCurve::measure_blocks(const Execution& execution) {
  for_chunks(blocks_.size(), 1, execution, [&](Range r) {
    const std::size_t first = r.first * block_points;
    double length = 0.0;
    for (std::size_t i = first; i + 1 < first + points_in(r.first); ++i) length += distance(points_[i], points_[i + 1]);
    if (r.last < blocks_.size()) blocks_[r.last].length_before = length;
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

void KeptCurve::unpack(std::size_t block, Vec2* to) const {
  constexpr double motion[][2] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
  const std::size_t first = block * block_points;
  const std::size_t last = first + points_in(block);
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
}

std::span<const Vec2> KeptCurve::points(std::size_t block, std::vector<Vec2>& room) const {
  if (steps_.empty()) return std::span<const Vec2>(points_).subspan(block * block_points, points_in(block));
  room.resize(points_in(block));
  unpack(block, room.data());
  return room;
}

Path<Vec2> KeptCurve::whole(const Execution& execution) const {
  execution.reserve(size_ * sizeof(Vec2));
  if (steps_.empty()) return points_;
  Path<Vec2> path(size_);
  for_chunks(blocks_.size(), 1, execution, [&](Range r) {
    std::vector<Vec2> room;
    const std::span<const Vec2> points = this->points(r.first, room);
    // The last is the next block's, which another thread writes.
    const std::size_t count = points.size() - (r.first + 1 < blocks_.size() ? 1 : 0);
    std::copy_n(points.begin(), count, path.begin() + static_cast<std::ptrdiff_t>(r.first * block_points));
  });
  return path;
}

}  // namespace warren::serve
