// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/trace.hpp"

#include <string_view>

namespace warren {
namespace {

double nanoseconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double, std::nano>(d).count();
}

/// What one look at the clock takes: it is in each lap.
double clock_ns() {
  static const double least = [] {
    double ns = 1e3;
    for (int i = 0; i < 100; ++i) {
      const auto before = std::chrono::steady_clock::now();
      ns = std::min(ns, nanoseconds(std::chrono::steady_clock::now() - before));
    }
    return ns;
  }();
  return least;
}

}  // namespace

double process_cpu_s() noexcept {
  timespec now{};
  if (::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now) != 0) return 0.0;
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void StageAccount::add(const char* stage, double wall_s, double cpu_s) noexcept {
  constexpr std::array names{"queries", "checks"};
  std::array<double, 2> part_s{};
  for (std::size_t i = 0; i < names.size(); ++i) part_s[i] = 1e-9 * static_cast<double>(parts_ns_[i].exchange(0));
  const double whole_s = std::max(cpu_s, part_s[0] + part_s[1]);
  double rest = 1.0;
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (part_s[i] <= 0.0) continue;
    const double share = part_s[i] / whole_s;
    add_cost(names[i], share * wall_s, share * cpu_s);
    rest -= share;
  }
  add_cost(stage, std::max(0.0, rest) * wall_s, std::max(0.0, rest) * cpu_s);
}

std::vector<StageCost> StageAccount::costs() const noexcept {
  try {
    std::vector<StageCost> told;
    std::for_each(costs_.begin(), costs_.begin() + count_, [&](const Cost& c) {
      told.push_back({c.name, c.wall_s, c.cpu_s});
    });
    return told;
  } catch (const std::bad_alloc&) {
    return {};
  }
}

void StageAccount::add_cost(const char* stage, double wall_s, double cpu_s) noexcept {
  const auto end = costs_.begin() + count_;
  const auto at = std::find_if(costs_.begin(), end, [&](const Cost& c) { return std::string_view(c.name) == stage; });
  if (at == costs_.end()) return;
  if (at == end) {
    *at = {stage, 0.0, 0.0};
    ++count_;
  }
  at->wall_s += wall_s;
  at->cpu_s += cpu_s;
}

void PartClock::take(StagePart part) {
  const auto now = Clock::now();
  constexpr double least_ns = 1.0;  // what was timed is there, however coarse the clock
  ns_[static_cast<std::size_t>(part)] += std::max(least_ns, nanoseconds(now - last_) - clock_ns());
  last_ = now;
}

PartClock::~PartClock() {
  if (timed_ == 0) return;
  const double all = static_cast<double>(turns_) / static_cast<double>(timed_);
  for (const StagePart part : {StagePart::queries, StagePart::checks}) {
    account_->add_part(part, all * ns_[static_cast<std::size_t>(part)]);
  }
}

}  // namespace warren
