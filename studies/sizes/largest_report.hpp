// SPDX-License-Identifier: BSD-3-Clause
// What `warren largest` says: to a person, as warren.largest/1, and as a plot of time against cells.
#pragma once

#include <string>

#include "pictures/plots/plot_sheet.hpp"
#include "scenes/text/palette.hpp"
#include "studies/sizes/largest_maze.hpp"

namespace warren::studies {

std::string largest_summary(const LargestOptions& options, const LargestResult& result, const Palette& palette);
std::string largest_json(const LargestOptions& options, const LargestResult& result);
/// Every run that came to its end, the runs at the largest size, and the budget's line.
PlotSheet largest_plot(const LargestOptions& options, const LargestResult& result);

}  // namespace warren::studies
