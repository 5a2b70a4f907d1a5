// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/path_places.hpp"

#include <algorithm>
#include <cmath>

namespace warren::serve {
namespace {

constexpr std::size_t legs_a_poll = std::size_t{1} << 16U;

PathState only_state(const Answer& answer) {
  if (answer.states.empty()) return {.numbers = {answer.path.front().x, answer.path.front().y}, .width = 2};
  PathState state;
  state.width = answer.states.width;
  std::ranges::copy(answer.states[0], state.numbers.begin());
  return state;
}

/// Goes along a path, leg by leg.
class Walk {
 public:
  Walk(const PathLegs& legs, const Execution& execution) : legs_(legs), execution_(execution) { begin_leg(); }

  /// target: not less than before.
  PathPlace at(double target) {
    while (leg_ + 1 < legs_.leg_count() && before_ + length_ < target) {
      before_ += length_;
      along_ += way_;
      ++leg_;
      begin_leg();
    }
    const double share = length_ > 0.0 ? std::clamp((target - before_) / length_, 0.0, 1.0) : 1.0;
    return {along_ + share * way_, legs_.at(leg_, share)};
  }

 private:
  void begin_leg() {
    if (leg_ % legs_a_poll == 0) execution_.check();
    length_ = legs_.length(leg_);
    way_ = length_;
    if (legs_.shape() != LegShape::turning) return;
    const PathState from = legs_.at(leg_, 0.0);
    const PathState to = legs_.at(leg_, 1.0);
    way_ = std::sqrt((to.numbers[0] - from.numbers[0]) * (to.numbers[0] - from.numbers[0]) +
                     (to.numbers[1] - from.numbers[1]) * (to.numbers[1] - from.numbers[1]));
  }

  const PathLegs& legs_;
  const Execution& execution_;
  std::size_t leg_ = 0;
  double before_ = 0.0;  // length of all legs before
  double along_ = 0.0;   // of the reference point's way
  double length_ = 0.0;  // of this leg
  double way_ = 0.0;
};

}  // namespace

std::vector<PathPlace> places_along(const Answer& answer, std::size_t count, const Execution& execution) {
  const PathLegs legs(answer);
  double length = 0.0;
  for (std::size_t leg = 0; leg < legs.leg_count(); ++leg) {
    if (leg % legs_a_poll == 0) execution.check();
    length += legs.length(leg);
  }
  if (length == 0.0) return {{0.0, only_state(answer)}};
  Walk walk(legs, execution);
  std::vector<PathPlace> places;
  for (std::size_t k = 0; k < count; ++k) {
    places.push_back(
        walk.at(k + 1 == count ? length : length * static_cast<double>(k) / static_cast<double>(count - 1)));
  }
  return places;
}

}  // namespace warren::serve
