// SPDX-License-Identifier: BSD-3-Clause
#include "planners/shorten/priced_taut.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace warren {
namespace {

class Puller {
 public:
  Puller(const Path<Vec2>& path, const PricedLegs& legs, const Execution& execution)
      : legs_(legs), execution_(execution) {
    for (const Vec2 place : path) {
      while (vertices_.size() > 1 && goes_straight_on(place)) vertices_.pop_back();
      vertices_.push_back({place, 0.0, legs.step, true});
    }
    for (std::size_t i = 1; i < vertices_.size(); ++i) {
      vertices_[i].leg = cost(vertices_[i - 1].place, vertices_[i].place);
    }
  }

  Path<Vec2> pulled() {
    constexpr double worth = 1e-4;
    constexpr int turns = 60;
    double older = std::numeric_limits<double>::infinity();  // two turns ago: one may be but halved steps
    double before = whole();
    for (int turn = 0; turn < turns && vertices_.size() > 1; ++turn) {
      noise_ = 1e-9 * before;
      leave_out();
      move();
      put_in();
      const double now = whole();
      if (older - now <= worth * now) break;
      older = std::exchange(before, now);
    }
    leave_out();
    Path<Vec2> path;
    for (const Vertex& v : vertices_) path.push_back(v.place);
    return path;
  }

 private:
  struct Vertex {
    Vec2 place;
    double leg = 0.0;    // what the leg to it costs
    double step = 0.0;   // of its next move
    bool is_new = true;  // has anything beside it changed since it was tried?
  };

  /// From the last vertex but one over the last: what costs the same with a vertex less.
  bool goes_straight_on(Vec2 to) const {
    constexpr double rounding = 1e-9;
    const Vec2 from = vertices_[vertices_.size() - 2].place;
    const Vec2 way = vertices_.back().place - from;
    const Vec2 rest = to - vertices_.back().place;
    return std::abs(cross(way, rest)) <= rounding * dot(way, rest) && legs_.is_free(from, to);
  }
  double cost(Vec2 a, Vec2 b) const { return legs_.cost(a, b); }
  double whole() const {
    double sum = 0.0;
    for (const Vertex& v : vertices_) sum += v.leg;
    return sum;
  }
  double least_step() const { return legs_.step / 64.0; }

  /// Each vertex that is not worth its corner, as far back as that goes.
  void leave_out() {
    std::vector<Vertex> kept;
    for (const Vertex& next : vertices_) {
      kept.push_back(next);
      while (kept.size() > 2) {
        execution_.check();
        Vertex& last = kept.back();
        const Vertex& middle = kept[kept.size() - 2];
        const Vec2 from = kept[kept.size() - 3].place;
        if (!last.is_new && !middle.is_new) break;
        const double straight = cost(from, last.place);
        if (!(straight <= middle.leg + last.leg + noise_ * 1e-3) || !legs_.is_free(from, last.place)) break;
        last.leg = straight;
        last.is_new = true;
        kept.erase(kept.end() - 2);
        kept[kept.size() - 2].is_new = true;
      }
    }
    vertices_ = std::move(kept);
  }

  /// Where the cost of both legs falls, first across the chord, then along it.
  void move() {
    for (std::size_t i = 1; i + 1 < vertices_.size(); ++i) {
      execution_.check();
      if (vertices_[i].step < least_step()) {
        if (!vertices_[i].is_new) continue;
        vertices_[i].step = 4.0 * least_step();
      }
      const Vec2 chord = vertices_[i + 1].place - vertices_[i - 1].place;
      const double length = norm(chord);
      if (!(length > 0.0)) continue;
      const Vec2 along = (1.0 / length) * chord;
      const Vec2 across{-along.y, along.x};
      const bool moved = move_along(i, across) || move_along(i, along);
      vertices_[i].is_new = moved;
      if (!moved) vertices_[i].step *= 0.5;
    }
  }

  /// The least of a parabola through three costs, and half as far where that is not free.
  bool move_along(std::size_t i, Vec2 direction) {
    Vertex& v = vertices_[i];
    const double now = v.leg + vertices_[i + 1].leg;
    const auto at = [&](double way) {
      const Vec2 place = v.place + way * direction;
      return cost(vertices_[i - 1].place, place) + cost(place, vertices_[i + 1].place);
    };
    const double ahead = at(v.step);
    const double back = at(-v.step);
    const double bend = ahead + back - 2.0 * now;
    const double downhill = ahead < back ? v.step : -v.step;
    double best = downhill;
    if (bend > 0.0) best = std::clamp(0.5 * v.step * (back - ahead) / bend, -2.0 * v.step, 2.0 * v.step);
    for (const double way : {best, 0.5 * best, 0.25 * best}) {
      if (!(std::abs(way) > 0.25 * least_step())) break;
      if (take(i, v.place + way * direction)) {
        if (std::abs(way) > 1.5 * v.step) v.step *= 2.0;
        return true;
      }
    }
    return false;
  }

  bool take(std::size_t i, Vec2 place) {
    Vertex& v = vertices_[i];
    Vertex& next = vertices_[i + 1];
    const double in = cost(vertices_[i - 1].place, place);
    const double out = cost(place, next.place);
    if (!(in + out < v.leg + next.leg - noise_)) return false;
    if (!legs_.is_free(vertices_[i - 1].place, place) || !legs_.is_free(place, next.place)) return false;
    v.place = place;
    v.leg = in;
    next.leg = out;
    vertices_[i - 1].is_new = v.is_new = next.is_new = true;
    return true;
  }

  /// A vertex in the middle of a leg, where that is cheaper off the leg.
  void put_in() {
    std::vector<Vertex> more{vertices_.front()};
    for (std::size_t i = 1; i < vertices_.size(); ++i) {
      execution_.check();
      Vertex next = vertices_[i];
      const Vec2 from = more.back().place;
      const Vec2 leg = next.place - from;
      const double length = norm(leg);
      const double pays = next.leg - length;  // a leg that costs nothing beyond is as cheap as can be
      if ((more.back().is_new || next.is_new) && length > 2.0 * legs_.step && pays > noise_) {
        const Vec2 across{-leg.y / length, leg.x / length};
        const Vec2 middle = from + 0.5 * leg;
        for (const double way : {legs_.step, -legs_.step, 0.25 * legs_.step, -0.25 * legs_.step}) {
          const Vec2 place = middle + way * across;
          const double in = cost(from, place);
          const double out = cost(place, next.place);
          if (!(in + out < next.leg - 1e3 * noise_)) continue;
          if (!legs_.is_free(from, place) || !legs_.is_free(place, next.place)) continue;
          more.push_back({place, in, legs_.step, true});
          next.leg = out;
          next.is_new = true;
          break;
        }
      }
      more.push_back(next);
    }
    vertices_ = std::move(more);
  }

  const PricedLegs& legs_;
  const Execution& execution_;
  std::vector<Vertex> vertices_;
  double noise_ = 0.0;  // what rounding may feign
};

}  // namespace

Path<Vec2> priced_taut(Path<Vec2> path, const PricedLegs& legs, const Execution& execution) {
  if (path.size() < 2) return path;
  Path<Vec2> pulled = Puller(path, legs, execution).pulled();
  // Rounding may lose what leaving out did not gain.
  return path_length(pulled, legs.cost) <= path_length(path, legs.cost) ? pulled : path;
}

}  // namespace warren
