// SPDX-License-Identifier: BSD-3-Clause
// An axis of a plot: where values lie on it, and its round ticks.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace warren {

/// low < high, both > 0 on a logarithmic axis; whole: a linear one counts something.
class PlotAxis {
 public:
  PlotAxis(double low, double high, bool logarithmic, bool whole)
      : logarithmic_(logarithmic), whole_(whole), low_(scaled(low)), high_(scaled(high)) {}
  /// 0 at the low end, 1 at the high one.
  double at(double value) const { return (scaled(value) - low_) / (high_ - low_); }
  bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0.0); }
  /// Five or so; of a logarithmic axis powers of ten, with 2 and 5 between them where there are few.
  std::vector<double> ticks() const;

 private:
  double scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }

  bool logarithmic_;
  bool whole_;
  double low_;
  double high_;
};

/// With some room around the values from low to high, which may be equal; low > high: there are none.
PlotAxis axis_around(double low, double high, bool logarithmic, bool from_zero = false, bool whole = false);

/// Four digits, with k, M or G: "1.5k".
std::string short_text(double value);
/// The same; on an axis whose name begins with "seconds", in the unit that fits: "50 us".
std::string tick_on_axis(double value, std::string_view name);

// Round numbers along an axis, and how they are written; for worlds and plots.

/// 1, 2 or 5 times a power of ten: the step of about so many ticks on a range that is not empty.
double tick_step(double range, double count);

/// The multiples of step in [low, high], ends included but for rounding.
std::vector<double> ticks_between(double low, double high, double step);

/// With as many decimals as the step asks for, or as a power where numbers are very large or small.
std::string tick_text(double value, double step);

}  // namespace warren
