// SPDX-License-Identifier: BSD-3-Clause
// Round numbers along an axis, and how they are written; for worlds and plots.
#pragma once

#include <string>
#include <vector>

namespace warren {

/// 1, 2 or 5 times a power of ten: the step of about so many ticks on a range that is not empty.
double tick_step(double range, double count);

/// The multiples of step in [low, high], ends included but for rounding.
std::vector<double> ticks_between(double low, double high, double step);

/// With as many decimals as the step asks for, or as a power where numbers are very large or small.
std::string tick_text(double value, double step);

}  // namespace warren
