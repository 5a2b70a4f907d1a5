// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/lines_side_by_side.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace warren {
namespace {

using Leg = std::array<double, 4>;               // of its ends, the lesser first
using PathNumbers = std::vector<std::uint32_t>;  // ascending, each once

constexpr std::size_t legs_per_poll = 1 << 12;

Leg leg_between(Vec2 a, Vec2 b) {
  if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
  return {a.x, a.y, b.x, b.y};
}

class SharedLegs {
 public:
  SharedLegs(std::span<const std::vector<Vec2>> paths, double dash, const Execution& execution)
      : paths_(paths), dash_(dash), execution_(execution), shown_(paths.size()) {
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
      for_each_leg(i, [&](Vec2 a, Vec2 b) {
        PathNumbers& users = users_[leg_between(a, b)];
        if (users.empty() || users.back() != i) users.push_back(i);
      });
    }
  }

  /// The first path along a run of legs with the same users draws it for all of them.
  std::vector<PolygonSet> take() {
    for (std::uint32_t i = 0; i < paths_.size(); ++i) {
      std::vector<Vec2> run;
      const PathNumbers* along = nullptr;
      for_each_leg(i, [&](Vec2 a, Vec2 b) {
        const PathNumbers& users = users_.at(leg_between(a, b));
        if (along == nullptr || *along != users) {
          end_run(i, along, run);
          run = {a};
          along = &users;
        }
        run.push_back(b);
      });
      end_run(i, along, run);
    }
    return std::move(shown_);
  }

 private:
  template <class Visit>
  void for_each_leg(std::uint32_t i, const Visit& visit) const {
    const std::vector<Vec2>& path = paths_[i];
    for (std::size_t k = 1; k < path.size(); ++k) {
      if (k % legs_per_poll == 0) execution_.check();
      if (!(path[k - 1] == path[k])) visit(path[k - 1], path[k]);
    }
  }
  void end_run(std::uint32_t path, const PathNumbers* users, const std::vector<Vec2>& run) {
    if (users == nullptr || users->front() != path) return;
    if (users->size() == 1) return shown_[path].add(run);
    take_turns(*users, run);
  }
  void take_turns(const PathNumbers& users, const std::vector<Vec2>& run);

  std::span<const std::vector<Vec2>> paths_;
  double dash_;
  const Execution& execution_;
  std::map<Leg, PathNumbers> users_;
  std::vector<PolygonSet> shown_;
};

/// Dashes of equal length, as many for each.
void SharedLegs::take_turns(const PathNumbers& users, const std::vector<Vec2>& run) {
  double length = 0.0;
  for (std::size_t k = 1; k < run.size(); ++k) length += distance(run[k - 1], run[k]);
  const auto rounds = std::max(std::round(length / dash_ / static_cast<double>(users.size())), 1.0);
  const auto dashes = static_cast<std::size_t>(rounds) * users.size();
  const double each = length / static_cast<double>(dashes);
  std::vector<Vec2> dash{run.front()};
  std::size_t drawn = 0;
  double walked = 0.0;
  for (std::size_t k = 1; k < run.size(); ++k) {
    const double leg = distance(run[k - 1], run[k]);
    for (; drawn + 1 < dashes && each * static_cast<double>(drawn + 1) < walked + leg; ++drawn) {
      const double share = (each * static_cast<double>(drawn + 1) - walked) / leg;
      const Vec2 end = run[k - 1] + share * (run[k] - run[k - 1]);
      dash.push_back(end);
      shown_[users[drawn % users.size()]].add(dash);
      dash = {end};
    }
    walked += leg;
    dash.push_back(run[k]);
  }
  shown_[users[drawn % users.size()]].add(dash);
}

}  // namespace

std::vector<PolygonSet> lines_side_by_side(std::span<const std::vector<Vec2>> paths, double dash,
                                           const Execution& execution) {
  return SharedLegs(paths, dash, execution).take();
}

}  // namespace warren
