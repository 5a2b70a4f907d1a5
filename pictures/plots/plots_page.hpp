// SPDX-License-Identifier: BSD-3-Clause
// Plots side by side on one page, as a file: SVG, PNG or PDF, all drawn from the same sheets.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/plots/plot_sheet.hpp"

namespace warren {

/// The endings that PlotsPage::write knows.
inline constexpr std::string_view plot_endings = ".svg .png .pdf";

struct PlotsPage {
  std::vector<PlotSheet> sheets = {};
  std::size_t columns = 1;  ///< at least one; the sheets fill row by row

  /// As large as its sheets need; that of one where there is none.
  Vec2 size() const;
  Vec2 place_of(std::size_t sheet) const;  ///< its upper left corner
  std::string svg() const;
  /// By the file's ending: .png, .pdf, and SVG for all others. A PNG has two pixels for one of the page, fewer where it
  /// would be wider or higher than 8192. Throws WriteError, Stopped; UsageError for a PDF where can_write_pdf() is
  /// false.
  void write(const std::string& file, const std::string& title, const Execution& execution) const;
};

}  // namespace warren
