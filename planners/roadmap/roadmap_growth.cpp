// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/roadmap_growth.hpp"

#include "core/base/error.hpp"

namespace warren {

ConnectionRule star_rule(StarRule rule, std::uint64_t samples, std::size_t dimension, double volume) {
  const double n = std::max(static_cast<double>(samples), 2.0);
  const auto d = static_cast<double>(dimension);
  if (rule == StarRule::neighbours) {
    return {0.0, static_cast<std::uint32_t>(std::ceil(std::numbers::e * (1.0 + 1.0 / d) * std::log(n)))};
  }
  if (!(volume > 0.0)) throw InputError("radius", "this world does not tell its volume: use the rule by neighbours");
  const double unit_ball = std::pow(std::numbers::pi, 0.5 * d) / std::tgamma(0.5 * d + 1.0);
  return {2.0 * std::pow((1.0 + 1.0 / d) * volume / unit_ball * std::log(n) / n, 1.0 / d), 0};
}

}  // namespace warren
