// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/path_view.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "parallel/chunks.hpp"
#include "solve/paths/path_legs.hpp"

namespace warren {
namespace {

constexpr std::size_t points_a_poll = std::size_t{1} << 16U;

/// What is seen of some legs in a row.
struct SeenLegs {
  std::vector<std::vector<Vec2>> chains;
  bool begins_seen = false;  // the first leg is
  bool ends_seen = false;    // the last leg is: its end stands in the last chain
};

SeenLegs seen_legs(std::span<const Vec2> path, const PathView& view) {
  SeenLegs seen;
  std::vector<std::vector<Vec2>>& chains = seen.chains;
  if (path.size() == 1 && view.box.contains(path.front())) chains.push_back({path.front()});
  bool is_open = false;  // does the last chain go on?
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const bool is_seen = box_of({path[i], path[i + 1]}).meets(view.box);
    if (is_seen && !is_open) chains.push_back({path[i]});
    if (is_open && !is_seen && chains.back().back() != path[i]) chains.back().push_back(path[i]);
    is_open = is_seen;
    if (i == 0) seen.begins_seen = is_seen;
    if (!is_seen) continue;
    const bool is_far = distance(chains.back().back(), path[i + 1]) >= view.pixel;
    if (is_far || i + 2 == path.size() || chains.back().size() == 1) chains.back().push_back(path[i + 1]);
  }
  seen.ends_seen = is_open;
  return seen;
}

}  // namespace

Path<Vec2> curve_of(const Answer& answer, const Execution& execution) {
  constexpr double most_turn_rad = 0.0873;
  const PathLegs legs(answer);
  Path<Vec2> curve{answer.path.front()};
  for (std::size_t leg = 0; leg < legs.leg_count(); ++leg) {
    if (leg % points_a_poll == 0) execution.check();
    const double parts = std::clamp(std::ceil(legs.length(leg) / (most_turn_rad * legs.radius(leg))), 1.0, 1000.0);
    for (double k = 1.0; k <= parts; k += 1.0) {
      const PathState state = legs.at(leg, k / parts);
      curve.push_back({state.numbers[0], state.numbers[1]});
    }
  }
  return curve;
}

std::vector<std::vector<Vec2>> seen_of(const KeptCurve& curve, const PathView& view, const Execution& execution) {
  std::vector<SeenLegs> parts(curve.block_count());
  for_chunks(parts.size(), 4, execution, [&](Range r) {
    std::vector<Vec2> room;
    for (std::size_t block = r.first; block < r.last; ++block) {
      if (!curve.box(block).meets(view.box)) continue;
      parts[block] = seen_legs(curve.points(block, room), view);
    }
  });
  std::vector<std::vector<Vec2>> chains;
  bool is_open = false;  // does the last chain go on?
  for (SeenLegs& part : parts) {
    for (std::vector<Vec2>& chain : part.chains) {
      if (is_open && part.begins_seen && &chain == &part.chains.front()) {
        chains.back().insert(chains.back().end(), chain.begin() + 1, chain.end());
      } else {
        chains.push_back(std::move(chain));
      }
    }
    is_open = part.ends_seen;
  }
  return chains;
}

}  // namespace warren
