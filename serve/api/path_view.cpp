// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/path_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "parallel/chunks.hpp"
#include "scenes/text/human_units.hpp"
#include "serve/http/http_message.hpp"
#include "solve/paths/path_legs.hpp"

namespace warren::serve {
namespace {

constexpr std::size_t points_a_poll = std::size_t{1} << 16U;
constexpr std::size_t blocks_a_look = 64;
/// Points in a chain that doubles, and the same again where they are joined.
constexpr std::size_t bytes_a_block = 4 * KeptCurve::block_points * sizeof(Vec2);

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

/// What is seen of block after block.
class JoinedChains {
 public:
  explicit JoinedChains(const PathView& view) : most_points_(view.most_points) {}

  /// is_next: it begins where the one before ends.
  void add(SeenLegs part, bool is_next) {
    const bool is_open = is_next && ends_seen_;  // does the last chain go on?
    for (std::vector<Vec2>& chain : part.chains) {
      if (is_open && part.begins_seen && &chain == &part.chains.front()) {
        chains_.back().insert(chains_.back().end(), chain.begin() + 1, chain.end());
        points_ += chain.size() - 1;
      } else {
        points_ += chain.size();
        chains_.push_back(std::move(chain));
      }
    }
    if (points_ > most_points_) {
      throw HttpError(413, "path_too_long", "query",
                      fmt::format("more than {} points; ask for a part of them by bbox and z", grouped(most_points_)));
    }
    ends_seen_ = part.ends_seen;
  }
  std::vector<std::vector<Vec2>> chains() { return std::move(chains_); }

 private:
  std::size_t most_points_;
  std::vector<std::vector<Vec2>> chains_;
  std::size_t points_ = 0;
  bool ends_seen_ = false;
};

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
  std::vector<std::size_t> blocks;
  for (std::size_t block = 0; block < curve.block_count(); ++block) {
    if (block % points_a_poll == 0) execution.check();
    if (curve.box(block).meets(view.box)) blocks.push_back(block);
  }
  JoinedChains joined(view);
  std::array<SeenLegs, blocks_a_look> parts;
  for (std::size_t first = 0; first < blocks.size(); first += blocks_a_look) {
    const std::size_t count = std::min(blocks_a_look, blocks.size() - first);
    execution.reserve(count * bytes_a_block);
    for_chunks(count, 4, execution, [&](Range r) {
      std::vector<Vec2> room;
      for (std::size_t i = r.first; i < r.last; ++i) {
        parts[i] = seen_legs(curve.points(blocks[first + i], room), view);
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t block = blocks[first + i];
      const bool is_next = first + i > 0 && blocks[first + i - 1] + 1 == block;
      joined.add(std::exchange(parts[i], {}), is_next);
    }
  }
  return joined.chains();
}

}  // namespace warren::serve
